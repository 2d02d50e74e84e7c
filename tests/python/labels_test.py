"""Labels: positions by an independent formula, masks by an independent decoder, files by their schemas."""

import csv
import json
import subprocess

import fanbeam
import jsonschema
import numpy as np
import pytest

# WGS 84 (NIMA TR8350.2)
A_m, F = 6378137.0, 1 / 298.257223563
E2 = F * (2 - F)


def ecef(latitude_deg, longitude_deg, height_m):
    phi, lam = np.radians(latitude_deg), np.radians(longitude_deg)
    n = A_m / np.sqrt(1 - E2 * np.sin(phi) ** 2)
    return np.array(
        [(n + height_m) * np.cos(phi) * np.cos(lam), (n + height_m) * np.cos(phi) * np.sin(lam), (n * (1 - E2) + height_m) * np.sin(phi)]
    )


def pixels(pose, place, sensor):
    """B-scope and C-scope pixels of a place, for a stabilised antenna at the aircraft's own position."""
    phi, lam = np.radians(pose["latitude_deg"]), np.radians(pose["longitude_deg"])
    away = ecef(*place) - ecef(pose["latitude_deg"], pose["longitude_deg"], pose["height_m"])
    north = np.array([-np.sin(phi) * np.cos(lam), -np.sin(phi) * np.sin(lam), np.cos(phi)]) @ away
    east = np.array([-np.sin(lam), np.cos(lam), 0.0]) @ away
    up = np.array([np.cos(phi) * np.cos(lam), np.cos(phi) * np.sin(lam), np.sin(phi)]) @ away
    azimuth = np.arctan2(east, north) - np.radians(pose["heading_deg"])
    azimuth = (azimuth + np.pi) % (2 * np.pi) - np.pi
    slant_m = np.sqrt(north**2 + east**2 + up**2)
    x = (azimuth / sensor["field_of_view_rad"] + 0.5) * sensor["columns"]
    y = sensor["range_cells"] - (slant_m - sensor["range_minimum_m"]) / sensor["range_cell_m"]
    elevation = np.arcsin(up / slant_m)
    return x, y, (sensor["cscope_top_rad"] - elevation) / sensor["cscope_span_rad"] * sensor["cscope_rows"]


def decoded(mask, rows, columns):
    """COCO's uncompressed run lengths, the slow and obvious way."""
    cells, value = [], 0
    for count in mask["runs"]:
        cells += [value] * count
        value = 1 - value
    assert len(cells) == rows * columns
    return np.array(cells, bool).reshape(columns, rows).T


def places_in(thing):
    if isinstance(thing, dict):
        if "in_sight" in thing:
            yield thing
        else:
            for value in thing.values():
                yield from places_in(value)
    elif isinstance(thing, list):
        for value in thing:
            yield from places_in(value)


@pytest.fixture(scope="module")
def approach(program, tmp_path_factory):
    folder = tmp_path_factory.mktemp("labels")
    subprocess.run(
        [program, "render", "braunschweig-26", "--frames", "700:1201:250", "-q", "-o", folder]
        + ["--products", "bscope,cscope,labels,masks,cscope_masks"],
        check=True,
    )
    return folder


@pytest.fixture(scope="module")
def scene():
    return fanbeam.Scene.open("braunschweig-26")


def test_positions_agree_with_an_independent_formula(scene):
    # The scene's antenna is mounted at the aircraft's reference point and stabilised.
    labels = scene.render(950, labels=True).labels
    compared = 0
    for place in places_in(labels):
        if place["bscope"] is None or place["range_m"] < 10:
            continue
        x, y, y_cscope = pixels(labels["pose"], (place["latitude_deg"], place["longitude_deg"], place["height_m"]), scene.facts)
        assert abs(place["bscope"]["x"] - x) < 0.1 and abs(place["bscope"]["y"] - y) < 0.1
        assert abs(place["cscope"]["x"] - x) < 0.1 and abs(place["cscope"]["y"] - y_cscope) < 0.1
        compared += 1
    assert compared > 100


def test_corners_are_those_of_the_published_runway(scene):
    # Braunschweig 08/26 is 2300 x 45 m: corners from its ends by the sphere's formulas, to a metre.
    runway = scene.render(950, labels=True).labels["runways"][0]
    assert (runway["near_end"], runway["far_end"]) == ("26", "08")
    corners = [ecef(*(runway["corners"][name][key] for key in ("latitude_deg", "longitude_deg", "height_m")))
               for name in ("near_left", "near_right", "far_right", "far_left")]
    lengths = [np.linalg.norm(corners[(i + 1) % 4] - corners[i]) for i in range(4)]
    assert lengths == pytest.approx([45.0, 2300.0, 45.0, 2300.0], abs=1.5)
    near_left, near_right = (runway["corners"][name] for name in ("near_left", "near_right"))
    assert near_left["azimuth_deg"] < near_right["azimuth_deg"]
    assert near_left["bscope"]["y"] > runway["corners"]["far_left"]["bscope"]["y"]
    zone = runway["touchdown_zone"]
    deep = ecef(*(zone["far_left"][key] for key in ("latitude_deg", "longitude_deg", "height_m")))
    assert np.linalg.norm(deep - corners[0]) == pytest.approx(900.0, abs=1.0)
    assert runway["in_view_share"] == 1.0 and runway["in_sight_share"] > 0.95


def test_masks_are_the_cells_whose_strongest_echo_has_the_id(scene):
    frame = scene.render(950, labels=True, layers=True, cscope_layers=True)
    names = np.array(scene.objects)
    for scope, layers in (("bscope", frame.layers), ("cscope", frame.cscope_layers)):
        seen = layers["object"]
        rows, columns = seen.shape
        assert rows == frame.labels[scope]["rows"] and columns == frame.labels[scope]["columns"]
        runway = np.isin(seen, np.flatnonzero([name.startswith("runway 08/26") for name in names]))
        assert np.array_equal(decoded(frame.labels["runways"][0][scope], rows, columns), runway)
        covered = np.zeros(seen.shape, bool)
        for thing in frame.labels["objects"]:
            mask = decoded(thing[scope], rows, columns)
            assert np.array_equal(mask, np.isin(seen, thing["ids"]))
            assert mask.sum() == thing[scope]["cells"]
            if mask.any():
                left, top, width, height = thing[scope]["box"]
                assert np.array_equal(np.flatnonzero(mask.any(axis=0))[[0, -1]], [left, left + width - 1])
                assert np.array_equal(np.flatnonzero(mask.any(axis=1))[[0, -1]], [top, top + height - 1])
            covered |= mask
        kinds = names[seen]
        bare = np.array([name == "terrain" or name.startswith(("surface ", "runway 08/26")) for name in kinds.ravel()])
        assert np.array_equal(covered, ~bare.reshape(seen.shape))


def test_the_truck_on_the_runway_stands_out(scene):
    labels = scene.render(950, labels=True).labels
    truck = next(thing for thing in labels["objects"] if thing["name"] == "truck")
    assert truck["group"] == "model" and truck["placement"] == "on_runway" and truck["view"] == "in_view"
    assert truck["signal_to_clutter_dB"] > 10 and truck["in_sight_share"] > 0.5
    assert 2.0 < truck["height_m"] < 5.0
    fence = next(thing for thing in labels["objects"] if thing["name"] == "fence post")
    assert fence["placement"] == "elsewhere"
    lights = next(thing for thing in labels["objects"] if thing["name"] == "approach light")
    assert lights["group"] == "lights" and len(lights["points"]) == len(lights["ids"]) > 10


def test_what_stands_behind_a_hill_is_hidden(tmp_path):
    # A wall 30 m high and 400 m wide, 1 km ahead; one box 300 m behind it, one beside it.
    (tmp_path / "scene.toml").write_text(
        """
[scene]
name = "hill"
origin = { latitude_deg = 52.0, longitude_deg = 10.0, height_m = 0.0 }
vertical_datum = "scene"
earth = "plane"
[terrain]
generator = "plane"
material = "short_grass"
half_extent_m = 4000.0
spacing_m = 20.0
[trajectory.fixed]
at = { latitude_deg = 52.0, longitude_deg = 10.0 }
above_ground_m = 30.0
heading_deg = 0.0
[[box]]
name = "wall"
at = { latitude_deg = 52.009, longitude_deg = 10.0 }
length_m = 10.0
width_m = 400.0
height_m = 40.0
[[box]]
name = "behind"
at = { latitude_deg = 52.0117, longitude_deg = 10.0 }
length_m = 20.0
width_m = 20.0
height_m = 10.0
[[box]]
name = "beside"
at = { latitude_deg = 52.0117, longitude_deg = 10.004 }
length_m = 20.0
width_m = 20.0
height_m = 10.0
""",
        encoding="utf-8",
    )
    labels = fanbeam.Scene.open(tmp_path).render(0, labels=True).labels
    by_name = {thing["name"]: thing for thing in labels["objects"]}
    assert by_name["behind"]["in_sight_share"] == 0.0 and by_name["behind"]["bscope"]["cells"] == 0
    assert by_name["behind"]["view"] == "in_view" and not by_name["behind"]["middle"]["in_sight"]
    # Its own face stands before a box's middle, and says nothing of the wall.
    assert by_name["beside"]["middle"]["in_sight"] and by_name["wall"]["middle"]["in_sight"]
    assert by_name["behind"]["signal_to_clutter_dB"] is None
    assert by_name["beside"]["in_sight_share"] == 1.0 and by_name["beside"]["bscope"]["cells"] > 0
    assert by_name["wall"]["in_sight_share"] == 1.0


def test_files_hold_their_schema(approach, root):
    schema = json.loads((root / "docs" / "labels.schema.json").read_text(encoding="utf-8"))
    validator = jsonschema.Draft202012Validator(schema)
    validator.check_schema(schema)
    run = json.loads((approach / "labels.json").read_text(encoding="utf-8"))
    validator.validate(run)
    assert [frame["frame"] for frame in run["frames"]] == [700, 950, 1200]
    alone = json.loads((approach / "labels" / "00950.json").read_text(encoding="utf-8"))
    validator.validate(alone)
    assert alone == run["frames"][1]
    assert not validator.is_valid({**alone, "frame": -1})


def test_coco_is_what_its_readers_expect(approach):
    coco = json.loads((approach / "coco.json").read_text(encoding="utf-8"))
    images = {image["id"]: image for image in coco["images"]}
    categories = {category["id"]: category for category in coco["categories"]}
    assert len(images) == 6 and len(categories) == 6
    assert all((approach / image["file_name"]).is_file() for image in images.values())
    assert len({note["id"] for note in coco["annotations"]}) == len(coco["annotations"])
    seen_runways = 0
    for note in coco["annotations"]:
        image = images[note["image_id"]]
        rows, columns = note["segmentation"]["size"]
        assert (rows, columns) == (image["height"], image["width"])
        mask = decoded({"runs": note["segmentation"]["counts"]}, rows, columns)
        assert mask.sum() == note["area"] > 0
        if categories[note["category_id"]]["name"] != "runway":
            assert "keypoints" not in note
            continue
        seen_runways += 1
        points = np.array(note["keypoints"]).reshape(4, 3)
        assert note["num_keypoints"] == np.count_nonzero(points[:, 2])
        assert np.all((points[:, 0] >= 0) & (points[:, 0] <= columns) & (points[:, 1] <= rows))
        if note["num_keypoints"] == 4:
            # The cells of a runway lie between its corners, and on its shoulders: 7.5 m beside 22.5 m.
            left, top, width, height = note["bbox"]
            beside = np.ptp(points[:, 0]) / 6 + 1
            assert left >= points[:, 0].min() - beside and left + width <= points[:, 0].max() + beside
            assert top >= points[:, 1].min() - 1 and top + height <= points[:, 1].max() + 1
    assert seen_runways == 6


def test_a_runway_beyond_the_gate_is_in_neither_picture(program, tmp_path):
    # The gate ends at 3695 m, the near threshold is 5009 m off; both pictures' other limits hold the corners.
    products = ["--products", "bscope,cscope,labels", "--rays-per-cell", "1", "-q", "-o", tmp_path]
    subprocess.run([program, "render", "braunschweig-26", "--frames", "0", *products], check=True)
    (frame,) = json.loads((tmp_path / "labels.json").read_text(encoding="utf-8"))["frames"]
    for corner in frame["runways"][0]["corners"].values():
        assert corner["range_m"] > 5000
        assert 0 < corner["cscope"]["x"] < 164 and 0 < corner["cscope"]["y"] < 524
        assert not corner["bscope"]["inside"] and not corner["cscope"]["inside"]
    notes = json.loads((tmp_path / "coco.json").read_text(encoding="utf-8"))["annotations"]
    assert all(note["category_id"] != 1 and note["area"] > 0 for note in notes)
    assert len((tmp_path / "lard.csv").read_text(encoding="utf-8").splitlines()) == 1


def test_lard_rows_have_its_conventions(approach):
    with open(approach / "lard.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file, delimiter=";"))
    run = json.loads((approach / "labels.json").read_text(encoding="utf-8"))
    inside = [
        frame
        for frame in run["frames"]
        if all(corner["bscope"]["inside"] for corner in frame["runways"][0]["corners"].values())
    ]
    assert inside and len([row for row in rows if row["image"].startswith("bscope/")]) == len(inside)
    for row in rows:
        assert len(row) == 29 and (approach / row["image"]).is_file()
        corners = [(float(row[f"y_{name}"]), float(row[f"x_{name}"])) for name in "ABCD"]
        assert corners == sorted(corners)
        # West by a little south: a quarter turn from south.
        assert 75 < float(row["yaw"]) < 95 and 85 < float(row["pitch"]) < 95
        frame = next(frame for frame in run["frames"] if f"{frame['frame']:05}" in row["image"])
        assert float(row["yaw"]) == pytest.approx(frame["pose"]["heading_deg"] - 180, abs=1e-3)
        at = frame["runways"][0]["aircraft"]
        assert float(row["along_track_distance"]) == pytest.approx(at["along_track_m"] / 1852, abs=0.006)
        assert float(row["height_above_runway"]) == pytest.approx(at["above_threshold_m"] / 0.3048, abs=0.006)
        speed = np.hypot(frame["pose"]["north_mps"], frame["pose"]["east_mps"])
        assert float(row["time_to_landing"]) == pytest.approx(at["along_track_m"] / speed, rel=0.01)
        assert row["weather"] == "fog"


def test_mask_pictures_show_the_categories(approach):
    run = json.loads((approach / "labels.json").read_text(encoding="utf-8"))
    levels = {"building": 2, "box": 3, "model": 4, "lights": 5, "target": 6}
    for product, scope in (("masks", "bscope"), ("cscope_masks", "cscope")):
        raw = subprocess.run(
            ["ffmpeg", "-v", "error", "-i", approach / product / "00950.png", "-f", "rawvideo", "-pix_fmt", "gray", "-"],
            check=True,
            capture_output=True,
        ).stdout
        shown = np.frombuffer(raw, np.uint8).reshape(524, 164)
        expected = np.zeros((524, 164), np.uint8)
        expected[decoded(run["frames"][1]["runways"][0][scope], 524, 164)] = 1
        for thing in run["frames"][1]["objects"]:
            expected[decoded(thing[scope], 524, 164)] = levels[thing["group"]]
        assert np.array_equal(shown, expected)


def test_a_run_that_goes_on_labels_all_of_its_frames(program, approach, tmp_path):
    products = ["--products", "bscope,cscope,labels,masks,cscope_masks", "-q", "-o", tmp_path]
    subprocess.run([program, "render", "braunschweig-26", "--frames", "700", *products], check=True)
    first = (tmp_path / "labels" / "00700.json").stat().st_mtime_ns
    subprocess.run([program, "render", "braunschweig-26", "--frames", "700:1201:250", "--resume", *products], check=True)
    assert (tmp_path / "labels" / "00700.json").stat().st_mtime_ns == first
    for name in ("labels.json", "coco.json", "lard.csv", "run.json"):
        assert (tmp_path / name).read_bytes() == (approach / name).read_bytes()
    # Pictures without labels take their place: nothing of them stays.
    subprocess.run([program, "render", "braunschweig-26", "--frames", "700", "--effects", "none", "-q", "-o", tmp_path], check=True)
    assert not (tmp_path / "coco.json").exists() and not (tmp_path / "labels").exists()


def test_labels_have_the_number_of_their_frame_however_long_a_session_runs(scene):
    number = 2**31 + 5
    frame = scene.render(700, frame_index=number, bscope=False, cscope=False, labels=True)
    assert frame.labels["frame"] == number


def test_labels_keep_to_the_threads_of_their_scene(tmp_path, share_of_all_threads):
    scene = (
        "[scene]\nname = 'boxes'\norigin = { latitude_deg = 52.0, longitude_deg = 10.0, height_m = 0.0 }\nvertical_datum = 'scene'\n"
        "[terrain]\nhalf_extent_m = 3000.0\nspacing_m = 100.0\n"
        "[trajectory.fixed]\nat = { latitude_deg = 52.0, longitude_deg = 10.0 }\nabove_ground_m = 60.0\n"
    )
    for row in range(30):
        for column in range(30):
            at = f"{{ latitude_deg = {52.004 + 0.0006 * row:.6f}, longitude_deg = {9.995 + 0.0004 * column:.6f} }}"
            scene += f"[[box]]\nname = '{row} {column}'\nat = {at}\nlength_m = 10.0\nwidth_m = 10.0\nheight_m = 10.0\n"
    (tmp_path / "scene.toml").write_text(scene)
    boxes = fanbeam.Scene.open(tmp_path, threads=1)
    boxes.set_samples(0.3)
    # Other threads took a tenth more.
    assert share_of_all_threads(lambda: [boxes.render(0, labels=True) for _ in range(3)]) < 1.03
