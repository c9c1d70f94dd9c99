"""The exceptions of the package. Files that cannot be read or written are `OSError`."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from . import Run


class Fault:
    """One fault of a scenario or a species."""

    file: str | None
    """The file, `preset:name`, or the name of the text."""
    line: int | None
    """Line, from 1."""
    column: int | None
    """Column, from 1, in characters."""
    path: str
    """The value in the file's tree, such as `order[1].death`."""
    text: str
    """What is wrong."""
    expected: str
    """What was expected."""
    help: str | None
    """The nearest spelling, where there is one."""

    def __init__(
        self,
        file: str | None,
        line: int | None,
        column: int | None,
        path: str,
        text: str,
        expected: str,
        help: str | None,
    ) -> None:
        self.file, self.line, self.column = file, line, column
        self.path, self.text, self.expected, self.help = path, text, expected, help

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Fault) and vars(self) == vars(other)

    def __hash__(self) -> int:
        return hash(tuple(vars(self).values()))

    def __repr__(self) -> str:
        return f"Fault({', '.join(f'{key}={value!r}' for key, value in vars(self).items())})"


class ScenarioError(ValueError):
    """A scenario or a species is wrong. `faults` has each fault; the text shows them with their lines."""

    faults: list[Fault]

    def __init__(self, text: str, faults: list[Any]) -> None:
        super().__init__(text)
        self.faults = [fault if isinstance(fault, Fault) else Fault(**fault) for fault in faults]


class LimitReached(RuntimeError):
    """A plot came to its limit of components, or tables in memory to theirs.

    `run` has what has grown where a plot came to its limit: the other plots are whole. It is None where the tables
    outgrew their memory.
    """

    run: Run | None

    def __init__(self, text: str, run: Any = None) -> None:
        super().__init__(text)
        self.run = run


class VerbError(RuntimeError):
    """A verb failed; the text is what it told on stderr, and `code` its exit code."""

    code: int

    def __init__(self, text: str, code: int) -> None:
        super().__init__(text)
        self.code = code
