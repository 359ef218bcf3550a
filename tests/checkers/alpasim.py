# /// script
# requires-python = ">=3.10"
# dependencies = ["grpcio==1.85.1", "grpcio-tools==1.85.1"]
# ///
"""AlpaSim's TrafficService: a client that protoc generates from the published names and numbers of the messages drives
one road user of a scene through a session, and the server drives the others."""

import json
import math
import subprocess
import sys

import grpc
from grpc_tools import protoc
from support.checks import check, end, program, root, work

proto = root / "python/examples/traffic.proto"
paths = [f"-I{proto.parent}", f"--python_out={work}", f"--grpc_python_out={work}", str(proto)]
check("generated", protoc.main(["protoc", *paths]) == 0)
sys.path.insert(0, str(work))
import traffic_pb2 as messages  # noqa: E402
import traffic_pb2_grpc as service  # noqa: E402

BEGIN_US, STEP_US = 50_000_000, 100_000
CLASSES = {"vehicle": "automobile", "pedestrian": "person", "cyclist": "rider"}
scene = json.loads((root / "assets/scenes/demo-crossing.json").read_text())
#: The one that the client drives.
EGO = "EGO"


def pose(x, y, heading, step):
    quat = messages.Quat(w=math.cos(heading / 2), z=math.sin(heading / 2))
    body = messages.Pose(vec=messages.Vec3(x=x, y=y, z=1.5), quat=quat)
    return messages.PoseAtTime(pose=body, timestamp_us=BEGIN_US + step * STEP_US)


def logged(agent):
    track = agent["track"]
    steps = [step for a, b in track["valid"] for step in range(a, b)]
    rows = [(step, *(track[name][step - track["first_step"]] for name in ("x_m", "y_m", "heading_rad"))) for step in steps]
    return messages.ObjectTrajectory(
        aabb=messages.AABB(size_x=agent["length_m"], size_y=agent["width_m"], size_z=1.6),
        trajectory=messages.Trajectory(poses=[pose(x, y, heading, step) for step, x, y, heading in rows]),
        object_id=EGO if agent["id"] == "4" else f"track {agent['id']}",
        label_class=CLASSES[agent["type"]],
    )


objects = [logged(agent) for agent in scene["agents"] if agent["type"] in CLASSES]
ego = next(one for one in objects if one.object_id == EGO)


def drive(stub, uuid, standing, steps=40, handover=0, seed=3):
    """Poses of the others by name at each step."""
    handover_us = BEGIN_US + handover * STEP_US
    stub.start_session(
        messages.TrafficSessionRequest(
            session_uuid=uuid,
            scene_id="demo-crossing",
            random_seed=seed,
            logged_object_trajectories=objects,
            handover_time_us=handover_us,
        )
    )
    seen = []
    for number in range(1, steps + 1):
        at = handover + number
        last = ego.trajectory.poses[handover if standing else at].pose
        moved = messages.PoseAtTime(pose=last, timestamp_us=BEGIN_US + at * STEP_US)
        update = messages.ObjectTrajectoryUpdate(object_id=EGO, trajectory=messages.Trajectory(poses=[moved]))
        asked = messages.TrafficRequest(
            session_uuid=uuid, time_query_us=BEGIN_US + at * STEP_US, object_trajectory_updates=[update]
        )
        seen.append(stub.simulate(asked).object_trajectory_updates)
    stub.close_session(messages.TrafficSessionCloseRequest(session_uuid=uuid))
    return seen


def places(updates):
    return {one.object_id: one.trajectory.poses[0].pose.vec for one in updates}


def apart(a, b):
    return math.hypot(a.x - b.x, a.y - b.y)


def refused(call, *arguments):
    try:
        call(*arguments)
        return None
    except grpc.RpcError as error:
        return error.code().name


def use(stub, unknown):
    metadata = stub.get_metadata(messages.Empty())
    check("no history is needed", metadata.minimum_history_length_us == 0)
    check("a version", metadata.version_id.version_id.startswith("dragtraffic-"))
    check("scenes", "demo-crossing" in stub.get_available_scenes(messages.Empty()).scene_ids)

    driven = drive(stub, "a", standing=False)
    names = [one.object_id for one in objects]
    for number, updates in enumerate(driven, 1):
        told = [one.object_id for one in updates]
        check("in the order of the session", told == [name for name in names if name in told] and EGO not in told)
        times = {pose.timestamp_us for one in updates for pose in one.trajectory.poses}
        check("a pose at the time of the question", times == {BEGIN_US + number * STEP_US})
    check(f"{len(driven[0])} of {len(objects)}", len(driven[0]) > 20)
    first = {one.object_id: one.trajectory.poses[0] for one in objects}
    for name, place in places(driven[0]).items():
        if first[name].timestamp_us == BEGIN_US:
            check(f"{name} goes on from its first pose", apart(place, first[name].pose.vec) < 3 and place.z == 1.5)
    for before, after in zip(driven, driven[1:]):
        then, now = places(before), places(after)
        check("nobody jumps", all(apart(then[name], now[name]) < 4 for name in then.keys() & now.keys()))
    moved = [name for name, place in places(driven[-1]).items() if name in places(driven[0])]
    far = [name for name in moved if apart(places(driven[-1])[name], places(driven[0])[name]) > 5]
    check(f"{len(far)} drive", len(far) > 3)

    check("equal sessions give equal answers", drive(stub, "b", standing=False) == driven)
    stopped = drive(stub, "c", standing=True)
    ends, others = places(driven[-1]), places(stopped[-1])
    changed = [name for name in ends.keys() & others.keys() if apart(ends[name], others[name]) > 0.5]
    check(f"the others react to what the client drives: {changed}", changed)
    later = drive(stub, "d", standing=False, steps=5, handover=20)
    check("a handover after two seconds of history", len(later[-1]) > 20)

    request = messages.TrafficSessionRequest(
        session_uuid="e", scene_id="demo-crossing", logged_object_trajectories=objects, handover_time_us=BEGIN_US
    )
    stub.start_session(request)
    step = messages.ObjectTrajectoryUpdate(object_id=EGO, trajectory=ego.trajectory)
    at = lambda us, *updates, uuid="e": messages.TrafficRequest(  # noqa: E731
        session_uuid=uuid, time_query_us=us, object_trajectory_updates=updates
    )
    between = stub.simulate(at(BEGIN_US + 250_000, step)).object_trajectory_updates
    check("between two steps", between[0].trajectory.poses[0].timestamp_us == BEGIN_US + 250_000)
    nan = pose(math.nan, 0, 0, 9)
    wrong = messages.ObjectTrajectoryUpdate(object_id=EGO, trajectory=messages.Trajectory(poses=[nan]))
    stranger = messages.ObjectTrajectoryUpdate(object_id="nobody", trajectory=ego.trajectory)
    other = messages.ObjectTrajectoryUpdate(object_id=names[0], trajectory=objects[0].trajectory)
    many = messages.TrafficSessionRequest(session_uuid="f", scene_id="demo-crossing", handover_time_us=BEGIN_US)
    many.logged_object_trajectories.extend(objects[:1] * 300)
    late = messages.TrafficSessionRequest(session_uuid="g", scene_id="demo-crossing", handover_time_us=2**64 - 1)
    cases = [
        ("FAILED_PRECONDITION", stub.simulate, at(BEGIN_US)),
        ("INVALID_ARGUMENT", stub.simulate, at(BEGIN_US + 400_000, wrong)),
        ("INVALID_ARGUMENT", stub.simulate, at(BEGIN_US + 400_000, stranger)),
        ("INVALID_ARGUMENT", stub.simulate, at(BEGIN_US + 400_000, other)),
        ("INVALID_ARGUMENT", stub.simulate, at(1 << 63)),
        ("INVALID_ARGUMENT", stub.simulate, at(BEGIN_US + 30_000_000)),
        ("NOT_FOUND", stub.simulate, at(BEGIN_US, uuid="none")),
        ("NOT_FOUND", stub.close_session, messages.TrafficSessionCloseRequest(session_uuid="none")),
        ("NOT_FOUND", stub.start_session, messages.TrafficSessionRequest(scene_id="no-such-scene")),
        ("INVALID_ARGUMENT", stub.start_session, many),
        ("INVALID_ARGUMENT", stub.start_session, late),
        ("UNIMPLEMENTED", unknown, b""),
    ]
    for code, call, argument in cases:
        found = refused(call, argument)
        check(f"{found} in place of {code}", found == code)
    check("the session goes on", stub.simulate(at(BEGIN_US + 500_000, step)).object_trajectory_updates)


command = [program, "serve", "--port", "0", "--grpc", "0", "--db", work / "scenes.sqlite"]
server = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
try:
    server.stdout.readline()
    address = server.stdout.readline().split()[-1]
    with grpc.insecure_channel(address) as channel:
        stub = service.TrafficServiceStub(channel)
        use(stub, channel.unary_unary("/traffic.TrafficService/no_such_call"))
        raw = channel.unary_unary("/traffic.TrafficService/simulate")
        check("no message", refused(raw, b"\xff" * 100) in ("INTERNAL", "INVALID_ARGUMENT"))
        check("still there", stub.get_metadata(messages.Empty()).version_id.version_id)
finally:
    server.terminate()
    server.wait()
end()
