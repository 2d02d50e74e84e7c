"""Campaigns: same bytes in any order, nothing lost by kills, damage found and repaired, labels of all runs."""

import csv
import hashlib
import json
import os
import shlex
import shutil
import signal
import subprocess
import time

import numpy as np
import pytest

CAMPAIGN = """
[campaign]
name = "small"
scenes = ["flat-grass", "obstacle-field"]
plan = "sobol"
runs = 6
seed = 7
frames = { count = 2, from = 0.4, to = 0.9 }
products = ["bscope", "power", "labels"]
isa = "v2"
realisation = "sample"
samples_per_cell = 1
[parameters]
scene = { values = ["obstacle-field", "flat-grass"], weights = [3, 1] }
surface = { values = ["dry", "wet"] }
weather.visibility_m = { log_uniform = [100, 2000] }
weather.rain_rate_mm_per_h = { values = [0, 2, 10] }
flight.lateral_m = { normal = [0, 10], within = [-30, 30] }
flight.turbulence_deg = 1
"""


def told(program, *arguments, exit_code=0, cwd=None):
    ended = subprocess.run([program, "campaign", *map(str, arguments)], capture_output=True, text=True, cwd=cwd)
    assert ended.returncode == exit_code, ended.stdout + ended.stderr
    return ended.stdout + ended.stderr


def bytes_of(folder):
    return {
        str(file.relative_to(folder)): file.read_bytes()
        for file in sorted(folder.rglob("*"))
        if file.is_file() and not file.name.startswith(".")
    }


@pytest.fixture(scope="module")
def campaign(tmp_path_factory):
    file = tmp_path_factory.mktemp("campaign") / "small.toml"
    file.write_text(CAMPAIGN, encoding="utf-8")
    return file


@pytest.fixture(scope="module")
def whole(program, campaign, tmp_path_factory):
    folder = tmp_path_factory.mktemp("whole")
    told(program, "run", campaign, "-o", folder)
    told(program, "merge", campaign, "-o", folder)
    return folder


def test_runs_have_the_same_bytes_in_any_order_and_for_any_number_of_threads(program, campaign, whole, tmp_path):
    for part in ("3/3", "1/3", "2/3"):
        told(program, "run", campaign, "-o", tmp_path, "--shard", part, "--threads", "1")
    assert "6 of 6 runs there" in told(program, "status", campaign, "-o", tmp_path)
    told(program, "merge", campaign, "-o", tmp_path)
    assert bytes_of(tmp_path) == bytes_of(whole)


def test_two_workers_make_every_run_once(program, campaign, whole, tmp_path):
    command = [program, "campaign", "run", campaign, "-o", tmp_path]
    workers = [subprocess.Popen(command, stdout=subprocess.PIPE, text=True) for _ in range(2)]
    made = sum(int(worker.communicate()[0].splitlines()[-1].split()[0]) for worker in workers)
    assert [worker.returncode for worker in workers] == [0, 0]
    assert made == 6
    told(program, "verify", campaign, "-o", tmp_path)
    told(program, "merge", campaign, "-o", tmp_path)
    assert bytes_of(tmp_path) == bytes_of(whole)


@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGTERM])
def test_a_killed_worker_leaves_no_half_run(program, campaign, whole, tmp_path, how):
    worker = subprocess.Popen([program, "campaign", "run", campaign, "-o", tmp_path, "-q"])
    while not list(tmp_path.glob("runs/0*")) and worker.poll() is None:
        time.sleep(0.005)
    worker.send_signal(how)
    worker.wait()
    for run in tmp_path.glob("runs/0*"):
        assert bytes_of(run) == bytes_of(whole / "runs" / run.name)
    told(program, "run", campaign, "-o", tmp_path)
    told(program, "merge", campaign, "-o", tmp_path)
    assert bytes_of(tmp_path) == bytes_of(whole)
    assert not list(tmp_path.glob("runs/.*"))


def test_a_pilot_counts_each_scene_by_its_share_of_the_runs(program, tmp_path):
    file = tmp_path / "shares.toml"
    # Half of the runs have five frames, half have one, of a scene that stands still.
    text = CAMPAIGN.replace('plan = "sobol"\nruns = 6', 'plan = "grid"\nruns = 4').split("[parameters]")[0]
    text = text.replace("count = 2", "count = 5").replace('["bscope", "power", "labels"]', '["power"]')
    file.write_text(text + '[parameters]\nsurface = { values = ["dry", "wet"] }\n', encoding="utf-8")
    said = told(program, "plan", file)
    pilot = next(line for line in said.splitlines() if line.startswith("pilot of "))
    assert pilot.startswith("pilot of 4 runs of 2 scenes on ") and " s to open a scene; " in pilot
    told(program, "run", file, "-o", tmp_path / "out", "-q")
    size = sum(len(data) for name, data in bytes_of(tmp_path / "out" / "runs").items() if not name.endswith("run.json"))
    assert float(pilot.split("all of it ")[1].split(" MB")[0]) == pytest.approx(size / 1e6, rel=0.1, abs=0.06)


def test_a_plan_tells_why_runs_of_its_pilot_would_be_refused(program, root, tmp_path):
    scene = (root / "scenes" / "flat-grass" / "scene.toml").read_text(encoding="utf-8")
    (tmp_path / "own").mkdir()
    (tmp_path / "own" / "scene.toml").write_text(scene + "\n[weathr]\nhumidity = 0.4\n", encoding="utf-8")
    file = tmp_path / "refused.toml"
    file.write_text(CAMPAIGN.replace("flat-grass", "own"), encoding="utf-8")
    said = told(program, "plan", file, exit_code=3)
    assert "would be refused: run " in said and " of own: " in said
    assert "E-REF weathr = unknown key" in said and said.count("would be refused") == 1
    assert " of 1 scene on " in said


def test_a_scene_and_a_sensor_that_are_not_there_are_refused_before_anything_runs(program, tmp_path):
    file = tmp_path / "nowhere.toml"
    text = CAMPAIGN.replace("flat-grass", "flat-gras").replace('isa = "v2"', 'isa = "v2"\nsensor = "hivisoin"')
    file.write_text(text, encoding="utf-8")
    for task in (["plan", file], ["run", file, "-o", tmp_path / "out"]):
        said = told(program, *task, exit_code=3)
        assert 'nowhere.toml:4:1: E-REF campaign.scenes = "flat-gras" not found' in said
        assert 'E-REF campaign.sensor = "hivisoin" not found' in said
        assert said.endswith("\n2 errors\n")
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGTERM])
def test_a_stopped_pilot_leaves_nothing(program, campaign, tmp_path, how):
    plan = subprocess.Popen([program, "campaign", "plan", campaign], env={**os.environ, "TMPDIR": str(tmp_path)})
    while not list(tmp_path.glob("fanbeam-pilot-*/runs")) and plan.poll() is None:
        time.sleep(0.002)
    plan.send_signal(how)
    assert plan.wait() == -how
    assert not list(tmp_path.iterdir())


def test_another_level_of_instructions_than_the_files_is_refused(program, tmp_path):
    file = tmp_path / "small.toml"
    file.write_text(CAMPAIGN.replace('isa = "v2"', 'isa = "v3"'), encoding="utf-8")
    for task in (["plan", file, "--no-pilot"], ["run", file, "-o", tmp_path / "out", "--runs", "0"]):
        said = told(program, *task, "--isa", "v2", exit_code=2)
        assert "E-RANGE --isa = v2" in said and "v3" in said
    assert not (tmp_path / "out").exists()
    file.write_text(CAMPAIGN, encoding="utf-8")
    told(program, "plan", file, "--no-pilot", "--isa", "v2")


def test_the_command_that_repairs_is_what_a_shell_takes_back(program, tmp_path):
    folder = tmp_path / "it's $HOME"
    (folder / "data 1").mkdir(parents=True)
    file = folder / "small.toml"
    file.write_text(CAMPAIGN, encoding="utf-8")
    words = ["-o", folder / "out", "--runs", "0:1"]
    said = told(program, "verify", file, *words, "--data", folder / "data 1", exit_code=1)
    command = shlex.split(said.strip().splitlines()[-1])
    assert command == [
        *("fanbeam", "campaign", "run", str(file), "-o", str(folder / "out"), "--data", str(folder / "data 1")),
        *("--runs", "0", "--replace"),
    ]  # fmt: skip
    subprocess.run([program, *command[1:], "-q"], check=True, capture_output=True)
    told(program, "verify", file, *words)


def test_verify_finds_damage_and_prints_what_repairs_it(program, campaign, whole, tmp_path):
    told(program, "run", campaign, "-o", tmp_path, "-q")
    assert "every file as recorded" in told(program, "verify", campaign, "-o", tmp_path)
    picture = next((tmp_path / "runs" / "000002").glob("bscope/*.png"))
    data = bytearray(picture.read_bytes())
    data[-20] ^= 1
    picture.write_bytes(data)
    next((tmp_path / "runs" / "000004").glob("labels/*.json")).unlink()
    record = tmp_path / "runs" / "000005" / "run.json"
    record.write_text(record.read_text(encoding="utf-8")[:-40], encoding="utf-8")
    said = told(program, "verify", campaign, "-o", tmp_path, exit_code=1)
    assert "run 2: bscope/" in said and "run 4: labels/" in said and "run 5: run.json" in said
    command = said.strip().splitlines()[-1]
    assert command.endswith("--runs 2,4:6 --replace")
    subprocess.run([program, *command.split()[1:]], check=True, capture_output=True)
    told(program, "verify", campaign, "-o", tmp_path)
    told(program, "merge", campaign, "-o", tmp_path)
    assert bytes_of(tmp_path) == bytes_of(whole)


def test_verify_finds_a_changed_record_and_takes_one_of_an_earlier_version(program, campaign, tmp_path):
    told(program, "run", campaign, "-o", tmp_path, "--runs", "0:2", "-q")
    record = tmp_path / "runs" / "000001" / "run.json"
    text = record.read_text(encoding="utf-8")
    visibility = json.loads(text)["parameters"]["weather.visibility_m"]
    record.write_text(text.replace(f'"weather.visibility_m": {visibility}', '"weather.visibility_m": 500.0'), encoding="utf-8")
    said = told(program, "verify", campaign, "-o", tmp_path, "--runs", "0:2", exit_code=1)
    assert "run 1: run.json: other bytes than recorded" in said and "1 of 2 runs" in said
    old = json.loads(text)
    assert list(old)[-1] == "record_sha256"
    del old["record_sha256"]
    record.write_text(json.dumps(old), encoding="utf-8")
    said = told(program, "verify", campaign, "-o", tmp_path, "--runs", "0:2", exit_code=1)
    assert "run 1: run.json: without its seal" in said
    # An earlier program had none.
    for run in ("000000", "000001"):
        file = tmp_path / "runs" / run / "run.json"
        old = {**json.loads(file.read_text(encoding="utf-8")), "commit": "0123456789ab"}
        old.pop("record_sha256", None)
        file.write_text(json.dumps(old), encoding="utf-8")
    told(program, "verify", campaign, "-o", tmp_path, "--runs", "0:2")


def test_a_record_of_other_types_is_told_and_the_other_runs_are_judged(program, campaign, tmp_path):
    told(program, "run", campaign, "-o", tmp_path, "--runs", "0:2", "-q")
    next((tmp_path / "runs" / "000001").glob("labels/*.json")).unlink()
    record = tmp_path / "runs" / "000000" / "run.json"
    whole = json.loads(record.read_text(encoding="utf-8"))
    name = next(iter(whole["files"]))
    for wrong in (
        {"run": "0"},
        {"campaign_sha256": 5},
        {"files": {**whole["files"], name: {"sha256": None}}},
        {"files": {**whole["files"], name: {"sha256": 5}}},
    ):
        record.write_text(json.dumps({**whole, **wrong}), encoding="utf-8")
        said = told(program, "verify", campaign, "-o", tmp_path, "--runs", "0:2", exit_code=1)
        assert "run 0: run.json: no record of a run" in said and "run 1: labels/" in said


def test_runs_of_other_values_and_beyond_the_file_are_damage(program, campaign, tmp_path):
    """As of a grid that an earlier version made twice as long."""
    told(program, "run", campaign, "-o", tmp_path, "-q")
    runs = tmp_path / "runs"
    record = json.loads((runs / "000001" / "run.json").read_text(encoding="utf-8"))
    del record["record_sha256"]
    record["parameters"]["surface"] = "dry" if record["parameters"]["surface"] == "wet" else "wet"
    (runs / "000001" / "run.json").write_text(json.dumps(record), encoding="utf-8")
    shutil.copytree(runs / "000002", runs / "000006")
    said = told(program, "verify", campaign, "-o", tmp_path, exit_code=1)
    assert "run 1: other values than the campaign's file gives: surface" in said
    assert "run 6: beyond the 6 runs of small.toml" in said
    assert said.strip().splitlines()[-1].endswith("--runs 1 --replace")
    said = told(program, "merge", campaign, "-o", tmp_path, exit_code=3)
    assert "other values" in said and "beyond the 6 runs" in said and not (tmp_path / "index.csv").exists()
    told(program, "run", campaign, "-o", tmp_path, "--runs", "1", "--replace", "-q")
    assert "run 6:" in told(program, "verify", campaign, "-o", tmp_path, exit_code=1)
    shutil.rmtree(runs / "000006")
    told(program, "verify", campaign, "-o", tmp_path)


def test_a_grid_with_weights_of_an_earlier_version_can_be_looked_at_alone(program, tmp_path):
    file, output = tmp_path / "small.toml", tmp_path / "out"
    head = CAMPAIGN.split("[parameters]")[0].replace('plan = "sobol"\nruns = 6', 'plan = "grid"\nruns = 1')
    even = head + '[parameters]\nscene = "flat-grass"\nsurface = { values = ["dry", "wet"] }\n'
    file.write_text(even, encoding="utf-8")
    told(program, "run", file, "-o", output, "-q")
    file.write_text(even.replace('"wet"] }', '"wet"], weights = [3, 1] }'), encoding="utf-8")
    for run in (output / "runs").iterdir():
        record = json.loads((run / "run.json").read_text(encoding="utf-8"))
        del record["record_sha256"]
        record["commit"] = "0123456789ab"
        record["campaign_sha256"] = hashlib.sha256(file.read_bytes()).hexdigest()
        (run / "run.json").write_text(json.dumps(record), encoding="utf-8")
    for task in ("status", "merge", "verify"):
        assert "W-NO-WEIGHTS" in told(program, task, file, "-o", output)
    for task in (["plan", file, "--no-pilot"], ["run", file, "-o", output], ["slurm", file, "-o", tmp_path / "job.sh"]):
        assert "E-REF" in told(program, *task, exit_code=3)


def test_mixtures_are_refused(program, campaign, tmp_path):
    folder = tmp_path / "out"
    told(program, "run", campaign, "-o", folder, "--runs", "0:4", "-q")
    record = folder / "runs" / "000001" / "run.json"
    json_text = json.loads(record.read_text(encoding="utf-8"))
    record.write_text(json.dumps({**json_text, "isa": "v4"}), encoding="utf-8")
    assert "v4" in told(program, "verify", campaign, "-o", folder, "--runs", "0:4", exit_code=1)
    assert "E-UNSUPPORTED" in told(program, "merge", campaign, "-o", folder, exit_code=3)
    assert not (folder / "index.csv").exists()
    # The same of runs that another version of the file made.
    record.write_text(json.dumps(json_text), encoding="utf-8")
    other = tmp_path / "small.toml"
    other.write_text(CAMPAIGN.replace("seed = 7", "seed = 8"), encoding="utf-8")
    assert "another version" in told(program, "verify", other, "-o", folder, "--runs", "0:4", exit_code=1)


def test_a_changed_file_is_told_once_and_early(program, campaign, tmp_path):
    folder, other = tmp_path / "out", tmp_path / "small.toml"
    told(program, "run", campaign, "-o", folder, "--runs", "0:4", "-q")
    other.write_text(CAMPAIGN + "# changed\n", encoding="utf-8")
    assert "W-CHANGED" not in told(program, "status", campaign, "-o", folder)
    for task in (["status", other, "-o", folder], ["run", other, "-o", folder, "--runs", "0:2"]):
        assert told(program, *task).count("W-CHANGED") == 1
    # By the first run of another file, whichever of those there it is.
    mixed = tmp_path / "mixed"
    told(program, "run", other, "-o", mixed, "--runs", "0", "-q")
    told(program, "run", campaign, "-o", mixed, "--runs", "1", "-q")
    assert told(program, "run", other, "-o", mixed, "--runs", "0:2").count("W-CHANGED") == 1
    said = told(program, "merge", other, "-o", folder, exit_code=3)
    assert "changed since 4 of 4 runs were made" in said and said.count("E-UNSUPPORTED") == 1
    assert "one program for all" not in said


def test_a_missing_file_of_a_run_in_a_folder_is_no_archive(program, campaign, tmp_path):
    told(program, "run", campaign, "-o", tmp_path, "--runs", "0", "-q")
    gone = next((tmp_path / "runs" / "000000").glob("labels/*.json"))
    gone.unlink()
    said = told(program, "merge", campaign, "-o", tmp_path, exit_code=4)
    assert f"{gone.name}: E-IO file = missing" in said and "archive" not in said


def test_what_is_no_campaigns_folder_stays_as_it_is(program, campaign, tmp_path):
    assert "E-IO" in told(program, "merge", campaign, "-o", tmp_path / "none", exit_code=4)
    assert "6 missing" in told(program, "status", campaign, "-o", tmp_path / "none")
    assert not (tmp_path / "none").exists()


def test_one_bad_run_does_not_stop_the_others(program, tmp_path):
    file = tmp_path / "bad.toml"
    # Fog below -40 C is refused by the weather.
    file.write_text(
        CAMPAIGN.replace('plan = "sobol"\nruns = 6', 'plan = "grid"\nruns = 1')
        .split("[parameters]")[0]
        .replace('["flat-grass", "obstacle-field"]', '["flat-grass"]')
        + "[parameters]\nweather.visibility_m = 200\nweather.temperature_C = { values = [10, -50, 0] }\n",
        encoding="utf-8",
    )
    assert "would be refused: 1 run" in told(program, "plan", file, "--no-pilot", exit_code=3)
    # Told once, and neither flown nor counted by the pilot.
    said = told(program, "plan", file, exit_code=3)
    assert said.count("would be refused") == 1
    all_MB = float(said.split("all of it ")[1].split(" MB")[0])
    said = told(program, "run", file, "-o", tmp_path / "out", exit_code=3)
    assert "2 of 3 runs made" in said and "1 failed" in said
    size = sum(len(data) for name, data in bytes_of(tmp_path / "out" / "runs").items() if not name.endswith("run.json"))
    assert all_MB == pytest.approx(size / 1e6, rel=0.1, abs=0.06)
    failed = json.loads((tmp_path / "out" / "failed" / "000001.json").read_text(encoding="utf-8"))
    assert "E-RANGE" in failed["problems"][0] and failed["parameters"]["weather.temperature_C"] == -50
    assert json.loads(told(program, "status", file, "-o", tmp_path / "out", "--json")) == {
        "campaign": "small", "runs": 3, "made": 2, "under_way": 0, "failed": 1, "missing": 0,
    }  # fmt: skip
    assert "run 1: failed" in told(program, "verify", file, "-o", tmp_path / "out", exit_code=1)


def test_a_full_disk_loses_nothing(program, campaign, whole, tmp_path):
    # As a file too large: 30 kB, less than a frame's layers of power.
    command = f"ulimit -f 30; exec {program} campaign run {campaign} -o {tmp_path} -q"
    ended = subprocess.run(["bash", "-c", command], capture_output=True, text=True)
    assert ended.returncode == 4 and "E-IO" in ended.stderr
    assert not list(tmp_path.glob("runs/0*")) and not (tmp_path / "failed").exists()
    told(program, "run", campaign, "-o", tmp_path, "-q")
    told(program, "merge", campaign, "-o", tmp_path)
    assert bytes_of(tmp_path) == bytes_of(whole)


def test_bad_files_tell_all_problems_with_their_lines(program, tmp_path):
    file = tmp_path / "wrong.toml"
    file.write_text(
        """[campaign]
name = "a b"
scenes = []
runs = 0
plan = "lattice"
frames = { count = 0, from = 0.9, to = 0.1 }
products = ["bscop"]
sead = 3
[parameters]
surface = "moist"
weather.visibility_m = { log_uniform = [-1, 100] }
weather.rain_rate_mm_per_h = { values = [1, 900] }
weather.humidity = { uniform = [0.2, 0.8], values = [0.5] }
flight.lateral_m = { normal = [0, -1], within = [5, -5] }
flight.sidewards_m = 3
[[traffic]]
name = "car"
rcs_m2 = -4
""",
        encoding="utf-8",
    )
    said = told(program, "plan", file, exit_code=3)
    for line in (2, 3, 4, 5, 6, 7, 8, 10, 11, 12, 13, 14, 15, 18):
        assert f"wrong.toml:{line}:" in said, (line, said)
    assert "bscope" in said and "seed" in said and "lateral_m" in said


def test_the_example_is_what_its_page_shows(program, root, tmp_path):
    example = root / "datasets" / "example.toml"
    assert "24 runs (sobol) of at most 5 frames, 120 in all" in told(program, "plan", example, "--no-pilot")
    shown = (root / "docs" / "campaigns.md").read_text(encoding="utf-8")
    for line in example.read_text(encoding="utf-8").splitlines()[1:]:
        assert f"    {line}\n" in shown or not line
    said = told(program, "run", example, "-o", tmp_path, "--runs", "0:2")
    assert "2 of 2 runs made" in said


def test_the_plan_covers_its_ranges(program, tmp_path):
    file = tmp_path / "many.toml"
    text = CAMPAIGN.replace("runs = 6", "runs = 1024")
    file.write_text(text, encoding="utf-8")
    begin = time.monotonic()
    said = told(program, "plan", file, "--no-pilot")
    assert time.monotonic() - begin < 20
    assert "1024 runs (sobol) of at most 2 frames, 2048 in all" in said
    # A Sobol plan of 2^k runs hits a choice of three to four as often as its weights say, to one.
    counts = next(line for line in said.splitlines() if line.strip().startswith("scene "))
    assert abs(int(counts.split("obstacle-field in ")[1].split()[0].rstrip(",")) - 768) <= 1


def test_draws_follow_their_distributions(program, tmp_path):
    file = tmp_path / "draws.toml"
    file.write_text(
        """[campaign]
name = "draws"
scenes = ["flat-grass"]
runs = 160
plan = "random"
frames = { count = 1 }
products = ["bscope"]
samples_per_cell = 0.3
isa = "v2"
[parameters]
weather.visibility_m = { log_uniform = [100, 1600] }
flight.vertical_m = { normal = [5, 4], within = [-20, 30] }
surface = { values = ["dry", "wet"], weights = [3, 1] }
""",
        encoding="utf-8",
    )
    told(program, "run", file, "-o", tmp_path / "out", "-q")
    told(program, "merge", file, "-o", tmp_path / "out", "-q")
    with open(tmp_path / "out" / "index.csv", encoding="utf-8", newline="") as table:
        rows = list(csv.DictReader(table))
    assert len(rows) == 160 and [int(row["run"]) for row in rows] == list(range(160))
    fog = np.log([float(row["weather.visibility_m"]) for row in rows])
    up = np.array([float(row["flight.vertical_m"]) for row in rows])
    # Kolmogorov-Smirnov at 1 in 1000: 1.95 / sqrt(n).
    even = np.sort((fog - np.log(100)) / np.log(16))
    assert np.abs(even - (np.arange(160) + 0.5) / 160).max() < 1.95 / np.sqrt(160)
    assert abs(up.mean() - 5) < 4 * 4 / np.sqrt(160) and abs(up.std() - 4) < 0.9
    wet = sum(row["surface"] == "wet" for row in rows)
    assert abs(wet - 40) < 4 * np.sqrt(160 * 0.25 * 0.75)
    # And the flight does as it is told.
    heights = np.array([float(row["height_m"]) for row in rows])
    assert np.allclose(heights - heights[0], up - up[0], atol=1e-9)


def test_merged_labels_name_the_pictures(whole):
    coco = json.loads((whole / "coco.json").read_text(encoding="utf-8"))
    with open(whole / "index.csv", encoding="utf-8", newline="") as table:
        frames = len(list(csv.DictReader(table)))
    assert len(coco["images"]) == frames >= 10  # one scene stands still: its frames are one
    assert all((whole / image["file_name"]).is_file() for image in coco["images"])
    manifest = json.loads((whole / "manifest.json").read_text(encoding="utf-8"))
    assert len(manifest["runs"]) == 6
    with open(whole / "index.csv", encoding="utf-8", newline="") as table:
        for row in csv.DictReader(table):
            assert (whole / row["bscope"]).is_file() and (whole / row["labels"]).is_file()
    assert os.access(whole / "index.csv", os.R_OK)


def test_a_picture_says_where_the_traffic_of_its_run_stands(program, tmp_path):
    file = tmp_path / "moved.toml"
    file.write_text(
        """
[campaign]
name = "moved"
scenes = ["obstacle-field"]
plan = "grid"
runs = 2
frames = { count = 1 }
products = ["bscope"]
samples_per_cell = 0.3
isa = "v2"
[[traffic]]
name = "van"
along_m = { values = [300, 900] }
""",
        encoding="utf-8",
    )
    told(program, "run", file, "-o", tmp_path / "out", "-q")
    records = [json.loads(record.read_text(encoding="utf-8")) for record in sorted(tmp_path.glob("out/runs/*/run.json"))]
    assert len({record["parameters"]["traffic.van.along_m"] for record in records}) == 2
    assert len({record["input"] for record in records}) == 2
