"""Scenes from above, with matplotlib."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ._motion import chosen, flat, poses

if TYPE_CHECKING:
    from matplotlib.animation import FuncAnimation
    from matplotlib.axes import Axes

    from ._scene import Scene

COLOURS = {"vehicle": "#2563eb", "pedestrian": "#c2410c", "cyclist": "#0f766e"}
GREY = "#8a8f98"


def plot(scene: Scene, ax: Axes | None, *, modes: bool) -> Axes:
    """See ``Scene.plot``."""
    from matplotlib.patches import Polygon

    ax = _ground(scene, ax)
    document = scene._peek()
    frame = scene.to_frame()
    frame = frame[frame["valid"]]
    made = set(frame.loc[frame["source"] == "generated", "agent_id"])
    keys = ["agent_id", "type", "source", "mode"]
    for (agent, kind, source, _), rows in frame.groupby(keys, sort=False, dropna=False):
        picked = bool(rows["chosen"].iloc[0])
        colour = COLOURS.get(str(kind), GREY)
        if source == "log":
            style: dict[str, Any] = {"color": GREY, "lw": 0.8, "ls": "--" if agent in made else "-"}
        elif picked:
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
    shown = frame[frame["agent_id"].isin(made)] if made else frame
    _look_at(shown[["x_m", "y_m"]].to_numpy(), ax)
    ax.set_title(scene.name)
    return ax


def animate(scene: Scene, path: str | os.PathLike[str] | None, ax: Axes | None, *, fps: float) -> FuncAnimation:
    """See ``Scene.animate``."""
    from matplotlib.animation import FFMpegWriter, FuncAnimation, PillowWriter
    from matplotlib.patches import Polygon

    pictures = path is not None and Path(path).suffix.lower() in (".gif", ".webp")
    if path is not None and not pictures and not FFMpegWriter.isAvailable():
        raise ValueError(f"{path}: this needs ffmpeg on the path; .gif and .webp do not")
    ax = _ground(scene, ax)
    document, motion, made = scene._peek(), poses(scene), chosen(scene)
    boxes: dict[str, tuple[Polygon, float, float]] = {}
    for agent in document["agents"]:
        id, colour = str(agent["id"]), COLOURS.get(agent["type"], GREY)
        face = colour if id in made else "white"
        box = Polygon(np.zeros((4, 2)), closed=True, facecolor=face, edgecolor=colour, lw=0.8, zorder=4)
        ax.add_patch(box)
        boxes[id] = (box, agent["length_m"], agent["width_m"])
    _look_at(np.concatenate([rows[:, :2] for id, rows in motion.items() if id in made or not made]), ax)
    step_s = document["time"]["step_s"]

    def show(step: int) -> list[Any]:
        for id, (box, length, width) in boxes.items():
            x, y, heading = motion[id][step].tolist()
            box.set_visible(not np.isnan(x))
            if box.get_visible():
                box.set_xy(_corners(x, y, heading, length, width))
        return [ax.set_title(f"{scene.name}   {step * step_s:.1f} s"), *(box for box, _, _ in boxes.values())]

    steps = max(map(len, motion.values()), default=0)
    every = max(1, round(1 / (fps * step_s)))
    figure = ax.get_figure(root=True)
    assert figure is not None
    film = FuncAnimation(figure, show, range(0, steps, every), interval=1e3 * every * step_s)
    if path is not None:
        rate = 1 / (every * step_s)
        film.save(Path(path), PillowWriter(fps=rate) if pictures else FFMpegWriter(fps=rate))
    return film


def _ground(scene: Scene, ax: Axes | None) -> Axes:
    """Axes with the map."""
    import matplotlib.pyplot as plt

    if ax is None:
        _, ax = plt.subplots(figsize=(8, 8))
    _draw_map(scene._peek()["map"], ax)
    ax.set_aspect("equal")
    ax.set_xlabel("x, metres")
    ax.set_ylabel("y, metres")
    return ax


def _look_at(places: Any, ax: Axes) -> None:
    """Shows a square about these places, shape [n, 2], at least 80 m wide."""
    places = places[~np.isnan(places).any(axis=1)]
    if not len(places):
        return
    low, high = places.min(axis=0), places.max(axis=0)
    half = max(40.0, float((high - low).max()) / 2 + 15.0)
    x, y = (low + high) / 2
    ax.set_xlim(x - half, x + half)
    ax.set_ylim(y - half, y + half)


def _draw_map(of: dict[str, Any], ax: Axes) -> None:
    from matplotlib.patches import Polygon

    for area in of.get("drivable", []):
        ring = flat(area["polygon_m"])
        ax.add_patch(Polygon(ring, closed=True, facecolor="#eceef1", edgecolor="none", zorder=0))
    for crossing in of.get("crosswalks", []):
        ring = flat(crossing["polygon_m"])
        ax.add_patch(Polygon(ring, closed=True, facecolor="none", edgecolor="#c9cdd3", hatch="//", zorder=1))
    lines = [("road_edges", "#5b616b", 1.2), ("road_lines", "#c9cdd3", 0.7), ("lanes", "#dfe2e7", 0.7)]
    for member, colour, width in lines:
        for line in of.get(member, []):
            points = flat(line["points_m"])
            ax.plot([x for x, _ in points], [y for _, y in points], color=colour, lw=width, zorder=1)


def _corners(x: float, y: float, heading: float, length: float, width: float) -> list[tuple[float, float]]:
    from math import cos, sin

    ahead, aside = (cos(heading), sin(heading)), (-sin(heading), cos(heading))
    halves = [(length / 2, width / 2), (-length / 2, width / 2), (-length / 2, -width / 2), (length / 2, -width / 2)]
    return [(x + a * ahead[0] + b * aside[0], y + a * ahead[1] + b * aside[1]) for a, b in halves]
