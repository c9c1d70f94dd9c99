"""What works without any other package, told in one line: each CPython that is found runs it, and all must tell the same."""

import hashlib
import json
import tempfile
from pathlib import Path

import phytomer as ph

TABLES = ("summary", "records", "components")


def rows(run):
    return [len(getattr(run, table)) for table in TABLES]


in_memory = ph.grow("coffee", plants=3, seed=7)
capsule = in_memory.summary.__arrow_c_stream__()
assert "arrow_array_stream" in repr(capsule), capsule
with tempfile.TemporaryDirectory() as folder:
    written = ph.grow("coffee", plants=3, seed=7, out=Path(folder) / "run")
    assert rows(written) == rows(in_memory)
    parts = sorted(path for path in Path(folder).rglob("*.parquet"))
    digest = hashlib.sha256(b"".join(path.read_bytes() for path in parts)).hexdigest()
try:
    ph.grow("cofee")
    refused = ""
except ph.ScenarioError as error:
    refused = str(error)
assert "cofee" in refused
print(json.dumps([ph.__version__, rows(in_memory), len(parts), digest, refused]))
