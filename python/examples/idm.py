"""A planner of twenty lines: along the lanes to its goal at 10 m/s, behind whatever is ahead, by the intelligent driver
model.

    dragtraffic drive assets/scenes/demo-crossing.json --planner python/examples/idm.py:Idm --ego 4
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from dragtraffic import Scene, State, Step
from numpy.typing import NDArray


class Idm:
    """Drives one road user of a scene; positions on its path are metres, a point each."""

    def __init__(self, scene: Scene, ego: str) -> None:
        self.ego, self.at = ego, 0.0
        self.lanes = {lane["id"]: lane for lane in scene.document["map"]["lanes"]}
        self.goal = goal(scene, ego)

    def __call__(self, step: Step) -> State:
        me = step[self.ego]
        if step.number == 0:
            self.path = along(self.lanes, me, self.goal)
        others = step.states[[id != self.ego for id in step.ids]]
        apart = np.hypot(others[:, None, 0] - self.path[:, 0], others[:, None, 1] - self.path[:, 1])
        ahead = (apart.min(axis=1, initial=9) < 2) & (apart.argmin(axis=1) > self.at)
        gaps = np.append(apart.argmin(axis=1)[ahead] - self.at - 5, 1e3)
        leads = np.append(np.hypot(others[ahead, 3], others[ahead, 4]), 10.0)
        speed, gap, lead = me.speed_mps, max(gaps.min(), 0.1), leads[gaps.argmin()]
        wanted = 2 + max(0.0, 1.5 * speed + speed * (speed - lead) / 3.5)
        speed = max(0.0, speed + 0.1 * max(-6.0, 1.5 * (1 - (speed / 10) ** 4 - (wanted / gap) ** 2)))
        self.at += 0.1 * speed
        x, y = (np.interp(self.at, range(len(self.path)), column) for column in self.path.T)
        dx, dy = self.path[int(self.at) + 1] - self.path[int(self.at)]
        heading = float(np.arctan2(dy, dx))
        return State(float(x), float(y), heading, speed * float(np.cos(heading)), speed * float(np.sin(heading)))


def goal(scene: Scene, ego: str) -> NDArray[np.float64]:
    """Place of the goal of a road user, else of the end of its recording, shape [2]."""
    agent = next(agent for agent in scene.document["agents"] if str(agent["id"]) == ego)
    asked = (agent.get("conditions") or {}).get("goal") or {}
    end = [agent["track"]["x_m"][-1], agent["track"]["y_m"][-1]]
    return np.array(end if asked.get("x_m") is None else [asked["x_m"], asked["y_m"]])


def ways(lanes: dict[str, dict[str, Any]], first: str) -> Iterator[list[str]]:
    """Rows of lanes that follow each other from one on, the short ones first; each lane ends one row."""
    found, row = {first}, 0
    rows = [[first]]
    while row < len(rows):
        yield rows[row]
        following = [id for id in lanes[rows[row][-1]].get("successors", []) if id not in found and id in lanes]
        found.update(following)
        rows.extend([*rows[row], id] for id in following)
        row += 1


def along(lanes: dict[str, dict[str, Any]], me: State, goal: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points a metre apart, shape [n, 2]: from a state along its lane and those that lead nearest to a goal, then the
    first lane after each, and 400 m straight on."""

    def misfit(lane: dict[str, Any]) -> float:
        points = np.array(lane["points_m"])[:, :2]
        away = np.hypot(*(points[:-1] - me[:2]).T)
        dx, dy = (points[1:] - points[:-1])[away.argmin()]
        return float(away.min() + 10 * (1 - np.cos(np.arctan2(dy, dx) - me.heading_rad)))

    def away_m(row: list[str]) -> float:
        return float(np.hypot(*(np.array(lanes[row[-1]]["points_m"])[:, :2] - goal).T).min())

    row = min(ways(lanes, min(lanes.values(), key=misfit)["id"]), key=away_m)
    while following := [id for id in lanes[row[-1]].get("successors", []) if id not in row and id in lanes]:
        row = [*row, following[0]]
    points = np.concatenate([np.array(lanes[id]["points_m"])[:, :2] for id in row])
    own = len(lanes[row[0]]["points_m"])
    points = points[np.hypot(*(points[:own] - me[:2]).T).argmin() + 1 :]
    heading = np.array([np.cos(me.heading_rad), np.sin(me.heading_rad)])
    end = 400 * (points[-1] - points[-2]) / np.hypot(*(points[-1] - points[-2])) if len(points) > 1 else 400 * heading
    points = np.concatenate([[me[:2]], points, [points[-1] + end]] if len(points) else [[me[:2]], [me[:2] + end]])
    metres = np.append(0, np.cumsum(np.hypot(*np.diff(points, axis=0).T)))
    return np.column_stack([np.interp(np.arange(metres[-1]), metres, column) for column in points.T])
