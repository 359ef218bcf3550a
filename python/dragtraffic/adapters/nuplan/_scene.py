"""A scenario of nuPlan as a scene: its map around the ego, its log as recordings, its traffic lights."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from nuplan.common.actor_state.tracked_objects_types import TrackedObjectType
from nuplan.common.maps.maps_datatypes import SemanticMapLayer, TrafficLightStatusType
from nuplan.planning.scenario_builder.abstract_scenario import AbstractScenario

from ..._drive import track_of
from ..._scene import Scene
from ._frames import EGO, Origin, centre

#: Length of a step of scenes, seconds, most steps, most road users, and most points of a line.
_STEP_S, _MOST_STEPS, _MOST_AGENTS, _MOST_POINTS = 0.1, 600, 256, 4096
#: Shortest distance of two points of a lane that are kept, metres.
_APART_M = 1.0
#: Narrowest and widest lane that its area is believed, metres.
_NARROW_M, _WIDE_M = 2.0, 6.0
#: Type and subtype of those that the engine drives; all else stands.
KINDS = {
    TrackedObjectType.VEHICLE: ("vehicle", "car"),
    TrackedObjectType.PEDESTRIAN: ("pedestrian", "adult"),
    TrackedObjectType.BICYCLE: ("cyclist", "bicycle"),
}
_STANDS = ("other", "unknown")
_LIGHTS = {
    TrafficLightStatusType.GREEN: "go",
    TrafficLightStatusType.YELLOW: "caution",
    TrafficLightStatusType.RED: "stop",
    TrafficLightStatusType.UNKNOWN: "unknown",
}
#: Layers whose areas may be driven on.
_DRIVABLE = (
    SemanticMapLayer.ROADBLOCK,
    SemanticMapLayer.ROADBLOCK_CONNECTOR,
    SemanticMapLayer.INTERSECTION,
    SemanticMapLayer.CARPARK_AREA,
)


def scene_of(scenario: AbstractScenario, *, radius_m: float = 150.0) -> Scene:
    """A scenario as a scene: the map within ``radius_m`` of the ego's start, the log as recordings of 10 Hz, at most 60 s
    and the 256 road users that come nearest. The ego's id is ``ego``, the others have their track tokens; a lane
    connector's id begins with ``c``. The origin of the scene is the ego's start, rounded to metres.

    Cones, barriers and signs are road users of the type ``other``, which stand.

    Raises:
        DragTrafficError: the scenario is no scene, for example since coordinates are not numbers.
    """
    start = scenario.get_ego_state_at_iteration(0)
    origin = (float(round(start.center.x)), float(round(start.center.y)))
    first_us = scenario.get_time_point(0).time_us
    times = np.array([scenario.get_time_point(i).time_us for i in range(scenario.get_number_of_iterations())])
    steps = min(int((times[-1] - first_us) / 1e6 / _STEP_S + 1e-6) + 1, _MOST_STEPS)
    moments = [int(np.argmin(abs(times - first_us - step * _STEP_S * 1e6))) for step in range(steps)]
    mapped = _map(scenario, start.center, radius_m, origin)
    return Scene(
        {
            "format": "dragtraffic.scene",
            "version": 1,
            "id": "nuplan",
            "name": f"{scenario.log_name} {scenario.token}"[:200],
            "meta": {"source": "nuplan", "origin": {"x_m": origin[0], "y_m": origin[1]}},
            "time": {"steps": steps},
            "map": mapped,
            "signals": _signals(scenario, moments, {lane["id"]: lane["points_m"][0] for lane in mapped["lanes"]}),
            "agents": [_ego(scenario, moments, origin), *_others(scenario, moments, origin, radius_m)],
        }
    )


def _ego(scenario: AbstractScenario, moments: list[int], origin: Origin) -> dict[str, Any]:
    moved = [(step, centre(scenario.get_ego_state_at_iteration(i), origin)) for step, i in enumerate(moments)]
    box = scenario.get_ego_state_at_iteration(0).car_footprint
    return {**_road_user(EGO, "vehicle", "car", box), "role": "ego", "track": track_of(moved)}


def _others(
    scenario: AbstractScenario, moments: list[int], origin: Origin, radius_m: float
) -> list[dict[str, Any]]:
    """Road users of the log, those that come nearest to the ego's start first."""
    moved: dict[str, list[tuple[int, Any]]] = {}
    seen: dict[str, Any] = {}
    for step, i in enumerate(moments):
        for one in scenario.get_tracked_objects_at_iteration(i).tracked_objects:
            at, heading, velocity = one.center, one.center.heading, one.velocity
            # Velocities of the log are not known everywhere.
            speeds = [speed if np.isfinite(speed) else 0.0 for speed in (velocity.x, velocity.y)]
            state = [at.x - origin[0], at.y - origin[1], heading, *speeds]
            seen.setdefault(str(one.track_token), one)
            moved.setdefault(str(one.track_token), []).append((step, state))
    away = {id: min(np.hypot(state[0], state[1]) for _, state in states) for id, states in moved.items()}
    near = sorted((id for id in moved if away[id] <= radius_m), key=lambda id: (away[id], id))
    road_users = ((id, seen[id]) for id in near[: _MOST_AGENTS - 1])
    return [
        {**_road_user(id, *KINDS.get(one.tracked_object_type, _STANDS), one.box), "track": track_of(moved[id])}
        for id, one in road_users
    ]


def _road_user(id: str, kind: str, subtype: str, box: Any) -> dict[str, Any]:
    size = {"length_m": float(box.length), "width_m": float(box.width)}
    return {"id": id, "type": kind, "subtype": subtype, **size}


def _map(scenario: AbstractScenario, at: Any, radius_m: float, origin: Origin) -> dict[str, Any]:
    layers = [SemanticMapLayer.LANE, SemanticMapLayer.LANE_CONNECTOR, SemanticMapLayer.CROSSWALK, *_DRIVABLE]
    found = scenario.map_api.get_proximal_map_objects(at.point, radius_m, layers)
    roads = [(str(lane.id), lane) for lane in found[SemanticMapLayer.LANE]]
    joins = [(f"c{lane.id}", lane) for lane in found[SemanticMapLayer.LANE_CONNECTOR]]
    lanes = [
        *(_lane(id, lane, False, dict(roads), dict(joins), origin) for id, lane in roads),
        *(_lane(id, lane, True, dict(roads), dict(joins), origin) for id, lane in joins),
    ]
    crossings = found[SemanticMapLayer.CROSSWALK]
    areas = [(f"{layer.name}.{one.id}", one) for layer in _DRIVABLE for one in found[layer]]
    return {
        "lanes": lanes,
        "crosswalks": [{"id": str(one.id), "polygon_m": _ring(one, origin)} for one in crossings],
        "drivable": [{"id": id, "polygon_m": _ring(one, origin)} for id, one in areas],
    }


def _lane(
    id: str, lane: Any, joins: bool, roads: dict[str, Any], connectors: dict[str, Any], origin: Origin
) -> dict[str, Any]:
    """A lane, or a lane connector, with its links to those around: lanes lead to connectors, and these to lanes."""
    prefix, around = ("", roads) if joins else ("c", connectors)

    def known(edges: Iterable[Any]) -> list[str]:
        return [f"{prefix}{edge.id}" for edge in edges if f"{prefix}{edge.id}" in around]

    line = _line(lane, origin)
    area, length = float(lane.polygon.area), float(lane.baseline_path.length)
    return {
        "id": id,
        "type": "surface_street",
        "points_m": line,
        "width_m": min(max(area / max(length, 1e-3), _NARROW_M), _WIDE_M),
        "speed_limit_mps": lane.speed_limit_mps or None,
        "predecessors": known(lane.incoming_edges),
        "successors": known(lane.outgoing_edges),
        "interpolating": joins,
        **({} if joins else _beside(lane, len(line), roads, origin)),
    }


def _beside(lane: Any, points: int, roads: dict[str, Any], origin: Origin) -> dict[str, Any]:
    """The lanes on the left and on the right that one may change to, all along."""
    sides = {}
    for name, other in zip(("left_neighbors", "right_neighbors"), lane.adjacent_edges):
        if other is not None and str(other.id) in roads:
            last = len(_line(other, origin)) - 1
            sides[name] = [{"lane": str(other.id), "self": [0, points - 1], "other": [0, last]}]
    return sides


def _line(lane: Any, origin: Origin) -> list[list[float]]:
    """The centre line, without points that are close to the one before; the last one stays."""
    points = np.array([[pose.x - origin[0], pose.y - origin[1]] for pose in lane.baseline_path.discrete_path])
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    _, kept = np.unique(np.floor(along / _APART_M), return_index=True)
    inner = [at for at in kept.tolist() if along[-1] - along[at] > _APART_M / 2 or at == 0]
    line: list[list[float]] = points[[*inner[: _MOST_POINTS - 1], -1]].tolist()
    return line


def _ring(area: Any, origin: Origin) -> list[list[float]]:
    """An area's border as an open ring."""
    corners = np.array([corner[:2] for corner in area.polygon.exterior.coords]) - origin
    ring: list[list[float]] = corners[:-1][:_MOST_POINTS].tolist()
    return ring


def _signals(
    scenario: AbstractScenario, moments: list[int], starts: dict[str, list[float]]
) -> list[dict[str, Any]]:
    """Lights of the lane connectors that begin at these places: one stops where its connector begins."""
    told: dict[str, list[list[Any]]] = {}
    for step, i in enumerate(moments):
        now = {f"c{one.lane_connector_id}": one.status for one in scenario.get_traffic_light_status_at_iteration(i)}
        for lane in (known for known in {**told, **now} if known in starts):
            state = _LIGHTS[now.get(lane, TrafficLightStatusType.UNKNOWN)]
            states = told.setdefault(lane, [])
            if not states or states[-1][1] != state:
                states.append([step, state])
    return [{"lane": lane, "stop_m": starts[lane], "states": states} for lane, states in told.items()]
