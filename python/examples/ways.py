"""Ways to equal traffic: `Run` of Python, Gymnasium, HTTP, gRPC, and the recording. `roads.py` compares them."""

from __future__ import annotations

import importlib
import json
import math
import urllib.request
from typing import Any, Protocol, cast

import dragtraffic.envs
import gymnasium
import numpy as np
from dragtraffic import Run, Scene, State, Step

#: Classes of gRPC by subtype, and the subtype that each comes back as.
CLASSES = {"motorcycle": "motorcycle", "truck": "truck", "bus": "bus", "trailer": "trailer", "car": "automobile"}
CLASSES |= {"adult": "person", "bicycle": "rider", "unknown": "object"}
NAMES = ("x_m", "y_m", "heading_rad", "vx_mps", "vy_mps")
#: Time of the first step in messages of gRPC, and length of a step.
BEGIN_US, STEP_US = 50_000_000, 100_000


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
    """`POST /v1/runs`. Replies are rounded to 0.1 mm: this road repeats the ego's states of another."""

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
