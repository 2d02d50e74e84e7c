"""The signal level: beat signals, radar cube, maps and detections of a scene's frame.

Loads FFTW, which is GPL: a program that ships with this module is under the GPL as a whole; the rest of
fanbeam is not. Values of cubes are complex amplitudes whose square is a power in watts at a receiver's
port. docs/fmcw.md tells what is modelled.

    import fanbeam.signal
    road = fanbeam.Scene.open("highway-76ghz")
    seen = fanbeam.signal.frame(road, 0, want=("beat", "detections"))
    seen.beats[0].shape                     # (channels, chirps, samples)
    seen.detections["range_m"]
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from fanbeam import _signal
from fanbeam._errors import items_of, refuse_type, warn
from fanbeam._scene import Scene

__all__ = ["SignalFrame", "frame", "waveform"]

Values = npt.NDArray[np.float64]
Cube = npt.NDArray[np.complex64]

_DETECTION = np.dtype(
    [(name, float) for name in ("range_m", "radial_speed_mps", "azimuth_rad", "elevation_rad", "power_W", "snr")]
    + [("cluster", int)]
)


@dataclass(eq=False)
class SignalFrame:
    """What one frame of the receiving chain holds; what was not asked for is None."""

    beats: list[Cube]  # of every stage of the waveform, [channel, chirp, sample]
    cube: Cube | None  # [azimuth, speed, range]
    range_doppler_W: Values | None  # [speed, range], sum over channels
    range_azimuth_W: Values | None  # [azimuth, range], largest over speeds
    detections: npt.NDArray[np.void] | None  # range_m, radial_speed_mps (receding), azimuth_rad, ..., cluster or -1
    range_m: Values  # of the cells of cube and maps
    speed_mps: Values  # receding
    azimuth_rad: Values
    meta: dict[str, Any] = field(repr=False)


def _numbers(told: Mapping[str, float]) -> dict[str, float]:
    if not isinstance(told, Mapping):
        refuse_type("numbers", "names with their numbers", told)
    return dict(told)


def frame(
    scene: Scene,
    index: int,
    *,
    want: Iterable[str] | None = None,
    waveform: str = "",
    radar: str | os.PathLike[str] | None = None,
    transmitters: int | None = None,
    receivers: int | None = None,
    real: bool | None = None,
    rays_per_cell: float = 1.0,
    false_alarm_probability: float | None = None,
    line_width_Hz: float | None = None,
    adc_bits: int | None = None,
    unfold: bool | None = None,
    seed: int = 0,
    numbers: Mapping[str, float] | None = None,
) -> SignalFrame:
    """Beat signals of a frame of the scene's flight, and what is made of them.

    Samples are a realisation: targets fluctuate, whatever the scene's pictures show, and every effect with any
    influence on the echoes runs unless the scene was opened without it.

    want           of "beat", "cube", "range-doppler", "range-azimuth", "detections"; by default beats and detections.
                   Waveforms without chirps in sequence have beats alone: of them more is refused
    waveform       a kind ("chirp-sequence", "triangle", ...) or "automotive-76ghz"; "": by the sensor
    radar          TOML file of a radar, which also has windows, detector, angle method, clusters, channel
                   errors and places of elements (docs/fmcw.md); the scene's own by default. The other arguments replace what it says;
                   line_width_Hz beside a table of phase noise is refused
    transmitters   and receivers of the array, 3 and 4
    numbers        of the waveform, in SI: {"bandwidth": 250e6, "ramp": 20e-6}; those of "fanbeam help waveform" without dashes
    line_width_Hz  of the oscillator, 0: no phase noise; adc_bits 0: no quantiser
    unfold         speeds of detections, by time division of the transmitters
    """
    if not isinstance(scene, Scene):
        refuse_type("scene", "a fanbeam.Scene", scene)
    products = None if want is None else items_of(want, "want", "an iterable of texts")
    told = {
        "waveform": waveform,
        "radar": "" if radar is None else radar,
        "transmitters": transmitters,
        "receivers": receivers,
        "real": real,
        "rays_per_cell": rays_per_cell,
        "false_alarm_probability": false_alarm_probability,
        "line_width_Hz": line_width_Hz,
        "adc_bits": adc_bits,
        "unfold": unfold,
        "seed": seed,
        "numbers": _numbers({} if numbers is None else numbers),
    }
    told = {name: value for name, value in told.items() if value is not None}
    made = _signal.frame(scene._core, scene._core.frame_number(index), products, told)
    warn(made.pop("warnings"))
    axes = made.pop("axes")
    doppler_Hz = (np.arange(axes["doppler_cells"]) - axes["doppler_cells"] // 2) * axes["doppler_step_Hz"]
    found = made.pop("detections")
    if found is not None:
        found = np.array([tuple(row) for row in found], _DETECTION)
    beats = made.pop("beats")
    return SignalFrame(
        beats=beats if products is None or "beat" in products else [],
        cube=made.pop("cube"),
        range_doppler_W=made.pop("range_doppler_W"),
        range_azimuth_W=made.pop("range_azimuth_W"),
        detections=found,
        range_m=np.arange(axes["range_cells"]) * axes["range_step_m"],
        speed_mps=0.5 * axes["wavelength_m"] * doppler_Hz,
        azimuth_rad=np.array(axes["azimuth_rad"]),
        meta={**made, "waveform": json.loads(made["waveform"])},
    )


def waveform(
    kind: str = "chirp-sequence", *, real: bool = False, down_first: bool = False, **numbers: float
) -> dict[str, Any]:
    """What a waveform can measure: its resolution, its unambiguous range and speed, by stage.

    Numbers in SI by the names of `frame`: waveform("chirp-sequence", bandwidth=250e6).
    """
    made: dict[str, Any] = json.loads(_signal.waveform(kind, numbers, real, down_first))
    return made
