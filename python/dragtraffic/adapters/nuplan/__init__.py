"""nuPlan: these road users as the traffic of its simulation, and its planners in a run of these.

:class:`ReactingAgents` is an observation of nuPlan: its planner drives there, the engine drives the others.
:class:`NuplanDriver` lets a planner of nuPlan drive here, with :func:`dragtraffic.drive`. :func:`scene_of` gives a scenario
of nuPlan as a scene. Needs the devkit (``nuplan``), which is not on PyPI.
"""

from ._observation import ReactingAgents
from ._planner import NuplanDriver
from ._scene import scene_of

__all__ = ["NuplanDriver", "ReactingAgents", "scene_of"]
