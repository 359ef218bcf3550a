//! Converts a scene to the dictionary of a scenario.

use super::export_map;
use super::import::OWN;
use super::words::{agent_word, signal_word};
use super::writer::PickleWriter;
use crate::format::{EGO, ExportOptions, Exported, ExportedMotion};
use crate::loss::{Loss, code};
use crate::sentences;
use crate::unwritten;
use scene::map::Points;
use scene::{Agent, STEP_S, Scene, Shown, Subtype};
use std::collections::{BTreeSet, HashMap};

/// Version of the scenario's description.
const VERSION: &str = "MetaDrive v0.4.3";
/// Name of the data set.
const DATASET: &str = "dragtraffic";

/// Writes a scene in its own frame; the metadata have the origin of the frame.
pub(super) fn write(scene: &Scene, options: &ExportOptions) -> Exported {
    let mut losses = BTreeSet::new();
    let (shown, steps) = options.motion.all(scene);
    losses.extend(unwritten::length(scene, steps));
    let mut out = PickleWriter::new();
    out.dict(|w| {
        let id = scene.meta.source_id.as_deref().or(scene.id.as_deref()).unwrap_or(&scene.name);
        w.entry("id", |w| w.text(id));
        w.entry("version", |w| w.text(VERSION));
        w.entry("length", |w| w.int(steps));
        w.entry("metadata", |w| metadata(scene, steps, id, w));
        w.entry("tracks", |w| {
            w.dict(|w| {
                for (agent, shown) in scene.agents.iter().zip(&shown) {
                    w.entry(&agent.id, |w| track(agent, shown, steps, w));
                }
            });
        });
        w.entry("dynamic_map_states", |w| signals(scene, steps, w));
        w.entry("map_features", |w| export_map::features(&scene.map, w, &mut losses));
    });
    tell(scene, options.motion, &mut losses);
    Exported { bytes: out.finish(), losses: losses.into_iter().collect() }
}

fn metadata(scene: &Scene, steps: usize, id: &str, w: &mut PickleWriter) {
    let meta = &scene.meta;
    let times = (0..steps).map(|step| {
        let own = meta.timestamps_s.as_deref().and_then(|times| times.get(step)).copied();
        own.unwrap_or(step as f64 * STEP_S)
    });
    let times: Vec<f64> = times.collect();
    w.dict(|w| {
        w.entry("id", |w| w.text(id));
        w.entry("scenario_id", |w| w.text(id));
        w.entry("dataset", |w| w.text(DATASET));
        w.entry("coordinate", |w| w.text(DATASET));
        w.entry("metadrive_processed", |w| w.bool(false));
        w.entry("ts", |w| w.floats(1, &times));
        w.entry("current_time_index", |w| w.int(scene.time.now_step));
        if let Some(ego) = scene.agents.iter().find(|agent| agent.role.as_deref() == Some(EGO)) {
            w.entry("sdc_id", |w| w.text(&ego.id));
        }
        w.entry("objects_of_interest", |w| w.list(&meta.objects_of_interest, |w, id| w.text(id)));
        w.entry("tracks_to_predict", |w| {
            w.dict(|w| {
                for (id, difficulty) in &meta.tracks_to_predict {
                    let agent = scene.agents.iter().enumerate().find(|(_, agent)| agent.id == *id);
                    let Some((index, agent)) = agent else { continue };
                    w.entry(id, |w| {
                        w.dict(|w| {
                            w.entry("track_id", |w| w.text(id));
                            w.entry("track_index", |w| w.int(index));
                            w.entry("difficulty", |w| w.int(*difficulty as usize));
                            w.entry("object_type", |w| w.text(agent_word(agent.agent_type)));
                        });
                    });
                }
            });
        });
        w.entry(OWN, |w| own(scene, w));
    });
}

/// Members that the format lacks and other readers ignore.
fn own(scene: &Scene, w: &mut PickleWriter) {
    let meta = &scene.meta;
    w.dict(|w| {
        w.entry("name", |w| w.text(&scene.name));
        w.entry("source", |w| w.text(&meta.source));
        w.entry("notes", |w| w.text(&meta.notes));
        w.entry("tags", |w| w.list(&meta.tags, |w, tag| w.text(tag)));
        if let Some(licence) = scene.licence() {
            w.entry("licence", |w| w.text(&licence));
        }
        if let Some(crs) = &meta.origin.crs {
            w.entry("origin_crs", |w| w.text(crs));
        }
        w.entry("origin_x_m", |w| w.float(meta.origin.x_m));
        w.entry("origin_y_m", |w| w.float(meta.origin.y_m));
        w.entry("origin_z_m", |w| w.float(meta.origin.z_m));
        w.entry("origin_rotation_rad", |w| w.float(meta.origin.rotation_rad));
    });
}

fn track(agent: &Agent, shown: &Shown<'_>, steps: usize, w: &mut PickleWriter) {
    let word = agent_word(shown.agent_type);
    let state = |step: usize| shown.track.at(step);
    let valid: Vec<bool> = (0..steps).map(|step| state(step).is_some()).collect();
    // Heights are those of the log; a missing one is the last known height.
    let mut height = 0.0;
    let position: Vec<f64> = (0..steps)
        .flat_map(|step| {
            let slot = step.checked_sub(agent.track.first_step).filter(|_| agent.track.at(step).is_some());
            height = agent
                .track
                .z_m
                .as_ref()
                .zip(slot)
                .and_then(|(z, slot)| z.get(slot))
                .copied()
                .unwrap_or(height);
            state(step).map_or([0.0; 3], |s| [s.x_m, s.y_m, height])
        })
        .collect();
    let each = |of: &dyn Fn(&scene::State) -> f64| -> Vec<f64> {
        (0..steps).map(|step| state(step).map_or(0.0, of)).collect()
    };
    let velocity: Vec<f64> =
        (0..steps).flat_map(|step| state(step).map_or([0.0; 2], |s| [s.vx_mps, s.vy_mps])).collect();
    let size = shown.size;
    w.dict(|w| {
        w.entry("type", |w| w.text(word));
        w.entry("state", |w| {
            w.dict(|w| {
                w.entry("position", |w| w.floats(3, &position));
                w.entry("heading", |w| w.floats(1, &each(&|s| s.heading_rad)));
                w.entry("velocity", |w| w.floats(2, &velocity));
                w.entry("length", |w| w.floats(1, &each(&|_| size.length_m)));
                w.entry("width", |w| w.floats(1, &each(&|_| size.width_m)));
                w.entry("height", |w| w.floats(1, &each(&|_| size.height_m.unwrap_or(0.0))));
                w.entry("valid", |w| w.bools(&valid));
            });
        });
        w.entry("metadata", |w| {
            w.dict(|w| {
                w.entry("track_length", |w| w.int(steps));
                w.entry("type", |w| w.text(word));
                w.entry("object_id", |w| w.text(&agent.id));
                w.entry("dataset", |w| w.text(DATASET));
            });
        });
    });
}

fn signals(scene: &Scene, steps: usize, w: &mut PickleWriter) {
    let mut times: HashMap<&str, usize> = HashMap::new();
    w.dict(|w| {
        for signal in &scene.signals {
            let nth = times.entry(&signal.lane).or_default();
            *nth += 1;
            let key = if *nth == 1 { signal.lane.clone() } else { format!("{}.{nth}", signal.lane) };
            w.entry(&key, |w| {
                w.dict(|w| {
                    w.entry("type", |w| w.text("TRAFFIC_LIGHT"));
                    w.entry("lane", |w| w.text(&signal.lane));
                    if let Some(stop) = signal.stop {
                        w.entry("stop_point", |w| {
                            w.floats(1, &[stop.x, stop.y, signal.stop_z_m.unwrap_or(0.0)])
                        });
                    }
                    w.entry("state", |w| {
                        let states = (0..steps).map(|step| signal_word(signal.at(step)));
                        w.dict(|w| w.entry("object_state", |w| w.list(states, PickleWriter::text)));
                    });
                    w.entry("metadata", |w| {
                        w.dict(|w| {
                            w.entry("track_length", |w| w.int(steps));
                            w.entry("type", |w| w.text("TRAFFIC_LIGHT"));
                            w.entry("object_id", |w| w.text(&key));
                            w.entry("dataset", |w| w.text(DATASET));
                        });
                    });
                });
            });
        }
    });
}

fn tell(scene: &Scene, motion: ExportedMotion, losses: &mut BTreeSet<Loss>) {
    let (map, agents) = (&scene.map, &scene.agents);
    let flat = |points: &Points| points.z_m.is_none();
    let unknown = map.lanes.iter().any(|lane| flat(&lane.points))
        || agents.iter().any(|agent| agent.track.z_m.is_none() || agent.size.height_m.is_none());
    let roles = agents.iter().filter(|a| a.role.as_deref() == Some(EGO)).count() > 1
        || agents.iter().any(|a| a.role.as_deref().is_some_and(|role| role != EGO));
    let noted = scene.meta.parent_id.is_some() || !scene.extra.is_empty();
    let largest =
        agents.iter().flat_map(|a| a.track.states.iter().flatten()).map(|s| s.x_m.abs().max(s.y_m.abs()));
    let lines = map.lanes.iter().flat_map(|lane| &lane.points.xy).map(|p| p.amax());
    // Half the spacing of single-precision numbers, which have a significand of 24 bits.
    let off_m = largest.chain(lines).fold(1.0, f64::max) / f64::from(1 << 24);
    let all = [
        (unknown, code::NO_Z, "unknown heights become zero"),
        (agents.iter().any(|a| a.subtype != Subtype::Unknown), code::NO_SUBTYPE, "finer kinds such as truck"),
        (roles, code::NO_ROLES, "roles other than the ego's"),
        (!map.drivable.is_empty(), code::NO_DRIVABLE, "drivable areas"),
        (noted, code::NO_NOTES, "the scene it was made of, members of other tools"),
    ];
    losses.insert(Loss::counted(code::GEOMETRY_APPROXIMATED, sentences::loss_single_precision(1e6 * off_m)));
    losses.extend(
        all.into_iter().filter(|(there, ..)| *there).map(|(_, code, detail)| Loss::new(code, detail)),
    );
    losses.extend(unwritten::conditions(scene, motion));
    losses.extend(unwritten::futures(scene, motion));
}
