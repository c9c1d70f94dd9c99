"""The rows of `phytomer query` are those of DuckDB: queries.py VIEWS.sql FOLDER

FOLDER has for each query its SQL, `N.sql`, and the rows that phytomer gave, `N.parquet`. Columns have the same names in the same
order, rows are compared in any order; whole numbers, words and dates are equal, real numbers to a few roundings of sums.
"""

import sys
from pathlib import Path

import duckdb

views, folder = Path(sys.argv[1]), Path(sys.argv[2])
con = duckdb.connect()
con.execute(views.read_text(encoding="utf-8"))

ROUNDING = 1e-9


def key(row):
    """Rows in one order in both engines: real numbers last, by nine digits."""
    words = [str(value) for value in row if not isinstance(value, float)]
    return words, [f"{value:.9g}" for value in row if isinstance(value, float)]


def near(a, b):
    if isinstance(a, float) and isinstance(b, float):
        return a == b or abs(a - b) <= ROUNDING * max(abs(a), abs(b))
    return a == b


queries = sorted(folder.glob("*.sql"), key=lambda path: int(path.stem))
assert queries, folder
for query in queries:
    sql = query.read_text(encoding="utf-8")
    theirs = con.sql(sql)
    ours = con.sql(f"select * from read_parquet('{query.with_suffix('.parquet')}')")
    assert [name.lower() for name in ours.columns] == [name.lower() for name in theirs.columns], (sql, ours.columns, theirs.columns)
    rows, others = (sorted(relation.fetchall(), key=key) for relation in (ours, theirs))
    assert len(rows) == len(others), f"{sql}: {len(rows)} rows, and {len(others)} by DuckDB"
    for row, other in zip(rows, others):
        assert all(near(a, b) for a, b in zip(row, other)), f"{sql}:\n{row}\n{other}"
    print(f"{len(rows)} rows: {sql}")
print("queries ok:", len(queries))
