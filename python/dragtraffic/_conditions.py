"""What a user fixes about a road user. Whatever is left out stays free."""

from __future__ import annotations

from dataclasses import dataclass, fields
from numbers import Integral, Real
from typing import Any, Literal


@dataclass(frozen=True, kw_only=True)
class Velocity:
    """A velocity in place of a speed: m/s east and north, or, in a goal, ahead and to the left of the start."""

    x_mps: float | None = None
    y_mps: float | None = None
    ahead_mps: float | None = None
    left_mps: float | None = None


@dataclass(frozen=True, kw_only=True)
class Start:
    """Where a road user starts: box centre in metres of the scene, heading counter-clockwise from east."""

    x_m: float | None = None
    y_m: float | None = None
    heading_rad: float | None = None
    speed_mps: float | None = None
    velocity: Velocity | None = None


@dataclass(frozen=True, kw_only=True)
class Relation:
    """A goal relative to the road user ``to``: a gap ``ahead_m`` or ``behind_m`` of it, ``behind_s`` behind it, or
    ``after_s`` after it was nearest to the goal's own ``x_m`` and ``y_m``. Exactly one of these four is needed."""

    to: str
    ahead_m: float | None = None
    behind_m: float | None = None
    behind_s: float | None = None
    after_s: float | None = None
    slower_mps: float | None = None
    lanes_left: int | None = None


@dataclass(frozen=True, kw_only=True)
class Goal:
    """Where a road user should be at ``time_s`` (the end of the window when free): ``x_m`` and ``y_m`` in the
    scene, or ``ahead_m`` and ``left_m`` (and ``turn_rad``) seen from where it starts, or a ``relation`` to another
    road user."""

    x_m: float | None = None
    y_m: float | None = None
    heading_rad: float | None = None
    ahead_m: float | None = None
    left_m: float | None = None
    turn_rad: float | None = None
    speed_mps: float | None = None
    velocity: Velocity | None = None
    time_s: float | None = None
    may_cross: tuple[str, ...] = ()
    relation: Relation | None = None

    @property
    def frame(self) -> Literal["agent", "scene"]:
        """``agent`` where a field is seen from the start."""
        seen = [self.ahead_m, self.left_m, self.turn_rad]
        if self.velocity is not None:
            seen += [self.velocity.ahead_mps, self.velocity.left_mps]
        return "scene" if all(value is None for value in seen) else "agent"


@dataclass(frozen=True, kw_only=True)
class Via:
    """A place on the way: no farther than ``tolerance_m`` (1 when free), at ``time_s`` where that is fixed."""

    x_m: float
    y_m: float
    tolerance_m: float | None = None
    time_s: float | None = None


@dataclass(frozen=True, kw_only=True)
class Condition:
    """All that is fixed about one road user."""

    goal: Goal | None = None
    start: Start | None = None
    length_m: float | None = None
    width_m: float | None = None
    type: Literal["vehicle", "pedestrian", "cyclist"] | None = None
    via: tuple[Via, ...] = ()

    def document(self) -> dict[str, Any]:
        """As the engine reads it."""
        made = _document(self)
        if self.goal is not None:
            made["frame"] = self.goal.frame
        return made


def _document(value: Any) -> dict[str, Any]:
    """The fields that are fixed, by name."""
    made: dict[str, Any] = {}
    for field in fields(value):
        fixed = getattr(value, field.name)
        if fixed is None or (isinstance(fixed, tuple) and not fixed):
            continue
        made[field.name] = _value(fixed)
    return made


def _value(fixed: Any) -> Any:
    if isinstance(fixed, (Goal, Relation, Start, Velocity, Via)):
        return _document(fixed)
    if isinstance(fixed, (tuple, list)):
        return [_value(part) for part in fixed]
    # A number of numpy or pandas is none of JSON's.
    if isinstance(fixed, Integral):
        return int(fixed)
    return float(fixed) if isinstance(fixed, Real) else fixed
