"""Campaigns: which scene and sensor a run is made of, and that a change of them is found."""

import shutil

import pytest
from campaign_test import bytes_of, told

CAMPAIGN = """
[campaign]
name = "inputs"
scenes = ["flat-grass"]
runs = 2
frames = { count = 1 }
products = ["power"]
samples_per_cell = 0.3
isa = "v2"
"""


# A file beside the campaign's and a shipped name; the working directory has another of each.
@pytest.mark.parametrize("sensor", ["radar.toml", "hivision-94"])
def test_scenes_and_sensors_are_not_those_of_the_working_directory(program, root, tmp_path, sensor):
    plain, decoys = tmp_path / "plain", tmp_path / "decoys"
    (decoys / "flat-grass").mkdir(parents=True)
    plain.mkdir()
    scene = (root / "scenes" / "flat-grass" / "scene.toml").read_text(encoding="utf-8")
    lower = scene.replace("above_ground_m = 60.0", "above_ground_m = 50.0")
    assert lower != scene
    (decoys / "flat-grass" / "scene.toml").write_text(lower, encoding="utf-8")
    shutil.copy(root / "sensors" / "hivision-94.toml", tmp_path / "radar.toml")
    shutil.copy(root / "sensors" / "hivision.toml", decoys / sensor)
    file = tmp_path / "inputs.toml"
    file.write_text(CAMPAIGN + f'sensor = "{sensor}"\n', encoding="utf-8")
    for folder in (plain, decoys):
        told(program, "run", file, "-o", folder / "out", "--runs", "0", cwd=folder)
    assert bytes_of(plain / "out") == bytes_of(decoys / "out")
    assert b"HiVision at 94 GHz" in (decoys / "out" / "runs" / "000000" / "run.json").read_bytes()
