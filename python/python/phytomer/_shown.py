"""What is shown: plants that grow again from their seeds, their pictures, and the pages of their lives."""

from __future__ import annotations

import os

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence
    from typing import Any

    from . import _phytomer
    from ._phytomer import Mesh


class Picture:
    """A PNG picture that shows itself in a notebook."""

    png: bytes
    """The bytes of the file."""

    def __init__(self, png: bytes) -> None:
        self.png = png

    def __repr__(self) -> str:
        return f"<phytomer.Picture: {len(self.png)} bytes>"

    def _repr_png_(self) -> bytes:
        return self.png

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the PNG file."""
        with open(path, "wb") as file:
            file.write(self.png)


class Page:
    """A page of HTML that shows the life of plants; it shows itself in a notebook and needs no network."""

    html: str
    """The page."""
    height: int
    """The height in a notebook, pixels."""

    def __init__(self, html: str, height: int = 600) -> None:
        self.html = html
        self.height = height

    def __repr__(self) -> str:
        return f"<phytomer.Page: {len(self.html)} characters>"

    def _repr_html_(self) -> str:
        from html import escape

        return f'<iframe srcdoc="{escape(self.html)}" style="width:100%;height:{self.height}px;border:0"></iframe>'

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the HTML file."""
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.html)


class Plant:
    """A plant of a run, which grows again from its seed when it is drawn."""

    number: int
    """Its number in the run."""

    def __init__(self, number: int, plants: _phytomer.Plants) -> None:
        self.number = number
        self._plants = plants

    def __repr__(self) -> str:
        return f"<phytomer.Plant {self.number}>"

    def mesh(self, age: float | None = None, *, sides: int = 8, tolerance_m: float | None = None) -> Mesh:
        """Its mesh at an age, the last of the run if not given: `points`, `faces` and `attributes` as numpy arrays.

        Points are metres from its foot, Z up. `tolerance_m` simplifies its wood within this distance.

        >>> import phytomer as ph
        >>> ph.grow("coffee", plants=1).plant(0).mesh(age=12).points.shape[1]
        3
        """
        return self._plants.mesh(self.number, age, sides, tolerance_m)

    def picture(self, age: float | Sequence[float] | None = None, **options: Any) -> Picture:
        """Its picture, with the options of `phytomer.picture`: `run.plant(0).picture(age=48)`."""
        return drawn(self._plants, plant=self.number, age=age, **options)


def listed(numbers: Any) -> list[Any]:
    """One number or several, as a list; an empty one for none."""
    if numbers is None:
        return []
    return list(numbers) if hasattr(numbers, "__iter__") else [numbers]


def drawn(
    plants: _phytomer.Plants,
    *,
    plant: Any = 0,
    age: Any = None,
    plot: int | None = None,
    view: str = "perspective",
    size: tuple[int, int] = (1600, 1200),
    turn: float | None = None,
    transparent: bool = False,
    ground: bool = True,
    caption: bool = True,
    sun: tuple[float, float] | None = None,
) -> Picture:
    """Plants as a picture, with the options of `phytomer.picture`."""
    return Picture(
        plants.picture(listed(plant), listed(age), plot, view, size, turn, transparent, ground, caption, sun)
    )
