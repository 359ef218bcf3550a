"""Several environments of one ego whose steps share the threads of the engine, after Gymnasium's vector interface."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode
from gymnasium.vector.utils import batch_space, concatenate, create_empty_array, iterate
from numpy.typing import NDArray

from .._run import Run
from ._drive import Drive
from ._episode import SceneSource
from ._observe import Seen

Flags = NDArray[np.bool_]


class VectorDrive(gymnasium.vector.VectorEnv[Any, Any, Any]):
    """``num_envs`` times :class:`dragtraffic.envs.Drive`, with its arguments. All runs make their step in one call of the
    engine, on several threads and outside of Python's lock. What comes of it is that of ``SyncVectorEnv``, to the last
    bit, whatever the threads.

    ``autoreset_mode``: an episode that ends begins anew in the next step (``NEXT_STEP``), or in the same one
    (``SAME_STEP``; its last observation and ``info`` are then ``final_obs`` and ``final_info``).
    """

    def __init__(
        self,
        scene: SceneSource,
        *,
        num_envs: int = 1,
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
        **settings: Any,
    ) -> None:
        self._mode = AutoresetMode(autoreset_mode)
        if self._mode == AutoresetMode.DISABLED:
            raise ValueError("autoreset_mode: next or same step expected")
        if num_envs < 1:
            raise ValueError(f"num_envs: one at least expected, found {num_envs}")
        self.num_envs = num_envs
        self.envs = [Drive(scene, **settings) for _ in range(num_envs)]
        self.metadata = {**Drive.metadata, "autoreset_mode": self._mode}
        self.single_observation_space = self.envs[0].observation_space
        self.single_action_space = self.envs[0].action_space
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._over: Flags = np.zeros(num_envs, dtype=np.bool_)

    def reset(
        self, *, seed: int | Sequence[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Seen, dict[str, Any]]:
        """Resets all. ``seed``: of the first one, the next ones follow; or one for each."""
        if seed is None or isinstance(seed, (int, np.integer)):
            seeds = [None if seed is None else int(seed) + number for number in range(self.num_envs)]
        else:
            seeds = list(seed)
        if len(seeds) != self.num_envs:
            raise ValueError(f"{self.num_envs} seeds expected, found {len(seeds)}")
        told = [env.reset(seed=own, options=options) for env, own in zip(self.envs, seeds)]
        self._over[:] = False
        infos: dict[str, Any] = {}
        for number, (_, info) in enumerate(told):
            infos = self._add_info(infos, info, number)
        return self._together([seen for seen, _ in told]), infos

    def step(self, actions: Any) -> tuple[Seen, NDArray[np.float64], Flags, Flags, dict[str, Any]]:
        """Drives one step of each."""
        going = np.flatnonzero(~self._over).tolist()
        each = list(iterate(self.action_space, actions))
        moved = [self.envs[number].moved(each[number]) for number in going]
        steps = Run.step_together([self.envs[number].episode.run for number in going], moved)
        made = dict(zip(going, steps))
        rewards, infos = np.zeros(self.num_envs), dict[str, Any]()
        overs, lates = np.zeros((2, self.num_envs), dtype=np.bool_)
        seen: list[Seen] = []
        for number, env in enumerate(self.envs):
            if number in made:
                found, rewards[number], overs[number], lates[number], info = env.came(made[number])
            else:
                found, info = env.reset()
            if self._mode == AutoresetMode.SAME_STEP and (overs[number] or lates[number]):
                infos = self._add_info(infos, {"final_obs": found, "final_info": info}, number)
                found, info = env.reset()
            seen.append(found)
            infos = self._add_info(infos, info, number)
        if self._mode == AutoresetMode.NEXT_STEP:
            self._over = overs | lates
        return self._together(seen), rewards, overs, lates, infos

    def _together(self, seen: list[Seen]) -> Seen:
        space = self.single_observation_space
        rows: Any = create_empty_array(space, self.num_envs)
        return concatenate(space, seen, rows)
