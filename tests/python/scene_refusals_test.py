"""What calls of a scene refuse, and how they tell of it."""

import re

import fanbeam
import numpy as np
import pytest


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
    with pytest.raises(fanbeam.InputError) as told:
        grass.set_targets(
            [
                fanbeam.Target("far", 95.0, 10.0, 0.0),
                fanbeam.Target("", 52.0, 10.0, 0.0, 1.0),
                fanbeam.Target("far", 52.0, 10.0, 0.0, 1.0),
            ]
        )
    assert [(problem.code, problem.field) for problem in told.value.problems] == [
        ("E-RANGE", "target[0].latitude_deg"),
        ("E-REF", "target[0].name"),  # new, and without rcs_m2
        ("E-RANGE", "target[1].name"),
        ("E-REF", "target[2].name"),  # again
    ]
    with pytest.raises(TypeError):
        grass.set_weather(rain=3)
    with pytest.raises(TypeError, match="rain_rate"):
        grass.set_weather(rain_rate_mm_per_h="much")
    with pytest.raises(fanbeam.InputError, match="frame = 99999: expected 0 to 0, or -1"):
        grass.render(99999)
    with pytest.raises(TypeError, match="frame: expected a fanbeam.Pose or a whole number, not 'now'"):
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
        ("tilt_deg low_dB,high_dB", lambda scene: scene.set_sensor(tilt_deg=1e3, low_dB=5.0, high_dB=-5.0)),
        # Nothing is said of a window of a level that is none and the sensor's own.
        ("low_dB", lambda scene: scene.set_sensor(low_dB=10**400, high_dB=-399.0)),
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
        ("frequency_Hz humidity", lambda scene: fanbeam.Atmosphere(94, humidity=2.0)),
    ],
)
def test_problems_of_one_call_are_told_together(grass, fields, call):
    with pytest.raises(fanbeam.InputError) as told:
        call(grass)
    assert sorted(problem.field.replace(", ", ",") for problem in told.value.problems) == sorted(fields.split())
    assert "--" not in str(told.value)


def test_a_frame_of_nothing_is_refused(grass):
    nothing = {"bscope": False, "cscope": False}
    with pytest.raises(fanbeam.InputError) as told:
        grass.render(0, frame_index=-1, **nothing)
    assert [(problem.code, problem.field) for problem in told.value.problems] == [
        ("E-RANGE", "frame_index"),
        ("E-REF", "bscope, cscope, layers, cscope_layers, labels"),
    ]
    assert grass.render(0, **nothing, layers=True).layers is not None


def test_a_number_that_is_too_large_is_told_the_range_of_its_field(grass):
    with pytest.raises(fanbeam.InputError, match=f"threads = {2**70}: expected 0 to 1024$"):
        fanbeam.Scene.open("flat-grass", threads=2**70)
    with pytest.raises(fanbeam.InputError, match="noise_figure_dB = 10{400}: expected 0 to 60 dB$"):
        grass.set_sensor(noise_figure_dB=10**400)


# With GHz in mind; extrapolation is of no help there.
def test_a_frequency_that_no_model_takes_is_told_by_its_argument():
    with pytest.raises(fanbeam.InputError, match="E-RANGE frequency_Hz = 94: expected 1e9 to 1e12 Hz$"):
        fanbeam.Atmosphere(94)
    with pytest.raises(fanbeam.InputError, match="E-RANGE frequency_Hz = 35: expected 1e8 to 3e11 Hz$"):
        fanbeam.nrcs("short_grass", 0.1, frequency_Hz=35)


def test_angles_out_of_range_are_told_by_their_index():
    angles = np.full((3, 5), 0.1)
    angles[1, 4], angles[2, 0] = np.nan, 2.0
    for told, fields in ((angles, ["grazing_rad[1, 4]", "grazing_rad[2, 0]"]), ([0.1, -0.1], ["grazing_rad[1]"])):
        with pytest.raises(fanbeam.InputError) as refused:
            fanbeam.nrcs("short_grass", told)
        assert [problem.field for problem in refused.value.problems] == fields
    with pytest.raises(fanbeam.InputError) as refused:
        fanbeam.nrcs("short_grass", np.full(10**6, np.nan))
    assert [problem.field for problem in refused.value.problems[:2]] == ["grazing_rad[0]", "grazing_rad[1]"]
    assert refused.value.problems[-1].code == "W-MORE"


def test_a_library_that_is_none_is_told_beside_what_else_is_wrong(tmp_path):
    with pytest.raises(fanbeam.InputError) as told:
        fanbeam.nrcs("short_grass", 2.0, state="moist", library=tmp_path / "none.toml")
    assert [problem.field for problem in told.value.problems] == ["grazing_rad", "state", ""]
    assert told.value.problems[2].file == str(tmp_path / "none.toml")


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
        ("frame", lambda scene: scene.render((52.0, 10.0, 60.0))),
        # True is no number here, as 1 is no truth.
        ("frame", lambda scene: scene.render(True)),
        ("frame", lambda scene: scene.render(np.bool_(False))),
        ("seed", lambda scene: fanbeam.Scene.open("flat-grass", seed=True)),
        ("tilt_deg", lambda scene: scene.set_sensor(tilt_deg=False)),
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
        ("targets", lambda scene: scene.set_targets("mast")),
        ("targets", lambda scene: scene.set_targets(np.array(2.5))),
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
        ("grazing_rad", lambda scene: fanbeam.nrcs("short_grass", True)),
        ("grazing_rad", lambda scene: fanbeam.nrcs("short_grass", np.ma.array([0.1, 0.2], mask=[False, True]))),
        ("polarisation", lambda scene: fanbeam.nrcs("short_grass", 0.1, polarisation=None)),
        ("extrapolate", lambda scene: fanbeam.nrcs("short_grass", 0.1, extrapolate="yes")),
        ("frequency_Hz", lambda scene: fanbeam.Atmosphere("35e9")),
        ("height_m", lambda scene: fanbeam.Atmosphere().one_way_dB_per_km("low")),
    ],
)
def test_another_type_is_a_type_error_that_names_the_field(grass, field, call):
    with pytest.raises(TypeError, match=f"^{re.escape(field)}: expected "):
        call(grass)


class Unshown:
    def __repr__(self):
        raise ZeroDivisionError


# Python makes no text of an integer above 4300 digits, nor of every object.
def test_what_has_no_text_is_told_with_its_field(grass):
    long = 10**5000
    for field, call in (
        ("frame", lambda: grass.render(long)),
        ("frame_index", lambda: grass.render(0, frame_index=-long)),
        ("tilt_deg", lambda: grass.set_sensor(tilt_deg=long)),
        ("seed", lambda: fanbeam.Scene.open("flat-grass", seed=long)),
    ):
        with pytest.raises(fanbeam.InputError, match=f"^E-RANGE {field} = a whole number of 16610 bits: expected "):
            call()
    with pytest.raises(TypeError, match="^surface: expected a text, not a whole number of 16610 bits$"):
        grass.set_surface(long)
    for field, call in (
        ("targets", lambda: grass.set_targets(Unshown())),
        ("target[0]", lambda: grass.set_targets([Unshown()])),
        ("frame", lambda: grass.render(Unshown())),
    ):
        with pytest.raises(TypeError, match=f"^{re.escape(field)}: expected .*, not one of type .*Unshown$"):
            call()


def test_an_angle_of_a_target_that_is_too_large_is_a_number_out_of_range(grass):
    with pytest.raises(fanbeam.InputError) as told:
        grass.set_targets([fanbeam.Target("new", 52.0, 10.0, 0.0, 1.0, attitude_deg=(0, 10**400, 0))])
    assert [(problem.code, problem.field) for problem in told.value.problems] == [("E-RANGE", "target[0].pitch_deg")]
    with pytest.raises(TypeError, match=r"^target\[0\]\.heading_deg: expected a number, not 'north'$"):
        grass.set_targets([fanbeam.Target("new", 52.0, 10.0, 0.0, 1.0, attitude_deg=(0, 0, "north"))])


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
        ("name", b"3"),
        ("latitude_deg", "52"),
        ("height_m", None),
        ("rcs_m2", "bright"),
        ("attitude_deg", (0.0, 0.0)),
        ("attitude_deg", np.array(1.0)),
        ("attitude_deg", 3),
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
