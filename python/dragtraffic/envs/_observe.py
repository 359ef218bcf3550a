"""What a road user sees, as arrays in its own frame: x ahead, y to the left, metres, m/s and radians."""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np
from numpy.typing import NDArray

from .._run import State, Step
from .._scene import Scene
from ._driver import Driver
from ._route import Lanes, Route, wrapped

Floats = NDArray[np.float32]
#: An observation: arrays by the names of :data:`SHAPES`, or one row in the order of GPUDrive. Who asked knows which.
Seen = Any

#: Other road users, lane points and signals that are seen, the nearest first. Rows beyond those there are zero.
OTHERS, LANE_POINTS, SIGNALS = 16, 64, 4
#: Metres within which lane points and other road users are seen.
SEEN_M = 80.0
#: Points of the way to the goal, and metres between them.
ROUTE_POINTS, ROUTE_M = 10, 4.0
#: States of a signal that forbid passing, and those that warn.
_STOP, _CAUTION = {"stop", "arrow_stop", "flashing_stop"}, {"caution", "arrow_caution", "flashing_caution"}

#: Shapes and columns of the parts of an observation.
#:
#: ``own``: speed, length, width, acceleration and curvature of the last step.
#: ``goal``: ahead, left, distance, turn to the goal's heading, seconds left.
#: ``route``: ahead and left of points each 4 m along the way to the goal, the last ones at the goal.
#: ``others``: ahead, left, cosine and sine of the relative heading, relative velocity ahead and left, length, width.
#: ``lanes``: ahead, left, cosine and sine of the lane's relative direction, speed limit (0 where unknown).
#: ``signals``: ahead, left of the stop position, 1 for red, 1 for amber.
SHAPES: dict[str, tuple[int, ...]] = {
    "own": (5,),
    "goal": (5,),
    "route": (ROUTE_POINTS, 2),
    "others": (OTHERS, 8),
    "lanes": (LANE_POINTS, 5),
    "signals": (SIGNALS, 4),
}


def observation_space() -> gymnasium.spaces.Dict:
    """The space of observations: boxes of the shapes of :data:`SHAPES`."""
    box = gymnasium.spaces.Box
    return gymnasium.spaces.Dict(
        {name: box(-np.inf, np.inf, shape, np.float32) for name, shape in SHAPES.items()}
    )


class View:
    """The scene's map, signals and sizes as arrays."""

    def __init__(self, scene: Scene) -> None:
        document = scene._peek()
        self._lanes = Lanes(document["map"].get("lanes", []))
        signals = [signal for signal in document.get("signals", []) if signal.get("stop_m")]
        # Recorded points have a height too.
        self._stops = np.array([signal["stop_m"][:2] for signal in signals], dtype=float).reshape(-1, 2)
        self._states = [[(int(step), str(state)) for step, state in signal["states"]] for signal in signals]
        self._sizes = {a["id"]: (a["length_m"], a["width_m"]) for a in document["agents"]}
        self._vehicles = {a["id"] for a in document["agents"] if a["type"] == "vehicle"}

    def size(self, id: str) -> tuple[float, float]:
        """Length and width of a road user."""
        return self._sizes[id]

    def route(self, id: str, start: State, goal: State) -> Route:
        """The way of a road user to its goal: along the lanes for a vehicle, straight for others."""
        lanes = self._lanes if id in self._vehicles else Lanes([])
        return lanes.route(start, goal)

    def observation(self, driver: Driver, step: Step, left_s: float) -> Seen:
        """What an ego sees at the end of a step, ``left_s`` before the horizon."""
        id, goal, own = driver.id, driver.goal, step[driver.id]
        frame = Frame(own)
        to_goal = frame.places(np.array([[goal.x_m, goal.y_m]]))[0]
        turn = float(wrapped(goal.heading_rad - own.heading_rad))
        length_m, width_m = self._sizes[id]
        seen = {
            "own": [own.speed_mps, length_m, width_m, *driver.action],
            "goal": [*to_goal, float(np.hypot(*to_goal)), turn, left_s],
            "route": frame.places(driver.route.ahead(ROUTE_POINTS, ROUTE_M)),
            "others": self._others(id, step, own, frame),
            "lanes": self._nearby_lanes(own, frame),
            "signals": self._signals(step, frame),
        }
        return {name: np.asarray(value, dtype=np.float32) for name, value in seen.items()}

    def _others(self, id: str, step: Step, own: State, frame: Frame) -> NDArray[np.float64]:
        others = [row for row, other in enumerate(step.ids) if other != id]
        rows = np.zeros(SHAPES["others"])
        if not others:
            return rows
        states = step.states[others]
        places = frame.places(states[:, :2])
        distance = np.hypot(places[:, 0], places[:, 1])
        nearest = np.argsort(distance, kind="stable")[:OTHERS]
        nearest = nearest[distance[nearest] <= SEEN_M]
        turn = states[nearest, 2] - own.heading_rad
        speed = frame.turned(states[nearest, 3:] - np.array([own.vx_mps, own.vy_mps]))
        sizes = np.array([self._sizes[step.ids[others[i]]] for i in nearest]).reshape(-1, 2)
        found = np.column_stack([places[nearest], np.cos(turn), np.sin(turn), speed, sizes])
        rows[: len(found)] = found
        return rows

    def _nearby_lanes(self, own: State, frame: Frame) -> NDArray[np.float64]:
        rows = np.zeros(SHAPES["lanes"])
        lanes = self._lanes.points
        away = lanes[:, :2] - (own.x_m, own.y_m)
        squares = np.einsum("ij,ij->i", away, away)
        within = np.flatnonzero(squares <= SEEN_M**2)
        nearest = within[np.argsort(squares[within], kind="stable")[:LANE_POINTS]]
        points = lanes[nearest]
        turn = points[:, 2] - own.heading_rad
        found = np.column_stack([frame.places(points[:, :2]), np.cos(turn), np.sin(turn), points[:, 3]])
        rows[: len(found)] = found
        return rows

    def _signals(self, step: Step, frame: Frame) -> NDArray[np.float64]:
        rows = np.zeros(SHAPES["signals"])
        if not len(self._stops):
            return rows
        places = frame.places(self._stops)
        nearest = np.argsort(np.hypot(places[:, 0], places[:, 1]), kind="stable")[:SIGNALS]
        for row, index in enumerate(nearest):
            # After the recorded time a signal keeps its last state.
            state = [word for first, word in self._states[index] if first <= step.time_s / 0.1 + 1e-6][-1:]
            red, amber = (float(bool(state) and state[0] in words) for words in (_STOP, _CAUTION))
            rows[row] = [*places[index], red, amber]
        return rows


class Frame:
    """The frame of a road user."""

    def __init__(self, own: State) -> None:
        cos, sin = np.cos(own.heading_rad), np.sin(own.heading_rad)
        self._origin = np.array([own.x_m, own.y_m])
        self._turn = np.array([[cos, -sin], [sin, cos]])

    def places(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Points of the scene, seen from the road user."""
        return self.turned(points - self._origin)

    def turned(self, directions: NDArray[np.float64]) -> NDArray[np.float64]:
        """Directions of the scene, seen from the road user."""
        turned: NDArray[np.float64] = directions @ self._turn
        return turned
