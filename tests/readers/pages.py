"""Reads a page of the life of plants and holds it against the tables of its run: pages.py PAGE RUN

Nothing here comes from the program: the policy and its hashes are checked by hashlib, the data unpacked by gzip, the
streams decoded as docs/view.md describes them, and the rows are those that pyarrow reads.
"""

import base64
import gzip
import hashlib
import html.parser
import json
import math
import re
import sys
from pathlib import Path

import pyarrow.parquet

page = Path(sys.argv[1]).read_text(encoding="utf-8")
run = Path(sys.argv[2])


class Elements(html.parser.HTMLParser):
    """The scripts, the styles and every attribute of a page."""

    def __init__(self):
        super().__init__()
        self.scripts, self.styles, self.attributes, self.within, self.ids = [], [], [], None, []

    def handle_starttag(self, tag, attributes):
        self.attributes += [(tag, name, value or "") for name, value in attributes]
        self.ids += [value for name, value in attributes if name == "id"]
        self.within = (tag, dict(attributes)) if tag in ("script", "style") else None
        if self.within:
            (self.scripts if tag == "script" else self.styles).append([dict(attributes), ""])

    def handle_endtag(self, _):
        self.within = None

    def handle_data(self, data):
        if self.within:
            (self.scripts if self.within[0] == "script" else self.styles)[-1][1] += data


elements = Elements()
elements.feed(page)
data = [text for attributes, text in elements.scripts if attributes.get("id") == "data"]
scripts = [text for attributes, text in elements.scripts if not attributes]
assert len(data) == 1 and len(scripts) + 1 == len(elements.scripts) and len(elements.styles) == 1

# The policy forbids all but what stands in the page, and nothing in it asks for more.
policy = next(value for tag, name, value in elements.attributes if (tag, name) == ("meta", "content") and "default-src" in value)
policy = dict(directive.strip().split(" ", 1) for directive in policy.split(";"))
assert policy["default-src"] == "'none'" and "unsafe" not in str(policy), policy


def hashed(text):
    return "'sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode() + "'"


assert policy["script-src"].split() == [hashed(text) for text in scripts]
assert policy["style-src"] == hashed(elements.styles[0][1])
for tag, name, value in elements.attributes:
    assert name not in ("src", "srcset", "style") and not name.startswith("on"), (tag, name, value)
    assert name != "href" or value.startswith(("#", "data:,")), (tag, name, value)
assert len(set(elements.ids)) == len(elements.ids)
labels = {value for tag, name, value in elements.attributes if name in ("aria-describedby", "for")}
assert all(word in elements.ids for label in labels for word in label.split())

plain = gzip.decompress(base64.b64decode("".join(data[0].split()), validate=True))
length = int.from_bytes(plain[:4], "little")
header = json.loads(plain[4 : 4 + length])
streams, at = {}, 4 + length
for name, size in header["streams"]:
    streams[name] = plain[at : at + size]
    at += size
assert at == len(plain) and len(streams) == len(header["streams"])


def numbers(name):
    found, value, shift = [], 0, 0
    for byte in streams[name]:
        value |= (byte & 127) << shift
        shift += 7
        if byte < 128:
            found.append((value >> 1) ^ -(value & 1))
            value = shift = 0
    assert shift == 0, name
    return found


def sums(steps):
    total, found = 0, []
    for step in steps:
        total += step
        found.append(total)
    return found


def measure(place):
    return header["least"] * 2 ** ((place - 1) / header["octave"]) if place > 0 else 0.0


def tracks(counts, ages, values, begin, kinds):
    """For each list its keys: (number of the age, value); values differ from the first of the list of its kind before."""
    ages, values, firsts, found = iter(ages), iter(values), {}, []
    for start, count, kind in zip(begin, counts, kinds, strict=True):
        keys, age, value = [], start, firsts.get(kind, 0)
        for key in range(count):
            age += next(ages) if key else 0
            value += next(values)
            if key == 0:
                firsts[kind] = value
            keys.append((age, value))
        found.append(keys)
    assert next(ages, None) is None and next(values, None) is None
    return found


AGES = header["ages"]
DIRECTION = ("dir_x", "dir_y", "dir_z")
UPPER = ("up_x", "up_y", "up_z")


def upper(roll, heading):
    """The upper side of an internode that points along a unit vector."""
    x, y, z = heading
    pole = 1 if roll < header["turn"] else -1
    near = max(1 + pole * z, sys.float_info.min)
    a = (1 - x * x / near, -x * y / near, -pole * x)
    b = (y * a[2] - z * a[1], z * a[0] - x * a[2], x * a[1] - y * a[0])
    turn = 2 * math.pi * (roll % header["turn"]) / header["turn"]
    return [math.cos(turn) * p + math.sin(turn) * q for p, q in zip(a, b, strict=True)]


def between(keys, number, real):
    """The value of a track at an age: held, or on the way to the next key."""
    before = [key for key in keys if key[0] <= number]
    after = [key for key in keys if key[0] > number]
    if not before:
        return keys[0][1] if keys else None
    age, value = before[-1]
    if real and after and value > 0 and after[0][1] > 0:
        share = (AGES[number] - AGES[age]) / (AGES[after[0][0]] - AGES[age])
        value += share * (after[0][1] - value)
    return value


def stands(start, lasts, number):
    return start >= 0 and start <= number and (lasts == 0 or number < start + lasts)


rows = {}
columns = [column["name"] for column in header["columns"]]
for part in sorted((run / "records").glob("part-*.parquet")):
    table = pyarrow.parquet.read_table(part)
    assert table.column_names == columns, "the page has the columns of the run, in their order"
    for row in table.to_pylist():
        rows.setdefault((row["plant_id"], row["age"]), {})[row["component_id"]] = row

compared = 0
for number, plant in enumerate(header["plants"]):
    start, lasts = sums(numbers(f"{number}.row.from")), numbers(f"{number}.row.lasts")
    assert len(start) == len(lasts) == plant["components"]
    kept = [column for column in header["columns"] if column["kept"]]
    values = {}
    kinds = [0] * len(start)
    for place, column in sorted(enumerate(kept), key=lambda entry: entry[1]["name"] != "kind"):
        of = [numbers(f"{number}.row.{place}.{what}") for what in ("counts", "ages", "values")]
        values[column["name"]] = tracks(*of, start, kinds if column["holds"] == "real" else [0] * len(start))
        if column["name"] == "kind":
            kinds = [keys[0][1] if keys else -1 for keys in values["kind"]]
    rolls = tracks(*[numbers(f"{number}.row.roll.{what}") for what in ("counts", "ages", "values")], start, [0] * len(start))

    # Lines: the first key of a point differs from that of the point before, of a line from that of its host.
    counts, hosts = numbers(f"{number}.line.points"), sums(numbers(f"{number}.line.host"))
    steps = [iter(numbers(f"{number}.point.{axis}")) for axis in "xyz"]
    keys_of, ages = numbers(f"{number}.point.keys"), iter(numbers(f"{number}.point.ages"))
    from_of, lasts_of = sums(numbers(f"{number}.point.from")), numbers(f"{number}.point.lasts")
    points, ends = [], []
    for line, count in enumerate(counts):
        ends += [len(points) + count] * count
        for inner in range(count):
            before = len(points) - 1 if inner else hosts[line] - 1
            here, age, keys = list(points[before][0][1]) if before >= 0 else [0, 0, 0], from_of[len(points)], []
            for key in range(keys_of[len(points)]):
                age += next(ages) if key else 0
                here = [x + next(step) for x, step in zip(here, steps, strict=True)]
                keys.append((age, list(here)))
            points.append(keys)
    assert len(points) == plant["points"]

    def point_at(point, when):
        keys = points[point]
        key = max((k for k, (age, _) in enumerate(keys) if age <= when), default=0)
        if key + 1 == len(keys) or keys[key][0] > when:
            return keys[key][1]
        share = (when - keys[key][0]) / (keys[key + 1][0] - keys[key][0])
        return [x + share * (y - x) for x, y in zip(keys[key][1], keys[key + 1][1], strict=True)]

    def following(point, when):
        return (next for next in range(point + 1, ends[point]) if stands(from_of[next], lasts_of[next], when))

    def far(a, b):
        x, y, z = (to - at for at, to in zip(a, b, strict=True))
        return math.sqrt(x * x + y * y + z * z)

    def carried(point, along, when):
        """The place on the line, so far along from a point."""
        here = point_at(point, when)
        for next in following(point, when):
            there = point_at(next, when)
            way = far(here, there)
            if way > 0 and along <= way:
                here = [x + along / way * (y - x) for x, y in zip(here, there, strict=True)]
                break
            along, here = along - way, there
        return [math.floor(x + 0.5) for x in here]

    # Parts: their places differ from those to which their hosts have carried them.
    part_hosts, shares = sums(numbers(f"{number}.part.host")), iter(numbers(f"{number}.part.share"))
    part_from, part_lasts = sums(numbers(f"{number}.part.from")), numbers(f"{number}.part.lasts")
    components = sums(numbers(f"{number}.part.component"))
    steps = [iter(numbers(f"{number}.part.{axis}")) for axis in "xyz"]
    ages = iter(numbers(f"{number}.part.ages"))
    parts = []
    for part, count in enumerate(numbers(f"{number}.part.keys")):
        host, age, off, keys = part_hosts[part] - 1, part_from[part], [0, 0, 0], []
        if host >= 0:
            after = next(following(host, age), None)
            share = next(shares) / 255
            along = share * far(point_at(host, age), point_at(after, age)) if after is not None else 0.0
        for key in range(count):
            age += next(ages) if key else 0
            off = [x + next(step) for x, step in zip(off, steps, strict=True)]
            there = carried(host, along, age) if host >= 0 else [0, 0, 0]
            keys.append((age, [x + y for x, y in zip(there, off, strict=True)]))
        parts.append(keys)
    assert len(parts) == plant["parts"]

    for at_age, age in enumerate(AGES):
        own = age - plant["sown"]
        recorded = rows.get((plant["number"], round(own)))
        # There are rows of whole ticks alone.
        if recorded is None or abs(own - round(own)) > 1e-3:
            continue
        standing = {i for i in range(len(start)) if stands(start[i], lasts[i], at_age)}
        assert standing == set(recorded), (plant["number"], age, len(standing), len(recorded))
        for component, row in recorded.items():
            for column in kept:
                keys, meant = values[column["name"]][component], row[column["name"]]
                found = between(keys, at_age, column["holds"] == "real")
                if column["holds"] == "real":
                    if meant is None:
                        assert found == -1, (column["name"], component, age, found)
                    else:
                        off = abs(measure(found) - meant)
                        assert off <= 0.03 * meant + 1e-9, (column["name"], component, age, measure(found), meant)
                elif isinstance(column["holds"], list):
                    assert column["holds"][found] == meant, (column["name"], component, age)
                else:
                    meant = -1 if meant is None else int(meant)
                    assert found == meant, (column["name"], component, age, found, meant)
                compared += 1
            # The upper side of an internode is within a degree, and the chord of that.
            if row["kind"].endswith("internode"):
                found = upper(between(rolls[component], at_age, False), [row[name] for name in DIRECTION])
                off = math.dist(found, [row[name] for name in UPPER])
                assert off <= 0.01746, ("up", component, age, found, off)
                compared += 1
            else:
                assert not rolls[component], component
        # Organs stand where their rows say, but for the radius of what bears them.
        drawn = {components[part]: keys for part, keys in enumerate(parts) if stands(part_from[part], part_lasts[part], at_age)}
        organs = {i for i, row in recorded.items() if not row["kind"].endswith(("internode", "bud"))}
        assert organs <= set(drawn), (age, len(organs - set(drawn)))
        for component in organs:
            row = recorded[component]
            keys = drawn[component]
            at_key = max(k for k, key in enumerate(keys) if key[0] <= at_age)
            here = keys[at_key][1]
            if at_key + 1 < len(keys):
                share = (AGES[at_age] - AGES[keys[at_key][0]]) / (AGES[keys[at_key + 1][0]] - AGES[keys[at_key][0]])
                here = [x + share * (y - x) for x, y in zip(here, keys[at_key + 1][1], strict=True)]
            radius = 0.5 * (recorded[row["parent_id"]]["diameter_tip_m"] or 0.0) if row["parent_id"] in recorded else 0.0
            off = math.dist([x * header["step_m"] for x in here], [row["x_m"], row["y_m"], row["z_m"]])
            assert off <= radius + header["tolerance_m"] * 1.01, (component, age, off, radius)
            compared += 1

assert compared > 0
assert re.fullmatch(r"\d+\.\d+\.\d+", header["version"])
print(f"{len(header['plants'])} plants at {len(AGES)} ages: {compared} values agree")
