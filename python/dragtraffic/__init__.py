"""Traffic scenes from Python: open, generate, place, score, step, look.

The engine runs in the process of Python; results are those of the command line and of HTTP, to the last digit. Long
calls leave other threads running and end with Ctrl-C. Units are in the names: metres, seconds, radians.

    >>> import dragtraffic
    >>> scene = dragtraffic.open("assets/scenes/demo-crossing.json")
    >>> turned = scene.generate(goals={"4": dragtraffic.Goal(x_m=2.0, y_m=27.5)}, react=True, seed=7)
    >>> len(turned.score()["scene"]["collisions"])
    0
    >>> run = dragtraffic.Run(scene, seed=7)
    >>> run.step().time_s
    0.1
"""

import os
from typing import TYPE_CHECKING, Any

# The engine's tensors are small: threads of the tensor library cost more than they gain.
os.environ.setdefault("CANDLE_NUM_THREADS", "1")
# Each product of tensors looks up RAYON_NUM_THREADS and, where it is not set, reads the list of processors: a quarter
# of a run's step. It gets the number that other libraries of the process take without it.
_processors = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
os.environ.setdefault("RAYON_NUM_THREADS", str(_processors))

from ._batch import batch  # noqa: E402
from ._conditions import Condition, Goal, Relation, Start, Velocity, Via  # noqa: E402
from ._drive import Drive, drive, film  # noqa: E402
from ._errors import DragTrafficError  # noqa: E402
from ._native import version  # noqa: E402
from ._run import Peek, Run, State, Step  # noqa: E402
from ._scene import Scene, open, open_all  # noqa: E402

if TYPE_CHECKING:
    from ._viewer import Viewer as Viewer

__all__ = [
    "Condition",
    "DragTrafficError",
    "Drive",
    "Goal",
    "Peek",
    "Relation",
    "Run",
    "Scene",
    "Start",
    "State",
    "Step",
    "Velocity",
    "Via",
    "batch",
    "drive",
    "film",
    "open",
    "open_all",
    "version",
]

if not TYPE_CHECKING:

    def __getattr__(name: str) -> Any:
        # The viewer needs packages that only notebooks have; for their sake it is not in __all__.
        if name == "Viewer":
            from ._viewer import Viewer

            return Viewer
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
