"""Scenes, conditions and frames, held against the program's own files and closed forms."""

import multiprocessing
import os
import pickle
import re
import shutil
import subprocess
import sys
import textwrap
import threading
import time
import tomllib
import warnings

import fanbeam
import numpy as np
import pytest


@pytest.fixture(scope="module")
def grass():
    return fanbeam.Scene.open("flat-grass")


@pytest.fixture(scope="module")
def runway():
    return fanbeam.Scene.open("braunschweig-26")


def png_pixels(path):
    """Grey rows of a PNG, by a decoder that is not ours."""
    raw = subprocess.run(
        ["ffmpeg", "-v", "error", "-i", path, "-f", "rawvideo", "-pix_fmt", "gray", "-"], check=True, capture_output=True
    ).stdout
    return np.frombuffer(raw, np.uint8)


def test_frames_are_those_that_the_program_writes(runway, program, tmp_path):
    subprocess.run([program, "render", "braunschweig-26", "--frames", "1200", "-o", tmp_path, "-q"], check=True)
    frame = runway.render(1200)
    assert frame.bscope.shape == frame.cscope.shape == (524, 164)
    assert np.array_equal(frame.bscope.ravel(), png_pixels(tmp_path / "bscope" / "01200.png"))
    assert np.array_equal(frame.cscope.ravel(), png_pixels(tmp_path / "cscope" / "01200.png"))


def test_the_picture_of_flat_grass_is_its_closed_form(grass):
    # Display "stc" is the NRCS of flat ground at full beam: a sin(psi) + b sin(psi)^c, two-way beam
    # and air taken off. Held at the boresight's range, where the beam takes 0 dB.
    frame = grass.render(0, cscope=False)
    at = int(np.argmin(np.abs(grass.range_m - 60.0 / np.sin(np.radians(3.8)))))
    psi = np.arcsin(60.0 / grass.range_m[at])
    sigma0_dB = 10 * np.log10(fanbeam.nrcs("short_grass", psi))
    loss_dB = 2 * fanbeam.Atmosphere().one_way_dB(60.0, 0.0, grass.range_m[at])
    low_dB, high_dB = grass.facts["window_dB"]
    grey = 255 * (sigma0_dB - loss_dB - low_dB) / (high_dB - low_dB)
    assert frame.bscope_grey[at, 82] == pytest.approx(grey, abs=0.5)


def test_arrays_share_the_memory_of_the_frame_and_outlive_its_scene():
    scene = fanbeam.Scene.open("flat-grass")
    frame = scene.render(0, layers=True)
    assert not frame.bscope_W.flags.owndata and frame.bscope_W.strides[0] < 0
    before = frame.bscope_W.copy()
    del scene
    assert np.array_equal(frame.bscope_W, before)
    assert pickle.loads(pickle.dumps(frame)).bscope_W.tobytes() == before.tobytes()


def test_a_pickle_keeps_the_accuracy_that_stays_for_effects():
    # Snow that two grey levels leave out and half a one does not.
    told = fanbeam.Scene.open("flat-grass")
    told.set_weather(snow_rate_mm_per_h=0.5)
    usual = told.plan
    told.set_accuracy(100.0)
    told.set_samples(2.0)
    sent = pickle.loads(pickle.dumps(told))
    assert str(told.plan) != str(usual)
    assert str(sent.plan) == str(told.plan)
    assert sent.render(0).bscope_W.tobytes() == told.render(0).bscope_W.tobytes()


@pytest.mark.parametrize("scene", ["flat-grass", "braunschweig-26"])  # without fog, and with a visibility
@pytest.mark.parametrize("then", [[], [None], [None, 0.2]])
def test_a_pickle_keeps_which_of_the_two_tells_the_fog(scene, then):
    told = fanbeam.Scene.open(scene)
    told.set_weather(liquid_water_g_per_m3=0.1)
    told.set_weather(visibility_m=500.0)
    assert pickle.loads(pickle.dumps(told)).weather == told.weather
    told.set_weather(liquid_water_g_per_m3=0.3)
    for water in then:
        told.set_weather(liquid_water_g_per_m3=water)
    sent = pickle.loads(pickle.dumps(told))
    assert sent.weather == told.weather
    assert sent.weather["visibility_m"] is None
    assert sent.weather["liquid_water_g_per_m3"] == (then or [0.3])[-1]


def test_a_pickle_keeps_that_water_took_the_place_of_the_scenes_visibility():
    told = fanbeam.Scene.open("braunschweig-26")
    assert told.weather["visibility_m"] == 300.0
    told.set_weather(liquid_water_g_per_m3=0.3)
    told.set_weather(liquid_water_g_per_m3=None)
    assert pickle.loads(pickle.dumps(told)).weather["visibility_m"] is None


@pytest.mark.parametrize(
    ("told", "other"),
    [({"liquid_water_g_per_m3": 0.3}, "visibility_m"), ({"visibility_m": 300.0}, "liquid_water_g_per_m3")],
)
def test_none_for_either_way_of_telling_the_fog_ends_it(told, other):
    scene = fanbeam.Scene.open("flat-grass")
    scene.set_weather(**told)
    scene.set_weather(**told, **{other: None})
    assert scene.weather.items() >= told.items()
    scene.set_weather(**{other: None})
    assert scene.weather["visibility_m"] is None and scene.weather["liquid_water_g_per_m3"] is None
    assert pickle.loads(pickle.dumps(scene)).weather == scene.weather


def test_what_was_told_is_the_scenes_own():
    scene = fanbeam.Scene.open("flat-grass")
    rate_mm_per_h, tilt_deg, attitude_deg = np.array(3.0), np.array(-5.0), np.zeros(3)
    scene.set_weather(rain_rate_mm_per_h=rate_mm_per_h)
    scene.set_sensor(tilt_deg=tilt_deg)
    scene.set_targets([fanbeam.Target("mast", 52.01, 10.0, 10.0, 100.0, attitude_deg)])
    rate_mm_per_h[...], tilt_deg[...], attitude_deg[...] = 50.0, 3.0, np.nan
    sent = pickle.loads(pickle.dumps(scene))
    assert sent.weather["rain_rate_mm_per_h"] == 3.0
    assert sent.facts["cscope_top_rad"] == scene.facts["cscope_top_rad"]
    assert sent.objects[-1] == "mast"


def test_copies_sample_as_the_time_budget_said_here(tmp_path, root):
    own = tmp_path / "grass"
    shutil.copytree(root / "scenes" / "flat-grass", own)
    with (own / "scene.toml").open("a", encoding="utf-8") as file:
        file.write("\n[accuracy]\ntime_budget_ms = 0.1\n")
    with pytest.warns(fanbeam.FanbeamWarning, match="W-BUDGET"):  # the coarsest sampling takes longer
        scene = fanbeam.Scene.open(own)
    asked = fanbeam.Scene.open("flat-grass")
    with pytest.warns(fanbeam.FanbeamWarning, match="W-BUDGET"):
        asked.set_time_budget(0.1)
    for told in (scene, asked):
        kind, samples = told.__getstate__().sampling
        assert kind == "samples" and samples > 0.0
        told.__getstate__().sampling = (kind, 37.0)  # what no budget of such a length comes to
        sent = pickle.loads(pickle.dumps(told))
        assert sent.__getstate__().sampling == (kind, 37.0)
        told.set_samples(37.0)
        assert sent.render(0).meta["sampling"] == told.render(0).meta["sampling"]


def test_warnings_show_the_users_line_and_are_not_given_again_by_copies():
    scene = fanbeam.Scene.open("flat-grass")
    with pytest.warns(fanbeam.FanbeamWarning) as told:
        scene.set_weather(snow_rate_mm_per_h=5.0, temperature_C=40.0)
        scene.set_time_budget(0.1)  # too short for any sampling
    assert [str(warning.message).split()[0] for warning in told] == ["W-WARM-SNOW", "W-BUDGET"]
    assert {warning.filename for warning in told} == {__file__}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert pickle.loads(pickle.dumps(scene)).weather == scene.weather


def test_folders_have_any_name(tmp_path, root):
    folder = tmp_path / os.fsdecode(b"gr\xfcn")  # Latin-1
    shutil.copytree(root / "scenes" / "flat-grass", folder)
    assert fanbeam.Scene.open(folder, data=folder).name == "flat-grass"
    assert pickle.loads(pickle.dumps(fanbeam.Scene.open(folder))).name == "flat-grass"
    with pytest.raises(fanbeam.InputError, match=r"E-IO scene = .*gr\\xfcner\" not found"):
        fanbeam.Scene.open(tmp_path / os.fsdecode(b"gr\xfcner"))
    with pytest.raises(fanbeam.InputError, match='E-IO scene = "" not found'):
        fanbeam.Scene.open("")


def test_data_folders_are_the_same_from_another_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("FANBEAM_DATA", "named")
    (tmp_path / "given").mkdir()
    told = fanbeam.Scene.open("flat-grass", data="given").__getstate__()
    assert told.opened["data"][:2] == [tmp_path / "given", tmp_path / "named"]


def test_none_takes_every_part_of_the_weather_away(grass):
    scene = fanbeam.Scene.open("flat-grass")
    usual = scene.weather
    other = {
        "liquid_water_g_per_m3": 0.1, "fog_top_m": 90.0, "rain_rate_mm_per_h": 4.0, "rain_top_m": 900.0,
        "melting_layer": True, "snow_rate_mm_per_h": 1.0, "snow_top_m": 5000.0, "temperature_C": 5.0,
        "pressure_hPa": 1000.0, "humidity": 0.5,
    }
    scene.set_weather(**other)
    assert all(scene.weather[name] == value for name, value in other.items())
    scene.set_weather(**dict.fromkeys(other))
    assert scene.weather == usual == grass.weather
    assert pickle.loads(pickle.dumps(scene)).weather == usual


def test_parts_that_threads_set_at_once_are_all_kept():
    scene = fanbeam.Scene.open("flat-grass")
    parts = [{"visibility_m": 800.0}, {"rain_rate_mm_per_h": 3.0}, {"temperature_C": 4.0}, {"humidity": 0.4}]
    for _ in range(5):
        scene.set_weather(visibility_m=None, rain_rate_mm_per_h=0.0, temperature_C=None, humidity=None)
        threads = [threading.Thread(target=scene.set_weather, kwargs=part) for part in parts]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        weather = scene.weather
        assert all(weather[name] == value for part in parts for name, value in part.items())


def test_all_pictures_have_the_farthest_range_on_top(grass):
    frame = grass.render(0, layers=True, cscope_layers=True)
    assert grass.range_m[0] > grass.range_m[-1] and grass.elevation_rad[0] > grass.elevation_rad[-1]
    seen = frame.layers["visibility"][:, 82] > 0.99
    # Flat ground: sin(grazing) = height / range, whatever the row.
    sine = np.sin(frame.layers["grazing_rad"][seen, 82])
    assert np.allclose(sine, 60.0 / grass.range_m[seen], rtol=0.03)
    rows = frame.cscope_layers["visibility"][:, 82] > 0.99
    down = np.sin(-grass.elevation_rad[rows])
    # A row of the C-scope is 0.019 degrees high: its mean range is within what it covers.
    assert np.allclose(60.0 / frame.cscope_layers["range_m"][rows, 82], down, atol=4e-4)
    assert grass.materials[frame.layers["material"][seen, 82][0]] == "short_grass"
    assert grass.objects[frame.layers["object"][seen, 82][0]] == "terrain"


def test_watts_follow_the_radar_equation_with_rain(grass):
    scene = fanbeam.Scene.open("flat-grass", effects="none,+rain")
    dry = scene.render(0, cscope=False).bscope_W[:, 82]
    scene.set_weather(rain_rate_mm_per_h=10.0)
    wet = scene.render(0, cscope=False).bscope_W[:, 82]
    air = fanbeam.Atmosphere(rain_rate_mm_per_h=10.0)
    assert scene.weather["rain_rate_mm_per_h"] == 10.0
    row = 262
    loss_dB = 2 * air.one_way_dB_per_km(30.0)["rain"] * scene.range_m[row] / 1000
    assert 10 * np.log10(dry[row] / wet[row]) == pytest.approx(loss_dB, rel=0.01)


def test_watts_hold_the_noise_that_a_display_hides():
    scene = fanbeam.Scene.open("flat-grass")
    scene.set_sensor(low_dB=100.0, high_dB=150.0)
    assert scene.plan.runs("thermal-noise")
    assert scene.render(0, cscope=False).meta["noise_W"] == scene.facts["noise_W"] > 0.0


def test_conditions_change_what_they_name_alone(grass):
    scene = fanbeam.Scene.open("flat-grass")
    scene.set_weather(visibility_m=200.0, temperature_C=5.0)
    scene.set_weather(liquid_water_g_per_m3=0.3)
    assert scene.weather["visibility_m"] is None and scene.weather["temperature_C"] == 5.0
    scene.set_weather(liquid_water_g_per_m3=None)
    assert scene.weather["liquid_water_g_per_m3"] is None
    scene.set_sensor(tilt_deg=-6.0)
    scene.set_sensor(low_dB=-50.0)
    assert scene.facts["window_dB"][0] == -50.0
    assert scene.facts["cscope_top_rad"] == pytest.approx(grass.facts["cscope_top_rad"] - np.radians(2.2))
    scene.set_surface("wet")
    assert scene.surface == "wet"


def test_a_target_stands_where_it_is_put(grass):
    scene = fanbeam.Scene.open("flat-grass")
    north_deg = np.degrees(1500.0 / 6371000.0)
    here = scene.trajectory[0]
    scene.set_targets([fanbeam.Target("mast", here.latitude_deg + north_deg, here.longitude_deg, 10.0, rcs_m2=1000.0)])
    frame = scene.render(0, cscope=False, layers=True)
    assert scene.objects[-1] == "mast"
    rows, columns = np.nonzero(frame.layers["object"] == len(scene.objects) - 1)
    assert set(columns) <= {81, 82}
    assert np.abs(scene.range_m[rows] - np.hypot(1500.0, 50.0)).max() < 10.0
    scene.set_targets([])
    assert "mast" not in scene.objects


def test_the_ground_is_where_the_scene_has_it(grass):
    assert grass.ground_height_m(52.0, 10.0) == pytest.approx(0.0, abs=1e-6)
    assert grass.ground_height_m(53.0, 10.0) is None
    with pytest.raises(fanbeam.InputError, match="latitude"):
        grass.ground_height_m(91.0, 10.0)


def test_every_problem_is_told_at_once(grass):
    with pytest.raises(fanbeam.InputError) as told:
        grass.render(fanbeam.Pose(95.0, float("nan"), 1e9))
    assert [problem.field for problem in told.value.problems] == ["pose.latitude_deg", "pose.longitude_deg", "pose.height_m"]
    assert [problem.code for problem in told.value.problems] == ["E-RANGE", "E-NONFINITE", "E-RANGE"]
    with pytest.raises(fanbeam.InputError, match="flat-grass"):
        fanbeam.Scene.open("flat-gras")
    with pytest.raises(fanbeam.InputError, match="speckle"):
        fanbeam.Scene.open("flat-grass", effects="+speckle", sample=False)
    with pytest.raises(fanbeam.InputError, match="rain_rate"):
        grass.set_weather(rain_rate_mm_per_h=-1.0)
    assert grass.weather["rain_rate_mm_per_h"] == 0.0
    with pytest.raises(fanbeam.InputError, match="E-REF"):
        grass.set_targets([fanbeam.Target("nobody", 52.0, 10.0, 0.0)])
    nan = float("nan")
    with pytest.raises(fanbeam.InputError) as told:
        grass.set_sensor(low_dB=nan, high_dB=500.0)
    assert [(problem.code, problem.field) for problem in told.value.problems] == [
        ("E-NONFINITE", "low_dB"),
        ("E-RANGE", "high_dB"),
    ]
    with pytest.raises(fanbeam.InputError) as told:
        grass.set_targets([fanbeam.Target("new", 52.0, 10.0, 0.0, 1.0, attitude_deg=(nan, 0.0, -nan))])
    assert [(problem.code, problem.field) for problem in told.value.problems] == [
        ("E-NONFINITE", "target[0].roll_deg"),
        ("E-NONFINITE", "target[0].heading_deg"),
    ]
    with pytest.raises(fanbeam.InputError) as told:
        grass.set_targets([fanbeam.Target("good", 52.0, 10.0, 0.0, 1.0), fanbeam.Target("bad", 95.0, 10.0, 1e9, -1.0)])
    assert [(problem.code, problem.field) for problem in told.value.problems] == [
        ("E-RANGE", "target[1].latitude_deg"),
        ("E-RANGE", "target[1].height_m"),
        ("E-RANGE", "target[1].rcs_m2"),
    ]
    with pytest.raises(TypeError):
        grass.set_weather(rain=3)
    with pytest.raises(TypeError, match="rain_rate"):
        grass.set_weather(rain_rate_mm_per_h="much")
    with pytest.raises(fanbeam.InputError, match="frame = 99999: expected 0 to 0, or -1"):
        grass.render(99999)
    with pytest.raises(TypeError, match="frame: expected a whole number, not 'now'"):
        grass.render("now")


@pytest.mark.parametrize(
    ("fields", "call"),
    [
        (
            "scene sensor data effects caster seed threads",
            lambda scene: fanbeam.Scene.open(
                "nowhere", sensor="bogus", data="/nowhere", effects="bogus", caster="bogus", seed=-1, threads=-1
            ),
        ),
        (
            "tilt_deg low_dB noise_figure_dB cscope_mode",
            lambda scene: scene.set_sensor(tilt_deg=1e3, low_dB=float("nan"), noise_figure_dB=-4, cscope_mode="q"),
        ),
        ("pose.height_m frame_index", lambda scene: scene.render(fanbeam.Pose(52.0, 10.0, 1e9), frame_index=-1)),
        (
            "grazing_rad polarisation state material",
            lambda scene: fanbeam.nrcs("nothing", 2.0, polarisation="HV", state="moist"),
        ),
        (
            "liquid_water_g_per_m3 humidity",
            lambda scene: fanbeam.Atmosphere(visibility_m=300.0, liquid_water_g_per_m3=0.1, humidity=2.0),
        ),
        (
            "rain_rate_mm_per_h humidity",
            lambda scene: fanbeam.Atmosphere(rain_rate_mm_per_h=10**400, humidity=2.0),
        ),
        # Nothing is said of the number that stands in for one that is too large.
        ("visibility_m", lambda scene: fanbeam.Atmosphere(visibility_m=10**400)),
        ("temperature_C pressure_hPa", lambda scene: scene.set_weather(temperature_C=90.0, pressure_hPa=10**400)),
        ("frequency_Hz state", lambda scene: fanbeam.nrcs("short_grass", 0.1, frequency_Hz=10**400, state="moist")),
    ],
)
def test_problems_of_one_call_are_told_together(grass, fields, call):
    with pytest.raises(fanbeam.InputError) as told:
        call(grass)
    assert sorted(problem.field for problem in told.value.problems) == sorted(fields.split())
    assert "--" not in str(told.value)


def test_a_number_that_is_too_large_is_told_the_range_of_its_field(grass):
    with pytest.raises(fanbeam.InputError, match=f"threads = {2**70}: expected 0 to 1024$"):
        fanbeam.Scene.open("flat-grass", threads=2**70)
    with pytest.raises(fanbeam.InputError, match="noise_figure_dB = 10{400}: expected 0 to 60 dB$"):
        grass.set_sensor(noise_figure_dB=10**400)


def test_a_library_that_is_none_is_told_beside_what_else_is_wrong(tmp_path):
    with pytest.raises(fanbeam.InputError) as told:
        fanbeam.nrcs("short_grass", 2.0, state="moist", library=tmp_path / "none.toml")
    assert [problem.field for problem in told.value.problems] == ["grazing_rad", "", "state"]
    assert told.value.problems[1].file == str(tmp_path / "none.toml")


@pytest.mark.parametrize(
    ("field", "call"),
    [
        ("seed", lambda scene: fanbeam.Scene.open("flat-grass", seed=2**64)),
        ("threads", lambda scene: fanbeam.Scene.open("flat-grass", threads=2**40)),
        ("effects", lambda scene: fanbeam.Scene.open("flat-grass", effects="+speckle", sample=False)),
        ("frame_index", lambda scene: scene.render(0, frame_index=2**64)),
        ("frame", lambda scene: scene.render(2**70)),
        ("latitude_deg", lambda scene: scene.ground_height_m(91.0, 10.0)),
        ("height_m", lambda scene: fanbeam.Atmosphere().one_way_dB_per_km(12001.0)),
        ("from_height_m", lambda scene: fanbeam.Atmosphere().one_way_dB(-2001.0, 0.0, 3000.0)),
        ("to_height_m", lambda scene: fanbeam.Atmosphere().one_way_dB(0.0, 2e4, 2e4)),
    ],
)
def test_what_is_out_of_range_is_an_input_error(grass, field, call):
    with pytest.raises(fanbeam.InputError) as told:
        call(grass)
    assert [problem.field for problem in told.value.problems] == [field]


@pytest.mark.parametrize(
    ("field", "call"),
    [
        ("pose.latitude_deg", lambda scene: scene.render(fanbeam.Pose("x", 1, 2))),
        ("pose.height_m", lambda scene: scene.render(fanbeam.Pose(52.0, 10.0, None))),
        ("frame", lambda scene: scene.render(1.0)),
        ("frame_index", lambda scene: scene.render(0, frame_index=3.0)),
        ("bscope", lambda scene: scene.render(0, bscope="no")),
        ("tilt_deg", lambda scene: scene.set_sensor(tilt_deg="3")),
        ("tilt_deg", lambda scene: scene.set_sensor(tilt_deg=(i for i in range(2)))),  # no copy can be made
        ("stabilised", lambda scene: scene.set_sensor(stabilised=0.0)),
        ("cscope_mode", lambda scene: scene.set_sensor(cscope_mode=3)),
        ("melting_layer", lambda scene: scene.set_weather(melting_layer=5)),
        ("surface", lambda scene: scene.set_surface(3)),
        ("samples_per_cell", lambda scene: scene.set_samples("x")),
        ("accuracy_grey", lambda scene: scene.set_accuracy("a")),
        ("time_budget_ms", lambda scene: scene.set_time_budget(None)),
        ("targets", lambda scene: scene.set_targets(None)),
        ("target[0]", lambda scene: scene.set_targets([3])),
        ("target[0]", lambda scene: scene.set_targets([(i for i in range(2))])),
        ("latitude_deg", lambda scene: scene.ground_height_m("a", 1)),
        ("scene", lambda scene: fanbeam.Scene.open(3)),
        ("sensor", lambda scene: fanbeam.Scene.open("flat-grass", sensor=3)),
        ("data", lambda scene: fanbeam.Scene.open("flat-grass", data=3)),
        ("seed", lambda scene: fanbeam.Scene.open("flat-grass", seed="a")),
        ("effects", lambda scene: fanbeam.Scene.open("flat-grass", effects=None)),
        ("sample", lambda scene: fanbeam.Scene.open("flat-grass", sample="x")),
        ("library", lambda scene: fanbeam.materials(library=3)),
        ("material", lambda scene: fanbeam.nrcs(3, 0.1)),
        ("grazing_rad", lambda scene: fanbeam.nrcs("short_grass", "steep")),
        ("grazing_rad", lambda scene: fanbeam.nrcs("short_grass", "0.1")),
        ("grazing_rad", lambda scene: fanbeam.nrcs("short_grass", [0.1, None])),
        ("grazing_rad", lambda scene: fanbeam.nrcs("short_grass", 0.1j)),
        ("polarisation", lambda scene: fanbeam.nrcs("short_grass", 0.1, polarisation=None)),
        ("extrapolate", lambda scene: fanbeam.nrcs("short_grass", 0.1, extrapolate="yes")),
        ("frequency_Hz", lambda scene: fanbeam.Atmosphere("35e9")),
        ("height_m", lambda scene: fanbeam.Atmosphere().one_way_dB_per_km("low")),
    ],
)
def test_another_type_is_a_type_error_that_names_the_field(grass, field, call):
    with pytest.raises(TypeError, match=f"^{re.escape(field)}: expected "):
        call(grass)


def test_numpys_numbers_and_truths_are_taken():
    scene = fanbeam.Scene.open("flat-grass", seed=np.uint64(2**64 - 1), sample=np.bool_(False), threads=np.int32(1))
    scene.set_weather(rain_rate_mm_per_h=np.float32(2.0), melting_layer=np.bool_(True), melting_height_m=500)
    assert scene.weather["melting_layer"] is True and scene.weather["rain_rate_mm_per_h"] == 2.0
    frame = scene.render(np.int64(-1), frame_index=np.uint64(2**63 + 1), cscope=np.bool_(False))
    assert frame.cscope is None and int(frame.meta["frame_index"]) == 2**63 + 1


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("name", 5),
        ("latitude_deg", "52"),
        ("height_m", None),
        ("rcs_m2", "bright"),
        ("attitude_deg", (0.0, 0.0)),
    ],
)
def test_a_value_of_another_type_is_told_with_its_field(grass, field, value):
    target = {"name": "new", "latitude_deg": 52.0, "longitude_deg": 10.0, "height_m": 50.0, "rcs_m2": 1.0}
    with pytest.raises(TypeError, match=rf"target\[0\]\.{field}: expected "):
        grass.set_targets([fanbeam.Target(**{**target, field: value})])


def test_a_data_folder_that_is_none_is_told(tmp_path):
    with pytest.raises(fanbeam.InputError, match="E-IO data"):
        fanbeam.Scene.open("flat-grass", data=tmp_path / "nowhere")
    assert fanbeam.Scene.open("flat-grass", data=tmp_path).name == "flat-grass"


def test_problems_of_files_have_their_line(tmp_path):
    (tmp_path / "scene.toml").write_text('[scene]\nname = "x"\nwrong = 1\n', encoding="utf-8")
    with pytest.raises(fanbeam.InputError) as told:
        fanbeam.Scene.open(tmp_path)
    assert any(problem.file.endswith("scene.toml") and problem.line == 3 for problem in told.value.problems)


def test_the_plan_says_why(runway):
    assert runway.plan.runs("fog") and not runway.plan.runs("rain")
    assert all(effect.reason for effect in runway.plan)
    with pytest.raises(KeyError, match="double-bounce"):
        runway.plan.runs("bounce")


def test_a_flight_is_a_sequence_and_columns(runway):
    flight = runway.trajectory
    assert len(flight) > 1000
    assert flight[-1].time_s == flight.time_s[-1] and len(flight[10:20]) == 10
    assert np.all(np.diff(flight.height_m) < 0)  # an approach
    with pytest.raises(AttributeError, match="heading_deg"):
        flight.altitude


def test_threads_render_the_bytes_of_one(runway):
    frames = range(1000, 1004)
    one = [runway.render(frame).bscope_W.tobytes() for frame in frames]
    found = {}
    workers = [threading.Thread(target=lambda k=k: found.update({k: runway.render(k).bscope_W.tobytes()})) for k in frames]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert [found[k] for k in frames] == one


def test_pythons_lock_is_free_while_a_frame_is_made(runway):
    ticks, done = [], threading.Event()

    def tick():
        while not done.wait(0.001):
            ticks.append(time.monotonic())

    thread = threading.Thread(target=tick)
    thread.start()
    begin = time.monotonic()
    for frame in range(1000, 1010):
        runway.render(frame)
    seconds = time.monotonic() - begin
    done.set()
    thread.join()
    # Held, the other thread would tick some ten times.
    assert len(ticks) > max(30, 100 * seconds)


def worker_bytes(scene):
    return scene.render(0).bscope_W.tobytes()


@pytest.mark.parametrize("method", ["spawn", "forkserver"])
def test_a_scene_travels_to_other_processes_with_its_conditions(method):
    scene = fanbeam.Scene.open("flat-grass", seed=3)
    scene.set_weather(rain_rate_mm_per_h=20.0)
    scene.set_sensor(tilt_deg=-5.0)
    scene.set_targets([fanbeam.Target("mast", 52.01, 10.0, 10.0, rcs_m2=100.0)])
    scene.set_samples(2.0)
    with multiprocessing.get_context(method).Pool(1) as pool:
        assert pool.apply(worker_bytes, (scene,)) == worker_bytes(scene)


def test_a_task_that_a_forked_worker_cannot_do_fails_instead_of_waiting(grass):
    with multiprocessing.get_context("fork").Pool(1) as pool:
        with pytest.raises(RuntimeError, match="spawn"):
            pool.apply_async(worker_bytes, (grass,)).get(timeout=60)


def test_what_cannot_be_opened_where_it_is_sent_is_told_by_the_first_call(tmp_path, root):
    shutil.copytree(root / "scenes" / "flat-grass", tmp_path / "grass")
    sent = pickle.dumps(fanbeam.Scene.open(tmp_path / "grass"))
    shutil.rmtree(tmp_path / "grass")
    arrived = pickle.loads(sent)
    for _ in range(2):
        with pytest.raises(fanbeam.InputError, match="E-IO"):
            arrived.render(0)
    shutil.copytree(root / "scenes" / "flat-grass", tmp_path / "grass")
    assert pickle.loads(pickle.dumps(arrived)).render(0).bscope is not None


def test_in_a_forked_child_a_scene_says_what_to_do(grass):
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        told = []
        for attempt in (lambda: grass.render(0), lambda: fanbeam.Scene.open("flat-grass")):
            try:
                attempt()
            except RuntimeError as error:
                told.append("spawn" in str(error))
        os.write(write, bytes([told == [True, True]]))
        os._exit(0)
    assert os.read(read, 1) == b"\x01"
    assert os.waitpid(child, 0)[1] == 0
    grass.render(0)


def test_ctrl_c_ends_a_reference_within_a_second():
    # A frame that takes a minute.
    script = textwrap.dedent("""
        import fanbeam, signal, threading, os, time
        scene = fanbeam.Scene.open("braunschweig-26")
        scene.set_reference()
        threading.Timer(1.0, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        begin = time.monotonic()
        try:
            scene.render(1000)
        except KeyboardInterrupt:
            print(time.monotonic() - begin)
    """)
    ended = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=120, check=True)
    assert 0.9 < float(ended.stdout) < 4.0


def test_sampling_is_told_in_the_frame(grass):
    scene = fanbeam.Scene.open("flat-grass", caster="rays")
    scene.set_samples(2.0)
    assert scene.render(0).meta["sampling"].startswith("rays, 2 per range cell")
    scene.set_accuracy(0.5)
    frame = scene.render(0)
    assert max(frame.meta["estimated_error_grey"]) <= 0.25
    of_bscope, of_cscope = scene.render(0, cscope=False).meta["estimated_error_grey"]
    assert of_bscope <= 0.25 and of_cscope is None


def test_lookups(root):
    assert {"braunschweig-26", "flat-grass"} <= set(fanbeam.scenes())
    assert "hivision" in fanbeam.sensors()
    assert "short_grass" in [material.name for material in fanbeam.materials()]
    angles = np.radians([[3.0, 10.0], [30.0, 60.0]])
    values = fanbeam.nrcs("short_grass", angles)
    assert values.shape == (2, 2)
    row = tomllib.loads((root / "materials" / "library.toml").read_text(encoding="utf-8"))["short_grass"]
    assert row["reference_frequency_GHz"] == 35
    sine = np.sin(angles)
    assert np.allclose(values, row["a"] * sine + row["b"] * sine ** row["c"], rtol=1e-12)
    with pytest.raises(fanbeam.InputError, match="short_grass"):
        fanbeam.nrcs("short_gras", 0.1)
    upright = fanbeam.nrcs("short_grass", np.pi / 2)
    assert fanbeam.nrcs("short_grass", np.float32(np.pi / 2)) == upright  # a bit more than pi/2
    with pytest.raises(fanbeam.InputError, match="grazing_rad"):
        fanbeam.nrcs("short_grass", np.pi / 2 + 2e-6)
    with pytest.raises(fanbeam.InputError, match="or extrapolate=True"):
        fanbeam.nrcs("short_grass", 0.1, frequency_Hz=0.0)
    air = fanbeam.Atmosphere()
    with pytest.raises(fanbeam.InputError, match="E-RANGE length_m = 299: expected at least 300 m"):
        air.one_way_dB(0.0, 300.0, 299.0)
    assert air.one_way_dB(0.1, 0.4, 0.3) > 0.0  # straight up, but for rounding
    # Recommendation ITU-R P.838-3 at 35 GHz, horizontal: k = 0.3374 , alpha = 0.9047
    assert fanbeam.Atmosphere(35e9, rain_rate_mm_per_h=10.0).one_way_dB_per_km(0.0)["rain"] == pytest.approx(
        0.3374 * 10**0.9047, rel=1e-3
    )


