"""States here and there. nuPlan has the rear axle of the ego, its velocity in its own frame, and map coordinates of a
city; a run has the box centre, velocities in the frame of the scene, and coordinates around its origin."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from nuplan.common.actor_state.ego_state import EgoState
from nuplan.common.actor_state.state_representation import StateSE2, StateVector2D, TimePoint
from nuplan.common.actor_state.vehicle_parameters import VehicleParameters

from ..._run import State

#: Id of the ego in scenes of scenarios.
EGO = "ego"
#: Shares of a car's length: the rear overhang, the wheelbase, the centre of gravity ahead of the rear axle.
_OVERHANG, _WHEELBASE, _GRAVITY = 0.22, 0.6, 0.32
#: Height of a vehicle that has none in the scene, metres.
HEIGHT_M = 1.7

#: Place of a scene's origin in nuPlan's map, metres.
Origin = tuple[float, float]


def centre(ego: EgoState, origin: Origin) -> State:
    """State of the box centre of nuPlan's ego, in the frame of a scene."""
    pose, velocity = ego.center, ego.dynamic_car_state.center_velocity_2d
    cos, sin = np.cos(pose.heading), np.sin(pose.heading)
    vx_mps, vy_mps = velocity.x * cos - velocity.y * sin, velocity.x * sin + velocity.y * cos
    return State(pose.x - origin[0], pose.y - origin[1], pose.heading, float(vx_mps), float(vy_mps))


def ego_state(state: State, at: TimePoint, vehicle: VehicleParameters, origin: Origin) -> EgoState:
    """nuPlan's ego whose box centre has this state. Acceleration, turn rate and steering are not known: zero."""
    cos, sin = np.cos(state.heading_rad), np.sin(state.heading_rad)
    ahead = state.vx_mps * cos + state.vy_mps * sin
    left = state.vy_mps * cos - state.vx_mps * sin
    return EgoState.build_from_center(
        center=pose(state, origin),
        center_velocity_2d=StateVector2D(float(ahead), float(left)),
        center_acceleration_2d=StateVector2D(0.0, 0.0),
        tire_steering_angle=0.0,
        time_point=at,
        vehicle_parameters=vehicle,
    )


def pose(state: State, origin: Origin) -> StateSE2:
    """Place and heading in nuPlan's map."""
    return StateSE2(state.x_m + origin[0], state.y_m + origin[1], state.heading_rad)


def vehicle_of(agent: dict[str, Any]) -> VehicleParameters:
    """A vehicle with the box of a road user and the proportions of a car."""
    length, width, height = agent["length_m"], agent["width_m"], agent.get("height_m")
    return VehicleParameters(
        width=width,
        front_length=length * (1 - _OVERHANG),
        rear_length=length * _OVERHANG,
        cog_position_from_rear_axle=length * _GRAVITY,
        wheel_base=length * _WHEELBASE,
        vehicle_name=str(agent["id"]),
        vehicle_type=str(agent["type"]),
        height=height or HEIGHT_M,
    )


def ahead(known: Sequence[tuple[float, State]], seconds: float) -> State:
    """Where somebody is after some seconds who keeps the turn rate and the acceleration of its last two states."""
    time_s, now = known[-1]
    speed, rate, turn = now.speed_mps, 0.0, 0.0
    if len(known) > 1 and time_s > known[-2][0]:
        before_s, before = known[-2]
        rate = (speed - before.speed_mps) / (time_s - before_s)
        turned = (now.heading_rad - before.heading_rad + np.pi) % (2 * np.pi) - np.pi
        turn = turned / (time_s - before_s)
    after = max(0.0, speed + rate * seconds)
    gone = 0.5 * (speed + after) * seconds
    course = np.arctan2(now.vy_mps, now.vx_mps) if speed > 0 else now.heading_rad
    halfway, end = course + 0.5 * turn * seconds, course + turn * seconds
    return State(
        now.x_m + float(gone * np.cos(halfway)),
        now.y_m + float(gone * np.sin(halfway)),
        now.heading_rad + float(turn * seconds),
        float(after * np.cos(end)),
        float(after * np.sin(end)),
    )
