"""Traffic scenes from Python: open, generate, place, score, look.

A thin layer over the program ``dragtraffic``, which comes with the wheel: each call runs it once, so results
are those of the command line, to the last digit. Units are in the names: metres, seconds, radians.

    >>> import dragtraffic
    >>> scene = dragtraffic.open("assets/scenes/demo-crossing.json")
    >>> turned = scene.generate(goals={"4": dragtraffic.Goal(x_m=2.0, y_m=27.5)}, react=True, seed=7)
    >>> len(turned.score()["scene"]["collisions"])
    0
"""

from ._conditions import Condition, Goal, Relation, Start, Velocity, Via
from ._program import DragTrafficError, program, version
from ._scene import Scene, open, open_all

__all__ = [
    "Condition",
    "DragTrafficError",
    "Goal",
    "Relation",
    "Scene",
    "Start",
    "Velocity",
    "Via",
    "open",
    "open_all",
    "program",
    "version",
]
