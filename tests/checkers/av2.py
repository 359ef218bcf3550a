# /// script
# dependencies = ["pandas==3.1.1", "pyarrow==26.0.1", "universal-pathlib==0.3.10", "scipy==1.17.1", "pyproj==3.7.2"]
# ///
"""Scenarios in the loader of the Argoverse 2 API: tracks, their categories and states equal to those of the scene."""

import json
import math
import subprocess
import sys

from support.checks import check, end, program, root, work

# This file has the name of the package.
sys.path.pop(0)

try:
    from av2.datasets.motion_forecasting import scenario_serialization
except ImportError:
    # Its own list of what it needs has torch and more, of which the loader uses nothing.
    pip = [sys.executable, "-m", "pip", "install", "-q", "--no-deps", "av2==0.3.6"]
    subprocess.run(pip, check=True)
    from av2.datasets.motion_forecasting import scenario_serialization

load = scenario_serialization.load_argoverse_scenario_parquet
for path in sorted((root / "assets/scenes").glob("*.json"))[:4]:
    scene = json.loads(path.read_text())
    table = work / f"scenario_{path.stem}.parquet"
    command = [program, "-q", "convert", path, "--to", "av2", "--force", "-o", table]
    subprocess.run(list(map(str, command)), check=True)
    scenario = load(table)
    tracks = {track.track_id: track for track in scenario.tracks}
    check(f"{path.name}: tracks", len(tracks) == len(scene["agents"]))
    check(f"{path.name}: focal", scenario.focal_track_id in tracks)
    focal = [track for track in scenario.tracks if track.category.name == "FOCAL_TRACK"]
    check(f"{path.name}: one focal track", [track.track_id for track in focal] == [scenario.focal_track_id])
    for agent in scene["agents"]:
        track = tracks.get("AV" if agent.get("role") == "ego" else agent["id"])
        motion = agent["track"]
        first = motion.get("first_step", 0)
        good = track is not None and len(track.object_states) > 0
        for state in track.object_states if track else []:
            i = state.timestep - first
            good &= math.dist(state.position, (motion["x_m"][i], motion["y_m"][i])) < 1e-6
            good &= state.observed == (state.timestep <= scene["time"].get("now_step", 0))
            good &= abs(state.velocity[0] - motion["vx_mps"][i]) < 1e-6 if "vx_mps" in motion else True
        check(f"{path.name}: {agent['id']}", good)
end()
