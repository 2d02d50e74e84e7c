"""What the long tests of the live channel share: a flight, its packets, a viewer, the program's memory."""
import json
import math
import re
import signal
import subprocess
import threading
import time
import urllib.request

FOOT_m, LENGTH_s, SPEED_mps, SLOPE_deg = 0.3048, 65.0, 70.0, 3.8


def resident_MB(pid):
    with open(f"/proc/{pid}/status", encoding="ascii") as status:
        return int(re.search(r"VmRSS:\s+(\d+)", status.read()).group(1)) / 1024


def share(values, part):
    values = sorted(values)
    return values[min(len(values) - 1, int(part * len(values)))] if values else math.nan


def start(fanbeam, *options):
    live = subprocess.Popen([fanbeam, "live", *options, "--http", "0"], stdout=subprocess.PIPE, text=True)
    return live, re.search(r"http://\S+", live.stdout.readline()).group(0)


def end(live):
    live.send_signal(signal.SIGTERM)
    return live.wait(30)


class Viewer(threading.Thread):
    """Reads frames as a page does, and keeps what they say of themselves and how long after their beginning they are here."""

    def __init__(self, url):
        super().__init__(daemon=True)
        self.url, self.heads = url, []
        self.start()

    def run(self):
        try:
            with urllib.request.urlopen(f"{self.url}frames") as stream:
                while size := stream.read(4):
                    message = stream.read(int.from_bytes(size, "little"))
                    arrived_s = time.monotonic()
                    head = json.loads(message.split(b"\n", 1)[0])
                    self.heads.append({"sink_ms": 1e3 * (arrived_s - head["began_s"])} | {key: head[key] for key in (
                        "number", "frame_ms", "pose_age_ms", "samples", "errors", "stale")})
        except (OSError, ValueError):
            pass  # the server ended


class Approach:
    """Straight down the scene's own approach, again and again."""

    def __init__(self, head):
        self.head = head

    def line(self, clock_s):
        t, head = clock_s % LENGTH_s, self.head
        heading, slope = math.radians(head["heading_deg"]), math.tan(math.radians(SLOPE_deg))
        along_m = SPEED_mps * t
        latitude = head["latitude_deg"] + math.degrees(along_m * math.cos(heading) / 6.37e6)
        longitude = head["longitude_deg"] + math.degrees(
            along_m * math.sin(heading) / 6.37e6 / math.cos(math.radians(latitude)))
        feet = (head["height_m"] - slope * along_m) / FOOT_m
        fps = SPEED_mps / FOOT_m
        return (f"fanbeam,2,{clock_s:.6f},{latitude:.12f},{longitude:.12f},{feet:.6f},300,{head['roll_deg']},"
                f"{head['pitch_deg']},{head['heading_deg']},{fps * math.cos(heading):.6f},{fps * math.sin(heading):.6f},"
                f"{fps * slope:.6f},9000,0,0\n").encode()


def own_approach(fanbeam, scene, *options):
    live, url = start(fanbeam, scene, *options, "--from", "ils", "--rate", "4", "--rays-per-cell", "1")
    viewer = urllib.request.urlopen(f"{url}frames")
    head = json.loads(viewer.read(int.from_bytes(viewer.read(4), "little")).split(b"\n", 1)[0])
    end(live)
    return Approach(head)
