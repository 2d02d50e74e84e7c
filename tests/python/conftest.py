"""Where the program and the shared data are, for tests that hold the package against them, and scenes for them all."""

import os
import threading
import time
from pathlib import Path

import fanbeam
import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def program():
    return os.environ["FANBEAM_PROGRAM"]


@pytest.fixture(scope="session")
def root():
    return ROOT


@pytest.fixture(scope="module")
def grass():
    return fanbeam.Scene.open("flat-grass")


@pytest.fixture(scope="module")
def runway():
    return fanbeam.Scene.open("braunschweig-26")


@pytest.fixture
def share_of_all_threads():
    """Processor time of all threads while `work` runs, over that of the thread that asks for it.

    Outside Python's main thread the work is done by the thread that asks for it. On a busy machine threads that
    have nothing to do any more take their time to sleep: the best of three.
    """

    def measured(work):
        ratios = []

        def timed():
            of_all, of_this = time.process_time(), time.thread_time()
            work()
            ratios.append((time.process_time() - of_all) / (time.thread_time() - of_this))

        for _ in range(3):
            thread = threading.Thread(target=timed)
            thread.start()
            thread.join()
        return min(ratios)

    return measured
