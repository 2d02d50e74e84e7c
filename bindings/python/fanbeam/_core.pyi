# What _core holds; users call what the package's own files make of it.
from os import PathLike
from typing import Any

import numpy as np
import numpy.typing as npt

from fanbeam._errors import Problem
from fanbeam._scene import Facts

version: str

class Scene:
    def __init__(
        self,
        scene: str | PathLike[str],
        shipped: str | PathLike[str],
        data: list[Any],
        sensor: str | PathLike[str],
        effects: str,
        caster: str,
        sample: bool | None,
        cscope: bool,
        seed: int,
        threads: int,
        keeps_time_budget: bool,
        warnings: list[Problem],
    ) -> None: ...
    def set_weather(self, changes: dict[str, Any]) -> list[Problem]: ...
    def weather(self) -> dict[str, Any]: ...
    def set_surface(self, state: str) -> list[Problem]: ...
    def set_sensor(
        self,
        tilt_deg: float | None,
        stabilised: bool | None,
        low_dB: float | None,
        high_dB: float | None,
        cscope_mode: str | None,
        noise_figure_dB: float | None,
    ) -> list[Problem]: ...
    def set_targets(self, targets: Any) -> list[Problem]: ...
    def set_sampling(self, kind: str, value: float) -> tuple[list[Problem], str, float]: ...
    def own_budget(self) -> tuple[str, float] | None: ...
    def render(
        self,
        pose: tuple[float, ...],
        frame_index: int,
        bscope: bool,
        cscope: bool,
        layers: bool,
        cscope_layers: bool,
        labels: bool,
    ) -> dict[str, Any]: ...
    def frame_number(self, index: int, expected: str = ...) -> int: ...
    def ground_height_m(self, latitude_deg: float, longitude_deg: float) -> float | None: ...
    def trajectory(self) -> npt.NDArray[np.float64]: ...
    def plan(self) -> list[tuple[str, bool, str, float, float]]: ...
    def facts(self) -> Facts: ...

class Air:
    def __init__(self, weather: dict[str, Any], frequency_Hz: float) -> None: ...
    def one_way_dB_per_km(self, height_m: float) -> dict[str, float]: ...
    def one_way_dB(self, from_height_m: float, to_height_m: float, length_m: float) -> float: ...

def shipped_above(file: str | PathLike[str]) -> PathLike[str]: ...
def shipped_scenes(shipped: str | PathLike[str]) -> list[str]: ...
def shipped_sensors(shipped: str | PathLike[str]) -> list[str]: ...
def checked_setup(
    scene: str | PathLike[str],
    sensor: str | PathLike[str] | None,
    data: str | PathLike[str] | None,
    effects: str,
    caster: str,
    sample: bool | None,
    cscope: bool,
    seed: int,
    threads: int,
    shipped: str | PathLike[str],
) -> dict[str, Any]: ...
def materials(library: str | PathLike[str]) -> list[tuple[str, str, str, str, str]]: ...
def nrcs(
    library: str | PathLike[str],
    material: str,
    grazing_rad: npt.ArrayLike,
    frequency_Hz: float,
    polarisation: str,
    state: str,
    extrapolate: bool,
    warnings: list[Problem],
) -> npt.NDArray[np.float64]: ...
