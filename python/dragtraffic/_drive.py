"""Drives: a planner of yours among road users that react, and the film of it."""

from __future__ import annotations

import argparse
import importlib
import importlib.util
import json
import subprocess
import sys
import tempfile
import time
import urllib.request
import webbrowser
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Union

import numpy as np

from . import _native
from ._errors import DragTrafficError
from ._run import Plan, Run, State, StateLike, Step
from ._scene import AgentId, Scene, open

#: Called with each step: the ego's state 0.1 s later, alone or with the plan that it announces.
Planner = Callable[[Step], Union[StateLike, "tuple[StateLike, Plan]"]]
#: Called once with the scene and the ego's id, a function or a class: the planner of this ego.
PlannerMaker = Callable[[Scene, str], Planner]

#: Length of a step of scenes, seconds, and most steps of a scene.
_STEP_S, _MOST_STEPS = 0.1, 600
#: Suffixes of films.
_FILMS = (".gif", ".webp", ".mp4")
#: What the help begins with.
_HELP = "A planner of yours drives road users of a scene while all others react. The result is a scene with its tracks."
#: Exit codes, as those of the other commands.
_FAILED, _INPUT, _EXISTS = 1, 3, 8


@dataclass(frozen=True)
class Drive:
    """What a drive came to.

    ``film`` is the scene with the driven motion as tracks, those of the recording before the start. ``steps`` has the
    start and every step, as :class:`Run` gives them. ``egos`` are the ids of those that planners drove.
    """

    film: Scene
    egos: list[str]
    steps: list[Step]

    @property
    def faults(self) -> list[dict[str, Any]]:
        """Collisions and vehicles off the road, by time: ``agent`` is who did it, ``fault`` what, when and where."""
        return [fault for step in self.steps for fault in step.faults]

    @property
    def reactions(self) -> list[dict[str, Any]]:
        """Changes of plans because of an ego, by time: ``agent``, ``reaction`` and ``time_s``."""
        changes = ((step, change) for step in self.steps for change in step.changes)
        return [
            {**change, "time_s": step.time_s}
            for step, change in changes
            if (change.get("reaction") or {}).get("cause") in self.egos
        ]


def drive(
    scene: Scene,
    planner: PlannerMaker,
    egos: AgentId | Iterable[AgentId] | None = None,
    *,
    seconds: float = 20.0,
    start_s: float = 0.0,
    seed: int = 0,
    plan_interval_s: float = 1.0,
) -> Drive:
    """Lets planners drive road users of a scene while all others react, in steps of 0.1 s.

    ``planner(scene, ego)`` is called once for each ego and gives the function that is called with each :class:`Step`:
    that returns the ego's :class:`State` 0.1 s later, or this and a plan. ``egos``: ids; the road user with the role
    ``ego`` when left out. A drive ends after ``seconds``, or when no ego is left.

    Raises:
        DragTrafficError: an ego is unknown or absent at the start, or a state is out of its range.
        ValueError: no road user has the role ``ego``, or a scene cannot be so long.
    """
    driven = _egos(scene, egos)
    first, count = round(start_s / _STEP_S), round(seconds / _STEP_S)
    if count < 1 or first + count >= _MOST_STEPS:
        raise ValueError(f"0.1 to {(_MOST_STEPS - 1) * _STEP_S - start_s:.1f} seconds expected, found {seconds:g}")
    run = Run(scene, driven, seed=seed, step_s=_STEP_S, plan_interval_s=plan_interval_s, start_s=start_s)
    planners = {ego: planner(scene, ego) for ego in driven}
    steps = [run.present]
    for _ in range(count):
        answers = {ego: _answer(planners[ego](steps[-1])) for ego in driven if ego in steps[-1]}
        if not answers:
            break
        plans: dict[AgentId, Plan] = {ego: plan for ego, (_, plan) in answers.items() if plan is not None}
        steps.append(run.step({ego: state for ego, (state, _) in answers.items()}, plans))
    return Drive(film(scene, steps), driven, steps)


def _egos(scene: Scene, egos: AgentId | Iterable[AgentId] | None) -> list[str]:
    if egos is None:
        found = [str(agent["id"]) for agent in scene._peek()["agents"] if agent.get("role") == "ego"]
        if not found:
            raise ValueError("no road user of the scene has the role ego: name one")
        return found
    return [str(egos)] if isinstance(egos, (str, int, np.integer)) else [str(id) for id in egos]


def _answer(given: Any) -> tuple[StateLike, Plan | None]:
    """A state, and the plan beside it. A state has five numbers, an answer with a plan two parts."""
    if isinstance(given, tuple) and not isinstance(given, State) and len(given) == 2:
        return given[0], given[1]
    return given, None


def film(scene: Scene, steps: Sequence[Step]) -> Scene:
    """The scene with what happened in a run as tracks, without futures. ``steps``: the run's start and each step after
    it, 0.1 s apart; what was recorded before the start is kept.

    Raises:
        ValueError: there are no steps, they are not 0.1 s apart, or a scene cannot be so long.
    """
    numbers = [step.time_s / _STEP_S for step in steps]
    first = round(numbers[0]) if steps else 0
    if not steps or any(abs(number - first - i) > 1e-3 for i, number in enumerate(numbers)):
        raise ValueError(f"a start and steps {_STEP_S} s apart expected")
    if first + len(steps) > _MOST_STEPS:
        raise ValueError(f"{_MOST_STEPS} steps at most expected, found {first + len(steps)}")
    document = json.loads(scene.bytes())
    rows: dict[str, list[tuple[int, Any]]] = {}
    for number, step in enumerate(steps):
        for id, state in zip(step.ids, step.states):
            rows.setdefault(id, []).append((first + number, state))
    agents = []
    for agent in document["agents"]:
        before = _recorded(agent["track"], first)
        moved = [*before, *rows.get(str(agent["id"]), [])]
        if moved:
            # A start or size that was fixed is part of the motion now; a goal is shown.
            goal = (agent.get("conditions") or {}).get("goal")
            agents.append({**agent, "track": track_of(moved), "conditions": {"goal": goal} if goal else {}})
    last, there = first + len(steps), {agent["id"] for agent in agents}
    meta = {**document.get("meta", {}), "timestamps_s": None}
    meta["objects_of_interest"] = [id for id in meta.get("objects_of_interest") or [] if id in there]
    meta["tracks_to_predict"] = [one for one in meta.get("tracks_to_predict") or [] if one[0] in there]
    now = min(int(document["time"].get("now_step") or 0), last - 1)
    timing = {**document["time"], "steps": last, "now_step": now}
    signals = [_until(signal, last) for signal in document.get("signals") or []]
    name = f"{scene.name}, driven"
    # The engine checks the document, so that a film is a scene or an error names what is not.
    parts = {"agents": agents, "signals": [signal for signal in signals if signal["states"]], "generated": None}
    made = Scene({**document, **parts, "name": name[:200], "meta": meta, "time": timing})
    return Scene._of(made.native())


def _until(signal: dict[str, Any], last: int) -> dict[str, Any]:
    """A signal without the states that begin at a step or later."""
    return {**signal, "states": [state for state in signal["states"] if state[0] < last]}


def _recorded(track: dict[str, Any], until: int) -> list[tuple[int, Any]]:
    """Steps and states of a recording before a step."""
    names = ("x_m", "y_m", "heading_rad", "vx_mps", "vy_mps")
    first, states = int(track["first_step"]), np.column_stack([track[name] for name in names])
    ranges = track.get("valid")

    def is_seen(step: int) -> bool:
        return ranges is None or any(begin <= step < end for begin, end in ranges)

    numbered = enumerate(states, first)
    return [(step, state) for step, state in numbered if step < until and is_seen(step)]


def track_of(moved: list[tuple[int, Any]]) -> dict[str, Any]:
    """Steps and states as a document has them; gaps are not valid."""
    first, length = moved[0][0], moved[-1][0] - moved[0][0] + 1
    states = np.zeros((length, 5))
    valid: list[list[int]] = []
    for step, state in moved:
        states[step - first] = state
        if valid and valid[-1][1] == step:
            valid[-1][1] = step + 1
        else:
            valid.append([step, step + 1])
    names = ("x_m", "y_m", "heading_rad", "vx_mps", "vy_mps")
    columns = {name: states[:, column].tolist() for column, name in enumerate(names)}
    return {"first_step": first, "valid": valid, **columns}


def found(name: str) -> PlannerMaker:
    """The planner of ``module:name`` or ``path/to/file.py:name``; modules are looked for in this folder too.

    Raises:
        ValueError: there is none.
    """
    place, _, wanted = name.rpartition(":")
    if not place or not wanted:
        raise ValueError(f"--planner {name}: MODULE:NAME expected, such as my_planner:Idm")
    if place.endswith(".py"):
        spec = importlib.util.spec_from_file_location(Path(place).stem, place)
        if spec is None or spec.loader is None or not Path(place).is_file():
            raise ValueError(f"--planner {name}: no file {place}")
        module = importlib.util.module_from_spec(spec)
        sys.modules[spec.name] = module
        spec.loader.exec_module(module)
    else:
        sys.path.insert(0, str(Path.cwd()))
        try:
            module = importlib.import_module(place)
        except ModuleNotFoundError as missing:
            if missing.name is not None and not place.startswith(missing.name):
                raise
            raise ValueError(f"--planner {name}: no module {place}") from None
    maker = getattr(module, wanted, None)
    if not callable(maker):
        raise ValueError(f"--planner {name}: {place} has no function or class {wanted}")
    planner: PlannerMaker = maker
    return planner


def told(driven: Drive) -> list[str]:
    """A drive in lines: each ego, the faults, the reactions."""
    lines, goals = [], {str(agent["id"]): _goal(agent) for agent in driven.film._peek()["agents"]}
    for ego in driven.egos:
        states = np.array([step[ego] for step in driven.steps if ego in step])
        gone = np.hypot(*np.diff(states[:, :2], axis=0).T).sum()
        own = [fault["fault"] for fault in driven.faults if fault["agent"] == ego]
        line = f"{ego}: {(len(states) - 1) * _STEP_S:.1f} s, {gone:.1f} m, {len(own)} faults of its own"
        goal = goals.get(ego)
        if goal is not None:
            away = np.hypot(states[:, 0] - goal[0], states[:, 1] - goal[1])
            line += f"; {away.min():.1f} m from its goal at {driven.steps[int(away.argmin())].time_s:.1f} s"
        lines.append(line)
    for fault in driven.faults:
        what, partner = fault["fault"], fault["fault"].get("with")
        beside = f" with {partner}" if partner else ""
        lines.append(f"{fault['agent']}: {what['kind'].replace('_', ' ')}{beside} at {what['time_s']:.1f} s")
    for change in driven.reactions:
        kind, cause = change["reaction"]["kind"].replace("_", " "), change["reaction"]["cause"]
        lines.append(f"{change['agent']}: {kind} because of {cause} at {change['time_s']:.1f} s")
    return lines


def _goal(agent: dict[str, Any]) -> tuple[float, float] | None:
    goal = (agent.get("conditions") or {}).get("goal") or {}
    return (goal["x_m"], goal["y_m"]) if goal.get("x_m") is not None else None


def main(arguments: Sequence[str]) -> int:
    """``dragtraffic drive``; returns the exit code."""
    parser = argparse.ArgumentParser(prog="dragtraffic drive", description=_HELP)
    parser.add_argument("scene", type=Path, help="file of any format that is read")
    planner_help = "or FILE.py:NAME: called with the scene and the id of the ego, it gives what is called with each step"
    parser.add_argument("--planner", required=True, metavar="MODULE:NAME", help=planner_help)
    ego_help = "road user that it drives, repeated for several; default: the one with the role ego"
    parser.add_argument("--ego", action="append", metavar="ID", help=ego_help)
    parser.add_argument("--index", type=int, default=0, help="position of the scene in a file of several")
    parser.add_argument("--seconds", type=float, default=20.0, help="length of the drive (default 20)")
    start_help = "scene time of the start (default 0)"
    parser.add_argument("--start-time", type=float, default=0.0, metavar="SECONDS", help=start_help)
    parser.add_argument("--seed", type=int, default=0, help="seed of the others")
    output_help = "scene with the motion as tracks; default: NAME-driven.json"
    parser.add_argument("-o", "--output", type=Path, metavar="FILE", help=output_help)
    film_help = f"moving picture: {', '.join(_FILMS)}; needs matplotlib"
    parser.add_argument("--film", type=Path, metavar="FILE", help=film_help)
    parser.add_argument("--force", action="store_true", help="overwrite files that exist")
    parser.add_argument("--open", action="store_true", help="open the result in the editor")
    args = parser.parse_args(arguments)
    output = args.output or Path(f"{args.scene.name.split('.')[0]}-driven.json")
    for path in filter(None, [output, args.film]):
        if path.exists() and not args.force:
            return _complain(f"{path} exists; --force overwrites it", _EXISTS)
    if args.film and args.film.suffix.lower() not in _FILMS:
        parser.error(f"--film {args.film}: one of {', '.join(_FILMS)} expected")
    try:
        planner, scene = found(args.planner), open(args.scene, args.index)
        settings = {"seconds": args.seconds, "start_s": args.start_time, "seed": args.seed}
        driven = drive(scene, planner, args.ego, **settings)
    except (DragTrafficError, ValueError, OSError) as refused:
        return _complain(str(refused), _INPUT)
    driven.film.save(output)
    print("\n".join([*told(driven), f"written: {output}"]))
    if args.film:
        try:
            driven.film.animate(args.film)
        except (ImportError, ValueError) as refused:
            return _complain(str(refused), _FAILED)
        print(f"written: {args.film}")
    return _show(output) if args.open else 0


def _complain(message: str, code: int) -> int:
    print(f"dragtraffic: {message}", file=sys.stderr)
    return code


def _show(path: Path) -> int:
    """Serves the editor with the scene open, until Ctrl-C."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "driven.json").write_bytes(path.read_bytes())
        command = [sys.executable, "-m", "dragtraffic", "serve", "--port", "0", "--data", folder]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
            assert server.stdout is not None
            address = server.stdout.readline().split()[-1:]
            if not address:
                return _complain("the editor does not start", _FAILED)
            try:
                url = f"{address[0]}{_query(address[0])}"
                print(f"the editor is at {url}; Ctrl-C ends it")
                webbrowser.open(url)
                server.wait()
            except KeyboardInterrupt:
                pass
            finally:
                server.terminate()
    return 0


def _query(address: str) -> str:
    """Query that opens the scene of the data folder, once it is listed."""
    for _ in range(50):
        with urllib.request.urlopen(f"{address}v1/scenes?limit=200") as reply:
            ids = [str(scene["id"]) for scene in json.load(reply)["scenes"]]
        of_folder = [id for id in ids if not id.startswith("demo-")]
        own = [id for id in of_folder if id.startswith("file-driven")] or of_folder[:1]
        if own:
            return f"?scene={own[0]}"
        time.sleep(0.1)
    return ""
