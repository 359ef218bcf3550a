# /// script
# requires-python = ">=3.10"
# dependencies = ["protobuf==7.36.2", "numpy==2.4.6", "crc32c==2.9.post0"]
#
# [tool.dragtraffic]
# # Their own lists have TensorFlow and PyTorch, of which the messages use nothing.
# no-deps = ["waymo-open-dataset-tf-2-12-0==1.6.7", "tfrecord==1.14.6"]
# ///
"""What we write for Waymo's tools, in theirs: Scenario records in the dataset's own messages, tf.Examples in the
package tfrecord by the dataset's features, and submissions to Sim Agents by the challenge's own validation. Called
with the program and a folder."""

import json
import math
import pathlib
import subprocess
import sys

import numpy
from google.protobuf import unknown_fields
from tfrecord import example_pb2
from tfrecord.reader import tfrecord_iterator
from waymo_open_dataset.protos import scenario_pb2, sim_agents_submission_pb2
from waymo_open_dataset.utils.sim_agents import submission_specs

PROGRAM, FOLDER = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
ROOT = pathlib.Path(__file__).resolve().parents[2]
# Single precision some hundred metres from the origin.
OFF_M = 1e-4
USERS, LIGHTS, POINTS = 128, 16, 30000
PARTS = {"past": 10, "current": 1, "future": 80}
MOTION = ("bbox_yaw", "height", "length", "vel_yaw", "velocity_x", "velocity_y", "width", "x", "y", "z", "speed")
results = []


def features():
    """The dataset's description of an example: kind and count by name (waymo.com/open/data/motion/tfexample)."""
    known = {"scenario/id": ("bytes", 1)}
    known |= {f"state/{name}": ("float", USERS) for name in ("id", "type")}
    whole = ("is_sdc", "tracks_to_predict", "difficulty_level", "objects_of_interest")
    known |= {f"state/{name}": ("int64", USERS) for name in whole}
    for part, steps in PARTS.items():
        known |= {f"state/{part}/{name}": ("float", USERS * steps) for name in MOTION}
        known |= {f"state/{part}/{name}": ("int64", USERS * steps) for name in ("valid", "timestamp_micros")}
        light = f"traffic_light_state/{part}"
        known |= {f"{light}/{name}": ("float", LIGHTS * steps) for name in ("x", "y", "z")}
        known |= {f"{light}/{name}": ("int64", LIGHTS * steps) for name in ("id", "state", "valid")}
        known[f"{light}/timestamp_micros"] = ("int64", steps)
    known |= {f"roadgraph_samples/{name}": ("float", POINTS * 3) for name in ("dir", "xyz")}
    known |= {f"roadgraph_samples/{name}": ("int64", POINTS) for name in ("id", "type", "valid")}
    return known


def check(name, holds, why=""):
    results.append(bool(holds))
    if not holds:
        print(f"FAILED {name}: {why}")


def run(*arguments):
    subprocess.run([str(PROGRAM), "-q", *map(str, arguments)], check=True, capture_output=True)


def records(path):
    """Contents of the records of a file, in tfrecord's reader."""
    return [bytes(record) for record in tfrecord_iterator(str(path))]


def is_known(message):
    """Nothing in a message, and what is in it, is unknown to the reader."""
    parts = [part for field, value in message.ListFields() if field.message_type
             for part in (value if field.is_repeated else [value])]
    return not len(unknown_fields.UnknownFieldSet(message)) and all(map(is_known, parts))


def states(agent):
    """States by step of a road user as it was recorded."""
    track = agent["track"]
    columns = zip(*(track[key] for key in ("x_m", "y_m", "heading_rad", "vx_mps", "vy_mps")))
    rows, first = list(columns), track.get("first_step") or 0
    known = track.get("valid") or [[0, len(rows)]]
    return {first + i: rows[i] for a, b in known for i in range(a, b)}


def scenario(name, scene, path):
    """The record in the dataset's own message, equal to the scene."""
    content = records(path)
    check(f"{name}: one record", len(content) == 1)
    read = scenario_pb2.Scenario.FromString(content[0])
    check(f"{name}: all fields are known", read.IsInitialized() and is_known(read))
    check(f"{name}: steps", len(read.timestamps_seconds) == scene["time"]["steps"])
    check(f"{name}: now", read.current_time_index == scene["time"]["now_step"])
    check(f"{name}: road users", len(read.tracks) == len(scene["agents"]))
    ego = [i for i, agent in enumerate(scene["agents"]) if agent.get("role") == "ego"]
    check(f"{name}: its own vehicle", not ego or read.sdc_track_index == ego[0])
    for agent, track in zip(scene["agents"], read.tracks):
        own = states(agent)
        good = {i for i, state in enumerate(track.states) if state.valid} == set(own)
        good &= scenario_pb2.Track.ObjectType.Name(track.object_type) == f"TYPE_{agent['type'].upper()}"
        for step, (x, y, heading, vx, vy) in own.items():
            state = track.states[step]
            good &= math.dist((x, y), (state.center_x, state.center_y)) < OFF_M
            good &= abs(math.remainder(state.heading - heading, math.tau)) < 1e-6
            good &= math.dist((vx, vy), (state.velocity_x, state.velocity_y)) < 1e-5
            good &= abs(state.length - agent["length_m"]) + abs(state.width - agent["width_m"]) < 1e-5
        check(f"{name}: motion of {agent['id']}", good)
    kinds = {}
    for feature in read.map_features:
        kinds.setdefault(feature.WhichOneof("feature_data"), []).append(feature)
    lanes = kinds.get("lane", [])
    check(f"{name}: lanes", len(lanes) == len(scene["map"]["lanes"]))
    links = sum(len(feature.lane.exit_lanes) for feature in lanes)
    check(f"{name}: links", links == sum(len(lane.get("successors") or []) for lane in scene["map"]["lanes"]))
    for feature, lane in zip(lanes, scene["map"]["lanes"]):
        line = [(point.x, point.y) for point in feature.lane.polyline]
        near = [math.dist(a, b[:2]) for a, b in zip(line, lane["points_m"])]
        check(f"{name}: lane {lane['id']}", len(line) == len(lane["points_m"]) and max(near) < OFF_M)
    lit = {light.lane for state in read.dynamic_map_states for light in state.lane_states}
    check(f"{name}: lights", len(lit) == len({signal["lane"] for signal in scene.get("signals") or []}))
    return read


def example(name, original, path):
    """The record by the dataset's features, with what the scenario has."""
    content = records(path)
    check(f"{name}: one example", len(content) == 1)
    read = example_pb2.Example.FromString(content[0]).features.feature
    for key, (kind, count) in features().items():
        there = read[key] if key in read else None
        what = there and (there.WhichOneof("kind"), len(getattr(there, f"{kind}_list").value))
        check(f"{name}: {key}", what == (f"{kind}_list", count), what)
    check(f"{name}: nothing else", set(read) == set(features()), sorted(set(read) - set(features()))[:5])

    def values(key):
        kind = read[key].WhichOneof("kind")
        return numpy.array(getattr(read[key], kind).value)

    check(f"{name}: who is who", values("state/is_sdc").argmax() == original.sdc_track_index)
    now, first = original.current_time_index, 0
    for part, steps in PARTS.items():
        first = {"past": now - 10, "current": now, "future": now + 1}[part]
        valid = values(f"state/{part}/valid").reshape(USERS, steps)
        at = [values(f"state/{part}/{axis}").reshape(USERS, steps) for axis in "xy"]
        good = True
        for user, track in enumerate(original.tracks):
            for step in range(steps):
                there = first + step < len(track.states) and track.states[first + step]
                good &= (valid[user, step] == 1) == bool(there and there.valid)
                if good and there and there.valid:
                    place = (at[0][user, step], at[1][user, step])
                    good &= math.dist(place, (there.center_x, there.center_y)) < OFF_M
        check(f"{name}: motion of the {part}", good)
        check(f"{name}: nobody else in the {part}", (valid[len(original.tracks) :] != 1).all())
    valid = values("roadgraph_samples/valid") == 1
    ids = set(values("roadgraph_samples/id")[valid].tolist())
    lanes = {feature.id for feature in original.map_features if feature.WhichOneof("feature_data") == "lane"}
    check(f"{name}: points of all lanes", lanes <= ids, sorted(lanes - ids)[:5])
    steepness = numpy.linalg.norm(values("roadgraph_samples/dir").reshape(-1, 3)[valid], axis=1)
    check(f"{name}: directions of length one or none", ((abs(steepness - 1) < 1e-3) | (steepness == 0)).all())


def submission(name, original, path, rollouts):
    """Rollouts by the challenge's own validation; they leave the places of now."""
    read = sim_agents_submission_pb2.SimAgentsChallengeSubmission.FromString(path.read_bytes())
    check(f"{name}: all fields are known", is_known(read))
    check(f"{name}: of Sim Agents", read.submission_type == read.SIM_AGENTS_SUBMISSION)
    check(f"{name}: one scene", len(read.scenario_rollouts) == 1)
    for rollout in read.scenario_rollouts:
        check(f"{name}: the scenario", rollout.scenario_id == original.scenario_id)
        check(f"{name}: rollouts", len(rollout.joint_scenes) == rollouts)
        try:
            if rollouts == 32:
                submission_specs.validate_scenario_rollouts(rollout, original)
            for joint in rollout.joint_scenes:
                submission_specs.validate_joint_scene(joint, original, submission_specs.ChallengeType.SIM_AGENTS)
            check(f"{name}: valid", True)
        except ValueError as fault:
            check(f"{name}: valid", False, fault)
        now = {track.id: track.states[original.current_time_index] for track in original.tracks}
        for way in (way for joint in rollout.joint_scenes for way in joint.simulated_trajectories):
            start = now[way.object_id]
            gone = math.dist((way.center_x[0], way.center_y[0]), (start.center_x, start.center_y))
            # A step on, at no more than 50 m/s.
            check(f"{name}: {way.object_id} starts where it is", gone < 5.0, gone)


def main():
    paths = sorted((ROOT / "assets/scenes").glob("demo-*.json"))
    check("scenes are there", len(paths) > 1)
    for number, path in enumerate(paths):
        scene, name = json.loads(path.read_text()), path.stem
        record, features_of, rollouts = (FOLDER / f"{name}.{end}" for end in ("tfrecord", "example.tfrecord", "binproto"))
        run("convert", path, "--to", "womd", "-o", record, "--force")
        original = scenario(name, scene, record)
        run("convert", path, "--to", "womd-example", "-o", features_of, "--force")
        example(name, original, features_of)
        # One scene has as many samples as the challenge takes, of one road user; the others have fewer, of all.
        samples, who = (32, "@ego") if number == 0 else (2, "@all")
        made = FOLDER / f"{name}.json"
        run("generate", path, "--agents", who, "--samples", samples, "--seed", "5", "-o", made, "--force")
        run("convert", made, "--to", "sim-agents", "-o", rollouts, "--force")
        submission(name, original, rollouts, samples)
    failed = results.count(False)
    print(f"{results.count(True)} passed, {failed} failed")
    sys.exit(1 if failed else 0)


main()
