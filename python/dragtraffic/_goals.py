"""What a scene says of where its road users were, and where they should get to."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ._run import State


def recorded_steps(agent: Mapping[str, Any]) -> list[int]:
    """Scene steps at which a road user was seen."""
    track = agent["track"]
    first = int(track["first_step"])
    ranges = track.get("valid") or [[first, first + len(track["x_m"])]]
    return [step for begin, end in ranges for step in range(begin, end)]


def recorded_state(agent: Mapping[str, Any], step: int) -> State:
    """The recorded state at a scene step."""
    track = agent["track"]
    return State(*(float(track[name][step - int(track["first_step"])]) for name in State._fields))


def asked_goal(agent: Mapping[str, Any]) -> State:
    """The goal of the conditions, else where the recording ends."""
    goal = (agent.get("conditions") or {}).get("goal") or {}
    last = recorded_state(agent, recorded_steps(agent)[-1])
    if goal.get("x_m") is None:
        return last
    heading, speed = goal.get("heading_rad"), goal.get("speed_mps") or 0.0
    heading = last.heading_rad if heading is None else heading
    return State(goal["x_m"], goal["y_m"], heading, speed * float(np.cos(heading)), speed * float(np.sin(heading)))
