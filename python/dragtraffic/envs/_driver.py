"""An ego within an episode, and how it moves."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import gymnasium
import numpy as np
from numpy.typing import NDArray

from .._run import State
from ._route import Route, wrapped

Actions = Literal["acceleration", "state"]

#: Greatest acceleration and braking, m/s2; curvature, 1/m; sideways acceleration, m/s2; speed, m/s.
ACCELERATION_MPS2, BRAKING_MPS2, CURVATURE_PER_M, SIDEWAYS_MPS2, SPEED_MPS = 3.0, 6.0, 0.2, 6.0, 35.0


@dataclass
class Driver:
    """An ego within an episode."""

    id: str
    goal: State
    state: State
    route: Route
    action: tuple[float, float] = (0.0, 0.0)
    reached: bool = False
    collided: bool = False
    over: bool = False

    def distance_m(self) -> float:
        """From the goal, metres."""
        return float(np.hypot(self.goal.x_m - self.state.x_m, self.goal.y_m - self.state.y_m))

    def left_m(self) -> float:
        """Of the way to the goal, metres."""
        return self.route.left_m(self.state)


def drive(driver: Driver, action: NDArray[Any], kind: Actions, dt: float) -> None:
    """Moves an ego by its action: a target state as it is, or shares of the greatest acceleration and curvature along a
    curve of that curvature, whose sideways acceleration is bounded."""
    state = driver.state
    speed = state.speed_mps
    if kind == "state":
        driver.state = State(*(float(number) for number in action))
        driver.action = ((driver.state.speed_mps - speed) / dt, 0.0)
        return
    push, steer = np.clip(np.asarray(action, dtype=float), -1.0, 1.0)
    rate = push * (ACCELERATION_MPS2 if push > 0 else BRAKING_MPS2)
    after = float(np.clip(speed + rate * dt, 0.0, SPEED_MPS))
    middle = 0.5 * (speed + after)
    most = min(CURVATURE_PER_M, SIDEWAYS_MPS2 / max(middle, 1.0) ** 2)
    curvature = float(steer) * most
    turn = middle * curvature * dt
    halfway, heading = state.heading_rad + 0.5 * turn, state.heading_rad + turn
    heading = float(wrapped(heading))
    driver.state = State(
        state.x_m + middle * dt * np.cos(halfway),
        state.y_m + middle * dt * np.sin(halfway),
        heading,
        after * np.cos(heading),
        after * np.sin(heading),
    )
    driver.action = ((after - speed) / dt, curvature)


def action_space(kind: Actions) -> gymnasium.spaces.Box:
    """Shares of acceleration and curvature, or a state: x, y, heading and velocity."""
    if kind == "acceleration":
        return gymnasium.spaces.Box(-1.0, 1.0, (2,), np.float32)
    most = np.array([1e5, 1e5, np.pi, 100.0, 100.0])
    return gymnasium.spaces.Box(-most, most, dtype=np.float64)
