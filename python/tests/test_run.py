"""Runs in the process of Python."""

from __future__ import annotations

import math
import multiprocessing
import os
import subprocess
import sys
from pathlib import Path

import dragtraffic
import numpy
import pytest
from dragtraffic import Run, Scene, State

ROOT = Path(__file__).resolve().parents[2]
CROSSING = ROOT / "assets/scenes/demo-crossing.json"


@pytest.fixture(scope="module")
def scene() -> Scene:
    return dragtraffic.open(CROSSING)


def straight_on(state: State, speed_mps: float, dt: float) -> State:
    """Where a road user is that goes straight on at a speed."""
    cos, sin = math.cos(state.heading_rad), math.sin(state.heading_rad)
    x_m, y_m = state.x_m + dt * speed_mps * cos, state.y_m + dt * speed_mps * sin
    return State(x_m, y_m, state.heading_rad, speed_mps * cos, speed_mps * sin)


def test_the_others_react_to_what_an_ego_does(scene: Scene) -> None:
    run = Run(scene, "4", seed=7)
    assert run.egos == ["4"] and run.step_s == pytest.approx(0.1)
    ego, changed = run.present["4"], set()
    for number in range(1, 51):
        ego = straight_on(ego, max(0.0, 5.0 - 0.1 * number), 0.1)
        step = run.step({4: ego})
        assert step.number == number and step.time_s == pytest.approx(0.1 * number)
        assert step["4"] == pytest.approx(ego), "an ego is where it says"
        assert step.states.shape == (len(step.ids), 5) and step.states.dtype == numpy.float64
        changed |= {change["agent"] for change in step.changes if change["reaction"]["cause"] == "4"}
    assert changed, "somebody reacts to a car that stops on the crossing"
    with pytest.raises(KeyError):
        step["nobody"]


def test_equal_egos_and_seeds_give_equal_steps(scene: Scene) -> None:
    def states(seed: int) -> numpy.ndarray:
        run = Run(scene, seed=seed)
        return numpy.stack([run.step().states for _ in range(12)][-1:])

    assert (states(3) == states(3)).all()
    assert not (states(3) == states(4)).all()


#: Four runs of two scenes, stepped together or each alone: a digest of all states and of the snapshots.
TOGETHER = """
import hashlib, sys
import dragtraffic
from dragtraffic import Run

scenes = [dragtraffic.open(path) for path in sys.argv[2:]]
runs = [Run(scenes[number % 2], "4" if number % 2 == 0 else (), seed=number) for number in range(4)]
digest = hashlib.sha256()
for _ in range(12):
    egos = [{ego: run.present[ego] for ego in run.egos} for run in runs]
    alone = sys.argv[1] == "alone"
    steps = [run.step(own) for run, own in zip(runs, egos)] if alone else Run.step_together(runs, egos)
    for step in steps:
        digest.update(step.states.tobytes())
        digest.update(repr((step.number, step.ids, step.changes, step.faults)).encode())
for run in runs:
    digest.update(run.snapshot())
print(digest.hexdigest())
"""


def test_runs_that_are_stepped_together_have_equal_bytes_whatever_the_threads() -> None:
    scenes = [str(CROSSING), str(ROOT / "assets/scenes/demo-roundabout.json")]
    found = set()
    for how, threads in (("alone", "1"), ("together", "1"), ("together", "2"), ("together", "7")):
        env = {**os.environ, "RAYON_NUM_THREADS": threads, "PYTHONPATH": str(ROOT / "python")}
        command = [sys.executable, "-c", TOGETHER, how, *scenes]
        found.add(subprocess.run(command, env=env, capture_output=True, text=True, check=True).stdout)
    assert len(found) == 1, found


def test_runs_are_stepped_together_or_not_at_all(scene: Scene) -> None:
    runs = [Run(scene, "4", seed=seed) for seed in (1, 2)]
    start = runs[0].present["4"]
    with pytest.raises(dragtraffic.DragTrafficError):
        Run.step_together(runs, [{"4": start}, {"4": [math.nan] * 5}])
    with pytest.raises(ValueError, match="for each run"):
        Run.step_together(runs, [{"4": start}])
    with pytest.raises(ValueError, match="each run once"):
        Run.step_together([runs[0], runs[0]], [{"4": start}] * 2)
    steps = Run.step_together(runs, [{"4": start}] * 2)
    assert [step.number for step in steps] == [1, 1] and runs[1].present is steps[1]
    assert Run.step_together([], []) == []


def test_a_run_goes_on_with_equal_bytes_from_a_snapshot_of_twenty_moments(scene: Scene) -> None:
    def drive(run: Run, until: int) -> list[bytes]:
        """States, changes and snapshot of each step to a number: the ego stands."""
        told = []
        while run.present.number < until:
            step = run.step({"4": run.present["4"]._replace(vx_mps=0.0, vy_mps=0.0)})
            told.append(step.states.tobytes() + repr((step.changes, step.entered, step.left)).encode() + run.snapshot())
        return told

    whole = Run(scene, "4", seed=7)
    saved, told = [], []
    for moment in range(3, 63, 3):
        told += drive(whole, moment)
        saved.append(whole.snapshot())
    told += drive(whole, 66)
    assert len(saved) == 20
    for moment, snapshot in zip(range(3, 63, 3), saved):
        assert drive(Run.restore(scene, snapshot), moment + 6) == told[moment : moment + 6], f"from step {moment}"


def test_a_snapshot_goes_on_as_the_run_does(scene: Scene) -> None:
    run = Run(scene, seed=7)
    for _ in range(7):
        run.step()
    saved, branch = run.snapshot(), run.branch()
    again = Run.restore(scene, saved)
    assert again.snapshot() == saved and branch.present.number == 7
    for _ in range(5):
        ours, theirs, third = run.step(), again.step(), branch.step()
        assert (ours.states == theirs.states).all() and (ours.states == third.states).all()
    with pytest.raises(dragtraffic.DragTrafficError, match="another scene"):
        Run.restore(dragtraffic.open(ROOT / "assets/scenes/demo-motorway.json"), saved)
    with pytest.raises(dragtraffic.DragTrafficError) as refused:
        Run.restore(scene, saved[:-3])
    assert refused.value.code == "invalid-field"


def test_a_peek_changes_nothing(scene: Scene) -> None:
    run = Run(scene, ["4"], seed=7)
    before = run.snapshot()
    plan, ego = [], run.present["4"]
    for _ in range(60):
        ego = straight_on(ego, 0.0, 0.1)
        plan.append(ego)
    peek = run.peek({"4": plan})
    assert run.snapshot() == before
    assert "4" not in peek.futures and all(future.shape == (90, 5) for future in peek.futures.values())


def test_faults_of_a_call_are_named(scene: Scene) -> None:
    with pytest.raises(dragtraffic.DragTrafficError) as refused:
        Run(scene, ["nobody"])
    assert refused.value.code == "unknown-agent" and refused.value.errors[0]["pointer"] == "/egos"
    with pytest.raises(dragtraffic.DragTrafficError, match="step_s"):
        Run(scene, step_s=3.0)
    run = Run(scene, ["4"])
    with pytest.raises(dragtraffic.DragTrafficError):
        run.step()
    with pytest.raises(ValueError, match="2 numbers"):
        run.step({"4": [1.0, 2.0]})
    with pytest.raises(dragtraffic.DragTrafficError):
        run.step({"4": [math.nan] * 5})
    with pytest.raises(ValueError, match="egos does not name"):
        run.step({"4": run.present["4"]}, plans={"5": []})
    assert run.step({"4": run.present["4"]}).number == 1, "a refused step is none"


def next_states(run: Run) -> numpy.ndarray:
    return run.step().states


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_runs_go_on_in_other_processes(scene: Scene, method: str) -> None:
    run = Run(scene, seed=7)
    run.step()
    with multiprocessing.get_context(method).Pool(2) as pool:
        there = pool.map_async(next_states, [run, run]).get(timeout=120)
    here = run.step().states
    assert all((states == here).all() for states in there)


def test_the_number_of_threads_is_the_users_and_else_that_of_the_processors() -> None:
    command = [sys.executable, "-c", "import dragtraffic, os; print(os.environ['RAYON_NUM_THREADS'])"]
    free = {name: value for name, value in os.environ.items() if name != "RAYON_NUM_THREADS"}
    said = []
    for env in (free, {**free, "RAYON_NUM_THREADS": "3"}):
        env["PYTHONPATH"] = str(ROOT / "python")
        said.append(int(subprocess.run(command, env=env, capture_output=True, text=True, check=True).stdout))
    assert said[0] >= 1 and said[1] == 3
