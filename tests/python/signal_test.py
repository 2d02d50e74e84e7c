"""Beat signals and detections, held against closed forms."""

import subprocess
import sys

import fanbeam
import fanbeam.signal
import numpy as np
import pytest


@pytest.fixture(scope="module")
def lone_target():
    # Ground beyond 600 m folds in range: far below this target.
    scene = fanbeam.Scene.open("flat-grass", effects="none")
    here = scene.trajectory[0]
    north_deg = np.degrees(400.0 / 6371000.0)
    scene.set_targets([fanbeam.Target("mast", here.latitude_deg + north_deg, here.longitude_deg, 60.0, rcs_m2=1e5)])
    return scene


def test_a_target_is_detected_where_it_stands(lone_target):
    numbers = {"bandwidth": 150e6, "ramp": 40e-6, "chirps": 64, "sample_rate": 28e6}
    want = ("beat", "range-doppler", "detections")
    with pytest.warns(fanbeam.FanbeamWarning, match="W-FOLDED"):
        seen = fanbeam.signal.frame(lone_target, 0, want=want, waveform="chirp-sequence", numbers=numbers)
    assert len(seen.beats) == 1 and seen.beats[0].dtype == np.complex64 and seen.beats[0].shape[0] == 12
    assert seen.range_doppler_W.shape == (len(seen.speed_mps), len(seen.range_m))
    strongest = seen.detections[np.argmax(seen.detections["power_W"])]
    # A degree of latitude is 0.2 % longer here than on the sphere that the target was placed by.
    assert strongest["range_m"] == pytest.approx(400.0, abs=1.0)
    assert strongest["radial_speed_mps"] == pytest.approx(0.0, abs=0.05)
    assert np.degrees(strongest["azimuth_rad"]) == pytest.approx(0.0, abs=0.1)
    row, column = np.unravel_index(np.argmax(seen.range_doppler_W), seen.range_doppler_W.shape)
    assert abs(seen.range_m[column] - strongest["range_m"]) <= seen.range_m[1]
    assert abs(seen.speed_mps[row]) <= seen.speed_mps[1] - seen.speed_mps[0]


def test_axes_are_as_long_as_maps_and_cube_whose_far_cells_are_left_out():
    road = fanbeam.Scene.open("highway-76ghz")
    want = ("beat", "cube", "range-doppler", "range-azimuth")
    seen = fanbeam.signal.frame(road, 0, want=want, numbers={"chirps": 32})
    assert seen.range_doppler_W.shape == (len(seen.speed_mps), len(seen.range_m))
    assert seen.range_azimuth_W.shape == (len(seen.azimuth_rad), len(seen.range_m))
    assert seen.cube.shape == (len(seen.azimuth_rad), len(seen.speed_mps), len(seen.range_m))
    assert len(seen.range_m) < seen.beats[0].shape[2]


def test_the_waveform_tells_its_resolution():
    told = fanbeam.signal.waveform("chirp-sequence", bandwidth=150e6)
    stage = told["stages"][0]
    assert stage["range_cell_m"] == pytest.approx(299792458.0 / (2 * 150e6), rel=1e-12)
    wavelength_m = 299792458.0 / told["centre_frequency_Hz"]
    assert stage["speed_cell_mps"] == pytest.approx(wavelength_m / (2 * told["duration_s"]), rel=1e-9)
    with pytest.raises(fanbeam.InputError, match="bandwidth"):
        fanbeam.signal.waveform("chirp-sequence", band=150e6)
    with pytest.raises(fanbeam.InputError, match="bandwidth"):
        fanbeam.signal.waveform("chirp-sequence", bandwidth=-1.0)
    with pytest.raises(fanbeam.InputError, match="kind = .*triangle"):
        fanbeam.signal.waveform("chirps")
    with pytest.raises(fanbeam.InputError) as told:
        fanbeam.signal.waveform("triangle", code_degree=7)
    assert told.value.problems[0].field == "code_degree"


def test_a_frame_that_the_flight_has_not_is_told(lone_target):
    with pytest.raises(fanbeam.InputError, match="frame = 99999"):
        fanbeam.signal.frame(lone_target, 99999)


def test_what_a_radar_cannot_be_is_told_by_arguments(lone_target):
    with pytest.raises(fanbeam.InputError, match="waveform = .*automotive-76ghz, .*stepped"):
        fanbeam.signal.frame(lone_target, 0, waveform="chirps")
    with pytest.raises(fanbeam.InputError) as told:
        fanbeam.signal.frame(lone_target, 0, numbers={"slots": 2})
    assert (told.value.problems[0].field, told.value.problems[0].expected) == ("slots", "1, or as many as transmitters")


def test_numbers_that_do_not_go_together_are_told_in_SI_as_they_were_given(lone_target):
    with pytest.raises(fanbeam.InputError) as told:
        fanbeam.signal.waveform("chirp-sequence", interval=10e-6)
    (problem,) = told.value.problems
    assert (problem.field, problem.value, problem.expected) == ("interval", "1e-05", "at least the ramp")
    with pytest.raises(fanbeam.InputError, match="hop = 700000: expected a parameter of triangle"):
        fanbeam.signal.waveform("triangle", hop=700e3)
    with pytest.raises(fanbeam.InputError, match="frequency = 77000000000: expected the scene's sensor's 35"):
        fanbeam.signal.frame(lone_target, 0, want=("beat",), numbers={"frequency": 77e9})


def test_what_is_wanted_is_checked(lone_target):
    with pytest.raises(ValueError, match="beats"):
        fanbeam.signal.frame(lone_target, 0, want=("beats",))
    with pytest.raises(fanbeam.InputError) as told:
        fanbeam.signal.frame(lone_target, 0, want=["maps", "beat", "beats"], seed=-1)
    assert [(problem.code, problem.field, problem.value) for problem in told.value.problems] == [
        ("E-REF", "want", '"beats"'),
        ("E-REF", "want", '"maps"'),
        ("E-RANGE", "seed", "-1"),
    ]
    assert told.value.problems[0].expected == "beat, cube, range-doppler, range-azimuth, detections"
    # A text is an iterable too, of letters.
    for want, value in (("beat", "'beat'"), (b"beat", "b'beat'"), (["beat", 1], "1"), ([[1]], r"\[1\]"),
                        ([b"beat"], "b'beat'"), (np.array(1.0), r"array\(1\.\)")):
        with pytest.raises(TypeError, match=f"^want: expected an iterable of texts, not {value}$"):
            fanbeam.signal.frame(lone_target, 0, want=want)
    with pytest.raises(fanbeam.InputError) as told:
        fanbeam.signal.frame(lone_target, 0, transmitters=0, adc_bits=99)
    assert {problem.field for problem in told.value.problems} == {"transmitters", "adc_bits"}
    with pytest.raises(fanbeam.InputError, match="E-LIMIT samples x chirps x channels"):
        fanbeam.signal.frame(lone_target, 0, waveform="continuous", receivers=64, numbers={"duration": 1000.0})


def test_maps_and_detections_of_a_waveform_without_them_are_refused(lone_target):
    for product in ("detections", "range-doppler", "range-azimuth", "cube"):
        with pytest.raises(fanbeam.InputError, match=f'E-UNSUPPORTED want = "{product}": expected beat: ') as told:
            fanbeam.signal.frame(lone_target, 0, want=("beat", product), waveform="triangle")
        assert told.value.problems[0].field == "want"
    # By default what there is.
    seen = fanbeam.signal.frame(lone_target, 0, waveform="triangle", transmitters=1, receivers=1, rays_per_cell=0.3)
    assert len(seen.beats) == 1 and seen.beats[0].shape[:2] == (1, 2) and seen.detections is None


def test_a_value_of_another_type_is_told_with_its_field(lone_target):
    for field, value in (("seed", "x"), ("receivers", 1.5), ("real", "yes"), ("unfold", 1), ("waveform", 5),
                         ("radar", 3), ("numbers", 3), ("numbers", np.array([1.0, 2.0])), ("numbers", []),
                         ("want", 3)):
        with pytest.raises(TypeError, match=f"{field}: expected "):
            fanbeam.signal.frame(lone_target, 0, **{field: value})
    with pytest.raises(TypeError, match="bandwidth: expected a number, not 'x'"):
        fanbeam.signal.frame(lone_target, 0, numbers={"bandwidth": "x"})
    with pytest.raises(TypeError, match="bandwidth: expected a number, not 'x'"):
        fanbeam.signal.waveform("chirp-sequence", bandwidth="x")
    with pytest.raises(TypeError, match="chirps: expected a number, not True"):
        fanbeam.signal.waveform(chirps=True)
    with pytest.raises(TypeError, match="kind: expected a text, not 3"):
        fanbeam.signal.waveform(3)
    with pytest.raises(TypeError, match="scene: expected a fanbeam.Scene, not 'highway-76ghz'"):
        fanbeam.signal.frame("highway-76ghz", 0)
    with pytest.raises(TypeError, match="frame: expected a whole number, not 'first'"):
        fanbeam.signal.frame(lone_target, "first")


def test_all_numbers_out_of_range_are_told_together(lone_target):
    with pytest.raises(fanbeam.InputError) as told:
        fanbeam.signal.frame(lone_target, 0, seed=-1, receivers=2**40, numbers={"bandwidth": -1.0})
    assert {problem.field for problem in told.value.problems} == {"seed", "receivers", "bandwidth"}
    assert "receivers = 1099511627776: expected 1 to 64" in str(told.value)
    with pytest.raises(fanbeam.InputError, match="receivers = 1180591620717411303424: expected 1 to 64$"):
        fanbeam.signal.frame(lone_target, 0, receivers=2**70)
    # Nothing is said of the number that stands in for one that is too large.
    with pytest.raises(fanbeam.InputError) as told:
        fanbeam.signal.waveform("chirp-sequence", bandwidth=10**400, chirps=-1)
    assert sorted(problem.field for problem in told.value.problems) == ["bandwidth", "chirps"]


def test_a_radar_that_is_none_is_told_beside_what_else_is_wrong(lone_target, tmp_path):
    with pytest.raises(fanbeam.InputError) as told:
        fanbeam.signal.frame(lone_target, 0, radar=tmp_path / "none.toml", receivers=99, seed=-1)
    assert [problem.field for problem in told.value.problems] == ["", "receivers", "seed"]
    assert told.value.problems[0].file == str(tmp_path / "none.toml")


def test_too_few_chirps_for_the_detector_are_told_by_arguments(lone_target):
    # The usual window leaves out 2 and takes 2 cells on either side: 8 in all.
    with pytest.raises(fanbeam.InputError) as told:
        fanbeam.signal.frame(lone_target, 0, numbers={"chirps": 8})
    (problem,) = told.value.problems
    assert (problem.code, problem.field, problem.value) == ("E-RANGE", "chirps", "8")
    assert "--" not in problem.expected and "cfar_guard of a radar file" in problem.expected
    assert fanbeam.signal.frame(lone_target, 0, want=("beat",), numbers={"chirps": 8}).detections is None


def test_a_frame_keeps_to_the_threads_of_its_scene(share_of_all_threads):
    road = fanbeam.Scene.open("highway-76ghz", threads=1)
    assert share_of_all_threads(lambda: fanbeam.signal.frame(road, 0, want=("range-doppler",))) < 1.2


def test_numbers_of_elements_replace_the_places_of_a_radar_file(lone_target, tmp_path):
    file = tmp_path / "radar.toml"
    file.write_text("[array]\ntransmitter_right_m = [0.0]\nreceiver_right_m = [0.0, 0.002, 0.004]\n")
    own = fanbeam.signal.frame(lone_target, 0, want=("beat",), radar=file)
    more = fanbeam.signal.frame(lone_target, 0, want=("beat",), radar=file, transmitters=2)
    assert own.beats[0].shape[0] == 3
    assert more.beats[0].shape[0] == 6


def test_fftw_comes_with_signals_alone():
    script = "import fanbeam; print('fftw' in open('/proc/self/maps').read())"
    plain = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    both = subprocess.run([sys.executable, "-c", "import fanbeam.signal; " + script], capture_output=True, text=True, check=True)
    assert (plain.stdout.strip(), both.stdout.strip()) == ("False", "True")
