"""What there is: shipped scenes, sensors and materials, and the air."""

from __future__ import annotations

import copy
import os
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from fanbeam import _core, _paths
from fanbeam._errors import refuse_type, warn


def scenes() -> list[str]:
    """Names of the scenes that ship with fanbeam, as Scene.open takes them."""
    return _core.shipped_scenes(_paths.shipped())


def sensors() -> list[str]:
    """Names of the sensors that ship with fanbeam, as Scene.open takes them."""
    return _core.shipped_sensors(_paths.shipped())


class Material(NamedTuple):
    """A surface of the library: `confidence` is "seen", "fitted", "recalled" or "assumed"."""

    name: str
    model: str
    confidence: str
    source: str
    note: str


def _library(library: str | os.PathLike[str] | None) -> str | os.PathLike[str]:
    return _paths.shipped() / "materials" / "library.toml" if library is None else library


def materials(library: str | os.PathLike[str] | None = None) -> list[Material]:
    """The materials of a library file, in its order; of the shipped one unless told otherwise."""
    return [Material(*row) for row in _core.materials(_library(library))]


def nrcs(
    material: str,
    grazing_rad: npt.ArrayLike,
    *,
    frequency_Hz: float = 35e9,
    polarisation: str = "HH",
    state: str = "dry",
    extrapolate: bool = False,
    library: str | os.PathLike[str] | None = None,
) -> npt.NDArray[np.float64]:
    """Normalised radar cross section sigma0, linear, of a material at grazing angles 0 to pi/2.

    Angles up to 1e-6 above pi/2, as single precision has them, count as pi/2.
    `polarisation` is "HH" or "VV", `state` what the weather left: "dry", "wet", "dry-snow" or
    "wet-snow". A frequency or polarisation that the material's model is not known for is refused
    unless `extrapolate`. The shape is that of `grazing_rad`, which has no mask.
    """
    if isinstance(grazing_rad, np.ma.MaskedArray):  # what the mask hides would be looked up, or refused
        refuse_type("grazing_rad", "a number or an array of numbers without a mask", grazing_rad)
    told: list[Any] = []
    values = _core.nrcs(
        _library(library), material, grazing_rad, frequency_Hz, polarisation, state, extrapolate, told
    )
    warn(told)
    return values


class Atmosphere:
    """Loss along straight paths through layered air: gases (ITU-R P.676), fog (P.840), rain (P.838), snow.

    Weather as in Scene.set_weather; without any, a standard day. Heights are above the ground that the
    weather is told for, -2000 to 12000 m: that far the air is known. Losses are one way. It pickles.
    """

    def __init__(self, frequency_Hz: float = 35e9, **weather: float | bool | None):
        self._air = _core.Air(weather, frequency_Hz)
        self._told = copy.deepcopy((frequency_Hz, weather))  # what passed can be copied

    def __getstate__(self) -> tuple[float, dict[str, float | bool | None]]:
        return self._told

    def __setstate__(self, told: tuple[float, dict[str, float | bool | None]]) -> None:
        frequency_Hz, weather = told
        self.__init__(frequency_Hz, **weather)  # type: ignore[misc]

    def one_way_dB_per_km(self, height_m: float = 0.0) -> dict[str, float]:
        """Specific attenuation at a height by cause: "gas", "fog", "rain", "snow"."""
        return self._air.one_way_dB_per_km(height_m)

    def one_way_dB(self, from_height_m: float, to_height_m: float, length_m: float) -> float:
        """Loss of a straight path of `length_m`, at least what the two heights are apart, between them."""
        return self._air.one_way_dB(from_height_m, to_height_m, length_m)
