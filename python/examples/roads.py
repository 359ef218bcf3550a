"""One planner in four roads: `Run` of Python, Gymnasium, HTTP and gRPC give it equal traffic, to the last bit (HTTP: to 0.1 mm).

    python python/examples/roads.py            # ten scenes, 20 s each
    python python/examples/roads.py --scenes 2 --seconds 5

The scenes are the examples and filled templates. The engine drives each for its length; that is its recording. Then `Idm`
(idm.py) drives the vehicle with the longest way, to the end of its recorded way, in each road, and once among the others
as recorded. Messages of gRPC are poses in single precision: in each road the planner gets what they carry, and velocities
from them. Printed: the states that are equal, and collisions and goals of the planner.
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
from typing import Any, Protocol, cast

import dragtraffic
import dragtraffic.envs
import gymnasium
import numpy as np
from dragtraffic import Run, Scene, State, Step
from idm import Idm

ROOT = Path(__file__).resolve().parents[2]
TEMPLATES = ("three-arms", "four-arms", "roundabout", "merge", "curve")
#: Classes of gRPC by subtype, and the subtype that each comes back as.
CLASSES = {"motorcycle": "motorcycle", "truck": "truck", "bus": "bus", "trailer": "trailer", "car": "automobile"}
CLASSES |= {"adult": "person", "bicycle": "rider", "unknown": "object"}
SUBTYPES = {"vehicle": "car", "pedestrian": "adult", "cyclist": "bicycle", "other": "unknown"}
NAMES = ("x_m", "y_m", "heading_rad", "vx_mps", "vy_mps")
BEGIN_US, STEP_US = 50_000_000, 100_000
AT_GOAL_M = 2.0


class Pose(tuple[float, float, float, float]):
    """What a message carries, in single precision: x, y, and w and z of the rotation."""

    @classmethod
    def of(cls, x: float, y: float, heading: float) -> Pose:
        return cls(float(np.float32(v)) for v in (x, y, math.cos(0.5 * heading), math.sin(0.5 * heading)))

    @classmethod
    def settled(cls, pose: Pose) -> Pose:
        """A pose next to this one that stays the same if its heading is carried again."""
        while (again := cls.of(pose[0], pose[1], pose.heading)) != pose:
            pose = again
        return pose

    @property
    def heading(self) -> float:
        w, z = self[2:]
        return math.atan2(2 * (w * z), w * w - z * z)

    def state(self, before: Pose, step_s: float) -> State:
        """The state at a pose, with the velocity since the one before."""
        x, y = self[0], self[1]
        heading = wrapped(wrapped(before.heading + wrapped(self.heading - before.heading)))
        return State(x, y, heading, (x - before[0]) / step_s, (y - before[1]) / step_s)


def wrapped(angle: float) -> float:
    turned = (angle + math.pi) % math.tau - math.pi
    return turned - math.tau if turned >= math.pi else turned


#: The poses of those who are there, by id.
Poses = dict[str, Pose]


class Road(Protocol):
    """A way to the traffic. An ego goes to a state, or pose; the others are told, `None` when the episode is over."""

    def step(self, state: State, pose: Pose) -> Poses | None: ...


def told(before: Step, after: Step, ego: str) -> Poses:
    """The others at the end of a step; who has just left is told once more, as gRPC does."""
    then, now = (dict(zip(step.ids, step.states.tolist())) for step in (before, after))
    poses = {}
    for id in {**now, **then}:
        (x, y, h, *_), (nx, ny, nh, *_) = then.get(id) or now[id], now.get(id) or then[id]
        if id != ego:
            poses[id] = Pose.of(x + (nx - x), y + (ny - y), wrapped(h + wrapped(nh - h)))
    return poses


class RunRoad:
    """`dragtraffic.Run`."""

    def __init__(self, scene: Scene, ego: str, seed: int) -> None:
        self.ego, self.run = ego, Run(scene, ego, seed=seed)
        self.steps = [self.run.present]

    def step(self, state: State, pose: Pose) -> Poses | None:
        self.steps.append(self.run.step({self.ego: state}))
        return told(self.steps[-2], self.steps[-1], self.ego)


class GymRoad:
    """`dragtraffic/Drive-v0`, until the planner is at its goal or has a fault."""

    def __init__(self, scene: Scene, ego: str, seed: int) -> None:
        self.ego, self.over = ego, False
        self.env = gymnasium.make("dragtraffic/Drive-v0", scene=scene, ego=ego, actions="state", horizon_s=60)
        self.seed = int(self.env.reset(seed=seed)[1]["seed"])
        self.steps = [self.run.present]

    @property
    def run(self) -> Run:
        return cast("dragtraffic.envs.Drive", self.env.unwrapped).episode.run

    def step(self, state: State, pose: Pose) -> Poses | None:
        if self.over:
            return None
        _, _, self.over, _, _ = self.env.step(np.array(state))
        self.steps.append(self.run.present)
        return told(self.steps[-2], self.steps[-1], self.ego)


class HttpRoad:
    """`POST /v1/runs`. Replies are rounded to a tenth of a millimetre: this road replays the ego's states of another."""

    def __init__(self, address: str, scene: Scene, ego: str, seed: int) -> None:
        self.at, self.ego, self.number = f"{address}/v1/runs", ego, 0
        begun = self.post("", {"scene": scene.document, "egos": [ego], "seed": seed})
        self.at = f"{self.at}/{begun['run']}/step"

    def post(self, path: str, body: Any) -> Any:
        head = {"Content-Type": "application/json"}
        with urllib.request.urlopen(urllib.request.Request(self.at + path, json.dumps(body).encode(), head)) as reply:
            return json.load(reply)

    def step(self, state: State) -> dict[str, list[float]]:
        """Everybody's state by id."""
        self.number += 1
        reply = self.post("", {"number": self.number, "egos": [{"id": self.ego, **state._asdict()}]})
        return {id: [row[name] for name in NAMES] for id, row in reply["states"].items()}


class GrpcRoad:
    """AlpaSim's `TrafficService`."""

    def __init__(self, channel: Any, name: str, scene: Scene, ego: str, seed: int) -> None:
        self.messages, service = (importlib.import_module(f"traffic_pb2{end}") for end in ("", "_grpc"))
        self.stub, self.ego, self.number, self.name = service.TrafficServiceStub(channel), ego, 0, name
        logs = [self.logged(agent) for agent in scene.document["agents"]]
        ask = {"session_uuid": name, "scene_id": name, "random_seed": seed, "handover_time_us": BEGIN_US}
        self.stub.start_session(self.messages.TrafficSessionRequest(logged_object_trajectories=logs, **ask))

    def pose(self, pose: Pose, step: int) -> Any:
        x, y, w, z = pose
        body = self.messages.Pose(vec=self.messages.Vec3(x=x, y=y), quat=self.messages.Quat(w=w, z=z))
        return self.messages.PoseAtTime(pose=body, timestamp_us=BEGIN_US + step * STEP_US)

    def logged(self, agent: dict[str, Any]) -> Any:
        track = agent["track"]
        rows = enumerate(zip(*(track[name] for name in NAMES[:3])), track["first_step"])
        poses = [self.pose(Pose.of(*row), step) for step, row in rows]
        sizes = {"size_x": agent["length_m"], "size_y": agent["width_m"], "size_z": agent["height_m"]}
        return self.messages.ObjectTrajectory(
            aabb=self.messages.AABB(**sizes),
            trajectory=self.messages.Trajectory(poses=poses),
            object_id=agent["id"],
            label_class=CLASSES[agent["subtype"]],
        )

    def step(self, state: State, pose: Pose) -> Poses | None:
        self.number += 1
        moved = self.messages.Trajectory(poses=[self.pose(pose, self.number)])
        update = self.messages.ObjectTrajectoryUpdate(object_id=self.ego, trajectory=moved)
        at_us = BEGIN_US + self.number * STEP_US
        ask = self.messages.TrafficRequest(
            session_uuid=self.name, time_query_us=at_us, object_trajectory_updates=[update]
        )
        poses = {}
        for one in self.stub.simulate(ask).object_trajectory_updates:
            body = one.trajectory.poses[0].pose
            poses[one.object_id] = Pose((body.vec.x, body.vec.y, body.quat.w, body.quat.z))
        return poses


class ReplayRoad:
    """The others as recorded."""

    def __init__(self, scene: Scene, ego: str) -> None:
        self.number, self.ego = 0, ego
        self.tracks = {agent["id"]: agent["track"] for agent in scene.document["agents"]}

    def step(self, state: State, pose: Pose) -> Poses | None:
        self.number += 1
        there = {id: self.number - track["first_step"] for id, track in self.tracks.items() if id != self.ego}
        is_there = {id: at for id, at in there.items() if 0 <= at < len(self.tracks[id]["x_m"])}
        return {id: Pose.of(*(self.tracks[id][name][at] for name in NAMES[:3])) for id, at in is_there.items()}


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
    signals = [{**one, "states": [state for state in one["states"] if state[0] <= count]} for one in document["signals"]]
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
    command = [sys.executable, "-m", "dragtraffic", "serve", "--log-level", "error", "--port", "0", "--grpc", "0", "--data", str(folder / "scenes")]
    with subprocess.Popen([*command, "--db", str(folder / "db.sqlite")], stdout=subprocess.PIPE, text=True) as server:
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
    pairs = [judged(scene, ego, driven, count) for driven in (drive(ReplayRoad(scene, ego), scene, ego, count), reacting)]
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
            print("scene               ego  equal steps: gym grpc http    collisions  off road  from its goal, m: replay, react")
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
