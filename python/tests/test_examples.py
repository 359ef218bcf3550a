"""The examples do what they say, in small."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any, cast

import numpy
import pytest

ROOT = Path(__file__).resolve().parents[2]
SCENES = ROOT / "assets/scenes"
sys.path.insert(0, str(ROOT / "python/examples"))

import goals  # noqa: E402
import ppo  # noqa: E402
import vector  # noqa: E402


def test_gradients_of_the_example_are_those_of_its_networks() -> None:
    random = numpy.random.default_rng(0)
    network = ppo.Network(7, 2, 1.0, random)
    # In double precision, so that differences tell.
    network.weights = [cast("Any", weights.astype(float)) for weights in network.weights]
    rows, wanted = (cast("Any", random.normal(size=(5, columns))) for columns in (7, 2))

    def loss() -> float:
        return float(0.5 * ((network(rows) - wanted) ** 2).sum())

    found = network.gradients(network(rows) - wanted)
    for weights, gradients in zip(network.weights, found):
        at = tuple(int(random.integers(size)) for size in weights.shape)
        kept, losses = weights[at], []
        for shift in (1e-5, -1e-5):
            weights[at] = kept + shift
            losses.append(loss())
        weights[at] = kept
        assert (losses[0] - losses[1]) / 2e-5 == pytest.approx(float(gradients[at]), abs=1e-6)


def test_updates_of_the_example_lead_to_what_is_rewarded() -> None:
    policy, random = ppo.Policy(1, 2, seed=1), numpy.random.default_rng(1)
    rows = numpy.ones((128, 1), numpy.float32)
    for _ in range(60):
        means = policy.actor(rows)
        actions = (means + numpy.exp(policy.spread) * random.normal(size=means.shape)).astype(numpy.float32)
        rewards = -((actions - (0.5, -0.3)) ** 2).sum(axis=1).astype(numpy.float32)
        before, values = policy.likelihood(actions, means), policy.critic(rows)[:, 0]
        for _ in range(4):
            policy.update(5e-3, rows, actions, before, rewards - values, rewards)
    assert policy.actor(rows)[0] == pytest.approx((0.5, -0.3), abs=0.05)


def test_the_example_trains_tests_and_draws(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for name, value in (("ENVS", 2), ("ROLLOUT", 8), ("BATCH", 8)):
        monkeypatch.setattr(ppo, name, value)
    scene = str(SCENES / "demo-roundabout.json")
    figure = tmp_path / "curve.svg"
    ppo.main(["--scenes", scene, "--unseen", scene, "--steps", "32", "--episodes", "1", "--figure", str(figure)])
    told = capsys.readouterr().out.splitlines()
    heads = [" ".join(line.split(":")[0].split()) for line in told]
    assert heads == ["step 0", "unseen maps, step 0", "step 16", "step 32", "unseen maps, step 32"]
    assert "<svg" in figure.read_text()


def test_environments_are_timed_alone_and_together(capsys: pytest.CaptureFixture[str]) -> None:
    vector.main([str(SCENES / "demo-crossing.json"), "--envs", "1", "2", "--steps", "2"])
    rows = [line.strip("| ").split(" | ") for line in capsys.readouterr().out.splitlines()[2:]]
    assert [row[0] for row in rows] == ["1", "2"] and all(float(cell) > 0 for row in rows for cell in row[1:])


def test_a_run_says_what_became_of_each_who_had_a_way_to_go(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(goals, "RUN_S", 9.5)
    found = goals.drive(SCENES / "demo-roundabout.json", 1)
    assert len(found) > 10 and all(one.way_m > 2 and one.type != "other" for one in found)
    assert sum(not one.lost for one in found) > 0.8 * len(found)
    said, low, high = goals.share(found)
    assert 0.8 < said <= 1 and low == high == said, "one scene has no interval"
