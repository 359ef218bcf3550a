"""A scene in a cell of a notebook, with anywidget: it plays, and goals are dragged."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import anywidget
import numpy as np
import traitlets

from ._conditions import Goal
from ._errors import DragTrafficError
from ._motion import Poses, chosen, flat, poses
from ._plot import COLOURS, GREY
from ._scene import AgentId, Scene


class Viewer(anywidget.AnyWidget):
    """A scene on a canvas, in Jupyter and its relatives. Needs ``pip install 'dragtraffic[notebook]'``.

    It plays what ``scene`` shows. The wheel zooms, dragging the ground moves it. With ``draggable``, dragging a road
    user or the dot of its goal sets the goal of :meth:`drag`. ``scene`` and ``goals`` are what came of it. The others
    react if ``react`` is true; ``seed`` and ``settings`` are arguments of :meth:`dragtraffic.Scene.generate`.
    """

    _esm = Path(__file__).with_name("_viewer.js")
    _map = traitlets.Dict().tag(sync=True)
    _motion = traitlets.Dict().tag(sync=True)
    draggable = traitlets.Bool(True).tag(sync=True)

    def __init__(
        self, scene: Scene, *, draggable: bool = True, react: bool = True, seed: int = 0, **settings: Any
    ) -> None:
        super().__init__(draggable=draggable)
        self.scene: Scene = scene
        self.goals: dict[AgentId, Goal] = {}
        self._begun, self._settings = scene, {"react": react, "seed": seed, **settings}
        self._map = _ground(scene)
        self._show(scene)
        self.on_msg(self._received)

    def drag(self, agent: AgentId, x_m: float, y_m: float) -> Scene:
        """Sets the goal of a road user, in metres of the scene, and shows what the engine makes of it.

        Raises:
            DragTrafficError: the engine refuses, and nothing changes.
        """
        goals = {**self.goals, str(agent): Goal(x_m=float(x_m), y_m=float(y_m))}
        self.scene = self._begun.generate(goals=goals, **self._settings)
        self.goals = goals
        self._show(self.scene)
        return self.scene

    def _received(self, _: Any, content: Any, __: Any) -> None:
        """A message of the page: a goal. The answer to it says that the page may send the next one."""
        if not isinstance(content, dict) or content.get("kind") != "goal":
            return
        told = ""
        try:
            self.drag(content["agent"], content["x_m"], content["y_m"])
        except (DragTrafficError, KeyError, TypeError, ValueError) as refused:
            told = str(refused)
        self.send({"kind": "answered", "told": told})

    def _show(self, scene: Scene) -> None:
        motion = poses(scene)
        self._motion = {
            "steps": max(map(len, motion.values()), default=1),
            "poses": {id: _listed(rows) for id, rows in motion.items()},
            "futures": {id: np.round(np.column_stack([f["x_m"], f["y_m"]]), 2).tolist() for id, f in chosen(scene).items()},
            "goals": {str(id): [goal.x_m, goal.y_m] for id, goal in self.goals.items()},
        }


def _listed(rows: Poses) -> list[list[float] | None]:
    """Poses as JSON has them, to the centimetre."""
    return [None if row[0] != row[0] else row for row in np.round(rows, 3).tolist()]


def _ground(scene: Scene) -> dict[str, Any]:
    """What does not move: lines in metres, road users with sizes, and where to look."""
    document = scene._peek()
    of = document["map"]
    members = {"areas": "drivable", "crosswalks": "crosswalks", "edges": "road_edges", "lines": "road_lines", "lanes": "lanes"}
    points = {"drivable": "polygon_m", "crosswalks": "polygon_m"}
    lines = {
        name: [np.round(flat(each[points.get(member, "points_m")]), 2).tolist() for each in of.get(member, [])]
        for name, member in members.items()
    }
    agents = [{name: agent[name] for name in ("id", "type", "length_m", "width_m")} for agent in document["agents"]]
    places = [rows[~np.isnan(rows[:, 0])][:1, :2] for rows in poses(scene).values()]
    starts = np.concatenate([*places, np.zeros((0 if any(map(len, places)) else 1, 2))])
    x_m, y_m = np.median(starts, axis=0).tolist()
    look = {"x_m": x_m, "y_m": y_m, "half_m": 45.0}
    colours = {**COLOURS, "other": GREY}
    return {**lines, "agents": agents, "look": look, "step_s": document["time"]["step_s"], "colours": colours}
