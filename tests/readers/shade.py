"""Hours of shade, found by a program of its own: shade.py SITE.toml FOLDER

SITE is a plan of buildings and zones without trees, FOLDER what `phytomer shade` made of it. The sun stands where the
formulas of the NOAA Solar Calculator have it (Meeus, *Astronomical Algorithms*, chapter 25), zones have random points,
and a point lies in the shade where its ray to the sun meets a box, slab by slab. Nothing of the program is used.
"""

import sys
import tomllib
import xml.etree.ElementTree as tree
from datetime import date, timedelta
from pathlib import Path

import numpy as np
import pyarrow.parquet as parquet

site = tomllib.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
folder = Path(sys.argv[2])
POINTS = 2000
STEPS = 49
rng = np.random.default_rng(7)


def declination(day, longitude):
    """Of the sun at about noon of a longitude, radians."""
    century = ((day - date(2000, 1, 1)).days - longitude / 360.0) / 36525.0
    mean = 280.46646 + century * (36000.76983 + century * 0.0003032)
    anomaly = np.radians(357.52911 + century * (35999.05029 - 0.0001537 * century))
    centre = (
        np.sin(anomaly) * (1.914602 - century * (0.004817 + 0.000014 * century))
        + np.sin(2 * anomaly) * (0.019993 - 0.000101 * century)
        + np.sin(3 * anomaly) * 0.000289
    )
    node = np.radians(125.04 - 1934.136 * century)
    longitude_of_sun = np.radians(mean + centre - 0.00569 - 0.00478 * np.sin(node))
    obliquity = np.radians(23.4392911 - 0.0130042 * century + 0.00256 * np.cos(node))
    return np.arcsin(np.sin(obliquity) * np.sin(longitude_of_sun))


def inside(corners, points):
    """Whether points lie in a polygon: a ray to the east crosses its outline an odd number of times."""
    odd = np.zeros(len(points), dtype=bool)
    for (ax, ay), (bx, by) in zip(corners, np.roll(corners, -1, axis=0)):
        spans = (ay > points[:, 1]) != (by > points[:, 1])
        with np.errstate(divide="ignore", invalid="ignore"):
            crossing = ax + (points[:, 1] - ay) / (by - ay) * (bx - ax)
        odd ^= spans & (points[:, 0] < crossing)
    return odd


def points_in(corners):
    corners = np.array(corners, dtype=float)
    low, high = corners.min(axis=0), corners.max(axis=0)
    kept = np.empty((0, 2))
    while len(kept) < POINTS:
        tried = low + rng.random((POINTS, 2)) * (high - low)
        kept = np.concatenate([kept, tried[inside(corners, tried)]])
    return kept[:POINTS]


def shaded(points, building, sun):
    """Whether rays from points on the ground to the sun meet a box."""
    turn = np.radians(building.get("turn_deg", 0.0))
    width_axis = np.array([np.cos(turn), -np.sin(turn)])
    depth_axis = np.array([np.sin(turn), np.cos(turn)])
    width, depth, top = building["size_m"]
    low, high = np.full(len(points), building.get("from_m", 0.0)), np.full(len(points), float(top))
    low, high = low / sun[2], high / sun[2]
    from_middle = points - np.array(building["place_m"])
    for axis, side in ((width_axis, width), (depth_axis, depth)):
        place, speed = from_middle @ axis, sun[:2] @ axis
        # At noon a ray may run along a side.
        with np.errstate(divide="ignore"):
            near, far = (-side / 2 - place) / speed, (side / 2 - place) / speed
        low, high = np.maximum(low, np.minimum(near, far)), np.minimum(high, np.maximum(near, far))
    return low <= high


def hours_of_day(points, day):
    latitude = np.radians(site["latitude_deg"])
    delta = declination(day, site.get("longitude_deg", 0.0))
    half = np.arccos(np.clip(-np.tan(latitude) * np.tan(delta), -1, 1))
    hours = 0.0
    for hour_angle in (np.arange(STEPS) + 0.5) / STEPS * 2 * half - half:
        up = np.sin(latitude) * np.sin(delta) + np.cos(latitude) * np.cos(delta) * np.cos(hour_angle)
        north = np.cos(latitude) * np.sin(delta) - np.sin(latitude) * np.cos(delta) * np.cos(hour_angle)
        sun = np.array([-np.cos(delta) * np.sin(hour_angle), north, up])
        dark = np.zeros(len(points), dtype=bool)
        for building in site["building"]:
            dark |= shaded(points, building, sun)
        hours += dark.mean() * half * 24 / np.pi / STEPS
    return hours, half * 24 / np.pi


table = parquet.read_table(folder / "shade.parquet")
units = {field.name: (field.metadata or {}).get(b"unit", b"").decode() for field in table.schema}
assert units["shade_h"] == "h/d" and units["area_m2"] == "m2", units
rows = {(row["zone"], row["month"]): row for row in table.to_pylist()}
assert len(rows) == 13 * len(site["zone"]) and all(row["state"] == "planned" for row in rows.values())
worst = 0.0
for zone in site["zone"]:
    points = points_in(zone["corners_m"])
    corners = np.array(zone["corners_m"], dtype=float)
    following = np.roll(corners, -1, axis=0)
    area = abs(np.sum(corners[:, 0] * following[:, 1] - following[:, 0] * corners[:, 1])) / 2
    for month in range(1, 13):
        days = [date(2025, month, 1) + timedelta(days=k) for k in range(31)]
        days = [day for day in days if day.month == month]
        found = np.array([hours_of_day(points, day) for day in days]).mean(axis=0)
        row = rows[zone["name"], month]
        assert abs(row["area_m2"] - area) < 1e-9 * area
        assert abs(row["sun_h"] - found[1]) < 0.03, (zone["name"], month, row["sun_h"], found[1])
        off = abs(row["shade_h"] - found[0])
        worst = max(worst, off)
        # 2,000 points, each of which is in the shade for 0 to 14 h: a standard error of at most 3 h / √2,000 = .07 h.
        assert off < 0.28, (zone["name"], month, row["shade_h"], found[0])
        assert row["plant_h"] == 0 and row["building_h"] == row["shade_h"]
root = tree.parse(folder / "plan.svg").getroot()
assert root.tag.endswith("svg") and sum(element.tag.endswith("image") for element in root) == len(site["zone"])
print(f"shade ok: off by {worst:.3f} h at most")
