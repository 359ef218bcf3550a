"""What a road user sees, as arrays in its own frame: x ahead, y to the left, metres, m/s and radians."""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np
from numpy.typing import NDArray

from .._run import State, Step
from .._scene import Scene

Floats = NDArray[np.float32]
#: An observation: arrays by the names of :data:`SHAPES`, or one row in the order of GPUDrive. Who asked knows which.
Seen = Any

#: Other road users, lane points and signals that are seen, the nearest first. Rows beyond those there are zero.
OTHERS, LANE_POINTS, SIGNALS = 16, 64, 4
#: Metres within which lane points and other road users are seen.
SEEN_M = 80.0
#: Metres between two lane points.
SPACING_M = 2.0
#: States of a signal that forbid passing, and those that warn.
_STOP, _CAUTION = {"stop", "arrow_stop", "flashing_stop"}, {"caution", "arrow_caution", "flashing_caution"}
_TYPES = ["vehicle", "pedestrian", "cyclist"]

#: Shapes and columns of the parts of an observation.
#:
#: ``own``: speed, length, width, acceleration and curvature of the last step.
#: ``goal``: ahead, left, distance, turn to the goal's heading, seconds left.
#: ``others``: ahead, left, cosine and sine of the relative heading, relative velocity ahead and left, length, width.
#: ``lanes``: ahead, left, cosine and sine of the lane's relative direction, speed limit (0 where unknown).
#: ``signals``: ahead, left of the stop position, 1 for red, 1 for amber.
SHAPES: dict[str, tuple[int, ...]] = {
    "own": (5,),
    "goal": (5,),
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
        self._lanes = _lane_points(document["map"].get("lanes", []))
        signals = [signal for signal in document.get("signals", []) if signal.get("stop_m")]
        # Recorded points have a height too.
        self._stops = np.array([signal["stop_m"][:2] for signal in signals], dtype=float).reshape(-1, 2)
        self._states = [[(int(step), str(state)) for step, state in signal["states"]] for signal in signals]
        self._sizes = {a["id"]: (a["length_m"], a["width_m"]) for a in document["agents"]}

    def size(self, id: str) -> tuple[float, float]:
        """Length and width of a road user."""
        return self._sizes[id]

    def observation(
        self, id: str, step: Step, goal: State, left_s: float, action: tuple[float, float], collided: bool
    ) -> Seen:
        """What ``id`` sees at the end of a step; ``action`` are acceleration and curvature of that step, ``collided``
        whether it met another in it."""
        own = step[id]
        frame = Frame(own)
        to_goal = frame.places(np.array([[goal.x_m, goal.y_m]]))[0]
        turn = float(wrapped(goal.heading_rad - own.heading_rad))
        length_m, width_m = self._sizes[id]
        seen = {
            "own": [own.speed_mps, length_m, width_m, *action],
            "goal": [*to_goal, float(np.hypot(*to_goal)), turn, left_s],
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
        if not len(self._lanes):
            return rows
        away = self._lanes[:, :2] - (own.x_m, own.y_m)
        squares = np.einsum("ij,ij->i", away, away)
        within = np.flatnonzero(squares <= SEEN_M**2)
        nearest = within[np.argsort(squares[within], kind="stable")[:LANE_POINTS]]
        points = self._lanes[nearest]
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


def wrapped(angle: Any) -> Any:
    """Angles within [-pi, pi)."""
    return (angle + np.pi) % (2 * np.pi) - np.pi


def flat(points: Any) -> NDArray[np.float64]:
    """Points without their heights, which recordings have."""
    return np.asarray(points, dtype=float)[:, :2]


def _lane_points(lanes: list[dict[str, Any]]) -> NDArray[np.float64]:
    """Points along the lanes of motor vehicles: x, y, direction, speed limit."""
    parts = [np.zeros((0, 4))]
    for lane in lanes:
        if lane.get("type") == "bike_lane":
            continue
        line = flat(lane["points_m"])
        edges = np.diff(line, axis=0)
        lengths = np.hypot(edges[:, 0], edges[:, 1])
        along = np.concatenate([[0.0], np.cumsum(lengths)])
        at = np.arange(0.0, along[-1], SPACING_M)
        edge = np.clip(np.searchsorted(along, at, side="right") - 1, 0, len(edges) - 1)
        heading = np.arctan2(edges[edge, 1], edges[edge, 0])
        limit = np.full(len(at), lane.get("speed_limit_mps") or 0.0)
        parts.append(
            np.column_stack([np.interp(at, along, line[:, 0]), np.interp(at, along, line[:, 1]), heading, limit])
        )
    return np.concatenate(parts)
