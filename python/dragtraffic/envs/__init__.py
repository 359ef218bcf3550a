"""Environments for learners: traffic reacts, and you drive one road user or several.

Importing this module registers ``dragtraffic/Drive-v0`` with Gymnasium; :func:`parallel_env` needs PettingZoo:

    >>> import gymnasium
    >>> import dragtraffic.envs
    >>> env = gymnasium.make("dragtraffic/Drive-v0", scene="assets/scenes/demo-crossing.json", ego="4")
    >>> observation, info = env.reset(seed=7)
    >>> observation["others"].shape
    (16, 8)
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import gymnasium

from ._drive import Drive
from ._episode import SceneSource, default_reward
from ._vector import VectorDrive

if TYPE_CHECKING:
    from ._parallel import ParallelDrive

__all__ = ["Drive", "SceneSource", "VectorDrive", "default_reward", "parallel_env"]

gymnasium.register(
    "dragtraffic/Drive-v0",
    entry_point="dragtraffic.envs:Drive",
    vector_entry_point="dragtraffic.envs:VectorDrive",
)


def parallel_env(*args: Any, **kwargs: Any) -> ParallelDrive:
    """An environment of PettingZoo's parallel kind: see :class:`dragtraffic.envs._parallel.ParallelDrive`."""
    from ._parallel import ParallelDrive

    return ParallelDrive(*args, **kwargs)
