"""How bad input is told."""

from __future__ import annotations

import warnings
from typing import Any, NamedTuple, NoReturn


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


def _shown(value: object) -> str:
    # Integers above 4300 digits have no text, and users' own objects may have a broken one.
    try:
        return repr(value)
    except Exception:
        if isinstance(value, int):
            return f"a whole number of {value.bit_length()} bits"
        return f"one of type {type(value).__name__}"


def refuse_type(field: str, expected: str, value: object) -> NoReturn:
    """As the extension modules tell it."""
    raise TypeError(f"{field}: expected {expected}, not {_shown(value)}")


def items_of(told: Any, field: str, expected: str) -> list[Any]:
    """Of an iterable; a text is one of letters, and never meant."""
    if not isinstance(told, (str, bytes)):
        try:
            items = iter(told)
        except TypeError:  # arrays without dimensions have __iter__ too
            pass
        else:
            return list(items)
    refuse_type(field, expected, told)
