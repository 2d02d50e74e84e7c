"""Scenes, conditions and frames, held against the program's own files and closed forms."""

import copy
import os
import pickle
import shutil
import subprocess
import tomllib

import fanbeam
import numpy as np
import pytest


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
        fanbeam.nrcs("short_grass", 0.1, frequency_Hz=10e9)
    air = fanbeam.Atmosphere()
    with pytest.raises(fanbeam.InputError, match="E-RANGE length_m = 299: expected at least 300 m"):
        air.one_way_dB(0.0, 300.0, 299.0)
    assert air.one_way_dB(0.1, 0.4, 0.3) > 0.0  # straight up, but for rounding
    # Recommendation ITU-R P.838-3 at 35 GHz, horizontal: k = 0.3374 , alpha = 0.9047
    assert fanbeam.Atmosphere(35e9, rain_rate_mm_per_h=10.0).one_way_dB_per_km(0.0)["rain"] == pytest.approx(
        0.3374 * 10**0.9047, rel=1e-3
    )


def test_the_air_pickles_and_is_copied():
    rate_mm_per_h = np.array(10.0)
    air = fanbeam.Atmosphere(94e9, rain_rate_mm_per_h=rate_mm_per_h, humidity=0.4)
    rate_mm_per_h[...] = 300.0
    for same in (pickle.loads(pickle.dumps(air)), copy.deepcopy(air), copy.copy(air)):
        assert same.one_way_dB_per_km(100.0) == air.one_way_dB_per_km(100.0)
        assert same.one_way_dB(300.0, 0.0, 4000.0) == air.one_way_dB(300.0, 0.0, 4000.0)


def test_a_scene_of_bscopes_alone_is_planned_for_them():
    # In a C-scope of mode shadow a trace of snow may raise or hide a whole obstacle.
    for cscope in (True, False):
        scene = fanbeam.Scene.open("flat-grass", cscope=cscope)
        scene.set_sensor(cscope_mode="shadow")
        scene.set_weather(snow_rate_mm_per_h=0.001, temperature_C=-5.0)
        assert scene.plan.runs("snow") == cscope
        assert (scene.render(0).cscope is not None) == cscope
    sent = pickle.loads(pickle.dumps(scene))
    assert str(sent.plan) == str(scene.plan) and sent.render(0).cscope is None
    for asked in ("cscope", "cscope_layers", "labels"):
        with pytest.raises(fanbeam.InputError, match=f"E-REF {asked} = True: expected False, as the scene was opened"):
            sent.render(0, **{asked: True})
