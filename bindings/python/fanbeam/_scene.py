"""A scene held open, its conditions, and the frames it gives."""

from __future__ import annotations

import copy
import json
import os
import threading
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, fields, replace
from types import EllipsisType
from typing import Any, NamedTuple, TypedDict, cast, overload

import numpy as np
import numpy.typing as npt

from fanbeam import _core, _paths
from fanbeam._errors import Problem, items_of, warn

Grey = npt.NDArray[np.uint8]
Values = npt.NDArray[np.float64]
Layers = dict[str, npt.NDArray[Any]]


class Facts(TypedDict):
    """What a scene says of itself: names, and the axes of its pictures."""

    name: str
    sensor: str
    frequency_Hz: float
    frame_rate_Hz: float
    columns: int  # of both pictures
    field_of_view_rad: float
    range_minimum_m: float  # near edge of the nearest range cell
    range_cell_m: float
    range_cells: int
    cscope_rows: int
    cscope_top_rad: float  # upper edge
    cscope_span_rad: float
    window_dB: tuple[float, float]  # shown as grey 0 and 255
    noise_W: float  # mean, of a cell
    caster: str
    caster_reason: str
    surface: str
    materials: list[str]
    objects: list[str]


@dataclass(frozen=True)
class Pose:
    """Where the aircraft is (WGS 84, height over the ellipsoid) and how it is turned.

    Heading clockwise from true north, pitch nose up, roll right wing down; yaw, pitch and roll are
    applied in this order. `time_s` moves the scene's own targets. The velocity over ground matters to
    signals alone.
    """

    latitude_deg: float
    longitude_deg: float
    height_m: float
    heading_deg: float = 0.0
    pitch_deg: float = 0.0
    roll_deg: float = 0.0
    time_s: float = 0.0
    north_mps: float = 0.0
    east_mps: float = 0.0
    down_mps: float = 0.0

    def _numbers(self) -> tuple[float, ...]:
        place = (self.time_s, self.latitude_deg, self.longitude_deg, self.height_m)
        attitude = (self.roll_deg, self.pitch_deg, self.heading_deg)
        return (*place, *attitude, self.north_mps, self.east_mps, self.down_mps)

    @staticmethod
    def _of(row: Iterable[float]) -> Pose:
        time_s, latitude, longitude, height_m, roll, pitch, heading, north, east, down = map(float, row)
        return Pose(latitude, longitude, height_m, heading, pitch, roll, time_s, north, east, down)


class Trajectory:
    """A flight: a sequence of Pose, one a frame, and its columns as arrays (`flight.height_m`).

    Columns are those of Pose; `as_array` has them all, in the order of `Trajectory.columns`.
    """

    columns = (
        "time_s",
        "latitude_deg",
        "longitude_deg",
        "height_m",
        "roll_deg",
        "pitch_deg",
        "heading_deg",
        "north_mps",
        "east_mps",
        "down_mps",
    )

    def __init__(self, rows: Values):
        self.as_array = rows

    def __len__(self) -> int:
        return len(self.as_array)

    @overload
    def __getitem__(self, frame: int) -> Pose: ...
    @overload
    def __getitem__(self, frame: slice) -> Trajectory: ...
    def __getitem__(self, frame: int | slice) -> Pose | Trajectory:
        if isinstance(frame, slice):
            return Trajectory(self.as_array[frame])
        return Pose._of(self.as_array[frame])

    def __iter__(self) -> Iterator[Pose]:
        return (Pose._of(row) for row in self.as_array)

    def __getattr__(self, name: str) -> Values:
        if name not in Trajectory.columns:
            raise AttributeError(f"a trajectory has no {name}; it has {', '.join(Trajectory.columns)}")
        return self.as_array[:, Trajectory.columns.index(name)]


@dataclass(frozen=True)
class Target:
    """A point scatterer that stands where it is said to, until told otherwise.

    `name`: of the scene's own, all that share it; another one is new and needs `rcs_m2`, the same from
    all sides (0 to 1e9). `attitude_deg`: roll, pitch, heading of its boresight. What is
    not given is the scene's own, of a new one north: it does not stay from an earlier call.
    """

    name: str
    latitude_deg: float
    longitude_deg: float
    height_m: float
    rcs_m2: float | None = None
    attitude_deg: tuple[float, float, float] | None = None


class Effect(NamedTuple):
    """Whether an effect is simulated, and why.

    Bounds are of the largest change of any displayed pixel that leaving it out can cause.
    """

    name: str
    on: bool
    reason: str
    bound_grey: float
    bound_dB: float


class Plan(tuple[Effect, ...]):
    """The effects of a scene under its conditions, each with the decision about it."""

    __slots__ = ()

    def runs(self, name: str) -> bool:
        """Whether the effect "rain", "double-bounce", ... is simulated."""
        for effect in self:
            if effect.name == name:
                return effect.on
        raise KeyError(f"no effect {name!r}; there are {', '.join(effect.name for effect in self)}")

    def __str__(self) -> str:
        return "\n".join(f"{'on ' if row.on else 'off'}  {row.name:<15} {row.reason}" for row in self)


@dataclass(eq=False)
class Frame:
    """Pictures of one moment as NumPy arrays, rows x columns; what was not asked for is None.

    All have the farthest range (B-scope) or the highest elevation (C-scope) on top and azimuth from
    left to right. They share the memory that the frame was rendered into.
    """

    bscope: Grey | None  # 8-bit grey, as the display shows it
    cscope: Grey | None
    bscope_grey: Values | None  # the same before rounding, 0 to 255
    cscope_grey: Values | None
    # Expected power of the echoes, without the receiver's noise: add meta["noise_W"]. Of a sample, with
    # the noise that was drawn.
    bscope_W: Values | None
    cscope_W_m3: Values | None  # the same times R^3, summed over range
    # Truth by cell of the B-scope: visibility, grazing_rad, nrcs (linear), elevation_rad,
    # double_bounce (share of the power), material and object (indices of Scene.materials, .objects)
    layers: Layers | None
    cscope_layers: Layers | None  # of the C-scope; range_m in the place of elevation_rad
    labels: dict[str, Any] | None  # what is where: runways, lights, obstacles, buildings; docs/labels.md
    # pose, frame_index, noise_W, rays, events, estimated_error_grey (of the B-scope and the C-scope;
    # None where not estimated, or where that picture was not asked for), ...
    meta: dict[str, Any] = field(repr=False)

    @property
    def pose(self) -> Pose:
        """Where it was rendered from: `meta["pose"]`."""
        at: Pose = self.meta["pose"]
        return at


_KEEP: EllipsisType = ...
_Wish = float | None | EllipsisType
_SENSOR = ("tilt_deg", "stabilised", "low_dB", "high_dB", "cscope_mode", "noise_figure_dB")


@dataclass
class _Settings:
    """All that a scene was told: what another process needs to have the same. Nobody else's objects."""

    opened: dict[str, Any]
    weather: dict[str, Any] = field(default_factory=dict)  # all of it, once any was told
    sensor: dict[str, Any] = field(default_factory=dict)
    surface: str | None = None
    targets: tuple[Target, ...] = ()
    accuracy: float | None = None  # the last one: it stays for effects
    sampling: tuple[str, float] | None = None


class _NotOpened:
    """In the place of a scene that could not be opened where it was sent: every call raises why."""

    def __init__(self, why: Exception):
        self._why = why

    def __getattr__(self, name: str) -> Any:
        raise self._why


class Scene:
    """A scene held open: terrain, buildings, runway, targets, a sensor, and usually a flight.

    Open it with Scene.open. Conditions change in milliseconds; frames under way keep theirs. Any
    number of threads may render and set at once, Python's lock is released meanwhile, and the bytes
    of a frame depend on its conditions, pose and number alone.

    Scenes pickle: what travels is what they were told, and the other side opens them anew; what is
    wrong with that is raised by the first call there. A process forked from one that opened a scene
    has none of its threads: there every call of a scene raises RuntimeError; start processes by
    "spawn" or "forkserver". A forked child that ends by itself must do so by os._exit, as those of
    multiprocessing do, or exec: docs/python.md.
    """

    def __init__(self, settings: _Settings, warnings: list[Any]):
        self._told = settings
        # What changes a part reads the rest before; a time budget is measured for seconds.
        self._setting, self._sampling = threading.Lock(), threading.Lock()
        # The scene's own time budget is measured once: copies take what it came to.
        budget = settings.sampling is None
        self._core = _core.Scene(keeps_time_budget=budget, warnings=warnings, **settings.opened)
        if budget:
            settings.sampling = self._core.own_budget()

    @staticmethod
    def open(
        scene: str | os.PathLike[str] = "braunschweig-26",
        *,
        sensor: str | os.PathLike[str] | None = None,
        data: str | os.PathLike[str] | None = None,
        effects: str = "",
        caster: str = "",
        sample: bool | None = None,
        cscope: bool = True,
        seed: int = 0,
        threads: int = 0,
    ) -> Scene:
        """Opens a scene: a folder with scene.toml, that file, or a name of fanbeam.scenes().

        sensor   a sensor file or a name of fanbeam.sensors(), instead of the scene's
        data     a folder looked at before the one that FANBEAM_DATA names
        effects  "all", "none", "+rain,-gas": instead of what the scene calls for
        caster   "rays", "profile" or "auto", instead of the scene's
        sample   True: frames are one draw of speckle and noise; False: the mean of all draws
        cscope   False: no C-scope is ever asked for, nor labels, and effects that only it shows are left out
        seed     of everything random
        threads  at most, for a frame; 0: all
        """
        shipped = _paths.shipped()
        opened = _core.checked_setup(
            scene, sensor, data, effects, caster, sample, cscope, seed, threads, shipped
        )
        opened["data"] = _paths.data_folders(data)
        warnings: list[Any] = []
        opened_scene = Scene(_Settings(opened), warnings)
        warn(warnings)
        return opened_scene

    def __getstate__(self) -> _Settings:
        return self._told

    def __setstate__(self, told: _Settings) -> None:
        # Raised in here, it would end a worker of a pool, which then waits for its answer for ever.
        try:
            self._open_again(told)
        except Exception as error:
            self._told = told
            self._core = cast(Any, _NotOpened(error))

    def _open_again(self, told: _Settings) -> None:
        # Warnings were given where all this was told.
        self.__init__(replace(told), [])  # type: ignore[misc]
        if told.weather:
            self._core.set_weather(told.weather)
        if told.surface is not None:
            self._core.set_surface(told.surface)
        if told.sensor:
            self._core.set_sensor(**told.sensor)
        if told.targets:
            self._core.set_targets(told.targets)
        if told.accuracy is not None:
            self._core.set_sampling("accuracy", told.accuracy)
        if told.sampling is not None:
            self._core.set_sampling(*told.sampling)

    def __repr__(self) -> str:
        return f"<fanbeam.Scene {self.name!r}, {self.sensor!r}, {len(self.trajectory)} frames>"

    # Conditions

    def set_weather(
        self,
        *,
        visibility_m: _Wish = _KEEP,
        liquid_water_g_per_m3: _Wish = _KEEP,
        fog_top_m: _Wish = _KEEP,
        rain_rate_mm_per_h: _Wish = _KEEP,
        rain_top_m: _Wish = _KEEP,
        melting_layer: bool | None | EllipsisType = _KEEP,
        melting_height_m: _Wish = _KEEP,
        snow_rate_mm_per_h: _Wish = _KEEP,
        snow_top_m: _Wish = _KEEP,
        temperature_C: _Wish = _KEEP,
        pressure_hPa: _Wish = _KEEP,
        humidity: _Wish = _KEEP,
    ) -> None:
        """Changes what is named and keeps the rest. Heights are above the scene's origin.

        visibility_m 10 to 100000 or liquid_water_g_per_m3 0 to 20: fog below fog_top_m. Either takes the
        other's place; None for either: no fog there.
        rain_rate_mm_per_h 0 to 300, everywhere below rain_top_m or a melting layer.
        snow_rate_mm_per_h 0 to 50, water equivalent. temperature_C -60 to 50, pressure_hPa 300 to 1100,
        humidity 0 to 1, of the air at the origin; None: of the reference atmosphere. Media that mirror and
        OpenMATERIAL surfaces follow the temperature.
        None of the rest: no rain, no snow, no melting layer, tops as without a scene (150, 3000, 6000 m).
        Layers of fog and cells of rain that the scene has stay.
        """
        told = {name: value for name, value in locals().items() if name != "self" and value is not _KEEP}
        with self._setting:
            warnings = self._core.set_weather(told)
            self._told.weather = self._core.weather()
        warn(warnings)

    @property
    def weather(self) -> dict[str, float | bool | None]:
        """That of now, by the names of set_weather."""
        return self._core.weather()

    def set_surface(self, state: str) -> None:
        """What the weather left on the ground and on buildings: "dry", "wet", "dry-snow", "wet-snow"."""
        with self._setting:
            warnings = self._core.set_surface(state)
            self._told.surface = state
        warn(warnings)

    @property
    def surface(self) -> str:
        """What lies on the ground and on buildings now, by the names of set_surface."""
        return self._core.facts()["surface"]

    def set_sensor(
        self,
        *,
        tilt_deg: _Wish = _KEEP,
        stabilised: bool | None | EllipsisType = _KEEP,
        low_dB: _Wish = _KEEP,
        high_dB: _Wish = _KEEP,
        cscope_mode: str | None | EllipsisType = _KEEP,
        noise_figure_dB: _Wish = _KEEP,
    ) -> None:
        """Changes what is named and keeps the rest; None is the sensor's own.

        tilt_deg of the boresight, positive up; the C-scope goes along. low_dB and high_dB: the display's
        window. cscope_mode: "true_elevation", "flat_earth" or "shadow". Another sensor: Scene.open.
        """
        told = {name: value for name, value in locals().items() if name != "self" and value is not _KEEP}
        with self._setting:
            settings = dict.fromkeys(_SENSOR) | self._told.sensor | told
            warnings = self._core.set_sensor(**settings)
            self._told.sensor = copy.deepcopy(settings)  # what passed can be copied
        warn(warnings)

    def set_targets(self, targets: Iterable[Target]) -> None:
        """Puts these; all others go back to where the scene has them, and new ones vanish."""
        own = tuple(items_of(targets, "targets", "an iterable of fanbeam.Target"))
        with self._setting:
            warnings = self._core.set_targets(own)
            self._told.targets = copy.deepcopy(own)
        warn(warnings)

    # Sampling: the last call counts.

    def set_samples(self, per_cell: float = 0.0) -> None:
        """Rays per range cell and column, or slices per column: 0.3 to 10000; 0: the caster's default."""
        warn(self._set_sampling("samples", per_cell))

    def set_accuracy(self, grey_levels: float) -> None:
        """Every frame is refined until its estimated error (RMS, grey levels) is at most half of it."""
        warn(self._set_sampling("accuracy", grey_levels))

    def set_time_budget(self, ms: float) -> None:
        """The finest sampling with which frames take so long on this machine, timed now.

        A pickled scene takes the sampling along: copies are not timed anew.
        """
        warn(self._set_sampling("time_budget", ms))

    def set_reference(self) -> None:
        """Converged pictures, as errors are stated against: 10 s to well over a minute each."""
        warn(self._set_sampling("reference", 0.0))

    def _set_sampling(self, kind: str, value: float) -> list[Problem]:
        with self._sampling:
            warnings, same, plain = self._core.set_sampling(kind, value)
            self._told.sampling = (same, plain)
            if kind == "accuracy":
                self._told.accuracy = plain
        return warnings

    # Frames

    def render(
        self,
        at: Pose | int,
        *,
        frame_index: int | None = None,
        bscope: bool = True,
        cscope: bool | None = None,
        layers: bool = False,
        cscope_layers: bool = False,
        labels: bool = False,
    ) -> Frame:
        """What the radar sees from a Pose, or in a frame of the scene's flight.

        Frames below 0 are counted from the end. What is not wanted is not computed, but for the B-scope's
        powers, which every frame is made with: `bscope=False` saves its picture alone. Something must be
        wanted; `cscope` is unless the scene was opened without. `frame_index` keys what is random: that of the flight, or 0,
        unless given. A pose the scene's plan was not made for takes tens of milliseconds more and has the
        event "outside_volume".
        """
        number = 0
        if isinstance(at, Pose):
            pose = at
        else:
            number = self._core.frame_number(at, "a fanbeam.Pose or a whole number")
            pose = self.trajectory[number]
        if frame_index is None:
            frame_index = number
        if cscope is None:
            cscope = self._told.opened["cscope"]
        made = self._core.render(pose._numbers(), frame_index, bscope, cscope, layers, cscope_layers, labels)
        if labels:
            made["labels"] = json.loads(made["labels"])
        shown = {item.name: made.pop(item.name) for item in fields(Frame) if item.name != "meta"}
        return Frame(**shown, meta={"pose": pose, "frame_index": frame_index, **made})

    def ground_height_m(self, latitude_deg: float, longitude_deg: float) -> float | None:
        """Of the terrain there, above the ellipsoid; None where the scene has none."""
        return self._core.ground_height_m(latitude_deg, longitude_deg)

    @property
    def trajectory(self) -> Trajectory:
        """The scene's own flight, a pose a frame; empty where it has none."""
        return Trajectory(self._core.trajectory())

    @property
    def plan(self) -> Plan:
        """Which effects are simulated under the conditions of now, and why."""
        return Plan(Effect(*row) for row in self._core.plan())

    # What a scene says of itself

    @property
    def facts(self) -> Facts:
        """Names and the axes of pictures, under the conditions of now."""
        return self._core.facts()

    @property
    def name(self) -> str:
        """What the scene's file calls it."""
        return self.facts["name"]

    @property
    def sensor(self) -> str:
        """What the sensor's file calls the sensor."""
        return self.facts["sensor"]

    @property
    def materials(self) -> list[str]:
        """By the index that `layers["material"]` holds; 65535 there: nothing is seen, or a target."""
        return self.facts["materials"]

    @property
    def objects(self) -> list[str]:
        """By the index that `layers["object"]` holds: the terrain, runways, buildings, point targets."""
        return self.facts["objects"]

    @property
    def azimuth_rad(self) -> Values:
        """Middle of every column."""
        facts = self.facts
        middle = (np.arange(facts["columns"]) + 0.5) / facts["columns"] - 0.5
        return np.asarray(middle * facts["field_of_view_rad"])

    @property
    def range_m(self) -> Values:
        """Middle of every row of B-scopes: the farthest first, as in pictures."""
        facts = self.facts
        cells = np.arange(facts["range_cells"])[::-1] + 0.5
        return np.asarray(facts["range_minimum_m"] + cells * facts["range_cell_m"])

    @property
    def elevation_rad(self) -> Values:
        """Middle of every row of C-scopes: the highest first."""
        facts = self.facts
        rows = (np.arange(facts["cscope_rows"]) + 0.5) / facts["cscope_rows"]
        return np.asarray(facts["cscope_top_rad"] - rows * facts["cscope_span_rad"])
