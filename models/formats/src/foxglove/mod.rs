//! MCAP with Foxglove's schemas, for robotics viewers: map, signals and road users as `foxglove.SceneUpdate`,
//! and the scene's position in its source as `foxglove.FrameTransform`. Messages are JSON.

mod mcap;
mod scene_update;

use crate::format::{
    ExportOptions, Exported, ExportedMotion, Format, ImportOptions, Info, Scenes, one_scene, written_only,
};
use crate::loss::{Loss, code};
use crate::source::Source;
use mcap::McapWriter;
use scene::{Agent, Conditions, STEP_S, Scene, Shown};
use serde::Serialize;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::io;

/// A scene as a log of messages, ten per second.
pub struct Mcap;

const SCENE_UPDATE: &str = include_str!("scene_update.schema.json");
const FRAME_TRANSFORM: &str = include_str!("frame_transform.schema.json");

impl Format for Mcap {
    fn info(&self) -> Info {
        Info {
            id: "mcap",
            name: "MCAP (Foxglove schemas)",
            media_type: "application/octet-stream",
            extensions: &["mcap"],
            import: false,
            export: true,
            many: false,
            takes_net: false,
            notes: "`foxglove.SceneUpdate` ten times a second and `foxglove.FrameTransform`, as JSON.",
            loses: &[
                code::NO_CONDITIONS,
                code::NO_MODES,
                code::NO_NOTES,
                code::NO_JUDGEMENTS,
                code::NO_LANE_GRAPH,
            ],
        }
    }

    fn scenes<'a>(&'a self, _: &'a dyn Source, _: &'a ImportOptions) -> Scenes<'a> {
        written_only(&self.info())
    }

    fn export(&self, scenes: &[&Scene], options: &ExportOptions) -> io::Result<Exported> {
        let scene = one_scene(scenes)?;
        Ok(Exported { bytes: log(scene, options)?, losses: lost(scene, options.motion) })
    }
}

const STEP_NS: u64 = 100_000_000;

/// A time in the form of messages.
fn time(step: usize) -> Value {
    let ns = step as u64 * STEP_NS;
    json!({"sec": ns / 1_000_000_000, "nsec": ns % 1_000_000_000})
}

fn log(scene: &Scene, options: &ExportOptions) -> io::Result<Vec<u8>> {
    let mut file = McapWriter::new(concat!("dragtraffic ", env!("CARGO_PKG_VERSION")));
    let update = file.schema("foxglove.SceneUpdate", SCENE_UPDATE);
    let transform = file.schema("foxglove.FrameTransform", FRAME_TRANSFORM);
    let frames = file.channel("/tf", transform);
    let map = file.channel("/map", update);
    let signals = file.channel("/signals", update);
    let users = file.channel("/road_users", update);
    fn put(file: &mut McapWriter, channel: u16, step: usize, message: &impl Serialize) -> io::Result<()> {
        file.message(channel, step as u64 * STEP_NS, &serde_json::to_vec(message)?)
    }
    put(&mut file, frames, 0, &scene_update::transform(scene))?;
    put(&mut file, map, 0, &scene_update::map(&scene.map))?;
    let bounds = options.bounds();
    let (shown, steps) = options.motion.all(scene);
    let tracks: Vec<(&Agent, Shown<'_>)> = scene.agents.iter().zip(shown).collect();
    for step in 0..steps {
        let changes = scene.signals.iter().any(|signal| signal.runs.iter().any(|(first, _)| *first == step));
        if changes || (step == 0 && !scene.signals.is_empty()) {
            put(&mut file, signals, step, &scene_update::signals(scene, step))?;
        }
        put(&mut file, users, step, &scene_update::users(&tracks, step))?;
        bounds.check(file.size())?;
    }
    file.metadata("dragtraffic", &about(scene));
    file.finish()
}

fn about(scene: &Scene) -> BTreeMap<String, String> {
    let origin = &scene.meta.origin;
    let mut about = BTreeMap::from([
        ("name".to_owned(), scene.name.clone()),
        ("source".to_owned(), scene.meta.source.clone()),
        ("units".to_owned(), "metres, seconds, radians".to_owned()),
        (
            "frame".to_owned(),
            "scene: x east, y north (or the source's axes), z up; source: scene turned and moved by /tf"
                .to_owned(),
        ),
        ("step_s".to_owned(), STEP_S.to_string()),
        ("now_step".to_owned(), scene.time.now_step.to_string()),
    ]);
    about.extend(origin.crs.clone().map(|crs| ("crs".to_owned(), crs)));
    about.extend(scene.licence().map(|licence| ("licence".to_owned(), licence)));
    about
}

fn lost(scene: &Scene, motion: ExportedMotion) -> Vec<Loss> {
    let generated = scene.generated.is_some();
    let samples = || scene.generated.iter().flat_map(|generated| &generated.samples);
    let further =
        samples().count() > 1 || samples().flat_map(|s| s.agents.values()).any(|f| f.modes.len() > 1);
    let fixed = scene.agents.iter().any(|agent| agent.conditions != Conditions::default());
    let meta = &scene.meta;
    let noted = !meta.tags.is_empty() || !meta.notes.is_empty() || !scene.extra.is_empty();
    let all = [
        (fixed, code::NO_CONDITIONS, "starts, goals, sizes and types that the user fixed"),
        (
            !scene.map.lanes.is_empty(),
            code::NO_LANE_GRAPH,
            "which lanes follow each other: the map is a picture",
        ),
        (
            generated && (motion == ExportedMotion::Log || further),
            code::NO_MODES,
            "generated futures other than the exported one",
        ),
        (generated, code::NO_JUDGEMENTS, "probabilities, faults, relations and reactions"),
        (noted, code::NO_NOTES, "tags, notes and members of other tools"),
    ];
    all.into_iter().filter(|(there, ..)| *there).map(|(_, code, detail)| Loss::new(code, detail)).collect()
}
