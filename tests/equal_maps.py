"""Writes one road network in several formats with a foreign program (roadgen), for models/formats/tests/equal_maps.rs."""

import math
import pathlib
import subprocess
import sys

import roadgen
import sumo

folder = pathlib.Path(sys.argv[1])
folder.mkdir(parents=True, exist_ok=True)


def lanes(count):
    """So many lanes each way, and a sidewalk beside them."""

    def side(direction):
        driven = [roadgen.Lane(width=3.5, direction=direction, speed_limit_kph=50) for _ in range(count)]
        return [*driven, roadgen.Lane(width=2.0, direction=direction, type_="sidewalk")]

    return side("forward") + side("backward")


network = roadgen.Map("equal", origin=(48.1, 11.5, 0.0))
arms = {}
for name, degrees, count in (("west", 180, 2), ("east", 0, 2), ("north", 90, 1), ("south", -90, 1)):
    x, y = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    start, end = (150 * x, 150 * y, 0), (22 * x, 22 * y, 0)
    arms[name] = network.add_road(start=start, end=end, lanes=lanes(count), name=name)
crossing = network.add_junction("crossing")
names = list(arms)
for i, name in enumerate(names):
    for other in names[i + 1 :]:
        network.connect(arms[name], arms[other], junction=crossing, ends=("end", "end"))
line = roadgen.Alignment(start=(-150.0, 0.0, 0.0), heading=math.pi)
line.spiral(40.0, curvature_end=1 / 60)
line.arc(60.0, curvature=1 / 60)
line.line(40.0)
bend = network.add_road(lanes=lanes(2), alignment=line, name="bend")
network.connect(bend, arms["west"], ends=("start", "start"))
if network.issues():
    sys.exit(f"the network is not valid: {network.issues()}")

network.export_opendrive(str(folder / "map.xodr"))
network.export_lanelet2(str(folder / "map.osm"))
network.export_womd(str(folder / "map.tfrecord"))
network.export_gpudrive(str(folder / "map.json"))
prefix = network.export_sumo(str(folder / "sumo"))
netconvert = pathlib.Path(sumo.SUMO_HOME) / "bin" / "netconvert"
command = [netconvert, "-c", f"{prefix}.netccfg", "-o", (folder / "map.net.xml").absolute()]
subprocess.run(command, cwd=folder / "sumo", check=True)
