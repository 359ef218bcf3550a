//! Writes motion as a recording of SUMO (`fcd-export`).

use super::network::Names;
use super::words::{VehicleType, kind};
use crate::format::{EGO, ExportOptions, Exported, NOW_STEP, RECORDED_STEPS};
use crate::frame::Frame;
use crate::loss::{Loss, code};
use crate::markup::{Markup, decimal};
use crate::sumo::kinds;
use crate::unwritten;
use crate::written::{BoundedFile, FileBounds};
use scene::geometry::direction;
use scene::{Agent, STEP_S, Scene, Shown, State, Vec2};
use std::io;

/// Greatest difference between a velocity along the heading and the speed in that direction, m/s.
const ALONG_MPS: f64 = 0.01;

/// A road user in the form in which it is written, in the frame of the source.
pub(super) struct ExportedAgent<'a> {
    pub name: String,
    pub agent: &'a Agent,
    pub shown: Shown<'a>,
    pub kind: VehicleType,
}

impl ExportedAgent<'_> {
    /// Distance from the centre to SUMO's reference point, metres: the middle of the front bumper, for a
    /// person the centre.
    pub fn ahead_m(&self) -> f64 {
        if self.kind.person { 0.0 } else { self.shown.size.length_m / 2.0 }
    }

    fn point(&self, state: &State) -> Vec2 {
        state.position() + direction(state.heading_rad) * self.ahead_m()
    }
}

/// Road users with a state at some step.
pub(super) fn road_users<'a>(scene: &'a Scene, options: &ExportOptions) -> Vec<ExportedAgent<'a>> {
    let mut names = Names::default();
    let written = |agent: &'a Agent| {
        let shown = options.motion.of(scene, agent);
        shown.track.valid_steps().next()?;
        let kind = kind(shown.agent_type, agent.subtype, &shown.size);
        Some(ExportedAgent { name: names.take(&agent.id), agent, shown, kind })
    };
    scene.agents.iter().filter_map(written).collect()
}

/// Number of written steps: those of the scene, or more if a future is longer.
pub(super) fn steps(scene: &Scene, written: &[ExportedAgent<'_>]) -> usize {
    let last = written.iter().filter_map(|user| user.shown.track.last_valid_step()).max();
    scene.time.steps.max(last.map_or(0, |last| last + 1))
}

/// Writes the motion of a scene.
///
/// # Errors
/// `InvalidInput` for a scene without any seen road user.
pub(in crate::sumo) fn write(scene: &Scene, options: &ExportOptions) -> io::Result<Exported> {
    let written = road_users(scene, options);
    if written.is_empty() {
        let message = crate::refusals::file_needs("FCD", crate::refusals::what::ROAD_USER);
        return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
    }
    let mut losses = losses(scene, options, &written);
    if *scene.map != scene::LaneMap::default() {
        losses.push(Loss::new(code::NO_MAP, "lanes, lines, edges and areas"));
    }
    if !scene.signals.is_empty() {
        losses.push(Loss::new(code::NO_SIGNALS, "traffic signals"));
    }
    Ok(Exported { bytes: document(scene, &written, options.bounds())?.whole()?, losses })
}

pub(super) fn document(
    scene: &Scene,
    written: &[ExportedAgent<'_>],
    bounds: FileBounds,
) -> io::Result<BoundedFile> {
    let frame = Frame::of(&scene.meta.origin);
    let mut out = Markup::new(bounds);
    out.open("fcd-export", &[]);
    for step in 0..steps(scene, written) {
        out.check()?;
        out.open("timestep", &[("time", &decimal(step as f64 * STEP_S))]);
        // SUMO lists vehicles first.
        for person in [false, true] {
            for user in written.iter().filter(|user| user.kind.person == person) {
                if let Some(state) = user.shown.track.at(step) {
                    row(user, &frame.state(state), &mut out);
                }
            }
        }
        out.close();
    }
    out.close();
    out.finish()
}

fn row(user: &ExportedAgent<'_>, state: &State, out: &mut Markup) {
    let at = user.point(state);
    // Degrees clockwise from north.
    let angle_deg = (90.0 - state.heading_rad.to_degrees()).rem_euclid(360.0);
    out.empty(
        if user.kind.person { "person" } else { "vehicle" },
        &[
            ("id", &user.name),
            ("x", &decimal(at.x)),
            ("y", &decimal(at.y)),
            ("angle", &decimal(angle_deg)),
            ("type", &user.kind.id),
            ("speed", &decimal(state.speed_mps())),
        ],
    );
}

/// Losses of the motion.
pub(super) fn losses(scene: &Scene, options: &ExportOptions, written: &[ExportedAgent<'_>]) -> Vec<Loss> {
    let mut losses = Vec::new();
    losses.extend(unwritten::conditions(scene, options.motion));
    losses.extend(unwritten::futures(scene, options.motion));
    let mut lose = |lost: bool, code, detail: &str| losses.extend(lost.then(|| Loss::new(code, detail)));
    let of_its_kind = |user: &ExportedAgent<'_>| {
        let read = kinds::of(&user.kind.id, user.kind.person);
        (read.agent_type, read.subtype) == (user.shown.agent_type, user.agent.subtype)
    };
    lose(
        !written.iter().all(of_its_kind),
        code::NO_SUBTYPE,
        "kinds that SUMO has no word for are usual ones",
    );
    let heightless =
        |user: &ExportedAgent<'_>| user.shown.size.length_m > 60.0 || user.shown.size.width_m > 60.0;
    lose(written.iter().any(heightless), code::NO_SIZES, "sizes beyond 60 m");
    lose(written.len() < scene.agents.len(), code::NO_UNSEEN, "road users without recorded states");
    let aside = |state: &State| {
        (direction(state.heading_rad) * state.speed_mps() - state.velocity()).norm() > ALONG_MPS
    };
    let mut states = written.iter().flat_map(|user| user.shown.track.states.iter().flatten());
    lose(states.any(aside), code::NO_VELOCITY, "velocities are along headings, forwards");
    let heights = written.iter().any(|user| user.agent.track.z_m.is_some());
    lose(heights, code::NO_Z, "heights of road users");
    let roles = scene.agents.iter().any(|agent| agent.role.is_some());
    lose(roles, code::NO_ROLES, &format!("roles, that of the {EGO} too"));
    let renamed = written.iter().any(|user| user.name != user.agent.id);
    lose(renamed, code::IDS_RENUMBERED, "SUMO takes no colons in ids");
    let steps = steps(scene, written);
    let now = NOW_STEP.min(steps.saturating_sub(1));
    let retimed = steps > RECORDED_STEPS || scene.time.now_step != now || scene.meta.timestamps_s.is_some();
    let detail = "the present step, and the source's times; more than 9.1 s are read as several scenes";
    lose(retimed || steps != scene.time.steps, code::NO_TIMING, detail);
    lose(scene.licence().is_some(), code::NO_LICENCE, "the file has no place for a licence");
    losses.extend(unwritten::notes(scene, ""));
    losses
}
