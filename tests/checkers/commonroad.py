# /// script
# requires-python = ">=3.10"
# dependencies = ["commonroad-io==2024.3", "numpy==1.26.4"]
# ///
"""CommonRoad's own reader and schema over the scenarios that we write: called with the program and a folder."""

import json
import math
import pathlib
import subprocess
import sys

# The package has the name of this script.
del sys.path[0]
import commonroad
import numpy
from commonroad.common.file_reader import CommonRoadFileReader
from lxml import etree

PROGRAM, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])
SCHEMA = pathlib.Path(commonroad.__file__).parent / "scenario_definition/xml_definition_files/XML_commonRoad_XSD.xsd"
# Differences of numbers with six digits behind the point.
OFF = 2e-6
results = []


def check(name, holds, why=""):
    results.append(bool(holds))
    if not holds:
        print(f"FAILED {name}: {why}")


def written(scene, name):
    """A scene as a scenario, and what the program says of it."""
    source, target = FOLDER / f"{name}.json", FOLDER / f"{name}.xml"
    source.write_text(json.dumps(scene))
    command = [PROGRAM, "convert", source, "--to", "commonroad", "-o", target, "--force"]
    subprocess.run(command, check=True, capture_output=True)
    return target


def states(agent):
    """Positions, headings and velocities by step."""
    track = agent.get("track") or {"x_m": []}
    known = track.get("valid", [[0, len(track["x_m"])]])
    first = track.get("first_step", 0)
    rows = zip(track["x_m"], track["y_m"], track.get("heading_rad", []), track.get("vx_mps", []), track.get("vy_mps", []))
    return {first + i: row for i, row in enumerate(rows) if any(a <= i < b for a, b in known)}


def same(name, scene, path):
    """What CommonRoad reads is what the scene has."""
    scenario, problems = CommonRoadFileReader(str(path)).open()
    lanes, crosswalks = scene["map"]["lanes"], scene["map"].get("crosswalks", [])
    network = scenario.lanelet_network
    areas = sum(len(area["polygon_m"]) > 2 for area in crosswalks)
    check(f"{name}: lanes", len(network.lanelets) == len(lanes) + areas, len(network.lanelets))
    for lane, lanelet in zip(lanes, network.lanelets):
        middle = numpy.array([p[:2] for p in lane["points_m"]])
        there = middle.shape == lanelet.center_vertices.shape
        check(f"{name}: lane {lane['id']}", there and numpy.abs(middle - lanelet.center_vertices).max() < OFF)
        ids = {str(network.lanelets[i].lanelet_id): other["id"] for i, other in enumerate(lanes)}
        after = {ids[str(i)] for i in lanelet.successor}
        check(f"{name}: after lane {lane['id']}", after == {i for i in lane.get("successors", []) if i in ids.values()})
    check(f"{name}: polygons", all(lanelet.polygon.shapely_object.area > 0 for lanelet in network.lanelets))
    seen = [agent for agent in scene["agents"] if states(agent)]
    ego = [agent for agent in seen if agent.get("role") == "ego"]
    ego = ego or [agent for agent in seen if agent.get("conditions", {}).get("goal")][:1]
    others = [agent for agent in seen if agent not in ego[:1]]
    check(f"{name}: obstacles", len(scenario.dynamic_obstacles) == len(others), len(scenario.dynamic_obstacles))
    check(f"{name}: problems", len(problems.planning_problem_dict) == len(ego[:1]))
    for agent, obstacle in zip(others, scenario.dynamic_obstacles):
        box = obstacle.obstacle_shape
        check(f"{name}: box of {agent['id']}", abs(box.length - agent["length_m"]) + abs(box.width - agent["width_m"]) < OFF)
        for step, (x, y, heading, vx, vy) in states(agent).items():
            state = obstacle.state_at_time(step)
            if state is None:
                check(f"{name}: {agent['id']} at {step}", False, "nothing there")
                continue
            turned = math.remainder(state.orientation - heading, 2 * math.pi)
            way = state.orientation + (getattr(state, "slip_angle", None) or 0)
            off = math.hypot(state.velocity * math.cos(way) - vx, state.velocity * math.sin(way) - vy)
            near = numpy.abs(state.position - (x, y)).max() < OFF and abs(turned) < OFF and off < 1e-5
            check(f"{name}: {agent['id']} at {step}", near, state)
    for agent, problem in zip(ego[:1], problems.planning_problem_dict.values()):
        x, y, *_ = states(agent)[min(states(agent))]
        check(f"{name}: start of the ego", numpy.abs(problem.initial_state.position - (x, y)).max() < OFF)
        goal = agent.get("conditions", {}).get("goal", {})
        if "x_m" in goal:
            centre = problem.goal.state_list[0].position.center
            check(f"{name}: goal of the ego", numpy.abs(centre - (goal["x_m"], goal["y_m"])).max() < OFF)


def valid(name, path, late):
    """The schema holds; it has no word for who comes after the first step, nor for a scenario without a problem."""
    schema = etree.XMLSchema(etree.parse(str(SCHEMA)))
    schema.validate(etree.parse(str(path)))
    faults = [fault.message for fault in schema.error_log]
    known = ("integerZero", "planningProblem", "{integerZero}")
    unknown = faults if not late else [fault for fault in faults if not any(word in fault for word in known) and "'exact'" not in fault]
    check(f"{name}: schema", not unknown, unknown[:3])


def main():
    scenes = sorted(pathlib.Path("assets/scenes").glob("*.json"))
    check("scenes are there", len(scenes) > 1)
    for path in scenes:
        scene = json.loads(path.read_text())
        file = written(scene, path.stem)
        same(path.stem, scene, file)
        firsts = [min(states(agent), default=0) for agent in scene["agents"]]
        is_problem = any(a.get("role") == "ego" or a.get("conditions", {}).get("goal") for a in scene["agents"])
        valid(path.stem, file, any(firsts) or not is_problem)
        # From the first step on, with a goal: nothing is beside the schema.
        from_first = dict(scene, agents=[agent for agent in scene["agents"] if min(states(agent), default=1) == 0])
        if from_first["agents"]:
            ego = from_first["agents"][0]
            x, y, *_ = states(ego)[0]
            ego["conditions"] = {"goal": {"x_m": x + 20, "y_m": y, "speed_mps": 5, "time_s": 6}}
            ego["role"] = "ego"
            for other in from_first["agents"][1:]:
                other.pop("role", None)
            from_first.pop("generated", None)
            file = written(from_first, f"{path.stem}-first")
            same(f"{path.stem}-first", from_first, file)
            valid(f"{path.stem}-first", file, False)
    failed = results.count(False)
    print(f"{results.count(True)} passed, {failed} failed")
    sys.exit(1 if failed else 0)


main()
