"""The verbs of the program as functions: each runs `python -m phytomer VERB …` and returns what it told on stdout.

Positional arguments are those of the verb. A keyword is an option: `age=48` is `--age 48`, `ages=[6, 12]` is
`--ages 6,12`, `plot=True` is `--plot`, `max_triangles=9` is `--max-triangles 9`; None and False leave it out, and a
dictionary states a constant a word: `D={"lr": 1.2}` is `-D lr=1.2`. `phytomer VERB --help` has all options.
"""

from __future__ import annotations

import os
import sys

from ._errors import Fault, ScenarioError, VerbError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

# Exit codes of the program.
_USAGE, _INVALID, _INTERRUPTED = 2, 3, 130


def _words(options: dict[str, Any]) -> list[str]:
    words: list[str] = []
    for key, value in options.items():
        if value is None or value is False:
            continue
        name = f"-{key}" if len(key) == 1 else "--" + key.replace("_", "-")
        if isinstance(value, dict):
            for word, number in value.items():
                words += [name, f"{word}={number}"]
        elif value is True:
            words.append(name)
        elif isinstance(value, (list, tuple)):
            words += [name, ",".join(str(item) for item in value)]
        else:
            words += [name, str(value)]
    return words


def run_verb(verb: str, *arguments: Any, **options: Any) -> str:
    """Runs a verb and returns its stdout. Raises `VerbError`, `ValueError` for a wrong option, `KeyboardInterrupt`.

    >>> run_verb("list", "woods").splitlines()[0]  # doctest: +SKIP
    """
    import subprocess

    command = [sys.executable, "-m", "phytomer", verb, *(os.fspath(a) if isinstance(a, os.PathLike) else str(a) for a in arguments)]
    done = subprocess.run([*command, *_words(options)], stdin=subprocess.DEVNULL, capture_output=True, check=False)
    out, said = done.stdout.decode("utf-8", "replace"), done.stderr.decode("utf-8", "replace").strip()
    if done.returncode == 0:
        return out
    if done.returncode == _INTERRUPTED or done.returncode < 0:
        raise KeyboardInterrupt(said)
    if done.returncode == _USAGE:
        raise ValueError(said)
    if done.returncode == _INVALID:
        raise ScenarioError(said, _faults(out))
    raise VerbError(said or out.strip(), done.returncode)


def _faults(out: str) -> list[Fault]:
    import json

    try:
        told = json.loads(out)["faults"]
    except (ValueError, KeyError, TypeError):
        return []
    return [_fault(fault) for fault in told]


def _fault(told: dict[str, Any]) -> Fault:
    """A fault as `--json` tells it."""
    suggestion = told["suggestion"]
    help_ = f"did you mean `{suggestion}`?" if suggestion else None
    file, line, column, path = (told[word] for word in ("file", "line", "column", "path"))
    return Fault(file, line, column, path, told["problem"], told["expected"], help_)


def _json(verb: str, *arguments: Any, **options: Any) -> Any:
    import json

    return json.loads(run_verb(verb, *arguments, json=True, **options))


def init(folder: Any, **options: Any) -> str:
    """A species and a scenario to begin with: `init("my_plant")`."""
    return run_verb("init", folder, **options)


def merge(out: Any, *shards: Any, **options: Any) -> str:
    """Folders of shards as one run: `merge("whole", "runs/coffee-shard-1-of-2", "runs/coffee-shard-2-of-2")`."""
    return run_verb("merge", out, *shards, **options)


def derive(system: str, **options: Any) -> str:
    """The string of an L-system: `derive("topiary/4", step=94)`."""
    return run_verb("derive", system, **options)


def convert(source: Any, out: Any, **options: Any) -> str:
    """A tree of another program as a file of this one, or the other way: `convert("my_tree.xml", "my_tree.toml")`."""
    return run_verb("convert", source, out, **options)


def verify(run: Any, **options: Any) -> Any:
    """Whether every file of a run is as it was written: `verify("runs/coffee")`."""
    return _json("verify", run, **options)


def describe(name: Any, **options: Any) -> Any:
    """What a run, a scenario or a species holds: `describe("coffee")["species"]`."""
    return _json("describe", name, **options)


def measure(run: Any, what: str, **options: Any) -> Any:
    """A measure of the plants of a run: `measure("runs/coffee", "bud-life", by="order")`."""
    return _json("measure", run, what, **options)


def list_shipped(*what: str, **options: Any) -> Any:
    """Everything that ships: `list_shipped()`."""
    return _json("list", *what, **options)


def mesh(name: Any, out: Any, **options: Any) -> str:
    """A plant as a mesh file: `mesh("coffee", "coffee.glb", age=36, tolerance="1mm")`."""
    return run_verb("mesh", name, out=out, **options)


def animate(name: Any, out: Any, **options: Any) -> str:
    """A film of its life: `animate("coffee", "life.webp", quiet=True)`."""
    return run_verb("animate", name, out=out, **options)


def view(name: Any, out: Any, **options: Any) -> str:
    """Its life as a page for a browser: `view("coffee", "life.html")`."""
    return run_verb("view", name, out=out, **options)


def fit(data: Any, **options: Any) -> Any:
    """A law fitted to counts, with intervals and rivals: `fit("nodes.csv", law="nodes")`."""
    return _json("fit", data, **options)


def query(*words: Any, **options: Any) -> str:
    """Tables of a run as views for DuckDB: `query("runs/coffee", views=True)`."""
    return run_verb("query", *words, **options)


def forest(site: Any, **options: Any) -> str:
    """A landscape from a raster: `forest("my_site/site.toml", out="landscape")`."""
    return run_verb("forest", site, **options)


def report(*runs: Any, **options: Any) -> str:
    """What became of the plants of runs, as a page with charts: `report("runs/coffee", out="told.html")`."""
    return run_verb("report", *runs, **options)


def sensitivity(name: Any, **options: Any) -> Any:
    """Which numbers of a species matter: `sensitivity("coffee", of="height_m@48")`."""
    return _json("sensitivity", name, **options)


def asystem(script: Any, **options: Any) -> str:
    """Trees by the commands of the A-system: `asystem("my_trees.asys", out="drawn")`."""
    return run_verb("asystem", script, **options)


def shade(site: Any, **options: Any) -> str:
    """Hours of shade on the zones of a plan, month by month: `shade("my_court/site.toml")`."""
    return run_verb("shade", site, **options)
