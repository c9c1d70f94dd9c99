"""All mixtures of two laws of nodes by a plain SciPy script: mixtures.py COUNTS.csv

The same job as `phytomer_fits::nodes::fit_all` does for its mixtures, as one would write it with NumPy and SciPy: EM from seven
beginnings, the best two to the end, the n of a binomial part over all whole numbers at once, the r of a negative binomial by
`minimize_scalar`, at last BFGS over what is not whole. No errors, no intervals, no profile of n. COUNTS.csv has the columns
dataset, n_nodes and count. Prints a line for each data set and pair, with ln L, and at the end the seconds of processor time without
reading.
"""

import csv
import sys
import time

import numpy as np
from scipy.optimize import minimize, minimize_scalar
from scipy.special import expit, gammaln, logit, xlog1py, xlogy

PAIRS = ["PP", "PB", "BP", "PN", "BB", "BN", "NB"]
BEGINNINGS = [0.05, 0.15, 0.3, 0.5, 0.7, 0.85, 0.95]
MOST_TRIALS = 200


def poisson(k, mean):
    return xlogy(k, mean) - mean - gammaln(k + 1)


def binomial(k, n, p):
    inside = k <= n
    safe = np.where(inside, k, 0)
    mass = gammaln(n + 1) - gammaln(safe + 1) - gammaln(n - safe + 1) + xlogy(safe, p) + xlog1py(n - safe, -p)
    return np.where(inside, mass, -np.inf)


def negative_binomial(k, r, p):
    return gammaln(r + k) - gammaln(r) - gammaln(k + 1) + r * np.log(p) + xlog1py(k, -p)


LOG_MASS = {"P": poisson, "B": binomial, "N": negative_binomial}


def part(family, k, weights):
    """The largest likelihood of a family from weighted counts; None where it has none."""
    total = weights.sum()
    mean = (weights * k).sum() / total
    if not mean > 0:
        return None
    if family == "P":
        return (mean,)
    if family == "B":
        largest = k[weights > 1e-4].max()
        kept, shares = k[: largest + 1], weights[: largest + 1]
        n = np.arange(max(largest, int(mean) + 1), MOST_TRIALS + 1)[:, None]
        if len(n) == 0:
            return None
        best = n[np.argmax((shares * binomial(kept, n, mean / n)).sum(axis=1)), 0]
        return (best, mean / best) if mean / best < 1 - 1e-9 else None
    variance = (weights * (k - mean) ** 2).sum() / total
    if variance <= mean * 1.0001:
        return None
    start = np.log(mean * mean / (variance - mean))
    loss = lambda ln_r: -(weights * negative_binomial(k, np.exp(ln_r), np.exp(ln_r) / (np.exp(ln_r) + mean))).sum()
    r = np.exp(minimize_scalar(loss, bracket=(start, start + 0.2), tol=1e-6).x)
    return (r, r / (r + mean))


def masses(pair, law, k):
    weight, first, second = law
    return weight * np.exp(LOG_MASS[pair[0]](k, *first)), (1 - weight) * np.exp(LOG_MASS[pair[1]](k, *second))


def climb(pair, k, counts, shares, steps, least):
    """EM until a step gains less than `least`."""
    last = None
    for _ in range(steps):
        first = counts * shares
        weight = first.sum() / counts.sum()
        if not 1e-4 <= weight <= 1 - 1e-4:
            return last
        parts = part(pair[0], k, first), part(pair[1], k, counts - first)
        if None in parts:
            return last
        law = (weight, *parts)
        a, b = masses(pair, law, k)
        value = xlogy(counts, a + b).sum()
        if not np.isfinite(value):
            return last
        gain = np.inf if last is None else value - last[0]
        last = (value, law)
        if gain < least:
            break
        shares = np.where(a + b > 0, a / np.maximum(a + b, 1e-300), 0.5)
    return last


def inwards(pair, law):
    x = [logit(law[0])]
    for family, values in zip(pair, law[1:]):
        x += {"P": lambda: [np.log(values[0])], "B": lambda: [logit(values[1])], "N": lambda: [np.log(values[0]), logit(values[1])]}[family]()
    return np.array(x)


def outwards(pair, law, x):
    found, x = [expit(x[0])], list(x[1:])
    for family, values in zip(pair, law[1:]):
        if family == "P":
            found.append((np.exp(x.pop(0)),))
        elif family == "B":
            found.append((values[0], expit(x.pop(0))))
        else:
            found.append((np.exp(x.pop(0)), expit(x.pop(0))))
    return tuple(found)


def mixture(pair, k, counts):
    """The largest ln L of a pair, and its law."""
    below = np.cumsum(counts)
    begun = []
    for cut in BEGINNINGS:
        place = np.searchsorted(below, cut * counts.sum())
        found = climb(pair, k, counts, np.where(k <= place, 0.9, 0.1), 40, 1e-4)
        if found:
            begun.append(found)
    ended = []
    for _, law in sorted(begun, key=lambda found: -found[0])[:2]:
        a, b = masses(pair, law, k)
        shares = np.where(a + b > 0, a / np.maximum(a + b, 1e-300), 0.5)
        found = climb(pair, k, counts, shares, 1000, 1e-6)
        if found:
            ended.append(found)
    if not ended:
        return None
    value, law = max(ended, key=lambda found: found[0])

    def loss(x):
        with np.errstate(all="ignore"):
            found = -xlogy(counts, sum(masses(pair, outwards(pair, law, x), k))).sum()
        return found if np.isfinite(found) else 1e10

    top = minimize(loss, inwards(pair, law), method="BFGS")
    return (-top.fun, outwards(pair, law, top.x)) if -top.fun > value else (value, law)


def read(path):
    tables = {}
    with open(path, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            tables.setdefault(row["dataset"], {})[int(row["n_nodes"])] = float(row["count"])
    for name, table in tables.items():
        last = max(nodes for nodes, count in table.items() if count > 0)
        yield name, np.array([table.get(nodes, 0.0) for nodes in range(last + 1)])


tables = list(read(sys.argv[1]))
begun = time.process_time()
told = []
for name, counts in tables:
    k = np.arange(len(counts))
    for pair in PAIRS:
        found = mixture(pair, k, counts)
        told.append((name, pair, found[0] if found else float("nan")))
seconds = time.process_time() - begun
for name, pair, value in told:
    print(name, pair, f"{value:.6f}")
print("seconds", seconds)
