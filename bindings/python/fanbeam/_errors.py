"""How bad input is told."""

from __future__ import annotations

import warnings
from typing import NamedTuple


class Problem(NamedTuple):
    """One thing wrong (code "E-...") or odd ("W-...") in an input; its text is one line."""

    code: str
    file: str  # "" where no file is to blame
    line: int  # 0 where there is none
    column: int
    field: str
    value: str  # as found
    expected: str
    text: str

    def __str__(self) -> str:
        return self.text


class InputError(ValueError):
    """Input that was refused: nothing has changed. `problems` holds every Problem, warnings too."""

    def __init__(self, problems: list[Problem]):
        super().__init__(problems)
        self.problems = list(problems)

    def __str__(self) -> str:
        return "\n".join(problem.text for problem in self.problems)


class FanbeamWarning(UserWarning):
    """Input that was taken, but looks odd."""


def warn(problems: list[Problem]) -> None:
    """For functions that users call themselves: the warning shows their line."""
    for problem in problems:
        warnings.warn(problem.text, FanbeamWarning, stacklevel=3)
