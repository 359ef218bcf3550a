# /// script
# requires-python = ">=3.10, <3.12"
# dependencies = ["numpy==1.26.4", "scipy==1.13.1"]
# [tool.dragtraffic]
# no-deps = ["metadrive-simulator==0.4.3"]
# ///
"""Python's own loader and MetaDrive's check over the scenarios that we write. It is a check of structure: the assets
that a replay needs are no package. Called with the program and a folder."""

import importlib.machinery
import importlib.util
import json
import pathlib
import pickle
import subprocess
import sys
import types

import numpy

PROGRAM, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])
results = []


def check(name, holds, why=""):
    results.append(bool(holds))
    if not holds:
        print(f"FAILED {name}: {why}")


def description():
    """The class that checks, without the simulator and the pictures that its packages would load."""
    spec = importlib.machinery.PathFinder.find_spec("metadrive")
    folder = pathlib.Path(spec.submodule_search_locations[0])
    for name in ("metadrive", "metadrive.scenario", "metadrive.utils"):
        package = types.ModuleType(name)
        package.__path__ = [str(folder.joinpath(*name.split(".")[1:]))]
        sys.modules[name] = package
    return importlib.import_module("metadrive.scenario.scenario_description").ScenarioDescription


def main():
    checker = description()
    scenes = sorted(pathlib.Path("assets/scenes").glob("*.json"))
    check("scenes are there", len(scenes) > 1)
    for path in scenes:
        scene = json.loads(path.read_text())
        target = FOLDER / f"{path.stem}.pkl"
        command = [PROGRAM, "convert", path, "--to", "scenarionet", "-o", target, "--force"]
        subprocess.run(command, check=True, capture_output=True)
        with target.open("rb") as file:
            scenario = pickle.load(file)
        try:
            checker.sanity_check(scenario, check_self_type=False, valid_check=True)
            check(f"{path.stem}: sanity", True)
        except AssertionError as error:
            check(f"{path.stem}: sanity", False, repr(error)[:300])
        lanes = scene["map"]["lanes"]
        for lane in lanes:
            line = scenario["map_features"][lane["id"]]["polyline"]
            middle = numpy.array([p[:2] for p in lane["points_m"]])
            check(f"{path.stem}: lane {lane['id']}", numpy.abs(line[:, :2] - middle).max() < 1e-3)
            # MetaDrive moves what it has read.
            line += 0
        for agent in scene["agents"]:
            state = scenario["tracks"][agent["id"]]["state"]
            track = agent.get("track") or {"x_m": []}
            first = track.get("first_step", 0)
            for a, b in track.get("valid", [[0, len(track["x_m"])]]):
                here = slice(first + a, first + b)
                near = numpy.abs(state["position"][here, 0] - track["x_m"][a:b]).max(initial=0) < 1e-3
                check(f"{path.stem}: {agent['id']}", near and state["valid"][here].all())
    failed = results.count(False)
    print(f"{results.count(True)} passed, {failed} failed")
    sys.exit(1 if failed else 0)


main()
