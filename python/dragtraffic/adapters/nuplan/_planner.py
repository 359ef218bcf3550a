"""A planner of nuPlan in a run."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from typing import Any

from nuplan.common.actor_state.state_representation import StateSE2, TimePoint
from nuplan.common.actor_state.tracked_objects import TrackedObjects
from nuplan.common.actor_state.vehicle_parameters import VehicleParameters
from nuplan.common.maps.abstract_map import AbstractMap
from nuplan.common.maps.maps_datatypes import TrafficLightStatusData, TrafficLightStatusType
from nuplan.planning.simulation.history.simulation_history_buffer import SimulationHistoryBuffer
from nuplan.planning.simulation.observation.observation_type import DetectionsTracks
from nuplan.planning.simulation.planner.abstract_planner import (
    AbstractPlanner,
    PlannerInitialization,
    PlannerInput,
)
from nuplan.planning.simulation.simulation_time_controller.simulation_iteration import SimulationIteration

from ..._goals import asked_goal
from ..._run import State, Step
from ..._scene import Scene
from ._boxes import RoadUsers
from ._frames import centre, ego_state, pose, vehicle_of

#: Length of a step of a drive, microseconds, and most states that an ego announces.
_STEP_US, _MOST_ANNOUNCED = 100_000, 90
#: States that a planner is told of the past, the present one too: two seconds.
_HISTORY = 21
_LIGHTS = {
    "go": TrafficLightStatusType.GREEN,
    "arrow_go": TrafficLightStatusType.GREEN,
    "caution": TrafficLightStatusType.YELLOW,
    "arrow_caution": TrafficLightStatusType.YELLOW,
    "flashing_caution": TrafficLightStatusType.YELLOW,
    "stop": TrafficLightStatusType.RED,
    "arrow_stop": TrafficLightStatusType.RED,
    "flashing_stop": TrafficLightStatusType.RED,
}


class NuplanDriver:
    """A planner of nuPlan as :func:`dragtraffic.drive` takes one: ``drive(scene, NuplanDriver(MyPlanner), "ego")``.

    ``make`` gives a planner for each ego. The ego is where its planner's trajectory is a step later, without a
    controller in between, and announces the trajectory. ``map_api`` and ``route_roadblock_ids`` are passed on to the
    planner: those of the scenario for a scene of :func:`scene_of`, and none for one that asks no map. ``mission_goal``
    in nuPlan's map is by default the goal of the ego's conditions, else where its recording ends. ``vehicle`` has by
    default the ego's box and the proportions of a car. ``start_us`` is the time of the scene's step 0.

    The history has the steps of the drive, two seconds at most; before the first one it is the present alone.
    """

    def __init__(
        self,
        make: Callable[[], AbstractPlanner],
        *,
        map_api: AbstractMap | None = None,
        route_roadblock_ids: Sequence[str] = (),
        mission_goal: StateSE2 | None = None,
        vehicle: VehicleParameters | None = None,
        start_us: int = 0,
    ) -> None:
        self._make, self._map_api, self._route = make, map_api, list(route_roadblock_ids)
        self._goal, self._vehicle, self._start_us = mission_goal, vehicle, start_us

    def __call__(self, scene: Scene, ego: str) -> Callable[[Step], tuple[State, list[State]]]:
        """The planner of an ego, initialized."""
        road_users = RoadUsers(scene)
        agent = next(agent for agent in scene._peek()["agents"] if str(agent["id"]) == ego)
        planner = self._make()
        goal = self._goal or pose(asked_goal(agent), road_users.origin)
        planner.initialize(
            PlannerInitialization(route_roadblock_ids=self._route, mission_goal=goal, map_api=self._map_api)
        )
        return _Driven(planner, ego, road_users, self._vehicle or vehicle_of(agent), self._start_us)


class _Driven:
    """A planner at work for one ego."""

    def __init__(
        self, planner: AbstractPlanner, ego: str, road_users: RoadUsers, vehicle: VehicleParameters, start_us: int
    ) -> None:
        self._planner, self._ego, self._road_users = planner, ego, road_users
        self._vehicle, self._start_us = vehicle, start_us
        self._signals = road_users.scene._peek().get("signals", [])
        self._egos: deque[Any] = deque(maxlen=_HISTORY)
        self._seen: deque[Any] = deque(maxlen=_HISTORY)

    def __call__(self, step: Step) -> tuple[State, list[State]]:
        """The ego's state 0.1 s later, and where its trajectory goes from there."""
        origin, now_us = self._road_users.origin, self._start_us + round(step.time_s * 1e6)
        if not self._egos:
            self._egos.append(ego_state(step[self._ego], TimePoint(now_us), self._vehicle, origin))
        others = self._road_users.agents(step, now_us, without=self._ego)
        self._seen.append(DetectionsTracks(TrackedObjects(others)))
        asked = PlannerInput(
            iteration=SimulationIteration(TimePoint(now_us), step.number),
            history=SimulationHistoryBuffer(self._egos, self._seen, _STEP_US / 1e6),
            traffic_light_data=self._lights(step.time_s, now_us),
        )
        trajectory = self._planner.compute_trajectory(asked)
        last = min((trajectory.end_time.time_us - now_us) // _STEP_US, _MOST_ANNOUNCED + 1)
        if last < 1:
            raise ValueError(f"a trajectory of 0.1 s at least expected from {self._planner.name()}")
        times = [TimePoint(now_us + number * _STEP_US) for number in range(1, last + 1)]
        states = trajectory.get_state_at_times(times)
        # What the planner is told of its ego next is what it said itself, accelerations and steering too.
        self._egos.append(states[0])
        first, *rest = (centre(state, origin) for state in states)
        return first, rest

    def _lights(self, time_s: float, now_us: int) -> list[TrafficLightStatusData]:
        """Lights of the lane connectors whose numbers the scene knows."""
        now = time_s / 0.1 + 1e-6
        told = []
        for signal in self._signals:
            number = str(signal["lane"]).removeprefix("c")
            state = [word for first, word in signal["states"] if first <= now][-1:]
            if state and number.isdecimal():
                status = _LIGHTS.get(state[0], TrafficLightStatusType.UNKNOWN)
                told.append(TrafficLightStatusData(status, int(number), now_us))
        return told
