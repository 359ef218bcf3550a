# /// script
# dependencies = ["mcap==1.6.0", "jsonschema==4.26.0"]
# ///
"""Logs in the Python package of MCAP: topics, times, the index, and messages that keep to their schemas."""

import json
import math
import subprocess

import jsonschema
from mcap.reader import NonSeekingReader, make_reader
from support.checks import check, end, program, root, work

for path in sorted((root / "assets/scenes").glob("*.json"))[:4]:
    scene = json.loads(path.read_text())
    log = work / f"{path.stem}.mcap"
    subprocess.run([program, "-q", "convert", path, "--to", "mcap", "--force", "-o", log], check=True)
    with open(log, "rb") as file:
        reader = make_reader(file, validate_crcs=True)
        summary = reader.get_summary()
        messages = list(reader.iter_messages())
        notes = {note.name: note.metadata for note in reader.iter_metadata()}
        some = list(reader.iter_messages(topics=["/road_users"], starting_at=10**9, ending_before=2 * 10**9))
    check(f"{path.name}: indexed", summary is not None and len(summary.chunk_indexes) > 0)
    check(f"{path.name}: counted", summary.statistics.message_count == len(messages))
    check(f"{path.name}: a second of messages", [m.log_time for _, _, m in some] == [10**9 + i * 10**8 for i in range(10)])
    with open(log, "rb") as file:
        check(f"{path.name}: read from its beginning", len(list(NonSeekingReader(file).iter_messages())) == len(messages))
    check(f"{path.name}: notes", "frame" in notes["dragtraffic"])
    users = []
    for schema, channel, message in messages:
        body = json.loads(message.data)
        document = json.loads(schema.data)
        check(f"{path.name}: {channel.topic} at {message.log_time}", jsonschema.Draft202012Validator(document).is_valid(body))
        if channel.topic == "/road_users":
            users.append(body)
    steps = max(a["track"].get("first_step", 0) + len(a["track"]["x_m"]) for a in scene["agents"])
    check(f"{path.name}: steps", len(users) == max(steps, scene["time"]["steps"]))
    for agent in scene["agents"]:
        track = agent["track"]
        first = track.get("first_step", 0)
        good = True
        for step, body in enumerate(users):
            found = [entity for entity in body["entities"] if entity["id"] == agent["id"]]
            for entity in found:
                at = entity["cubes"][0]["pose"]["position"]
                good &= math.dist((at["x"], at["y"]), (track["x_m"][step - first], track["y_m"][step - first])) < 1e-6
        check(f"{path.name}: {agent['id']}", good)
end()
