"""What a road user sees, as one row of numbers in the order of GPUDrive, for policies of that simulator."""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np
from numpy.typing import NDArray

from .._motion import flat
from .._run import State, Step
from .._scene import Scene
from ._driver import Driver
from ._observe import Floats, Frame, View
from ._route import wrapped

#: Other road users and map elements that have a place, and metres within which they are seen.
PARTNERS, ROADS, SEEN_M = 63, 200, 50.0
#: Numbers of the ego, of a partner and of a map element, and of all.
EGO, PARTNER, ROAD = 6, 6, 13
SIZE = EGO + PARTNERS * PARTNER + ROADS * ROAD
#: What is divided by: speed, length, width, places, sizes of map elements. GPUDrive shrinks road users before.
_SPEED_MPS, _LENGTH_M, _WIDTH_M, _PLACE_M, _ELEMENT_M, _SHRUNK = 100.0, 30.0, 15.0, 1000.0, 100.0, 0.7
#: Places of the kinds of map elements among seven; the first stands for none.
_EDGE, _LINE, _LANE, _CROSSWALK, _BUMP, _STOP = 1, 2, 3, 4, 5, 6
#: Half the width of a line, and its height, metres.
_THIN_M = 0.1
#: A line of at least eleven points loses those that span less than this with their neighbours, m2.
_LONG, _AREA_M2 = 11, 0.1


def gpudrive_space() -> gymnasium.spaces.Box:
    """The space of these observations: a box of 2984 numbers."""
    return gymnasium.spaces.Box(-np.inf, np.inf, (SIZE,), np.float32)


class GpudriveView(View):
    """The scene's map and sizes as GPUDrive has them."""

    def __init__(self, scene: Scene) -> None:
        super().__init__(scene)
        self._roads = _elements(scene._peek()["map"])

    def observation(self, driver: Driver, step: Step, left_s: float) -> Floats:
        """What an ego sees at the end of a step, shape [2984]."""
        id, goal, own = driver.id, driver.goal, step[driver.id]
        frame = Frame(own)
        row = np.zeros(SIZE)
        to_goal = frame.places(np.array([[goal.x_m, goal.y_m]]))[0] / _PLACE_M
        row[:EGO] = [own.speed_mps / _SPEED_MPS, *self._scaled([id])[0], *to_goal, float(driver.collided)]
        partners = self._partners(id, step, own, frame)
        row[EGO : EGO + partners.size] = partners.ravel()
        row[EGO + PARTNERS * PARTNER :] = self._elements_near(own, frame).ravel()
        return row.astype(np.float32)

    def _scaled(self, ids: list[str]) -> NDArray[np.float64]:
        """Lengths and widths."""
        sizes = np.array([self.size(id) for id in ids]).reshape(-1, 2)
        return sizes * _SHRUNK / (_LENGTH_M, _WIDTH_M)

    def _partners(self, id: str, step: Step, own: State, frame: Frame) -> NDArray[np.float64]:
        """Speed, place, heading and size of those within reach, in the order of the scene."""
        places = frame.places(step.states[:, :2])
        near = np.hypot(places[:, 0], places[:, 1]) <= SEEN_M
        rows = [row for row in np.flatnonzero(near).tolist() if step.ids[row] != id][:PARTNERS]
        states = step.states[rows]
        speed = np.hypot(states[:, 3], states[:, 4]) / _SPEED_MPS
        turn = wrapped(states[:, 2] - own.heading_rad) / (2 * np.pi)
        sizes = self._scaled([step.ids[row] for row in rows])
        return np.column_stack([speed, places[rows] / _PLACE_M, turn, sizes])

    def _elements_near(self, own: State, frame: Frame) -> NDArray[np.float64]:
        """Place, half length, half width, height, heading and kind of the nearest elements."""
        rows = np.zeros((ROADS, ROAD))
        rows[:, 6] = 1.0
        away = self._roads[:, :2] - (own.x_m, own.y_m)
        distance = np.hypot(away[:, 0], away[:, 1])
        near = np.argsort(distance, kind="stable")[:ROADS]
        found = self._roads[near[distance[near] <= SEEN_M]]
        turn = wrapped(found[:, 5] - own.heading_rad) / (2 * np.pi)
        places = frame.places(found[:, :2]) / _PLACE_M
        kinds = np.eye(7)[found[:, 6].astype(int)]
        rows[: len(found)] = np.column_stack([places, found[:, 2:5] / _ELEMENT_M, turn, kinds])
        return rows


def _elements(map: dict[str, Any]) -> NDArray[np.float64]:
    """A row for each piece of a line, each area and each sign: middle, half length, half width, height, heading, kind."""
    rows: list[NDArray[np.float64]] = [np.zeros((0, 7))]
    for member, kind in (("road_edges", _EDGE), ("road_lines", _LINE), ("lanes", _LANE)):
        for line in map.get(member, []):
            points = _thinned(flat(line["points_m"]))
            ahead = np.diff(points, axis=0)
            half = 0.5 * np.hypot(ahead[:, 0], ahead[:, 1])
            thin = np.full((len(half), 2), _THIN_M)
            heading = np.arctan2(ahead[:, 1], ahead[:, 0])
            middle = 0.5 * (points[1:] + points[:-1])
            rows.append(np.column_stack([middle, half, thin, heading, np.full(len(half), kind)]))
    for member, kind in (("crosswalks", _CROSSWALK), ("speed_bumps", _BUMP)):
        for area in map.get(member, []):
            corners = flat(area["polygon_m"])[:4]
            sides = np.roll(corners, -1, axis=0) - corners
            lengths = np.hypot(sides[:, 0], sides[:, 1])
            along = sides[int(np.argmax(lengths))]
            size = [0.5 * lengths.max(), 0.5 * lengths.min(), _THIN_M]
            rows.append(np.array([[*corners.mean(axis=0), *size, np.arctan2(along[1], along[0]), kind]]))
    for sign in map.get("stop_signs", []):
        rows.append(np.array([[*sign["position_m"][:2], 0.2, 0.2, 1.0, 0.0, _STOP]]))
    return np.concatenate(rows)


def _thinned(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """A line without the points that hardly bend it: of neighbours one at a time, until none is left."""
    if len(points) < _LONG:
        return points
    while len(points) > 2:
        before, after = points[1:-1] - points[:-2], points[2:] - points[:-2]
        areas = 0.5 * np.abs(before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0])
        kept = np.ones(len(points), dtype=bool)
        for at in (np.flatnonzero(areas < _AREA_M2) + 1).tolist():
            kept[at] = not kept[at - 1]
        if kept.all():
            break
        points = points[kept]
    return points
