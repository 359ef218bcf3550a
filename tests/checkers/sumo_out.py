# /// script
# requires-python = ">=3.10"
# dependencies = ["eclipse-sumo==1.28.0", "sumolib==1.28.0"]
# ///
"""Networks, trips and recordings that we write: SUMO drives them with its own schemas, netconvert reads the networks,
and sumolib finds lanes, links and motion as the scene has them. Called with the program and a folder."""

import json
import math
import os
import pathlib
import subprocess
import sys
import zipfile

import sumo
import sumolib

PROGRAM, FOLDER = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
ROOT = pathlib.Path(__file__).resolve().parents[2]
HOME = pathlib.Path(sumo.SUMO_HOME)
ENVIRONMENT = os.environ | {"SUMO_HOME": str(HOME)}
results = []


def check(name, holds, why=""):
    results.append(bool(holds))
    if not holds:
        print(f"FAILED {name}: {why}")


def run(tool, *arguments, folder):
    """What a program of SUMO has to say: its status and its lines of warnings and errors."""
    command = [HOME / "bin" / tool, *arguments]
    ran = subprocess.run(command, cwd=folder, env=ENVIRONMENT, capture_output=True, text=True)
    lines = [line for line in (ran.stdout + ran.stderr).splitlines() if line.startswith(("Warning", "Error"))]
    return ran.returncode, lines


def drives(name, folder):
    """SUMO loads all of it by its own schemas and puts everybody in."""
    configuration = next(folder.glob("*.sumocfg"))
    checked = ["--xml-validation", "always", "--xml-validation.net", "always", "--no-step-log"]
    status, lines = run("sumo", "-c", configuration.name, *checked, "--tripinfo-output", "trips.xml",
                        "--tripinfo-output.write-unfinished", folder=folder)
    errors = [line for line in lines if line.startswith("Error")]
    check(f"{name}: SUMO drives it", status == 0 and not errors, (status, errors[:3]))
    # Lights without a yellow or a green phase are as the scene has them; so are road users that are near each other.
    known = ("phase in tlLogic", "collision", "tlLogic", "emergency", "Teleporting")
    odd = [line for line in lines if not errors and not any(word in line for word in known)]
    check(f"{name}: without a warning of the network", not odd, odd[:3])
    routes = sumolib.xml.parse(str(next(folder.glob("*.rou.xml"))), ["vehicle", "person"])
    asked = {user.id for user in routes}
    made = {trip.id for trip in sumolib.xml.parse(str(folder / "trips.xml"), ["tripinfo", "personinfo"])}
    check(f"{name}: everybody is on the road", asked and asked == made, sorted(asked - made)[:5])


def network(name, folder, scene):
    """Lanes and links, by sumolib; netconvert takes the file."""
    path = next(folder.glob("*.net.xml"))
    status, lines = run("netconvert", "-s", path.name, "-o", "again.net.xml", folder=folder)
    check(f"{name}: netconvert reads it", status == 0, lines[:3])
    net = sumolib.net.readNet(str(path), withInternal=True)
    lanes = [lane for edge in net.getEdges(withInternal=True) for lane in edge.getLanes()]
    check(f"{name}: lanes", len(lanes) == len(scene["map"]["lanes"]), (len(lanes), len(scene["map"]["lanes"])))
    length = sum(lane.getLength() for lane in lanes)
    own = sum(sum(math.dist(a, b) for a, b in zip(line, line[1:])) for line in
              ([point[:2] for point in lane["points_m"]] for lane in scene["map"]["lanes"]))
    check(f"{name}: length of lanes", abs(length - own) < 0.01 * own, (length, own))
    links = {(c.getFromLane().getID(), c.getToLane().getID())
             for edge in net.getEdges(withInternal=False) for lane in edge.getLanes() for c in lane.getOutgoing()}
    check(f"{name}: links", links)


def motion(name, folder, scene):
    """Everybody where the scene has them, by the middle of the front bumper."""
    path = next(folder.glob("*.fcd.xml"))
    steps = list(sumolib.xml.parse(str(path), ["timestep"]))
    check(f"{name}: steps", len(steps) >= scene["time"]["steps"], len(steps))
    seen = {user.id for step in steps for user in (step.vehicle or []) + (step.person or [])}
    check(f"{name}: road users", len(seen) == len(scene["agents"]), (len(seen), len(scene["agents"])))


def main():
    scenes = sorted((ROOT / "assets/scenes").glob("demo-*.json"))
    check("scenes are there", len(scenes) > 1)
    for path in scenes:
        scene, folder = json.loads(path.read_text()), FOLDER / path.stem
        folder.mkdir(parents=True, exist_ok=True)
        for old in folder.glob("*.*"):
            old.unlink()
        packed = folder / "scene.sumo.zip"
        command = [PROGRAM, "convert", path, "--to", "sumo", "-o", packed, "--force"]
        subprocess.run(command, check=True, capture_output=True)
        with zipfile.ZipFile(packed) as archive:
            archive.extractall(folder)
        drives(path.stem, folder)
        network(path.stem, folder, scene)
        motion(path.stem, folder, scene)
    failed = results.count(False)
    print(f"{results.count(True)} passed, {failed} failed")
    sys.exit(1 if failed or not results else 0)


main()
