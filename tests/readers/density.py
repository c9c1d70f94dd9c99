"""The reciprocal law of yield and density, fitted twice: density.py PAGE.md RUN [FAN FIGURE.svg]

RUN is a run of `coffee_density`. The first SQL block of PAGE fits 1/w = A + B rho by DuckDB over the views of RUN. Here
the stands are made of the Parquet files by pyarrow, and the law is fitted by the normal equations. Stands of one replicate
share their draws at all densities: the error of B and the lack of fit (Draper & Smith 1998, Applied Regression Analysis,
section 2.1) are those within replicates.
With FAN, a run of `coffee_fan`, the means of its arcs are told as well, and both are drawn.
"""

import os
import re
import sys
from pathlib import Path

import duckdb
import numpy as np
import pyarrow.parquet as parquet
from scipy import stats

page, run = Path(sys.argv[1]), Path(sys.argv[2])


def trees(folder):
    """Of each tree that is no guard: nitrogen, ground, stand, and the clusters of berries that it has set."""
    plants = parquet.read_table(folder / "plants").to_pandas()
    if "guard" in plants:
        plants = plants[~plants["guard"].astype(bool)]
    parts = parquet.read_table(folder / "components", columns=["plant_id", "kind"]).to_pandas()
    berries = parts[parts["kind"] == "fruit"].groupby("plant_id").size()
    plants["w"] = plants["plant_id"].map(berries).fillna(0).astype(float)
    plants["rho"] = 1e4 / plants["ground_area_m2"]
    plants["nitrogen"] = plants["treatment"].astype(str).str.extract(r"(\d+) kg")[0].astype(int)
    return plants


def fit(rho, y):
    """A, B and their standard errors, and the standard deviation of what is left over."""
    x = np.column_stack([np.ones(len(rho)), rho])
    inverse = np.linalg.inv(x.T @ x)
    estimate = inverse @ x.T @ y
    left = y - x @ estimate
    s = np.sqrt(left @ left / (len(y) - 2))
    return estimate, s * np.sqrt(np.diag(inverse)), s


def paired(rho, y, replicate):
    """B, its standard error, and the probability of such a lack of fit, where stands of one replicate share their draws."""
    blocks = (replicate[:, None] == np.unique(replicate)).astype(float)
    levels = (rho[:, None] == np.unique(rho)[1:]).astype(float)

    def left(of):
        x = np.column_stack([blocks, of])
        estimate, *_ = np.linalg.lstsq(x, y, rcond=None)
        return estimate[-1], ((y - x @ estimate) ** 2).sum(), x

    b, straight, x = left(rho / 1e4)
    _, pure, each = left(levels)
    df, pure_df = len(y) - x.shape[1], len(y) - each.shape[1]
    error = np.sqrt(straight / df * np.linalg.inv(x.T @ x)[-1, -1])
    p = stats.f.sf((straight - pure) / (df - pure_df) / (pure / pure_df), df - pure_df, pure_df)
    return b / 1e4, error / 1e4, p


all_trees = trees(run)
con = duckdb.connect()
views = (run / "views.sql").read_text(encoding="utf-8")
sql = re.search(r"```sql\n(.*?)```", page.read_text(encoding="utf-8"), re.S).group(1)
figure = Path(sys.argv[4]).resolve() if len(sys.argv) > 4 else None
fan = trees(Path(sys.argv[3])) if figure else None
os.chdir(run)
con.execute(views)
by_sql = {int(row[0].split()[0]): row[1:] for row in con.sql(sql).fetchall()}
assert sorted(by_sql) == [0, 60, 120], by_sql

for nitrogen, of in all_trees.groupby("nitrogen"):
    stands = of.groupby(["rho", "replicate"])["w"].mean().reset_index()
    rho, y = np.round(stands["rho"].to_numpy()), 1.0 / stands["w"].to_numpy()
    exact = stands["rho"].to_numpy()
    (a, b), (a_error, b_error), s = fit(exact, y)
    assert np.allclose(by_sql[nitrogen][:3], [a, b, s], rtol=1e-9), (by_sql[nitrogen], a, b, s)
    assert a > 4 * a_error, (nitrogen, a, a_error)
    of_pairs, pair_error, p = paired(rho, y, stands["replicate"].to_numpy())
    assert abs(of_pairs / b - 1) < 1e-3 and b > 4 * pair_error, (nitrogen, b, of_pairs, pair_error)
    print(f"{nitrogen} kg: A = {a:.6f} ± {a_error:.6f}, B = {b:.3e} ± {b_error:.1e}, of pairs ± {pair_error:.1e}, lack of fit p = {p:.2g}")
    for level in np.unique(rho):
        found, line = y[rho == level].mean(), a + b * level
        print(f"  {level:6.0f} a ha: w = {1 / found:6.1f}, by the law {1 / line:6.1f}, 1/w off by {found / line - 1:+.1%}")
        # The page says 3 %.
        assert abs(found / line - 1) < 0.03, (nitrogen, level, found, line)

if figure:
    import matplotlib

    matplotlib.use("svg")
    matplotlib.rcParams.update({"svg.hashsalt": "density", "font.size": 10})
    import matplotlib.pyplot as plt

    picture, axes = plt.subplots(1, 2, figsize=(9, 3.8), constrained_layout=True)
    for nitrogen, colour in [(0, "#b5651d"), (60, "#2f80b5"), (120, "#1b5e20")]:
        of = all_trees[all_trees["nitrogen"] == nitrogen]
        stands = of.groupby(["rho", "replicate"])["w"].mean().reset_index()
        rho, w = stands["rho"].to_numpy(), stands["w"].to_numpy()
        (a, b), _, _ = fit(rho, 1 / w)
        line = np.linspace(500, 10500, 100)
        arcs = fan[fan["nitrogen"] == nitrogen].groupby(fan["rho"].round())["w"].mean()
        axes[0].plot(rho, 1 / w, "o", color=colour, ms=4, label=f"{nitrogen} kg N/ha")
        axes[0].plot(arcs.index, 1 / arcs, "x", color=colour)
        axes[0].plot(line, a + b * line, "-", color=colour, lw=1)
        axes[1].plot(rho, w * rho / 1e3, "o", color=colour, ms=4)
        axes[1].plot(arcs.index, arcs * arcs.index / 1e3, "x", color=colour)
        axes[1].plot(line, line / (a + b * line) / 1e3, "-", color=colour, lw=1)
        for density, mean in arcs.items():
            print(f"fan, {nitrogen} kg: {density:.0f} a ha, {mean:.1f}")
    axes[0].plot([], [], "x", color="#555555", label="an arc of the fan")
    axes[0].set(xlabel="trees a hectare", ylabel="1/w (w: clusters of berries a tree)", ylim=(0, None))
    axes[1].set(xlabel="trees a hectare", ylabel="clusters of berries a hectare, thousands", ylim=(0, None))
    axes[0].legend(frameon=False)
    for ax in axes:
        ax.spines[["top", "right"]].set_visible(False)
    picture.savefig(figure, metadata={"Date": None})
