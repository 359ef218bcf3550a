"""PPO in one file, in the style of CleanRL: a car learns to reach its goal among road users that react.

It needs ``pip install '.[gym,plot]'`` and no tensor library: two small networks are a page of numpy.

    python python/examples/ppo.py --figure docs/ppo.svg

Each episode fills a map with other traffic and draws another car with another goal. ``--scenes`` names the maps. The
policy is tested before, during and after training on seeds, and with those of ``--unseen`` on maps, that training does
not use.
"""

from __future__ import annotations

import argparse
import os
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

# The networks are small: more threads would only wait for each other.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import dragtraffic.envs  # noqa: E402, F401  (registers the environment)
import gymnasium  # noqa: E402
import numpy as np  # noqa: E402
from numpy.typing import NDArray  # noqa: E402

Floats = NDArray[np.float32]

SCENES = Path(__file__).resolve().parents[2] / "assets/scenes"
#: Environments beside each other, steps of each before an update, passes over these, and samples of a gradient.
ENVS, ROLLOUT, EPOCHS, BATCH = 8, 256, 10, 256
GAMMA, LAMBDA, CLIP, RATE, HIDDEN = 0.97, 0.9, 0.2, 7e-4, 64
#: Others that the policy sees, the nearest ones.
OTHERS = 4
#: Logarithms of the deviations of acceleration and steering at the beginning.
SPREAD = (-1.0, -2.0)
#: Seeds of tests begin here; training uses those below.
TEST_SEED = 1_000_000


def reward(info: Mapping[str, Any]) -> float:
    """A tenth for each metre of progress, 3 for the goal, -3 for a fault, and less the farther beside the way."""
    beside = 0.1 * min(info["aside_m"], 2.0)
    return float(0.1 * info["progress_m"] - beside + 3.0 * info["reached"] - 3.0 * bool(info["faults"]))


def settings(scenes: Sequence[Path]) -> dict[str, Any]:
    """Arguments of the environment: a decision each 0.2 s, among five other vehicles."""
    fill = {"count": 6, "types": {"vehicle": 1.0}}
    return {"scene": [str(scene) for scene in scenes], "fill": fill, "reward": reward, "step_s": 0.2}


def row(seen: Mapping[str, Floats]) -> Floats:
    """What the policy sees: the way to the goal stands for the lanes, and lights are not obeyed here."""
    return np.concatenate([seen["own"], seen["goal"], seen["route"].ravel(), seen["others"][:OTHERS].ravel()])


def with_rows(env: gymnasium.Env[Any, Any]) -> gymnasium.Wrapper[Any, Any, Any, Any]:
    """The environment with one row of numbers as its observation."""
    size = len(row(env.observation_space.sample()))
    return gymnasium.wrappers.TransformObservation(env, row, gymnasium.spaces.Box(-np.inf, np.inf, (size,), np.float32))


class Network:
    """Two hidden layers of tanh, trained by Adam."""

    def __init__(self, inputs: int, outputs: int, last: float, random: np.random.Generator) -> None:
        sizes = [(inputs, HIDDEN, 1.0), (HIDDEN, HIDDEN, 1.0), (HIDDEN, outputs, last)]
        self.weights: list[Floats] = []
        for rows, columns, gain in sizes:
            drawn = random.normal(size=(rows, columns)) * gain / np.sqrt(rows)
            self.weights += [drawn.astype(np.float32), np.zeros(columns, np.float32)]
        self.adam = Adam(self.weights)
        self.seen: list[Floats] = []

    def __call__(self, x: Floats) -> Floats:
        """Outputs for rows of inputs."""
        self.seen = [x]
        for layer in (0, 2):
            x = np.tanh(x @ self.weights[layer] + self.weights[layer + 1])
            self.seen.append(x)
        out: Floats = x @ self.weights[4] + self.weights[5]
        return out

    def gradients(self, out: Floats) -> list[Floats]:
        """Gradients of the weights, from those of the last call's outputs."""
        found: list[Floats] = []
        for layer in (4, 2, 0):
            x = self.seen[layer // 2]
            found = [x.T @ out, out.sum(axis=0), *found]
            out = (out @ self.weights[layer].T) * (1.0 - x * x)
        return found


class Adam:
    """Steps of Adam on arrays, in place."""

    def __init__(self, weights: list[Floats]) -> None:
        self.weights, self.count = weights, 0
        self.first, self.second = ([np.zeros_like(w) for w in weights] for _ in range(2))

    def step(self, gradients: list[Floats], rate: float, most: float = 0.5) -> None:
        """A step, with the size of the whole gradient held below ``most``."""
        self.count += 1
        size = float(np.sqrt(sum(float((g * g).sum()) for g in gradients)))
        scale = min(1.0, most / (size + 1e-8))
        for w, g, first, second in zip(self.weights, gradients, self.first, self.second):
            g = g * np.float32(scale)
            first += np.float32(0.1) * (g - first)
            second += np.float32(0.001) * (g * g - second)
            hat = np.sqrt(second / (1.0 - 0.999**self.count)) + 1e-5
            w -= (rate * first / (1.0 - 0.9**self.count) / hat).astype(np.float32)


class Policy:
    """A normal distribution of actions, and the value of a state. Inputs are scaled by what training has seen."""

    def __init__(self, inputs: int, actions: int, seed: int) -> None:
        random = np.random.default_rng(seed)
        self.actor, self.critic = Network(inputs, actions, 0.01, random), Network(inputs, 1, 1.0, random)
        # Logarithm of the deviation. Steering that is tried at random leads off the road soon: it begins small.
        self.spread = np.array(SPREAD, np.float32)
        self.spread_adam = Adam([self.spread])
        self.mean, self.square, self.count = np.zeros(inputs), np.ones(inputs), 1e-4

    def watch(self, rows: Floats) -> None:
        """Lets the scale of the inputs follow these rows."""
        self.count += len(rows)
        share = len(rows) / self.count
        self.mean += share * (rows.mean(axis=0) - self.mean)
        self.square += share * ((rows.astype(float) ** 2).mean(axis=0) - self.square)

    def scaled(self, rows: Floats) -> Floats:
        """Inputs of the networks."""
        deviation = np.sqrt(np.maximum(self.square - self.mean**2, 1e-4))
        return np.clip((rows - self.mean) / deviation, -5.0, 5.0).astype(np.float32)

    def likelihood(self, actions: Floats, means: Floats) -> Floats:
        """Logarithm of the density of each action."""
        away = (actions - means) / np.exp(self.spread)
        log: Floats = (-0.5 * away * away - self.spread - 0.5 * np.log(2 * np.pi)).sum(axis=1)
        return log

    def update(self, rate: float, x: Floats, actions: Floats, before: Floats, gains: Floats, returns: Floats) -> None:
        """One step of PPO on a batch."""
        gains = (gains - gains.mean()) / (gains.std() + 1e-8)
        means, size = self.actor(x), np.float32(len(x))
        ratio = np.exp(self.likelihood(actions, means) - before)
        # Where the ratio has left its bounds in the direction of the gain, the objective is flat.
        moves = np.where(gains > 0, ratio < 1 + CLIP, ratio > 1 - CLIP)
        pull = (-gains * ratio * moves / size)[:, None].astype(np.float32)
        away = (actions - means) / np.exp(self.spread)
        self.actor.adam.step(self.actor.gradients(pull * away / np.exp(self.spread)), rate)
        self.spread_adam.step([(pull * (away * away - 1.0)).sum(axis=0)], rate)
        values = self.critic(x)[:, 0]
        self.critic.adam.step(self.critic.gradients(((values - returns) / size)[:, None]), rate)


@dataclass
class Test:
    """What a policy does on ``episodes`` of its own seeds: mean return, and shares of reached goals and of faults."""

    steps: int
    episodes: int
    returns: float
    reached: float
    faults: float

    def __str__(self) -> str:
        shares = f"goal {self.reached:.0%}, fault {self.faults:.0%}, neither {abs(1 - self.reached - self.faults):.0%}"
        return f"step {self.steps:7}: return {self.returns:6.2f}, {shares} of {self.episodes} episodes"


def test(policy: Policy, scenes: Sequence[Path], steps: int, episodes: int) -> Test:
    """Drives the means of the policy through held-out episodes."""
    env = with_rows(gymnasium.make("dragtraffic/Drive-v0", **settings(scenes)))
    sums: list[float] = []
    reached = faults = 0
    for episode in range(episodes):
        seen, info = env.reset(seed=TEST_SEED + episode)
        total, over, late = 0.0, False, False
        while not (over or late):
            action = policy.actor(policy.scaled(seen[None]))[0]
            seen, gained, over, late, info = env.step(np.clip(action, -1.0, 1.0))
            total += float(gained)
        sums.append(total)
        reached += info["reached"] and not info["faults"]
        faults += bool(info["faults"])
    return Test(steps, episodes, float(np.mean(sums)), reached / episodes, faults / episodes)


def train(scenes: Sequence[Path], unseen: Sequence[Path], steps: int, seed: int, episodes: int) -> list[Test]:
    """Trains a policy and tests it five times on the way; on unseen maps before and after."""
    same = {"autoreset_mode": gymnasium.vector.AutoresetMode.SAME_STEP}
    envs = gymnasium.make_vec("dragtraffic/Drive-v0", ENVS, "async", same, [with_rows], **settings(scenes))
    inputs, outputs = envs.single_observation_space.shape, envs.single_action_space.shape
    assert inputs is not None and outputs is not None
    policy, random = Policy(inputs[0], outputs[0], seed), np.random.default_rng(seed)
    tests = [test(policy, scenes, 0, episodes)]
    print(f"{tests[0]}\nunseen maps, {test(policy, unseen, 0, episodes)}", flush=True)
    updates, began = max(1, steps // (ENVS * ROLLOUT)), time.monotonic()
    now, _ = envs.reset(seed=seed)
    for number in range(updates):
        rows: list[tuple[Floats, ...]] = []
        for _ in range(ROLLOUT):
            policy.watch(now)
            x = policy.scaled(now)
            means = policy.actor(x)
            action = (means + np.exp(policy.spread) * random.normal(size=means.shape)).astype(np.float32)
            now, gained, over, late, _ = envs.step(np.clip(action, -1.0, 1.0))
            # The seconds left are observed, so the horizon is an end like any other.
            rows.append((x, action, policy.likelihood(action, means), policy.critic(x)[:, 0], gained, over | late))
        x, action, before, value, gained, ended = (np.stack(column) for column in zip(*rows))
        gains, gain = np.zeros_like(value), np.zeros(ENVS, np.float32)
        after = policy.critic(policy.scaled(now))[:, 0]
        for t in reversed(range(ROLLOUT)):
            goes_on = 1.0 - ended[t]
            gain = gained[t] + GAMMA * goes_on * after - value[t] + GAMMA * LAMBDA * goes_on * gain
            gains[t], after = gain, value[t]
        whole = [column.reshape(ENVS * ROLLOUT, -1) for column in (x, action)]
        single = [column.reshape(-1).astype(np.float32) for column in (before, gains, gains + value)]
        for _ in range(EPOCHS):
            for part in np.array_split(random.permutation(ENVS * ROLLOUT), ENVS * ROLLOUT // BATCH):
                batch = [column[part] for column in whole + single]
                policy.update(RATE * (1.0 - number / updates), *batch)
        if (number + 1) % max(1, updates // 5) == 0 or number + 1 == updates:
            tests.append(test(policy, scenes, (number + 1) * ENVS * ROLLOUT, episodes))
            print(f"{tests[-1]}, {time.monotonic() - began:.0f} s", flush=True)
    envs.close()
    print(f"unseen maps, {test(policy, unseen, tests[-1].steps, episodes)}", flush=True)
    return tests


def draw(tests: list[Test], path: Path) -> None:
    """The learning curve as a picture."""
    import matplotlib

    matplotlib.use("Agg")
    matplotlib.rcParams["svg.hashsalt"] = "dragtraffic"
    import matplotlib.pyplot as plt

    figure, (left, right) = plt.subplots(1, 2, figsize=(8, 2.8), layout="constrained")
    steps = [test.steps for test in tests]
    left.plot(steps, [test.returns for test in tests], "o-", color="#2563eb")
    left.set(xlabel="steps of training", ylabel="mean return")
    right.plot(steps, [test.reached for test in tests], "o-", color="#0f766e", label="goal without fault")
    right.plot(steps, [test.faults for test in tests], "o-", color="#c2410c", label="fault")
    right.set(xlabel="steps of training", ylabel=f"share of {tests[0].episodes} episodes", ylim=(0, 1))
    right.legend(frameon=False)
    figure.savefig(path, metadata={"Date": None} if path.suffix == ".svg" else None)


def main(arguments: Sequence[str] | None = None) -> None:
    """Trains, tests and draws."""
    parser = argparse.ArgumentParser(description="Trains a policy with PPO.")
    known = [SCENES / f"demo-{name}.json" for name in ("crossing", "roundabout", "residential")]
    parser.add_argument("--scenes", type=Path, nargs="+", default=known, help="maps of training")
    parser.add_argument("--unseen", type=Path, nargs="+", default=[SCENES / "demo-arterial.json"], help="maps of tests alone")
    parser.add_argument("--steps", type=int, default=80_000, help="of all environments together")
    parser.add_argument("--episodes", type=int, default=50, help="of each test")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--figure", type=Path, help="the learning curve, as SVG or PNG")
    asked = parser.parse_args(arguments)
    tests = train(asked.scenes, asked.unseen, asked.steps, asked.seed, asked.episodes)
    if asked.figure:
        draw(tests, asked.figure)


if __name__ == "__main__":
    main()
