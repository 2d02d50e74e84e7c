"""Campaigns: which scene and sensor a run is made of, and that a change of them is found."""

import csv
import json
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
HEIGHT = "above_ground_m = 60.0"  # of flat-grass


# A file beside the campaign's and a shipped name; the working directory has another of each.
@pytest.mark.parametrize("sensor", ["radar.toml", "hivision-94"])
def test_scenes_and_sensors_are_not_those_of_the_working_directory(program, root, tmp_path, sensor):
    plain, decoys = tmp_path / "plain", tmp_path / "decoys"
    (decoys / "flat-grass").mkdir(parents=True)
    plain.mkdir()
    scene = (root / "scenes" / "flat-grass" / "scene.toml").read_text(encoding="utf-8")
    lower = scene.replace(HEIGHT, "above_ground_m = 50.0")
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


SCENES = (
    CAMPAIGN.replace('["flat-grass"]\nruns = 2', '["one", "two"]\nruns = 1\nplan = "grid"\nsensor = "radar.toml"')
    + "[parameters]\nweather.rain_rate_mm_per_h = { values = [0, 1, 2] }\n"
)


@pytest.fixture
def scenes(root, tmp_path):
    """Six runs of two scenes that call themselves by one name."""
    scene = (root / "scenes" / "flat-grass" / "scene.toml").read_text(encoding="utf-8")
    for name, height in (("one", HEIGHT), ("two", "above_ground_m = 55.0")):
        (tmp_path / name).mkdir()
        (tmp_path / name / "scene.toml").write_text(scene.replace(HEIGHT, height), encoding="utf-8")
    shutil.copy(root / "sensors" / "hivision-94.toml", tmp_path / "radar.toml")
    file = tmp_path / "inputs.toml"
    file.write_text(SCENES, encoding="utf-8")
    return file


@pytest.mark.parametrize("changed, by", [("two/scene.toml", "[weather]\nhumidity = 0.4\n"), ("radar.toml", "# a remark\n")])
def test_a_run_of_changed_files_is_told_and_not_merged(program, scenes, changed, by):
    output = scenes.parent / "out"
    told(program, "run", scenes, "-o", output, "--runs", "0:5", "-q")
    told(program, "verify", scenes, "-o", output, "--runs", "0:5")
    with open(scenes.parent / changed, "a", encoding="utf-8") as file:
        file.write(by)
    told(program, "run", scenes, "-o", output, "-q")
    said = told(program, "verify", scenes, "-o", output, exit_code=1)
    assert "run 5: made of other files of scene, sensor or terrain" in said and "than most of scene two" in said
    assert "1 of 6 runs are to be made again" in said
    said = told(program, "merge", scenes, "-o", output, exit_code=3)
    assert said.count("E-UNSUPPORTED") == 1 and "one state of each scene for all" in said
    assert not (output / "index.csv").exists()
    # All of the new files, whoever made them first.
    told(program, "run", scenes, "-o", output, "--replace", "-q")
    told(program, "verify", scenes, "-o", output)
    records = [json.loads(record.read_text(encoding="utf-8")) for record in sorted(output.glob("runs/*/run.json"))]
    assert [record["scene"] for record in records] == ["flat-grass"] * 6
    assert len({record["input"] for record in records}) == 6
    assert len({record["scene_input"] for record in records}) == 2


def test_the_index_tells_scenes_of_one_name_apart(program, scenes):
    output = scenes.parent / "out"
    told(program, "run", scenes, "-o", output, "--runs", "1,4", "-q")
    told(program, "merge", scenes, "-o", output)
    with open(output / "index.csv", newline="", encoding="utf-8") as index:
        assert [row["scene"] for row in csv.DictReader(index)] == ["one", "two"]
