"""One ego, after Gymnasium's interface."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import gymnasium
import numpy as np
from numpy.typing import NDArray

from .._run import StateLike, Step
from .._scene import AgentId
from ._driver import Actions, action_space
from ._episode import (
    Episode,
    Observations,
    Scenes,
    SceneSource,
    default_reward,
    goal_of,
    movers,
    seen_space,
)
from ._observe import Seen

#: Most scenes that a reset looks at for one with an ego.
_TRIES = 20


class Drive(gymnasium.Env[Any, NDArray[Any]]):
    """You drive one road user to its goal; all others react.

    ``scene``: a scene, a file, a folder, several of these, or a function from a random generator to a scene; one is drawn
    at each reset. ``fill``: arguments of :meth:`dragtraffic.Scene.place`, which then places road users anew at each reset.
    ``ego``: the road user; without it one of the vehicles that move is drawn. Its goal is that of its conditions, else
    where its recording ends, else where its likeliest future does. ``observation``: ``"parts"`` (arrays by name) or
    ``"gpudrive"`` (one row in the order of GPUDrive). ``actions``: ``"acceleration"`` (shares of acceleration and curvature
    in [-1, 1]) or ``"state"``. ``reward``: a function of ``info``, which has ``progress_m``, ``aside_m``, ``distance_m``,
    ``reached``, ``faults``, ``acceleration_mps2``, ``sideways_mps2`` and ``jerk_mps3``. An episode ends at the goal and at
    a fault of the ego, and is truncated after ``horizon_s``.
    """

    metadata: dict[str, Any] = {"render_modes": []}

    def __init__(
        self,
        scene: SceneSource,
        *,
        ego: str | int | None = None,
        fill: Mapping[str, Any] | None = None,
        observation: Observations = "parts",
        actions: Actions = "acceleration",
        reward: Callable[[Mapping[str, Any]], float] = default_reward,
        step_s: float = 0.1,
        horizon_s: float = 20.0,
    ) -> None:
        self._scenes = Scenes(scene, fill)
        self._ego = None if ego is None else str(ego)
        self._kind, self._reward, self._view = actions, reward, observation
        self._step_s, self._horizon_s = step_s, horizon_s
        self.observation_space = seen_space(observation)
        self.action_space = action_space(actions)
        self._episode: Episode | None = None
        self._id = ""

    @property
    def episode(self) -> Episode:
        """The episode under way, with its ``run``.

        Raises:
            RuntimeError: before the first reset.
        """
        if self._episode is None:
            raise RuntimeError("reset the environment first")
        return self._episode

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Seen, dict[str, Any]]:
        """Draws a scene and an ego. Equal seeds give equal episodes. ``info`` has ``ego``, ``distance_m`` to its goal, and
        ``seed``, that of the episode's run."""
        super().reset(seed=seed)
        for _ in range(_TRIES):
            scene = self._scenes.draw(self.np_random)
            all = [self._ego] if self._ego is not None else movers(scene)
            at, number = int(self.np_random.integers(2**31)), int(self.np_random.integers(2**31))
            self._id = all[at % len(all)] if all else ""
            goal = goal_of(scene, self._id, number) if all else None
            if goal is not None:
                break
        else:
            who = "vehicle that moves" if self._ego is None else f"goal of road user {self._ego}"
            raise ValueError(f"no {who} in {_TRIES} scenes")
        self._episode = Episode(scene, {self._id: goal}, number, self._step_s, self._horizon_s, self._view)
        driver = self._episode.drivers[self._id]
        info = {"ego": self._id, "distance_m": driver.distance_m(), "seed": number}
        return self._episode.observation(self._id), info

    def step(
        self, action: NDArray[Any]
    ) -> tuple[Seen, float, bool, bool, dict[str, Any]]:
        """Drives one step."""
        return self.came(self.episode.run.step(self.moved(action)))

    def moved(self, action: NDArray[Any]) -> dict[AgentId, StateLike]:
        """The ego at the end of the next step."""
        return self.episode.moved({self._id: np.asarray(action)}, self._kind)

    def came(self, step: Step) -> tuple[Seen, float, bool, bool, dict[str, Any]]:
        """What came of the step that the ego moved for."""
        episode = self.episode
        info = episode.told(step)[self._id]
        over = episode.drivers[self._id].over
        observation = episode.observation(self._id)
        return observation, self._reward(info), over, episode.late and not over, info
