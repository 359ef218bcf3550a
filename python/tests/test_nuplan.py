"""The adapters for nuPlan, over its devkit where this is installed, else over stand-ins for its classes."""

from __future__ import annotations

import math
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import dragtraffic
import numpy as np
import nuplan_shapes
import pytest
from dragtraffic import State

nuplan_shapes.provide()

from dragtraffic.adapters.nuplan import NuplanDriver, ReactingAgents, scene_of  # noqa: E402
from nuplan.common.actor_state.agent import Agent  # noqa: E402
from nuplan.common.actor_state.ego_state import EgoState  # noqa: E402
from nuplan.common.actor_state.oriented_box import OrientedBox  # noqa: E402
from nuplan.common.actor_state.scene_object import SceneObjectMetadata  # noqa: E402
from nuplan.common.actor_state.state_representation import StateSE2, StateVector2D, TimePoint  # noqa: E402
from nuplan.common.actor_state.static_object import StaticObject  # noqa: E402
from nuplan.common.actor_state.tracked_objects import TrackedObjects  # noqa: E402
from nuplan.common.actor_state.tracked_objects_types import TrackedObjectType  # noqa: E402
from nuplan.common.actor_state.vehicle_parameters import VehicleParameters  # noqa: E402
from nuplan.common.maps.maps_datatypes import (  # noqa: E402
    SemanticMapLayer,
    TrafficLightStatusData,
    TrafficLightStatusType,
)
from nuplan.planning.simulation.history.simulation_history_buffer import SimulationHistoryBuffer  # noqa: E402
from nuplan.planning.simulation.observation.observation_type import DetectionsTracks  # noqa: E402
from nuplan.planning.simulation.planner.abstract_planner import AbstractPlanner  # noqa: E402
from nuplan.planning.simulation.simulation_time_controller.simulation_iteration import (  # noqa: E402
    SimulationIteration,
)
from nuplan.planning.simulation.trajectory.interpolated_trajectory import InterpolatedTrajectory  # noqa: E402

CROSSING = Path(__file__).resolve().parents[2] / "assets/scenes/demo-crossing.json"
#: Place of the crossing in a city, metres; time of its first iteration, microseconds.
EAST_M, NORTH_M, START_US = 664_400.0, 3_998_300.0, 1_623_000_000_000_123
#: The car of nuPlan: its rear axle is 1.461 m behind the centre of its box.
CAR = VehicleParameters(2.297, 4.049, 1.127, 1.67, 3.089, "car", "gen1", 1.777)
KINDS = {
    "vehicle": TrackedObjectType.VEHICLE,
    "pedestrian": TrackedObjectType.PEDESTRIAN,
    "cyclist": TrackedObjectType.BICYCLE,
}
LIGHTS = {
    "go": TrafficLightStatusType.GREEN,
    "caution": TrafficLightStatusType.YELLOW,
    "stop": TrafficLightStatusType.RED,
}


class Ring:
    """An area as shapely has it."""

    def __init__(self, corners: list[list[float]]) -> None:
        points = [(x + EAST_M, y + NORTH_M) for x, y in corners]
        self.exterior = SimpleNamespace(coords=[*points, points[0]])
        x, y = np.array(corners).T
        self.area = abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1))) / 2


class MapObjects:
    """The crossing as a map of nuPlan: lanes through the junction are connectors."""

    def __init__(self, document: dict[str, Any]) -> None:
        road = document["map"]
        self.lanes = {lane["id"]: lane for lane in road["lanes"] if lane["type"] == "surface_street"}
        self.areas = [SimpleNamespace(id=one["id"], polygon=Ring(one["polygon_m"])) for one in road["drivable"]]
        self.crosswalks = [SimpleNamespace(id=one["id"], polygon=Ring(one["polygon_m"])) for one in road["crosswalks"]]

    def _lane(self, lane: dict[str, Any]) -> Any:
        line = np.array(lane["points_m"])[:, :2]
        edges = np.diff(line, axis=0)
        length = float(np.hypot(*edges.T).sum())
        headings = np.arctan2(edges[:, 1], edges[:, 0])
        poses = zip(line.tolist(), [*headings.tolist(), float(headings[-1])])
        around = [SimpleNamespace(id=id) for id in lane["successors"] if id in self.lanes]
        before = [SimpleNamespace(id=id) for id in lane["predecessors"] if id in self.lanes]

        def beside(side: str) -> Any:
            found = [self.lanes[one["lane"]] for one in lane[side] if one["lane"] in self.lanes]
            return self._lane({**found[0], "left_neighbors": [], "right_neighbors": []}) if found else None

        return SimpleNamespace(
            id=lane["id"],
            polygon=SimpleNamespace(area=length * 3.5),
            baseline_path=SimpleNamespace(
                length=length, discrete_path=[StateSE2(x + EAST_M, y + NORTH_M, turn) for (x, y), turn in poses]
            ),
            speed_limit_mps=lane["speed_limit_mps"],
            incoming_edges=before,
            outgoing_edges=around,
            adjacent_edges=(beside("left_neighbors"), beside("right_neighbors")),
        )

    def get_proximal_map_objects(self, point: Any, radius: float, layers: list[Any]) -> dict[Any, list[Any]]:
        assert abs(point.x - EAST_M) < 100 and abs(point.y - NORTH_M) < 100 and radius > 0
        found: dict[Any, list[Any]] = {layer: [] for layer in layers}
        for lane in self.lanes.values():
            layer = SemanticMapLayer.LANE_CONNECTOR if lane["interpolating"] else SemanticMapLayer.LANE
            found[layer].append(self._lane(lane))
        found[SemanticMapLayer.CROSSWALK] = self.crosswalks
        found[SemanticMapLayer.ROADBLOCK] = self.areas
        return found


class Log:
    """The crossing as a scenario of nuPlan whose ego is car 4, with a cone beside the road."""

    log_name, token, database_interval = "crossing", "t1", 0.1

    def __init__(self) -> None:
        self.document = dragtraffic.open(CROSSING).document
        self.agents = {agent["id"]: agent for agent in self.document["agents"]}
        self.map_api = MapObjects(self.document)

    def get_number_of_iterations(self) -> int:
        return 91

    def get_time_point(self, iteration: int) -> TimePoint:
        # Clocks of a log are not quite regular.
        return TimePoint(START_US + iteration * 100_000 + (iteration % 3) * 40)

    def get_ego_state_at_iteration(self, iteration: int) -> EgoState:
        state = state_of(self.agents["4"], iteration)
        assert state is not None
        speed = StateVector2D(state.speed_mps, 0.0)
        none, at = StateVector2D(0.0, 0.0), self.get_time_point(iteration)
        return EgoState.build_from_center(pose(state), speed, none, 0.0, at, CAR)

    def get_tracked_objects_at_iteration(self, iteration: int) -> DetectionsTracks:
        found: list[Any] = []
        for number, agent in enumerate(self.document["agents"]):
            state = state_of(agent, iteration)
            if state is None or agent["id"] == "4" or agent["type"] not in KINDS:
                continue
            box = OrientedBox(pose(state), agent["length_m"], agent["width_m"], agent["height_m"] or 1.7)
            data = SceneObjectMetadata(0, f"{agent['id']}@{iteration}", number, agent["id"], agent["type"])
            found.append(Agent(KINDS[agent["type"]], box, StateVector2D(state.vx_mps, state.vy_mps), data))
        box = OrientedBox(StateSE2(EAST_M + 30.0, NORTH_M + 30.0, 0.0), 0.4, 0.4, 0.8)
        cone = SceneObjectMetadata(0, f"cone@{iteration}", 99, "cone", "traffic_cone")
        found.append(StaticObject(TrackedObjectType.TRAFFIC_CONE, box, cone))
        return DetectionsTracks(TrackedObjects(found))

    def get_traffic_light_status_at_iteration(self, iteration: int) -> Any:
        for signal in self.document["signals"]:
            state = [word for first, word in signal["states"] if first <= iteration][-1]
            yield TrafficLightStatusData(LIGHTS[state.removeprefix("arrow_")], int(signal["lane"]), 0)


def state_of(agent: dict[str, Any], step: int) -> State | None:
    track = agent["track"]
    at = step - track["first_step"]
    if not any(begin <= step < end for begin, end in track["valid"] or [[track["first_step"], 600]]):
        return None
    return State(*(track[name][at] for name in State._fields)) if 0 <= at < len(track["x_m"]) else None


def pose(state: State) -> StateSE2:
    return StateSE2(state.x_m + EAST_M, state.y_m + NORTH_M, state.heading_rad)


@pytest.fixture(scope="module")
def log() -> Log:
    return Log()


def test_a_scenario_is_a_scene_around_its_ego(log: Log) -> None:
    scene = scene_of(log)
    document = scene.document
    agents = {agent["id"]: agent for agent in document["agents"]}
    origin = document["meta"]["origin"]
    start = state_of(log.agents["4"], 0)
    assert start is not None
    ego = agents["ego"]
    assert ego["role"] == "ego" and (ego["length_m"], ego["width_m"]) == pytest.approx((5.176, 2.297))
    assert origin["x_m"] == round(EAST_M + start.x_m) and origin["y_m"] == round(NORTH_M + start.y_m)
    assert ego["track"]["x_m"][0] + origin["x_m"] == pytest.approx(start.x_m + EAST_M, abs=0.01)
    assert ego["track"]["vx_mps"][0] == pytest.approx(start.speed_mps * math.cos(start.heading_rad), abs=0.01)
    assert document["time"]["steps"] == 91 and agents["cone"]["type"] == "other"
    for id, agent in log.agents.items():
        if id != "4" and agent["type"] in KINDS:
            seen = agent["track"]["valid"] or [[agent["track"]["first_step"]]]
            assert agents[id]["type"] == agent["type"] and agents[id]["track"]["first_step"] == seen[0][0]
    lanes = {lane["id"]: lane for lane in document["map"]["lanes"]}
    assert len(lanes) == len(log.map_api.lanes)
    for id, known in log.map_api.lanes.items():
        lane = lanes[f"c{id}" if known["interpolating"] else id]
        assert len(lane["successors"]) == sum(
            next_ in log.map_api.lanes and log.map_api.lanes[next_]["interpolating"] != known["interpolating"]
            for next_ in known["successors"]
        )
        assert lane["width_m"] == pytest.approx(3.5) and lane["interpolating"] == known["interpolating"]
        for end in (0, -1):
            there = np.array(lane["points_m"][end]) + (origin["x_m"], origin["y_m"])
            assert there == pytest.approx(np.array(known["points_m"][end][:2]) + (EAST_M, NORTH_M), abs=0.01)
    lights = {signal["lane"]: signal["states"] for signal in document["signals"]}
    assert lights and all(lane in lanes for lane in lights)


def braking(ego: EgoState, at: TimePoint, seconds: float) -> EgoState:
    """The ego after it has braked by 3 m/s2 for some seconds along its heading."""
    velocity = ego.dynamic_car_state.rear_axle_velocity_2d
    after = max(0.0, velocity.x - 3.0 * seconds)
    gone, none = 0.5 * (velocity.x + after) * seconds, StateVector2D(0.0, 0.0)
    rear = ego.rear_axle
    place = StateSE2(rear.x + gone * math.cos(rear.heading), rear.y + gone * math.sin(rear.heading), rear.heading)
    return EgoState.build_from_rear_axle(place, StateVector2D(after, 0.0), none, 0.0, at, CAR)


def simulated(log: Log, agents: ReactingAgents, count: int) -> list[tuple[EgoState, DetectionsTracks]]:
    """A simulation as nuPlan steps it: the ego first, then the observation, which is told of the ego before."""
    agents.reset()
    agents.initialize()
    history = SimulationHistoryBuffer([log.get_ego_state_at_iteration(0)], [agents.get_observation()], 0.1)
    for index in range(count):
        now, then = (SimulationIteration(log.get_time_point(i), i) for i in (index, index + 1))
        ego = braking(history.ego_states[-1], then.time_point, (then.time_us - now.time_us) / 1e6)
        agents.update_observation(now, then, history)
        history.ego_state_buffer.append(ego)
        history.observation_buffer.append(agents.get_observation())
    return list(zip(history.ego_states, history.observations))


def test_its_traffic_reacts_to_the_ego_of_a_simulation(log: Log) -> None:
    agents = ReactingAgents(log, seed=7)
    assert agents.observation_type() is DetectionsTracks
    with pytest.raises(RuntimeError, match="initialize"):
        agents.get_observation()
    told = simulated(log, agents, 60)
    seen = [{one.track_token: one for one in observation.tracked_objects} for _, observation in told]
    first, last = seen[0], seen[-1]
    for id, one in first.items():
        start = state_of(log.agents[id], 0) if id != "cone" else None
        if start is not None:
            assert (one.center.x - EAST_M, one.center.y - NORTH_M) == pytest.approx((start.x_m, start.y_m), abs=1e-3)
            assert (one.velocity.x, one.velocity.y) == pytest.approx((start.vx_mps, start.vy_mps), abs=1e-3)
            assert one.box.length == pytest.approx(log.agents[id]["length_m"])
    assert "ego" not in last and last["cone"].tracked_object_type == TrackedObjectType.TRAFFIC_CONE
    assert all(one.metadata.timestamp_us == log.get_time_point(60).time_us for id, one in last.items() if id != "cone")
    # The run has the ego where the simulation has it, but for what a step's acceleration changes.
    own, there = agents.run.present["ego"], told[-1][0].center
    origin = agents.road_users.origin
    assert (own.x_m + origin[0], own.y_m + origin[1]) == pytest.approx((there.x, there.y), abs=0.05)
    moved = [one for id, one in last.items() if id in first and np.hypot(one.velocity.x, one.velocity.y) > 1]
    assert moved, "somebody drives"
    again = simulated(log, agents, 60)[-1][1].tracked_objects
    assert [(one.center.x, one.center.y) for one in again] == [(one.center.x, one.center.y) for one in last.values()]


class Straight(AbstractPlanner):  # type: ignore[misc]
    """Goes straight on and brakes by 3 m/s2; keeps what it is told."""

    def __init__(self) -> None:
        self.told: list[tuple[Any, list[Any], list[Any]]] = []

    def name(self) -> str:
        return "straight"

    def initialize(self, initialization: Any) -> None:
        self.initialization = initialization

    def observation_type(self) -> Any:
        return DetectionsTracks

    def compute_planner_trajectory(self, current_input: Any) -> Any:
        history = current_input.history
        self.told.append((current_input, history.ego_states, history.observations))
        ego, _ = history.current_state
        at = [TimePoint(ego.time_us + number * 250_000) for number in range(1, 13)]
        return InterpolatedTrajectory([ego, *(braking(ego, time, 0.25 * (i + 1)) for i, time in enumerate(at))])


def test_a_planner_drives_in_a_run(log: Log) -> None:
    scene, made = scene_of(log), []

    def make() -> Straight:
        made.append(Straight())
        return made[-1]

    driver = NuplanDriver(make, map_api=log.map_api, route_roadblock_ids=["7"], vehicle=CAR, start_us=START_US)
    driven = dragtraffic.drive(scene, driver, seconds=2.0, seed=7)
    (planner,) = made
    assert planner.initialization.map_api is log.map_api and planner.initialization.route_roadblock_ids == ["7"]
    end = log.agents["4"]["track"]
    goal = planner.initialization.mission_goal
    assert (goal.x - EAST_M, goal.y - NORTH_M) == pytest.approx((end["x_m"][-1], end["y_m"][-1]), abs=0.01)
    assert [asked.iteration.time_us - START_US for asked, *_ in planner.told] == [i * 100_000 for i in range(20)]
    assert [len(egos) for _, egos, _ in planner.told] == list(range(1, 21))
    first, (ego,), (observation,) = planner.told[0]
    start = state_of(log.agents["4"], 0)
    assert start is not None
    # Its pose is the rear axle's, ours the centre of the box.
    assert (ego.center.x - EAST_M, ego.center.y - NORTH_M) == pytest.approx((start.x_m, start.y_m), abs=0.01)
    behind = (ego.center.x - ego.rear_axle.x) * math.cos(start.heading_rad)
    behind += (ego.center.y - ego.rear_axle.y) * math.sin(start.heading_rad)
    assert behind == pytest.approx(1.461, abs=1e-3)
    assert ego.dynamic_car_state.rear_axle_velocity_2d.x == pytest.approx(start.speed_mps, abs=0.01)
    assert {one.track_token for one in observation.tracked_objects} == set(driven.steps[0].ids) - {"ego", "cone"}
    assert {light.lane_connector_id for light in first.traffic_light_data} <= set(map(int, log.map_api.lanes))
    now = driven.steps[19]["ego"]
    there = planner.told[-1][1][-1].center
    origin = scene.document["meta"]["origin"]
    assert (now.x_m + origin["x_m"], now.y_m + origin["y_m"]) == pytest.approx((there.x, there.y), abs=1e-3)
    assert driven.steps[20]["ego"].speed_mps == pytest.approx(max(0.0, start.speed_mps - 6.0), abs=0.35)


def test_a_planner_without_a_map_drives_any_scene() -> None:
    made: list[Straight] = []

    def make() -> Straight:
        made.append(Straight())
        return made[-1]

    driven = dragtraffic.drive(dragtraffic.open(CROSSING), NuplanDriver(make), ["4", "6"], seconds=0.5)
    assert len(made) == 2 and driven.egos == ["4", "6"]
    (length,) = (agent["length_m"] for agent in driven.film.document["agents"] if agent["id"] == "4")
    ego = made[0].told[0][1][0]
    assert ego.car_footprint.length == pytest.approx(length) and made[0].initialization.map_api is None
