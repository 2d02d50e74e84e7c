"""The package as a whole: its tour, and its type hints by a judge that is not ours."""

import os
import subprocess
import sys
from pathlib import Path

import fanbeam
import pytest

PACKAGE = Path(fanbeam.__file__).parent


def test_the_tour_runs_and_draws(root, tmp_path):
    tour = root / "bindings" / "python" / "examples" / "tour.py"
    told = subprocess.run([sys.executable, tour, tmp_path], capture_output=True, text=True, check=True, timeout=300)
    assert "the car: " in told.stdout and "frame 1200" in told.stdout
    for name in ("frame.png", "rain.png"):
        assert (tmp_path / name).stat().st_size > 10_000


def test_labels_can_be_drawn(root, tmp_path):
    script = root / "bindings" / "python" / "examples" / "show_labels.py"
    subprocess.run([sys.executable, script, "braunschweig-26", "950", tmp_path / "labels.png"], check=True, timeout=300)
    assert (tmp_path / "labels.png").stat().st_size > 30_000


def test_type_hints_hold():
    checked = subprocess.run(
        ["mypy", "--strict", "--cache-dir", os.devnull, "-p", "fanbeam"], cwd=PACKAGE.parent, capture_output=True, text=True
    )
    assert checked.returncode == 0, checked.stdout


@pytest.mark.parametrize("name", fanbeam.__all__)
def test_everything_public_is_documented(name):
    if name == "__version__":
        return
    thing = getattr(fanbeam, name)
    assert thing.__doc__ and not thing.__doc__.startswith("dict(")
    if isinstance(thing, type):
        for member, value in vars(thing).items():
            if not member.startswith("_") and (isinstance(value, (property, classmethod)) or callable(value)):
                assert value.__doc__, f"{name}.{member}"
