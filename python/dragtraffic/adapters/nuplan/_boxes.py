"""Road users of a scene as agents of nuPlan."""

from __future__ import annotations

from nuplan.common.actor_state.agent import Agent
from nuplan.common.actor_state.oriented_box import OrientedBox
from nuplan.common.actor_state.scene_object import SceneObjectMetadata
from nuplan.common.actor_state.state_representation import StateVector2D

from ..._run import State, Step
from ..._scene import Scene
from ._frames import HEIGHT_M, Origin, pose
from ._scene import KINDS

_TYPES = {kind: type for type, (kind, _) in KINDS.items()}


class RoadUsers:
    """Those of a scene, with its place in nuPlan's map. Their ids are the track tokens, their numbers the track ids."""

    def __init__(self, scene: Scene) -> None:
        document = scene._peek()
        origin = document["meta"].get("origin") or {}
        self.scene = scene
        self.origin: Origin = (origin.get("x_m", 0.0), origin.get("y_m", 0.0))
        self._documents = {str(agent["id"]): (number, agent) for number, agent in enumerate(document["agents"])}

    def agents(self, step: Step, at_us: int, *, without: str) -> list[Agent]:
        """Vehicles, pedestrians and cyclists that are there at the end of a step, except one."""
        there = zip(step.ids, (State(*row) for row in step.states.tolist()))
        found = (self._agent(id, state, at_us) for id, state in there if id != without)
        return [agent for agent in found if agent is not None]

    def _agent(self, id: str, state: State, at_us: int) -> Agent | None:
        number, agent = self._documents[id]
        kind = _TYPES.get(agent["type"])
        if kind is None:
            return None
        size = {"length": agent["length_m"], "width": agent["width_m"], "height": agent.get("height_m") or HEIGHT_M}
        return Agent(
            tracked_object_type=kind,
            oriented_box=OrientedBox(pose(state, self.origin), **size),
            velocity=StateVector2D(state.vx_mps, state.vy_mps),
            metadata=SceneObjectMetadata(
                timestamp_us=at_us,
                token=f"{id}.{at_us}",
                track_id=number,
                track_token=id,
                category_name=agent["type"],
            ),
        )
