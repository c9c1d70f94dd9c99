"""The slope of self-thinning of a run: thinning.py RUN AREA_M2 SHARE

Reads `summary` with pyarrow alone. Of each tick from the fourth on at which at most SHARE of the plants live, the mean
wood of the living and their density; prints the number of ticks, the slope of the standardised major axis of their
logarithms, the ends of its 95 % interval (Warton et al. 2006, Table 2), and r2.
"""

import sys
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
from scipy.stats import f

run, area, share = Path(sys.argv[1]), float(sys.argv[2]), float(sys.argv[3])
table = pq.read_table(run / "summary", columns=["plant_id", "tick", "alive", "wood_volume_m3"]).to_pandas()
plants = table["plant_id"].nunique()
living = table[table["alive"].astype(bool) & (table["tick"] > 3)]
years = living.groupby("tick")["wood_volume_m3"].agg(["size", "mean"])
years = years[years["size"] <= share * plants]
x, y = np.log(years["size"] / area), np.log(years["mean"])
n, r = len(x), np.corrcoef(x, y)[0, 1]
slope = np.sign(r) * np.std(y, ddof=1) / np.std(x, ddof=1)
b = (1 - r**2) / (n - 2) * f.ppf(0.95, 1, n - 2)
ends = sorted([slope * (np.sqrt(b + 1) - np.sqrt(b)), slope * (np.sqrt(b + 1) + np.sqrt(b))])
print(n, repr(float(slope)), repr(float(ends[0])), repr(float(ends[1])), repr(float(r**2)))
