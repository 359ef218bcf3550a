"""Batches on clusters that fail: `python python/tests/clusters.py FOLDER [--seed S] [--kills 30]`; some minutes.

600 units in chunks of 20, made by one process, are what every other way must give, byte for byte, without a stray file:
Dask with three workers while a worker, the scheduler or the client is killed; two runs at once; shards beside Dask; a
disk that is full (as root on Linux); HyperQueue where its wheel is installed; the variables of a Slurm array and of an
Indexed Job; one process killed, or refused by the disk, at every file that it opens, syncs and names (where strace is
installed). Then Dask's cost, beside three processes with shards.
"""

from __future__ import annotations

import argparse
import importlib
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import dragtraffic
import duckdb
import psutil
from distributed import Client
from dragtraffic import _program

ROOT = Path(__file__).resolve().parents[2]
#: The package that is measured, and its program.
PACKAGE = str(Path(dragtraffic.__file__).parents[1])
PROGRAM = [sys.executable, _program.__file__]
WORKERS = 3
SITUATIONS = """[[situations]]
template = "cut-in"
[[situations]]
template = "brake"
"""
PLAN = f"""
scenes = ["{ROOT}/assets/scenes"]
seeds = 60
chunk_units = 20
[generate]
horizon_s = 4
{SITUATIONS}"""
#: A plan of few files, each of which is a moment to fail at.
SMALL = f"""
scenes = ["{ROOT}/assets/scenes/demo-motorway.json"]
seeds = 4
chunk_units = 4
[generate]
horizon_s = 3
{SITUATIONS}"""
CLIENT = """
import sys, dragtraffic
from distributed import Client
with Client(sys.argv[1], timeout=20) as client:
    dragtraffic.batch(sys.argv[2], sys.argv[3], client=client)
"""
#: A client gives a scheduler up after this time, seconds; all of a cluster is there after that.
GIVES_UP_S, STARTS_S = 60, 60

#: A process, and all that were started.
Process = subprocess.Popen[bytes]
STARTED: list[Process] = []


def start(folder: Path, *command: str, **variables: str) -> Process:
    """Starts a process; what it complains about goes to `log.txt` of a folder."""
    own = {**os.environ, "PYTHONPATH": PACKAGE, "DASK_DISTRIBUTED__COMM__TIMEOUTS__CONNECT": "10s"}
    none = subprocess.DEVNULL
    with (folder / "log.txt").open("ab") as log:
        process = subprocess.Popen(command, env={**own, **variables}, stdin=subprocess.PIPE, stdout=none, stderr=log)
    STARTED.append(process)
    return process


class Cluster:
    """A scheduler and workers, each a process."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.number = folder, 0
        self.begin()

    def begin(self) -> None:
        self.number += 1
        self.file = self.folder / f"scheduler-{self.number}.json"
        self.file.unlink(missing_ok=True)
        common = ["--scheduler-file", str(self.file), "--no-dashboard"]
        scheduler = ["-m", "dask", "scheduler", "--host", "127.0.0.1", "--port", "0", *common]
        self.scheduler = start(self.folder, sys.executable, *scheduler)
        until = time.monotonic() + STARTS_S
        while not self.file.exists() or not self.file.read_text().endswith("}"):
            assert time.monotonic() < until, "no scheduler"
            time.sleep(0.05)
        self.address = json.loads(self.file.read_text())["address"]
        self.workers = [self.worker() for _ in range(WORKERS)]

    def worker(self) -> Process:
        own = ["--nthreads", "1", "--no-nanny", "--no-dashboard", "--local-directory", str(self.folder / "scratch")]
        return start(self.folder, sys.executable, "-m", "dask", "worker", self.address, *own)

    def processes(self) -> list[psutil.Process]:
        return [psutil.Process(process.pid) for process in [*self.workers, self.scheduler]]

    def end(self) -> None:
        for process in [*self.workers, self.scheduler]:
            kill(process)

    def client(self, plan: Path, out: Path) -> Process:
        return start(self.folder, sys.executable, "-c", CLIENT, self.address, str(plan), str(out))


def kill(process: Process) -> None:
    if process.poll() is None:
        process.send_signal(signal.SIGKILL)
    process.wait()


def tables(out: Path) -> int:
    return len(list(out.glob("chunks/*.parquet")))


def tree(folder: Path) -> dict[str, bytes]:
    return {str(file.relative_to(folder)): file.read_bytes() for file in folder.rglob("*") if file.is_file()}


class Proof:
    """Every way beside the one of a single process."""

    def __init__(self, folder: Path, seed: int) -> None:
        self.folder, self.random = folder, random.Random(seed)
        folder.mkdir(parents=True)
        self.plan = folder / "plan.toml"
        self.plan.write_text(PLAN)
        began = time.monotonic()
        assert start(folder, *PROGRAM, "batch", str(self.plan), "-o", str(folder / "alone"), "--jobs", "1").wait() == 0
        self.alone = tree(folder / "alone")
        spent = time.monotonic() - began
        query = f"SELECT count(*), count(DISTINCT unit) FROM '{folder}/alone/chunks/*.parquet'"
        (rows,) = duckdb.execute(query).fetchall()
        assert rows == (600, 600), rows
        self.say("one process", f"{rows[0]} units in {tables(folder / 'alone')} chunks, {spent:.1f} s")

    def say(self, what: str, found: str) -> None:
        print(f"{what}: {found}", flush=True)

    def equal(self, what: str, out: Path, found: str) -> None:
        mine = tree(out)
        assert mine.keys() == self.alone.keys(), (what, mine.keys() ^ self.alone.keys())
        assert mine == self.alone, (what, [name for name in mine if mine[name] != self.alone[name]])
        self.say(what, f"{found}; equal bytes, no other file")

    def shards(self, out: Path, count: int) -> list[Process]:
        shard = [*PROGRAM, "batch", str(self.plan), "-o", str(out), "--jobs", "1", "--shard"]
        return [start(self.folder, *shard, f"{index}/{count}") for index in range(count)]

    def kills(self, count: int) -> None:
        """Kills a worker, the scheduler or the client at drawn moments and goes on, in as many folders as it takes."""
        cluster, killed = Cluster(self.folder), dict.fromkeys(["worker", "scheduler", "client"], 0)
        rounds, waited = 0, 0.0
        while sum(killed.values()) < count:
            rounds += 1
            out = self.folder / f"killed-{rounds}"
            client = cluster.client(self.plan, out)
            while sum(killed.values()) < count:
                victim = self.random.choice(list(killed))
                goal, later = tables(out) + self.random.randrange(1, 3), self.random.uniform(0, 1)
                while client.poll() is None and tables(out) < goal:
                    time.sleep(0.02)
                time.sleep(later)
                if client.poll() is not None:
                    break
                killed[victim] += 1
                if victim == "worker":
                    at = self.random.randrange(WORKERS)
                    kill(cluster.workers[at])
                    cluster.workers[at] = cluster.worker()
                    continue
                if victim == "client":
                    kill(client)
                else:
                    waited = max(waited, self.without_scheduler(cluster, client))
                client = cluster.client(self.plan, out)
            assert client.wait() == 0
            self.equal(f"kills, folder {rounds}", out, str(killed))
        cluster.end()
        self.say("kills", f"a client ended at most {waited:.1f} s after its scheduler")

    def without_scheduler(self, cluster: Cluster, client: Process) -> float:
        """Kills the scheduler and begins anew; how long the client took to end with an error, seconds."""
        began = time.monotonic()
        kill(cluster.scheduler)
        assert client.wait(GIVES_UP_S) != 0
        waited = time.monotonic() - began
        cluster.end()
        cluster.begin()
        return waited

    def beside(self) -> None:
        cluster = Cluster(self.folder)
        out = self.folder / "twice"
        both = [cluster.client(self.plan, out), cluster.client(self.plan, out)]
        assert [client.wait() for client in both] == [0, 0]
        self.equal("two runs into one folder", out, "on one cluster")
        out = self.folder / "mixed"
        all = [cluster.client(self.plan, out), *self.shards(out, 3)]
        assert [process.wait() for process in all] == [0] * 4
        self.equal("shards 0/3 to 2/3 beside Dask", out, "four processes")
        cluster.end()

    def full_disk(self) -> None:
        if os.geteuid() != 0:
            return self.say("full disk", "skipped, it needs root")
        out = self.folder / "small"
        out.mkdir()
        size = sum(map(len, self.alone.values()))
        subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size // 2}", "tmpfs", out], check=True)
        cluster = Cluster(self.folder)
        try:
            assert cluster.client(self.plan, out).wait() != 0
            there = tables(out)
            assert all(self.alone[name] == content for name, content in tree(out).items())
            subprocess.run(["mount", "-o", f"remount,size={4 * size}", out], check=True)
            assert cluster.client(self.plan, out).wait() == 0
            self.equal("full disk", out, f"refused with {there} chunks, with more room it goes on")
        finally:
            cluster.end()
            subprocess.run(["umount", out], check=True)

    def hyperqueue(self) -> None:
        try:
            hq: Any = importlib.import_module("hyperqueue")
        except ImportError:
            return self.say("HyperQueue", "skipped, its wheel is not installed")
        out, job = self.folder / "hq", hq.Job(default_workdir=self.folder)
        # Its tasks have no standard input, with which a program of PROGRAM would end.
        shard = [sys.executable, "-m", "dragtraffic", "batch", str(self.plan), "-o", str(out), "--jobs", "1", "--shard"]
        for index in range(2 * WORKERS):
            own = {"PYTHONPATH": PACKAGE}
            job.program([*shard, f"{index}/{2 * WORKERS}"], env=own, stdout=None, stderr=None)
        with hq.LocalCluster() as cluster:
            for _ in range(WORKERS):
                cluster.start_worker(hq.cluster.WorkerConfig(cores=1))
            client = cluster.client()
            assert client.wait_for_jobs([client.submit(job)])
        self.equal("HyperQueue", out, f"{2 * WORKERS} shards on {WORKERS} workers")

    def environment(self) -> None:
        """The share of a process by the variables of a cluster."""
        for name, index, count in (
            ("Slurm array", "SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_COUNT"),
            ("Indexed Job", "JOB_COMPLETION_INDEX", "JOB_COMPLETION_COUNT"),
        ):
            out = self.folder / name.split()[0].lower()
            command = [*PROGRAM, "batch", str(self.plan), "-o", str(out)]
            all = [start(self.folder, *command, **{index: str(at), count: "3"}) for at in range(3)]
            assert [process.wait() for process in all] == [0] * 3
            self.equal(name, out, "three processes with its variables")

    def fail_points(self) -> None:
        """Ends a run at each call that opens the folder of chunks (before a write), syncs a file (after the write) or its
        folder (after the link), or links a name, and resumes it: killed, or with an error of the disk."""
        if shutil.which("strace") is None:
            return self.say("fail points", "skipped, strace is not installed")
        plan, whole = self.folder / "small.toml", self.folder / "small-alone"
        plan.write_text(SMALL)
        command = [*PROGRAM, "batch", str(plan), "--jobs", "1", "-o"]
        assert start(self.folder, *command, str(whole)).wait() == 0
        expected = tree(whole)
        counts: dict[str, int] = {}
        for call, fault in (
            ("openat", "signal=KILL"),
            ("fsync", "signal=KILL"),
            ("linkat", "signal=KILL"),
            ("fsync", "error=EIO"),
            ("linkat", "error=ENOSPC"),
        ):
            number, ended = 0, 1
            while ended != 0:
                number += 1
                out = self.folder / f"point-{call}-{fault}-{number}"
                # Of the many files that are opened, those of the chunks alone are counted.
                of = ["-P", str(out / "chunks")] if call == "openat" else []
                inject = ["-e", f"trace={call}", "-e", f"inject={call}:{fault}:when={number}"]
                traced = ["strace", "-f", "-qqq", "-o", "/dev/null", *of, *inject]
                ended = start(self.folder, *traced, *command, str(out)).wait()
                found = tree(out)
                assert found.items() <= expected.items(), (call, fault, number, found.keys() - expected.keys())
                assert start(self.folder, *command, str(out)).wait() == 0
                assert tree(out) == expected, (call, fault, number)
            # The last one was beyond the end of the run.
            counts[f"{call} {fault}"] = number - 1
        assert all(counts.values()), counts
        self.say("fail points", f"{sum(counts.values())} stopped and resumed, {counts}; equal bytes, no other file")

    def cost(self, times: int = 2) -> None:
        """Time of the processor and of the clock, of shards without Dask and of Dask, one after the other."""
        spent: dict[str, list[tuple[float, float]]] = {"shards": [], "Dask": []}
        cluster = Cluster(self.folder)
        for number in range(times):
            out = self.folder / f"shards-{number}"
            began = time.monotonic()
            all = self.shards(out, WORKERS)
            used = sum(map(last_s, all))
            spent["shards"].append((used, time.monotonic() - began))
            out = self.folder / f"dask-{number}"
            with Client(cluster.address, timeout=STARTS_S) as client:
                client.wait_for_workers(WORKERS, timeout=STARTS_S)
                mine = psutil.Process()
                before, began = sum(map(used_s, [mine, *cluster.processes()])), time.monotonic()
                dragtraffic.batch(self.plan, out, client=client)
                used = sum(map(used_s, [mine, *cluster.processes()])) - before
            spent["Dask"].append((used, time.monotonic() - began))
            told = [f"{name} {of[-1][0]:.1f} s of the processor in {of[-1][1]:.1f} s" for name, of in spent.items()]
            self.equal(f"cost {number}", out, ", ".join(told))
        cluster.end()


def used_s(process: psutil.Process) -> float:
    """Time of the processor that a process and its ended children used, seconds."""
    times = process.cpu_times()
    return float(times.user + times.system + times.children_user + times.children_system)


def last_s(process: Process) -> float:
    """Waits for a process, and gives the time that it used."""
    used = os.wait4(process.pid, 0)[2]
    return used.ru_utime + used.ru_stime


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="where to work; it must not be there")
    parser.add_argument("--seed", type=int, default=0, help="of the moments")
    parser.add_argument("--kills", type=int, default=30, help="number of the moments")
    args = parser.parse_args()
    try:
        proof = Proof(args.folder.resolve(), args.seed)
        proof.kills(args.kills)
        proof.beside()
        proof.full_disk()
        proof.hyperqueue()
        proof.environment()
        proof.fail_points()
        proof.cost()
    finally:
        for process in STARTED:
            kill(process)


if __name__ == "__main__":
    main()
