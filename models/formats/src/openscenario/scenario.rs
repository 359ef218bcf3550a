//! Writes a scene as OpenSCENARIO 1.2.

use super::signals;
use crate::format::ExportOptions;
use crate::loss::{Loss, code};
use crate::markup::{Markup, decimal};
use crate::unwritten;
use crate::written::BoundedFile;
use scene::geometry::direction;
use scene::{Agent, AgentType, STEP_S, Scene, Shown, Size, State, Subtype};
use std::collections::{BTreeSet, HashSet};
use std::io;

/// Distances of the rear axle behind the centre of a vehicle and of the front axle ahead of it, as shares of
/// the length. Positions in scenarios are those of the rear axle.
const REAR: f64 = 0.3;
const FRONT: f64 = 0.3;
/// Vehicle properties that a scenario requires and a scene lacks: maximum speed, acceleration and braking.
const PERFORMANCE: [(&str, &str); 3] =
    [("maxSpeed", "70"), ("maxAcceleration", "10"), ("maxDeceleration", "10")];
/// A road user that moves less than this in the last step is at rest, metres.
const STANDS_M: f64 = 0.05;
/// Rule of a condition that holds from a time on.
const FROM: &str = "greaterOrEqual";
/// Date of all files, so that they do not depend on the time of writing.
const DAY: &str = "1970-01-01T00:00:00";

/// A road user as an entity of the scenario.
struct ScenarioEntity<'a> {
    name: String,
    agent: &'a Agent,
    shown: Shown<'a>,
    /// Steps with a state, at least one.
    states: Vec<(usize, State)>,
}

impl ScenarioEntity<'_> {
    fn is_vehicle(&self) -> bool {
        self.shown.agent_type != AgentType::Pedestrian
    }

    /// Distance from the scenario's reference point to the centre of the box, metres.
    fn ahead_m(&self) -> f64 {
        if self.is_vehicle() { REAR * self.shown.size.length_m } else { 0.0 }
    }

    fn first(&self) -> (usize, State) {
        self.states.first().copied().unwrap_or_default()
    }

    fn last_step(&self) -> usize {
        self.states.last().map_or(0, |(step, _)| *step)
    }
}

/// Writes the scenario; `road_file` is the name of the map beside it.
pub(super) fn write(
    scene: &Scene,
    options: &ExportOptions,
    road_file: Option<&str>,
    losses: &mut BTreeSet<Loss>,
) -> io::Result<BoundedFile> {
    let written = road_users(scene, options, losses);
    let end =
        written.iter().map(ScenarioEntity::last_step).fold(scene.time.steps.saturating_sub(1), usize::max);
    let mut out = Markup::new(options.bounds());
    out.open("OpenSCENARIO", &[]);
    header(scene, &mut out);
    out.empty("CatalogLocations", &[]);
    out.open("RoadNetwork", &[]);
    if let Some(file) = road_file {
        out.empty("LogicFile", &[("filepath", file)]);
        signals::write(scene, &mut out, losses);
    }
    out.close();
    out.open("Entities", &[]);
    written.iter().for_each(|road_user| entity(road_user, &mut out));
    out.close();
    out.open("Storyboard", &[]);
    init(&written, &mut out);
    if !written.is_empty() {
        story(&written, end, &mut out);
    }
    out.open("StopTrigger", &[]);
    condition("end", FROM, end as f64 * STEP_S, &mut out);
    out.close();
    lost(scene, options, &written, losses);
    out.finish()
}

fn header(scene: &Scene, out: &mut Markup) {
    let description = "Metres, radians and seconds; x east and y north in the frame of the map.";
    out.open(
        "FileHeader",
        &[
            ("revMajor", "1"),
            ("revMinor", "2"),
            ("date", DAY),
            ("description", &format!("{}. {description}", scene.name)),
            ("author", "DragTraffic"),
        ],
    );
    if let Some(licence) = scene.licence() {
        out.empty("License", &[("name", &licence)]);
    }
    out.open("Properties", &[]);
    let meta = &scene.meta;
    for (name, value) in [("source", Some(&meta.source)), ("source_id", meta.source_id.as_ref())] {
        if let Some(value) = value.filter(|value| !value.is_empty()) {
            out.empty("Property", &[("name", name), ("value", value)]);
        }
    }
    out.close();
    out.close();
}

/// Road users with a state at some step, each with a unique name.
fn road_users<'a>(
    scene: &'a Scene,
    options: &ExportOptions,
    losses: &mut BTreeSet<Loss>,
) -> Vec<ScenarioEntity<'a>> {
    let mut names = HashSet::new();
    let mut written = Vec::new();
    for agent in &scene.agents {
        let shown = options.motion.of(scene, agent);
        let track = &shown.track;
        let states: Vec<(usize, State)> =
            track.valid_steps().filter_map(|step| Some((step, *track.at(step)?))).collect();
        if states.is_empty() {
            losses
                .insert(Loss::new(code::NO_CONDITIONS, "road users that were put somewhere and never moved"));
            continue;
        }
        if states.windows(2).any(|pair| pair[1].0 > pair[0].0 + 1) {
            losses
                .insert(Loss::new(code::NO_VALIDITY_GAPS, "straight motion where a road user was not seen"));
        }
        // A name with a colon would refer to a catalogue in another file.
        let mut name = agent.id.replace(':', "-");
        while !names.insert(name.clone()) {
            name.push('\'');
        }
        written.push(ScenarioEntity { name, agent, shown, states });
    }
    written
}

fn entity(road_user: &ScenarioEntity<'_>, out: &mut Markup) {
    let Size { length_m, width_m, height_m } = road_user.shown.size;
    let height_m = height_m.unwrap_or(1.5);
    let bounding_box = |out: &mut Markup| {
        out.open("BoundingBox", &[]);
        let middle = [("x", &*decimal(road_user.ahead_m())), ("y", "0"), ("z", &*decimal(height_m / 2.0))];
        out.empty("Center", &middle);
        let size =
            [("width", &*decimal(width_m)), ("length", &*decimal(length_m)), ("height", &*decimal(height_m))];
        out.empty("Dimensions", &size);
        out.close();
    };
    let properties = |out: &mut Markup| {
        out.open("Properties", &[]);
        if let Some(role) = &road_user.agent.role {
            out.empty("Property", &[("name", "role"), ("value", role)]);
        }
        out.close();
    };
    out.open("ScenarioObject", &[("name", &road_user.name)]);
    if road_user.is_vehicle() {
        let category = category(road_user.shown.agent_type, road_user.agent.subtype);
        out.open("Vehicle", &[("name", category), ("vehicleCategory", category)]);
        bounding_box(out);
        out.empty("Performance", &PERFORMANCE);
        out.open("Axles", &[]);
        let axle = |name, x_m: f64, steering: &str, out: &mut Markup| {
            let wheel_m = decimal((0.4 * height_m).clamp(0.2, 1.2));
            out.empty(
                name,
                &[
                    ("maxSteering", steering),
                    ("wheelDiameter", &wheel_m),
                    ("trackWidth", &decimal(0.9 * width_m)),
                    ("positionX", &decimal(x_m)),
                    ("positionZ", &decimal((0.2 * height_m).clamp(0.1, 0.6))),
                ],
            );
        };
        axle("FrontAxle", (REAR + FRONT) * length_m, "0.5", out);
        axle("RearAxle", 0.0, "0", out);
        out.close();
        properties(out);
    } else {
        let child = road_user.agent.subtype == Subtype::Child;
        let name = if child { "child" } else { "adult" };
        out.open(
            "Pedestrian",
            &[
                ("name", name),
                ("mass", if child { "30" } else { "75" }),
                (
                    "pedestrianCategory",
                    if road_user.agent.subtype == Subtype::Wheelchair { "wheelchair" } else { "pedestrian" },
                ),
            ],
        );
        bounding_box(out);
        properties(out);
    }
    out.close();
    out.close();
}

/// The category of a vehicle.
fn category(agent_type: AgentType, subtype: Subtype) -> &'static str {
    match (agent_type, subtype) {
        (_, Subtype::Truck) => "truck",
        (_, Subtype::Bus) => "bus",
        (_, Subtype::Van) => "van",
        (_, Subtype::Trailer) => "trailer",
        (_, Subtype::Motorcycle | Subtype::Scooter) => "motorbike",
        (AgentType::Cyclist, _) | (_, Subtype::Bicycle) => "bicycle",
        _ => "car",
    }
}

/// A position: the rear axle of vehicles, the centre of others.
fn position(road_user: &ScenarioEntity<'_>, state: &State, out: &mut Markup) {
    let place = state.position() - direction(state.heading_rad) * road_user.ahead_m();
    out.open("Position", &[]);
    out.empty(
        "WorldPosition",
        &[
            ("x", &*decimal(place.x)),
            ("y", &*decimal(place.y)),
            ("z", "0"),
            ("h", &*decimal(state.heading_rad)),
        ],
    );
    out.close();
}

/// Speed along the heading, negative backwards, m/s.
fn speed_mps(state: &State) -> f64 {
    state.velocity().dot(&direction(state.heading_rad))
}

fn init(written: &[ScenarioEntity<'_>], out: &mut Markup) {
    out.open("Init", &[]);
    out.open("Actions", &[]);
    for road_user in written.iter().filter(|road_user| road_user.first().0 == 0) {
        let state = road_user.first().1;
        out.open("Private", &[("entityRef", &road_user.name)]);
        out.open("PrivateAction", &[]);
        out.open("TeleportAction", &[]);
        position(road_user, &state, out);
        out.close();
        out.close();
        out.open("PrivateAction", &[]);
        out.open("LongitudinalAction", &[]);
        out.open("SpeedAction", &[]);
        out.empty(
            "SpeedActionDynamics",
            &[("dynamicsShape", "step"), ("value", "0"), ("dynamicsDimension", "time")],
        );
        out.open("SpeedActionTarget", &[]);
        out.empty("AbsoluteTargetSpeed", &[("value", &decimal(speed_mps(&state)))]);
        out.close();
        out.close();
        out.close();
        out.close();
        out.close();
    }
    out.close();
    out.close();
}

/// A condition on the time, as a separate trigger.
fn condition(name: &str, rule: &str, from_s: f64, out: &mut Markup) {
    out.open("ConditionGroup", &[]);
    out.open("Condition", &[("name", name), ("delay", "0"), ("conditionEdge", "none")]);
    out.open("ByValueCondition", &[]);
    out.empty("SimulationTimeCondition", &[("value", &decimal(from_s)), ("rule", rule)]);
    out.close();
    out.close();
    out.close();
}

fn story(written: &[ScenarioEntity<'_>], end: usize, out: &mut Markup) {
    out.open("Story", &[("name", "traffic")]);
    out.open("Act", &[("name", "drive")]);
    for road_user in written {
        let name = &road_user.name;
        out.open("ManeuverGroup", &[("name", &format!("{name} moves")), ("maximumExecutionCount", "1")]);
        out.open("Actors", &[("selectTriggeringEntities", "false")]);
        out.empty("EntityRef", &[("entityRef", name)]);
        out.close();
        out.open("Maneuver", &[("name", &format!("{name} follows its track"))]);
        let (first, state) = road_user.first();
        if first > 0 {
            event(&format!("{name} comes"), first, out, |out| {
                present(name, out, |out| {
                    out.open("AddEntityAction", &[]);
                    position(road_user, &state, out);
                    out.close();
                });
            });
        }
        event(&format!("{name} goes"), first, out, |out| follow(road_user, out));
        let last = road_user.last_step();
        if last < end {
            event(&format!("{name} leaves"), last + 1, out, |out| {
                present(name, out, |out| out.empty("DeleteEntityAction", &[]));
            });
        }
        out.close();
        out.close();
    }
    out.open("StartTrigger", &[]);
    condition("begin", FROM, 0.0, out);
    out.close();
    out.close();
    out.close();
}

/// An event with one action at a step.
fn event(name: &str, step: usize, out: &mut Markup, action: impl FnOnce(&mut Markup)) {
    out.open("Event", &[("name", name), ("priority", "parallel"), ("maximumExecutionCount", "1")]);
    out.open("Action", &[("name", name)]);
    action(out);
    out.close();
    out.open("StartTrigger", &[]);
    // Immediate actions wait until the initial actions are done: players would stop these, with a warning.
    let rule = if step > 0 { FROM } else { "greaterThan" };
    condition(&format!("{name} at"), rule, step as f64 * STEP_S, out);
    out.close();
    out.close();
}

/// An action that adds or removes a road user.
fn present(name: &str, out: &mut Markup, action: impl FnOnce(&mut Markup)) {
    out.open("GlobalAction", &[]);
    out.open("EntityAction", &[("entityRef", name)]);
    action(out);
    out.close();
    out.close();
}

/// Writes its trajectory, timed by the clock of the scenario.
fn follow(road_user: &ScenarioEntity<'_>, out: &mut Markup) {
    out.open("PrivateAction", &[]);
    out.open("RoutingAction", &[]);
    out.open("FollowTrajectoryAction", &[]);
    out.open("TrajectoryRef", &[]);
    out.open("Trajectory", &[("name", &format!("{} track", road_user.name)), ("closed", "false")]);
    out.open("Shape", &[]);
    out.open("Polyline", &[]);
    let vertex = |(step, state): (usize, &State), out: &mut Markup| {
        out.open("Vertex", &[("time", &decimal(step as f64 * STEP_S))]);
        position(road_user, state, out);
        out.close();
    };
    for (step, state) in &road_user.states {
        vertex((*step, state), out);
    }
    // A polyline needs two points: a road user that is seen once stays for one step. One that stands at the
    // end stays for another step, since players rotate it to the direction of the last segment, which has
    // none.
    let held = match &road_user.states[..] {
        [.., (_, before), (step, last)] => {
            ((last.position() - before.position()).norm() < STANDS_M).then_some((step, last))
        }
        [(step, only)] => Some((step, only)),
        [] => None,
    };
    if let Some((step, state)) = held {
        vertex((step + 1, state), out);
    }
    out.close();
    out.close();
    out.close();
    out.close();
    out.open("TimeReference", &[]);
    out.empty("Timing", &[("domainAbsoluteRelative", "absolute"), ("scale", "1"), ("offset", "0")]);
    out.close();
    out.empty("TrajectoryFollowingMode", &[("followingMode", "position")]);
    out.close();
    out.close();
    out.close();
}

fn lost(scene: &Scene, options: &ExportOptions, written: &[ScenarioEntity<'_>], losses: &mut BTreeSet<Loss>) {
    losses.extend(unwritten::conditions(scene, options.motion));
    losses.extend(unwritten::futures(scene, options.motion));
    losses.insert(Loss::new(code::NO_VELOCITY, "speeds after the first moment follow from places and times"));
    let unusual =
        |agent: &&Agent| matches!(agent.subtype, Subtype::Emergency) || agent.agent_type == AgentType::Other;
    if written.iter().map(|road_user| road_user.agent).any(|agent| unusual(&agent)) {
        losses
            .insert(Loss::new(code::NO_SUBTYPE, "emergency vehicles, and things of no known kind, are cars"));
    }
    let heights = |agent: &Agent| agent.track.z_m.is_some();
    if written.iter().any(|road_user| heights(road_user.agent)) {
        losses.insert(Loss::new(code::NO_Z, "heights of road users"));
    }
    losses.extend(unwritten::notes(scene, &scene.name));
}
