# /// script
# requires-python = ">=3.10"
# dependencies = []
#
# [tool.dragtraffic]
# programs = ["esmini"]
# ///
"""Scenarios that we write, played by esmini: every road user is there when and where the scene has it, and the log
has no warning that the file could avoid. Called with the program and a folder; the variable ESMINI names esmini."""

import csv
import math
import os
import pathlib
import subprocess
import sys
import zipfile

sys.path.insert(0, str(pathlib.Path(__file__).parent / "support"))

from checks import check, end, program, root, work

ESMINI = pathlib.Path(os.environ["ESMINI"]).resolve()
STEP_S = 0.1
# Where the rear axle of our vehicles lies behind their middle, as a share of the length: the place of a scenario.
REAR = 0.3
NEAR_M = 0.05
NEAR_RAD = 0.1
# A player without pictures misses its models of road users and its list of signs, whatever the file says.
UNAVOIDABLE = ("3D model", "Traffic sign mapping file")


def ours(*arguments):
    subprocess.run([program, *map(str, arguments)], check=True, capture_output=True, cwd=work)


def made():
    """Example scenes, one with futures and reactions, and filled maps of three templates."""
    scenes = {path.stem: path for path in sorted((root / "assets/scenes").glob("demo-*.json"))}
    check("scenes are there", len(scenes) > 1)
    crossing = scenes["demo-crossing"]
    turned = work / "turned.json"
    ours("generate", crossing, "--agents", "4", "--goal", "4=2,27.5", "--react", "--seed", "7", "-o", turned, "--force")
    for template in ("roundabout", "merge", "school-street"):
        bare, filled, driven = (work / f"{template}-{what}.json" for what in ("map", "filled", "driven"))
        ours("map", "--template", template, "-o", bare, "--force")
        ours("place", bare, "--count", "16", "--seed", "3", "-o", filled, "--force")
        ours("generate", filled, "--seed", "3", "-o", driven, "--force")
        scenes[driven.stem] = driven
    return scenes | {"turned": turned}


def exported(scene, folder):
    """The scenario of a scene, and its motion by our own table."""
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob("*"):
        old.unlink()
    ours("convert", scene, "--to", "openscenario", "-o", folder / "scene.xosc.zip")
    ours("convert", scene, "--to", "csv", "-o", folder / "motion.csv")
    with zipfile.ZipFile(folder / "scene.xosc.zip") as archive:
        archive.extractall(folder)
    return next(folder.glob("*.xosc")), shown(folder / "motion.csv")


def shown(table):
    """Who is where, by road user and step: the rear axle of vehicles, the middle of pedestrians, and the heading."""
    places = {}
    with table.open() as file:
        # Chosen futures come after the recording, whose place they take.
        for row in csv.DictReader(file):
            if row["valid"] == "1" and (row["source"] == "log" or row["chosen"] == "1"):
                x_m, y_m, heading_rad = (float(row[name]) for name in ("x_m", "y_m", "heading_rad"))
                behind_m = 0.0 if row["type"] == "pedestrian" else REAR * float(row["length_m"])
                at = (x_m - behind_m * math.cos(heading_rad), y_m - behind_m * math.sin(heading_rad), heading_rad)
                places.setdefault(row["agent_id"], {})[int(row["step"])] = at
    return places


def run(tool, *arguments, folder):
    return subprocess.run([str(part) for part in (tool, *arguments)], cwd=folder, capture_output=True, text=True, timeout=600)


def played(scenario):
    """What esmini makes of it, by road user and step, and what it says."""
    folder = scenario.parent
    told = run(ESMINI, "--osc", scenario.name, "--headless", "--disable_stdout", "--fixed_timestep", STEP_S / 2,
               "--traj_filter", 0, "--record", "played.dat", "--logfile_path", "log.txt", folder=folder)
    run(ESMINI.with_name("dat2csv"), "--file", "played.dat", "--precision", "4", folder=folder)
    places = {}
    with (folder / "played.csv").open() as file:
        for row in csv.DictReader(file, skipinitialspace=True):
            step = float(row["time"]) / STEP_S
            if abs(step - round(step)) < 0.01:
                at = tuple(float(row[name]) for name in "xyh")
                places.setdefault(row["name"], {})[round(step)] = at
    return told.returncode, places, (folder / "log.txt").read_text(errors="replace").splitlines()


def apart(own, theirs):
    """How far two places are apart, metres, and how far their headings, rad."""
    turned = (own[2] - theirs[2] + math.pi) % math.tau - math.pi
    return math.dist(own[:2], theirs[:2]), abs(turned)


def plays(name, scenario, expected):
    status, places, lines = played(scenario)
    check(f"{name}: esmini plays it to its end", status == 0)
    said = [line for line in lines if "[warn]" in line or "[error]" in line]
    odd = [line for line in said if not any(word in line for word in UNAVOIDABLE)]
    check(f"{name}: it says {len(odd)} times what the file could avoid, such as {odd[:1]}", not odd)
    check(f"{name}: everybody is there", expected.keys() == places.keys())
    for road_user in expected.keys() & places.keys():
        own, theirs = expected[road_user], places[road_user]
        # A player brings in and takes out a frame after the time.
        missed = (own.keys() ^ theirs.keys()) - {min(own), max(own) + 1}
        check(f"{name}, {road_user}: there or not at steps {sorted(missed)[:5]}", not missed)
        pairs = {step: apart(own[step], theirs[step]) for step in own.keys() & theirs.keys()}
        far = max(pairs, key=lambda step: pairs[step][0])
        check(f"{name}, {road_user}: {pairs[far][0]:.3f} m away at step {far}", pairs[far][0] <= NEAR_M)
        turned = max(pairs, key=lambda step: pairs[step][1])
        check(f"{name}, {road_user}: turned by {pairs[turned][1]:.3f} rad at step {turned}", pairs[turned][1] <= NEAR_RAD)


def main():
    for name, scene in made().items():
        plays(name, *exported(scene, work / name))
    end()


main()
