#!/usr/bin/python3
"""The live channel for long: 20 minutes over Innsbruck at 16 Hz, 8 hours in fast replay (./dev soak).

usage: soak.py FANBEAM DATA FOLDER [MINUTES [HOURS]]   0 leaves a part out

First part: every planned effect, packets 50 to 83 ms apart, two viewers, a reader of shared memory.
Second part: that many hours of a recording, one in 24 of its packets garbage, not finite, of another time,
a jump ahead or back, and one in 120 missing, replayed as fast as frames are made: hours of decoding, of the
predictor, of rendering and of answers. A recording is of packets that counted, so a replay has neither the
gate of the simulator's clock nor the counts by reason: those are in the first part without faults, and with
faults (hard cases F11 to F14) in minute_test.py. The frames' bytes are not compared: a frame's noise goes by
its number. tests/apps/long_run_test.cpp compares those of a loop.
Says whether what docs/live.md promises held, and ends with 1 where it did not. FOLDER gets soak.json.
"""
import json
import math
import mmap
import os
import random
import re
import socket
import struct
import sys
import threading
import time
import urllib.request

from flying import Viewer, end, own_approach, resident_MB, share, start

FANBEAM, DATA, FOLDER = sys.argv[1:4]
MINUTES = float(sys.argv[4]) if len(sys.argv) > 4 else 20.0
HOURS = float(sys.argv[5]) if len(sys.argv) > 5 else 8.0
RATE_Hz = 16


def stolen_and_all():
    with open("/proc/stat", encoding="ascii") as stat:
        times = [int(word) for word in stat.readline().split()[1:9]]
    return times[7], sum(times)


class MemoryReader(threading.Thread):
    """Looks at shared memory as docs/live.md tells, and counts frames that are whole."""

    def __init__(self, name):
        super().__init__(daemon=True)
        self.name_, self.whole, self.torn = name, 0, 0
        self.start()

    def run(self):
        with open(f"/dev/shm/{self.name_}", "rb") as file:
            memory = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
        slots, slot_bytes = struct.unpack_from("<2I", memory, 16)
        last = 0
        while True:
            number, = struct.unpack_from("<Q", memory, 104)
            if number != last:
                last = number
                at = 256 + number % slots * slot_bytes
                before, = struct.unpack_from("<Q", memory, at)
                bytes(memory[at + 192 : at + slot_bytes])
                whole = before == struct.unpack_from("<Q", memory, at)[0] == 2 * number
                self.whole, self.torn = self.whole + whole, self.torn + (not whole)
            time.sleep(1 / 64)


class Sender(threading.Thread):
    """Packets as FlightGear sends them: whole display frames of 60 Hz apart, 16 a second."""

    def __init__(self, port, approach):
        super().__init__(daemon=True)
        self.port, self.approach, self.stop = port, approach, threading.Event()
        self.start()

    def run(self):
        wire = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        begin, number = time.monotonic(), 0
        while not self.stop.is_set():
            clock_s = math.ceil(number * 60 / 16) / 60
            time.sleep(max(0.0, begin + clock_s - time.monotonic()))
            wire.sendto(self.approach.line(clock_s), ("127.0.0.1", self.port))
            number += 1


def benchmark(minutes):
    scene = "innsbruck-26"
    approach = own_approach(FANBEAM, scene, "--data", DATA)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as one:
        one.bind(("127.0.0.1", 0))
        port = one.getsockname()[1]
    live, url = start(FANBEAM, scene, "--data", DATA, "--from", f"fg-generic:{port},datum=ellipsoid", "--to", f"shm:soak{os.getpid()}")
    sender = Sender(port, approach)
    viewers = [Viewer(url), Viewer(url)]
    memory_reader = MemoryReader(f"soak{os.getpid()}")
    begin, stolen = time.monotonic(), stolen_and_all()
    memory = []
    while time.monotonic() < begin + 60 * minutes:
        time.sleep(5)
        memory.append(resident_MB(live.pid))
        print(f"\r{(time.monotonic() - begin) / 60:.1f} of {minutes:g} min, {memory[-1]:.0f} MB", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    with urllib.request.urlopen(f"{url}api/status") as answer:
        status = json.load(answer)
    stolen = [after - before for before, after in zip(stolen, stolen_and_all())]
    sender.stop.set()
    good_end = end(live)
    heads = viewers[0].heads
    known = [head["errors"] for head in heads if head["errors"]]
    settled = memory[min(len(memory) - 1, 12):]  # after the first minute
    period_ms = 1e3 / RATE_Hz
    found = {
        "minutes": minutes, "frames": status["frames"], "stolen_percent": 100 * stolen[0] / max(1, stolen[1]),
        "late_by_clock": status["late"] / max(1, status["frames"]),
        "late_by_processor": status["late_by_processor"] / max(1, status["frames"]),
        "frame_ms_median": share([head["frame_ms"] for head in heads], 0.5),
        "frame_ms_99": share([head["frame_ms"] for head in heads], 0.99),
        "pose_to_picture_ms_median": share([head["frame_ms"] + head["pose_age_ms"] for head in heads], 0.5),
        "pose_to_picture_ms_99": share([head["frame_ms"] + head["pose_age_ms"] for head in heads], 0.99),
        "samples_median": share([head["samples"] for head in heads], 0.5),
        "bscope_grey_median": share([one["bscope_grey"] for one in known], 0.5),
        "cscope_grey_median": share([one["cscope_grey"] for one in known], 0.5),
        "viewers_got": [len(viewer.heads) / max(1, status["frames"]) for viewer in viewers],
        "shared_memory_got": memory_reader.whole / max(1, status["frames"]), "shared_memory_torn": memory_reader.torn,
        "memory_MB_after_a_minute": settled[0], "memory_MB_at_the_end": memory[-1], "exit_code": good_end,
    }
    promised = {
        "late by processor time at most 1 in 1000": found["late_by_processor"] <= 1e-3,
        "late by the clock at most 1 in 100": found["late_by_clock"] <= 1e-2,
        "frame to sink, 99th percentile, at most 80 % of the period + 10 ms": found["frame_ms_99"] <= 0.8 * period_ms + 10,
        "pose to picture, 99th percentile, at most 143 ms": found["pose_to_picture_ms_99"] <= 143,
        "median error at most 2.0 and 3.2 grey": found["bscope_grey_median"] <= 2.0 and found["cscope_grey_median"] <= 3.2,
        "memory flat (5 %) after the first minute": memory[-1] <= 1.05 * settled[0],
        "a clean end": good_end == 0,
    }
    return found, promised


def write_hours(file, hours, approach, draw):
    """A recording of that many hours, as live/journal.h has it, with packets that no channel would keep."""
    def packet(at_s, data):
        file.write(json.dumps({"packet": data.hex(), "s": at_s}) + "\n")
    file.write(json.dumps({"fanbeam_live": 1, "scene": "flat-grass", "from": "fg-generic:0", "rate_Hz": RATE_Hz,
                           "lockstep": False}) + "\n")
    for number in range(1, int(3600 * hours * RATE_Hz) + 1):
        now_s = number / RATE_Hz
        line = approach.line(now_s)
        fault = draw.randrange(120)
        if fault == 0:
            packet(now_s - 0.004, draw.randbytes(draw.randrange(1500)))
        elif fault == 1:
            packet(now_s - 0.004, re.sub(rb"^(fanbeam,2,)[^,]+", rb"\g<1>4e9", line))
        elif fault == 2:
            packet(now_s - 0.004, re.sub(rb"^((?:[^,]+,){3})[^,]+", rb"\g<1>nan", line))
        elif fault == 3:
            packet(now_s - 0.004, approach.line(now_s + 30.0))
        elif fault == 4:
            packet(now_s - 0.004, approach.line(max(0.0, now_s - 5.0)))
        elif fault == 5:
            continue  # one is lost
        packet(now_s - 0.002, line)
        file.write(json.dumps({"frame": number, "now_s": now_s, "at_s": now_s + 0.5 / RATE_Hz, "samples": 0.3}) + "\n")


def hours_of_replay(hours):
    name = os.path.join(FOLDER, "hours.recording")
    with open(name, "w", encoding="ascii") as file:
        write_hours(file, hours, own_approach(FANBEAM, "flat-grass"), random.Random(1))
    live, url = start(FANBEAM, "flat-grass", "--replay", name, "--lockstep")
    begin, memory, frames = time.monotonic(), [], []
    while live.poll() is None:
        time.sleep(2)
        try:
            with urllib.request.urlopen(f"{url}api/status", timeout=5) as answer:
                frames.append(json.load(answer)["frames"])
            memory.append(resident_MB(live.pid))
        except (OSError, AttributeError):
            continue  # busy for long, or at its end
        print(f"\r{frames[-1] / 3600 / RATE_Hz:.2f} of {hours:g} h, {memory[-1]:.0f} MB", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    code, taken_s = live.wait(30), time.monotonic() - begin
    os.remove(name)
    assert memory, "the replay ended at once"
    settled = next((i for i, count in enumerate(frames) if count > 60 * RATE_Hz), 0)  # a minute of flight
    found = {"hours": hours, "frames": frames[-1], "minutes_taken": taken_s / 60, "exit_code": code,
             "memory_MB_after_a_minute_of_flight": memory[settled], "memory_MB_most_after": max(memory[settled:])}
    promised = {"all of the flight, to a clean end": code == 0 and frames[-1] > 0.9 * 3600 * hours * RATE_Hz,
                "memory flat (1 %) after its first minute": max(memory[settled:]) <= 1.01 * memory[settled]}
    return found, promised


def main():
    os.makedirs(FOLDER, exist_ok=True)
    told, kept = {}, True
    for name, part, length in (("benchmark", benchmark, MINUTES), ("replay", hours_of_replay, HOURS)):
        if length <= 0:
            continue
        found, promised = part(length)
        told[name] = {"found": found, "promised": promised}
        for key, value in found.items():
            print(f"{key:38} {value if not isinstance(value, float) else round(value, 4)}")
        for words, held in promised.items():
            print(f"{'held  ' if held else 'MISSED'}  {words}")
            kept = kept and held
        with open(os.path.join(FOLDER, "soak.json"), "w", encoding="ascii") as file:
            json.dump(told, file, indent=1)
    sys.exit(0 if kept else 1)


if __name__ == "__main__":
    main()
