"""Drives: planners among road users that react, in Python and as a command."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import dragtraffic
import numpy
import pytest
from dragtraffic import DragTrafficError, Run, Scene, State, Step, _drive

ROOT = Path(__file__).resolve().parents[2]
CROSSING = ROOT / "assets/scenes/demo-crossing.json"
IDM = f"{ROOT}/python/examples/idm.py:Idm"


@pytest.fixture(scope="module")
def scene() -> Scene:
    return dragtraffic.open(CROSSING)


def standing(scene: Scene, ego: str) -> _drive.Planner:
    """A planner that stops at once, and says so."""

    def plan(step: Step) -> tuple[State, list[State]]:
        me = step[ego]
        still = State(me.x_m, me.y_m, me.heading_rad, 0.0, 0.0)
        return still, [still] * 90

    return plan


def test_a_film_has_what_was_driven(scene: Scene) -> None:
    driven = dragtraffic.drive(scene, _drive.found(IDM), "4", seconds=4.0, seed=1)
    assert driven.egos == ["4"] and len(driven.steps) == 41
    document = driven.film.document
    assert document["time"]["steps"] == 41 and not document.get("generated")
    tracks = {agent["id"]: agent["track"] for agent in document["agents"]}
    for id in driven.steps[0].ids:
        states = numpy.array([step[id] for step in driven.steps if id in step])
        seen = slice(0, len(states))
        assert tracks[id]["x_m"][seen] == pytest.approx(states[:, 0], abs=1e-3)
        assert tracks[id]["vy_mps"][seen] == pytest.approx(states[:, 4], abs=1e-3)
    moved = numpy.hypot(tracks["4"]["x_m"][-1] - tracks["4"]["x_m"][0], tracks["4"]["y_m"][-1] - tracks["4"]["y_m"][0])
    assert 10 < moved < 40, "it drives along its lane"
    assert not [fault for fault in driven.faults if fault["agent"] == "4"]
    again = dragtraffic.drive(scene, _drive.found(IDM), 4, seconds=4.0, seed=1)
    assert again.film.document == document, "equal planners and seeds give equal films"


def test_a_film_of_a_recording_keeps_whom_it_names(scene: Scene) -> None:
    document = scene.document
    meta = {**document["meta"], "objects_of_interest": ["2", "4"], "tracks_to_predict": [["2", 1], ["4", 2]]}
    recording = Scene({**document, "meta": meta})
    kept = _drive.film(recording, [Run(recording).step()]).document["meta"]
    assert kept["objects_of_interest"] == ["2", "4"] and kept["tracks_to_predict"] == [["2", 1], ["4", 2]]


def test_the_others_react_to_a_planner(scene: Scene) -> None:
    driven = dragtraffic.drive(scene, standing, ["4", "2"], seconds=5.0)
    first, last = driven.steps[0], driven.steps[-1]
    for ego in driven.egos:
        assert last[ego][:2] == pytest.approx(first[ego][:2]) and last[ego].speed_mps == 0
    assert driven.reactions and {change["reaction"]["cause"] for change in driven.reactions} <= {"2", "4"}
    lines = _drive.told(driven)
    assert lines[0].startswith("4: 5.0 s, 0.0 m") and len(lines) == 2 + len(driven.faults) + len(driven.reactions)


def test_a_drive_that_begins_later_keeps_the_recording_before(scene: Scene) -> None:
    driven = dragtraffic.drive(scene, standing, "4", seconds=1.0, start_s=2.0)
    document = driven.film.document
    assert document["time"]["steps"] == 31
    before = next(agent["track"] for agent in scene.document["agents"] if agent["id"] == "4")
    track = next(agent["track"] for agent in document["agents"] if agent["id"] == "4")
    assert track["x_m"][:20] == pytest.approx(before["x_m"][:20], abs=1e-3)
    assert track["x_m"][21:] == pytest.approx([track["x_m"][21]] * 10, abs=1e-3)


def test_what_cannot_be_driven_is_refused(scene: Scene) -> None:
    with pytest.raises(DragTrafficError):
        dragtraffic.drive(scene, standing, "nobody")
    nobody = Scene({**scene.document, "agents": [{**a, "role": None} for a in scene.document["agents"]]})
    with pytest.raises(ValueError, match="role ego"):
        dragtraffic.drive(nobody, standing)
    for seconds in (0.0, -1.0, 60.0):
        with pytest.raises(ValueError, match="seconds expected"):
            dragtraffic.drive(scene, standing, "4", seconds=seconds)
    with pytest.raises(ValueError):
        dragtraffic.drive(scene, lambda *_: lambda step: (1.0, 2.0, 3.0), "4", seconds=0.2)
    for name in ("idm", ":Idm", "no_such_module:Idm", f"{ROOT}/none.py:Idm", f"{ROOT}/python/examples/idm.py:None_"):
        with pytest.raises(ValueError, match="--planner"):
            _drive.found(name)


def test_the_command_writes_a_scene_and_a_film(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    common = [str(CROSSING), "--planner", IDM, "--ego", "4", "--seconds", "1.5"]
    command = [sys.executable, "-m", "dragtraffic", "drive", *common, "--film", "out.gif"]
    environment = {"PYTHONPATH": f"{ROOT}/python", "PATH": "/usr/bin:/bin", "MPLBACKEND": "agg", "HOME": str(tmp_path)}
    made = subprocess.run(command, capture_output=True, text=True, env=environment)
    assert made.returncode == 0, made.stderr
    assert made.stdout.startswith("4: 1.5 s, ") and "written: demo-crossing-driven.json" in made.stdout
    assert dragtraffic.open("demo-crossing-driven.json").duration_s == pytest.approx(1.5)
    assert Path("out.gif").read_bytes()[:3] == b"GIF"
    assert _drive.main(common) == 8, "a file that exists is kept"
    assert _drive.main([*common, "--force"]) == 0
    refused = [[*common[:1], "--planner", "none:Idm"], [*common[:3], "--ego", "nobody"], ["none.json", *common[1:]]]
    for arguments in refused:
        assert _drive.main([*arguments, "-o", "new.json"]) == 3
    assert not Path("new.json").exists()


def test_the_editor_opens_the_film(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    opened: list[str] = []

    def look(url: str) -> None:
        opened.append(url)
        raise KeyboardInterrupt

    film = tmp_path / "film.json"
    film.write_bytes(CROSSING.read_bytes())
    monkeypatch.setattr("webbrowser.open", look)
    monkeypatch.setenv("PYTHONPATH", f"{ROOT}/python")
    monkeypatch.setenv("HOME", str(tmp_path))
    assert _drive._show(film) == 0
    assert "?scene=" in opened[0] and json.loads(film.read_text())["agents"]
