"""The environments, by the checks of their interfaces."""

from __future__ import annotations

from pathlib import Path
from typing import Any, cast

import dragtraffic
import dragtraffic.envs
import gymnasium
import numpy
import pytest
from dragtraffic.envs import Drive, VectorDrive
from gymnasium.utils.env_checker import check_env
from pettingzoo.test.parallel_test import parallel_api_test

ROOT = Path(__file__).resolve().parents[2]
SCENES = ROOT / "assets/scenes"
CROSSING = SCENES / "demo-crossing.json"
ID = "dragtraffic/Drive-v0"


def drive(**arguments: Any) -> Drive:
    """The registered environment, without Gymnasium's wrappers."""
    return cast("Drive", gymnasium.make(ID, **arguments).unwrapped)


def test_gymnasiums_own_check() -> None:
    check_env(drive(scene=CROSSING))


@pytest.mark.parametrize("observation", ["parts", "gpudrive"])
def test_pettingzoos_own_check(observation: Any) -> None:
    env = dragtraffic.envs.parallel_env(CROSSING, ["4", "6"], horizon_s=2.0, observation=observation)
    parallel_api_test(env, num_cycles=60)


@pytest.mark.parametrize("mode", ["NextStep", "SameStep"])
def test_several_at_once_are_as_one_after_the_other(mode: str) -> None:
    settings: dict[str, Any] = {"scene": CROSSING, "horizon_s": 0.6}
    mode_of = gymnasium.vector.AutoresetMode(mode)
    ours = gymnasium.make_vec(ID, num_envs=3, autoreset_mode=mode_of, **settings)
    theirs = gymnasium.vector.SyncVectorEnv([lambda: Drive(**settings)] * 3, autoreset_mode=mode_of)
    assert isinstance(ours.unwrapped, VectorDrive) and ours.metadata == theirs.metadata
    assert (ours.observation_space, ours.action_space) == (theirs.observation_space, theirs.action_space)
    actions = numpy.array([[0.1, 0.0], [-1.0, 0.0], [1.0, 0.3]], dtype=numpy.float32)
    told: list[tuple[Any, Any]] = [(ours.reset(seed=5), theirs.reset(seed=5))]
    told += [(ours.step(actions), theirs.step(actions)) for _ in range(16)]
    for own, other in told:
        assert all(same(*parts) for parts in zip(own, other))
    over = numpy.array([own[2] | own[3] for own, _ in told[1:]])
    assert (over.sum(axis=0) >= 2).all(), "each began anew"


def same(own: Any, other: Any) -> bool:
    """Whether arrays, or dictionaries and arrays of these, have equal bytes and types."""
    if isinstance(own, dict):
        return own.keys() == other.keys() and all(same(own[name], other[name]) for name in own)
    if isinstance(own, numpy.ndarray) and own.dtype != object:
        return bool(own.dtype == other.dtype) and own.tobytes() == other.tobytes()
    if isinstance(own, numpy.ndarray):
        return len(own) == len(other) and all(same(*parts) for parts in zip(own, other))
    return bool(own == other)


def test_what_is_seen_has_one_of_two_forms() -> None:
    check_env(drive(scene=CROSSING, observation="gpudrive"))
    with pytest.raises(ValueError, match="parts or gpudrive"):
        drive(scene=CROSSING, observation="rows")


def test_gpudrives_row_has_ego_partners_and_map_in_their_frame_and_scale() -> None:
    parts, row = (drive(scene=CROSSING, ego="4", observation=o) for o in ("parts", "gpudrive"))
    (seen, _), (wanted, _) = row.reset(seed=1), parts.reset(seed=1)
    speed, length, width = wanted["own"][:3]
    ahead, left = wanted["goal"][:2]
    ego = [speed / 100, 0.7 * length / 30, 0.7 * width / 15, ahead / 1000, left / 1000, 0.0]
    assert seen[:6] == pytest.approx(ego, abs=1e-6)
    partners = seen[6 : 6 + 63 * 6].reshape(63, 6)
    there = partners[partners[:, 4] > 0]
    states = row.episode.run.present.states
    own = row.episode.run.present["4"]
    away = numpy.hypot(states[:, 0] - own.x_m, states[:, 1] - own.y_m)
    assert len(there) == ((away > 0) & (away <= 50)).sum() and not partners[len(there) :].any()
    nearest = there[numpy.hypot(there[:, 1], there[:, 2]).argmin()]
    other = wanted["others"][0]
    assert nearest[1:3] * 1000 == pytest.approx(other[:2], abs=1e-3)
    assert nearest[3] * 2 * numpy.pi == pytest.approx(numpy.arctan2(other[3], other[2]), abs=1e-4)
    assert nearest[4:] * (30, 15) == pytest.approx(0.7 * other[6:], abs=1e-4)
    roads = seen[6 + 63 * 6 :].reshape(200, 13)
    assert (roads[:, 6:].sum(axis=1) == 1).all(), "each element is of one kind, or of none"
    places = numpy.hypot(roads[:, 0], roads[:, 1]) * 1000
    known = roads[:, 6] == 0
    assert known.sum() > 50 and places[known].max() <= 50 and not roads[~known, :6].any()
    # The lane that the car is on goes its way.
    lanes = roads[roads[:, 9] == 1]
    x, y, half, turn = lanes[:, 0] * 1000, lanes[:, 1] * 1000, lanes[:, 2] * 100, lanes[:, 5] * 2 * numpy.pi
    along, aside = x * numpy.cos(turn) + y * numpy.sin(turn), y * numpy.cos(turn) - x * numpy.sin(turn)
    on = lanes[(abs(along) <= half) & (abs(aside) < 1)]
    assert abs(on[:, 5]).min() * 2 * numpy.pi < 0.1 and on[0, 3] == pytest.approx(0.001)


def test_gpudrives_lines_lose_points_that_hardly_bend_them() -> None:
    scene = dragtraffic.open(CROSSING)
    line = [[0.5 * at, 0.0] for at in range(21)] + [[10.0, 0.5 * at] for at in range(1, 21)]
    lane = {**scene.document["map"]["lanes"][0], "points_m": line}
    lanes = dragtraffic.Scene({**scene.document, "map": {**scene.document["map"], "lanes": [lane]}})
    kept = drive(scene=lanes, ego="4", observation="gpudrive").reset(seed=1)[0][384:].reshape(200, 13)
    halves = numpy.sort(kept[kept[:, 9] == 1][:, 2]) * 100
    assert halves == pytest.approx([5.0, 5.0], abs=0.6), "two sides are left"


def straight(env: Any, action: Any) -> list[tuple[float, bool, bool, dict[str, Any]]]:
    """An episode under one action."""
    env.reset(seed=3)
    told = []
    while True:
        _, reward, over, late, info = env.step(action)
        told.append((reward, over, late, info))
        if over or late:
            return told


def test_who_stands_stays_and_the_horizon_ends_it() -> None:
    env = drive(scene=CROSSING, ego="4", horizon_s=3.0)
    told = straight(env, numpy.array([-1.0, 0.0]))
    assert len(told) == 30 and told[-1][2] and not told[-1][1]
    assert abs(told[-1][3]["acceleration_mps2"]) < 1e-9, "it has stopped"
    assert min(info["acceleration_mps2"] for *_, info in told) >= -6.0 - 1e-6


def test_driving_on_blindly_ends_with_a_fault() -> None:
    env = drive(scene=CROSSING, ego="4")
    _, over, _, info = straight(env, numpy.array([1.0, 0.4]))[-1]
    assert over and info["faults"] and not info["reached"]


def test_a_target_state_is_where_the_ego_is() -> None:
    env = drive(scene=CROSSING, ego="4", actions="state")
    env.reset(seed=1)
    state = numpy.array([18.0, 8.0, -3.1, -4.0, 0.0])
    observation, *_ = env.step(state)
    assert env.episode.run.present["4"] == pytest.approx(state)
    assert observation["own"][0] == pytest.approx(4.0)


def test_equal_seeds_give_equal_episodes_and_folders_are_drawn_from() -> None:
    env = drive(scene=SCENES)
    first, second = (env.reset(seed=11) for _ in range(2))
    assert first[1] == second[1]
    assert all((first[0][name] == second[0][name]).all() for name in first[0])
    names = set()
    for seed in range(8):
        env.reset(seed=seed)
        names.add(env.episode.run.scene.name)
    assert len(names) > 1


def test_road_users_are_placed_anew() -> None:
    fill = {"count": 8, "types": {"vehicle": 1.0}}
    made = drive(scene=CROSSING, fill=fill)
    scenes = []
    for seed in (1, 2):
        made.reset(seed=seed)
        scenes.append(made.episode.run.present.states)
    assert len(scenes[0]) == 8 and not numpy.array_equal(scenes[0], scenes[1])


def test_a_view_is_in_the_road_users_frame() -> None:
    env = drive(scene=CROSSING, ego="4")
    observation, _ = env.reset(seed=1)
    present = env.episode.run.present
    own = present["4"]
    other = observation["others"][0]
    distances = [
        numpy.hypot(state[0] - own.x_m, state[1] - own.y_m) for id, state in zip(present.ids, present.states) if id != "4"
    ]
    assert numpy.hypot(other[0], other[1]) == pytest.approx(min(distances), abs=1e-4)
    lane = observation["lanes"][0]
    assert numpy.hypot(lane[2], lane[3]) == pytest.approx(1.0, abs=1e-4)
    assert numpy.hypot(lane[0], lane[1]) < 3.0, "a car is on a lane"


def test_the_way_to_the_goal_follows_the_lanes() -> None:
    env = drive(scene=SCENES / "demo-residential.json", fill={"count": 8, "types": {"vehicle": 1.0}})
    observation, info = env.reset(seed=3)
    (driver,) = env.episode.drivers.values()
    assert driver.left_m() > 1.05 * info["distance_m"], "it turns"
    lanes, route = observation["lanes"], observation["route"]
    ahead = route[(numpy.hypot(*route.T) < 10) & (numpy.hypot(*route.T) > 2)]
    beside = numpy.hypot(*(ahead[:, None] - lanes[None, :, :2]).transpose(2, 0, 1)).min(axis=1)
    assert len(ahead) and beside.max() < 1.5
    left = driver.left_m()
    _, _, _, _, told = env.step(numpy.array([0.0, 0.0]))
    assert told["progress_m"] == pytest.approx(left - driver.left_m()) and 0 < told["progress_m"] < 2


def test_where_no_lanes_lead_the_way_is_straight() -> None:
    scene = dragtraffic.open(CROSSING)
    bare = dragtraffic.Scene({**scene.document, "map": {**scene.document["map"], "lanes": []}})
    env = drive(scene=bare, ego="4")
    observation, info = env.reset(seed=1)
    assert env.episode.drivers["4"].left_m() == pytest.approx(info["distance_m"])
    assert observation["route"][0] == pytest.approx(4 * observation["goal"][:2] / observation["goal"][2], abs=1e-4)


def test_a_recording_with_heights_is_seen_as_one_without() -> None:
    flat = dragtraffic.open(CROSSING)
    document = flat.document
    signals = [{**s, "stop_m": s["stop_m"] and [*s["stop_m"], 1.5]} for s in document["signals"]]
    lanes = [{**lane, "points_m": [[*p[:2], 1.5] for p in lane["points_m"]]} for lane in document["map"]["lanes"]]
    high = dragtraffic.Scene({**document, "signals": signals, "map": {**document["map"], "lanes": lanes}})
    (seen, _), (wanted, _) = (drive(scene=scene, ego="4").reset(seed=1) for scene in (high, flat))
    assert all(seen[name] == pytest.approx(wanted[name]) for name in wanted)
