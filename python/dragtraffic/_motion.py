"""The motion of a scene as arrays: what is shown at each of its steps."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from ._scene import Scene

Poses = NDArray[np.float64]


def poses(scene: Scene) -> dict[str, Poses]:
    """Places and headings by road user, shape [steps, 3] (m, m, rad), the scene's ``step_s`` apart from its start on.
    NaN where a road user is not there. Chosen futures count before the recording."""
    document, futures = scene._peek(), chosen(scene)
    parts: dict[str, list[tuple[int, Poses]]] = {}
    for agent in document["agents"]:
        id = str(agent["id"])
        parts[id] = [_recorded(agent["track"])]
        if id in futures:
            parts[id].append((int(futures[id]["first_step"]), _rows(futures[id])))
    steps = max([int(document["time"]["steps"]), *(first + len(rows) for all in parts.values() for first, rows in all)])
    return {id: _joined(all, steps) for id, all in parts.items()}


def chosen(scene: Scene) -> dict[str, dict[str, Any]]:
    """The future that is shown of each road user that has one."""
    generated = scene._peek().get("generated") or {}
    samples = generated.get("samples") or [{"agents": {}}]
    shown = samples[generated.get("chosen_sample") or 0]["agents"]
    return {str(id): futures["modes"][futures["chosen"]] for id, futures in shown.items()}


def flat(points: Any) -> NDArray[np.float64]:
    """Points without their heights, which recordings have, shape [n, 2]."""
    return np.asarray(points, dtype=float).reshape(len(points), -1)[:, :2]


def _rows(motion: Mapping[str, Any]) -> Poses:
    columns = [np.asarray(motion[name], dtype=float) for name in ("x_m", "y_m", "heading_rad")]
    return np.column_stack(columns)


def _recorded(track: Mapping[str, Any]) -> tuple[int, Poses]:
    """First step and rows of a track."""
    first, rows = int(track["first_step"]), _rows(track)
    if track.get("valid") is not None:
        seen = np.zeros(len(rows), dtype=bool)
        for begin, end in track["valid"]:
            seen[begin - first : end - first] = True
        rows[~seen] = np.nan
    return first, rows


def _joined(parts: list[tuple[int, Poses]], steps: int) -> Poses:
    rows = np.full((steps, 3), np.nan)
    for first, part in parts:
        begin = max(first, 0)
        rows[begin : first + len(part)] = part[begin - first :]
        if len(parts) > 1 and part is parts[-1][1]:
            # After a chosen future the recording does not go on.
            rows[first + len(part) :] = np.nan
    return rows
