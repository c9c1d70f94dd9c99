"""Whether every package of a requirements file can be imported: present.py requirements.txt"""

import importlib
import sys

with open(sys.argv[1], encoding="utf-8") as lines:
    names = [line.strip() for line in lines if line.strip() and not line.startswith("#")]
missing = []
for name in names:
    try:
        importlib.import_module(name)
    except Exception as reason:  # an import can fail in any way: a missing library, a wrong version
        missing.append(f"{name} ({reason})")
if missing:
    sys.exit("cannot be imported: " + ", ".join(missing))
