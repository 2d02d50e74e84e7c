#!/usr/bin/python3
"""A baseline: finds the runway in B-scopes, fitted on one airport and judged on the others, error over rain.

usage: find_runway.py FOLDER [PICTURE]     FOLDER of the campaign approaches.toml, merged; draws PICTURE (runway.png)

A candidate is a strip on flat ground: how far ahead its threshold is, how far right, and how it lies. Its features are mean
grey and spread inside, beside, and before the threshold; a score is linear in them, fitted by ridge regression on the first
scene's frames, for candidates near the truth and far from it. The best of a grid of candidates, refined, is the answer.
"""

import csv
import json
import sys
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.image as image  # noqa: E402
import matplotlib.pyplot as plt  # noqa: E402

COLUMNS, ROWS, FIELD_deg, NEAREST_m, CELL_m = 164, 524, 41.0, 200.0, 6.67  # HiVision
ALONG_m = np.concatenate([np.linspace(30, 1200, 16), np.linspace(-150, -40, 5)])
ACROSS_m = np.array([-9.0, 9.0, -48.0, -65.0, 48.0, 65.0])  # inside, left, right of a strip some 45 m wide
INSIDE, LEFT, RIGHT = slice(0, 2), slice(2, 4), slice(4, 6)
ON, BEFORE = slice(0, 16), slice(16, 21)


def cells(candidates):
    """Row-major cell of every sample of candidates (ahead_m, right_m, angle_rad); -1 outside the picture."""
    ahead, right, angle = (part[:, None, None] for part in candidates.T)
    along, across = ALONG_m[None, :, None], ACROSS_m[None, None, :]
    y = ahead + along * np.cos(angle) - across * np.sin(angle)
    x = right + along * np.sin(angle) + across * np.cos(angle)
    column = np.floor((np.degrees(np.arctan2(x, y)) / FIELD_deg + 0.5) * COLUMNS).astype(int)
    row = np.floor(ROWS - (np.hypot(x, y) - NEAREST_m) / CELL_m).astype(int)
    inside = (y > 0) & (column >= 0) & (column < COLUMNS) & (row >= 0) & (row < ROWS)
    return np.where(inside, row * COLUMNS + column, -1)


def features(picture, where):
    """Of a smoothed picture at the cells of candidates; samples outside the picture do not count."""
    grey = np.append(picture.ravel(), np.nan)[where]
    inside, left, right = grey[:, ON, INSIDE], grey[:, ON, LEFT], grey[:, ON, RIGHT]
    before = grey[:, BEFORE, INSIDE]

    def mean(part):
        count = np.maximum(np.isfinite(part).sum(axis=(1, 2)), 1)
        return np.nansum(part, axis=(1, 2)) / count

    middle = mean(inside)
    spread = np.sqrt(mean((inside - middle[:, None, None]) ** 2))
    beside = np.fmin(np.fmin(left[:, :, 0], left[:, :, 1]), np.fmin(right[:, :, 0], right[:, :, 1]))
    darker = mean((beside > np.fmax(inside[:, :, 0], inside[:, :, 1]))[:, :, None] * 1.0)
    seen = np.isfinite(inside).mean(axis=(1, 2))
    values = [middle, mean(left) - middle, mean(right) - middle, mean(before) - middle, spread, 40 * darker, 40 * seen]
    linear = np.stack(values, axis=1) / 40
    return np.concatenate([linear, np.minimum(linear[:, 1:2], linear[:, 2:3]), linear**2, np.ones((len(linear), 1))], axis=1)


def smoothed(path):
    """Grey of a B-scope, speckle averaged over five rows."""
    picture = np.asarray(image.imread(path), float) * 255
    padded = np.pad(picture, ((2, 2), (0, 0)), mode="edge")
    return sum(padded[k : k + ROWS] for k in range(5)) / 5


def truth_of(labels):
    near, far = labels["runways"][0]["thresholds"]["near"], labels["runways"][0]["thresholds"]["far"]
    at = [np.array([place["range_m"], np.radians(place["azimuth_deg"])]) for place in (near, far)]
    (y0, x0), (y1, x1) = (np.array([r * np.cos(a), r * np.sin(a)]) for r, a in at)
    return np.array([y0, x0, np.arctan2(x1 - x0, y1 - y0)])


def fit(frames, draws):
    """Weights of the score: 1 at the truth, falling with the error in widths of a runway."""
    rows, targets = [], []
    for frame in frames:
        scale = np.where(draws.random((160, 1)) < 0.5, np.array([[60.0, 20.0, 0.03]]), np.array([[400.0, 120.0, 0.15]]))
        tried = np.concatenate([frame["truth"][None], frame["truth"] + draws.normal(size=(160, 3)) * scale])
        error = (tried - frame["truth"]) / np.array([60.0, 15.0, 0.02])
        rows.append(features(frame["picture"], cells(tried)))
        targets.append(np.exp(-0.5 * (error**2).sum(axis=1)))
    rows, targets = np.concatenate(rows), np.concatenate(targets)
    weight = 1 + 4 * targets  # few are near
    normal = (rows * weight[:, None]).T @ rows + 1e-2 * len(rows) * np.eye(rows.shape[1]) / 100
    return np.linalg.solve(normal, (rows * weight[:, None]).T @ targets)


GRID = np.stack(
    np.meshgrid(np.arange(150.0, 2000, 30), np.arange(-120.0, 121, 10), np.radians(np.arange(-9.0, 9.1, 1.0)), indexing="ij"), -1
).reshape(-1, 3)


def find(picture, weights, grid_cells, draws):
    best = GRID[np.argmax(features(picture, grid_cells) @ weights)]
    for width in (1.0, 0.5, 0.25, 0.12):
        tried = np.concatenate([best[None], best + draws.normal(size=(300, 3)) * width * np.array([30.0, 10.0, 0.02])])
        best = tried[np.argmax(features(picture, cells(tried)) @ weights)]
    return best


def read(folder):
    with open(folder / "index.csv", encoding="utf-8", newline="") as table:
        for row in csv.DictReader(table):
            labels = json.loads((folder / row["labels"]).read_text(encoding="utf-8"))
            near = labels["runways"][0]["thresholds"]["near"]
            if near["bscope"] is None or not 250 < near["range_m"] < 1900:
                continue
            yield {
                "scene": row["scene"],
                "rain": float(row["weather.rain_rate_mm_per_h"]),
                "truth": truth_of(labels),
                "picture": smoothed(folder / row["bscope"]),
            }


def main():
    folder = Path(sys.argv[1])
    frames = list(read(folder))
    scenes = sorted({frame["scene"] for frame in frames})
    draws = np.random.default_rng(1)
    home = [frame for frame in frames if frame["scene"] == scenes[0]]
    weights = fit(home[::2], draws)  # the other half judges at home
    grid_cells = cells(GRID)
    judged = home[1::2] + [frame for frame in frames if frame["scene"] != scenes[0]]
    for frame in judged:
        error = find(frame["picture"], weights, grid_cells, draws) - frame["truth"]
        frame["found"] = abs(error[1]) < 22.5 and abs(error[0]) < 100 and abs(error[2]) < np.radians(2)
        frame["aside_m"] = abs(error[1])
    figure, axes = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
    rates = sorted({frame["rain"] for frame in judged})
    for scene in scenes:
        shares, medians = [], []
        for rate in rates:
            here = [frame for frame in judged if frame["scene"] == scene and frame["rain"] == rate]
            shares.append(np.mean([frame["found"] for frame in here]) if here else np.nan)
            medians.append(np.median([frame["aside_m"] for frame in here]) if here else np.nan)
        mine = [frame for frame in judged if frame["scene"] == scene]
        share = np.mean([frame["found"] for frame in mine])
        print(f"{scene:18} {len(mine):4} frames, found in {100 * share:.0f} %, median {np.median([f['aside_m'] for f in mine]):.1f} m aside")
        axes[0].plot(rates, 100 * np.array(shares), "o-", label=scene)
        axes[1].plot(rates, medians, "o-", label=scene)
    axes[0].set(xlabel="rain, mm/h", ylabel="found, %", ylim=(0, 102), title=f"fitted on half of {scenes[0]}")
    axes[1].set(xlabel="rain, mm/h", ylabel="median error aside, m", yscale="log")
    axes[0].legend()
    figure.savefig(sys.argv[2] if len(sys.argv) > 2 else "runway.png", dpi=100)


if __name__ == "__main__":
    main()
