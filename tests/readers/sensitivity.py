"""Designs and estimators of sensitivities against the formulas of SALib 1.5, read here with numpy alone: sensitivity.py FILE

FILE has designs, results and estimates as JSON. The model, the structure of the designs and the estimators are worked out
anew: Morris after SALib.analyze.morris (mu_star, sigma), Sobol' after SALib.analyze.sobol (Saltelli et al. 2010 and Jansen).
"""

import json
import sys

import numpy as np

with open(sys.argv[1], encoding="utf-8") as text:
    told = json.load(text)


def ishigami(at):
    x, y, z = (np.pi * (2 * at[:, k] - 1) for k in range(3))
    return np.sin(x) + 7 * np.sin(y) ** 2 + 0.1 * z**4 * np.sin(x)


factors = told["factors"]

# Morris: ways of factors + 1 points; each step moves one factor by 2/3 on a grid of four levels.
at, results = np.array(told["morris"]["at"]), np.array(told["morris"]["results"])
assert np.allclose(results, ishigami(at), rtol=1e-12)
ways, values = at.reshape(-1, factors + 1, factors), results.reshape(-1, factors + 1)
assert np.allclose(at * 3, np.round(at * 3)), "levels 0, 1/3, 2/3 and 1"
steps = np.diff(ways, axis=1)
assert np.all((np.abs(steps) > 1e-12).sum(axis=2) == 1), "one factor a step"
moved = np.abs(steps).argmax(axis=2)
assert all(sorted(way) == list(range(factors)) for way in moved), "each factor once a way"
size = np.take_along_axis(steps, moved[:, :, None], axis=2)[:, :, 0]
assert np.allclose(np.abs(size), 2 / 3)
effects = np.diff(values, axis=1) / size
for factor, found in enumerate(told["morris"]["effects"]):
    own = effects[moved == factor]
    assert np.isclose(found["size"], np.abs(own).mean(), rtol=1e-10), factor
    assert np.isclose(found["spread"], own.std(ddof=1), rtol=1e-10), factor
    # SALib's interval of mu_star: 1.96 deviations of resampled means.
    draws = np.random.default_rng(1).choice(np.abs(own), (2000, own.size)).mean(axis=1)
    low, high = found["size_within"]
    assert abs((high - low) / 2 - 1.96 * draws.std(ddof=1)) < 0.35 * (high - low) + 1e-9, (factor, low, high)

# Sobol': blocks A, B, A again, and A with each column of B.
at, results = np.array(told["sobol"]["at"]), np.array(told["sobol"]["results"])
assert np.allclose(results, ishigami(at), rtol=1e-12)
at = at.reshape(-1, factors + 3, factors)
a, b = at[:, 0], at[:, 1]
assert np.array_equal(at[:, 2], a)
for factor in range(factors):
    mixed = a.copy()
    mixed[:, factor] = b[:, factor]
    assert np.array_equal(at[:, 3 + factor], mixed), factor
# Points of a scrambled sequence: each half, quarter, … of each axis has as many.
for column in np.concatenate([a, b], axis=1).T:
    counts = np.histogram(column, bins=64, range=(0, 1))[0]
    assert np.all(counts == a.shape[0] / 64), counts
y = results.reshape(-1, factors + 3)
ya, yb, mixed = y[:, 0], y[:, 1], y[:, 3:]
variance = np.var(np.r_[ya, yb])
for factor, found in enumerate(told["sobol"]["indices"]):
    total = 0.5 * np.mean((ya - mixed[:, factor]) ** 2) / variance
    first = np.mean((yb - yb.mean()) * (mixed[:, factor] - ya)) / variance
    # SALib takes the mean of all results away, which changes the estimate within its error alone.
    salib = np.mean((yb - y.mean()) * (mixed[:, factor] - ya)) / variance
    assert np.isclose(found["total"], total, rtol=1e-10), factor
    assert np.isclose(found["first"], first, rtol=1e-9, atol=1e-12), factor
    assert abs(found["first"] - salib) < 0.005, (factor, found["first"], salib)
    rows = np.random.default_rng(2).integers(0, ya.size, (1000, ya.size))
    totals = 0.5 * np.mean((ya[rows] - mixed[:, factor][rows]) ** 2, axis=1) / variance
    low, high = found["total_within"]
    assert abs((high - low) / 2 - 1.96 * totals.std(ddof=1)) < 0.35 * (high - low) + 1e-9, (factor, low, high)
assert abs(told["sobol"]["noise"]) < 1e-12
print("sensitivity: designs, effects and indices agree")
