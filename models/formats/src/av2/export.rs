//! Writes a scene as the rows of a scenario.

use super::{AV, CITY, FOCAL, FRAGMENT, NOTE, SCORED, UNSCORED};
use crate::columnar::{self, Column, ColumnValues};
use crate::format::{EGO, Exported, ExportedMotion};
use crate::frame::Frame;
use crate::loss::{Loss, code};
use crate::unwritten;
use scene::map::LaneMap;
use scene::{Agent, AgentType, Conditions, STEP_S, Scene, Shown, State, Subtype};
use std::borrow::Cow;
use std::io;

/// A track in the form of the file.
struct Track<'a> {
    id: Cow<'a, str>,
    object_type: &'static str,
    category: i64,
    /// Step and state, in the source's frame.
    states: Vec<(usize, State)>,
}

/// Writes the scenario of a scene.
///
/// # Errors
/// Those of the library; none is expected.
pub(super) fn write(scene: &Scene, motion: ExportedMotion) -> io::Result<Exported> {
    let frame = Frame::of(&scene.meta.origin);
    let focal = focal(scene);
    let mut losses = Vec::new();
    let tracks: Vec<Track<'_>> =
        scene.agents.iter().map(|agent| track(scene, agent, motion, focal, frame)).collect();
    let steps = tracks.iter().flat_map(|track| track.states.last()).map(|(step, _)| step + 1);
    let steps = steps.fold(scene.time.steps, usize::max);
    losses.extend(unwritten::length(scene, steps));
    lost(scene, motion, &mut losses);
    let rows: Vec<(&Track<'_>, usize, State)> = tracks
        .iter()
        .flat_map(|track| track.states.iter().map(move |(step, state)| (track, *step, *state)))
        .collect();
    let text = |of: &dyn Fn(&Track<'_>) -> String| {
        ColumnValues::Text(rows.iter().map(|(track, ..)| Some(of(track))).collect())
    };
    let number = |of: fn(&State) -> f64| {
        ColumnValues::Number(rows.iter().map(|(.., state)| Some(of(state))).collect())
    };
    let same = |value: &str| ColumnValues::Text(vec![Some(value.to_owned()); rows.len()]);
    let id = scene.meta.source_id.as_ref().or(scene.id.as_ref()).unwrap_or(&scene.name);
    let (start, end) = times(scene, steps);
    let city = scene.meta.tags.iter().find_map(|tag| tag.strip_prefix(CITY)).unwrap_or("unknown");
    let focal_id = tracks.iter().find(|track| track.category == FOCAL).map_or("", |track| &track.id);
    let observed = rows.iter().map(|(_, step, _)| Some(*step <= scene.time.now_step)).collect();
    let columns = [
        ("observed", ColumnValues::Flag(observed)),
        ("track_id", text(&|track| track.id.to_string())),
        ("object_type", text(&|track| track.object_type.to_owned())),
        (
            "object_category",
            ColumnValues::Whole(rows.iter().map(|(track, ..)| Some(track.category)).collect()),
        ),
        ("timestep", ColumnValues::Whole(rows.iter().map(|(_, step, _)| Some(*step as i64)).collect())),
        ("position_x", number(|s| s.x_m)),
        ("position_y", number(|s| s.y_m)),
        ("heading", number(|s| s.heading_rad)),
        ("velocity_x", number(|s| s.vx_mps)),
        ("velocity_y", number(|s| s.vy_mps)),
        ("scenario_id", same(id)),
        ("start_timestamp", ColumnValues::Number(vec![Some(start); rows.len()])),
        ("end_timestamp", ColumnValues::Number(vec![Some(end); rows.len()])),
        ("num_timestamps", ColumnValues::Whole(vec![Some(steps as i64); rows.len()])),
        ("focal_track_id", same(focal_id)),
        ("city", same(city)),
    ];
    let column = |(name, values)| Column { name, required: false, values };
    let mut notes = vec![
        (NOTE.to_owned(), "metres, seconds, radians; the source's frame; 10 Hz".to_owned()),
        ("source".to_owned(), scene.meta.source.clone()),
    ];
    notes.extend(scene.licence().map(|licence| ("licence".to_owned(), licence)));
    let bytes = columnar::write([columns.map(column).into()], notes)?;
    losses.sort();
    Ok(Exported { bytes, losses })
}

/// The focal road user, which the format requires.
fn focal(scene: &Scene) -> Option<&str> {
    let listed =
        scene.meta.objects_of_interest.first().or(scene.meta.tracks_to_predict.first().map(|(id, _)| id));
    let asked = || {
        let sample = scene.generated.as_ref().and_then(|g| g.samples.get(g.chosen_sample));
        sample.and_then(|sample| sample.agents.keys().next())
    };
    let longest = || scene.agents.iter().max_by_key(|agent| agent.track.valid_steps().count()).map(|a| &a.id);
    listed.or_else(asked).or_else(longest).map(String::as_str)
}

fn track<'a>(
    scene: &Scene,
    agent: &'a Agent,
    motion: ExportedMotion,
    focal: Option<&str>,
    frame: Frame,
) -> Track<'a> {
    let shown = match motion {
        ExportedMotion::Chosen => scene.shown(agent),
        ExportedMotion::Log => {
            Shown { agent_type: agent.agent_type, size: agent.size, track: Cow::Borrowed(&agent.track) }
        }
    };
    let states: Vec<(usize, State)> = shown
        .track
        .valid_steps()
        .filter_map(|step| Some((step, frame.state(shown.track.at(step)?))))
        .collect();
    let predicted = scene.meta.tracks_to_predict.iter().any(|(id, _)| *id == agent.id);
    let category = match () {
        () if focal == Some(agent.id.as_str()) => FOCAL,
        () if predicted => SCORED,
        () if states.len() >= scene.time.steps => UNSCORED,
        () => FRAGMENT,
    };
    let is_ego = agent.role.as_deref() == Some(EGO);
    Track {
        id: if is_ego { Cow::Borrowed(AV) } else { Cow::Borrowed(&agent.id) },
        object_type: object_type(shown.agent_type, agent.subtype),
        category,
        states,
    }
}

fn object_type(agent_type: AgentType, subtype: Subtype) -> &'static str {
    match (agent_type, subtype) {
        (AgentType::Vehicle, Subtype::Bus) => "bus",
        (AgentType::Vehicle, Subtype::Motorcycle) => "motorcyclist",
        (AgentType::Vehicle, _) => "vehicle",
        (AgentType::Pedestrian, _) => "pedestrian",
        (AgentType::Cyclist, _) => "cyclist",
        (AgentType::Other, _) => "unknown",
    }
}

/// First and last time, nanoseconds.
fn times(scene: &Scene, steps: usize) -> (f64, f64) {
    let whole_s = (steps - 1) as f64 * STEP_S;
    let (start_s, end_s) = match scene.meta.timestamps_s.as_deref() {
        Some([first, .., last]) => {
            let beyond = steps.saturating_sub(scene.meta.timestamps_s.as_ref().map_or(0, Vec::len));
            (*first, last + beyond as f64 * STEP_S)
        }
        _ => (0.0, whole_s),
    };
    ((start_s * 1e9).round(), (end_s * 1e9).round())
}

fn lost(scene: &Scene, motion: ExportedMotion, losses: &mut Vec<Loss>) {
    let agents = &scene.agents;
    let generated = scene.generated.is_some();
    let chosen = motion == ExportedMotion::Chosen;
    let samples = || scene.generated.iter().flat_map(|g| &g.samples);
    let futures = || samples().flat_map(|sample| sample.agents.values());
    let further = samples().count() > 1 || futures().any(|f| f.modes.len() > 1);
    let plain = |agent: &Agent| {
        let known = matches!(agent.subtype, Subtype::Unknown)
            || agent.agent_type == AgentType::Vehicle
                && matches!(agent.subtype, Subtype::Bus | Subtype::Motorcycle);
        !known
    };
    let ego = |agent: &&Agent| agent.role.as_deref() == Some(EGO);
    let renamed = agents.iter().filter(ego).any(|agent| agent.id != AV);
    let fixed = agents.iter().any(|agent| agent.conditions != Conditions::default());
    let heights = agents.iter().any(|agent| agent.track.z_m.is_some());
    let own_tags = scene.meta.tags.iter().any(|tag| !tag.starts_with(CITY));
    let meta = &scene.meta;
    let noted = own_tags || !meta.notes.is_empty() || meta.parent_id.is_some() || !scene.extra.is_empty();
    let id = meta.source_id.as_ref().or(scene.id.as_ref()).unwrap_or(&scene.name);
    let unseen = agents.iter().any(|agent| agent.track.valid_steps().next().is_none());
    let all = [
        (*scene.map != LaneMap::default(), code::NO_MAP, "the map: it is a file of its own in this format"),
        (!scene.signals.is_empty(), code::NO_SIGNALS, "traffic signals"),
        (!agents.is_empty(), code::NO_SIZES, "boxes of road users"),
        (fixed, code::NO_CONDITIONS, "starts, goals, sizes and types that the user fixed"),
        (generated && chosen, code::NO_GENERATED, "read again, generated motion counts as recorded"),
        (generated && (!chosen || further), code::NO_MODES, "generated futures other than the exported one"),
        (agents.iter().any(plain), code::NO_SUBTYPE, "finer kinds but bus and motorcycle"),
        (agents.iter().any(|a| a.role.is_some() && !ego(&a)), code::NO_ROLES, "roles other than the ego's"),
        (renamed, code::IDS_RENUMBERED, "the ego is called AV"),
        (heights, code::NO_Z, "heights"),
        (unseen, code::NO_UNSEEN, "road users without recorded states"),
        (noted || scene.name != *id, code::NO_NOTES, "name, tags, notes and members of other tools"),
    ];
    losses.extend(
        all.into_iter().filter(|(there, ..)| *there).map(|(_, code, detail)| Loss::new(code, detail)),
    );
}
