"""Stand-ins for the classes of nuPlan's devkit that the adapters use: constructors, attributes and units as published
there, and nothing else. They are there where the devkit is not, which PyPI does not have."""

from __future__ import annotations

import abc
import enum
import importlib.util
import math
import sys
from dataclasses import dataclass
from types import ModuleType
from typing import Any

import numpy as np


class TimePoint:
    def __init__(self, time_us: int) -> None:
        assert time_us >= 0
        self.time_us = time_us

    def __eq__(self, other: object) -> bool:
        return isinstance(other, TimePoint) and other.time_us == self.time_us

    def __hash__(self) -> int:
        return hash(self.time_us)


@dataclass(frozen=True)
class Point2D:
    x: float
    y: float


@dataclass(frozen=True)
class StateSE2(Point2D):
    heading: float

    @property
    def point(self) -> Point2D:
        return Point2D(self.x, self.y)


@dataclass(frozen=True)
class StateVector2D:
    x: float
    y: float


@dataclass(frozen=True)
class VehicleParameters:
    width: float
    front_length: float
    rear_length: float
    cog_position_from_rear_axle: float
    wheel_base: float
    vehicle_name: str
    vehicle_type: str
    height: float | None = None

    @property
    def length(self) -> float:
        return self.front_length + self.rear_length

    @property
    def rear_axle_to_center(self) -> float:
        return self.length / 2 - self.rear_length


class OrientedBox:
    def __init__(self, center: StateSE2, length: float, width: float, height: float) -> None:
        self.center, self.length, self.width, self.height = center, length, width, height


def shifted(pose: StateSE2, ahead_m: float) -> StateSE2:
    """A pose that is ahead of another."""
    return StateSE2(pose.x + ahead_m * math.cos(pose.heading), pose.y + ahead_m * math.sin(pose.heading), pose.heading)


class DynamicCarState:
    def __init__(self, to_center_m: float, velocity: StateVector2D, turn: float) -> None:
        self.rear_axle_velocity_2d = velocity
        self.center_velocity_2d = StateVector2D(velocity.x, velocity.y + turn * to_center_m)
        self.angular_velocity = turn


class EgoState:
    """Poses in the map's frame, velocities in the ego's own."""

    def __init__(
        self, center: StateSE2, at_rear: StateVector2D, time_point: TimePoint, vehicle: VehicleParameters, turn: float
    ) -> None:
        self.car_footprint = OrientedBox(center, vehicle.length, vehicle.width, vehicle.height or 1.7)
        self.center, self.time_point, self.vehicle = center, time_point, vehicle
        self.rear_axle = shifted(center, -vehicle.rear_axle_to_center)
        self.dynamic_car_state = DynamicCarState(vehicle.rear_axle_to_center, at_rear, turn)

    @property
    def time_us(self) -> int:
        return self.time_point.time_us

    @classmethod
    def build_from_center(
        cls,
        center: StateSE2,
        center_velocity_2d: StateVector2D,
        center_acceleration_2d: StateVector2D,
        tire_steering_angle: float,
        time_point: TimePoint,
        vehicle_parameters: VehicleParameters,
        is_in_auto_mode: bool = True,
        angular_vel: float = 0.0,
        angular_accel: float = 0.0,
    ) -> EgoState:
        left = center_velocity_2d.y - angular_vel * vehicle_parameters.rear_axle_to_center
        return cls(center, StateVector2D(center_velocity_2d.x, left), time_point, vehicle_parameters, angular_vel)

    @classmethod
    def build_from_rear_axle(
        cls,
        rear_axle_pose: StateSE2,
        rear_axle_velocity_2d: StateVector2D,
        rear_axle_acceleration_2d: StateVector2D,
        tire_steering_angle: float,
        time_point: TimePoint,
        vehicle_parameters: VehicleParameters,
        is_in_auto_mode: bool = True,
        angular_vel: float = 0.0,
        angular_accel: float = 0.0,
        tire_steering_rate: float = 0.0,
    ) -> EgoState:
        center = shifted(rear_axle_pose, vehicle_parameters.rear_axle_to_center)
        return cls(center, rear_axle_velocity_2d, time_point, vehicle_parameters, angular_vel)


class TrackedObjectType(enum.Enum):
    VEHICLE = 0
    PEDESTRIAN = 1
    BICYCLE = 2
    TRAFFIC_CONE = 3
    BARRIER = 4
    CZONE_SIGN = 5
    GENERIC_OBJECT = 6
    EGO = 7


@dataclass(frozen=True)
class SceneObjectMetadata:
    timestamp_us: int
    token: str
    track_id: int | None
    track_token: str | None
    category_name: str | None = None


class SceneObject:
    def __init__(
        self, tracked_object_type: TrackedObjectType, oriented_box: OrientedBox, metadata: SceneObjectMetadata
    ) -> None:
        self.tracked_object_type, self.box, self.metadata = tracked_object_type, oriented_box, metadata
        self.velocity = StateVector2D(0.0, 0.0)

    @property
    def center(self) -> StateSE2:
        return self.box.center

    @property
    def track_token(self) -> str | None:
        return self.metadata.track_token


class StaticObject(SceneObject):
    pass


class Agent(SceneObject):
    def __init__(
        self,
        tracked_object_type: TrackedObjectType,
        oriented_box: OrientedBox,
        velocity: StateVector2D,
        metadata: SceneObjectMetadata,
        angular_velocity: float | None = None,
        predictions: list[Any] | None = None,
        past_trajectory: Any = None,
    ) -> None:
        super().__init__(tracked_object_type, oriented_box, metadata)
        self.velocity = velocity


class TrackedObjects:
    def __init__(self, tracked_objects: list[Any] | None = None) -> None:
        self.tracked_objects = tracked_objects or []

    def __iter__(self) -> Any:
        return iter(self.tracked_objects)

    def __len__(self) -> int:
        return len(self.tracked_objects)


@dataclass
class Observation:
    pass


@dataclass
class DetectionsTracks(Observation):
    tracked_objects: TrackedObjects


class SemanticMapLayer(enum.IntEnum):
    LANE = 0
    INTERSECTION = 1
    CROSSWALK = 4
    LANE_CONNECTOR = 11
    CARPARK_AREA = 15
    ROADBLOCK = 17
    ROADBLOCK_CONNECTOR = 18


class TrafficLightStatusType(enum.IntEnum):
    GREEN = 0
    YELLOW = 1
    RED = 2
    UNKNOWN = 3


@dataclass
class TrafficLightStatusData:
    status: TrafficLightStatusType
    lane_connector_id: int
    timestamp: int


class AbstractMap(abc.ABC):
    pass


class AbstractScenario(abc.ABC):
    pass


@dataclass
class SimulationIteration:
    time_point: TimePoint
    index: int

    @property
    def time_us(self) -> int:
        return self.time_point.time_us


class SimulationHistoryBuffer:
    def __init__(
        self, ego_state_buffer: Any, observations_buffer: Any, sample_interval: float | None = None
    ) -> None:
        assert ego_state_buffer and len(ego_state_buffer) == len(observations_buffer)
        self.ego_state_buffer, self.observation_buffer = ego_state_buffer, observations_buffer
        self.sample_interval = sample_interval

    @property
    def ego_states(self) -> list[EgoState]:
        return list(self.ego_state_buffer)

    @property
    def observations(self) -> list[Observation]:
        return list(self.observation_buffer)

    @property
    def current_state(self) -> tuple[EgoState, Observation]:
        return self.ego_states[-1], self.observations[-1]


class AbstractObservation(abc.ABC):
    @abc.abstractmethod
    def reset(self) -> None: ...

    @abc.abstractmethod
    def get_observation(self) -> Observation: ...

    @abc.abstractmethod
    def initialize(self) -> None: ...

    @abc.abstractmethod
    def update_observation(
        self, iteration: SimulationIteration, next_iteration: SimulationIteration, history: SimulationHistoryBuffer
    ) -> None: ...


@dataclass(frozen=True)
class PlannerInitialization:
    route_roadblock_ids: list[str]
    mission_goal: StateSE2
    map_api: Any


@dataclass(frozen=True)
class PlannerInput:
    iteration: SimulationIteration
    history: SimulationHistoryBuffer
    traffic_light_data: list[TrafficLightStatusData] | None = None


class AbstractPlanner(abc.ABC):
    @abc.abstractmethod
    def name(self) -> str: ...

    @abc.abstractmethod
    def initialize(self, initialization: PlannerInitialization) -> None: ...

    @abc.abstractmethod
    def observation_type(self) -> type[Observation]: ...

    @abc.abstractmethod
    def compute_planner_trajectory(self, current_input: PlannerInput) -> Any: ...

    def compute_trajectory(self, current_input: PlannerInput) -> Any:
        return self.compute_planner_trajectory(current_input)


class InterpolatedTrajectory:
    """Between its states linearly; the turn rate is lost there, as in the devkit."""

    def __init__(self, trajectory: list[EgoState]) -> None:
        assert len(trajectory) > 1
        self._states = trajectory
        self.start_time, self.end_time = trajectory[0].time_point, trajectory[-1].time_point

    def get_state_at_times(self, time_points: list[TimePoint]) -> list[EgoState]:
        rows = np.array([_row(state) for state in self._states])
        rows[:, 2] = np.unwrap(rows[:, 2])
        known = [state.time_us for state in self._states]
        assert known[0] <= min(at.time_us for at in time_points) <= max(at.time_us for at in time_points) <= known[-1]
        found = []
        for at in time_points:
            x, y, heading, ahead, left = (float(np.interp(at.time_us, known, column)) for column in rows.T)
            velocity, none = StateVector2D(ahead, left), StateVector2D(0.0, 0.0)
            vehicle = self._states[0].vehicle
            found.append(EgoState.build_from_rear_axle(StateSE2(x, y, heading), velocity, none, 0.0, at, vehicle))
        return found


def _row(state: EgoState) -> list[float]:
    pose, velocity = state.rear_axle, state.dynamic_car_state.rear_axle_velocity_2d
    return [pose.x, pose.y, pose.heading, velocity.x, velocity.y]


#: Where the devkit has these classes.
_MODULES: dict[str, tuple[type, ...]] = {
    "common.actor_state.state_representation": (TimePoint, Point2D, StateSE2, StateVector2D),
    "common.actor_state.vehicle_parameters": (VehicleParameters,),
    "common.actor_state.oriented_box": (OrientedBox,),
    "common.actor_state.ego_state": (EgoState,),
    "common.actor_state.tracked_objects_types": (TrackedObjectType,),
    "common.actor_state.scene_object": (SceneObjectMetadata,),
    "common.actor_state.static_object": (StaticObject,),
    "common.actor_state.agent": (Agent,),
    "common.actor_state.tracked_objects": (TrackedObjects,),
    "common.maps.maps_datatypes": (SemanticMapLayer, TrafficLightStatusType, TrafficLightStatusData),
    "common.maps.abstract_map": (AbstractMap,),
    "planning.scenario_builder.abstract_scenario": (AbstractScenario,),
    "planning.simulation.observation.observation_type": (Observation, DetectionsTracks),
    "planning.simulation.observation.abstract_observation": (AbstractObservation,),
    "planning.simulation.history.simulation_history_buffer": (SimulationHistoryBuffer,),
    "planning.simulation.simulation_time_controller.simulation_iteration": (SimulationIteration,),
    "planning.simulation.planner.abstract_planner": (AbstractPlanner, PlannerInitialization, PlannerInput),
    "planning.simulation.trajectory.interpolated_trajectory": (InterpolatedTrajectory,),
}


def provide() -> None:
    """Makes ``nuplan`` importable: the devkit if it is installed, else the stand-ins."""
    if "nuplan" in sys.modules or importlib.util.find_spec("nuplan") is not None:
        return
    for path, classes in _MODULES.items():
        names = ["nuplan", *path.split(".")]
        for length in range(1, len(names) + 1):
            sys.modules.setdefault(".".join(names[:length]), ModuleType(".".join(names[:length])))
        for one in classes:
            setattr(sys.modules[".".join(names)], one.__name__, one)
