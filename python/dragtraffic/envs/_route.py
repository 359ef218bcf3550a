"""The way of a road user to its goal, along the lanes."""

from __future__ import annotations

from heapq import heappop, heappush
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._motion import flat
from .._run import State

Numbers = NDArray[np.float64]

#: Metres between two lane points.
SPACING_M = 2.0
#: A lane point is where a state is within this distance, metres, and this turn, radians.
_NEAR_M, _TURN = 5.0, 1.0
#: Metres that a change of lanes takes, and those that it costs beside.
_CHANGE_M, _CHANGE_COST_M = 10.0, 10.0
#: How much more a metre beside the lanes costs than one along them.
_BESIDE = 5.0
#: Metres of the route before and after the last place where the next one is looked for.
_BEHIND_M, _AHEAD_M = 5.0, 30.0


def wrapped(angle: Any) -> Any:
    """Angles within [-pi, pi)."""
    return (angle + np.pi) % (2 * np.pi) - np.pi


class Lanes:
    """Points along the lanes of motor vehicles, and where one can go from each."""

    def __init__(self, lanes: list[dict[str, Any]]) -> None:
        known = [lane for lane in lanes if lane.get("type") != "bike_lane" and len(lane["points_m"]) > 1]
        parts = [_along(lane) for lane in known]
        first = np.cumsum([0, *map(len, parts)]).tolist()
        #: A row for each point: x, y, direction, speed limit (0 where unknown).
        self.points: Numbers = np.concatenate([np.zeros((0, 4)), *parts])
        self._rows = {str(lane["id"]): range(*first[i : i + 2]) for i, lane in enumerate(known)}
        self._next: list[list[tuple[int, float]]] = [[] for _ in self.points]
        for lane in known:
            self._link(lane)

    def _link(self, lane: dict[str, Any]) -> None:
        rows = self._rows[str(lane["id"])]
        for row in rows[:-1]:
            self._next[row].append((row + 1, SPACING_M))
        for id in map(str, lane.get("successors", [])):
            if id in self._rows and rows:
                ahead = self._rows[id][0]
                away = float(np.hypot(*(self.points[ahead, :2] - self.points[rows[-1], :2])))
                self._next[rows[-1]].append((ahead, away))
        for beside in (*lane.get("left_neighbors", []), *lane.get("right_neighbors", [])):
            others = self._rows.get(str(beside["lane"]), range(0))
            if not others:
                continue
            apart = self.points[rows, None, :2] - self.points[None, others, :2]
            nearest = np.argmin(np.hypot(apart[..., 0], apart[..., 1]), axis=1) + int(_CHANGE_M / SPACING_M)
            for row, at in zip(rows, nearest.tolist()):
                if at < len(others):
                    self._next[row].append((others[at], _CHANGE_M + _CHANGE_COST_M))

    def _at(self, state: State) -> dict[int, float]:
        """Points where a state is, with the cost of getting there; the nearest where there is none."""
        away = np.hypot(self.points[:, 0] - state.x_m, self.points[:, 1] - state.y_m)
        turned = np.abs(wrapped(self.points[:, 2] - state.heading_rad))
        near = np.flatnonzero((away <= _NEAR_M) & (turned <= _TURN)).tolist() or [int(np.argmin(away))]
        return {row: float(_BESIDE * away[row]) for row in near}

    def last_near(self, places: Numbers) -> int:
        """Index of the last of these places that is on the lanes, -1 for none; the last of all without lanes."""
        if not len(self.points):
            return len(places) - 1
        apart = self.points[None, :, :2] - places[:, None]
        near = np.hypot(apart[..., 0], apart[..., 1]).min(axis=1) <= _NEAR_M
        return int(np.flatnonzero(near)[-1]) if near.any() else -1

    def route(self, start: State, goal: State) -> Route:
        """The cheapest way along the lanes; the straight line where these do not lead there."""
        ends = np.array([[start.x_m, start.y_m], [goal.x_m, goal.y_m]])
        way = self.points[self._cheapest(start, goal) if len(self.points) else [], :2]
        # Points behind the start and beyond the goal would lead back.
        for end, sign in ((start, 1.0), (goal, -1.0)):
            apart = way - (end.x_m, end.y_m)
            along = sign * (apart @ (np.cos(end.heading_rad), np.sin(end.heading_rad)))
            way = way[(along > 0) | (np.hypot(apart[:, 0], apart[:, 1]) > _NEAR_M)]
        return Route(np.concatenate([ends[:1], way, ends[1:]]))

    def _cheapest(self, start: State, goal: State) -> list[int]:
        """Points from a start to a goal (Dijkstra's search); none where no lanes lead there."""
        waiting = [(cost, row, -1) for row, cost in self._at(start).items()]
        waiting.sort()
        arrived, end = self._at(goal), len(self.points)
        came: dict[int, int] = {}
        while waiting and end not in came:
            cost, row, before = heappop(waiting)
            if row in came:
                continue
            came[row] = before
            if row in arrived:
                heappush(waiting, (cost + arrived[row], end, row))
            for after, more in self._next[row] if row < end else []:
                heappush(waiting, (cost + more, after, row))
        rows, row = [], came.get(end, -1)
        while row >= 0:
            rows.append(row)
            row = came[row]
        return rows[::-1]


class Route:
    """A line to the goal, and how far along it a road user is."""

    def __init__(self, line: Numbers) -> None:
        steps = np.hypot(*np.diff(line, axis=0).T)
        keep = np.concatenate([[True], steps > 1e-6])
        self._line = line[keep]
        self._along = np.concatenate([[0.0], np.cumsum(steps[keep[1:]])])
        self._at_m = 0.0
        #: Metres between the line and the last place.
        self.aside_m = 0.0

    def left_m(self, state: State) -> float:
        """Metres along the line that are left from here; the place is looked for near the last one."""
        low, high = np.searchsorted(self._along, [self._at_m - _BEHIND_M, self._at_m + _AHEAD_M])
        edges = range(max(int(low) - 1, 0), min(int(high) + 1, len(self._line) - 1))
        if not edges:
            return 0.0
        begin, end = self._line[edges], self._line[edges.start + 1 : edges.stop + 1]
        way = end - begin
        here = np.array([state.x_m, state.y_m])
        share = np.clip(((here - begin) * way).sum(axis=1) / (way * way).sum(axis=1), 0.0, 1.0)
        away = np.hypot(*(begin + share[:, None] * way - here).T)
        nearest = int(np.argmin(away))
        self.aside_m = float(away[nearest])
        length = self._along[edges.start + nearest + 1] - self._along[edges.start + nearest]
        self._at_m = float(self._along[edges.start + nearest] + share[nearest] * length)
        return float(self._along[-1] - self._at_m)

    def ahead(self, count: int, spacing_m: float) -> Numbers:
        """Points ahead of the last place, at most to the goal: x, y, shape [count, 2]."""
        at = np.minimum(self._at_m + spacing_m * np.arange(1, count + 1), self._along[-1])
        return np.column_stack([np.interp(at, self._along, self._line[:, axis]) for axis in (0, 1)])


def _along(lane: dict[str, Any]) -> Numbers:
    """Points along a lane: x, y, direction, speed limit."""
    line = flat(lane["points_m"])
    edges = np.diff(line, axis=0)
    along = np.concatenate([[0.0], np.cumsum(np.hypot(edges[:, 0], edges[:, 1]))])
    at = np.arange(0.0, max(along[-1], SPACING_M / 2), SPACING_M)
    edge = np.clip(np.searchsorted(along, at, side="right") - 1, 0, len(edges) - 1)
    heading = np.arctan2(edges[edge, 1], edges[edge, 0])
    limit = np.full(len(at), lane.get("speed_limit_mps") or 0.0)
    return np.column_stack([np.interp(at, along, line[:, 0]), np.interp(at, along, line[:, 1]), heading, limit])
