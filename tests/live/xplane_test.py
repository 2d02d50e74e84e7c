#!/usr/bin/python3
"""A stand-in for X-Plane, by the vendor's description, flies fanbeam live (./dev live-test). X-Plane itself cannot run here.

usage: xplane_test.py FANBEAM
"""
import json
import os
import re
import signal
import socket
import struct
import subprocess
import sys
import threading
import time
import unittest
import urllib.request

FANBEAM = os.path.abspath(sys.argv[1])
GROUP, BEACON_PORT = "239.255.1.1", 49707
VISIBILITY, RAIN = "sim/weather/visibility_reported_m", "sim/weather/rain_percent"


class StandIn:
    """Sends what is asked for to who asks, as often as asked, and forgets them when it is started anew."""

    def __init__(self):
        self.wire = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.wire.bind(("127.0.0.1", 0))
        self.wire.settimeout(0.01)
        self.port = self.wire.getsockname()[1]
        self.weather = {VISIBILITY: 20000.0, RAIN: 0.0}
        self.positions, self.values, self.farewells = {}, {}, 0
        self.longitude_deg, self.leaving = 10.0, False
        self.thread = threading.Thread(target=self.run, daemon=True)
        self.thread.start()

    def start_anew(self):
        self.positions, self.values = {}, {}

    def close(self):
        self.leaving = True
        self.thread.join()
        self.wire.close()

    def hear(self, data, sender):
        if data[:5] == b"RPOS\0":
            rate = int(data[5:].rstrip(b"\0"))
            self.farewells += rate == 0
            self.positions[sender] = [rate, 0.0]
        elif data[:5] == b"RREF\0" and len(data) == 413:
            rate, index = struct.unpack_from("<ii", data, 5)
            self.values[sender, index] = [rate, 0.0, data[13:].rstrip(b"\0").decode()]

    def send(self, now):
        for sender, one in list(self.positions.items()):
            if one[0] and now - one[1] >= 1 / one[0]:
                one[1] = now
                self.longitude_deg += 1e-5
                self.wire.sendto(b"RPOS4" + struct.pack("<3d10f", self.longitude_deg, 52.0, 120.0, 20.0, -3.0, 90.0, 0.0, 60.0,
                                                        0.0, 0.0, 0.0, 0.0, 0.0), sender)
        for (sender, index), one in list(self.values.items()):
            if one[0] and now - one[1] >= 1 / one[0]:
                one[1] = now
                self.wire.sendto(b"RREF," + struct.pack("<if", index, self.weather[one[2]]), sender)

    def run(self):
        while not self.leaving:
            try:
                self.hear(*self.wire.recvfrom(65536))
            except TimeoutError:
                pass
            self.send(time.monotonic())

    def beacon(self):
        data = b"BECN\0" + struct.pack("<BBiiIH", 1, 2, 1, 120100, 1, self.port) + b"cockpit\0"
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as wire:
            wire.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, socket.inet_aton("127.0.0.1"))
            wire.bind(("127.0.0.1", 0))
            wire.sendto(data, (GROUP, BEACON_PORT))


class XPlane(unittest.TestCase):
    def setUp(self):
        self.simulator = StandIn()
        self.addCleanup(self.simulator.close)

    def fly(self, source):
        self.channel = subprocess.Popen([FANBEAM, "live", "flat-grass", "--from", source, "--http", "0", "--rays-per-cell", "1"],
                                        stdout=subprocess.PIPE, text=True)
        self.addCleanup(self.channel.wait)
        self.addCleanup(self.channel.kill)
        self.addCleanup(self.channel.stdout.close)
        self.page = re.search(r"http://\S+", self.channel.stdout.readline()).group(0)

    def get(self, path):
        with urllib.request.urlopen(self.page + path, timeout=10) as answer:
            return json.load(answer)

    def wait_for(self, what, seconds=20):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if what():
                return
            time.sleep(0.1)
        self.fail("waited in vain")

    def frame(self):
        """What the next frame says of itself."""
        with urllib.request.urlopen(self.page + "frames", timeout=10) as stream:
            size, = struct.unpack("<I", stream.read(4))
            return json.loads(stream.read(size).split(b"\n", 1)[0])

    def test_a_flight_its_weather_a_restart_and_the_end(self):
        self.fly(f"xplane:127.0.0.1:{self.simulator.port},datum=ellipsoid,weather=simulator")
        self.wait_for(lambda: self.get("api/status")["frames"] > 3)
        frame = self.frame()
        self.assertAlmostEqual(frame["latitude_deg"], 52.0, delta=1e-9)
        self.assertAlmostEqual(frame["height_m"], 120.0, delta=1e-3)
        self.assertAlmostEqual(frame["longitude_deg"], self.simulator.longitude_deg, delta=1e-3)
        self.assertAlmostEqual(frame["heading_deg"] % 360, 90.0, delta=1e-4)
        self.simulator.weather[RAIN] = 1.0
        self.wait_for(lambda: self.get("api/weather")["rain_rate_mm_per_h"] == 22)
        self.simulator.start_anew()
        self.wait_for(lambda: self.simulator.positions)
        number = self.get("api/status")["frames"]
        self.wait_for(lambda: self.get("api/status")["frames"] > number + 3)
        self.channel.send_signal(signal.SIGTERM)
        self.channel.wait(timeout=20)
        self.wait_for(lambda: self.simulator.farewells == 1)
        self.assertEqual(self.channel.returncode, 0)

    def test_the_beacon_tells_where_it_is(self):
        self.fly("xplane:beacon,datum=ellipsoid")

        def frames_come():
            self.simulator.beacon()
            return self.get("api/status")["frames"] > 3

        self.wait_for(frames_come)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:], verbosity=2)
