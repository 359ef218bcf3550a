"""Several egos, after PettingZoo's parallel interface."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import gymnasium
import numpy as np
from numpy.typing import NDArray
from pettingzoo import ParallelEnv

from ._driver import Actions, action_space
from ._episode import (
    Episode,
    Observations,
    Scenes,
    SceneSource,
    default_reward,
    goal_of,
    seen_space,
)
from ._observe import Seen


class ParallelDrive(ParallelEnv[str, Any, NDArray[Any]]):
    """You drive several road users to their goals; all others react. The arguments are those of
    :class:`dragtraffic.envs.Drive`, with the ids of the ``egos``. An ego that is done stands where it is."""

    metadata: dict[str, Any] = {"name": "dragtraffic_drive_v0", "render_modes": []}

    def __init__(
        self,
        scene: SceneSource,
        egos: Sequence[str | int],
        *,
        fill: Mapping[str, Any] | None = None,
        observation: Observations = "parts",
        actions: Actions = "acceleration",
        reward: Callable[[Mapping[str, Any]], float] = default_reward,
        step_s: float = 0.1,
        horizon_s: float = 20.0,
    ) -> None:
        self._scenes = Scenes(scene, fill)
        self.possible_agents = [str(ego) for ego in egos]
        self.agents: list[str] = []
        self._kind, self._reward, self._view = actions, reward, observation
        self._step_s, self._horizon_s = step_s, horizon_s
        self._seen, self._done = seen_space(observation), action_space(actions)
        self._random = np.random.default_rng()
        self._episode: Episode | None = None

    def observation_space(self, agent: str) -> gymnasium.spaces.Space[Any]:
        """The same for each."""
        return self._seen

    def action_space(self, agent: str) -> gymnasium.spaces.Box:
        """The same for each."""
        return self._done

    def reset(
        self, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, Seen], dict[str, dict[str, Any]]]:
        """Draws a scene. Equal seeds give equal episodes."""
        if seed is not None:
            self._random = np.random.default_rng(seed)
        scene = self._scenes.draw(self._random)
        number = int(self._random.integers(2**31))
        goals = {id: goal_of(scene, id, number) for id in self.possible_agents}
        known = {id: goal for id, goal in goals.items() if goal is not None}
        if len(known) < len(goals):
            raise ValueError(f"no goal of {', '.join(goals.keys() - known.keys())}")
        self._episode = Episode(scene, known, number, self._step_s, self._horizon_s, self._view)
        self.agents = list(self.possible_agents)
        return self._observations(self._episode), {id: {} for id in self.agents}

    def step(self, actions: dict[str, NDArray[Any]]) -> tuple[
        dict[str, Seen],
        dict[str, float],
        dict[str, bool],
        dict[str, bool],
        dict[str, dict[str, Any]],
    ]:
        """Drives one step."""
        if self._episode is None:
            raise RuntimeError("reset the environment first")
        infos = self._episode.step(actions, self._kind)
        rewards = {id: self._reward(info) for id, info in infos.items()}
        over = {id: self._episode.drivers[id].over for id in infos}
        late = {id: self._episode.late and not over[id] for id in infos}
        observations = self._observations(self._episode)
        self.agents = [id for id in self.agents if not over[id] and not late[id]]
        return observations, rewards, over, late, infos

    def _observations(self, episode: Episode) -> dict[str, Seen]:
        return {id: episode.observation(id) for id in self.agents}
