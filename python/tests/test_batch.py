"""Batches from Python: on this machine and on a cluster of Dask, with workers that die."""

from __future__ import annotations

import os
import pickle
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import dragtraffic
import pytest
from distributed import Client, LocalCluster
from dragtraffic import DragTrafficError, _program

ROOT = Path(__file__).resolve().parents[2]
#: 24 units in 8 chunks.
PLAN = f"""
scenes = ["{ROOT}/assets/scenes/demo-motorway.json", "{ROOT}/assets/scenes/demo-crossing.json"]
seeds = 6
chunk_units = 3
[generate]
horizon_s = 2
[[situations]]
template = "cut-in"
[[situations]]
template = "brake"
"""


@pytest.fixture(scope="module")
def client() -> Iterator[Client]:
    # Spawned workers import the package by themselves.
    os.environ["PYTHONPATH"] = str(ROOT / "python")
    settings = {"n_workers": 2, "threads_per_worker": 1, "dashboard_address": None, "silence_logs": 50}
    with LocalCluster(**settings) as cluster, Client(cluster) as client:
        yield client


@pytest.fixture
def plan(tmp_path: Path) -> Path:
    file = tmp_path / "plan.toml"
    file.write_text(PLAN)
    return file


def tree(folder: Path) -> dict[str, bytes]:
    """Every file below a folder."""
    return {str(file.relative_to(folder)): file.read_bytes() for file in folder.rglob("*") if file.is_file()}


def test_a_killed_worker_and_a_shard_beside_change_no_byte(client: Client, plan: Path, tmp_path: Path) -> None:
    alone = dragtraffic.batch(plan, tmp_path / "alone")
    assert alone["units_done"] == alone["units"] == 24 and alone["chunks_done"] == alone["chunks"] == 8

    workers = list(client.run(os.getpid).values())
    victim = subprocess.Popen([sys.executable, "-c", KILLER, str(tmp_path / "spread/chunks"), str(workers[0])])
    beside = [sys.executable, _program.__file__, "batch", str(plan), "-o", str(tmp_path / "spread"), "--shard", "0/3"]
    with subprocess.Popen([*beside, "--quiet"], stdin=subprocess.PIPE) as shard:
        spread = dragtraffic.batch(plan, tmp_path / "spread", client=client)
        assert shard.wait() == 0
    assert victim.wait() == 0, "no worker was killed"
    assert spread == alone
    assert tree(tmp_path / "spread") == tree(tmp_path / "alone")
    assert dragtraffic.batch(plan, tmp_path / "spread", client=client) == alone


#: Kills a process once a folder has a table.
KILLER = """
import os, signal, sys, time
from pathlib import Path
while not list(Path(sys.argv[1]).glob("*.parquet")):
    time.sleep(0.01)
os.kill(int(sys.argv[2]), signal.SIGKILL)
"""


def test_what_a_worker_refuses_is_said_to_the_caller(client: Client, plan: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    dragtraffic.batch(plan, out)
    plan.write_text(PLAN.replace("seeds = 6", "seeds = 7"))
    with pytest.raises(DragTrafficError, match="another plan") as refused:
        dragtraffic.batch(plan, out, client=client)
    again = pickle.loads(pickle.dumps(refused.value))
    assert (str(again), again.code) == (str(refused.value), "batch-failed")
    # A chunk whose cases are there with other bytes, and whose table is not.
    plan.write_text(PLAN)
    table = min((out / "chunks").glob("*.parquet"))
    table.unlink()
    table.with_suffix(".jsonl").write_text("{}\n")
    with pytest.raises(DragTrafficError, match="other bytes") as refused:
        dragtraffic.batch(plan, out, client=client)
    assert refused.value.code == "not-reproducible"


def test_a_lost_scheduler_is_an_error_and_the_same_call_goes_on(plan: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    settings = {"n_workers": 1, "threads_per_worker": 1, "processes": False, "dashboard_address": None}
    with LocalCluster(**settings, silence_logs=50) as cluster, Client(cluster) as client:

        def lose() -> None:
            while not list(out.glob("chunks/*.parquet")):
                time.sleep(0.01)
            cluster.close()

        thief = threading.Thread(target=lose)
        thief.start()
        with pytest.raises(DragTrafficError, match="the cluster was lost"):
            dragtraffic.batch(plan, out, client=client)
        thief.join()
    assert dragtraffic.batch(plan, out)["chunks_done"] == 8


def test_a_program_ends_with_the_process_that_started_it(plan: Path, tmp_path: Path) -> None:
    command = [sys.executable, _program.__file__, "batch", str(plan), "-o", str(tmp_path / "out"), "--quiet"]
    starter = f"import subprocess, time; p = subprocess.Popen({command!r}, stdin=-1); print(p.pid, flush=True); time.sleep(60)"
    with subprocess.Popen([sys.executable, "-c", starter], stdout=subprocess.PIPE) as parent:
        assert parent.stdout is not None
        child = int(parent.stdout.readline())
        parent.send_signal(signal.SIGKILL)
    until = time.monotonic() + 10
    while is_running(child):
        assert time.monotonic() < until, "it goes on alone"
        time.sleep(0.02)


def is_running(process: int) -> bool:
    stat = Path(f"/proc/{process}/stat")
    try:
        return stat.read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False
