"""A planner of twenty lines: along the lanes at 10 m/s, behind whatever is ahead, by the intelligent driver model.

    dragtraffic drive assets/scenes/demo-crossing.json --planner python/examples/idm.py:Idm --ego 4
"""

from __future__ import annotations

from typing import Any

import numpy as np
from dragtraffic import Scene, State, Step
from numpy.typing import NDArray


class Idm:
    """Drives one road user of a scene; positions on its path are metres, a point each."""

    def __init__(self, scene: Scene, ego: str) -> None:
        self.ego, self.at = ego, 0.0
        self.lanes = {lane["id"]: lane for lane in scene.document["map"]["lanes"]}

    def __call__(self, step: Step) -> State:
        me = step[self.ego]
        if step.number == 0:
            self.path = along(self.lanes, me)
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


def along(lanes: dict[str, dict[str, Any]], me: State) -> NDArray[np.float64]:
    """Points a metre apart, shape [n, 2]: from a state along its lane and the first lane after each, 400 m in all."""

    def misfit(lane: dict[str, Any]) -> float:
        points = np.array(lane["points_m"])[:, :2]
        away = np.hypot(*(points[:-1] - me[:2]).T)
        dx, dy = (points[1:] - points[:-1])[away.argmin()]
        return float(away.min() + 10 * (1 - np.cos(np.arctan2(dy, dx) - me.heading_rad)))

    first = min(lanes.values(), key=misfit)
    points, row = np.array(first["points_m"])[:, :2], [first["id"]]
    points = points[np.hypot(*(points - me[:2]).T).argmin() + 1 :]
    while following := [id for id in lanes[row[-1]].get("successors", []) if id not in row]:
        row.append(following[0])
        points = np.concatenate([points, np.array(lanes[row[-1]]["points_m"])[:, :2]])
    heading = np.array([np.cos(me.heading_rad), np.sin(me.heading_rad)])
    end = 400 * (points[-1] - points[-2]) / np.hypot(*(points[-1] - points[-2])) if len(points) > 1 else 400 * heading
    points = np.concatenate([[me[:2]], points, [points[-1] + end]] if len(points) else [[me[:2]], [me[:2] + end]])
    metres = np.append(0, np.cumsum(np.hypot(*np.diff(points, axis=0).T)))
    return np.column_stack([np.interp(np.arange(metres[-1]), metres, column) for column in points.T])
