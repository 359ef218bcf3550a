"""Scenes: open, generate, place, score, tables, plots."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any, cast

import dragtraffic
import numpy
import pandas
import pytest
from dragtraffic import Condition, Goal, Relation, Scene, Start, Velocity, Via
from dragtraffic._motion import poses

ROOT = Path(__file__).resolve().parents[2]
CROSSING = ROOT / "assets/scenes/demo-crossing.json"


@pytest.fixture(scope="module")
def scene() -> Scene:
    return dragtraffic.open(CROSSING)


@pytest.fixture(scope="module")
def turned(scene: Scene) -> Scene:
    return scene.generate(goals={"4": Goal(x_m=2.0, y_m=27.5)}, react=True, seed=7, samples=2)


def test_a_scene_opens(scene: Scene) -> None:
    assert len(scene.agents) == 44 and scene.duration_s == pytest.approx(9.0)
    assert "44 road users" in repr(scene)
    with pytest.raises(dragtraffic.DragTrafficError) as refused:
        dragtraffic.open(ROOT / "pyproject.toml")
    assert refused.value.code == "format-unknown" and "pyproject.toml" in str(refused.value)


def test_goals_are_met_and_others_react(scene: Scene, turned: Scene) -> None:
    assert not scene.samples, "the scene asked stays as it is"
    futures = turned.samples[0]["agents"]["4"]
    shown = futures["modes"][futures["chosen"]]
    assert shown["x_m"][-1] == pytest.approx(2.0, abs=0.05)
    assert shown["y_m"][-1] == pytest.approx(27.5, abs=0.05)
    assert "2" in turned.samples[0]["agents"], "car 2 gives way"
    score = turned.score()
    assert score["scene"]["collisions"] == [] and score["agents"]["4"]["goal_error"]["position_m"] < 0.05
    assert turned.score(1)["agents"].keys() == score["agents"].keys()
    with pytest.raises(IndexError):
        turned.chosen(2)


def test_a_goal_relative_to_another_road_user(scene: Scene) -> None:
    goal = Goal(time_s=5.0, relation=Relation(to="1", behind_m=8.0))
    followed = scene.generate(goals={"5": goal}, seed=7)
    assert followed.document["agents"], "the relation is part of the scene"
    own = next(agent for agent in followed.document["agents"] if agent["id"] == "5")
    assert own["conditions"]["goal"] == {"time_s": 5.0, "relation": {"to": "1", "behind_m": 8.0}}
    with pytest.raises(dragtraffic.DragTrafficError, match="relative to"):
        scene.generate(goals={"4": Goal(relation=Relation(to="nobody", ahead_m=1.0))})


def test_equal_calls_give_equal_scenes(scene: Scene, turned: Scene) -> None:
    again = scene.generate(goals={"4": Goal(x_m=2.0, y_m=27.5)}, react=True, seed=7, samples=2)
    assert again.samples == turned.samples


def test_edits_chain(turned: Scene) -> None:
    more = turned.generate(["7"], seed=7)
    assert more.samples[0]["agents"]["4"] == turned.samples[0]["agents"]["4"]
    alone = turned.generate(["7"], seed=7, kept_futures="forgotten")
    assert set(alone.samples[0]["agents"]) == {"7"}


def test_frames_hold_every_step(turned: Scene) -> None:
    frame = turned.to_frame()
    assert isinstance(frame, pandas.DataFrame)
    wanted = {"scenario_id", "agent_id", "type", "sample", "mode", "probability", "step", "time_s", "x_m", "y_m"}
    wanted |= {"heading_rad", "vx_mps", "vy_mps", "length_m", "width_m", "valid", "source", "chosen"}
    assert wanted <= set(frame.columns)
    ours = frame[(frame["agent_id"] == "4") & (frame["sample"] == 0) & (frame["source"] == "generated")]
    assert ours["mode"].nunique() == 6 and len(ours) == 6 * 90
    shown = ours[ours["chosen"]].iloc[-1]
    assert (shown["x_m"], shown["y_m"], shown["time_s"]) == pytest.approx((2.0, 27.5, 9.0), abs=0.05)
    assert set(frame[frame["source"] == "log"]["agent_id"]) == set(turned.agents)


def test_conditions_in_the_road_users_own_frame(scene: Scene) -> None:
    goal = Goal(ahead_m=20.0, left_m=0.0, velocity=Velocity(ahead_mps=5.0, left_mps=0.0))
    start = Start(speed_mps=3.0)
    condition = Condition(goal=goal, start=start, length_m=6.0, via=(Via(x_m=1.0, y_m=2.0, tolerance_m=5.0),))
    assert condition.document() == {
        "goal": {"ahead_m": 20.0, "left_m": 0.0, "velocity": {"ahead_mps": 5.0, "left_mps": 0.0}},
        "start": {"speed_mps": 3.0},
        "length_m": 6.0,
        "via": [{"x_m": 1.0, "y_m": 2.0, "tolerance_m": 5.0}],
        "frame": "agent",
    }
    made = scene.generate(conditions={"6": condition})
    agent = next(agent for agent in made.document["agents"] if agent["id"] == "6")
    assert agent["conditions"]["length_m"] == 6.0
    with pytest.raises(ValueError, match="6"):
        scene.generate(goals={"6": goal}, conditions={"6": condition})
    with pytest.raises(dragtraffic.DragTrafficError):
        scene.generate(["nobody"])
    with pytest.raises(dragtraffic.DragTrafficError, match="agents"):
        scene.generate([])
    goes_on = scene.generate([], react=True, horizon_s=15.0)
    assert goes_on.samples[0]["agents"], "motion that ends goes on"
    with pytest.raises(dragtraffic.DragTrafficError, match='conditions/6/goal: road user "6" is not in agents'):
        scene.generate(["7"], goals={"6": Goal(x_m=1.0, y_m=2.0)})


def test_numbers_of_numpy_and_ids_that_are_numbers(scene: Scene, turned: Scene) -> None:
    single, whole, seed = cast("tuple[Any, Any, Any]", (numpy.float32(27.5), numpy.int64(9), numpy.int64(7)))
    goal = Goal(x_m=numpy.float64(2.0), y_m=single, time_s=whole)
    assert Condition(goal=goal).document()["goal"] == {"x_m": 2.0, "y_m": 27.5, "time_s": 9}
    goal = Goal(x_m=numpy.float64(2.0), y_m=27.5)
    again = scene.generate(numpy.array([4]), goals={4: goal}, react=True, seed=seed, samples=2)
    assert again.samples == turned.samples
    one = scene.generate("12", react=[])
    assert set(one.samples[0]["agents"]) == {"12"}


def test_a_search_has_tries_that_are_made_again(scene: Scene) -> None:
    ranges = {"agents": ["4"], "goal": {"ahead_m": {"uniform": [10, 40]}, "speed_mps": 4}}
    tries = scene.search("actor.min_ttc_s < 2.5", ranges, tries=5, method="sobol", options={"horizon_s": 4})
    assert [tried["number"] for tried in tries] == list(range(5))
    for tried in tries:
        near = tried["figures"].get("actor.min_ttc_s", 9.0) < 2.5
        assert (tried["outcome"] == "kept") == near == (tried["miss"] == 0.0)
    assert scene.generate_request(tries[0]["request"]).code == tries[0]["code"]
    assert len(scene.search("collisions >= 0", ranges, found=2)) == 2
    with pytest.raises(dragtraffic.DragTrafficError) as refused:
        scene.search("colisions == 0", ranges)
    assert refused.value.errors[0]["pointer"] == "/where"


def test_placing(scene: Scene) -> None:
    placed = scene.place(count=5, types={"vehicle": 1.0}, keep=[], seed=3)
    assert len(placed.agents) == 5
    box = [(-60.0, -60.0), (60.0, -60.0), (60.0, 60.0), (-60.0, 60.0)]
    inside = scene.place(count=3, types={"vehicle": 1.0}, keep=[], region=box)
    first = [agent["track"] for agent in inside.document["agents"]]
    assert first and all(abs(t["x_m"][0]) <= 60 and abs(t["y_m"][0]) <= 60 for t in first)
    later = scene.place(density_per_lane_km=0, start_s=1.0, keep=[])
    assert not later.agents


def test_old_names_of_arguments_are_refused_with_the_new_ones(scene: Scene) -> None:
    generate, place = cast("tuple[Any, Any]", (scene.generate, scene.place))
    with pytest.raises(TypeError, match="replan_s is replan_interval_s now"):
        generate(replan_s=3)
    with pytest.raises(TypeError, match="density_per_km is density_per_lane_km now"):
        place(density_per_km=12)


def test_saving(turned: Scene, tmp_path: Path) -> None:
    turned.save(tmp_path / "a.json")
    assert dragtraffic.open(tmp_path / "a.json").samples == turned.samples
    turned.save(tmp_path / "a.tfrecord", "womd")
    assert dragtraffic.open(tmp_path / "a.tfrecord").agents == turned.agents


def test_a_plot_shows_map_boxes_and_futures(turned: Scene) -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    axes = turned.plot()
    frame = turned.to_frame()
    assert len(axes.lines) > frame["agent_id"].nunique()
    assert len(axes.patches) >= frame[frame["source"] == "log"]["agent_id"].nunique()
    assert {"4", "2"} <= {text.get_text() for text in axes.texts}


def test_a_recording_with_heights_is_plotted(scene: Scene) -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    area = [[-9.0, -9.0, 1.2], [9.0, -9.0, 1.3], [9.0, 9.0, 1.4]]
    lines = {name: scene.document["map"].get(name, []) for name in ("lanes", "road_edges", "road_lines")}
    high = {name: [{**line, "points_m": [[*p[:2], 1.2] for p in line["points_m"]]} for line in lines[name]] for name in lines}
    areas = {"crosswalks": [{"id": "c", "polygon_m": area}], "drivable": [{"id": "d", "polygon_m": area}]}
    recorded = Scene({**scene.document, "map": {**scene.document["map"], **high, **areas}})
    assert len(recorded.plot().patches) >= len(scene.agents)


def test_the_notebook_runs(monkeypatch: pytest.MonkeyPatch) -> None:
    nbformat = pytest.importorskip("nbformat")
    nbclient = pytest.importorskip("nbclient")
    notebook = nbformat.read(ROOT / "python/notebooks/first.ipynb", as_version=4)
    monkeypatch.setenv("PYTHONPATH", str(ROOT / "python"))
    nbclient.NotebookClient(notebook, timeout=120, resources={"metadata": {"path": str(ROOT)}}).execute()
    outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    assert any("image/png" in output.get("data", {}) for output in outputs)
    assert "application/vnd.jupyter.widget-view+json" in outputs[-1]["data"], "the last cell is a viewer"


def test_a_film_shows_who_is_there_and_where(turned: Scene, tmp_path: Path) -> None:
    import matplotlib
    from matplotlib.patches import Polygon
    from PIL import Image

    matplotlib.use("Agg")
    path = tmp_path / "turned.webp"
    film = turned.animate(path, fps=1)
    with Image.open(path) as pictures:
        assert getattr(pictures, "n_frames") == 10, "one a second over nine seconds"
    shown = cast("Any", film)._func(90)
    boxes = [box for box in shown if isinstance(box, Polygon) and box.get_visible()]
    there = [box.get_xy()[:4].mean(axis=0) for box in boxes]
    assert min(numpy.hypot(*(place - (2.0, 27.5))) for place in there) < 0.1, "car 4 is at its goal"
    if not shutil.which("ffmpeg"):
        with pytest.raises(ValueError, match="ffmpeg"):
            turned.animate(tmp_path / "turned.mp4")


def test_motion_is_the_recording_until_a_chosen_future(scene: Scene, turned: Scene) -> None:
    recorded, made = poses(scene), poses(turned)
    assert all(rows.shape == (91, 3) for rows in made.values())
    assert made["4"][0] == pytest.approx(recorded["4"][0]) and made["4"][90, :2] == pytest.approx((2.0, 27.5), abs=0.05)
    still = next(id for id in made if id not in turned.samples[0]["agents"])
    assert numpy.array_equal(made[still], recorded[still], equal_nan=True)
    frame = scene.to_frame()
    seen = frame[frame["valid"]].groupby("agent_id").size()
    assert all((~numpy.isnan(rows[:, 0])).sum() == seen[id] for id, rows in recorded.items())


def test_a_notebook_cell_takes_goals_and_keeps_what_the_engine_refuses(scene: Scene) -> None:
    viewer = dragtraffic.Viewer(scene, seed=7)
    sent: list[Any] = []
    viewer.send = lambda content, buffers=None: sent.append(content)
    assert viewer._motion["futures"] == {} and len(viewer._motion["poses"]["4"]) == 91
    viewer._handle_custom_msg({"kind": "goal", "agent": "4", "x_m": 2.0, "y_m": 27.5}, [])
    assert viewer._motion["futures"]["4"][-1] == pytest.approx([2.0, 27.5], abs=0.05)
    assert viewer._motion["goals"] == {"4": [2.0, 27.5]} and "2" in viewer._motion["futures"], "car 2 gives way"
    before = viewer._motion
    viewer._handle_custom_msg({"kind": "goal", "agent": "4", "x_m": 1e9, "y_m": 0.0}, [])
    assert [bool(message["told"]) for message in sent] == [False, True]
    assert viewer._motion == before and list(viewer.goals) == ["4"]
    for odd in ("goal", {"kind": "else"}, {"kind": "goal", "agent": "nobody", "x_m": 0, "y_m": 0}, {"kind": "goal"}):
        viewer._handle_custom_msg(odd, [])
    assert viewer._motion == before
    json.dumps([viewer._map, viewer._motion], allow_nan=False)


def test_a_part_of_a_map_is_opened(tmp_path: Path) -> None:
    lane = '<edge id="{0}"><lane id="{0}_0" index="0" speed="9" length="900" shape="0,{1} 900,{1}"/></edge>'
    path = tmp_path / "a.net.xml"
    path.write_text(f"<net>{lane.format('near', 0)}{lane.format('far', 500)}</net>")
    part = dragtraffic.open(path, around=(400, 0, 150))
    assert len(part.document["map"]["lanes"]) == 1
    with pytest.raises(dragtraffic.DragTrafficError):
        dragtraffic.open(path, around=(400, 0, 1))


def test_a_recording_is_opened_with_what_lies_beside_it(tmp_path: Path) -> None:
    rows = "".join(f"0,{frame},{frame / 2.5},-2,0,2,5,10,0\n" for frame in range(51))
    for recording in "07", "08":
        head = "trackId,frame,xCenter,yCenter,heading,width,length,xVelocity,yVelocity\n"
        (tmp_path / f"{recording}_tracks.csv").write_text(head + rows)
        (tmp_path / f"{recording}_tracksMeta.csv").write_text("trackId,class\n0,truck_bus\n")
    lane = '<edge id="e"><lane id="e_0" index="0" speed="9" length="900" width="4" shape="-100,-2 800,-2"/></edge>'
    (tmp_path / "place.net.xml").write_text(f"<net>{lane}</net>")
    for scene in (dragtraffic.open(tmp_path / "08_tracks.csv"), dragtraffic.open(tmp_path, index=1)):
        assert scene.name == "08" and scene.document["agents"][0]["subtype"] == "truck"
        assert len(scene.document["map"]["lanes"]) == 1
        said = {warning["code"]: warning["detail"] for warning in scene.warnings}
        assert said["files-beside"].endswith("08_tracksMeta.csv, place.net.xml") and "100%" in said["map-laid"]
    with pytest.raises(dragtraffic.DragTrafficError, match="no scene 2"):
        dragtraffic.open(tmp_path, index=2)
