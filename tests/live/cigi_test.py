#!/usr/bin/python3
"""A scripted CIGI 3.3 host flies fanbeam live, and TShark reads what went over the wire (./dev live-test).

usage: cigi_test.py FANBEAM
"""
import json
import math
import os
import re
import shutil
import socket
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.request

FANBEAM = os.path.abspath(sys.argv[1])
# Ports of the host and of the image generator in captures. The true ones are the system's choice; of 33435 to 33464
# TShark says "possible traceroute", whatever the datagram holds.
CAPTURED = (8005, 8004)
OPERATE = 0x31


class Host:
    """Sends messages in one byte order, and keeps both directions as a capture."""

    def __init__(self, port, order):
        self.port, self.order, self.frame = port, order, 0
        self.wire = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.wire.bind(("127.0.0.1", 0))
        self.wire.settimeout(10)
        self.records, self.ig_frame = [], 0

    def pack(self, layout, *values):
        return struct.pack(self.order + layout, *values)

    def send(self, *packets, mode=OPERATE, database=1):
        self.frame += 1
        head = self.pack("BBBbBBHIIII", 1, 24, 3, database, mode, 0, 0x8000, self.frame, 0, self.ig_frame, 0)
        message = head + b"".join(packets)
        self.wire.sendto(message, ("127.0.0.1", self.port))
        self.keep(message, *CAPTURED)
        return self.frame

    def receive(self):
        message = self.wire.recv(65536)
        self.keep(message, *reversed(CAPTURED))
        packets, at = [], 0
        while at < len(message):
            packets.append(message[at : at + message[at + 1]])
            at += message[at + 1]
        assert packets[0][0] == 101, "start of frame first"
        self.ig_frame, = struct.unpack_from("<I", packets[0], 8)
        return packets

    def keep(self, data, source, target):
        udp = struct.pack(">HHHH", source, target, 8 + len(data), 0) + data
        local = bytes([127, 0, 0, 1])
        ip = struct.pack(">BBHHHBBH4s4s", 0x45, 0, 20 + len(udp), 0, 0, 64, 17, 0, local, local) + udp
        self.records.append(struct.pack("<IIII", 1, len(self.records), len(ip), len(ip)) + ip)

    def write(self, file):
        file.write(struct.pack("<IHHiIII", 0xA1B2C3D4, 2, 4, 0, 0, 65535, 101) + b"".join(self.records))
        file.flush()

    def entity(self, latitude_deg, longitude_deg, height_m, roll=0.0, pitch=0.0, heading=0.0):
        return self.pack("BBHBBBBHHfffddd", 2, 48, 0, 1, 0, 255, 0, 1, 0, roll, pitch, heading, latitude_deg,
                         longitude_deg, height_m)

    def height_request(self, number, latitude_deg, longitude_deg, height_m):
        return self.pack("BBHBBHddd", 24, 32, number, 2, 0, 0, latitude_deg, longitude_deg, height_m)

    def rain(self, severity):
        return self.pack("BBHBBBB12f", 12, 56, 0, 4, 0, 1, severity << 2, *([0.0] * 12))


class Cigi(unittest.TestCase):
    def start(self, *options, order="<", scene="braunschweig-26"):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as one:
            one.bind(("127.0.0.1", 0))
            port = one.getsockname()[1]
        live = subprocess.Popen([FANBEAM, "live", scene, "--http", "0", "--rays-per-cell", "0.5", "--from",
                                 f"cigi:{port},datum=ellipsoid", *options], stdout=subprocess.PIPE, text=True)
        self.addCleanup(self.end, live)
        self.url = re.search(r"http://\S+", live.stdout.readline()).group(0)
        host = Host(port, order)
        self.addCleanup(host.wire.close)
        return host

    def end(self, live):
        live.terminate()
        self.assertEqual(live.wait(20), 0)
        live.stdout.close()

    def asked(self, path):
        with urllib.request.urlopen(f"{self.url}{path}", timeout=20) as answer:
            return json.load(answer)

    def approach(self, i):
        """Down a straight line to the threshold of runway 26."""
        metres = 4000.0 - 4.0 * i
        return (52.320297 + 0.0001 * math.sin(i), 10.575681 + metres / 68000.0, 150.0 + 0.05 * metres,
                math.sin(i), -3.0, 264.0 + math.cos(i))

    def tshark(self, host, *fields):
        with tempfile.NamedTemporaryFile(suffix=".pcap") as file:
            host.write(file)
            self.assertEqual(self.read(file.name, ["-Y", "_ws.malformed || _ws.expert"]), "")
            self.assertEqual(len(self.read(file.name, ["-Y", "cigi"]).splitlines()), len(host.records))
            told = self.read(file.name, ["-T", "fields", "-E", "occurrence=a", "-E", "aggregator= ",
                                         *[word for field in fields for word in ("-e", field)]])
            return [line.split("\t") for line in told.splitlines()]

    def read(self, name, options):
        ports = [option for port in CAPTURED for option in ("-d", f"udp.port=={port},cigi")]
        return subprocess.run(["tshark", "-n", "-r", name, *ports, *options], check=True, capture_output=True,
                              text=True).stdout

    def test_a_host_in_lockstep_gets_a_frame_for_each_message_at_the_pose_it_sent(self):
        for order in ("<", ">"):
            host = self.start("--lockstep", order=order)
            with urllib.request.urlopen(f"{self.url}frames", timeout=60) as frames:
                for i in range(6):
                    place = self.approach(i)
                    number = host.send(host.entity(*place))
                    head = json.loads(frames.read(int.from_bytes(frames.read(4), "little")).split(b"\n", 1)[0])
                    for key, value in zip(("latitude_deg", "longitude_deg", "height_m"), place):
                        self.assertAlmostEqual(head[key], value, delta=1e-8)
                    for key, value in zip(("roll_deg", "pitch_deg", "heading_deg"), place[3:]):
                        self.assertAlmostEqual(head[key], value, delta=1e-4)  # sent as 32-bit numbers
                    while struct.unpack_from("<I", host.receive()[0], 16)[0] != number:
                        pass
            rows = self.tshark(host, "cigi.entity_control.lat_xoff", "cigi.sof.last_host_frame_number",
                               "cigi.sof.ig_mode")
            sent = [float(row[0]) for row in rows if row[0]]
            for i, latitude in enumerate(sent):
                self.assertAlmostEqual(latitude, self.approach(i)[0], delta=1e-6)
            self.assertEqual(len(sent), 6)
            told = [(int(row[1]), int(row[2], 0)) for row in rows if row[1]]
            self.assertEqual(told[-1], (6, 1))

    def test_start_of_frame_comes_at_the_rate_and_the_picture_follows(self):
        host = self.start("--rate", "8")
        host.send(host.entity(*self.approach(0)))
        begin, got = time.monotonic(), 0
        while time.monotonic() < begin + 4:
            host.receive()
            got += 1
            host.send(host.entity(*self.approach(got)))
        self.assertGreater(got, 20)
        self.assertGreater(self.asked("api/status")["frames"], 10)
        ticks = [int(row[0]) for row in self.tshark(host, "cigi.sof.timestamp") if row[0]]
        mean_s = 1e-5 * (ticks[-1] - ticks[0]) / (len(ticks) - 1)
        self.assertLess(abs(mean_s - 1 / 8), 0.03)

    def test_heights_materials_and_rain(self):
        host = self.start("--rate", "8")
        latitude, longitude = 52.320297, 10.575681  # threshold 26, on the runway
        host.send(host.entity(latitude, longitude + 0.03, 300.0), host.height_request(7, latitude, longitude - 0.005, 400.0),
                  host.rain(4), host.pack("BB14x", 201, 16))
        answer = None
        while answer is None:
            answer = next((packet for packet in host.receive() if packet[0] == 103), None)
        above_m, ground_m, material = struct.unpack_from("<ddI", answer, 8)
        self.assertAlmostEqual(above_m + ground_m, 400.0, places=6)
        told = self.tshark(host, "cigi.hat_hot_ext_response.hat", "cigi.hat_hot_ext_response.hot",
                           "cigi.hat_hot_ext_response.material_code")
        [row] = [row for row in told if row[0]]
        self.assertAlmostEqual(float(row[0]), above_m, places=4)
        self.assertAlmostEqual(float(row[1]), ground_m, places=4)
        self.assertEqual(int(row[2], 0), material)
        end = time.monotonic() + 20
        while self.asked("api/weather")["rain_rate_mm_per_h"] != 20 and time.monotonic() < end:
            time.sleep(0.2)
        self.assertEqual(self.asked("api/weather")["rain_rate_mm_per_h"], 20)
        self.assertEqual(self.asked("api/status")["unused_packets"], {"user_defined (201)": 1})

    def test_sensor_view_switches_and_time(self):
        for order in ("<", ">"):
            host = self.start("--lockstep", order=order)
            with urllib.request.urlopen(f"{self.url}frames", timeout=60) as frames:
                host.send(host.entity(*self.approach(0)),
                          host.pack("BBHBBBBffff", 17, 24, 1, 3, 1 | 2 << 5, 0, 0, 0.75, 0.25, 0.0, 0.5),
                          host.pack("BBHBBBBffffff", 21, 32, 1, 0, 3, 0, 0, 1000.0, 2000.0, 0.0, 0.0, 0.0, 0.0),
                          host.pack("BBHHBBfIIIII", 4, 32, 1, 7, 3, 1, -5.0, 0, 0, 0, 0, 0),
                          host.pack("BBHHBBII", 5, 16, 2, 7, 3, 0, 0, 0),
                          host.pack("BBBBBBHIf", 9, 16, 14, 5, 16, 0, 0, 11252026, 0.0))
                told = {}
                while not {106, 116} <= told.keys():
                    told.update((packet[0], packet) for packet in host.receive())
                # In force with the message's own frame.
                head, pictures = frames.read(int.from_bytes(frames.read(4), "little")).split(b"\n", 1)
                columns, rows = json.loads(head)["bscope"]
            # The view is from 1000 to 2000 m: cells of 6.67 m from 200 m on, the top row the farthest.
            lit = {row for row in range(rows) if any(pictures[row * columns : (row + 1) * columns])}
            self.assertGreater(len(lit), 100)
            self.assertTrue(all(1000 <= 200 + 6.67 * (rows - row - 0.5) <= 2000 for row in lit))
            self.assertEqual(self.asked("api/status")["host_time"], "2026-11-25T14:05Z")
            self.assertAlmostEqual(self.asked("api/sensor")["tilt_deg"], -5.0, places=6)
            rows = self.tshark(host, "cigi.event_notification.event_id", "cigi.event_notification.data_1",
                               "cigi.sensor_response.view_id", "cigi.sensor_response.frame_ctr", "cigi.sensor_control.gain",
                               "cigi.view_def.far", "cigi.celestial_sphere_control.date",
                               "cigi.component_control.component_id", "cigi.short_component_control.instance_id")
            told = [next((row[i] for row in rows if row[i]), None) for i in range(9)]
            self.assertEqual([int(word, 0) for word in told[0].split()], [1, 2])
            self.assertEqual((int(told[2], 0), float(told[4]), float(told[5]), int(told[6]), int(told[7], 0), int(told[8], 0)),
                             (1, 0.75, 2000.0, 11252026, 1, 7))

    def test_scenes_are_switched_by_database_number(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        shipped = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scenes", "flat-grass")
        base = shutil.copytree(shipped, os.path.join(folder.name, "base"))
        with open(os.path.join(base, "scene.toml"), "a", encoding="utf-8") as file:
            file.write('[[database]]\nnumber = 2\nscene = "obstacle-field"\n[[database]]\nnumber = 3\nscene = "nowhere"\n')
        shared = f"fanbeam-cigi-{os.getpid()}"
        host = self.start("--rate", "8", "--to", f"shm:{shared}", scene=base)
        numbers, shown = [], []

        def look():
            try:
                with open(f"/dev/shm/{shared}", "rb") as file:
                    shown.append(struct.unpack_from("<Q", file.read(112), 104)[0])
            except (FileNotFoundError, struct.error):
                pass  # between two scenes

        def ask(database, until):
            def see(packets):
                look()
                numbers.append(struct.unpack_from("<I", packets[0], 8)[0])

            return self.texts_once(host, database, until, see)

        # Each silence shows a picture once more, with a number of its own.
        for _ in range(3):
            ask(1, lambda database, _: database == 1)
            end = time.monotonic() + 1.4
            while time.monotonic() < end:
                host.receive()
        look()
        self.assertGreater(shown[-1], self.asked("api/status")["frames"])
        ask(2, lambda database, _: database == -2)
        ask(2, lambda database, _: database == 2)
        self.assertEqual(self.asked("api/status")["scene"], "obstacle-field")
        [text] = ask(3, lambda _, texts: texts)
        self.assertIn("nowhere", text)
        ask(3, lambda database, _: database == -128)
        ask(1, lambda database, _: database == 1)
        self.assertEqual(self.asked("api/status")["scene"], "flat-grass")
        self.assertEqual(numbers, sorted(set(numbers)), "frame numbers go on")
        shown = [number for number in shown if number > 0]
        self.assertEqual(shown, sorted(shown), "in shared memory too")
        seen = [int(row[0]) for row in self.tshark(host, "cigi.sof.db_number") if row[0]]
        self.assertLessEqual({1, 2, -2, -128}, set(seen))

    def texts_once(self, host, database, until, see=lambda packets: None):
        """Asks for the database until its told number and the texts are what is waited for."""
        told, end = [], time.monotonic() + 60
        while time.monotonic() < end:
            host.send(host.entity(52.0, 10.03, 200.0), database=database)
            try:
                packets = host.receive()
            except TimeoutError:
                continue
            see(packets)
            told.append(struct.unpack_from("<b", packets[0], 3)[0])
            texts = [packet[4:].rstrip(b"\0").decode() for packet in packets if packet[0] == 117]
            if until(told[-1], texts):
                return texts
        self.fail(f"database {database} in vain: {told}")

    def test_a_scene_of_another_size_is_refused_where_raw_video_is_written(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        shipped = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scenes", "flat-grass")
        base, other = (shutil.copytree(shipped, os.path.join(folder.name, name)) for name in ("base", "other"))
        with open(os.path.join(base, "scene.toml"), "a", encoding="utf-8") as file:
            file.write('[[database]]\nnumber = 2\nscene = "other"\n[[database]]\nnumber = 3\nscene = "obstacle-field"\n')
        with open(os.path.join(shipped, "..", "..", "sensors", "hivision.toml"), encoding="utf-8") as file:
            sensor = file.read().replace("\ncolumns = 164", "\ncolumns = 82")
        with open(os.path.join(other, "coarse.toml"), "w", encoding="utf-8") as file:
            file.write(sensor)
        with open(os.path.join(other, "scene.toml"), "a", encoding="utf-8") as file:
            file.write('[sensor]\nfile = "coarse.toml"\n')
        film = os.path.join(folder.name, "film.raw")
        host = self.start("--rate", "8", "--to", f"raw-bscope:{film}", scene=base)

        def ask(database, until):
            return self.texts_once(host, database, until)

        [text] = ask(2, lambda _, texts: texts)
        self.assertIn("164x524", text)
        ask(2, lambda database, _: database == -128)
        ask(3, lambda database, _: database == 3)
        self.assertEqual(os.path.getsize(film) % (164 * 524), 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
