"""Steps a second of ``dragtraffic/Drive-v0``: environments one after the other, and as one vector environment.

    pip install '.[gym]' && python python/examples/vector.py assets/scenes/demo-crossing.json

Both have the same scene with placed vehicles, the same egos and seeds, and drive on at their speeds. A step is one of all
environments; episodes that end begin anew, which counts too.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Sequence

import dragtraffic.envs  # noqa: F401
import gymnasium
import numpy as np

ID = "dragtraffic/Drive-v0"


def rate(mode: str, count: int, scene: str, vehicles: int, steps: int) -> float:
    """Steps of single environments a second, over so many steps of all."""
    fill = {"count": vehicles, "types": {"vehicle": 1.0}}
    vectorization = {"loop": "sync", "together": "vector_entry_point"}[mode]
    envs = gymnasium.make_vec(ID, num_envs=count, vectorization_mode=vectorization, scene=scene, fill=fill)
    envs.reset(seed=1)
    still = np.zeros(envs.action_space.shape or (), dtype=np.float32)
    begun = time.perf_counter()
    for _ in range(steps):
        envs.step(still)
    passed = time.perf_counter() - begun
    envs.close()
    return count * steps / passed


def main(arguments: Sequence[str] | None = None) -> None:
    """Measures and prints a table."""
    parser = argparse.ArgumentParser(description="Steps a second of environments.")
    parser.add_argument("scene")
    parser.add_argument("--envs", type=int, nargs="+", default=[1, 4, 16])
    parser.add_argument("--vehicles", type=int, default=8)
    parser.add_argument("--steps", type=int, default=50, help="of all environments together")
    asked = parser.parse_args(arguments)
    print("| environments | one after the other | together |")
    print("|---|---|---|")
    for count in asked.envs:
        rates = (rate(mode, count, asked.scene, asked.vehicles, asked.steps) for mode in ("loop", "together"))
        print(f"| {count} | {' | '.join(f'{one:.0f}' for one in rates)} |", flush=True)


if __name__ == "__main__":
    main()
