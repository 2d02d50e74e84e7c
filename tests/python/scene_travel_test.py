"""Scenes that threads share, and those that are sent to other processes: what was told goes along."""

import multiprocessing
import os
import pickle
import shutil
import subprocess
import sys
import textwrap
import threading
import time
import warnings

import fanbeam
import numpy as np
import pytest


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


def ticks_beside(work):
    """Of another thread, and when the work began and ended."""
    ticks, done = [], threading.Event()

    def tick():
        while not done.wait(0.001):
            ticks.append(time.monotonic())

    thread = threading.Thread(target=tick)
    thread.start()
    begin = time.monotonic()
    work()
    end = time.monotonic()
    done.set()
    thread.join()
    return ticks, begin, end


def test_pythons_lock_is_free_while_a_frame_is_made(runway):
    ticks, begin, end = ticks_beside(lambda: [runway.render(frame) for frame in range(1000, 1010)])
    # Held, the other thread would tick some ten times.
    assert len(ticks) > max(30, 100 * (end - begin))


def test_pythons_lock_is_free_while_many_angles_are_looked_up():
    angles = np.full(10**7, 0.1)
    ticks, begin, end = ticks_beside(lambda: fanbeam.nrcs("short_grass", angles))
    # Held, the other thread would tick at either end.
    middle = [at for at in ticks if begin + 0.2 * (end - begin) < at < end - 0.2 * (end - begin)]
    assert len(middle) > 3


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
