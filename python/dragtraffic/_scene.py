"""A scene and what the engine does with it."""

from __future__ import annotations

import io
import json
import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Union

from . import _native
from ._conditions import Condition, Goal
from ._errors import DragTrafficError
from ._renamed import renamed

#: An id of a road user; numbers are taken as their text.
AgentId = Union[str, int]

if TYPE_CHECKING:
    import pandas
    from matplotlib.animation import FuncAnimation
    from matplotlib.axes import Axes


def _ids(ids: object) -> list[str]:
    """Ids as the engine takes them: one id, or several, as text or numbers."""
    several = ids if isinstance(ids, Iterable) and not isinstance(ids, str) else [ids]
    return [str(id) for id in several]


class Scene:
    """A scene: map, signals, road users with their tracks, and futures where there are some.

    ``document`` is the scene as JSON has it (``dragtraffic schema`` prints what that is). Methods give new scenes and
    leave this one as it is. Of a scene that was generated, ``resolved`` says of each road user what was asked and
    whether it can be had, ``warnings`` what is unlikely, and ``code`` names the answer. Of a scene that was opened,
    ``warnings`` are what its reader changed or left out.
    """

    resolved: dict[str, Any]
    warnings: list[dict[str, Any]]
    code: str | None

    def __init__(self, document: Mapping[str, Any]) -> None:
        self._document: dict[str, Any] | None = dict(document)
        self._native: _native.Scene | None = None
        self._read: dict[str, Any] | None = None
        self.resolved, self.warnings, self.code = {}, [], None

    @classmethod
    def _of(cls, native: _native.Scene) -> Scene:
        scene = cls({})
        scene._document, scene._native = None, native
        return scene

    @property
    def document(self) -> dict[str, Any]:
        """The scene as JSON has it. Changes of it count in later calls."""
        self._document = self._peek()
        # Whoever has the document may change it.
        self._native = self._read = None
        return self._document

    def _peek(self) -> dict[str, Any]:
        """The document, for those who do not change it: the engine's own scene stays."""
        if self._document is not None:
            return self._document
        if self._read is None:
            assert self._native is not None
            self._read = dict(json.loads(self._native.document()))
        return self._read

    def native(self) -> _native.Scene:
        """The scene as the engine has it.

        Raises:
            DragTrafficError: the document is no scene.
        """
        return self._native or _native.Scene.of_document(self.bytes())

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_document": None, "_read": None, "_native": self.bytes()}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self._native = _native.Scene.of_document(state["_native"])

    def __repr__(self) -> str:
        futures = f", {len(self.samples)} samples" if self.samples else ""
        return f"<Scene {self.name!r}: {len(self.agents)} road users, {self.duration_s:.1f} s{futures}>"

    @property
    def name(self) -> str:
        """Name for people."""
        return str(self._peek().get("name") or self._peek().get("id") or "")

    @property
    def agents(self) -> list[str]:
        """Ids of the road users."""
        return [agent["id"] for agent in self._peek()["agents"]]

    @property
    def duration_s(self) -> float:
        """Recorded time, seconds."""
        time = self._peek()["time"]
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
            DragTrafficError: the engine refused the call.
            ValueError: a condition is given twice.
        """
        fixed = {str(id): Condition(goal=goal) for id, goal in (goals or {}).items()}
        whole = {str(id): condition for id, condition in (conditions or {}).items()}
        both = sorted(fixed.keys() & whole.keys())
        if both:
            raise ValueError(f"goals and conditions both name {', '.join(both)}")
        fixed.update(whole)
        body: dict[str, Any] = {
            "conditions": {id: condition.document() for id, condition in fixed.items()},
            "react": react if isinstance(react, bool) else _ids(react),
            "seed": int(seed),
            "samples": int(samples),
            "modes": int(modes),
            "horizon_s": float(horizon_s),
            "start_s": float(start_s),
            "kept_futures": kept_futures,
        }
        if agents is not None:
            body["agents"] = _ids(agents)
        numbers = {"replan_interval_s": replan_interval_s, "diversity": diversity, "steps": steps}
        body.update({name: value for name, value in numbers.items() if value is not None})
        return self.generate_request(body)

    def generate_request(self, request: Mapping[str, Any]) -> Scene:
        """Futures by a request in the form of ``POST /v1/generate``, without its scene: a try of ``search`` has one.

        Raises:
            DragTrafficError: the engine refused the call.
        """
        native, said = self.native().generate(_json(dict(request)))
        made, answer = Scene._of(native), json.loads(said)
        made.resolved, made.warnings, made.code = answer["resolved"], answer["warnings"], answer["code"]
        return made

    def search(
        self,
        where: str,
        situation: Mapping[str, Any] | None = None,
        *,
        tries: int = 100,
        found: int | None = None,
        method: Literal["search", "random", "sobol", "latin-hypercube", "grid"] = "search",
        seed: int = 0,
        seeds: int | Iterable[int] = 1,
        options: Mapping[str, Any] | None = None,
    ) -> list[dict[str, Any]]:
        """Tries towards a condition on the figures of the score, such as ``"actor.min_ttc_s < 1.5"``.

        ``situation`` is what is varied, as a batch plan has it: ``{"template": "cut-in"}``, or ``{"agents": ["4"],
        "goal": {"speed_mps": {"uniform": [5, 15]}}}``. ``tries``: for each road user and seed, at most 1000 in all;
        ``found`` ends the search early. ``options``: those of every generation, such as ``{"horizon_s": 6}``.

        Returns:
            The tries in their order. Each has ``number``, ``outcome`` (``"kept"`` where the condition holds), ``drawn``
            numbers, ``miss`` (0 where it holds), ``figures``, ``code`` and ``request``; ``generate_request`` makes its
            result again.

        Raises:
            DragTrafficError: the engine refused the call.
        """
        body: dict[str, Any] = {
            "where": where,
            "situation": dict(situation or {}),
            "tries": int(tries),
            "method": method,
            "seed": int(seed),
            "seeds": int(seeds) if isinstance(seeds, int) else [int(one) for one in seeds],
            "generate": dict(options or {}),
        }
        if found is not None:
            body["found"] = int(found)
        return list(json.loads(self.native().search(_json(body)))["tries"])

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
            DragTrafficError: the engine refused the call.
        """
        body: dict[str, Any] = {"seed": int(seed), "start_s": float(start_s)}
        if count is not None or density_per_lane_km is not None:
            body["density"] = {"count": count} if count is not None else {"per_lane_km": density_per_lane_km}
        if types:
            body["types"] = dict(types)
        if keep is not None:
            body["keep"] = _ids(keep)
        if region is not None:
            ring = [list(point) for point in region]
            body["region"] = {"polygon_m": ring[:-1] if ring[:1] == ring[-1:] else ring}
        native, said = self.native().place(_json(body))
        made, placed = Scene._of(native), json.loads(said)
        if placed["unplaced"]:
            made.warnings = [{"code": "unplaced", "detail": f"{placed['unplaced']} not placed: {placed['reason']}"}]
        return made

    def score(self, sample: int | None = None) -> dict[str, Any]:
        """Collisions, near misses, time to collision, road, kinematics and goals of the scene as it is shown,
        or with another of its samples: ``scene`` and ``agents`` by id."""
        scene = self if sample is None else self.chosen(sample)
        return dict(json.loads(scene.native().score(b"{}")))

    def to_frame(self) -> pandas.DataFrame:
        """A long table of all motion in the frame of the scene, one row for each road user, future and step:
        ``source`` is ``log`` or ``generated``, futures have ``sample``, ``mode`` and ``probability``, ``chosen`` are
        those that are shown, and ``valid`` is false where the road user was not seen. Needs pandas."""
        import pandas

        # Tables have the frame of the source; without an origin that is the scene's own.
        meta = {name: value for name, value in self._peek().get("meta", {}).items() if name != "origin"}
        text, _ = Scene({**self._peek(), "meta": meta}).native().export("csv")
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

    def animate(
        self, path: str | os.PathLike[str] | None = None, ax: Axes | None = None, *, fps: float = 10.0
    ) -> FuncAnimation:
        """The scene in motion from above: chosen futures in filled colour, all others as recorded. With ``path`` it is
        written: ``.gif`` or ``.webp``, or ``.mp4`` where ffmpeg is on the path. ``fps`` are pictures a second, at most
        10. Needs matplotlib; keep what is returned while it plays.

        Raises:
            ValueError: ffmpeg is needed and not there.
        """
        from ._plot import animate

        return animate(self, path, ax, fps=fps)

    def save(self, path: str | os.PathLike[str], format: str | None = None) -> list[dict[str, Any]]:
        """Writes the scene: as it is, or in another format that ``dragtraffic convert`` knows. Returns what that format
        cannot hold."""
        content, losses = (self.bytes(), b"[]") if format is None else self.native().export(format)
        Path(path).write_bytes(content)
        lost: list[dict[str, Any]] = json.loads(losses)
        return lost

    def bytes(self) -> bytes:
        """The document as JSON."""
        return self._native.document() if self._document is None and self._native else _json(self.document)


def _json(value: Any) -> bytes:
    return json.dumps(value, default=_plain).encode()


def _plain(number: Any) -> Any:
    """A number of numpy or pandas as one of JSON's."""
    if hasattr(number, "item"):
        return number.item()
    raise TypeError(f"{type(number).__name__} has no place in a document")


def open(
    path: str | os.PathLike[str], index: int = 0, around: tuple[float, float, float] | None = None
) -> Scene:
    """Opens a scene of any format that ``dragtraffic convert`` reads; ``index`` says which one of a file of many.

    Beside the tracks of a recording (``00_tracks.csv``), its other tables and the map of its place are read too; of a
    folder its recordings are read, one after the other. ``warnings`` of the scene names the files.

    ``around`` reads a part of a map: x, y in the coordinates of the file and a radius of 10 to 5000 m.

    Raises:
        DragTrafficError: with the fault and where in the file it lies.
    """
    path = Path(path)
    try:
        if path.is_dir():
            native, said = _native.Scene.read_folder(path, index)
        else:
            native, said = _native.Scene.read(path.read_bytes(), path, index, around)
    except DragTrafficError as refused:
        raise DragTrafficError(f"{path}: {refused}", refused.code, refused.errors) from None
    scene = Scene._of(native)
    scene.warnings = json.loads(said)
    return scene


def open_all(paths: Iterable[str | os.PathLike[str]]) -> list[Scene]:
    """Opens the first scene of each file."""
    return [open(path) for path in paths]
