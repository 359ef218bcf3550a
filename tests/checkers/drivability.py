# /// script
# requires-python = ">=3.10"
# dependencies = ["commonroad-io==2024.3", "commonroad-drivability-checker==2025.3.1"]
# ///
"""Trajectories that we make, in CommonRoad's drivability checker: cars are driven by the kinematic single-track model
of one, and who collides there collides in our score, and the other way round. Called with the program and a folder.
"""

import json
import math
import pathlib
import subprocess
import sys

# A script beside this one has the name of the package.
del sys.path[0]
import numpy
from commonroad.common.file_reader import CommonRoadFileReader
from commonroad.common.solution import VehicleType
from commonroad.scenario.state import KSState
from commonroad.scenario.trajectory import Trajectory
from commonroad_dc import pycrcc
from commonroad_dc.feasibility.feasibility_checker import trajectory_feasibility
from commonroad_dc.feasibility.vehicle_dynamics import VehicleDynamics

PROGRAM, FOLDER = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
STEP_S = 0.1
# The point of a car that goes where it heads lies so many lengths behind its middle.
REAR = 0.3
# Cars of each scene that are driven, and steps of each.
CARS, STEPS = 8, 60
# Boxes that overlap by less may be told apart or not.
DEEP_M = 0.02
CAR = VehicleDynamics.KS(VehicleType.BMW_320i)
WHEELBASE_M = CAR.parameters.a + CAR.parameters.b
results = []


def check(name, holds, why=""):
    results.append(bool(holds))
    if not holds:
        print(f"FAILED {name}: {why}")


def run(*arguments):
    command = [str(PROGRAM), "-q", *map(str, arguments)]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def states(obstacle):
    """All states of an obstacle, from its first on."""
    return [obstacle.initial_state, *obstacle.prediction.trajectory.state_list]


def driven(obstacle):
    """The way of a car with the steering that its turns take. The checker puts the rear axle of the model behind the
    middle of each state, as far as that of its own car."""
    found = []
    rows = states(obstacle)
    for state, after in zip(rows, rows[1:]):
        heading, turn = state.orientation, math.remainder(after.orientation - state.orientation, math.tau)
        back_m = REAR * obstacle.obstacle_shape.length - CAR.parameters.b
        back = back_m * numpy.array([math.cos(heading), math.sin(heading)])
        # Along the heading all points of a body are as fast as each other.
        speed = state.velocity * math.cos(getattr(state, "slip_angle", None) or 0.0)
        middle = speed + (after.velocity - state.velocity) / 2
        steering = math.atan(WHEELBASE_M * turn / (middle * STEP_S)) if abs(middle) > 0.1 else 0.0
        found.append(KSState(position=state.position - back, orientation=heading, velocity=speed,
                             steering_angle=steering, time_step=state.time_step))
    return found


def feasible(name, obstacles):
    """Futures of cars are accepted; the same with a jump sideways are not."""
    cars = [o for o in obstacles if o.obstacle_type.value == "car" and len(states(o)) > STEPS]
    moving = [o for o in cars if max(abs(state.velocity) for state in states(o)) > 2.0][:CARS]
    check(f"{name}: cars move", len(moving) > 1, len(moving))
    for i, car in enumerate(moving):
        way = driven(car)[:STEPS]
        accepted, inputs = trajectory_feasibility(Trajectory(way[0].time_step, way), CAR, STEP_S)
        check(f"{name}: car {car.obstacle_id}", accepted, f"at step {inputs.final_state.time_step}")
        if i == 0:
            left = numpy.array([-math.sin(way[9].orientation), math.cos(way[9].orientation)])
            way[9].position = way[9].position + 0.1 * left
            accepted, _ = trajectory_feasibility(Trajectory(way[0].time_step, way[:12]), CAR, STEP_S)
            check(f"{name}: a jump is seen", not accepted)


def box(obstacle, state, less_m=0.0):
    shape = obstacle.obstacle_shape
    sides = (max(shape.length / 2 - less_m, 0.01), max(shape.width / 2 - less_m, 0.01))
    return pycrcc.RectOBB(*sides, state.orientation, *state.position)


def colliding(obstacles, less_m=0.0):
    """Pairs of obstacles, by their places, whose boxes overlap at a step."""
    found, known = set(), [{state.time_step: state for state in states(o)} for o in obstacles]
    for i in range(len(obstacles)):
        for j in range(i):
            for step in known[i].keys() & known[j].keys():
                a, b = known[i][step], known[j][step]
                if numpy.abs(a.position - b.position).max() < 30:
                    if box(obstacles[i], a, less_m).collide(box(obstacles[j], b, less_m)):
                        found.add((j, i))
                        break
    return found


def collisions(name, path, scene, obstacles):
    """Pairs of the checker and of our score are the same."""
    score = json.loads(run("score", path, "--json").splitlines()[0])["scene"]
    places = {agent["id"]: i for i, agent in enumerate(scene["agents"])}
    told = [tuple(sorted((places[c["a"]], places[c["b"]]))) for c in score["collisions"] + score["overlaps"]]
    deep, touching = colliding(obstacles, DEEP_M), colliding(obstacles)
    check(f"{name}: what collides there collides here", deep <= set(told), deep - set(told))
    check(f"{name}: what collides here collides there", set(told) <= touching, set(told) - touching)
    return len(touching)


def put_in_the_way(scene):
    """A car stands where another one gets to: filled scenes have no collision of their own."""
    futures = scene["generated"]["samples"][0]["agents"]
    shown = {name: future["modes"][future["chosen"]] for name, future in futures.items()}
    way = lambda m: math.hypot(m["x_m"][-1] - m["x_m"][0], m["y_m"][-1] - m["y_m"][0])
    farthest, *_, nearest = sorted(shown, key=lambda name: -way(shown[name]))
    track = next(agent["track"] for agent in scene["agents"] if agent["id"] == nearest)
    for member in ("x_m", "y_m", "heading_rad", "vx_mps", "vy_mps"):
        place = 0.0 if member.startswith("v") else shown[farthest][member][-1]
        for states in (shown[nearest], track):
            states[member] = [place] * len(states[member])


def read(made):
    """A scene, and its obstacles as another reader has them."""
    file = made.with_suffix(".xml")
    run("convert", made, "--to", "commonroad", "-o", file, "--force")
    return json.loads(made.read_text()), CommonRoadFileReader(str(file)).open()[0].dynamic_obstacles


def main():
    met = 0
    for template, density in (("straight", 30), ("merge", 30), ("three-arms", 40), ("four-arms", 40)):
        drawn, filled, made = (FOLDER / f"{template}{end}.json" for end in ("-map", "-filled", ""))
        run("map", "--template", template, "-o", drawn, "--force")
        run("place", drawn, "--density", density, "--types", "vehicle=1", "--seed", "3", "-o", filled, "--force")
        run("generate", filled, "--seed", "6", "-o", made, "--force")
        scene, obstacles = read(made)
        check(f"{template}: obstacles", len(obstacles) == len(scene["agents"]))
        feasible(template, obstacles)
        met += collisions(template, made, scene, obstacles)
    put_in_the_way(scene)
    made = FOLDER / "colliding.json"
    made.write_text(json.dumps(scene))
    met += collisions("a car in the way", made, *read(made))
    check("somebody collides", met > 0)
    failed = results.count(False)
    print(f"{results.count(True)} passed, {failed} failed")
    sys.exit(1 if failed else 0)


main()
