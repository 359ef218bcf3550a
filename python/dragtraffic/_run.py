"""Runs: traffic that is stepped beside road users that you drive."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._scene import AgentId, Scene

#: A state: :class:`State`, or its five numbers in that order.
StateLike = Union["State", Sequence[float], NDArray[np.float64]]
#: States 0.1 s apart, a row each, shape [n, 5].
Plan = Union[Sequence[StateLike], NDArray[np.float64]]

_NONE: NDArray[np.float64] = np.zeros((0, 5))


class State(NamedTuple):
    """Box centre in metres of the scene, heading counter-clockwise from east, velocity of the centre."""

    x_m: float
    y_m: float
    heading_rad: float
    vx_mps: float
    vy_mps: float

    @property
    def speed_mps(self) -> float:
        """Size of the velocity."""
        return float(np.hypot(self.vx_mps, self.vy_mps))


@dataclass(frozen=True)
class Step:
    """Result of a step.

    ``states`` has a row for each of ``ids``, shape [n, 5], float64: x, y, heading, velocity (m, rad, m/s), egos
    included. ``changes`` has the changes of plan with their causes, ``faults`` the collisions and vehicles off the road
    that began in this step, ``entered`` the road users that entered, ``left`` those that left, with the reason:
    docs/runs.md describes them.
    """

    number: int
    time_s: float
    ids: list[str]
    states: NDArray[np.float64]
    changes: list[dict[str, Any]] = field(default_factory=list)
    faults: list[dict[str, Any]] = field(default_factory=list)
    entered: list[str] = field(default_factory=list)
    left: list[dict[str, Any]] = field(default_factory=list)

    def __contains__(self, id: object) -> bool:
        return str(id) in self.ids

    def __getitem__(self, id: AgentId) -> State:
        """State of a present road user; KeyError for any other."""
        try:
            row = self.ids.index(str(id))
        except ValueError:
            raise KeyError(id) from None
        return State(*self.states[row].tolist())


@dataclass(frozen=True)
class Peek:
    """Predicted motion of the others: ``futures`` by id, shape [90, 5], the first state 0.1 s after the present; their
    changes of plan (``changes``), and the first collision of each ego with each other road user (``faults``)."""

    futures: dict[str, NDArray[np.float64]]
    changes: list[dict[str, Any]]
    faults: list[dict[str, Any]]


class Run:
    """Traffic that is stepped beside road users that you drive, the *egos*. The others react to them in the same step.

    ``egos``: ids of the scene. ``step_s`` 0.05 to 0.5; the others replan every ``plan_interval_s``, 0.2 to 5;
    ``start_s`` is the scene time of the start; ``steps`` are refinement steps of each plan, 1 by default. Equal egos
    and seeds give equal steps.

    Raises:
        DragTrafficError: an ego is unknown or absent at the start, or a number is out of its range.
    """

    def __init__(
        self,
        scene: Scene,
        egos: AgentId | Iterable[AgentId] = (),
        *,
        seed: int = 0,
        step_s: float = 0.1,
        plan_interval_s: float = 1.0,
        start_s: float = 0.0,
        steps: int | None = None,
    ) -> None:
        several = [egos] if isinstance(egos, (str, int, np.integer)) else list(egos)
        settings = {
            "egos": [str(id) for id in several],
            "seed": int(seed),
            "step_s": float(step_s),
            "plan_interval_s": float(plan_interval_s),
            "start_s": float(start_s),
        }
        if steps is not None:
            settings["steps"] = int(steps)
        self._of(scene, _native.Run.begin(scene.native(), json.dumps(settings).encode()))

    def _of(self, scene: Scene, run: _native.Run) -> Run:
        self.scene = scene
        self._run = run
        self._present = _step(run.present())
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        return Run.restore, (self.scene, self.snapshot())

    def __repr__(self) -> str:
        present = self._present
        return f"<Run of {self.scene.name!r}: step {present.number}, {len(present.ids)} road users>"

    @property
    def egos(self) -> list[str]:
        """Ids of the road users that you drive, in the order of the scene."""
        return self._run.egos

    @property
    def step_s(self) -> float:
        """Length of a step, seconds."""
        return self._run.step_s

    @property
    def present(self) -> Step:
        """The last step; before the first one, who is there."""
        return self._present

    def step(
        self, egos: Mapping[AgentId, StateLike] | None = None, plans: Mapping[AgentId, Plan] | None = None
    ) -> Step:
        """Makes a step. ``egos``: the state of each ego at its end. ``plans``: what an ego announces, at most 90 states,
        the first 0.1 s after the step; without a plan the others expect it to go on along its lane.

        Raises:
            DragTrafficError: an ego is missing, or a state is out of its range.
            ValueError: a state has not five numbers.
        """
        self._present = _step(self._run.step(*_said(egos or {}, plans or {})))
        return self._present

    @staticmethod
    def step_together(runs: Sequence[Run], egos: Sequence[Mapping[AgentId, StateLike]]) -> list[Step]:
        """Makes a step of each of several runs, on as many threads as there are processors (``RAYON_NUM_THREADS``).
        ``egos``: for each run the state of each ego at its end. The steps are those of :meth:`step`, to the last bit.

        Raises:
            DragTrafficError: as :meth:`step`; then no run is stepped.
            ValueError: there are not as many ``egos`` as runs, or a state has not five numbers.
        """
        said = [_said(states, {}) for states in egos]
        for run, stepped in zip(runs, _native.Run.step_together([run._run for run in runs], said)):
            run._present = _step(stepped)
        return [run._present for run in runs]

    def peek(self, plans: Mapping[AgentId, Plan] | None = None) -> Peek:
        """What the others would do over nine seconds if egos drove these plans; nothing changes. An ego without a plan
        does what it has announced."""
        known = {str(id): _rows(plan) for id, plan in (plans or {}).items()}
        ids, futures, said = self._run.peek(list(known), list(known.values()))
        reply = json.loads(said)
        return Peek(dict(zip(ids, futures)), reply["changes"], reply["faults"])

    def snapshot(self) -> bytes:
        """The run as bytes, without its scene."""
        return self._run.snapshot()

    @classmethod
    def restore(cls, scene: Scene, snapshot: bytes) -> Run:
        """The run of a snapshot, in the scene that it was made in.

        Raises:
            DragTrafficError: the snapshot is damaged, or of another scene.
        """
        return cls.__new__(cls)._of(scene, _native.Run.restore(scene.native(), snapshot))

    def branch(self) -> Run:
        """The same run, which goes its own way from here."""
        run = Run.__new__(Run)._of(self.scene, self._run.branch())
        run._present = self._present
        return run


def _said(
    egos: Mapping[AgentId, StateLike], plans: Mapping[AgentId, Plan]
) -> tuple[list[str], NDArray[np.float64], list[NDArray[np.float64]]]:
    """Egos as the native module takes them."""
    ids = [str(id) for id in egos]
    announced = {str(id): _rows(plan) for id, plan in plans.items()}
    if unknown := announced.keys() - set(ids):
        raise ValueError(f"a plan of {', '.join(sorted(unknown))}, which egos does not name")
    return ids, _rows(list(egos.values())), [announced.get(id, _NONE) for id in ids]


def _rows(states: Plan) -> NDArray[np.float64]:
    """States as the native module takes them."""
    rows = np.asarray(states, dtype=np.float64)
    if rows.size == 0:
        return _NONE
    if rows.ndim != 2:
        raise ValueError(f"states as rows of five numbers expected, found the shape {rows.shape}")
    return rows


def _step(stepped: _native.Stepped) -> Step:
    number, time_s, ids, states, rest = stepped
    if rest is None:
        return Step(number, time_s, ids, states)
    said = json.loads(rest)
    return Step(number, time_s, ids, states, said["changes"], said["faults"], said["entered"], said["left"])
