# /// script
# requires-python = ">=3.10"
# dependencies = ["commonroad-crime==0.4.5"]
# ///
"""Our time to collision beside CriMe's, the criticality measures of CommonRoad, in ten scenes with futures that were
made: they agree within 0.05 s. Called with the program and a folder.

Ours is of two boxes that keep their velocities, wherever they go. CriMe's (`TTC`) is of one behind another in its
lane: the way along the lane between the bumpers by the velocities along it, and by the accelerations, too, where
they differ by more than 0.1 m/s2: they are set to zero in what it has read. It sets the bumpers off to the right
(east) and takes of velocities what goes that way, so a lane has to lead there: each scenario is turned until it does,
which changes neither figure. Then both ask the same where the lane is straight and the boxes are behind each other.
There, and nowhere else, they are held against each other. Ours says nothing of two who both go slower than 0.5 m/s.
"""

import json
import logging
import math
import pathlib
import subprocess
import sys

# A script beside this one has the name of the package.
del sys.path[0]
import numpy
from commonroad_clcs import pycrccosy
from commonroad.common.file_reader import CommonRoadFileReader
from commonroad.scenario.lanelet import LaneletNetwork
from commonroad_crime.data_structure.configuration import CriMeConfiguration
from commonroad_crime.measure import TTC

PROGRAM, FOLDER = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
# Times agree within this, seconds; ours looks so far ahead.
SAME_S, AHEAD_S = 0.05, 8.0
# A lane is straight below this, and two go the same way, radians.
STRAIGHT_RAD, SAME_RAD = 0.002, 0.02
# CriMe works with distances of whole centimetres, so that slower approaches than this, m/s, say little in a time.
CLOSING_MPS = 0.6
# Lanes are turned to lead this far off the east: CriMe takes the mean of directions on both sides of it for west.
LEAST_RAD = 0.001
# A state of CommonRoad has a speed and a heading: who slips aside in a bend by more than this, m/s, has another speed
# along its heading there than here.
SLIP_MPS = 0.01
# Steps from one moment that is looked at to the next, and most moments of a scene.
EVERY, MOST = 2, 12
# Maps with straight lanes, filled by these seeds.
TEMPLATES = {"straight": (3, 4, 5), "merge": (3, 4, 5), "three-arms": (3, 4), "four-arms": (3, 4)}
results = []


def check(name, holds, why=""):
    results.append(bool(holds))
    if not holds:
        print(f"FAILED {name}: {why}")


def run(*arguments):
    command = [str(PROGRAM), "-q", *map(str, arguments)]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def scenes():
    """Ten scenes with futures: maps from templates with traffic."""
    for template, seeds in TEMPLATES.items():
        for seed in seeds:
            drawn, filled, made = (FOLDER / f"{template}-{seed}{end}.json" for end in ("-map", "-filled", ""))
            run("map", "--template", template, "-o", drawn, "--force")
            traffic = ("--density", "30", "--types", "vehicle=1", "--seed", seed)
            run("place", drawn, *traffic, "-o", filled, "--force")
            run("generate", filled, "--seed", seed, "-o", made, "--force")
            yield made


def motion(scene):
    """Box and states by step of each vehicle as it is shown: the chosen future after what was recorded."""
    generated = scene["generated"]
    futures = generated["samples"][generated["chosen_sample"]]["agents"]
    found = []
    for agent in scene["agents"]:
        track, states = agent["track"], {}
        future = futures.get(agent["id"])
        parts = [track] + ([future["modes"][future["chosen"]]] if future else [])
        for part in parts:
            rows = list(zip(*(part[key] for key in ("x_m", "y_m", "heading_rad", "vx_mps", "vy_mps"))))
            for a, b in part.get("valid") or [[0, len(rows)]]:
                states.update({(part.get("first_step") or 0) + i: rows[i] for i in range(a, b)})
        found.append((agent, states))
    return found


def moment(pair, step):
    """Two vehicles as they are at one step, as a scene."""

    def alone(agent, state):
        columns = zip(("x_m", "y_m", "heading_rad", "vx_mps", "vy_mps"), state)
        track = {"first_step": 0, "valid": [[0, 1]]} | {name: [value] for name, value in columns}
        return {key: agent[key] for key in ("id", "type", "length_m", "width_m")} | {"track": track}

    agents = [alone(agent, states[step]) for agent, states in pair]
    time = {"step_s": 0.1, "steps": 1, "now_step": 0}
    return {"format": "dragtraffic.scene", "version": 1, "name": "", "time": time, "map": {"lanes": []}, "agents": agents}


def behind(pair, step):
    """The second is ahead of the first in the same direction and comes nearer; it stays ahead until they meet."""
    (a, of_a), (b, of_b) = pair
    if step not in of_a or step not in of_b:
        return False
    (x, y, heading, vx, vy), (x2, y2, heading2, vx2, vy2) = of_a[step], of_b[step]
    way = numpy.array([math.cos(heading), math.sin(heading)])
    between = numpy.array([x2 - x, y2 - y])
    left = numpy.array([-way[1], way[0]])
    faster = numpy.array([vx - vx2, vy - vy2])
    closing, gap_m = way @ faster, way @ between - (a["length_m"] + b["length_m"]) / 2
    if gap_m < 0.05 or closing < CLOSING_MPS or gap_m / closing > AHEAD_S - SAME_S:
        return False
    aside = max(abs(left @ between), abs(left @ (between - faster * gap_m / closing)))
    turn = abs(math.remainder(heading2 - heading, math.tau))
    slips = max(math.hypot(*v) - abs(way @ v) for v in ((vx, vy), (vx2, vy2)))
    return turn < SAME_RAD and slips < SLIP_MPS and aside < 0.4 * (a["width_m"] + b["width_m"])


class Measured:
    """One vehicle in CriMe, in a scenario that is turned so that its way leads east."""

    def __init__(self, scenario, number):
        configuration = CriMeConfiguration()
        configuration.vehicle.ego_id = number
        configuration.update(sce=scenario)
        self.ttc = TTC(configuration)

    def straight(self, step, other):
        """The line along which CriMe measures is straight from behind the vehicle to ahead of the other one."""
        line = self.ttc.clcs
        ends = [self.ttc.ego_vehicle.state_at_time(step).position, other.state_at_time(step).position]
        try:
            (start, off), (end, off2) = (line.convert_to_curvilinear_coords(*end) for end in ends)
            tangents = [line.tangent(s) for s in numpy.linspace(start - 3, end + 3, 12)]
        except (pycrccosy.CartesianProjectionDomainError, pycrccosy.CurvilinearProjectionDomainLongitudinalError):
            return False
        turned = max(abs(math.atan2(y, x) - LEAST_RAD) for x, y in tangents)
        # CriMe takes the direction of the lane under the first vehicle beside the second one, too, or ends.
        network = self.ttc.sce.lanelet_network
        under = [network.find_lanelet_by_position([end])[0] for end in ends]
        return (
            start < end
            and turned < STRAIGHT_RAD
            and max(abs(off), abs(off2)) < 1.5
            and under[0][:1] == under[1][:1] != []
        )

    def time_s(self, step, number):
        """CriMe's figure at constant velocities; nothing where its line is not straight."""
        self.ttc.set_other_vehicles(number)
        other = self.ttc.other_vehicle
        if not self.straight(step, other):
            return None
        for state in (self.ttc.ego_vehicle.state_at_time(step), other.state_at_time(step)):
            state.acceleration, state.acceleration_y = 0.0, 0.0
        try:
            return self.ttc.compute(number, step, verbose=False)
        except TypeError:
            # CriMe finds no direction of the lane there, as near its ends, and goes on with it.
            return None


def turned(path):
    """The scenario by how far it is turned, each read once."""
    known = {}

    def scenario(heading):
        if heading not in known:
            known[heading], _ = CommonRoadFileReader(str(path)).open(lanelet_assignment=True)
            known[heading].translate_rotate(numpy.zeros(2), LEAST_RAD - heading)
            # What a network finds by place is where it was before it was turned.
            lanelets = known[heading].lanelet_network.lanelets
            known[heading].replace_lanelet_network(LaneletNetwork.create_from_lanelet_list(lanelets))
        return known[heading]

    return scenario


def lane_heading(scenario, state):
    """Where the lane under a vehicle leads, which is about where it goes itself."""
    at, network = numpy.array(state[:2]), scenario.lanelet_network
    for number in network.find_lanelet_by_position([at])[0]:
        line = network.find_lanelet_by_id(number).center_vertices
        middles, ways = (line[1:] + line[:-1]) / 2, line[1:] - line[:-1]
        way = ways[numpy.linalg.norm(middles - at, axis=1).argmin()]
        heading = round(math.atan2(way[1], way[0]), 4)
        if abs(math.remainder(heading - state[2], math.tau)) < SAME_RAD:
            return heading
    return None


def theirs(path, numbers, vehicles):
    """CriMe's times where both ask the same, with pair and step."""
    scenario, measured, found = turned(path), {}, []
    pairs = [(i, j) for i in range(len(vehicles)) for j in range(len(vehicles)) if i != j]
    for i, j in pairs:
        pair = (vehicles[i], vehicles[j])
        for step in filter(lambda step: behind(pair, step), sorted(vehicles[i][1])[::EVERY]):
            heading = lane_heading(scenario(0.0), vehicles[i][1][step])
            if heading is None:
                continue
            if (i, heading) not in measured:
                measured[i, heading] = Measured(scenario(heading), numbers[i])
            value = measured[i, heading].time_s(step, numbers[j])
            found += [] if value is None else [(pair, step, value)]
            if len(found) == MOST:
                return found
    return found


def ours(name, moments):
    """Our times of the same, by the program."""
    folder = FOLDER / f"{name}-moments"
    folder.mkdir(exist_ok=True)
    for i, (pair, step, _) in enumerate(moments):
        (folder / f"{i:04}.json").write_text(json.dumps(moment(pair, step)))
    lines = run("score", folder, "--json").splitlines() if moments else []
    return [json.loads(line)["scene"].get("min_ttc_s") for line in lines]


def main():
    logging.disable(logging.CRITICAL)
    names = [(path.stem, path) for path in scenes()]
    check("ten scenes", len(names) == 10, len(names))
    table = []
    for name, path in names:
        scene = json.loads(path.read_text())
        for agent in scene["agents"]:
            # All are obstacles; one with a role or a goal would be a planning problem.
            agent["role"], agent["conditions"] = None, {}
        path.write_text(json.dumps(scene))
        file = path.with_suffix(".xml")
        run("convert", path, "--to", "commonroad", "-o", file, "--force")
        scenario, _ = CommonRoadFileReader(str(file)).open()
        all_motion = motion(scene)
        numbers = [obstacle.obstacle_id for obstacle in scenario.dynamic_obstacles]
        check(f"{name}: obstacles", len(numbers) == len(all_motion))
        vehicles = [(n, m) for n, m in zip(numbers, all_motion) if m[0]["type"] == "vehicle"]
        moments = theirs(file, [n for n, _ in vehicles], [m for _, m in vehicles])
        own = ours(name, moments)
        check(f"{name}: figures of all", len(own) == len(moments), (len(own), len(moments)))
        off = []
        for (pair, step, value), mine in zip(moments, own):
            what = f"{name}: {pair[0][0]['id']} behind {pair[1][0]['id']} at {step}"
            both = mine is not None and math.isfinite(value)
            check(what, both and abs(mine - value) < SAME_S, (mine, value))
            off += [abs(mine - value)] if both else []
        table.append((name, moments, own, off))
    print(f"{'scene':18} moments  most apart (s)   least time: ours   CriMe")
    for name, moments, own, off in table:
        least = min(range(len(own)), key=lambda i: own[i] or AHEAD_S, default=None)
        values = "" if least is None else f"{own[least]:16.3f} {moments[least][2]:7.2f}"
        print(f"{name:18} {len(moments):7} {max(off, default=0):15.3f}   {values}")
    check("every scene has moments to compare", all(len(moments) > 2 for _, moments, _, _ in table))
    failed = results.count(False)
    print(f"{results.count(True)} passed, {failed} failed")
    sys.exit(1 if failed else 0)


main()
