//! Rows of scenes, as CSV and as columns.

use super::{COLUMNS, GENERATED, LOG};
use crate::columnar::{Column, ColumnValues};
use crate::format::{ExportOptions, ExportedMotion};
use crate::frame::Frame;
use crate::loss::{Loss, code};
use scene::{Agent, AgentType, Conditions, LaneMap, STEP_S, Scene, Size, State, Subtype};
use std::borrow::Cow;
use std::io::{self, Write};

/// A row; values that a future or an unseen road user lacks are `None`.
pub(super) struct TableRow<'a> {
    pub scenario: &'a str,
    pub agent: &'a str,
    pub agent_type: &'static str,
    pub subtype: &'static str,
    /// Sample, mode and probability of a future.
    pub future: Option<(usize, usize, f64)>,
    pub step: usize,
    /// State in the frame of the source.
    pub state: Option<State>,
    pub z_m: Option<f64>,
    pub size: Size,
    pub chosen: bool,
}

/// Scenes with unique names.
pub(super) fn named<'a>(scenes: &[&'a Scene], options: &ExportOptions) -> Vec<(&'a Scene, String)> {
    let mut taken = std::collections::BTreeSet::new();
    let name = |scene: &&'a Scene| {
        let own = options.label.clone().unwrap_or_else(|| scene.name.clone());
        let numbered = (2..).map(|k| format!("{own} ({k})"));
        let name = std::iter::once(own.clone()).chain(numbered).find(|name| !taken.contains(name));
        let name = name.unwrap_or(own);
        taken.insert(name.clone());
        (*scene, name)
    };
    scenes.iter().map(name).collect()
}

/// Calls `take` for each row of a scene: first recorded states, then futures, in the order of sample, road
/// user, mode and step.
pub(super) fn each(
    (scene, name): &(&Scene, String),
    options: &ExportOptions,
    take: &mut dyn FnMut(&TableRow<'_>) -> io::Result<()>,
) -> io::Result<()> {
    let frame = Frame::of(&scene.meta.origin);
    for agent in &scene.agents {
        logged(scene, name, agent, options.motion, frame, take)?;
    }
    let samples = scene.generated.iter().flat_map(|generated| &generated.samples).enumerate();
    let wanted = |k: usize| options.motion == ExportedMotion::Chosen && options.sample.is_none_or(|s| s == k);
    for (k, sample) in samples.filter(|(k, _)| wanted(*k)) {
        for (id, futures) in &sample.agents {
            let Some(agent) = scene.agent(id) else { continue };
            for (mode, future) in futures.modes.iter().enumerate() {
                for (i, state) in future.states.iter().enumerate() {
                    take(&TableRow {
                        scenario: name,
                        agent: id,
                        agent_type: word(agent.kind()),
                        subtype: subtype_word(agent.subtype),
                        future: Some((k, mode, future.probability)),
                        step: future.first_step + i,
                        state: Some(frame.state(state)),
                        z_m: None,
                        size: agent.shown_size(),
                        chosen: mode == futures.chosen,
                    })?;
                }
            }
        }
    }
    Ok(())
}

/// States that differ by less than this are the same, metres and m/s: for a placed road user, one state is the
/// other one, rounded.
const SAME: f64 = 5e-3;

fn is_same(a: Option<&State>, b: Option<&State>) -> bool {
    let near = |a: &State, b: &State| {
        (a.position() - b.position()).norm() < SAME && (a.velocity() - b.velocity()).norm() < SAME
    };
    a.zip(b).is_some_and(|(a, b)| near(a, b))
}

/// Rows of a recorded track; a row is chosen if the shown motion has the same state.
fn logged(
    scene: &Scene,
    name: &str,
    agent: &Agent,
    motion: ExportedMotion,
    frame: Frame,
    take: &mut dyn FnMut(&TableRow<'_>) -> io::Result<()>,
) -> io::Result<()> {
    let shown = scene.shown(agent);
    let (agent_type, size) = match motion {
        ExportedMotion::Chosen => (shown.agent_type, shown.size),
        ExportedMotion::Log => (agent.agent_type, agent.size),
    };
    let track = &agent.track;
    // A road user without any state still has one row.
    for i in 0..track.states.len().max(1) {
        let step = track.first_step + i;
        let state = track.at(step);
        let chosen =
            state.is_some() && (motion == ExportedMotion::Log || is_same(shown.track.at(step), state));
        take(&TableRow {
            scenario: name,
            agent: &agent.id,
            agent_type: word(agent_type),
            subtype: subtype_word(agent.subtype),
            future: None,
            step,
            state: state.map(|state| frame.state(state)),
            z_m: track.z_m.as_ref().and_then(|z| z.get(i)).map(|z| frame.height(*z)),
            size,
            chosen,
        })?;
    }
    Ok(())
}

/// Writes rows as CSV.
///
/// # Errors
/// Those of the writer.
pub(super) fn csv(scenes: &[(&Scene, String)], options: &ExportOptions, out: impl Write) -> io::Result<()> {
    let mut csv = csv::Writer::from_writer(out);
    if !options.continued {
        csv.write_record(COLUMNS).map_err(io::Error::other)?;
    }
    let number = |value: Option<f64>| value.map_or_else(String::new, decimal);
    let flag = |flag: bool| if flag { "1" } else { "0" };
    for scene in scenes {
        each(scene, options, &mut |row| {
            let state = |part: fn(&State) -> f64| number(row.state.as_ref().map(part));
            let (sample, mode, probability) = match row.future {
                None => Default::default(),
                Some((sample, mode, p)) => (sample.to_string(), mode.to_string(), decimal(p)),
            };
            let record = [
                &*cell(row.scenario),
                &*cell(row.agent),
                row.agent_type,
                row.subtype,
                &sample,
                &mode,
                &probability,
                &row.step.to_string(),
                &format!("{:.1}", row.step as f64 * STEP_S),
                &state(|s| s.x_m),
                &state(|s| s.y_m),
                &number(row.z_m),
                &state(|s| s.heading_rad),
                &state(|s| s.vx_mps),
                &state(|s| s.vy_mps),
                &decimal(row.size.length_m),
                &decimal(row.size.width_m),
                flag(row.state.is_some()),
                if row.future.is_some() { GENERATED } else { LOG },
                &number(row.size.height_m),
                flag(row.chosen),
            ];
            csv.write_record(record).map_err(io::Error::other)
        })?;
    }
    csv.flush()
}

/// A text that no spreadsheet runs as a formula: one that begins like a formula gets a quote as prefix.
pub fn cell(text: &str) -> Cow<'_, str> {
    if is_formula(text) { Cow::Owned(format!("{QUOTE}{text}")) } else { Cow::Borrowed(text) }
}

/// The text of a cell that [`cell`] made.
pub(super) fn plain(cell: &str) -> &str {
    cell.strip_prefix(QUOTE).filter(|text| is_formula(text)).unwrap_or(cell)
}

/// Prefix of texts that spreadsheets would run, and of texts that begin with this character.
const QUOTE: char = '\'';

/// Spreadsheets of East Asian languages take the wide forms of the signs too, and some skip blanks before a sign.
fn is_formula(text: &str) -> bool {
    const SIGNS: [char; 11] =
        ['=', '+', '-', '@', '\t', '\r', '\n', '\u{ff1d}', '\u{ff0b}', '\u{ff0d}', '\u{ff20}'];
    text.starts_with(QUOTE) || text.trim_start_matches([' ', '\u{a0}', '\u{feff}']).starts_with(SIGNS)
}

/// Formats a number with six decimals, without trailing zeros.
fn decimal(value: f64) -> String {
    let text = format!("{:.6}", value + 0.0);
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}

/// The rows of a scene as columns.
pub(super) fn columns(scene: &(&Scene, String), options: &ExportOptions) -> Vec<Column> {
    let column = |(i, name): (usize, &'static str)| {
        let required =
            !matches!(name, "sample" | "mode" | "probability" | "x_m" | "y_m" | "z_m" | "heading_rad")
                && !matches!(name, "vx_mps" | "vy_mps" | "height_m");
        Column { name, required, values: values(scene, options, i) }
    };
    COLUMNS.into_iter().enumerate().map(column).collect()
}

/// One column. It iterates over the rows separately, so that memory holds only one column besides the file.
fn values(scene: &(&Scene, String), options: &ExportOptions, column: usize) -> ColumnValues {
    match column {
        0 => text(scene, options, |row| row.scenario.to_owned()),
        1 => text(scene, options, |row| row.agent.to_owned()),
        2 => text(scene, options, |row| row.agent_type.to_owned()),
        3 => text(scene, options, |row| row.subtype.to_owned()),
        4 => whole(scene, options, |row| row.future.map(|(sample, ..)| sample)),
        5 => whole(scene, options, |row| row.future.map(|(_, mode, _)| mode)),
        6 => numbers(scene, options, |row| row.future.map(|(.., probability)| probability)),
        7 => whole(scene, options, |row| Some(row.step)),
        // The quotient is the number that prints as a multiple of 0.1, such as 0.3.
        8 => numbers(scene, options, |row| Some(row.step as f64 / 10.0)),
        9 => numbers(scene, options, |row| row.state.map(|s| s.x_m)),
        10 => numbers(scene, options, |row| row.state.map(|s| s.y_m)),
        11 => numbers(scene, options, |row| row.z_m),
        12 => numbers(scene, options, |row| row.state.map(|s| s.heading_rad)),
        13 => numbers(scene, options, |row| row.state.map(|s| s.vx_mps)),
        14 => numbers(scene, options, |row| row.state.map(|s| s.vy_mps)),
        15 => numbers(scene, options, |row| Some(row.size.length_m)),
        16 => numbers(scene, options, |row| Some(row.size.width_m)),
        17 => flags(scene, options, |row| row.state.is_some()),
        18 => text(scene, options, |row| if row.future.is_some() { GENERATED } else { LOG }.to_owned()),
        19 => numbers(scene, options, |row| row.size.height_m),
        _ => flags(scene, options, |row| row.chosen),
    }
}

type Named<'a> = (&'a Scene, String);

fn all<T>(scene: &Named<'_>, options: &ExportOptions, of: impl Fn(&TableRow<'_>) -> T) -> Vec<T> {
    let mut list = Vec::new();
    // The closure never fails, so neither does the call.
    let _ = each(scene, options, &mut |row| {
        list.push(of(row));
        Ok(())
    });
    list
}

fn text(scene: &Named<'_>, options: &ExportOptions, of: impl Fn(&TableRow<'_>) -> String) -> ColumnValues {
    ColumnValues::Text(all(scene, options, |row| Some(of(row))))
}

fn whole(
    scene: &Named<'_>,
    options: &ExportOptions,
    of: impl Fn(&TableRow<'_>) -> Option<usize>,
) -> ColumnValues {
    ColumnValues::Whole(all(scene, options, |row| of(row).map(|value| value as i64)))
}

fn numbers(
    scene: &Named<'_>,
    options: &ExportOptions,
    of: impl Fn(&TableRow<'_>) -> Option<f64>,
) -> ColumnValues {
    ColumnValues::Number(all(scene, options, of))
}

fn flags(scene: &Named<'_>, options: &ExportOptions, of: impl Fn(&TableRow<'_>) -> bool) -> ColumnValues {
    ColumnValues::Flag(all(scene, options, |row| Some(of(row))))
}

fn word(agent_type: AgentType) -> &'static str {
    match agent_type {
        AgentType::Vehicle => "vehicle",
        AgentType::Pedestrian => "pedestrian",
        AgentType::Cyclist => "cyclist",
        AgentType::Other => "other",
    }
}

fn subtype_word(subtype: Subtype) -> &'static str {
    match subtype {
        Subtype::Car => "car",
        Subtype::Truck => "truck",
        Subtype::Bus => "bus",
        Subtype::Van => "van",
        Subtype::Motorcycle => "motorcycle",
        Subtype::Trailer => "trailer",
        Subtype::Emergency => "emergency",
        Subtype::Adult => "adult",
        Subtype::Child => "child",
        Subtype::Wheelchair => "wheelchair",
        Subtype::Scooter => "scooter",
        Subtype::Bicycle => "bicycle",
        Subtype::Unknown => "unknown",
    }
}

/// Codes of the losses that a table may have.
pub(super) const LOSES: &[&str] = &[
    code::NO_CONDITIONS,
    code::NO_MODES,
    code::NO_ROLES,
    code::NO_LICENCE,
    code::NO_NOTES,
    code::NO_MAP,
    code::NO_SIGNALS,
    code::NO_JUDGEMENTS,
    code::NO_TIMING,
];

/// Losses of this scene; with `noted`, frame, licence and time are kept in the metadata.
pub(super) fn lost(scene: &Scene, motion: ExportedMotion, noted: bool) -> Vec<Loss> {
    let agents = &scene.agents;
    let fixed = agents.iter().any(|agent| agent.conditions != Conditions::default());
    let generated = scene.generated.is_some();
    let meta = &scene.meta;
    let said = !meta.tags.is_empty() || !meta.notes.is_empty() || !scene.extra.is_empty();
    let linked = meta.parent_id.is_some() || meta.created_with.is_some();
    let picked = !meta.objects_of_interest.is_empty() || !meta.tracks_to_predict.is_empty();
    let all = [
        (*scene.map != LaneMap::default(), code::NO_MAP, "the map"),
        (!scene.signals.is_empty(), code::NO_SIGNALS, "traffic signals"),
        (fixed, code::NO_CONDITIONS, "starts, goals, sizes and types that the user fixed"),
        (generated && motion == ExportedMotion::Log, code::NO_MODES, "generated futures"),
        (
            generated && motion == ExportedMotion::Chosen,
            code::NO_JUDGEMENTS,
            "what futures answer, their anchors, faults, relations and reactions, and which sample is shown",
        ),
        (!noted && agents.iter().any(|a| a.role.is_some()), code::NO_ROLES, "roles such as the ego's"),
        (!noted && scene.licence().is_some(), code::NO_LICENCE, "the licence"),
        (!noted, code::NO_TIMING, "the present, how long the scene is, the source's times, and its frame"),
        (
            said || linked || picked,
            code::NO_NOTES,
            "tags, notes, road users of interest, members of other tools",
        ),
    ];
    all.into_iter().filter(|(there, ..)| *there).map(|(_, code, detail)| Loss::new(code, detail)).collect()
}
