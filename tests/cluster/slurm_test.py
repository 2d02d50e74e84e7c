#!/usr/bin/python3
"""A campaign on a Slurm cluster of three nodes on this machine, one of them killed in the middle (./dev cluster-test).

usage: slurm_test.py FANBEAM FOLDER     FOLDER is emptied, and keeps the logs
"""
import os
import re
import secrets
import shutil
import signal
import socket
import subprocess
import sys
import time
import unittest
from pathlib import Path

FANBEAM, FOLDER = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()

CAMPAIGN = """[campaign]
name = "cluster"
scenes = ["obstacle-field"]
plan = "sobol"
runs = 72
frames = { count = 4, from = 0.3, to = 0.9 }
products = ["bscope", "labels"]
isa = "v2"
samples_per_cell = 2
[parameters]
weather.visibility_m = { log_uniform = [100, 2000] }
flight.lateral_m = { normal = [0, 10], within = [-30, 30] }
"""


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class Cluster:
    """munged, slurmctld and three slurmd of the test's own: folders, sockets and ports are nobody else's."""

    def __init__(self, folder):
        self.folder = folder
        folder.mkdir(parents=True)
        os.chmod(folder, 0o755)
        key = folder / "munge.key"
        key.write_bytes(secrets.token_bytes(128))
        key.chmod(0o600)
        self.start_munge(key)
        ports = free_ports(4)
        user, host = ("root" if os.geteuid() == 0 else os.environ["USER"]), socket.gethostname()
        self.conf = folder / "slurm.conf"
        nodes = "\n".join(
            f"NodeName=n{k + 1} NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[k]} CPUs=1 RealMemory=1000 State=UNKNOWN"
            for k in range(3)
        )
        self.conf.write_text(
            f"""ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[3]}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
SlurmUser={user}
SlurmdUser={user}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool-%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd-%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd-%n.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
MpiDefault=none
ReturnToService=2
SlurmdTimeout=10
KillWait=2
SelectType=select/cons_tres
SlurmdParameters=config_overrides
SchedulerParameters=sched_interval=2,batch_sched_delay=1
{nodes}
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
""",
            encoding="ascii",
        )
        (folder / "state").mkdir()
        self.environment = {**os.environ, "SLURM_CONF": str(self.conf)}
        self.run("slurmctld", "-f", self.conf)
        for node in ("n1", "n2", "n3"):
            self.run("slurmd", "-f", self.conf, "-N", node)
        self.wait(lambda: self.run("sinfo", "-h", "-o", "%T %D").strip() == "idle 3", 60, "three idle nodes")

    def start_munge(self, key):
        options = [f"--socket={self.folder}/munge.socket", f"--key-file={key}", f"--pid-file={self.folder}/munged.pid"]
        options += [f"--log-file={self.folder}/munged.log", f"--seed-file={self.folder}/munged.seed", "--num-threads=2"]
        subprocess.run(["munged", "--force", *options], check=True)

    def run(self, *command):
        environment = getattr(self, "environment", os.environ)
        ended = subprocess.run([*map(str, command)], env=environment, capture_output=True, text=True, timeout=60)
        if ended.returncode != 0:
            raise RuntimeError(f"{command}: {ended.stdout}{ended.stderr}")
        return ended.stdout

    def wait(self, met, seconds, what):
        end = time.monotonic() + seconds
        while not met():
            if time.monotonic() > end:
                raise RuntimeError(f"no {what} within {seconds} s\n{self.run('sinfo', '-N', '-l')}{self.run('squeue', '-a')}")
            time.sleep(0.3)

    def pid(self, name):
        return int((self.folder / f"{name}.pid").read_text(encoding="ascii"))

    def work_on(self, node):
        """What runs there, and the steps' watchers."""
        jobs, stepds = set(), set()
        for process in Path("/proc").iterdir():
            try:
                if process.name.isdigit() and f"SLURMD_NODENAME={node}\0".encode() in (process / "environ").read_bytes():
                    jobs.add(int(process.name))
                    watcher = int(re.search(r"PPid:\s+(\d+)", (process / "status").read_text()).group(1))
                    if "slurmstepd" in Path(f"/proc/{watcher}/comm").read_text():
                        stepds.add(watcher)
            except OSError:
                pass  # it ended
        return jobs, stepds

    def kill_node(self, node):
        """As a power cut: the daemon, then the steps' watchers, which would tell of it, then what they watch."""
        os.kill(self.pid(f"slurmd-{node}"), signal.SIGKILL)
        jobs, stepds = self.work_on(node)
        for pid in [*stepds, *(jobs - stepds)]:
            os.kill(pid, signal.SIGKILL)
        return len(stepds)

    def stop(self):
        try:
            self.run("scancel", "--full", "-u", str(os.geteuid()))
        except RuntimeError:
            pass
        for name in ("slurmd-n1", "slurmd-n2", "slurmd-n3", "slurmctld", "munged"):
            try:
                os.kill(self.pid(name), signal.SIGTERM)
            except (OSError, ValueError):
                pass


def bytes_of(folder):
    return {
        str(file.relative_to(folder)): file.read_bytes()
        for file in sorted(folder.rglob("*"))
        if file.is_file() and not file.name.startswith(".") and "slurm" not in file.relative_to(folder).parts
    }


class Campaign(unittest.TestCase):
    def test_an_array_of_jobs_survives_a_node_and_gives_the_bytes_of_one_machine(self):
        shutil.rmtree(FOLDER, ignore_errors=True)
        FOLDER.mkdir(parents=True)
        file = FOLDER / "cluster.toml"
        file.write_text(CAMPAIGN, encoding="ascii")
        alone, shared = FOLDER / "alone", FOLDER / "shared"
        begin = time.monotonic()
        subprocess.run([FANBEAM, "campaign", "run", file, "-o", alone, "-q"], check=True)
        alone_s = time.monotonic() - begin
        subprocess.run([FANBEAM, "campaign", "merge", file, "-o", alone, "-q"], check=True)

        cluster = Cluster(FOLDER / "slurm")
        self.addCleanup(cluster.stop)
        script = FOLDER / "job.sh"
        options = ["--folder", shared, "--tasks", "6", "--threads", "1", "-o", script, "-q"]
        subprocess.run([FANBEAM, "campaign", "slurm", file, *options], check=True)
        begin = time.monotonic()
        array, merge, verify = cluster.run("bash", script).split()
        # Nodes one and two of three shards each have begun, and some runs are there.
        cluster.wait(lambda: len(list(shared.glob("runs/0*"))) >= 6, 90, "six runs")
        # A node that is told to be busy may have its shard yet to begin.
        cluster.wait(lambda: cluster.work_on("n2")[1], 60, "shard at work on the second node")
        before = len(list(shared.glob("runs/0*")))
        self.assertEqual(cluster.kill_node("n2"), 1)
        # Slurm notices after SlurmdTimeout, requeues, and would let two minutes pass before it begins again.
        cluster.wait(lambda: "Restarts=1" in cluster.run("scontrol", "show", "job", array), 60, "requeued shard")
        lost = cluster.run("squeue", "-h", "-r", "-t", "PD", "-j", array, "-o", "%i").split()
        self.assertGreaterEqual(len(lost), 1)  # on a slow machine shards that have not begun are among them
        for task in lost:
            cluster.run("scontrol", "update", f"JobId={task}", "StartTime=now")
        cluster.wait(lambda: cluster.run("squeue", "-h").strip() == "", 120, "empty queue")
        taken_s = time.monotonic() - begin

        told = {job: cluster.run("scontrol", "show", "job", job) for job in (array, merge, verify)}
        self.assertIn("JobState=COMPLETED", told[verify], told[verify])
        self.assertIn("Restarts=1", told[array], "no shard was requeued: the node was killed too late")
        self.assertIn("every file as recorded", (shared / "slurm" / "verify.txt").read_text(encoding="utf-8"))
        self.assertEqual(bytes_of(shared), bytes_of(alone))
        self.assertEqual(list(shared.glob("runs/.*")), [])
        print(f"\n72 runs: {alone_s:.1f} s alone; as six jobs on three nodes of one processor each, one killed after {before} runs, {taken_s:.1f} s")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
