//! Converts timed poses to states of a scene and back.

use super::messages::{BoxPose, ObjectMotion, PoseQuaternion, PoseTrajectory, PoseVector, TimedPose};
use scene::{State, wrap_angle};

/// Greatest distance in time at which a pose is used, microseconds.
const NEAR_US: u64 = 60_000;
/// Largest accepted coordinate, metres.
const MOST_M: f64 = scene::MAX_COORDINATE_M;

/// A pose in the plane at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanePose {
    /// Microseconds.
    pub at_us: u64,
    /// Metres.
    pub x_m: f64,
    /// Metres.
    pub y_m: f64,
    /// Height, metres.
    pub z_m: f64,
    /// Radians.
    pub heading_rad: f64,
}

impl PlanePose {
    fn of(timed: &TimedPose) -> Option<Self> {
        let pose = timed.pose?;
        let place = pose.vec.unwrap_or_default();
        let [x_m, y_m, z_m] = [place.x, place.y, place.z].map(f64::from);
        let turn = pose.quat.unwrap_or(PoseQuaternion { w: 1.0, ..PoseQuaternion::default() });
        let [w, x, y, z] = [turn.w, turn.x, turn.y, turn.z].map(f64::from);
        let heading_rad = (2.0 * (w * z + x * y)).atan2(w * w + x * x - y * y - z * z);
        let is_place = |value: f64| value.is_finite() && value.abs() <= MOST_M;
        let is_pose = is_place(x_m) && is_place(y_m) && is_place(z_m) && heading_rad.is_finite();
        is_pose.then_some(Self { at_us: timed.timestamp_us, x_m, y_m, z_m, heading_rad })
    }

    /// Interpolates between this pose and a later one.
    fn towards(&self, other: &Self, at_us: u64) -> Self {
        let span = other.at_us.saturating_sub(self.at_us);
        let share = if span == 0 { 0.0 } else { at_us.saturating_sub(self.at_us) as f64 / span as f64 };
        let between = |from: f64, to: f64| from + share * (to - from);
        let turn = wrap_angle(other.heading_rad - self.heading_rad);
        Self {
            at_us,
            x_m: between(self.x_m, other.x_m),
            y_m: between(self.y_m, other.y_m),
            z_m: between(self.z_m, other.z_m),
            heading_rad: wrap_angle(self.heading_rad + share * turn),
        }
    }
}

/// Poses of a trajectory; `None` if one is invalid, or times do not rise.
pub fn poses(trajectory: Option<&PoseTrajectory>) -> Option<Vec<PlanePose>> {
    let all = trajectory.map_or(&[][..], |trajectory| &trajectory.poses);
    let poses: Vec<PlanePose> = all.iter().map(PlanePose::of).collect::<Option<_>>()?;
    poses.is_sorted_by(|a, b| a.at_us < b.at_us).then_some(poses)
}

/// The pose at a time; `None` outside the range of the poses.
pub fn at(poses: &[PlanePose], at_us: u64) -> Option<PlanePose> {
    let after = poses.partition_point(|pose| pose.at_us < at_us);
    match (after.checked_sub(1).and_then(|before| poses.get(before)), poses.get(after)) {
        (Some(before), Some(after)) => Some(before.towards(after, at_us)),
        (None, Some(one)) | (Some(one), None) => {
            (one.at_us.abs_diff(at_us) <= NEAR_US).then_some(PlanePose { at_us, ..*one })
        }
        (None, None) => None,
    }
}

/// A state from two poses `apart_s` seconds apart.
pub fn state(pose: &PlanePose, before: &PlanePose, apart_s: f64) -> State {
    let speed = |now: f64, then: f64| if apart_s > 0.0 { (now - then) / apart_s } else { 0.0 };
    State {
        x_m: pose.x_m,
        y_m: pose.y_m,
        heading_rad: wrap_angle(pose.heading_rad),
        vx_mps: speed(pose.x_m, before.x_m),
        vy_mps: speed(pose.y_m, before.y_m),
    }
}

/// The motion of a road user as a single pose.
pub fn reply(object_id: &str, pose: &PlanePose) -> ObjectMotion {
    let (sin, cos) = (0.5 * pose.heading_rad).sin_cos();
    let place = PoseVector { x: pose.x_m as f32, y: pose.y_m as f32, z: pose.z_m as f32 };
    let turn = PoseQuaternion { w: cos as f32, z: sin as f32, ..PoseQuaternion::default() };
    let pose =
        TimedPose { pose: Some(BoxPose { vec: Some(place), quat: Some(turn) }), timestamp_us: pose.at_us };
    let trajectory = Some(PoseTrajectory { poses: vec![pose] });
    ObjectMotion { object_id: object_id.to_owned(), trajectory }
}

/// Interpolates between the states of two steps.
pub fn between(before: &State, after: &State, share: f64, at_us: u64, z_m: f64) -> PlanePose {
    let of = |state: &State, at_us| PlanePose {
        at_us,
        x_m: state.x_m,
        y_m: state.y_m,
        z_m,
        heading_rad: state.heading_rad,
    };
    let pose = of(before, 0).towards(&of(after, 1_000_000), (share * 1e6).round() as u64);
    PlanePose { at_us, ..pose }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pose(at_us: u64, x_m: f64, heading_rad: f64) -> PlanePose {
        PlanePose { at_us, x_m, y_m: 0.0, z_m: 1.0, heading_rad }
    }

    #[test]
    fn poses_lie_between_those_beside_them_and_end_with_them() {
        let line = [pose(0, 0.0, 3.0), pose(100_000, 2.0, -3.0)];
        let middle = at(&line, 50_000).unwrap();
        assert!(
            (middle.x_m - 1.0).abs() < 1e-9 && (middle.heading_rad.abs() - std::f64::consts::PI).abs() < 1e-9
        );
        assert_eq!(at(&line, 150_000).map(|pose| pose.x_m), Some(2.0));
        assert_eq!(at(&line, 200_000), None);
        assert_eq!(at(&[], 0), None);
    }

    #[test]
    fn a_pose_comes_back_as_it_was() {
        let given = PlanePose { at_us: 7, x_m: 3.0, y_m: -4.0, z_m: 0.5, heading_rad: 2.5 };
        let again = poses(reply("a", &given).trajectory.as_ref()).unwrap();
        assert!((again[0].heading_rad - 2.5).abs() < 1e-6 && again[0].y_m == -4.0 && again[0].at_us == 7);
        let falling =
            PoseTrajectory { poses: vec![TimedPose { pose: Some(BoxPose::default()), timestamp_us: 3 }; 2] };
        assert_eq!(poses(Some(&falling)), None);
        let nowhere = BoxPose { vec: Some(PoseVector { x: f32::NAN, y: 0.0, z: 0.0 }), quat: None };
        let nowhere = PoseTrajectory { poses: vec![TimedPose { pose: Some(nowhere), timestamp_us: 0 }] };
        assert_eq!(poses(Some(&nowhere)), None);
    }
}
