"""Scenes from above, with matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes

    from ._scene import Scene

COLOURS = {"vehicle": "#2563eb", "pedestrian": "#c2410c", "cyclist": "#0f766e"}
GREY = "#8a8f98"


def plot(scene: Scene, ax: Axes | None, *, modes: bool) -> Axes:
    """See ``Scene.plot``."""
    import matplotlib.pyplot as plt
    from matplotlib.patches import Polygon

    if ax is None:
        _, ax = plt.subplots(figsize=(8, 8))
    document = scene._peek()
    _draw_map(document["map"], ax)
    frame = scene.to_frame()
    frame = frame[frame["valid"]]
    made = set(frame.loc[frame["source"] == "generated", "agent_id"])
    keys = ["agent_id", "type", "source", "mode"]
    for (agent, kind, source, _), rows in frame.groupby(keys, sort=False, dropna=False):
        shown = bool(rows["chosen"].iloc[0])
        colour = COLOURS.get(str(kind), GREY)
        if source == "log":
            style: dict[str, Any] = {"color": GREY, "lw": 0.8, "ls": "--" if agent in made else "-"}
        elif shown:
            style = {"color": colour, "lw": 2.2}
        elif modes:
            style = {"color": colour, "lw": 0.8, "alpha": 0.5}
        else:
            continue
        ax.plot(rows["x_m"], rows["y_m"], zorder=3, **style)
    starts = frame[frame["source"] == "log"].groupby("agent_id", sort=False).first()
    sizes = {agent["id"]: (agent["length_m"], agent["width_m"]) for agent in document["agents"]}
    for agent, row in starts.iterrows():
        colour = COLOURS.get(str(row["type"]), GREY)
        corners = _corners(row["x_m"], row["y_m"], row["heading_rad"], *sizes[str(agent)])
        face = colour if agent in made else "white"
        ax.add_patch(Polygon(corners, closed=True, facecolor=face, edgecolor=colour, lw=0.8, zorder=4))
        if agent in made:
            ax.annotate(str(agent), corners[0], fontsize=8, zorder=5)
    ax.set_aspect("equal")
    _look_at(frame[frame["agent_id"].isin(made)] if made else frame, ax)
    ax.set_xlabel("x, metres")
    ax.set_ylabel("y, metres")
    ax.set_title(scene.name)
    return ax


def _look_at(rows: pandas.DataFrame, ax: Axes) -> None:
    """Shows a square about these places, at least 80 m wide."""
    if rows.empty:
        return
    low, high = rows[["x_m", "y_m"]].min(), rows[["x_m", "y_m"]].max()
    half = max(40.0, float((high - low).max()) / 2 + 15.0)
    x, y = (low + high) / 2
    ax.set_xlim(x - half, x + half)
    ax.set_ylim(y - half, y + half)


def _draw_map(of: dict[str, Any], ax: Axes) -> None:
    from matplotlib.patches import Polygon

    for area in of.get("drivable", []):
        ring = _flat(area["polygon_m"])
        ax.add_patch(Polygon(ring, closed=True, facecolor="#eceef1", edgecolor="none", zorder=0))
    for crossing in of.get("crosswalks", []):
        ring = _flat(crossing["polygon_m"])
        ax.add_patch(Polygon(ring, closed=True, facecolor="none", edgecolor="#c9cdd3", hatch="//", zorder=1))
    lines = [("road_edges", "#5b616b", 1.2), ("road_lines", "#c9cdd3", 0.7), ("lanes", "#dfe2e7", 0.7)]
    for member, colour, width in lines:
        for line in of.get(member, []):
            points = _flat(line["points_m"])
            ax.plot([x for x, _ in points], [y for _, y in points], color=colour, lw=width, zorder=1)


def _flat(points: list[list[float]]) -> list[tuple[float, float]]:
    """The points without their heights, which recordings have."""
    return [(point[0], point[1]) for point in points]


def _corners(x: float, y: float, heading: float, length: float, width: float) -> list[tuple[float, float]]:
    from math import cos, sin

    ahead, aside = (cos(heading), sin(heading)), (-sin(heading), cos(heading))
    halves = [(length / 2, width / 2), (-length / 2, width / 2), (-length / 2, -width / 2), (length / 2, -width / 2)]
    return [(x + a * ahead[0] + b * aside[0], y + a * ahead[1] + b * aside[1]) for a, b in halves]
