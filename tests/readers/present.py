"""Whether every package of a requirements file is here: present.py requirements.txt"""

import importlib
import sys
from pathlib import Path

# Packages that bring a program and no module.
PROGRAMS = {"taplo"}
# Packages whose module has another name.
MODULES = {"pillow": "PIL", "usd-core": "pxr"}


def find(name):
    if name not in PROGRAMS:
        importlib.import_module(MODULES.get(name, name))
    elif not Path(sys.executable).with_name(name).is_file():
        raise FileNotFoundError(f"no program beside {sys.executable}")


with open(sys.argv[1], encoding="utf-8") as lines:
    names = [line.split("==")[0].strip() for line in lines if line.strip() and not line.startswith("#")]
missing = []
for name in names:
    try:
        find(name)
    except Exception as reason:  # an import can fail in any way: a missing library, a wrong version
        missing.append(f"{name} ({reason})")
if missing:
    sys.exit("not here: " + ", ".join(missing))
