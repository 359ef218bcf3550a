"""One planner in Python, in Gymnasium, over HTTP and over gRPC: equal traffic in ten scenes."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python/examples"))

import roads  # noqa: E402
from ways import Pose  # noqa: E402


def test_a_planner_meets_equal_traffic_in_every_road(monkeypatch: pytest.MonkeyPatch) -> None:
    # The server and the maps come from the module of this checkout.
    monkeypatch.setenv("PYTHONPATH", str(ROOT / "python"))
    found = roads.main(["--seconds", "1"])
    assert len(found) == len({one.scene for one in found}) == 10
    for one in found:
        assert one.equal == {"gym": 10, "grpc": 10, "http": 10}, one.scene
        assert one.collisions == (0, 0) and one.off_road == (0.0, 0.0), one.scene
        replayed, reacting = one.nearest_m
        assert replayed > 0 and reacting > 0


def test_a_pose_is_what_a_message_carries() -> None:
    before, pose = Pose.of(1.0, 2.0, 3.1), Pose.of(1.5, 2.0, -3.1)
    assert Pose.of(*pose.state(before, 0.1)[:3]) == pose
    state = pose.state(before, 0.1)
    assert state.heading_rad == pytest.approx(-3.1, abs=1e-6)
    settled = Pose.settled(pose)
    assert Pose.of(*settled[:2], settled.heading) == settled
    assert (state.vx_mps, state.vy_mps) == pytest.approx((5.0, 0.0))
