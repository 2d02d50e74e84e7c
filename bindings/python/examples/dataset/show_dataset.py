#!/usr/bin/python3
"""A mosaic of a merged campaign's B-scopes, and how its parameters are spread.

usage: show_dataset.py FOLDER [PREFIX]     draws PREFIXmosaic.png and PREFIXparameters.png
"""

import csv
import sys
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.image as image  # noqa: E402
import matplotlib.pyplot as plt  # noqa: E402

ACROSS, DOWN = 12, 3
FIXED = ("run", "frame", "time_s", "latitude_deg", "longitude_deg", "height_m", "roll_deg", "pitch_deg", "heading_deg")


def is_number(text):
    try:
        float(text)
    except ValueError:
        return False
    return True


def draw_mosaic(folder, rows, file):
    chosen = [rows[k] for k in np.linspace(0, len(rows) - 1, ACROSS * DOWN).astype(int)]
    pictures = [image.imread(folder / row["bscope"])[::2] for row in chosen]
    gap = np.ones((pictures[0].shape[0], 2))
    lines = [np.hstack([part for picture in pictures[k : k + ACROSS] for part in (picture, gap)]) for k in range(0, len(pictures), ACROSS)]
    mosaic = np.vstack([part for line in lines for part in (line, np.ones((2, line.shape[1])))])
    plt.imsave(file, mosaic, cmap="gray", vmin=0, vmax=1)


def draw_parameters(rows, file):
    runs = {row["run"]: row for row in rows}.values()
    names = [name for name in rows[0] if name not in FIXED and "/" not in rows[0][name] and len({row[name] for row in runs}) > 1]
    across = 4
    figure, axes = plt.subplots(-(-len(names) // across), across, figsize=(13, 2.2 * -(-len(names) // across)), layout="constrained")
    for axis in axes.ravel()[len(names) :]:
        axis.axis("off")
    for name, axis in zip(names, axes.ravel()):
        values = [row[name] for row in runs]
        if all(map(is_number, values)) and len(set(values)) > 8:
            numbers = np.array(values, float)
            skewed = numbers.min() > 0 and numbers.max() > 15 * numbers.min()
            bins = np.geomspace(numbers.min(), numbers.max(), 21) if skewed else 20
            axis.hist(numbers, bins)
            axis.set_xscale("log" if skewed else "linear")
        else:
            words = sorted(set(values), key=lambda word: (float(word) if is_number(word) else 0, word))
            axis.bar(words, [values.count(word) for word in words])
        axis.set_title(name, fontsize=9)
        axis.tick_params(labelsize=7)
    figure.supylabel("runs")
    figure.savefig(file, dpi=90)


def main():
    folder, prefix = Path(sys.argv[1]), sys.argv[2] if len(sys.argv) > 2 else ""
    with open(folder / "index.csv", encoding="utf-8", newline="") as table:
        rows = list(csv.DictReader(table))
    draw_mosaic(folder, rows, prefix + "mosaic.png")
    draw_parameters(rows, prefix + "parameters.png")
    print(f"{len({row['run'] for row in rows})} approaches, {len(rows)} frames")


if __name__ == "__main__":
    main()
