"""Where files lie: what ships with fanbeam, and data."""

from __future__ import annotations

import functools
import os
from pathlib import Path

from fanbeam import _core


@functools.cache
def shipped() -> Path:
    return Path(_core.shipped_above(Path(__file__).resolve()))


def data_folders(first: str | os.PathLike[str] | None) -> list[Path]:
    """`first`, then what FANBEAM_DATA names, then shared/data beside a source tree.

    All absolute: a pickled scene may be opened from another folder.
    """
    folders = [Path(os.fsdecode(first)).absolute()] if first is not None else []
    if named := os.environ.get("FANBEAM_DATA"):
        folders.append(Path(named).absolute())
    beside = shipped().parent / "shared" / "data"
    if beside.is_dir():
        folders.append(beside)
    return folders
