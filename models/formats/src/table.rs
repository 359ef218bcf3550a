//! Motion as one long table: a line for each road user, future and step, as notebooks and spreadsheets take it.
//! Written, never read.

use crate::format::{ExportOptions, Exported, ExportedMotion, Format, ImportOptions, Info, Scenes, one};
use crate::loss::{Loss, code};
use crate::problem::{FieldProblem, code as problem};
use crate::source::Source;
use flate2::Compression;
use flate2::write::GzEncoder;
use scene::{Agent, AgentType, Conditions, STEP_S, Scene, State, Subtype};
use std::collections::BTreeSet;
use std::io::{self, Write};

/// What a line says. `sample` is empty and `mode` is `log` where the motion was recorded; `chosen` is 1 where it is
/// what is shown.
const COLUMNS: [&str; 11] =
    ["scene", "sample", "agent", "type", "mode", "chosen", "t_s", "x_m", "y_m", "heading_rad", "v_mps"];
/// Mode of recorded motion.
const LOG: &str = "log";

/// Motion as comma-separated values.
pub struct Table;

impl Format for Table {
    fn info(&self) -> Info {
        Info {
            id: "csv",
            name: "Table of motion (CSV)",
            media_type: "text/csv",
            extensions: &["csv", "csv.gz"],
            import: false,
            export: true,
            many: true,
            takes_net: false,
        }
    }

    fn sniff(&self, _: &[u8], _: &str) -> u8 {
        0
    }

    fn scenes<'a>(&'a self, _: &'a dyn Source, _: &'a ImportOptions) -> Scenes<'a> {
        let detail = "csv is written, never read: it has neither map nor boxes";
        one(Err(FieldProblem::new("", problem::FORMAT_UNKNOWN, detail).into()))
    }

    fn export(&self, scenes: &[&Scene], options: &ExportOptions) -> io::Result<Exported> {
        let mut losses = BTreeSet::new();
        let mut bytes = Vec::new();
        if options.gzip {
            let mut encoder = GzEncoder::new(&mut bytes, Compression::default());
            write(scenes, options, &mut encoder)?;
            encoder.finish()?;
        } else {
            write(scenes, options, &mut bytes)?;
        }
        scenes.iter().for_each(|scene| losses.extend(lost(scene, options.motion)));
        Ok(Exported { bytes, losses: losses.into_iter().collect() })
    }
}

fn write(scenes: &[&Scene], options: &ExportOptions, out: impl Write) -> io::Result<()> {
    let mut rows = Rows { csv: csv::Writer::from_writer(out) };
    if !options.continued {
        rows.csv.write_record(COLUMNS).map_err(io::Error::other)?;
    }
    for scene in scenes {
        let name = options.label.as_deref().unwrap_or(&scene.name);
        for agent in &scene.agents {
            rows.log(name, scene, agent, options.motion)?;
        }
        let samples = scene.generated.iter().flat_map(|generated| &generated.samples).enumerate();
        let wanted =
            |k: usize| options.motion == ExportedMotion::Chosen && options.sample.is_none_or(|s| s == k);
        for (k, sample) in samples.filter(|(k, _)| wanted(*k)) {
            for (id, futures) in &sample.agents {
                let Some(agent) = scene.agent(id) else { continue };
                for (mode, future) in futures.modes.iter().enumerate() {
                    let about = [&k.to_string(), id, word(agent.kind()), &mode.to_string()];
                    let chosen = mode == futures.chosen;
                    for (i, state) in future.states.iter().enumerate() {
                        rows.add(name, about, chosen, future.first_step + i, state)?;
                    }
                }
            }
        }
    }
    rows.csv.flush()
}

struct Rows<W: Write> {
    csv: csv::Writer<W>,
}

impl<W: Write> Rows<W> {
    /// What was recorded; it is shown where no future has taken its place.
    fn log(&mut self, name: &str, scene: &Scene, agent: &Agent, motion: ExportedMotion) -> io::Result<()> {
        let shown = scene.shown(agent);
        let agent_type = match motion {
            ExportedMotion::Chosen => shown.agent_type,
            ExportedMotion::Log => agent.agent_type,
        };
        for (i, state) in agent.track.states.iter().enumerate() {
            let Some(state) = state else { continue };
            let step = agent.track.first_step + i;
            let chosen = motion == ExportedMotion::Log || shown.track.at(step) == Some(state);
            self.add(name, ["", &agent.id, word(agent_type), LOG], chosen, step, state)?;
        }
        Ok(())
    }

    fn add(
        &mut self,
        name: &str,
        [sample, agent, agent_type, mode]: [&str; 4],
        chosen: bool,
        step: usize,
        state: &State,
    ) -> io::Result<()> {
        let number = |value: f64, digits: usize| format!("{:.digits$}", value + 0.0);
        let numbers = [
            number(step as f64 * STEP_S, 1),
            number(state.x_m, 3),
            number(state.y_m, 3),
            number(scene::wrap_angle(state.heading_rad), 4),
            number(state.speed_mps(), 3),
        ];
        let words = [name, sample, agent, agent_type, mode, if chosen { "1" } else { "0" }];
        let record = words.into_iter().chain(numbers.iter().map(String::as_str));
        self.csv.write_record(record).map_err(io::Error::other)
    }
}

fn word(agent_type: AgentType) -> &'static str {
    match agent_type {
        AgentType::Vehicle => "vehicle",
        AgentType::Pedestrian => "pedestrian",
        AgentType::Cyclist => "cyclist",
        AgentType::Other => "other",
    }
}

/// What of this scene a table has no place for.
fn lost(scene: &Scene, motion: ExportedMotion) -> Vec<Loss> {
    let agents = &scene.agents;
    let fixed = agents.iter().any(|agent| agent.conditions != Conditions::default());
    let generated = scene.generated.is_some();
    let meta = &scene.meta;
    let noted = !meta.tags.is_empty() || !meta.notes.is_empty() || !scene.extra.is_empty();
    let all = [
        (!scene.map.lanes.is_empty(), code::NO_MAP, "the map"),
        (!scene.signals.is_empty(), code::NO_SIGNALS, "traffic signals"),
        (!agents.is_empty(), code::NO_SIZES, "boxes of road users"),
        (fixed, code::NO_CONDITIONS, "starts, goals, sizes and types that the user fixed"),
        (generated && motion == ExportedMotion::Log, code::NO_MODES, "generated futures"),
        (generated, code::NO_JUDGEMENTS, "probabilities, faults, relations and reactions"),
        (agents.iter().any(|a| a.subtype != Subtype::Unknown), code::NO_SUBTYPE, "finer kinds such as truck"),
        (agents.iter().any(|a| a.role.is_some()), code::NO_ROLES, "roles such as the ego's"),
        (scene.licence().is_some(), code::NO_LICENCE, "the licence"),
        (noted, code::NO_NOTES, "tags, notes and members of other tools"),
    ];
    all.into_iter().filter(|(there, ..)| *there).map(|(_, code, detail)| Loss::new(code, detail)).collect()
}
