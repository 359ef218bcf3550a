"""A scene document and what the program does with it."""

from __future__ import annotations

import io
import json
import os
import tempfile
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Union

from ._conditions import Condition, Goal
from ._program import run
from ._renamed import renamed

#: An id of a road user; numbers are taken as their text.
AgentId = Union[str, int]

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes


def _ids(ids: object) -> list[str]:
    """Ids as the program takes them: one id, or several, as text or numbers."""
    several = ids if isinstance(ids, Iterable) and not isinstance(ids, str) else [ids]
    return [str(id) for id in several]


class Scene:
    """A scene: map, signals, road users with their tracks, and futures where there are some.

    ``document`` is the scene as JSON has it (``dragtraffic schema`` prints what that is). Methods give new
    scenes and leave this one as it is.
    """

    def __init__(self, document: Mapping[str, Any]) -> None:
        self.document: dict[str, Any] = dict(document)

    def __repr__(self) -> str:
        futures = f", {len(self.samples)} samples" if self.samples else ""
        return f"<Scene {self.name!r}: {len(self.agents)} road users, {self.duration_s:.1f} s{futures}>"

    @property
    def name(self) -> str:
        """Name for people."""
        return str(self.document.get("name") or self.document.get("id") or "")

    @property
    def agents(self) -> list[str]:
        """Ids of the road users."""
        return [agent["id"] for agent in self.document["agents"]]

    @property
    def duration_s(self) -> float:
        """Recorded time, seconds."""
        time = self.document["time"]
        return float(time["step_s"] * (time["steps"] - 1))

    @property
    def samples(self) -> list[dict[str, Any]]:
        """Joint scenes of the last answer: road user's id to its futures."""
        return list((self.document.get("generated") or {}).get("samples", []))

    def chosen(self, sample: int) -> Scene:
        """The same scene with another joint scene shown, scored and exported."""
        if not 0 <= sample < len(self.samples):
            raise IndexError(f"sample {sample} of {len(self.samples)}")
        return Scene({**self.document, "generated": {**self.document["generated"], "chosen_sample": sample}})

    @renamed(replan_s="replan_interval_s", forget='kept_futures="forgotten"')
    def generate(
        self,
        agents: AgentId | Iterable[AgentId] | None = None,
        *,
        goals: Mapping[AgentId, Goal] | None = None,
        conditions: Mapping[AgentId, Condition] | None = None,
        react: bool | AgentId | Iterable[AgentId] = False,
        seed: int = 0,
        samples: int = 1,
        modes: int = 6,
        horizon_s: float = 9.0,
        start_s: float = 0.0,
        replan_interval_s: float | None = None,
        diversity: float | None = None,
        steps: int | None = None,
        kept_futures: Literal["answered", "omitted", "forgotten"] = "answered",
    ) -> Scene:
        """Futures for road users.

        ``agents``: the road users to generate. Without it: those with a goal or via points, and without any of
        these all. An empty list needs ``react``: road users then continue where their known motion ends. ``react``:
        the others react, all or the ids named. ``kept_futures``: what becomes of the futures of earlier calls, of
        road users that are not generated; ``forgotten`` drops them. ``horizon_s`` up to 20; above 9, and with
        ``replan_interval_s`` (3, 6 or 9), every road user plans again from the state it has reached. Of a road user
        that is not generated, a goal, start or via point is refused; its type and size count. Ids are text or numbers.

        Raises:
            DragTrafficError: the program refused the call.
            ValueError: a condition is given twice.
        """
        fixed = {str(id): Condition(goal=goal) for id, goal in (goals or {}).items()}
        whole = {str(id): condition for id, condition in (conditions or {}).items()}
        both = sorted(fixed.keys() & whole.keys())
        if both:
            raise ValueError(f"goals and conditions both name {', '.join(both)}")
        fixed.update(whole)
        arguments = ["generate", "-"]
        if agents is not None:
            arguments.append(f"--agents={','.join(_ids(agents)) or '@none'}")
        options = {
            "seed": seed,
            "samples": samples,
            "modes": modes,
            "horizon": horizon_s,
            "start-time": start_s,
            "replan-interval": replan_interval_s,
            "diversity": diversity,
            "steps": steps,
            "kept-futures": kept_futures,
        }
        arguments += [f"--{name}={value}" for name, value in options.items() if value is not None]
        if react is True:
            arguments.append("--react")
        elif react is not False and (reacting := _ids(react)):
            arguments.append(f"--react={','.join(reacting)}")
        with tempfile.TemporaryDirectory() as folder:
            for number, (id, condition) in enumerate(fixed.items()):
                file = Path(folder, f"{number}.json")
                file.write_text(json.dumps(condition.document()))
                arguments.append(f"--condition={id}={file}")
            return self._made(arguments)

    @renamed(at_s="start_s", density_per_km="density_per_lane_km")
    def place(
        self,
        *,
        count: int | None = None,
        density_per_lane_km: float | None = None,
        types: Mapping[str, float] | None = None,
        region: Iterable[tuple[float, float]] | None = None,
        keep: AgentId | Iterable[AgentId] | None = None,
        start_s: float = 0.0,
        seed: int = 0,
    ) -> Scene:
        """Places road users on the map, beside those that are there: ``count`` in all, or ``density_per_lane_km`` for
        each kilometre of lane. ``types`` gives shares, ``region`` a polygon in metres, ``keep`` the road users of
        the scene that stay (all when absent).

        Raises:
            DragTrafficError: the program refused the call.
        """
        arguments = ["place", "-", f"--seed={seed}", f"--start-time={start_s}"]
        arguments += [f"--count={count}"] if count is not None else []
        arguments += [f"--density={density_per_lane_km}"] if density_per_lane_km is not None else []
        if types:
            arguments.append("--types=" + ",".join(f"{name}={share}" for name, share in types.items()))
        if keep is not None:
            ids = ",".join(_ids(keep))
            arguments.append(f"--keep={ids}" if ids else "--keep")
        if region is None:
            return self._made(arguments)
        ring = [list(point) for point in region]
        polygon = {"type": "Polygon", "coordinates": [ring if ring[:1] == ring[-1:] else [*ring, ring[0]]]}
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "region.json")
            file.write_text(json.dumps(polygon))
            return self._made([*arguments, f"--region={file}"])

    def score(self, sample: int | None = None) -> dict[str, Any]:
        """Collisions, near misses, time to collision, road, kinematics and goals of the scene as it is shown,
        or with another of its samples: ``scene`` and ``agents`` by id."""
        scene = self if sample is None else self.chosen(sample)
        return dict(json.loads(run(["score", "--json", "-"], scene.bytes())))

    def to_frame(self) -> pandas.DataFrame:
        """A long table of all motion in the frame of the scene, one row for each road user, future and step:
        ``source`` is ``log`` or ``generated``, futures have ``sample``, ``mode`` and ``probability``, ``chosen`` are
        those that are shown, and ``valid`` is false where the road user was not seen. Needs pandas."""
        import pandas

        # Tables have the frame of the source; without an origin that is the scene's own.
        meta = {name: value for name, value in self.document.get("meta", {}).items() if name != "origin"}
        here = Scene({**self.document, "meta": meta})
        text = run(["export", "-", "--to", "csv", "-o", "-"], here.bytes())
        words = {name: "string" for name in ("scenario_id", "agent_id", "type", "subtype", "source")}
        whole = {name: "Int64" for name in ("sample", "mode")}
        frame = pandas.read_csv(io.BytesIO(text), dtype={**words, **whole})
        frame = frame.assign(scenario_id=self.name)
        return frame.astype({"scenario_id": "string", "chosen": bool, "valid": bool})

    def plot(self, ax: Axes | None = None, *, modes: bool = True) -> Axes:
        """The scene from above, about those who have futures: map, recorded tracks in grey, what is shown in
        colour and, with ``modes``, the alternatives thinly. Needs pandas and matplotlib."""
        from ._plot import plot

        return plot(self, ax, modes=modes)

    def save(self, path: str | os.PathLike[str], format: str | None = None) -> None:
        """Writes the scene: as it is, or in another format that ``dragtraffic export`` knows."""
        if format is None:
            Path(path).write_bytes(self.bytes())
        else:
            arguments = ["export", "-", "--to", format, "--force", "-o", os.fspath(path)]
            run(arguments, self.bytes())

    def bytes(self) -> bytes:
        """The document as JSON."""
        return json.dumps(self.document).encode()

    def _made(self, arguments: list[str]) -> Scene:
        return Scene(json.loads(run(arguments, self.bytes())))


def open(path: str | os.PathLike[str], index: int = 0) -> Scene:
    """Opens a scene of any format that ``dragtraffic convert`` reads; ``index`` says which one of a file of many.

    Raises:
        DragTrafficError: with the fault and where in the file it lies.
    """
    arguments = ["convert", os.fspath(path), "--to", "dragtraffic", "--index", str(index), "-o", "-"]
    return Scene(json.loads(run(arguments)))


def open_all(paths: Iterable[str | os.PathLike[str]]) -> list[Scene]:
    """Opens the first scene of each file."""
    return [open(path) for path in paths]
