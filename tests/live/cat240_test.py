#!/usr/bin/python3
"""Radar video of fanbeam live as TShark and a display take it (./dev live-test).

usage: cat240_test.py FANBEAM
"""
import os
import re
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import zlib

FANBEAM = os.path.abspath(sys.argv[1])
FRAMES, PERIOD_S = 3, 1 / 16
# Of flat-grass's sensor, sensors/hivision.toml.
COLUMNS, ROWS, FIELD_OF_VIEW_DEG, GATE_M, CELL_M = 164, 524, 41.0, 200.0, 6.67
C_MPS = 299792458.0
SO_RCVBUFFORCE = 33  # asm-generic/socket.h
FIELDS = ("010_SAC", "010_SIC", "000_VALUE", "020_VALUE", "041_STARTAZ", "041_ENDAZ", "041_STARTRG", "041_CELLDUR", "048_C",
          "048_RES", "049_NBVB", "049_NBCELLS", "140_VALUE")


class Display:
    """Whatever takes the datagrams: keeps them, and as a capture."""

    def __init__(self, group=None):
        self.wire = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        try:
            self.wire.setsockopt(socket.SOL_SOCKET, SO_RCVBUFFORCE, 1 << 24)
        except PermissionError:  # then as much as net.core.rmem_max allows
            self.wire.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 24)
        self.wire.bind((group or "127.0.0.1", 0))
        if group:
            join = socket.inet_aton(group) + socket.inet_aton("127.0.0.1")
            self.wire.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, join)
        self.wire.settimeout(0.2)
        self.port = self.wire.getsockname()[1]
        self.messages, self.times_s, self.leaving = [], [], False
        self.thread = threading.Thread(target=self.take, daemon=True)
        self.thread.start()

    def take(self):
        while True:
            try:
                self.messages.append(self.wire.recv(65536))
                self.times_s.append(time.monotonic())
            except TimeoutError:
                if self.leaving:
                    return

    def close(self):
        self.leaving = True
        self.thread.join()
        self.wire.close()

    def capture(self, file):
        local = bytes([127, 0, 0, 1])
        file.write(struct.pack("<IHHiIII", 0xA1B2C3D4, 2, 4, 0, 0, 65535, 101))
        for i, data in enumerate(self.messages):
            udp = struct.pack(">HHHH", 40000, 8600, 8 + len(data), 0) + data
            ip = struct.pack(">BBHHHBBH4s4s", 0x45, 0, 20 + len(udp), 0, 0, 64, 17, 0, local, local) + udp
            file.write(struct.pack("<IIII", 1, i, len(ip), len(ip)) + ip)
        file.flush()


def cells_in(message):
    """First cell, and the octets of a video message's cells."""
    first, = struct.unpack_from(">I", message, 16)
    octets, = struct.unpack_from(">H", message, 26)
    return first, message[32 : 32 + octets]


def wrapped_deg(angle):
    return (angle + 180) % 360 - 180


class RadarVideo(unittest.TestCase):
    def fly(self, words="", group=None):
        """All of a session's datagrams, and the pictures that it wrote beside them."""
        display = Display(group)
        with tempfile.NamedTemporaryFile() as raw:
            sink = f"cat240:{group or '127.0.0.1'}:{display.port}{words}"
            try:
                subprocess.run([FANBEAM, "live", "flat-grass", "--quiet", "--http", "0", "--lockstep", "--frames",
                                str(FRAMES), "--rays-per-cell", "1", "--to", sink, "--to", f"raw-bscope:{raw.name}"],
                               check=True, timeout=120)
            finally:
                display.close()
            pictures = raw.read()
        self.assertEqual(len(pictures), FRAMES * COLUMNS * ROWS)
        return display, pictures

    def tshark(self, display):
        """Rows of FIELDS, once TShark found nothing wrong."""
        with tempfile.NamedTemporaryFile(suffix=".pcap") as capture:
            display.capture(capture)
            read = ["tshark", "-r", capture.name]
            fields = [word for field in FIELDS for word in ("-e", f"asterix.240_{field}")]
            rows = subprocess.run(read + ["-T", "fields", "-E", "separator=;"] + fields, capture_output=True, text=True,
                                  check=True).stdout.splitlines()
            faults = subprocess.run(read + ["-Y", "_ws.malformed or _ws.expert or not asterix"], capture_output=True, text=True,
                                    check=True).stdout
        self.assertEqual(faults, "")
        self.assertEqual(len(rows), len(display.messages))
        return [dict(zip(FIELDS, row.split(";"))) for row in rows]

    def video(self, display):
        return [row for row in self.tshark(display) if row["000_VALUE"] == "2"]

    def radials(self, display, cell_octets, unpack=bytes):
        """The cells of each radial, from near to far, its pieces put together."""
        radials, last = [], None
        for message in (message for message in display.messages if message[7] == 2):
            first, octets = cells_in(message)
            if message[12:16] != last:
                radials.append((first, b""))
                last = message[12:16]
            begin, cells = radials[-1]
            self.assertEqual(first, begin + len(cells) // cell_octets)
            radials[-1] = (begin, cells + unpack(octets))
        self.assertEqual(len(radials), FRAMES * COLUMNS)
        self.assertTrue(all(begin == round(GATE_M / CELL_M) for begin, _ in radials))
        return [cells for _, cells in radials]

    def columns(self, pictures):
        """Of pictures with their top row first."""
        size = COLUMNS * ROWS
        return [pictures[frame * size + column : (frame + 1) * size : COLUMNS][::-1] for frame in range(FRAMES)
                for column in range(COLUMNS)]

    def summary(self, display):
        message = next(message for message in display.messages if message[7] == 1)
        return message[9 : 9 + message[8]].decode()

    def test_tshark_reads_a_session_and_its_cells_are_the_picture(self):
        display, pictures = self.fly(",source=12/34")
        self.assertEqual(self.tshark(display)[0]["000_VALUE"], "1", "a summary first")
        video = self.video(display)
        self.assertEqual(len(video), FRAMES * COLUMNS)
        for i, row in enumerate(video):
            self.assertEqual((row["010_SAC"], row["010_SIC"], int(row["020_VALUE"])), ("0x0c", "0x22", i))
            start, end = float(row["041_STARTAZ"]), float(row["041_ENDAZ"])
            for edge, azimuth in ((i % COLUMNS, start), (i % COLUMNS + 1, end)):
                expected = FIELD_OF_VIEW_DEG * (edge / COLUMNS - 0.5)
                self.assertAlmostEqual(wrapped_deg(azimuth), expected, delta=0.51 * 360 / 65536)
            cell_m = 1e-15 * int(row["041_CELLDUR"]) * C_MPS / 2
            self.assertAlmostEqual(cell_m, CELL_M, delta=2e-7)
            self.assertEqual((row["048_C"], row["048_RES"], row["049_NBVB"], row["049_NBCELLS"]),
                             ("0", "4", str(ROWS), str(ROWS)))
        today_s = time.time() % 86400
        self.assertLess((today_s - float(video[-1]["140_VALUE"])) % 86400, 60)
        self.assertEqual(self.radials(display, 1), self.columns(pictures))

    def test_columns_are_spread_over_the_period(self):
        display, _ = self.fly()
        at_s = [at for at, message in zip(display.times_s, display.messages) if message[7] == 2]
        sweeps_s = [at_s[i + COLUMNS - 1] - at_s[i] for i in range(0, FRAMES * COLUMNS, COLUMNS)]
        # No burst; slower on a busy machine, where this process may also read one late.
        self.assertGreater(max(sweeps_s), 0.5 * PERIOD_S)

    def test_true_bearings_are_those_from_the_nose_and_the_heading_that_the_summary_tells(self):
        nose, bearing = self.fly()[0], self.fly(",azimuth=true")[0]
        self.assertIn("azimuth from nose", self.summary(nose))
        text = self.summary(bearing)
        self.assertIn("azimuth true", text)
        heading_deg = float(re.search(r"heading ([\d.]+) deg", text).group(1))
        start = [float(self.video(display)[0]["041_STARTAZ"]) for display in (nose, bearing)]
        self.assertAlmostEqual(wrapped_deg(start[1] - start[0] - heading_deg), 0.0, delta=0.01 + 360 / 65536)

    def test_sixteen_bits_and_zlib_as_marked(self):
        display, _ = self.fly(",bits=16")
        self.assertTrue(all((row["048_RES"], int(row["049_NBVB"])) == ("5", 2 * int(row["049_NBCELLS"]))
                            for row in self.video(display)))
        self.assertTrue(all(len(cells) == 2 * ROWS for cells in self.radials(display, 2)))
        display, pictures = self.fly(",compress=zlib")
        self.assertTrue(all(row["048_C"] == "1" for row in self.video(display)))
        self.assertEqual(self.radials(display, 1, zlib.decompress), self.columns(pictures))

    def test_a_group_of_multicast_gets_the_same(self):
        display, pictures = self.fly(",interface=127.0.0.1", "239.255.35.240")
        self.assertEqual(self.radials(display, 1), self.columns(pictures))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:], verbosity=2)
