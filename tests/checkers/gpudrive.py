# /// script
# requires-python = ">=3.10"
# dependencies = ["jsonschema==4.26.0"]
# ///
"""The files for GPUDrive and Nocturne against a schema of our own, drawn from published files: no package has an
engine that reads them. Called with the program and a folder."""

import json
import pathlib
import subprocess
import sys

import jsonschema

PROGRAM, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])
results = []


def check(name, holds, why=""):
    results.append(bool(holds))
    if not holds:
        print(f"FAILED {name}: {why}")


def schema(full):
    """What a file has; `full` with heights, ids and kinds of map elements."""
    number = {"type": "number"}
    names = ["x", "y", "z"] if full else ["x", "y"]
    point = {"type": "object", "required": names, "additionalProperties": False, "properties": {name: number for name in names}}
    plane = {"type": "object", "required": ["x", "y"], "additionalProperties": False, "properties": {"x": number, "y": number}}
    lists = {"position": point, "velocity": plane, "heading": number, "valid": {"type": "boolean"}}
    thing = {name: {"type": "array", "items": item} for name, item in lists.items()}
    thing |= {"width": number, "length": number, "goalPosition": point}
    thing["type"] = {"enum": ["vehicle", "pedestrian", "cyclist", "other"]}
    kinds = ["lane", "road_line", "road_edge", "stop_sign", "crosswalk", "speed_bump", "driveway"]
    road = {"geometry": {"type": "array", "items": point, "minItems": 1}, "type": {"enum": kinds}}
    whole = {"type": "integer"}
    document = {"name": {"type": "string"}, "tl_states": {"type": "object"}}
    if full:
        thing |= {"id": whole, "mark_as_expert": {"type": "boolean"}}
        road |= {"id": whole, "map_element_id": {"type": "integer", "minimum": 0, "maximum": 20}}
        document |= {"scenario_id": {"type": "string"}, "metadata": {"type": "object", "required": ["objects_of_interest", "tracks_to_predict"]}}
    required = sorted(thing)
    thing["height"] = number
    document["objects"] = {"type": "array", "items": {"type": "object", "required": required, "additionalProperties": False, "properties": thing}}
    document["roads"] = {"type": "array", "items": {"type": "object", "required": sorted(road), "additionalProperties": False, "properties": road}}
    return {"type": "object", "required": sorted(document), "additionalProperties": False, "properties": document}


def main():
    scenes = sorted(pathlib.Path("assets/scenes").glob("*.json"))
    check("scenes are there", len(scenes) > 1)
    for path in scenes:
        scene = json.loads(path.read_text())
        for engine in ("gpudrive", "nocturne"):
            target = FOLDER / f"{path.stem}.{engine}.json"
            command = [PROGRAM, "convert", path, "--to", engine, "-o", target, "--force"]
            subprocess.run(command, check=True, capture_output=True)
            document = json.loads(target.read_text())
            faults = [e.message[:200] for e in jsonschema.Draft202012Validator(schema(engine == "gpudrive")).iter_errors(document)]
            check(f"{path.stem}: {engine}", not faults, faults[:3])
            check(f"{path.stem}: {engine} road users", len(document["objects"]) == len(scene["agents"]))
            lengths = {len(thing[name]) for thing in document["objects"] for name in ("position", "heading", "velocity", "valid")}
            check(f"{path.stem}: {engine} steps", len(lengths) == 1, lengths)
    failed = results.count(False)
    print(f"{results.count(True)} passed, {failed} failed")
    sys.exit(1 if failed else 0)


main()
