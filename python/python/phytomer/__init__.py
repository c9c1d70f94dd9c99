"""Grow any plant from seed to death, a million at a time, and query the result like a database.

>>> import phytomer as ph
>>> run = ph.grow("coffee", plants=3, seed=7)
>>> len(run.summary) > 0
True

Lengths are metres, areas m², masses kg; ages and times are ticks of the species. A table is an Arrow stream: pass it to
`polars.DataFrame`, `pyarrow.table`, or name it in the SQL of DuckDB. The verbs of the command line are functions too:
`ph.describe("coffee")`, `ph.fit("nodes.csv", law="nodes")`.
"""

from __future__ import annotations

import os

from . import _phytomer
from ._errors import Fault, LimitReached, ScenarioError, VerbError
from ._phytomer import Mesh, Table, __version__
from ._shown import Page, Picture, Plant, drawn, listed
from ._verbs import (
    animate,
    asystem,
    convert,
    derive,
    describe,
    fit,
    forest,
    init,
    list_shipped,
    measure,
    merge,
    query,
    report,
    run_verb,
    sensitivity,
    shade,
    verify,
    view,
)
from ._verbs import mesh as write_mesh

__all__ = [
    "Fault", "LimitReached", "Mesh", "Page", "Picture", "Plant", "Run", "ScenarioError", "Table", "VerbError", "__version__",
    "animate", "asystem", "convert", "derive", "describe", "fit", "forest", "grow", "init", "list_shipped", "measure",
    "merge", "open", "picture", "query", "report", "run_verb", "schema", "sensitivity", "shade", "validate", "verify",
    "view", "write_mesh",
]  # fmt: skip

# Type checkers take it as true. The modules of types are not imported, since `import phytomer` should take no time.
TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from typing import Any, TypeAlias

    # What is grown: the name of a shipped scenario or species, the path of a file, TOML text, or a dictionary.
    Scenario: TypeAlias = str | os.PathLike[str] | dict[str, Any]
    # Texts that a scenario in memory names, such as its species: TOML, or dictionaries.
    Texts: TypeAlias = dict[str, str | dict[str, Any]]

# `open` of this module opens runs.
_open = open
_IN_MEMORY = "scenario"
_MOST_MB = 4000


def _stated(scenario: Scenario, files: Texts | None) -> tuple[str, list[tuple[str, str]]]:
    """The name and the texts of a scenario."""
    texts = [(name, _toml(text)) for name, text in (files or {}).items()]
    if isinstance(scenario, dict):
        return _IN_MEMORY, [(_IN_MEMORY, _toml(scenario)), *texts]
    name = os.fspath(scenario)
    if ("\n" in name or "=" in name) and not os.path.exists(name):
        return _IN_MEMORY, [(_IN_MEMORY, name), *texts]
    if texts and name not in dict(texts) and os.path.isfile(name):
        with _open(name, encoding="utf-8") as file:
            return _IN_MEMORY, [(_IN_MEMORY, file.read()), *texts]
    return name, texts


def _toml(text: str | dict[str, Any]) -> str:
    if isinstance(text, str):
        return text
    import json

    return _phytomer.toml_of_json(json.dumps(text))


class _Asked:
    """How a run is made; the module reads the attributes."""

    def __init__(self, **asked: Any) -> None:
        self.__dict__.update(asked)


def grow(
    scenario: Scenario,
    *,
    plants: int | None = None,
    seed: int | None = None,
    out: str | os.PathLike[str] | None = None,
    resume: bool = False,
    overwrite: bool = False,
    threads: int = 0,
    max_memory_mb: int = _MOST_MB,
    progress: Callable[[dict[str, Any]], object] | None = None,
    files: Texts | None = None,
) -> Run:
    """Grows the plants of a scenario: in memory, or into the run folder `out`.

    `plants` and `seed` stand in the place of the scenario's; `threads` 0 takes as many as the machine has, and changes
    no result. `max_memory_mb` bounds the tables of a run in memory. `progress` is called about twenty times a second
    with a dictionary: `share` in [0, 1], `seconds`, `plants`, `plants_in_all`, `components`, `components_per_s`,
    `bytes`, `left_s`. `files` are texts that a scenario in memory names.

    The interpreter is released meanwhile, so threads grow side by side. Ctrl-C raises `KeyboardInterrupt`; a run with
    `out` then resumes with `resume=True` and ends with the same bytes.

    Raises `ScenarioError` with every fault, `LimitReached`, `OSError`.

    >>> grow("coffee", plants=3, seed=7).tables
    ['components', 'records', 'events', 'summary', 'plants', 'treatments', 'site']
    """
    name, texts = _stated(scenario, files)
    folder = None if out is None else os.fspath(out)
    asked = _Asked(
        plants=plants,
        seed=seed,
        threads=threads,
        out=folder,
        resume=resume,
        overwrite=overwrite,
        max_memory_mb=max_memory_mb,
        progress=progress,
    )
    try:
        return Run(_phytomer.grow(name, texts, asked))
    except LimitReached as reached:
        if isinstance(reached.run, _phytomer.Run):
            reached.run = Run(reached.run)
        raise


def open(folder: str | os.PathLike[str]) -> Run:
    """The run in a folder, as `phytomer grow` or `grow(out=…)` left it: `ph.open("runs/coffee").summary`.

    Tables are read when they are asked for. Raises `OSError` for a folder that is no run.
    """
    return Run(_phytomer.Run.open(folder))


def validate(scenario: Scenario, *, files: Texts | None = None) -> list[Fault]:
    """Every fault of a scenario or a species; an empty list where it can be grown.

    >>> validate('name = "x"\\nspecies = "coffe"\\nplants = 1\\nages = { until = 12 }')[0].help
    'did you mean `coffee`?'
    """
    return [Fault(**fault) for fault in _phytomer.validate(*_stated(scenario, files))]


def schema(kind: str) -> dict[str, Any]:
    """The JSON Schema of a `species` or a `scenario` file.

    >>> schema("scenario")["type"]
    'object'
    """
    import json

    told: dict[str, Any] = json.loads(_phytomer.schema(kind))
    return told


def picture(
    scenario: Scenario,
    *,
    plant: int | Sequence[int] = 0,
    age: float | Sequence[float] | None = None,
    plot: int | None = None,
    view: str = "perspective",
    size: tuple[int, int] = (1600, 1200),
    turn: float | None = None,
    transparent: bool = False,
    ground: bool = True,
    caption: bool = True,
    sun: tuple[float, float] | None = None,
    files: Texts | None = None,
) -> Picture:
    """Plants of a scenario, a species or a run folder as a picture.

    Each plant is drawn at each age, side by side; an age that is not given is that at which the species shows itself.
    `plot` draws a whole plot at ticks. `view` is perspective, top, front, side or oblique, `turn` and `sun` (azimuth and
    elevation) are degrees, `size` pixels. In a notebook it shows itself; `save` writes a PNG file.

    >>> picture("coffee", age=12, size=(64, 48)).png[:4]
    b'\\x89PNG'
    """
    asked = listed(age)
    plants = _plants_of(scenario, files, max(asked) if asked else None)
    return drawn(
        plants,
        plant=plant,
        age=age,
        plot=plot,
        view=view,
        size=size,
        turn=turn,
        transparent=transparent,
        ground=ground,
        caption=caption,
        sun=sun,
    )


def _plants_of(scenario: Scenario, files: Texts | None, until: float | None) -> _phytomer.Plants:
    if not isinstance(scenario, dict) and files is None and os.path.isfile(os.path.join(os.fspath(scenario), "run.json")):
        return _phytomer.Run.open(scenario).plants
    return _phytomer.Plants.of(*_stated(scenario, files), until)


class Run:
    """A run: its tables as Arrow streams, and its plants.

    >>> import polars
    >>> run = grow("coffee", plants=2, seed=7)
    >>> polars.DataFrame(run.summary).select("plant_id").n_unique()
    2
    """

    def __init__(self, run: _phytomer.Run) -> None:
        self._run = run

    @property
    def name(self) -> str:
        """The name of the run, or its folder."""
        return self._run.name

    @property
    def tables(self) -> list[str]:
        """The names of its tables."""
        return self._run.tables

    @property
    def json(self) -> dict[str, Any]:
        """What `run.json` holds: the scenario as it was grown, its seed, its recorded ages."""
        import json

        told: dict[str, Any] = json.loads(self._run.json())
        return told

    def table(self, name: str) -> Table:
        """A table by its name: `run.table("summary")`. Raises `KeyError` where the run does not have it."""
        return self._run.table(name)

    @property
    def components(self) -> Table:
        """A row per component that ever lived."""
        return self.table("components")

    @property
    def records(self) -> Table:
        """A row per component that stands at a recorded age, with its pose."""
        return self.table("records")

    @property
    def events(self) -> Table:
        """A row per fate of a bud or a branch."""
        return self.table("events")

    @property
    def summary(self) -> Table:
        """A row per plant and recorded age."""
        return self.table("summary")

    @property
    def plants(self) -> Table:
        """A row per plant."""
        return self.table("plants")

    @property
    def treatments(self) -> Table:
        """A row per treatment."""
        return self.table("treatments")

    @property
    def site(self) -> Table:
        """A row per treatment, replicate and recorded age."""
        return self.table("site")

    def plant(self, number: int) -> Plant:
        """A plant by its number, from 0. Raises `IndexError` where the run does not have it."""
        plants = self._run.plants
        if not 0 <= number < len(plants):
            raise IndexError(f"plant {number}: the run has the plants 0 to {len(plants) - 1}")
        return Plant(number, plants)

    def picture(self, **options: Any) -> Picture:
        """Plants of the run as a picture, with the options of `phytomer.picture`: `run.picture(plot=0)`."""
        return drawn(self._run.plants, **options)

    def show(
        self,
        plant: int | Sequence[int] = 0,
        ages: Sequence[float] | None = None,
        *,
        plot: int | None = None,
        height: int = 600,
    ) -> Page:
        """The life of plants as the page of `phytomer view`; in a notebook it shows itself: `run.show(plant=0)`."""
        shown = None if ages is None else list(ages)
        return Page(self._run.plants.page(listed(plant), shown, plot), height)

    def __repr__(self) -> str:
        return f"<phytomer.Run {self.name!r}: {', '.join(self.tables)}>"
