"""Campaigns as archives, one a run, read by others; and over airports of public data."""

import csv
import json
import os
import shutil
import subprocess
import tarfile

import pytest
from campaign_test import CAMPAIGN, bytes_of, told

DATA = os.environ.get("FANBEAM_DATA", os.path.join(os.path.dirname(__file__), "../../../shared/data"))


@pytest.fixture(scope="module")
def both(program, tmp_path_factory):
    """The same campaign as folders and as archives, merged."""
    folder = tmp_path_factory.mktemp("both")
    texts = {"folders": CAMPAIGN, "archives": CAMPAIGN.replace("[parameters]", 'runs_as = "archives"\n[parameters]', 1)}
    for name, text in texts.items():
        (folder / f"{name}.toml").write_text(text, encoding="utf-8")
        told(program, "run", folder / f"{name}.toml", "-o", folder / name)
        told(program, "merge", folder / f"{name}.toml", "-o", folder / name)
        told(program, "verify", folder / f"{name}.toml", "-o", folder / name)
    return folder


def test_an_archive_holds_the_files_of_a_runs_folder(both):
    archives = sorted((both / "archives" / "runs").iterdir())
    assert [archive.name for archive in archives] == [f"{run:06}.tar" for run in range(6)]
    for archive in archives:
        folder = both / "folders" / "runs" / archive.stem
        with tarfile.open(archive) as tar:
            members = tar.getmembers()
            assert members[0].name == "run.json"
            assert all((m.mtime, m.uid, m.gid, m.mode) == (0, 0, 0, 0o644) for m in members)
            names = [m.name for m in members[1:]]
            assert names == sorted(names)
            in_folder = bytes_of(folder)
            assert set(in_folder) == {m.name for m in members}
            for member in members[1:]:
                assert tar.extractfile(member).read() == in_folder[member.name]
            record = json.load(tar.extractfile("run.json"))
        of_folder = json.loads((folder / "run.json").read_text(encoding="utf-8"))
        for of_the_file in ("campaign_sha256", "record_sha256"):
            assert record.pop(of_the_file) != of_folder.pop(of_the_file)
        assert record == of_folder
    # GNU tar reads them as well.
    listed = subprocess.run(["tar", "-tf", archives[0]], capture_output=True, text=True, check=True)
    assert listed.stdout.splitlines()[0] == "run.json"


def test_the_index_says_where_in_an_archive_a_picture_lies(both):
    with open(both / "archives" / "index.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    with open(both / "folders" / "index.csv", newline="", encoding="utf-8") as file:
        plain = list(csv.DictReader(file))
    assert len(rows) == len(plain) > 6
    for row, other in zip(rows, plain):
        for product in ("bscope", "power", "labels"):
            with open(both / "archives" / row[product], "rb") as file:
                file.seek(int(row[f"{product}_offset"]))
                found = file.read(int(row[f"{product}_bytes"]))
            assert found == (both / "folders" / other[product]).read_bytes()
    for name in ("coco.json", "lard.csv"):
        assert (both / "archives" / name).read_bytes() == (both / "folders" / name).read_bytes()


def test_what_merge_prints_makes_the_names_in_labels_true(program, both, tmp_path):
    campaign, folder = both / "archives.toml", tmp_path / "it's here"
    shutil.copytree(both / "archives", folder)
    assert ".tar" not in told(program, "merge", both / "folders.toml", "-o", both / "folders")
    command = told(program, "merge", campaign, "-o", folder).strip().splitlines()[-1]
    images = json.loads((folder / "coco.json").read_text(encoding="utf-8"))["images"]
    assert images and not (folder / images[0]["file_name"]).exists()
    subprocess.run(["sh", "-c", command], check=True)
    for image in images:
        assert (folder / image["file_name"]).read_bytes() == (both / "folders" / image["file_name"]).read_bytes()
    told(program, "verify", campaign, "-o", folder)
    assert "6 of 6 runs there" in told(program, "status", campaign, "-o", folder)


def test_archives_are_the_same_bytes_from_any_worker_and_damage_is_found(program, both, tmp_path):
    campaign = both / "archives.toml"
    for part in ("2/2", "1/2"):
        told(program, "run", campaign, "-o", tmp_path, "--shard", part, "--threads", "1", "-q")
    told(program, "merge", campaign, "-o", tmp_path)
    assert bytes_of(tmp_path) == bytes_of(both / "archives")
    assert "6 of 6 runs there" in told(program, "status", campaign, "-o", tmp_path)
    # A bit within a picture, an archive cut in the middle of a file, one cut in its record, one that is none.
    record = tmp_path / "runs" / "000001.tar"
    with tarfile.open(record) as tar:
        picture = next(m for m in tar if m.name.startswith("bscope/"))
        middle = picture.offset_data + picture.size // 2
    data = bytearray(record.read_bytes())
    data[middle] ^= 1
    record.write_bytes(data)
    for run, bytes_left in ((2, middle), (3, 700), (4, 0)):
        archive = tmp_path / "runs" / f"{run:06}.tar"
        archive.write_bytes(archive.read_bytes()[:bytes_left])
    said = told(program, "verify", campaign, "-o", tmp_path, exit_code=1)
    assert "run 1: bscope/" in said and "other bytes than recorded" in said
    assert "run 2: " in said and "missing" in said
    assert "run 3: run.json" in said and "run 4: run.json" in said
    command = said.strip().splitlines()[-1]
    assert command.endswith("--runs 1:5 --replace")
    assert "E-PARSE" in told(program, "merge", campaign, "-o", tmp_path, exit_code=3)
    subprocess.run([program, *command.split()[1:]], check=True, capture_output=True)
    told(program, "merge", campaign, "-o", tmp_path)
    assert bytes_of(tmp_path) == bytes_of(both / "archives")


def test_a_killed_worker_leaves_no_half_archive(program, both, tmp_path):
    campaign = both / "archives.toml"
    worker = subprocess.Popen([program, "campaign", "run", campaign, "-o", tmp_path, "-q"])
    while not list(tmp_path.glob("runs/0*")) and worker.poll() is None:
        pass
    worker.kill()
    worker.wait()
    for run in tmp_path.glob("runs/0*"):
        assert run.read_bytes() == (both / "archives" / "runs" / run.name).read_bytes()
    told(program, "run", campaign, "-o", tmp_path)
    told(program, "merge", campaign, "-o", tmp_path)
    assert bytes_of(tmp_path) == bytes_of(both / "archives")
    assert not list(tmp_path.glob("runs/.*"))


AIRPORTS = """
[campaign]
name = "airports"
plan = "grid"
frames = { count = 2, from = 0.5, to = 0.9 }
products = ["bscope", "labels"]
isa = "v2"
samples_per_cell = 1
[[airport]]
ident = "EDNY"
runway = "24"
file = "airports/runways_ourairports.csv"
elevation = "srtm-n47e009/N47E009.hgt"
[[airport]]
name = "other-end"
ident = "EDNY"
runway = "06"
file = "airports/runway_ends_derived.csv"
elevation = "srtm-n47e009/N47E009.hgt"
start_distance_m = 3000
glide_path_deg = 3.5
"""


def test_a_list_of_airports_over_elevation_data_is_a_list_of_scenes(program, tmp_path):
    if not os.path.isdir(os.path.join(DATA, "airports")):
        if os.environ.get("FANBEAM_REQUIRE_DATA") == "1":
            pytest.fail("shared data is required but missing")
        pytest.skip("needs shared data")
    file = tmp_path / "airports.toml"
    file.write_text(AIRPORTS, encoding="utf-8")
    folders = [tmp_path / "one", tmp_path / "two"]
    for folder in folders:
        told(program, "run", file, "-o", folder, "--data", DATA)
        told(program, "merge", file, "-o", folder)
    assert bytes_of(folders[0]) == bytes_of(folders[1])
    with open(folders[0] / "index.csv", newline="", encoding="utf-8") as index:
        rows = list(csv.DictReader(index))
    assert [row["scene"] for row in rows] == ["edny-24", "edny-24", "other-end", "other-end"]
    # Both land on the same runway, one from the west: published ends 47.6660 N 9.4979 E and 47.6766 N 9.5251 E.
    headings = [float(row["heading_deg"]) for row in rows]
    assert headings[0] == pytest.approx(240, abs=3) and headings[2] == pytest.approx(60, abs=3)
    label = json.loads((folders[0] / rows[0]["labels"]).read_text(encoding="utf-8"))
    (runway,) = label["runways"]
    assert {runway["near_end"], runway["far_end"]} == {"24", "06"}
    assert "scenes/edny-24/scene.toml" in bytes_of(folders[0])


def test_what_is_wrong_with_an_airport_is_told(program, tmp_path):
    file = tmp_path / "airports.toml"
    wrong = AIRPORTS.replace('name = "other-end"\n', 'name = "edny-24"\n').replace("glide_path_deg = 3.5", "glide_path_deg = 35")
    file.write_text(wrong, encoding="utf-8")
    said = told(program, "plan", file, "--no-pilot", exit_code=3)
    assert "airport[1].name" in said and "airport[1].glide_path_deg" in said
    file.write_text(AIRPORTS.replace("srtm-n47e009/N47E009.hgt", "nowhere.hgt"), encoding="utf-8")
    said = told(program, "run", file, "-o", tmp_path / "out", exit_code=3)
    failed = json.loads((tmp_path / "out" / "failed" / "000000.json").read_text(encoding="utf-8"))
    assert "nowhere.hgt" in failed["problems"][-1] and "2 failed" in said
