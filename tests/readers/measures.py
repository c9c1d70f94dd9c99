"""Each measure of a run against lifelines, statsmodels and scipy: measures.py PHYTOMER RUN

The rows are read by DuckDB from the tables; nothing of phytomer's code has a part in what is expected.
"""

import json
import re
import subprocess
import sys
from collections import defaultdict

import duckdb
import numpy as np
import statsmodels.api as sm
from lifelines import KaplanMeierFitter
from lifelines.statistics import multivariate_logrank_test
from scipy import stats
from statsmodels.duration.survfunc import CumIncidenceRight, SurvfuncRight
from statsmodels.stats.power import TTestIndPower, TTestPower
from statsmodels.stats.proportion import proportion_confint

program, run = sys.argv[1:3]
checked = 0


def table(name):
    return f"read_parquet('{run}/{name}/*.parquet')"


def rows(sql):
    return duckdb.sql(sql).fetchall()


def measure(*words):
    done = subprocess.run([program, "measure", run, *words, "--json"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert not re.search(r"\b(nan|inf|infinity)\b", done.stdout.lower()), done.stdout
    return json.loads(done.stdout)["tables"]


def near(found, expected, what, relative=1e-9):
    global checked
    checked += 1
    assert found is not None, f"{what}: nothing, expected {expected}"
    assert np.isclose(found, expected, rtol=relative, atol=1e-12), f"{what}: {found}, expected {expected}"


with open(f"{run}/run.json", encoding="utf-8") as text:
    until = json.load(text)["until"]

LIVES = {
    "bud": "kind = 'apical_bud'",
    "axis": "kind like '%internode' and rank = 1",
    "leaf": "kind = 'leaf'",
}


def lives(which):
    """Group by order: duration, whether it ended, plant, cause."""
    return rows(f"""
        select c."order", coalesce(death_age - (cause_of_death in ('pruned', 'harvested'))::int, {until} - sown_tick) - birth_age,
            coalesce(cause_of_death not in ('pruned', 'harvested'), false), c.plant_id, cause_of_death
        from {table("components")} c join {table("plants")} p using (plant_id) where {LIVES[which]}""")


def survival(which):
    found = measure(f"{which}-life", "--by", "order")
    groups = defaultdict(list)
    for order, *life in lives(which):
        groups[str(order)].append(life)
    assert {row["group"] for row in found["survival"]["rows"]} == set(groups)
    for group, of in groups.items():
        time, ended, plant = (np.array([life[i] for life in of]) for i in range(3))
        kmf = KaplanMeierFitter().fit(time, ended)
        greenwood = SurvfuncRight(time, ended.astype(int)) if ended.any() else None
        for row in (row for row in found["survival"]["rows"] if row["group"] == group):
            at = row["dimension"]
            near(row["survival"], kmf.survival_function_at_times(at).iloc[0], f"{which} {group} survival at {at}")
            near(row["at_risk"], (time >= at).sum(), f"{which} {group} at risk at {at}")
            if row["ended"] and row["greenwood_se"]:
                place = list(greenwood.surv_times).index(at)
                near(row["greenwood_se"], greenwood.surv_prob_se[place], f"{which} {group} Greenwood at {at}", 1e-7)
        jackknife(which, group, found, (time, ended, plant))
        median = next(row for row in found["median"]["rows"] if row["group"] == group)["median"]
        expected = kmf.median_survival_time_
        assert (median is None) == bool(np.isinf(expected)), (which, group, median, expected)
        if median is not None:
            near(median, expected, f"{which} {group} median")
    if len(groups) > 1:
        every = [(life[0], life[1], group) for group, of in groups.items() for life in of]
        test = multivariate_logrank_test(*([life[i] for life in every] for i in (0, 2, 1)))
        own = next(row for row in found["log_rank"]["rows"] if "independent" in row["test"])
        near(own["statistic"], test.test_statistic, f"{which} log-rank", 1e-7)
        near(own["p"], test.p_value, f"{which} log-rank p", 1e-5)


def jackknife(which, group, found, of):
    """The errors of plants against the survival curves without each plant in turn, where they are well known."""
    time, ended, plant = of
    plants = np.unique(plant)
    if len(plants) < 10:
        return
    row = max(
        (row for row in found["survival"]["rows"] if row["group"] == group and 0.3 < row["survival"] < 0.7),
        key=lambda row: row["at_risk"],
        default=None,
    )
    if row is None or row["plant_se"] is None:
        return
    without = []
    for one in plants:
        kept = plant != one
        curve = KaplanMeierFitter().fit(time[kept], ended[kept])
        without.append(curve.survival_function_at_times(row["dimension"]).iloc[0])
    n = len(plants)
    error = np.sqrt((n - 1) / n * np.sum((np.array(without) - np.mean(without)) ** 2))
    near(row["plant_se"], error, f"{which} {group} error of plants", 0.15)


def causes(which):
    found = measure(f"{which}-causes")["causes"]["rows"]
    of = lives(which)
    names = sorted({life[4] for life in of if life[2]})
    numbers = [names.index(life[4]) + 1 if life[2] else 0 for life in of]
    incidence = CumIncidenceRight(np.array([life[1] for life in of], dtype=float), np.array(numbers))
    assert {row["cause"] for row in found} == set(names)
    for row in found:
        shares = incidence.cinc[names.index(row["cause"])]
        place = list(incidence.times).index(row["dimension"])
        near(row["share"], shares[place], f"{which} {row['cause']} at {row['dimension']}")


def means(name, by, sql, sheet):
    """Means of units within plants against a regression with errors clustered by plant."""
    groups = defaultdict(list)
    for group, plant, value in rows(sql):
        groups[str(group)].append((plant, value))
    found = measure(name, *(["--by", by] if by else []))[sheet]["rows"]
    assert {row["group"] for row in found} == set(groups)
    for row in found:
        plant, value = (np.array(of) for of in zip(*groups[row["group"]]))
        near(row["mean"], value.mean(), f"{name} {row['group']}")
        near(row["units"], len(value), f"{name} {row['group']} units")
        if len(np.unique(plant)) < 2 or np.ptp(value) == 0:
            continue
        clustered = sm.OLS(value, np.ones(len(value))).fit(cov_type="cluster", cov_kwds={"groups": plant}, use_t=True)
        low, high = clustered.conf_int()[0]
        near(row["monte_carlo_error"], clustered.bse[0], f"{name} {row['group']} error", 1e-7)
        near(row["low"], low, f"{name} {row['group']} low", 1e-7)
        near(row["high"], high, f"{name} {row['group']} high", 1e-7)
        near(row["design_effect"], clustered.bse[0] ** 2 / (value.var(ddof=1) / len(value)), f"{name} effect", 1e-7)


def sizes():
    of = defaultdict(list)
    for treatment, height, leaf in rows(f"""
            select treatment, height_m, leaf_area_m2 from {table("summary")} where age = {until} and alive
            order by plant_id"""):
        of[treatment].append((height, leaf))
    for row in measure("height", "--by", "treatment")["mean"]["rows"]:
        height = np.array([size[0] for size in of[row["group"]]])
        interval = stats.t.interval(0.95, len(height) - 1, height.mean(), stats.sem(height))
        near(row["mean"], height.mean(), "height")
        near(row["sd"], height.std(ddof=1), "sd of height")
        near(row["low"], interval[0], "height, low")
        near(row["high"], interval[1], "height, high")
    first, second = (np.array([size[0] for size in of[name]]) for name in sorted(of))
    contrasts(first, second)
    components([np.array([size[0] for size in of[name]]) for name in sorted(of)])
    powers(first, second)


def contrasts(first, second):
    for row in measure("contrast", "--of", "height_m")["contrast"]["rows"]:
        near(row["difference"], second.mean() - first.mean(), f"{row['design']} difference")
        if row["design"] == "paired":
            test = stats.ttest_rel(second, first)
        else:
            test = stats.ttest_ind(second, first, equal_var=False)
        near(row["p"], test.pvalue, f"{row['design']} p", 1e-7)
        near(row["low"], test.confidence_interval().low, f"{row['design']} low", 1e-7)
        near(row["high"], test.confidence_interval().high, f"{row['design']} high", 1e-7)


def components(groups):
    row = measure("variance", "--of", "height_m", "--by", "treatment")["variance"]["rows"][0]
    test = stats.f_oneway(*groups)
    near(row["f"], test.statistic, "F", 1e-7)
    near(row["p"], test.pvalue, "p of F", 1e-7)
    near(row["variance_within"], np.mean([group.var(ddof=1) for group in groups]), "variance within", 1e-7)


def powers(first, second):
    wanted = 0.5 * first.std(ddof=1)
    for row in measure("power", "--of", "height_m", "--difference", repr(float(wanted)))["power"]["rows"]:
        solver = TTestPower() if row["design"] == "paired" else TTestIndPower()
        needed = solver.solve_power(effect_size=row["effect"], power=0.8, alpha=0.05)
        near(row["needed"], max(2, np.ceil(needed)), f"plants needed, {row['design']}")
        if row["design"] == "paired":
            near(row["sd"], (second - first).std(ddof=1), "sd of differences")


def living():
    row = measure("living")["living"]["rows"][0]
    plants, alive = rows(f"select count(*), count(*) filter (alive) from {table('summary')} where age = {until}")[0]
    low, high = proportion_confint(alive, plants, method="wilson")
    near(row["share"], alive / plants, "living")
    near(row["low"], low, "living, low")
    near(row["high"], high, "living, high")


def allometry():
    x, y = (np.log(of) for of in zip(*rows(f"""
        select crown_width_m, height_m from {table("summary")} where age = {until} and alive and crown_width_m > 0""")))
    line = stats.linregress(x, y)
    for row in measure("allometry")["allometry"]["rows"]:
        if row["line"] == "least squares":
            near(row["slope"], line.slope, "least squares")
            near(row["se"], line.stderr, "least squares, error", 1e-7)
            near(row["log_intercept"], line.intercept, "least squares, intercept")
        else:
            near(row["slope"], np.sign(line.slope) * y.std() / x.std(), "standardised major axis")
        near(row["r2"], line.rvalue**2, "r2", 1e-7)


def insertions():
    for name, where in [("leaf-insertion", "o.kind = 'leaf'"), ("axis-insertion", "o.kind like '%internode' and o.rank = 1")]:
        cosines = np.array(rows(f"""
            select o.dir_x::double * i.dir_x + o.dir_y::double * i.dir_y + o.dir_z::double * i.dir_z
            from {table("records")} o join {table("records")} i
            on o.plant_id = i.plant_id and o.age = i.age and o.parent_id = i.component_id
            where o.age = {until} and {where} and i.kind like '%internode'"""))[:, 0]
        angles = np.arccos(np.clip(cosines, -1, 1))
        row = measure(name)["angle"]["rows"][0]
        near(row["angles"], len(angles), name)
        near(row["mean"], np.degrees(stats.circmean(angles)), name, 1e-7)
        near(row["circular_sd"], np.degrees(stats.circstd(angles)), f"{name}, deviation", 1e-5)


def divergences():
    """From the azimuths of leaves on upright axes, where the angle about the axis is that about the vertical."""
    row = measure("divergence", "--by", "order")["angle"]["rows"][0]
    assert row["group"] == "1"
    leaves = rows(f"""
        select plant_id, rank, atan2(arg_min(dir_y, component_id), arg_min(dir_x, component_id)) from {table("records")}
        where age = {until} and kind = 'leaf' and "order" = 1 group by all order by plant_id, rank""")
    turns = [b[2] - a[2] for a, b in zip(leaves, leaves[1:]) if a[0] == b[0] and b[1] == a[1] + 1]
    near(row["angles"], len(turns), "divergences")
    near(row["mean"], np.degrees(stats.circmean(turns)), "divergence", 1e-4)


def branching():
    found = measure("branching")["branching"]["rows"]
    internodes = rows(f"""
        select plant_id, component_id, parent_id, "order", rank from {table("components")}
        where kind like '%internode' order by plant_id, component_id desc""")
    counts, streams, children = defaultdict(int), defaultdict(int), defaultdict(list)
    strahler, bearer = {}, {}
    for plant, component, parent, order, rank in internodes:
        counts[order] += rank == 1
        below = sorted(children[plant, component], reverse=True)
        own = 1 if not below else below[0] + (len(below) > 1 and below[1] == below[0])
        strahler[plant, component], bearer[plant, component] = own, (plant, parent)
        children[plant, parent].append(own)
    for component, own in strahler.items():
        streams[own] += strahler.get(bearer[component]) != own
    for row in found:
        order = row["of_order"]
        if row["ratio"].startswith("axes"):
            near(row["value"], counts[order] / counts[order - 1], f"axes of order {order}")
            assert row["low"] is None or row["low"] <= row["value"] <= row["high"], row
        elif row["ratio"].startswith("streams"):
            near(row["count"], streams[order], f"streams of order {order}")
        else:
            orders = sorted(streams)
            slope = stats.linregress(orders, np.log([streams[order] for order in orders])).slope
            near(row["value"], np.exp(-slope), "bifurcation ratio")


def crowns():
    areas, plants = defaultdict(dict), rows(f"""
        select count(distinct plant_id) from {table("records")} where age = {until}""")[0][0]
    lowest = {}
    for plant, z, area in rows(f"""
            select plant_id, z_m::double, area_m2::double from {table("records")}
            where age = {until} and kind in ('leaf', 'leaflet')"""):
        layer = int(np.floor(z / 0.5))
        areas[layer][plant] = areas[layer].get(plant, 0) + area
        lowest[plant] = min(lowest.get(plant, np.inf), z)
    found = measure("crown-profile")["profile"]["rows"]
    assert len(found) == len(areas)
    for row in found:
        values = np.array([*areas[round(row["from"] / 0.5)].values()])
        values = np.concatenate([values, np.zeros(plants - len(values))])
        near(row["leaf_area"], values.mean(), f"leaf area from {row['from']} m", 1e-7)
        near(row["monte_carlo_error"], stats.sem(values), f"its error from {row['from']} m", 1e-7)
    bole = np.array([*lowest.values()])
    row = measure("clear-bole")["clear_bole"]["rows"][0]
    near(row["mean"], bole.mean(), "clear bole", 1e-7)
    near(row["high"], stats.t.interval(0.95, len(bole) - 1, bole.mean(), stats.sem(bole))[1], "clear bole, high", 1e-7)


def effective_leaf_areas():
    """The union of discs by spans of fine lines; the error of a line is that of the disc's edge beside it."""
    leaves = defaultdict(list)
    for plant, *leaf in rows(f"""
            select plant_id, x_m::double + length_m / 2 * dir_x::double, y_m::double + length_m / 2 * dir_y::double,
                z_m::double + length_m / 2 * dir_z::double, sqrt(area_m2::double / pi())
            from {table("records")} where age = {until} and kind in ('leaf', 'leaflet')"""):
        leaves[plant].append(leaf)
    plants = rows(f"select count(distinct plant_id) from {table('records')} where age = {until}")[0][0]
    altitude, azimuth = np.radians(30), np.radians(200)
    light = np.array([np.cos(altitude) * np.sin(azimuth), np.cos(altitude) * np.cos(azimuth), np.sin(altitude)])
    right = np.cross([0, 0, 1], light) / np.cos(altitude)
    for words, across in (((), np.eye(3)[:2]), (("--sun", "30,200"), np.array([right, np.cross(light, right)]))):
        found = 0
        for of in leaves.values():
            of = np.array(of)
            places, radii = of[:, :3] @ across.T, of[:, 3]
            step = np.median(radii) / 100
            for y in np.arange((places[:, 1] - radii).min() + step / 2, (places[:, 1] + radii).max(), step):
                half = np.sqrt(np.maximum(radii**2 - (y - places[:, 1]) ** 2, 0))
                met = half > 0
                begin, end = places[met, 0] - half[met], places[met, 0] + half[met]
                order = np.argsort(begin)
                begin, end = begin[order], np.maximum.accumulate(end[order])
                before = np.concatenate([[-np.inf], end[:-1]])
                found += step * np.maximum(end - np.maximum(begin, before), 0).sum()
        row = measure("effective-leaf-area", *words)["effective_leaf_area"]["rows"][0]
        near(row["mean"], found / plants, f"effective leaf area {' '.join(words)}", 1e-3)


for kind in LIVES:
    survival(kind)
    causes(kind)
means("activity", None, f"""
    select 'all', plant_id, (event = 'grew')::int::double from {table("events")} where event in ('grew', 'paused')""", "activity")
means("nodes-per-axis", "order", f"""
    select "order", plant_id, count(*) filter (kind like '%internode')::double from {table("components")}
    where kind = 'apical_bud' or kind like '%internode' group by "order", plant_id, axis_id""", "nodes")
means("nodes-per-unit", "order", f"""
    select "order", plant_id, count(*)::double from (
        select *, sum((unit_rank = 1)::int) over (partition by plant_id, axis_id order by component_id) as unit
        from {table("components")} where kind like '%internode')
    group by "order", plant_id, axis_id, unit""", "nodes")
sizes()
living()
allometry()
insertions()
divergences()
branching()
crowns()
effective_leaf_areas()
print(f"{run}: {checked} numbers of measures agree with lifelines, statsmodels and scipy")
