#!/usr/bin/python3
"""fanbeam from Python in two minutes: pictures, truth, weather, a target, many processes.

usage: tour.py [FOLDER]     draws its pictures into FOLDER, out/python-tour unless told
"""

import multiprocessing
import sys
from pathlib import Path

import fanbeam
import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402


def brightness(scene, frame):
    """What a worker of the pool makes of a frame: the mean grey of its B-scope."""
    return frame, float(scene.render(frame, cscope=False).bscope_grey.mean())


def show_pictures(scene, folder):
    """A frame as the pilot sees it, and what stands where."""
    frame = scene.render(1150, layers=True)
    azimuth_deg = np.degrees(scene.azimuth_rad)
    figure, axes = plt.subplots(1, 3, figsize=(13, 5.5), layout="constrained")
    km = (azimuth_deg[0], azimuth_deg[-1], scene.range_m[-1] / 1000, scene.range_m[0] / 1000)
    degrees = (*km[:2], np.degrees(scene.elevation_rad[-1]), np.degrees(scene.elevation_rad[0]))
    axes[0].imshow(frame.bscope, extent=km, aspect="auto", cmap="gray", vmin=0, vmax=255)
    axes[0].set(title="B-scope", xlabel="azimuth, deg", ylabel="range, km")
    axes[1].imshow(frame.cscope, extent=degrees, aspect="auto", cmap="gray", vmin=0, vmax=255)
    axes[1].set(title="C-scope", xlabel="azimuth, deg", ylabel="elevation, deg")
    # Cells by what stands in them, the commonest materials by colour.
    material = frame.layers["material"].astype(int)
    common = [k for k in np.argsort(-np.bincount(material[material < 65535]))[:8]]
    shown = np.full(material.shape, np.nan)
    for colour, k in enumerate(common):
        shown[material == k] = colour
    picture = axes[2].imshow(shown, extent=km, aspect="auto", cmap="tab10", vmin=-0.5, vmax=9.5)
    axes[2].set(title="material that sends most", xlabel="azimuth, deg", ylabel="range, km")
    bar = figure.colorbar(picture, ax=axes[2], ticks=range(len(common)))
    bar.ax.set_yticklabels([scene.materials[k] for k in common])
    bar.ax.set_ylim(-0.5, len(common) - 0.5)
    figure.savefig(folder / "frame.png", dpi=110)


def show_rain(scene, folder):
    """The signal that rain leaves: power of the columns ahead over range."""
    figure, axis = plt.subplots(figsize=(8, 4.5), layout="constrained")
    for rate in (0, 5, 20, 50):
        scene.set_weather(rain_rate_mm_per_h=rate)
        power_W = scene.render(1150, cscope=False).bscope_W[:, 72:92].mean(axis=1)
        axis.plot(scene.range_m / 1000, 10 * np.log10(power_W + scene.facts["noise_W"]), label=f"{rate} mm/h")
    axis.set(title="mean received power ahead, with noise", xlabel="range, km", ylabel="dBW")
    axis.legend(title="rain")
    figure.savefig(folder / "rain.png", dpi=110)
    scene.set_weather(rain_rate_mm_per_h=0)


def main():
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else "out/python-tour")
    folder.mkdir(parents=True, exist_ok=True)
    scene = fanbeam.Scene.open("braunschweig-26")
    print(scene)
    print(scene.plan)
    show_pictures(scene, folder)
    show_rain(scene, folder)

    # A car on the runway, where the approach ends; its echo over what surrounds it.
    end = scene.trajectory[-1]
    ground_m = scene.ground_height_m(end.latitude_deg, end.longitude_deg)
    clear_W = scene.render(1150, cscope=False).bscope_W
    scene.set_targets([fanbeam.Target("car", end.latitude_deg, end.longitude_deg, ground_m + 1.0, rcs_m2=10.0)])
    added_W = scene.render(1150, cscope=False).bscope_W - clear_W
    row, column = np.unravel_index(np.argmax(added_W), added_W.shape)
    over_dB = 10 * np.log10(added_W[row, column] / (clear_W[row, column] + scene.facts["noise_W"]))
    print(f"the car: {scene.range_m[row]:.0f} m, {np.degrees(scene.azimuth_rad[column]):+.2f} deg, {over_dB:.1f} dB over the runway")

    # Frames by two processes, each with a scene of its own: what a scene was told travels.
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        for frame, grey in pool.starmap(brightness, [(scene, frame) for frame in (600, 900, 1200)]):
            print(f"frame {frame}: mean grey {grey:.1f}")
    print(f"pictures in {folder}")


if __name__ == "__main__":
    main()
