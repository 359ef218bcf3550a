# /// script
# requires-python = ">=3.10"
# dependencies = ["dragtraffic", "libsumo==1.28.0"]
# ///
"""The time of a step of 0.1 s: the engine's beside one of SUMO, with its car-following model IDM.

    pip install . libsumo && python python/examples/steps.py assets/scenes/demo-arterial.json

Both have the same map and the same placed vehicles, and go through the same 20 s in this process. In the engine one
vehicle is an ego that goes on at its speed along its future; the others plan anew each second and react in each step.
SUMO has the routes of the same futures, four times 5 s. It moves vehicles along lanes by the gap ahead; it plans nothing.
"""

from __future__ import annotations

import argparse
import re
import tempfile
import time
import zipfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import dragtraffic
import numpy as np
from dragtraffic import Run, Scene, State

#: Steps of 0.1 s, and those after which SUMO begins again: its vehicles leave at the ends of their routes.
STEPS, ROUND = 200, 50


def timed(work: Callable[[], Any]) -> float:
    """Milliseconds that it takes."""
    begun = time.perf_counter()
    work()
    return 1e3 * (time.perf_counter() - begun)


def engine_steps(scene: Scene) -> tuple[list[float], float]:
    """Milliseconds of each step of a run, and how many others there are on average."""
    futures = scene.samples[0]["agents"]

    def path(id: str) -> dict[str, Any]:
        future: dict[str, Any] = futures[id]["modes"][futures[id]["chosen"]]
        return future

    def way(id: str) -> float:
        x, y = path(id)["x_m"], path(id)["y_m"]
        return float(np.hypot(x[-1] - x[0], y[-1] - y[0]))

    ego = max(futures, key=way)
    states = [State(*row) for row in zip(*(path(ego)[name] for name in State._fields))]
    run, times, there = Run(scene, ego, seed=1), [], []
    for number in range(STEPS):
        state = states[min(number, len(states) - 1)]
        times.append(timed(lambda: run.step({ego: state})))
        there.append(len(run.present.ids) - 1)
    return times, float(np.mean(there))


def sumo_steps(scene: Scene, folder: Path) -> tuple[list[float], float]:
    """Milliseconds of each step of SUMO with IDM, and how many vehicles there are on average."""
    import libsumo

    packed = folder / "scene.zip"
    scene.save(packed, "sumo")
    with zipfile.ZipFile(packed) as archive:
        archive.extractall(folder)
    (routes,) = folder.glob("*.rou.xml")
    routes.write_text(re.sub(r"<vType ", '<vType carFollowModel="IDM" ', routes.read_text()))
    (configuration,) = folder.glob("*.sumocfg")
    arguments = ["-c", str(configuration), "--end", "60", "--no-warnings", "--no-step-log"]
    libsumo.start(["sumo", *arguments])
    times, there = [], []
    for number in range(STEPS):
        if number and number % ROUND == 0:
            libsumo.load(arguments)
        times.append(timed(libsumo.simulationStep))
        there.append(libsumo.vehicle.getIDCount())
    libsumo.close()
    return times, float(np.mean(there))


def main(arguments: Sequence[str] | None = None) -> None:
    """Measures and prints a table."""
    parser = argparse.ArgumentParser(description="Times of steps, the engine's beside SUMO's.")
    parser.add_argument("scene", type=Path)
    parser.add_argument("--others", type=int, nargs="+", default=[8, 32, 128])
    asked = parser.parse_args(arguments)
    scene = dragtraffic.open(asked.scene)
    print("| vehicles | engine, others there | p50 | p95 ms | SUMO, vehicles there | p50 | p95 ms |")
    print("|---|---|---|---|---|---|---|")
    for others in asked.others:
        filled = scene.place(count=others + 1, keep=[], seed=1, types={"vehicle": 1.0})
        driven = filled.generate(filled.agents[:128], horizon_s=20.0, seed=1)
        cells = [str(len(filled.agents))]
        with tempfile.TemporaryDirectory() as folder:
            for times, there in (engine_steps(driven), sumo_steps(driven, Path(folder))):
                p50, p95 = np.percentile(times, [50, 95])
                cells += [f"{there:.0f}", f"{p50:.3f}", f"{p95:.3f}"]
        print(f"| {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
