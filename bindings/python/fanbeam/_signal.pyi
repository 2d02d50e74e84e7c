# What _signal holds; users call fanbeam.signal.
from typing import Any

from fanbeam._core import Scene

def frame(scene: Scene, index: int, products: list[str] | None, told: dict[str, Any]) -> dict[str, Any]: ...
def waveform(kind: str, numbers: dict[str, float], real: bool, down_first: bool) -> str: ...
