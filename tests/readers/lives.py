"""Counts of organs in a life against the tables of its run: lives.py RUN PLANT COUNTS

COUNTS is JSON: for each age how many leaves, flowers and fruits stand, as another reader has counted them in the file.
"""

import json
import sys

import duckdb

run, plant, counts = sys.argv[1], int(sys.argv[2]), json.loads(sys.argv[3])
WOOD = ("internode", "short_internode")
assert len(counts) >= 5, counts
for age, of_age in counts.items():
    rows = duckdb.sql(f"""
        select kind, count(*) from read_parquet('{run}/records/part-*.parquet')
        where plant_id = {plant} and age = {age} group by kind""").fetchall()
    organs = {kind: count for kind, count in rows if kind not in WOOD and not kind.endswith("_bud")}
    counted = sum(of_age.values())
    assert counted == sum(organs.values()), f"age {age}: {of_age} in the file, {organs} in the records"
    print(f"age {age}: {counted} organs, as in the records")
