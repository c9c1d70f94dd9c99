"""Three readers of Parquet read every table of a run folder, and agree cell for cell: tables.py RUN

The types and units are those of datapackage.json, the counts of living things those of the summary.
"""

import json
import re
import sys
from pathlib import Path

import duckdb
import polars
import pyarrow.parquet

run = Path(sys.argv[1])
package = json.loads((run / "datapackage.json").read_text(encoding="utf-8"))
report = json.loads((run / "run.json").read_text(encoding="utf-8"))
resources = {resource["name"]: resource for resource in package["resources"]}
assert set(resources) >= {"components", "records", "events", "summary", "plants", "treatments", "site"}, resources.keys()

ARROW = {
    "integer": ("int32", "int64"),
    "number": ("float", "double"),
    "date": ("date32[day]",),
    "boolean": ("bool",),
    "string": ("string", *(f"dictionary<values=string, indices=int{bits}, ordered=0>" for bits in (8, 16, 32))),
}


def parts(table):
    return sorted((run / table).glob("part-*.parquet"))


def by_pyarrow(table, fields):
    rows = 0
    for part in parts(table):
        file = pyarrow.parquet.ParquetFile(part)
        rows += file.metadata.num_rows
        schema = file.schema_arrow
        assert schema.names == [field["name"] for field in fields], (part, schema.names)
        for field in fields:
            column = schema.field(field["name"])
            assert str(column.type) in ARROW[field["type"]], (part, column)
            unit = (column.metadata or {}).get(b"unit", b"").decode()
            assert unit == field.get("unit", ""), (part, field["name"], unit)
        known = {key.decode() for key in file.metadata.metadata or {}}
        assert any("seed" in key for key in known), known
        assert file.read().num_rows == file.metadata.num_rows
    return rows


def by_polars(table):
    return polars.scan_parquet([str(part) for part in parts(table)]).collect().height


def by_duckdb(table):
    return duckdb.sql(f"select count(*) from read_parquet('{run}/{table}/part-*.parquet')").fetchall()[0][0]


def same_cells(part):
    """The cells of a part file, after a comparison of what the readers make of each: nulls, words, and numbers to the
    bit, in the order of the rows."""
    def plain(columns):
        words = [name for name, of in columns.schema.items() if of in (polars.Categorical, polars.Enum)]
        numbers = [name for name, of in columns.schema.items() if of in (polars.Float32, polars.Float64)]
        bits = {polars.Float32: polars.UInt32, polars.Float64: polars.UInt64}
        columns = columns.with_columns(polars.col(words).cast(polars.String)) if words else columns
        return columns.with_columns(polars.col(name).reinterpret(dtype=bits[columns.schema[name]]) for name in numbers)

    by_polars = plain(polars.read_parquet(part))
    by_pyarrow = plain(polars.from_arrow(pyarrow.parquet.read_table(part)))
    by_duckdb = plain(polars.from_arrow(duckdb.sql(f"select * from read_parquet('{part}')").to_arrow_table()))
    for name, other in (("pyarrow", by_pyarrow), ("DuckDB", by_duckdb)):
        assert other.columns == by_polars.columns, (part, name, other.columns)
        for column in by_polars.columns:
            assert by_polars[column].equals(other[column], check_dtypes=True, null_equal=True), (part, name, column)
    return by_polars.height * by_polars.width


for table, resource in resources.items():
    fields = resource["schema"]["fields"]
    counts = {by_pyarrow(table, fields), by_polars(table), by_duckdb(table)}
    assert len(counts) == 1, f"{table}: the readers disagree: {counts}"
    cells = sum(same_cells(part) for part in parts(table))
    assert cells == max(counts) * len(fields), (table, cells, counts, len(fields))
    print(f"{table}: {counts.pop()} rows, {len(fields)} columns, three readers agree on {cells} cells")

# Rows are sorted by the columns that each part states, by plot, tick, plant and component as far as a table has them.
for table, resource in resources.items():
    names = [field["name"] for field in resource["schema"]["fields"]]
    order = [name for name in ("treatment_index", "plot_id", "tick", "plant_id", "component_id") if name in names]
    assert resource["schema"].get("primaryKey", order) == order, (table, resource["schema"]["primaryKey"])
    for part in parts(table):
        groups = pyarrow.parquet.ParquetFile(part).metadata
        for group in range(groups.num_row_groups):
            stated = groups.row_group(group).sorting_columns
            assert [names[by.column_index] for by in stated] == order, (part, stated)
            assert not any(by.descending for by in stated), (part, stated)
    rows = polars.scan_parquet([str(part) for part in parts(table)]).select(order).collect()
    assert rows.equals(rows.sort(order)), f"{table}: rows are not sorted by {order}"
    assert table == "events" or rows.n_unique() == rows.height, f"{table}: {order} repeat"
print("rows: sorted by plot, tick, plant and component, as their files state")

# Every kind that occurs has its Plant Ontology term, in the metadata of the files and in datapackage.json.
metadata = pyarrow.parquet.ParquetFile(parts("records")[0]).metadata.metadata
terms = json.loads(metadata[b"phytomer.plant_ontology"])
kind_field = next(field for field in resources["records"]["schema"]["fields"] if field["name"] == "kind")
assert kind_field["plantOntology"] == terms and set(kind_field["constraints"]["enum"]) == set(terms)
assert all(re.fullmatch("PO:[0-9]{7}", term) for term in terms.values()), terms
occurring = {row[0] for row in duckdb.sql(f"select distinct kind from read_parquet('{run}/records/part-*.parquet')").fetchall()}
assert occurring <= set(terms), occurring - set(terms)
print(f"kinds: {', '.join(sorted(occurring))}, each with its term")

summary = duckdb.sql(f"select * from read_parquet('{run}/summary/part-*.parquet')")
kinds = {
    "internodes": "ends_with(kind, 'internode') and alive",
    "dead_internodes": "ends_with(kind, 'internode') and not alive",
    "leaves": "kind = 'leaf'",
    "flowers": "kind in ('flower', 'inflorescence', 'spikelet')",
    "fruits": "kind in ('fruit', 'infructescence', 'strobilus')",
    "buds": "kind = 'apical_bud'",
}
for column, condition in kinds.items():
    assert column in summary.columns, f"the summary has no column {column}: {summary.columns}"
    disagreeing = duckdb.sql(f"""
        with counted as (
            select plant_id, age, count(*) filter (where {condition}) as n
            from read_parquet('{run}/records/part-*.parquet') group by plant_id, age)
        select count(*) from read_parquet('{run}/summary/part-*.parquet') s
        left join counted c using (plant_id, age) where s.{column} <> coalesce(c.n, 0)
    """).fetchall()[0][0]
    assert disagreeing == 0, f"{column}: {disagreeing} plants and ages disagree with records"

fields = {field["name"] for field in resources["records"]["schema"]["fields"]}
if report["resolved_scenario"]["scenario"]["output"].get("mechanics"):
    records = f"read_parquet('{run}/records/part-*.parquet')"
    rules = {
        "the volume of a frustum": """kind in ('internode', 'short_internode') and not abs(wood_volume_m3 / (pi() / 12 *
            length_m * (diameter_m ** 2 + diameter_m * diameter_tip_m + diameter_tip_m ** 2)) - 1) < 1e-5""",
        "mass where there is volume": "wood_volume_m3 is not null and not fresh_mass_kg > 0",
        "nothing for buds": "kind = 'apical_bud' and coalesce(wood_volume_m3, fresh_mass_kg) is not null",
        "bending of internodes": """kind in ('internode', 'short_internode') <>
            (curvature_per_m is not null and bending_moment_N_m is not null)""",
        "sizes": "curvature_per_m < 0 or bending_moment_N_m < 0",
    }
    for rule, broken in rules.items():
        rows = duckdb.sql(f"select count(*) from {records} where {broken}").fetchall()[0][0]
        assert rows == 0, f"mechanics, {rule}: {rows} rows disagree"
    # The base of the trunk carries the moment of all that stands; a tip carries almost none.
    ratio = duckdb.sql(f"""
        select avg(bending_moment_N_m) filter (where "order" = 1 and rank = 1) / avg(bending_moment_N_m)
        from {records} where kind = 'internode'
    """).fetchall()[0][0]
    assert ratio > 1, f"mechanics: the trunk's base bears {ratio} of the mean moment"
    print("mechanics: volumes, masses and moments agree")
else:
    assert not fields & {"fresh_mass_kg", "curvature_per_m", "bending_moment_N_m"}, fields

con = duckdb.connect()
con.execute(f"set file_search_path = '{run}'")
con.execute((run / "views.sql").read_text(encoding="utf-8"))
last = con.sql("select max(age) from summary").fetchall()[0][0]

# A tick is the plot's and an age the plant's; a plant has no row before it is sown.
for table in ("records", "events", "summary"):
    wrong = con.sql(f"""
        select count(*) from {table} join plants using (plot_id, plant_id)
        where tick <> age + sown_tick or age < 0 or {table}.treatment <> plants.treatment
    """).fetchall()[0][0]
    assert wrong == 0, f"{table}: {wrong} rows disagree with the sowing of their plants"
species, ticks = (con.sql(f"select count(distinct {name}) from plants").fetchall()[0][0] for name in ("species", "sown_tick"))
means = con.sql("select count(distinct species), sum(plants) from growth()").fetchall()[0]
assert means == (species, con.sql("select count(*) from summary").fetchall()[0][0]), means
print(f"sowing: {species} species, sown at {ticks} ticks")

# Events have the order of their axis, and the names of states go with their numbers.
for table in ("records", "components", "events", "records_world"):
    wrong = con.sql(f'select count(*) from {table} where axis_order is distinct from "order"').fetchall()[0][0]
    assert wrong == 0, f"{table}: {wrong} rows have another axis_order"
wrong = con.sql("""
    select count(*) from events e join components c using (plot_id, plant_id, component_id)
    where e.axis_order <> c.axis_order or (e.event = 'branched' and e.state is not null and e.state <> c.state)
""").fetchall()[0][0]
assert wrong == 0, f"events: {wrong} rows have the order or the state of another axis"
for table in ("components", "events"):
    names = con.sql(f"""
        select species, state, count(distinct state_name), count(state_name), count(*)
        from {table} join plants using (plot_id, plant_id) group by all
    """).fetchall()
    wrong = [row for row in names if row[2] > 1 or row[3] not in (0, row[4])]
    assert not wrong, f"{table}: states with several names: {wrong}"

# A growth unit is told by an event with its number of nodes; no node has more axillary axes than buds.
wrong = con.sql("""
    with made as (
        select plot_id, plant_id, axis_id, count(*) as nodes, max(growth_unit) as units, max(cycle) as cycles
        from components where growth_unit is not null group by all
    ), told as (
        select plot_id, plant_id, axis_id, sum(count) as nodes, count(*) as units from events where event = 'grew' group by all
    )
    select count(*) from made left join told using (plot_id, plant_id, axis_id)
    where told.nodes is distinct from made.nodes or told.units < made.units or made.cycles < 1
""").fetchall()[0][0]
assert wrong == 0, f"components: the growth units of {wrong} axes are not those of events"
buds = con.sql("""
    with borne as (
        select plot_id, plant_id, parent_id as component_id, count(*) as axes from components
        where kind = 'apical_bud' and origin = 'axillary' group by all
    )
    select count(*) filter (axes > axillary_buds), sum(axillary_buds), sum(axes)
    from components left join borne using (plot_id, plant_id, component_id) where axillary_buds is not null
""").fetchall()[0]
assert buds[0] == 0, f"components: {buds[0]} nodes have more axillary axes than buds"
print(f"growth units agree with events; {buds[1]} axillary buds, {buds[2]} of them became axes")

# Years and days are ages by the ticks of a year; the ground of plants is told or not within a treatment.
years = con.sql("""
    select count(*) from summary join plants using (plot_id, plant_id)
    where abs(age_years * ticks_per_year - age) > 1e-9 * (age + 1) or (age_years is null) <> (ticks_per_year is null)
""").fetchall()[0][0]
assert years == 0, f"summary: {years} ages in years are not those of the species"
for table, ages in (("summary", ["age"]), ("records", ["age"]), ("events", ["age"]), ("components", ["birth", "death"])):
    for age in ages:
        ticks = age if age == "age" else f"{age}_age"
        wrong = con.sql(f"""
            select count(*) from {table} join (select plot_id, plant_id, ticks_per_year from plants) using (plot_id, plant_id)
            where abs({age}_days - {age}_years * 146097 / 400) > 1e-9 * ({age}_days + 1)
            or (ticks_per_year = 12 and abs({age}_days - {ticks} * 30.436875) > 1e-9 * ({age}_days + 1))
            or ({age}_days is null) <> (ticks_per_year is null or {ticks} is null)
        """).fetchall()[0][0]
        assert wrong == 0, f"{table}: {wrong} ages in days are not those of the species"
wrong = con.sql("select count(*) from plants where ground_area_m2 <= 0").fetchall()[0][0]
assert wrong == 0, f"plants: {wrong} have no ground"

# A row a treatment, with a column for each factor; each plant is of one of them, and pairs are found in each.
treatments = con.sql("select treatment_index, treatment from treatments order by treatment_index").fetchall()
assert [index for index, _ in treatments] == list(range(len(treatments))), treatments
given = {row[0] for row in con.sql("select distinct treatment from plants").fetchall()}
assert given == {name for _, name in treatments}, (given, treatments)
assert len(con.sql(f"from treatments_at({last})").fetchall()) <= len(treatments)
paired = con.sql(f"select count(*), count(distinct (treatment, replicate, number)) from pairs_at({last})").fetchall()[0]
assert paired[0] == paired[1], f"{paired[0]} plants have {paired[1]} places"
factors = [field["name"] for field in resources["treatments"]["schema"]["fields"]][2:]
print(f"treatments: {len(treatments)}, factors: {', '.join(factors) or 'none'}")

# Places in the plot are sums in double precision of what `records` says and where the seed lies.
types = dict(zip(con.sql("from records_world").columns, con.sql("from records_world").types))
plants = con.sql("select count(*), count(distinct plant_id) from plants").fetchall()[0]
seeds = {row[0]: row[1:] for row in con.sql("select plant_id, x_m, y_m, z_m from plants").fetchall()}
assert plants == (len(seeds), len(seeds)) == (report["living"] + report["dead"],) * 2, plants
for axis, seed in zip("xyz", range(3)):
    assert str(types[f"world_{axis}_m"]) == "DOUBLE" and str(types[f"{axis}_m"]) == "FLOAT", types
    rows = con.sql(f"select plant_id, {axis}_m, world_{axis}_m from at_age({last})").fetchall()
    wrong = [row for row in rows if seeds[row[0]][seed] + row[1] != row[2]]
    assert not wrong, f"{axis}: {len(wrong)} places in the plot are no sums, such as {wrong[0]}"
counts = [con.sql(f"select count(*) from {table}").fetchall()[0][0] for table in ("records", "records_world")]
assert counts[0] == counts[1], f"records_world has {counts[1]} rows of {counts[0]}"
print(f"places: {len(seeds)} plants, from {min(seeds.values())} to {max(seeds.values())}")
alive = con.sql(f"select count(*) from at_age({last})").fetchall()[0][0]
print(f"views.sql: {alive} components stand at age {last}")
print("tables ok:", report.get("name", run.name))
