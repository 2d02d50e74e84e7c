#!/usr/bin/python3
"""Draws what fanbeam says is where over the pictures of a frame.

usage: show_labels.py [SCENE [FRAME [FILE]]]     braunschweig-26, 950, labels.png unless told
"""

import sys

import fanbeam
import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

COLOURS = {"building": "tab:cyan", "box": "violet", "model": "tomato", "target": "tab:orange", "lights": "tab:green"}
LINE, WORD = 13, 25  # rows and columns that a name takes
CORNERS = ("near_left", "near_right", "far_right", "far_left")


def outline(axis, corners, scope, **style):
    spots = [corners[name][scope] for name in CORNERS]
    if all(spots):
        axis.fill([spot["x"] for spot in spots], [spot["y"] for spot in spots], fill=False, **style)


def mask_of(mask, picture):
    """Cells of a run-length mask."""
    values = np.arange(len(mask["runs"])) % 2 == 1
    return np.repeat(values, mask["runs"]).reshape(picture["columns"], picture["rows"]).T


def write_names(axis, names):
    """Beside their boxes, in lines of their own where boxes are close: text, colour, left, right, row of each."""
    written = []
    for text, colour, left, right, row in sorted(names, key=lambda name: name[-1]):
        near = [other for other in names if abs(other[2] - left) < WORD]
        to_the_left = min(other[2] for other in near) > WORD
        column = min(other[2] for other in near) - 5 if to_the_left else max(other[3] for other in near) + 5
        line = max([row] + [other + LINE for at, other in written if abs(at - column) < WORD])
        written.append((column, line))
        axis.annotate(
            text,
            (left if to_the_left else right, row),
            (column, line),
            ha="right" if to_the_left else "left",
            va="center",
            color=colour,
            fontsize=7,
            arrowprops={"arrowstyle": "-", "color": colour, "lw": 0.6},
            bbox={"facecolor": "black", "alpha": 0.6, "lw": 0, "pad": 1},
        )


def draw(axis, frame, scope):
    labels, picture = frame.labels, frame.labels[scope]
    axis.imshow(getattr(frame, scope), extent=(0, picture["columns"], picture["rows"], 0), aspect="auto", cmap="gray", vmin=0, vmax=255)
    for runway in labels["runways"]:
        mask = mask_of(runway[scope], picture)
        shown = np.zeros((*mask.shape, 4))
        shown[mask] = (1.0, 0.9, 0.0, 0.25)
        axis.imshow(shown, extent=(0, picture["columns"], picture["rows"], 0), aspect="auto")
        outline(axis, runway["corners"], scope, color="yellow", lw=1)
        outline(axis, runway["touchdown_zone"], scope, color="lime", lw=1)
    names = []
    for thing in labels["objects"]:
        colour = COLOURS[thing["group"]]
        for point in thing.get("points", []):
            if point[scope] and point["in_sight"]:
                axis.plot(point[scope]["x"], point[scope]["y"], ".", ms=2, color=colour)
        left, top, width, height = thing[scope]["box"]
        if not thing[scope]["cells"] or thing["group"] in ("lights", "target"):
            continue
        axis.add_patch(plt.Rectangle((left, top), width, height, fill=False, color=colour, lw=0.8))
        if thing["group"] != "building":
            told = f", {thing['signal_to_clutter_dB']:.0f} dB" if thing["signal_to_clutter_dB"] is not None else ""
            names.append((thing["name"] + told, colour, left, left + width, top + height / 2))
    write_names(axis, names)
    axis.set(xlim=(0, picture["columns"]), ylim=(picture["rows"], 0), title=scope, xlabel="column", ylabel="row")


def main():
    scene = fanbeam.Scene.open(sys.argv[1] if len(sys.argv) > 1 else "braunschweig-26")
    frame = scene.render(int(sys.argv[2]) if len(sys.argv) > 2 else 950, labels=True)
    figure, axes = plt.subplots(1, 2, figsize=(13, 6.5), layout="constrained")
    for axis, scope in zip(axes, ("bscope", "cscope")):
        draw(axis, frame, scope)
    figure.savefig(sys.argv[3] if len(sys.argv) > 3 else "labels.png", dpi=100)


if __name__ == "__main__":
    main()
