"""Reads an MTG in FORM-A by the rules of the format, and tells each entity in a line of JSON.

It knows nothing of phytomer. Rows, from the manual of AMAPmod: the code of an entity stands in the column of its
branching; `^` goes on from the last entity of the column, a code without it from the last one of the column on the left.
`/` begins a part, `<` follows, `+` branches; `a<<b` and `a++b` stand for all between. A `*` is another observation.

    python mtg.py FILE
"""

import json
import re
import sys

SECTION = re.compile(r"^(CODE|CLASSES|DESCRIPTION|FEATURES|MTG)\s*:")
STEP = re.compile(r"(<\.<|\+\.\+|<<|\+\+|/|<|\+)([A-Za-z_]+)([0-9.]*)")


def strip(line):
    """A line without comments: `#` to the next tab."""
    return [re.sub(r"#.*", "", cell).strip() for cell in line.rstrip("\r\n").split("\t")]


class Reader:
    def __init__(self, path):
        self.scales, self.features, self.described = {}, [], 0
        self.entities, self.last, self.names = [], [], None
        section = None
        for number, line in enumerate(open(path, encoding="utf-8"), 1):
            cells = strip(line)
            found = SECTION.match(cells[0])
            if found and section != "MTG":
                section = found[1]
            elif section == "CLASSES" and cells[0] not in ("", "SYMBOL"):
                self.scales[cells[0]] = int(cells[1])
            elif section == "DESCRIPTION" and cells[0] not in ("", "LEFT"):
                left, right, sign, _ = cells
                assert left in self.scales and sign in "<+", line
                assert all(one in self.scales for one in right.split(",")), line
                self.described += 1
            elif section == "FEATURES" and cells[0] not in ("", "NAME"):
                self.features.append(cells[0])
            elif section == "MTG":
                self.row(number, cells)
        assert self.described, "no relation is described: openalea.mtg reads a single vertex then"

    def row(self, number, cells):
        if self.names is None:
            assert cells[0] in ("ENTITY-CODE", "TOPO"), cells[0]
            first = next((i for i, cell in enumerate(cells) if i and cell), len(cells))
            self.columns, self.names = first, cells[first:]
            assert self.names == self.features, "columns are not in the order of FEATURES"
            return
        column = next((i for i, cell in enumerate(cells[: self.columns]) if cell), None)
        if column is None:
            assert not any(cells), f"line {number}"
            return
        values = {name: cell for name, cell in zip(self.names, cells[self.columns :]) if cell}
        for value in values.values():
            assert re.fullmatch(r"[A-Za-z0-9_.\-/]+", value), f"line {number}: `{value}` cuts the line of a reader"
            assert not re.fullmatch(r"[0-9.]+[eE].*", value), f"line {number}: `{value}` has an exponent"
        code = cells[column]
        if code == "*":
            self.entities[self.last[column]]["more"].append(values)
            return
        here = None
        if code.startswith("^"):
            here, code = self.last[column], code[1:]
        elif column:
            here = self.last[column - 1]
        del self.last[column:]
        steps = STEP.findall(code)
        assert "".join(a + b + c for a, b, c in steps) == code, f"line {number}: {code}"
        for sign, symbol, index in steps:
            index = float(index) if index else None
            if sign in ("<<", "++"):
                before = self.entities[here]
                assert before["class"] == symbol and index > before["index"]
                for each in range(int(before["index"]) + 1, int(index) + 1):
                    here = self.add(sign[0], symbol, float(each), here)
            else:
                here = self.add(sign, symbol, index, here)
        self.entities[here]["values"] = values
        self.last.append(here)

    def up(self, here, scale):
        """The whole around an entity, itself included, of a scale that is coarser."""
        while here is not None and self.scales[self.entities[here]["class"]] >= scale:
            here = self.entities[here]["complex"]
        return here

    def add(self, sign, symbol, index, here):
        scale = self.scales[symbol]
        whole = self.up(here, scale)
        bearer = None if sign == "/" else here
        self.entities.append(
            {"class": symbol, "index": index, "sign": sign, "bearer": bearer, "complex": whole, "values": {}, "more": []}
        )
        return len(self.entities) - 1


if __name__ == "__main__":
    for entity in Reader(sys.argv[1]).entities:
        print(json.dumps(entity))
