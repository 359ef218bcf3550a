"""One planner in four roads: `Run` of Python, Gymnasium, HTTP and gRPC give it equal traffic, to the last bit (HTTP: to
0.1 mm).

    python python/examples/roads.py            # ten scenes, 20 s each
    python python/examples/roads.py --scenes 2 --seconds 5

The scenes are the examples and filled templates. The engine drives each for its length: this is its recording. Then
`Idm` (idm.py) drives the vehicle with the longest way, to the end of its recorded way, in each road, and once among the
others as recorded. Messages of gRPC are poses in single precision: in each road the planner gets what they carry, and
velocities from them. Printed are the steps that are equal, and collisions and goals of the planner.
"""

from __future__ import annotations

import argparse
import importlib
import json
import math
import subprocess
import sys
import tempfile
import time
import urllib.request
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import dragtraffic
import numpy as np
from dragtraffic import Run, Scene, State, Step
from idm import Idm
from ways import CLASSES, NAMES, STEP_US, GrpcRoad, GymRoad, HttpRoad, Pose, Poses, ReplayRoad, Road, RunRoad

ROOT = Path(__file__).resolve().parents[2]
TEMPLATES = ("three-arms", "four-arms", "roundabout", "merge", "curve")
SUBTYPES = {"vehicle": "car", "pedestrian": "adult", "cyclist": "bicycle", "other": "unknown"}
AT_GOAL_M = 2.0


@dataclass
class Driven:
    """The ego's states, and the others at each step."""

    states: list[State]
    others: list[Poses] = field(default_factory=list)


def drive(road: Road, scene: Scene, ego: str, count: int) -> Driven:
    """Lets the planner drive in a road."""
    agents = {agent["id"]: agent["track"] for agent in scene.document["agents"]}
    begun = {id: State(*(track[name][0] for name in NAMES)) for id, track in agents.items() if track["first_step"] == 0}
    planner, driven, pose = Idm(scene, ego), Driven([begun[ego]]), Pose.of(*begun[ego][:3])
    seen, before = begun, {id: Pose.of(*state[:3]) for id, state in begun.items()}
    for number in range(count):
        wanted = planner(Step(number, 0.1 * number, list(seen), np.array(list(seen.values()))))
        pose, last = Pose.of(*wanted[:3]), pose
        state = pose.state(last, STEP_US * 1e-6)
        others = road.step(state, pose)
        if others is None:
            break
        driven.states.append(state)
        driven.others.append(others)
        seen = {ego: state, **{id: of.state(before.get(id, of), 0.1) for id, of in sorted(others.items())}}
        before = others
    return driven


def recorded(scene: Scene, name: str, seed: int, count: int) -> Scene:
    """The scene with the engine's own run as recording, as messages of gRPC can carry it."""
    run = Run(scene, seed=seed)
    rows: dict[str, dict[int, Pose]] = {}
    for number in range(count + 1):
        step = run.step() if number else run.present
        for id, (x, y, heading, *_) in zip(step.ids, step.states.tolist()):
            rows.setdefault(id, {})[number] = Pose.of(x, y, heading)
    return Scene({**filmed(scene, rows, count).document, "name": f"{name}, recorded"})


def filmed(scene: Scene, rows: dict[str, dict[int, Pose]], count: int) -> Scene:
    """The scene with these motions as tracks."""
    document, agents = scene.document, []
    for agent in document["agents"]:
        poses = rows.get(agent["id"], {})
        if len(poses) < 2:
            continue
        first, line = min(poses), [Pose.settled(poses[step]) for step in sorted(poses)]
        # A velocity is that since the pose before; at the first one, until the next.
        states = [pose.state(before, 0.1) for before, pose in zip([line[0], *line], line)]
        states[0] = State(*states[0][:3], *line[1].state(line[0], 0.1)[3:])
        track = {"first_step": first, **{name: [getattr(state, name) for state in states] for name in NAMES}}
        subtype = agent.get("subtype") if agent.get("subtype") in CLASSES else SUBTYPES[agent["type"]]
        size = {key: float(np.float32(agent.get(key) or 1.6)) for key in ("length_m", "width_m", "height_m")}
        agents.append({"id": agent["id"], "type": agent["type"], "subtype": subtype, **size, "track": track})
    signals = document["signals"]
    signals = [{**one, "states": [state for state in one["states"] if state[0] <= count]} for one in signals]
    kept = {key: document[key] for key in ("format", "version", "name", "map")}
    timing = {"step_s": 0.1, "steps": count + 1, "now_step": 0}
    return Scene({**kept, "time": timing, "agents": agents, "signals": [one for one in signals if one["states"]]})


def scenes(wanted: int, count: int) -> Iterator[Scene]:
    """Filled templates and examples in turn, recorded."""
    files = sorted((ROOT / "assets/scenes").glob("*.json"))
    names = [name for pair in zip(TEMPLATES, files) for name in pair][:wanted]
    for name in names:
        if isinstance(name, Path):
            yield recorded(dragtraffic.open(name), name.stem, 1, count)
            continue
        command = [sys.executable, "-m", "dragtraffic", "map", "--template", name, "--json"]
        empty = Scene(json.loads(subprocess.run(command, capture_output=True, check=True).stdout))
        yield recorded(empty.place(count=16, types={"vehicle": 1.0}, seed=1), name, 1, count)


def longest(scene: Scene) -> str:
    """The vehicle that is there from the first step on and goes farthest."""

    def way_m(agent: dict[str, Any]) -> float:
        track = agent["track"]
        steps = np.hypot(np.diff(track["x_m"]), np.diff(track["y_m"]))
        return float(steps.sum()) if agent["type"] == "vehicle" and track["first_step"] == 0 else -1.0

    return str(max(scene.document["agents"], key=way_m)["id"])


@contextmanager
def served(folder: Path) -> Iterator[tuple[str, Any]]:
    """A server over a folder of scenes: its address, and a channel of gRPC."""
    grpc, protoc = importlib.import_module("grpc"), importlib.import_module("grpc_tools.protoc")
    made, proto = folder / "made", Path(__file__).with_name("traffic.proto")
    made.mkdir()
    outputs = [f"-I{proto.parent}", f"--python_out={made}", f"--grpc_python_out={made}"]
    assert protoc.main(["protoc", *outputs, str(proto)]) == 0
    sys.path.insert(0, str(made))
    command = [sys.executable, "-m", "dragtraffic", "serve", "--port", "0", "--grpc", "0", "--log-level", "error"]
    stores = ["--data", str(folder / "scenes"), "--db", str(folder / "db.sqlite")]
    with subprocess.Popen([*command, *stores], stdout=subprocess.PIPE, text=True) as server:
        assert server.stdout is not None
        try:
            address, port = (server.stdout.readline().split()[-1] for _ in range(2))
            with grpc.insecure_channel(port) as channel:
                yield address.rstrip("/"), channel
        finally:
            server.terminate()


def listed(address: str, count: int) -> dict[str, str]:
    """Ids of the recorded scenes by name, once the server has read so many."""
    for _ in range(600):
        with urllib.request.urlopen(f"{address}/v1/scenes?limit=200") as reply:
            ids = {one["name"]: one["id"] for one in json.load(reply)["scenes"]}
        ids = {name: id for name, id in ids.items() if name.endswith(", recorded")}
        if len(ids) == count:
            return ids
        time.sleep(0.1)
    raise TimeoutError(f"the server lists {len(ids)} of {count} scenes")


@dataclass
class Outcome:
    """Of one scene: steps that are equal in each road, and of the planner among others as recorded and as they react:
    collisions, steps off the road, metres from its goal."""

    scene: str
    ego: str
    equal: dict[str, int]
    collisions: tuple[int, int]
    off_road: tuple[float, float]
    nearest_m: tuple[float, float]


def outcome(scene: Scene, address: str, channel: Any, id: str, count: int) -> Outcome:
    """Drives a scene in all roads.

    Raises:
        AssertionError: two roads differ.
    """
    name, ego = scene.name, longest(scene)
    gym = GymRoad(scene, ego, 7)
    run = RunRoad(scene, ego, gym.seed)
    roads: dict[str, Road] = {"gym": gym, "grpc": GrpcRoad(channel, id, scene, ego, gym.seed)}
    reacting, equal = drive(run, scene, ego, count), {}
    for road, of in roads.items():
        found = drive(of, scene, ego, count)
        equal[road] = len(found.others)
        assert found.states == reacting.states[: len(found.states)], f"{name}: the ego by {road}"
        assert found.others == reacting.others[: len(found.others)], f"{name}: the others by {road}"
    for one, other in zip(gym.steps, run.steps):
        assert one.ids == other.ids and one.states.tobytes() == other.states.tobytes(), f"{name}: gym, {one.number}"
    http = HttpRoad(address, scene, ego, gym.seed)
    for state, step in zip(reacting.states[1:], run.steps[1:]):
        states = http.step(state)
        assert sorted(states) == sorted(step.ids), f"{name}: http, {step.number}"
        apart = np.abs(step.states - np.array([states[id] for id in step.ids]))
        assert apart.max() < 0.6e-4, f"{name}: http, {step.number}"
        equal["http"] = step.number
    replayed = drive(ReplayRoad(scene, ego), scene, ego, count)
    pairs = [judged(scene, ego, driven, count) for driven in (replayed, reacting)]
    collisions, off_road, nearest_m = zip(*pairs)
    return Outcome(name, ego, equal, collisions, off_road, nearest_m)


def judged(scene: Scene, ego: str, driven: Driven, count: int) -> tuple[int, float, float]:
    """Collisions of the ego, its share of the time off the road, and its least distance from its goal."""
    rows: dict[str, dict[int, Pose]] = {ego: {at: Pose.of(*state[:3]) for at, state in enumerate(driven.states)}}
    for number, others in enumerate(driven.others, 1):
        for id, pose in others.items():
            rows.setdefault(id, {})[number] = pose
    score = filmed(scene, rows, count).score()["agents"][ego]
    track = next(agent["track"] for agent in scene.document["agents"] if agent["id"] == ego)
    away = [math.hypot(state.x_m - track["x_m"][-1], state.y_m - track["y_m"][-1]) for state in driven.states]
    return int(score["collisions"]), float(score["offroad_share"] or 0.0), min(away)


def main(arguments: Sequence[str] | None = None) -> list[Outcome]:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", type=int, default=10, help="number of scenes, at most 10")
    parser.add_argument("--seconds", type=float, default=20.0, help="length of each drive")
    args = parser.parse_args(arguments)
    count, found = round(10 * args.seconds), []
    with tempfile.TemporaryDirectory() as folder:
        data = Path(folder, "scenes")
        data.mkdir()
        all = list(scenes(args.scenes, count))
        for number, scene in enumerate(all):
            (data / f"{number}.json").write_text(json.dumps(scene.document))
        with served(Path(folder)) as (address, channel):
            ids = listed(address, len(all))
            print("scene, ego; equal steps: gym, grpc, http; replay and react: collisions, off road, m from the goal")
            for scene in all:
                found.append(outcome(scene, address, channel, ids[scene.name], count))
                print(row(found[-1]), flush=True)
    return found


def row(one: Outcome) -> str:
    equal = " ".join(f"{steps:4}" for steps in one.equal.values())
    pairs = [f"{a:.2f} {b:.2f}" for a, b in (one.off_road, one.nearest_m)]
    return f"{one.scene:18} {one.ego:>4}  {equal}  {one.collisions[0]} {one.collisions[1]}  {pairs[0]}  {pairs[1]}"


if __name__ == "__main__":
    main()
