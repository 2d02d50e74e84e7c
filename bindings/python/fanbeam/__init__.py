"""What an imaging millimetre-wave radar sees from an aircraft: pictures, watts and truth.

    import fanbeam
    scene = fanbeam.Scene.open("braunschweig-26")       # seconds
    scene.set_weather(visibility_m=200)                 # milliseconds
    frame = scene.render(1200, layers=True)             # frame 1200 of its flight, or any Pose
    frame.bscope                                        # NumPy, 8-bit grey, farthest range on top

Units stand in names: SI and radians in arrays, degrees, dB and mm/h where people type them. Arrays of
pictures are rows x columns, columns left to right in azimuth, the farthest range (B-scope) or the
highest elevation (C-scope) on top. Bad input raises InputError, which lists every problem.

The signal level (beat signals, radar cube, detections) is fanbeam.signal, imported by itself: it
loads FFTW, which is GPL. docs/python.md tells more.
"""

from fanbeam._core import version as __version__
from fanbeam._errors import FanbeamWarning, InputError, Problem
from fanbeam._lookups import Atmosphere, Material, materials, nrcs, scenes, sensors
from fanbeam._scene import Effect, Frame, Plan, Pose, Scene, Target, Trajectory

__all__ = [
    "Atmosphere",
    "Effect",
    "FanbeamWarning",
    "Frame",
    "InputError",
    "Material",
    "Plan",
    "Pose",
    "Problem",
    "Scene",
    "Target",
    "Trajectory",
    "__version__",
    "materials",
    "nrcs",
    "scenes",
    "sensors",
]
