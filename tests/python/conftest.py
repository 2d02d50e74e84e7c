"""Where the program and the shared data are, for tests that hold the package against them."""

import os
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def program():
    return os.environ["FANBEAM_PROGRAM"]


@pytest.fixture(scope="session")
def root():
    return ROOT
