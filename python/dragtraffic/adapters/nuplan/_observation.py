"""The engine's road users as the traffic of a simulation of nuPlan."""

from __future__ import annotations

from nuplan.common.actor_state.tracked_objects import TrackedObjects
from nuplan.planning.scenario_builder.abstract_scenario import AbstractScenario
from nuplan.planning.simulation.history.simulation_history_buffer import SimulationHistoryBuffer
from nuplan.planning.simulation.observation.abstract_observation import AbstractObservation
from nuplan.planning.simulation.observation.observation_type import DetectionsTracks, Observation
from nuplan.planning.simulation.simulation_time_controller.simulation_iteration import SimulationIteration

from ..._run import Run
from ._boxes import RoadUsers
from ._frames import EGO, ahead, centre
from ._scene import KINDS, scene_of


class ReactingAgents(AbstractObservation):  # type: ignore[misc]
    """Vehicles, pedestrians and cyclists that react to the ego of a simulation, in place of those of the log or of
    nuPlan's IDM agents. Cones, barriers and signs are those of the log.

    ``radius_m``: of the map and the road users around the ego's start. ``seed`` and ``plan_interval_s`` are those of
    :class:`dragtraffic.Run`. Equal seeds and equal egos give equal traffic.

    nuPlan tells an observation where the ego is before an iteration, not after it: the ego's next state is taken from
    its last turn rate and acceleration, and mended an iteration later. Predictions of agents are left empty.
    """

    def __init__(
        self,
        scenario: AbstractScenario,
        *,
        radius_m: float = 150.0,
        seed: int = 0,
        plan_interval_s: float = 1.0,
    ) -> None:
        self._scenario, self._radius_m = scenario, radius_m
        self._seed, self._plan_interval_s = seed, plan_interval_s
        self._road_users: RoadUsers | None = None
        self.reset()

    def reset(self) -> None:
        """Forgets the run."""
        self._run: Run | None = None
        self._iteration, self._time_us = 0, self._scenario.get_time_point(0).time_us

    def initialize(self) -> None:
        """Begins the run at the start of the scenario."""
        scene = self.road_users.scene
        step_s = round(float(self._scenario.database_interval), 3)
        self._run = Run(scene, EGO, seed=self._seed, step_s=step_s, plan_interval_s=self._plan_interval_s)

    @property
    def road_users(self) -> RoadUsers:
        """Those of the scenario, which is read once."""
        if self._road_users is None:
            self._road_users = RoadUsers(scene_of(self._scenario, radius_m=self._radius_m))
        return self._road_users

    @property
    def run(self) -> Run:
        """The run under way.

        Raises:
            RuntimeError: before it is begun.
        """
        if self._run is None:
            raise RuntimeError("initialize the observation first")
        return self._run

    def observation_type(self) -> type[Observation]:
        """Boxes with tracks."""
        kind: type[Observation] = DetectionsTracks
        return kind

    def get_observation(self) -> DetectionsTracks:
        """Who is there."""
        agents = self.road_users.agents(self.run.present, self._time_us, without=EGO)
        # Beyond its log a scenario has no objects; those that stand stay where they are.
        last = min(self._iteration, self._scenario.get_number_of_iterations() - 1)
        known = self._scenario.get_tracked_objects_at_iteration(last).tracked_objects
        standing = [one for one in known if one.tracked_object_type not in KINDS]
        return DetectionsTracks(TrackedObjects([*agents, *standing]))

    def update_observation(
        self, iteration: SimulationIteration, next_iteration: SimulationIteration, history: SimulationHistoryBuffer
    ) -> None:
        """Steps the run to the next iteration: as often as its step fits into the time between them."""
        origin = self.road_users.origin
        known = [(ego.time_us / 1e6, centre(ego, origin)) for ego in history.ego_states[-2:]]
        step_s = self.run.step_s
        steps = max(1, round((next_iteration.time_us - iteration.time_us) / 1e6 / step_s))
        for number in range(1, steps + 1):
            self.run.step({EGO: ahead(known, number * step_s)})
        self._iteration, self._time_us = next_iteration.index, next_iteration.time_us
