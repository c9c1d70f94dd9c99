"""An independent validator holds every shipped file against the JSON Schemas:
schemas.py SPECIES SCENARIO PRESETS FOREST PAGE PLAN COURT

SPECIES, SCENARIO, FOREST and PLAN are what `phytomer schema` prints; PRESETS is the folder with `species` and
`scenarios`, PAGE the documentation of forests, which has one as TOML, and COURT a plan.
"""

import copy
import json
import sys
import tomllib
from pathlib import Path

from jsonschema.validators import validator_for


def validator(path):
    schema = json.loads(Path(path).read_text(encoding="utf-8"))
    kind = validator_for(schema)
    kind.check_schema(schema)
    return kind(schema)


def refuses_a_misspelling(check, file):
    """A validator that lets everything through would prove nothing."""
    bad = copy.deepcopy(file)
    bad["nmae"] = bad.pop("name")
    return any(check.iter_errors(bad))


for folder, check in (("species", validator(sys.argv[1])), ("scenarios", validator(sys.argv[2]))):
    files = sorted((Path(sys.argv[3]) / folder).rglob("*.toml"))
    assert files, f"no files in {folder}"
    for path in files:
        file = tomllib.loads(path.read_text(encoding="utf-8"))
        faults = [f"{error.json_path}: {error.message}" for error in check.iter_errors(file)]
        assert not faults, f"{path}:\n" + "\n".join(faults)
        assert "name" not in file or refuses_a_misspelling(check, file), f"{path}: a misspelt key is let through"
    print(f"{folder}: {len(files)} files obey the schema")

check = validator(sys.argv[4])
forest = tomllib.loads(Path(sys.argv[5]).read_text(encoding="utf-8").split("```toml")[1].split("```")[0])
faults = [f"{error.json_path}: {error.message}" for error in check.iter_errors(forest)]
assert not faults, "\n".join(faults)
assert refuses_a_misspelling(check, forest), "a misspelt key of a forest is let through"
check = validator(sys.argv[6])
plan = tomllib.loads(Path(sys.argv[7]).read_text(encoding="utf-8"))
faults = [f"{error.json_path}: {error.message}" for error in check.iter_errors(plan)]
assert not faults, "\n".join(faults)
assert refuses_a_misspelling(check, plan), "a misspelt key of a plan is let through"
print("schemas ok")
