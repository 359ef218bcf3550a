"""One episode: a scene, a run in it, and where the egos should get to."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, Literal, Union

import gymnasium
import numpy as np
from numpy.typing import NDArray

from .._errors import DragTrafficError
from .._goals import asked_goal, recorded_state, recorded_steps
from .._run import Run, State, StateLike, Step
from .._scene import AgentId, Scene, open
from ._driver import Actions, Driver, drive
from ._gpudrive import GpudriveView, gpudrive_space
from ._observe import Seen, View, observation_space
from ._route import Lanes

#: A scene, a file, a folder of files, several of them, or a function that makes one from a generator of numbers.
SceneSource = Union[
    Scene, str, "os.PathLike[str]", Sequence[Union[Scene, str]], Callable[[np.random.Generator], Scene]
]
Observations = Literal["parts", "gpudrive"]

#: An ego is at its goal within this distance, metres.
AT_GOAL_M = 2.0
#: Shortest way to a goal, metres, and least speed of a road user that moves, m/s.
MOVES_M, MOVES_MPS = 15.0, 1.0


def default_reward(info: Mapping[str, Any]) -> float:
    """Metres of progress along the way to the goal, 10 for reaching it, -10 for each fault, -0.01 for each m/s3 of jerk."""
    comfort = 0.01 * abs(info["jerk_mps3"])
    return float(info["progress_m"] + 10.0 * info["reached"] - 10.0 * len(info["faults"]) - comfort)


class Scenes:
    """Scenes of a source, one for each episode."""

    def __init__(self, source: SceneSource, fill: Mapping[str, Any] | None) -> None:
        self._fill = fill
        self._make: Callable[[np.random.Generator], Scene] | None = None
        self._all: list[Scene | Path] = []
        if callable(source):
            self._make = source
            return
        several = [source] if isinstance(source, (Scene, str, os.PathLike)) else list(source)
        for each in several:
            if isinstance(each, Scene):
                self._all.append(each)
            elif Path(each).is_dir():
                self._all.extend(sorted(file for file in Path(each).iterdir() if file.is_file()))
            else:
                self._all.append(Path(each))
        if not self._all:
            raise ValueError(f"no scenes in {source}")

    def draw(self, random: np.random.Generator) -> Scene:
        """The scene of an episode. With ``fill``, its road users are placed anew."""
        scene = self._make(random) if self._make is not None else self._opened(int(random.integers(len(self._all))))
        if self._fill is None:
            return scene
        return scene.place(**{"keep": [], "seed": int(random.integers(2**31)), **self._fill})

    def _opened(self, at: int) -> Scene:
        """A scene by its number; a file that is no scene stands for the next one."""
        refused: DragTrafficError | None = None
        for index in [*range(at, len(self._all)), *range(at)]:
            found = self._all[index]
            try:
                scene = self._all[index] = found if isinstance(found, Scene) else open(found)
                return scene
            except DragTrafficError as error:
                refused = error
        raise ValueError(f"no file is a scene: {refused}")


def movers(scene: Scene, types: Sequence[str] = ("vehicle",)) -> list[str]:
    """Road users of these types that are there at the start and move, or will."""
    found = []
    for agent in scene._peek()["agents"]:
        steps = recorded_steps(agent)
        if agent["type"] not in types or not steps or steps[0] > 0:
            continue
        if recorded_state(agent, 0).speed_mps >= MOVES_MPS or _way_m(agent, asked_goal(agent)) >= MOVES_M:
            found.append(str(agent["id"]))
    return found


def goal_of(scene: Scene, id: str, seed: int) -> State | None:
    """The goal of a road user: that of its conditions, else where its recording ends, else where its likeliest future
    does, on the lanes. None where it goes nowhere."""
    agent = next(agent for agent in scene._peek()["agents"] if agent["id"] == id)
    if not recorded_steps(agent):
        return None
    goal = asked_goal(agent)
    if _way_m(agent, goal) < MOVES_M:
        futures = scene.generate([id], seed=seed).samples[0]["agents"][id]
        future = np.array([futures["modes"][futures["chosen"]][name] for name in State._fields], dtype=float).T
        # A future may go on beyond the roads of the map.
        last = Lanes(scene._peek()["map"].get("lanes", [])).last_near(future[:, :2])
        goal = State(*future[last].tolist()) if last >= 0 else goal
    return goal if _way_m(agent, goal) >= MOVES_M else None


def _way_m(agent: Mapping[str, Any], goal: State) -> float:
    start = recorded_state(agent, recorded_steps(agent)[0])
    return float(np.hypot(goal.x_m - start.x_m, goal.y_m - start.y_m))


class Episode:
    """Egos among traffic that reacts."""

    def __init__(
        self,
        scene: Scene,
        goals: Mapping[str, State],
        seed: int,
        step_s: float,
        horizon_s: float,
        observation: Observations,
    ) -> None:
        egos = list(goals)
        self.run = Run(scene, egos, seed=seed, step_s=step_s)
        self.view = GpudriveView(scene) if observation == "gpudrive" else View(scene)
        self.horizon_s = horizon_s
        self._before: dict[str, tuple[float, float]] = {}
        self.drivers = {id: self._driver(id, goal) for id, goal in goals.items()}

    def _driver(self, id: str, goal: State) -> Driver:
        start = self.run.present[id]
        return Driver(id, goal, start, self.view.route(id, start, goal))

    def step(self, actions: Mapping[str, NDArray[Any]], kind: Actions) -> dict[str, dict[str, Any]]:
        """Makes a step, and says of each ego that drove what came of it."""
        return self.told(self.run.step(self.moved(actions, kind)))

    def moved(self, actions: Mapping[str, NDArray[Any]], kind: Actions) -> dict[AgentId, StateLike]:
        """Where the egos are at the end of the next step. An ego that is done stands where it is."""
        dt = self.run.step_s
        self._before = {id: (driver.left_m(), driver.action[0]) for id, driver in self.drivers.items()}
        for id, driver in self.drivers.items():
            if driver.over:
                driver.state = driver.state._replace(vx_mps=0.0, vy_mps=0.0)
            else:
                drive(driver, actions[id], kind, dt)
        return {id: driver.state for id, driver in self.drivers.items()}

    def told(self, step: Step) -> dict[str, dict[str, Any]]:
        """What came of the step that the egos moved for, of each ego that drove."""
        driving = [(id, driver) for id, driver in self.drivers.items() if not driver.over]
        return {id: self._came(driver, step, *self._before[id]) for id, driver in driving}

    def _came(self, driver: Driver, step: Step, left_m: float, acceleration: float) -> dict[str, Any]:
        faults = [fault["fault"] for fault in step.faults if driver.id in _involved(fault)]
        driver.collided = any(fault["kind"] == "collision" for fault in faults)
        driver.reached = driver.distance_m() <= AT_GOAL_M
        driver.over = driver.reached or bool(faults)
        rate, curvature = driver.action
        return {
            "progress_m": left_m - driver.left_m(),
            "aside_m": driver.route.aside_m,
            "distance_m": driver.distance_m(),
            "reached": driver.reached,
            "faults": faults,
            "acceleration_mps2": rate,
            "sideways_mps2": curvature * driver.state.speed_mps**2,
            "jerk_mps3": (rate - acceleration) / self.run.step_s,
            "changes": step.changes,
            "time_s": step.time_s,
        }

    @property
    def late(self) -> bool:
        """The horizon is reached."""
        return self.run.present.number * self.run.step_s >= self.horizon_s - 1e-9

    def observation(self, id: str) -> Seen:
        """What an ego sees."""
        present = self.run.present
        return self.view.observation(self.drivers[id], present, self.horizon_s - present.number * self.run.step_s)


def _involved(fault: Mapping[str, Any]) -> set[str]:
    """Road users that a fault is about: whose it is, and whom it meets."""
    return {str(fault["agent"]), *(str(id) for id in [fault["fault"].get("with")] if id is not None)}


def seen_space(observation: Observations) -> gymnasium.spaces.Dict | gymnasium.spaces.Box:
    """The space of observations.

    Raises:
        ValueError: the observation is neither of the two.
    """
    if observation == "parts":
        return observation_space()
    if observation == "gpudrive":
        return gpudrive_space()
    raise ValueError(f"observation {observation!r}: parts or gpudrive expected")
