"""Road scenarios: the JSON Schema and the program agree on what is one."""

import copy
import csv
import json
import os
import subprocess

import jsonschema
import pytest

ROOT = os.path.join(os.path.dirname(__file__), "../..")
SHIPPED = os.path.join(ROOT, "scenes/highway-76ghz/traffic.json")
SHARED = os.path.join(
    os.environ.get("FANBEAM_DATA", os.path.join(ROOT, "../shared/data")), "../reference/highway-scenarios.json"
)


@pytest.fixture(scope="module")
def schema():
    with open(os.path.join(ROOT, "docs/highway.schema.json"), encoding="utf-8") as file:
        schema = json.load(file)
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


@pytest.fixture(scope="module")
def traffic():
    with open(SHIPPED, encoding="utf-8") as file:
        return json.load(file)


def test_shipped_and_shared_scenarios_fit(schema):
    with open(SHIPPED, encoding="utf-8") as file:
        schema.validate(json.load(file))
    if not os.path.exists(SHARED):
        (pytest.fail if os.environ.get("FANBEAM_REQUIRE_DATA") == "1" else pytest.skip)(f"needs shared data: {SHARED}")
    with open(SHARED, encoding="utf-8") as file:
        schema.validate(json.load(file))


def change(path, value):
    def apply(scenario):
        owner = scenario
        for step in path[:-1]:
            owner = owner[step]
        if value is None:
            del owner[path[-1]]
        else:
            owner[path[-1]] = value

    return apply


CHANGES = {
    "own radar": (change(["scenarios", 0, "radar_overrides"], {"noise_figure_db": 12}), True),
    "not measured": (change(["scenarios", 0, "suppressed_detections"], []), True),
    "unknown member": (change(["scenarios", 0, "weather"], "rain"), False),
    "unknown radar member": (change(["scenarios", 0, "radar_overrides"], {"noise_figre_db": 12}), False),
    "no scenario": (change(["scenarios"], []), False),
    "no duration": (change(["scenarios", 0, "duration_s"], None), False),
    "a target's name of two cells": (change(["scenarios", 0, "targets", 0, "id"], "A, left"), False),
    "unknown motion": (change(["scenarios", 0, "targets", 0, "motion"], "spiral"), False),
    "three numbers": (change(["scenarios", 0, "targets", 0, "position_m"], [1, 2, 3]), False),
    "waveforms": (change(["waveforms"], {"tri": {"type": "triangle", "ramp_s": 1e-3}}), True),
    "unknown waveform": (change(["waveforms"], {"tri": {"type": "sawtooth"}}), False),
    "one slope of two": (change(["waveforms"], {"two": {"type": "triangle-pair", "ramp_s": [2e-3]}}), False),
    "two slopes": (change(["waveforms"], {"two": {"type": "triangle-pair", "ramp_s": [3e-3, 2e-3]}}), True),
    "one slope twice": (change(["waveforms"], {"two": {"type": "triangle-pair", "ramp_s": [2e-3, 2e-3]}}), False),
    "a ramp of a coarse stage": (
        change(["waveforms"], {"two": {"type": "two-stage", "coarse": {"ramp_s": 1}, "fine": {}}}), False),
    "a rate of two stages": (
        change(["waveforms"], {"two": {"type": "two-stage", "coarse": {}, "fine": {}, "sample_rate_hz": 1e6}}), False),
    "a buffer of two stages": (
        change(["waveforms"], {"two": {"type": "two-stage", "coarse": {}, "fine": {}, "ramps_per_buffer": 8}}), False),
    "another code": (change(["waveforms"], {"pn": {"type": "up-flat-down", "flat_code": "gold-127"}}), False),
    "noise below none": (change(["radar", "noise_figure_db"], -1), False),
    "farther than any radar": (change(["radar", "max_range_m"], 1e10), False),
    "truth": (change(["scenarios", 0, "truth"], [{"id": "A", "rows": [], "in_view": [], "columns": ["t_s"]}]), True),
    "unknown member of truth": (
        change(["scenarios", 0, "truth"], [{"id": "A", "rows": [], "in_view": [], "in_veiw": []}]), False),
    "a lane change that accelerates": (
        change(["scenarios", 0, "targets", 3, "segments", 0, "acceleration_mps2"], [1, 0]), False),
    "a radius of a straight way": (change(["scenarios", 0, "targets", 0, "radius_m"], 50), False),
}


@pytest.mark.parametrize("name", CHANGES)
def test_the_schema_and_the_program_say_the_same(program, schema, traffic, tmp_path, name):
    apply, good = CHANGES[name]
    scenario = copy.deepcopy(traffic)
    apply(scenario)
    assert schema.is_valid(scenario) == good
    file = tmp_path / "traffic.json"
    file.write_text(json.dumps(scenario), encoding="utf-8")
    ended = subprocess.run([program, "track", file, "-o", tmp_path / "out", "-q"], capture_output=True, text=True)
    assert ended.returncode == (0 if good else 3), ended.stderr


def tracked(program, traffic, folder, extra):
    """The first scenario with other members: what run.json tells of it, and its measurements."""
    scenario = copy.deepcopy(traffic)
    scenario["scenarios"][0].update(extra)
    folder.mkdir()
    (folder / "traffic.json").write_text(json.dumps(scenario), encoding="utf-8")
    subprocess.run([program, "track", folder / "traffic.json", "-o", folder / "out", "-q"], check=True)
    told = json.loads((folder / "out/run.json").read_text())["scenarios"][0]
    (table,) = (folder / "out").glob("*/measurements.csv")
    with open(table, encoding="utf-8", newline="") as file:
        return told, [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]


def test_a_scenarios_radar_is_obeyed(program, traffic, tmp_path):
    """A radar of 30 dB noise figure more measures worse."""
    quiet, _ = tracked(program, traffic, tmp_path / "quiet", {})
    noisy, _ = tracked(program, traffic, tmp_path / "noisy", {"radar_overrides": {"noise_figure_db": 34.5}})
    assert noisy["range_rmse_m"] > 5 * quiet["range_rmse_m"]


def test_a_target_is_not_measured_in_its_gap_and_nothing_else_is_missing(program, traffic, tmp_path):
    one = traffic["scenarios"][0]["targets"][0]  # alone on its place
    speed = one["velocity_mps"][0] - traffic["scenarios"][0]["ego_speed_mps"]
    gap = {"suppressed_detections": [{"id": one["id"], "from_s": 0.975, "to_s": 1.975}]}  # 20 frames
    _, before = tracked(program, traffic, tmp_path / "whole", {})
    _, after = tracked(program, traffic, tmp_path / "gap", gap)

    def in_gap(row):
        return 0.975 <= row["time_s"] < 1.975

    def of_one(row):
        range_m = one["position_m"][0] + speed * row["time_s"]
        return abs(row["range_m"] - range_m) < 1 and abs(row["range_rate_mps"] - speed) < 1

    def alike(row, other):  # the noise of the others is drawn anew
        apart = [abs(row[name] - other[name]) for name in ("time_s", "range_m", "range_rate_mps", "azimuth_rad")]
        return max(apart) < 0.05

    assert [row for row in after if not in_gap(row)] == [row for row in before if not in_gap(row)]
    hidden = [row for row in before if in_gap(row) and of_one(row)]
    others = [row for row in before if in_gap(row) and not of_one(row)]
    left = [row for row in after if in_gap(row)]
    assert len(hidden) == 20 and len(others) > 50
    assert len(left) == len(others)
    assert all(any(alike(row, other) for other in left) for row in others)


def test_a_files_ramps_are_obeyed(program, traffic, tmp_path):
    """Speed errors of one measurement go with the power -1.5 of the ramp: 8 times here, 2 in tracks, which average."""
    errors = []
    for ramp_s in (2e-3, 0.5e-3):
        scenario = copy.deepcopy(traffic)
        scenario["waveforms"] = {"slow": {"type": "triangle", "ramp_s": 9e-3},
                                 "tri": {"type": "triangle", "ramp_s": ramp_s}}
        one = scenario["scenarios"][0]
        one["waveforms"] = ["tri"]
        one["targets"] = one["targets"][:1]  # no beats that merge
        one.pop("truth", None)
        file = tmp_path / f"{ramp_s}.json"
        file.write_text(json.dumps(scenario), encoding="utf-8")
        out = tmp_path / f"out{ramp_s}"
        subprocess.run([program, "track", file, "-o", out, "-q"], check=True)
        told = json.loads((out / "run.json").read_text())["scenarios"][0]
        assert told["waveform"] == "triangle"  # what the scenario names
        errors.append(told["range_rate_rmse_mps"])
    assert errors[1] > 1.5 * errors[0]


def test_a_scenario_names_waveforms_that_are_there(program, traffic, tmp_path):
    scenario = copy.deepcopy(traffic)
    scenario["scenarios"][0]["waveforms"] = ["nowhere"]
    file = tmp_path / "traffic.json"
    file.write_text(json.dumps(scenario), encoding="utf-8")
    ended = subprocess.run([program, "track", file, "-o", tmp_path / "out", "-q"], capture_output=True, text=True)
    assert ended.returncode == 3
    assert "/scenarios/0/waveforms/0" in ended.stderr
