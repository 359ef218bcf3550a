"""How many road users reach their goals and do nothing wrong, if the engine drives all of them.

    python python/examples/goals.py --runs 200 FOLDER

Each run takes a recorded scene and prescribes nobody: all are driven by the engine for 20 s from the first recorded
state on. The goal of each is where its recording ends, due when it ends. A road user counts if its goal is more than
2 m away from where it comes in. It succeeds if it comes within 2 m of its goal and has no fault of its own: no
collision in which it drove into the other, and as a vehicle no corner off the road (faults of the steps, docs/runs.md).
Stop lines crossed at red and driving against the lanes are told beside this: they are of the score of the whole run, by
the rules of every scene (docs/metrics.md).
"""

from __future__ import annotations

import argparse
import json
from collections import Counter
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass
from pathlib import Path

import dragtraffic
import numpy as np
from dragtraffic import Run, Scene, film

#: Metres within which a goal is reached, and length of a run in seconds.
AT_GOAL_M, RUN_S = 2.0, 20.0
#: Rules of vehicles that the score of a run judges, as it names them.
RULES = ("red_lights", "wrong_way")


@dataclass
class Outcome:
    """What became of a road user in a run. ``lost`` is empty if it succeeded; ``nearest_m`` is its least distance to
    the goal; ``rules`` are the rules of the road that it broke, of the score of the run."""

    scene: str
    seed: int
    id: str
    type: str
    way_m: float
    nearest_m: float
    lost: str
    rules: list[str]


def with_goals(scene: Scene) -> tuple[Scene, dict[str, tuple[float, float]]]:
    """The scene with the end of each recording as a goal, and these places by id."""
    document, goals = scene.document, {}
    agents = []
    for agent in document["agents"]:
        track = agent["track"]
        first = int(track["first_step"])
        last = (track.get("valid") or [[first, first + len(track["x_m"])]])[-1][1] - 1
        x, y = (float(track[name][last - first]) for name in ("x_m", "y_m"))
        goals[str(agent["id"])] = (x, y)
        goal = {"x_m": x, "y_m": y, "time_s": max(0.5, round(0.1 * last, 1))}
        agents.append({**agent, "conditions": {"goal": goal}} if last > 0 else agent)
    return Scene({**document, "agents": agents}), goals


def drive(path: Path, seed: int) -> list[Outcome]:
    """A run of a scene; what became of those who had a way to go."""
    scene, goals = with_goals(dragtraffic.open(path))
    kinds = {str(agent["id"]): str(agent["type"]) for agent in scene.document["agents"]}
    run = Run(scene, seed=seed)
    step = run.present
    steps = [step]
    ways: dict[str, float] = {}
    nearest: dict[str, float] = {}
    faults: dict[str, str] = {}
    gone: dict[str, str] = {}
    while True:
        away = np.hypot(*(step.states[:, :2] - np.array([goals[id] for id in step.ids]).reshape(-1, 2)).T)
        for id, distance in zip(step.ids, away.tolist()):
            ways.setdefault(id, distance)
            nearest[id] = min(distance, nearest.get(id, distance))
        for fault in step.faults:
            faults.setdefault(str(fault["agent"]), str(fault["fault"]["kind"]))
        gone.update({str(one["agent"]): str(one["reason"]) for one in step.left})
        if step.time_s >= RUN_S - 1e-9:
            break
        step = run.step()
        steps.append(step)
    score = film(scene, steps).score()["scene"]

    def rules(id: str) -> list[str]:
        broken = [name for name in RULES if any(str(one["agent"]) == id for one in score[name])]
        return broken if kinds[id] == "vehicle" else []

    def lost(id: str) -> str:
        if id in faults:
            return faults[id]
        # Who is at its goal when it is due leaves in that step.
        if nearest[id] <= AT_GOAL_M or gone.get(id) == "arrived":
            return ""
        return "left the map" if gone.get(id) == "left_the_map" else "goal missed"

    return [
        Outcome(path.name, seed, id, kinds[id], way, nearest[id], lost(id), rules(id))
        for id, way in ways.items()
        if way > AT_GOAL_M and kinds[id] != "other"
    ]


def share(outcomes: Sequence[Outcome]) -> tuple[float, float, float]:
    """Share of success, and its 95 % interval from drawing scenes anew a thousand times."""
    names = sorted({one.scene for one in outcomes})
    counts = np.array(
        [[sum(one.scene == name and good in (None, not one.lost) for one in outcomes) for good in (True, None)] for name in names]
    )
    drawn = counts[np.random.default_rng(0).integers(len(names), size=(1000, len(names)))].sum(axis=1)
    low, high = np.quantile(drawn[:, 0] / drawn[:, 1], [0.025, 0.975])
    return float(counts[:, 0].sum() / counts[:, 1].sum()), float(low), float(high)


def report(outcomes: Sequence[Outcome]) -> Iterator[str]:
    """Lines: the share of success, and where the rest is lost, of all and of each type."""
    said, low, high = share(outcomes)
    runs = Counter((one.scene, one.seed) for one in outcomes)
    good = Counter((one.scene, one.seed) for one in outcomes if not one.lost)
    mean = np.mean([good[run] / count for run, count in runs.items()])
    yield f"{len(outcomes)} road users with a way to go in {len(runs)} runs"
    yield f"goal without fault: {said:.1%} ({low:.1%} to {high:.1%}), mean of runs {mean:.1%}"
    kinds = {"all": list(outcomes)}
    kinds |= {kind: [one for one in outcomes if one.type == kind] for kind in sorted({one.type for one in outcomes})}
    for kind, ones in kinds.items():
        lost = Counter(one.lost for one in ones)
        told = ", ".join(f"{name or 'success'} {count / len(ones):.1%}" for name, count in lost.most_common())
        yield f"{kind:10} {len(ones):6}: {told}"
    driven = kinds.get("vehicle", [])
    for name in RULES:
        broke = sum(name in one.rules for one in driven)
        yield f"vehicles, {name.replace('_', ' ')}: {broke} of {len(driven)}"
    obey = sum(not one.lost and not one.rules for one in outcomes)
    yield f"goal without fault and by these rules: {obey / len(outcomes):.1%}"


def main(arguments: Sequence[str] | None = None) -> None:
    """Drives, counts and prints."""
    parser = argparse.ArgumentParser(description="Drives all road users of recorded scenes.")
    parser.add_argument("folder", type=Path, help="recorded scenes, of any format")
    parser.add_argument("--runs", type=int, default=200, help="scenes in turn, each time with another seed")
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--outcomes", type=Path, help="a file for the outcomes, a JSON object a line")
    asked = parser.parse_args(arguments)
    files = sorted(path for path in asked.folder.iterdir() if path.is_file())
    jobs = [(files[number % len(files)], number // len(files)) for number in range(asked.runs)]
    outcomes: list[Outcome] = []
    with ProcessPoolExecutor(asked.processes) as pool:
        for found in pool.map(drive, *zip(*jobs)):
            outcomes += found
            if asked.outcomes:
                with asked.outcomes.open("a") as file:
                    file.writelines(json.dumps(asdict(one)) + "\n" for one in found)
    print(*report(outcomes), sep="\n")


if __name__ == "__main__":
    main()
