#!/usr/bin/python3
"""FlightGear itself flies the radar, with the add-on, under Xvfb (./dev live-test flightgear).

usage: flightgear_test.py FANBEAM DATA [FOLDER]   DATA is the shared data; FOLDER keeps screenshots

FlightGear draws with the processor here, and fanbeam live renders beside it: the rates that are printed
are of both on one machine.
"""
import json
import math
import os
import re
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.request

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PLUGIN = os.path.join(ROOT, "plugins", "flightgear")
FANBEAM, DATA = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
FOLDER = os.path.abspath(sys.argv[3]) if len(sys.argv) > 3 else None
PATIENCE_S = 420  # the first start builds a navigation database

# What keeps FlightGear 2020.3 from crashing under llvmpipe, and from asking for the network.
QUIET = """--disable-sound --disable-terrasync --disable-fgcom --disable-real-weather-fetch --disable-ai-models
--disable-ai-traffic --disable-random-objects --disable-random-vegetation --disable-random-buildings --disable-clouds
--disable-clouds3d --disable-specular-highlight --disable-distance-attenuation --disable-horizon-effect
--disable-splash-screen --disable-hud --disable-panel --disable-save-on-exit --timeofday=noon --season=summer
--prop:/sim/rendering/multithreading-mode=SingleThreaded --prop:/sim/rendering/shaders/quality-level=0
--prop:/sim/rendering/multi-sample-buffers=0 --prop:/sim/rendering/shadows/enabled=0 --prop:/sim/tutorials/first-run=0
--prop:/sim/gui/startup-tips=0 --visibility=9000 --geometry=800x640""".split()


def free_port(kind):
    with socket.socket(socket.AF_INET, kind) as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def stop(process):
    """With its children: they are a session of their own."""
    try:
        os.killpg(process.pid, signal.SIGTERM)
        process.wait(20)
    except (ProcessLookupError, subprocess.TimeoutExpired):
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()


class Properties:
    """FlightGear's property server: a line a command."""

    def __init__(self, port):
        self.wire = socket.create_connection(("127.0.0.1", port), 20)
        self.wire.settimeout(60)
        self.lines = self.wire.makefile("rw", newline="\r\n", encoding="latin-1")
        self.say("data")

    def say(self, line):
        self.lines.write(line + "\r\n")
        self.lines.flush()

    def get(self, name):
        self.say("get " + name)
        return self.lines.readline().strip()

    def number(self, name):
        return self.numbers([name])[0]

    def numbers(self, names):
        """Of one display frame: FlightGear answers once in each, whatever has been asked."""
        self.lines.write("".join(f"get {name}\r\n" for name in names))
        self.lines.flush()
        return [float(self.lines.readline().strip() or "nan") for _ in names]

    def set(self, name, value):
        self.say(f"set {name} {value}")


class Flight:
    aircraft = None
    throttle = None  # that lets it fly, where it does not by itself

    @classmethod
    def setUpClass(cls):
        cls.processes = []
        try:
            cls.begin()
        except BaseException:
            cls.tearDownClass()
            raise

    @classmethod
    def start(cls, command, **options):
        cls.processes.append(subprocess.Popen(command, start_new_session=True, **options))
        return cls.processes[-1]

    @classmethod
    def begin(cls):
        feed, cls.telnet = free_port(socket.SOCK_DGRAM), free_port(socket.SOCK_STREAM)
        cls.live = cls.start([FANBEAM, "live", "keflavik-10", "--data", DATA, "--http", "0", "--rate", "8", "--from",
                              f"fg-generic:{feed},weather=simulator"], stdout=subprocess.PIPE, text=True)
        cls.url = re.search(r"http://\S+", cls.live.stdout.readline()).group(0)
        display = f":{70 + os.getpid() % 20}"
        cls.start(["Xvfb", display, "-screen", "0", "800x640x24", "-noreset", "-nolisten", "tcp"],
                  stderr=subprocess.DEVNULL)
        cls.home = tempfile.TemporaryDirectory()
        cls.environment = dict(os.environ, DISPLAY=display, FG_HOME=cls.home.name, HOME=cls.home.name,
                               LIBGL_ALWAYS_SOFTWARE="1", GALLIUM_DRIVER="llvmpipe", LP_NUM_THREADS="1",
                               DBUS_FATAL_WARNINGS="0")
        time.sleep(2)
        with open(os.path.join(FOLDER or cls.home.name, f"fgfs-{cls.aircraft}.log"), "w", encoding="utf-8") as log:
            cls.fgfs = cls.start_simulator(feed, log)
        end = time.time() + PATIENCE_S
        while cls.asked("api/status")["frames"] == 0:
            assert cls.fgfs.poll() is None, "FlightGear ended"
            assert time.time() < end, "no frame: FlightGear sends nothing"
            time.sleep(1)
        cls.properties = Properties(cls.telnet)

    @classmethod
    def start_simulator(cls, feed, log):
        return cls.start(
            ["dbus-run-session", "--", "/usr/games/fgfs", *QUIET, f"--addon={PLUGIN}", f"--data={PLUGIN}",
             f"--prop:string:/fanbeam/http={cls.url.rstrip('/')}", f"--prop:int:/fanbeam/port={feed}",
             f"--telnet={cls.telnet}", f"--aircraft={cls.aircraft}", "--airport=BIKF", "--runway=10",
             "--offset-distance=1.5", "--glideslope=3", "--vc=90", "--in-air"],
            env=cls.environment, stdout=log, stderr=subprocess.STDOUT)

    @classmethod
    def tearDownClass(cls):
        for process in reversed(cls.processes):
            stop(process)

    @classmethod
    def asked(cls, path):
        with urllib.request.urlopen(f"{cls.url}{path}", timeout=30) as answer:
            return json.load(answer)

    def head(self):
        """What the newest frame says of itself."""
        with urllib.request.urlopen(f"{self.url}frames", timeout=30) as stream:
            size = int.from_bytes(stream.read(4), "little")
            return json.loads(stream.read(size).split(b"\n", 1)[0])

    def wait(self, done, what, seconds=90):
        end = time.time() + seconds
        while not done():
            self.assertLess(time.time(), end, f"no {what} within {seconds} s")
            time.sleep(0.5)

    def look(self, ending):
        """Keeps a screenshot, in which both halves of the window show something."""
        file = os.path.join(FOLDER or self.home.name, f"flightgear-{self.aircraft}{ending}.png")
        subprocess.run(["import", "-window", "root", file], env=self.environment, check=True)
        for left in (14, 180):
            mean = subprocess.run(["convert", file, "-crop", f"150x500+{left}+60", "-format", "%[fx:mean]", "info:"],
                                  check=True, capture_output=True, text=True).stdout
            self.assertGreater(float(mean), 0.02, file)

    def pictures(self):
        return self.properties.number("/fanbeam/pictures")

    def way(self, seconds):
        """FlightGear's places (metres north and east of the first, heading, time) and frames of the radar between."""
        places, heads = [], []
        end = time.time() + seconds
        while time.time() < end:
            latitude, longitude, heading = self.properties.numbers(
                ["/position/latitude-deg", "/position/longitude-deg", "/orientation/heading-deg"])
            if not places:
                north_m, east_m = 111.2e3, 111.2e3 * math.cos(math.radians(latitude))
                begin = (latitude, longitude)
            places.append(((latitude - begin[0]) * north_m, (longitude - begin[1]) * east_m, heading, time.time()))
            if len(places) > 2 and time.time() < end - 8:
                head = self.head()
                heads.append(((head["latitude_deg"] - begin[0]) * north_m,
                              (head["longitude_deg"] - begin[1]) * east_m, head["heading_deg"], time.time()))
        return places, heads

    def test_1_frames_follow_the_aircraft(self):
        """On the way that FlightGear says it flew, at most some seconds behind or ahead of it: it draws and tells few
        places, and the radar's frames lie between."""
        if self.throttle:
            self.properties.set("/controls/engines/engine/throttle", self.throttle)
            time.sleep(5)
        places, heads = self.way(40)
        if self.throttle:
            self.properties.set("/controls/engines/engine/throttle", 0)
        self.assertGreater(len(heads), 4)
        self.assertGreater(sum(math.dist(a[:2], b[:2]) for a, b in zip(places, places[1:])), 200)
        farthest = oldest = 0.0
        for north, east, heading, at in heads:
            nearest = None
            for a, b in zip(places, places[1:]):
                step = (b[0] - a[0], b[1] - a[1])
                square = step[0] ** 2 + step[1] ** 2
                share = ((north - a[0]) * step[0] + (east - a[1]) * step[1]) / square if square > 0 else 0
                share = min(max(share, 0), 1)
                off = math.hypot(north - a[0] - share * step[0], east - a[1] - share * step[1])
                if nearest is None or off < nearest[0]:
                    nearest = (off, a[3] + share * (b[3] - a[3]), a[2])
            farthest, oldest = max(farthest, nearest[0]), max(oldest, abs(at - nearest[1]))
            self.assertLess(abs((heading - nearest[2] + 540) % 360 - 180), 15)
        print(f"\n{self.aircraft}: {len(heads)} frames at most {farthest:.0f} m beside FlightGear's way, {oldest:.1f} s"
              f" from its place there; {len(places)} places in 40 s", flush=True)
        self.assertLess(farthest, 50)
        # FlightGear sends one place for each frame it draws, and seconds pass between them while it loads scenery.
        self.assertLess(oldest, 1 + 2 * max(b[3] - a[3] for a, b in zip(places, places[1:])))
        bad = self.asked("api/status")["bad_packets"]
        self.assertFalse([reason for reason in bad if "late" not in reason and "jump" not in reason], bad)

    def test_2_the_window_shows_pictures_one_after_the_other(self):
        self.wait(lambda: self.pictures() > 3, "picture in the window")
        begin, before, failed = time.time(), self.pictures(), self.properties.number("/fanbeam/failed")
        rates = []
        while time.time() < begin + 30:
            time.sleep(3)
            rates.append(self.properties.number("/sim/frame-rate"))
        rate = (self.pictures() - before) / (time.time() - begin)
        print(f"\n{self.aircraft}: {rate:.2f} pictures a second in the window, where FlightGear draws "
              f"{sum(rates) / len(rates):.1f} frames a second", flush=True)
        self.assertGreater(rate, 0.2)
        # While it loads scenery a picture may come too late; now none does.
        self.assertEqual(self.properties.number("/fanbeam/failed"), failed)
        self.look("")

    def test_3_weather_arrives(self):
        self.assertEqual(self.asked("api/weather")["rain_rate_mm_per_h"], 0)
        for name in ("/environment/metar/rain-norm", "/environment/rain-norm"):
            self.properties.set(name, 0.8)
        self.wait(lambda: self.asked("api/weather")["rain_rate_mm_per_h"] > 1, "rain")
        for name in ("/environment/metar/rain-norm", "/environment/rain-norm"):
            self.properties.set(name, 0)
        self.wait(lambda: self.asked("api/weather")["rain_rate_mm_per_h"] == 0, "end of the rain")

    def test_4_freeze_and_the_other_scope(self):
        self.properties.set("/fanbeam/scope", "cscope")
        before = self.pictures()
        self.wait(lambda: self.pictures() > before + 2, "C-scope")
        self.look("-cscope")
        self.properties.set("/fanbeam/frozen", 1)
        time.sleep(6)
        held = self.pictures()
        time.sleep(5)
        self.assertEqual(self.pictures(), held)
        self.properties.set("/fanbeam/frozen", 0)
        self.wait(lambda: self.pictures() > held, "picture after the freeze")


class Ufo(Flight, unittest.TestCase):
    aircraft = "ufo"
    throttle = 0.045


class Cessna(Flight, unittest.TestCase):
    aircraft = "c172p"


if __name__ == "__main__":
    if FOLDER:
        os.makedirs(FOLDER, exist_ok=True)
    unittest.main(argv=sys.argv[:1], verbosity=2)
