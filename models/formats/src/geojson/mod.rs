//! GeoJSON (RFC 7946) for maps and notebooks: map, road users and their futures as features.
//!
//! Positions are metres of the scene's source, because most sources have no geographic position: `frame`
//! states this. If the source names its coordinate reference system, `frame` has that name.

use crate::format::{
    ExportOptions, Exported, ExportedMotion, Format, ImportOptions, Info, Scenes, one_scene, written_only,
};
use crate::frame::Frame;
use crate::loss::{Loss, code};
use crate::source::Source;
use crate::written::BoundedFile;
use flate2::Compression;
use flate2::write::GzEncoder;
use scene::geometry::cross;
use scene::map::{Area, Lane, Points, TypedLine};
use scene::{Agent, STEP_S, Scene, Signal, State, Vec2};
use serde_json::{Map, Value, json};
use std::collections::BTreeSet;
use std::io::{self, Write};

/// A scene as a collection of features.
pub struct GeoJson;

impl Format for GeoJson {
    fn info(&self) -> Info {
        Info {
            id: "geojson",
            name: "GeoJSON",
            media_type: "application/geo+json",
            extensions: &["geojson"],
            import: false,
            export: true,
            many: false,
            takes_net: false,
            notes: "Lanes, paint, edges, areas, tracks, futures and goals, in metres of the source's frame, \
                 which `frame` names.",
            loses: &[
                code::NO_CONDITIONS,
                code::NO_MODES,
                code::NO_NOTES,
                code::NO_JUDGEMENTS,
                code::NO_LANE_GRAPH,
                code::NO_Z,
            ],
        }
    }

    fn scenes<'a>(&'a self, _: &'a dyn Source, _: &'a ImportOptions) -> Scenes<'a> {
        written_only(&self.info())
    }

    fn export(&self, scenes: &[&Scene], options: &ExportOptions) -> io::Result<Exported> {
        let scene = one_scene(scenes)?;
        let mut file = BoundedFile::new(options.bounds());
        if options.gzip {
            let mut encoder = GzEncoder::new(&mut file, Compression::default());
            write(scene, options, &mut encoder)?;
            encoder.finish()?;
        } else {
            write(scene, options, &mut file)?;
        }
        Ok(Exported { bytes: file.whole()?, losses: lost(scene, options.motion) })
    }
}

/// Description of a collection.
fn about(scene: &Scene) -> Map<String, Value> {
    let origin = &scene.meta.origin;
    let frame = json!({
        "kind": if origin.crs.is_some() { "projected" } else { "local" },
        "crs": origin.crs,
        "units": "metres, seconds, radians",
        "axes": "x east, y north (or the source's own), headings counter-clockwise from +x",
        "note": "not longitude and latitude: positions are metres in the frame of the scene's source",
        "origin_m": [origin.x_m, origin.y_m],
        "rotation_rad": origin.rotation_rad,
    });
    let mut about = Map::new();
    about.insert("name".into(), json!(scene.name));
    about.insert("frame".into(), frame);
    about.insert("source".into(), json!(scene.meta.source));
    about.insert("licence".into(), json!(scene.licence()));
    let time = json!({"step_s": STEP_S, "steps": scene.time.steps, "now_step": scene.time.now_step});
    about.insert("time".into(), time);
    about
}

/// Writes feature after feature, so that the whole collection is never in memory.
fn write(scene: &Scene, options: &ExportOptions, out: &mut dyn Write) -> io::Result<()> {
    write!(out, "{{\"type\":\"FeatureCollection\",")?;
    for (key, value) in about(scene) {
        write!(out, "{}:{value},", Value::String(key))?;
    }
    write!(out, "\"features\":[")?;
    let mut first = true;
    let features = Features { frame: Frame::of(&scene.meta.origin), scene };
    features.each(options, &mut |feature| {
        out.write_all(if first { b"\n" } else { b",\n" })?;
        first = false;
        write!(out, "{feature}")
    })?;
    writeln!(out, "\n]}}")
}

struct Features<'a> {
    frame: Frame,
    scene: &'a Scene,
}

/// Rounds to a millimetre.
fn short(value: f64) -> f64 {
    (value * 1e3).round() / 1e3 + 0.0
}

fn feature(id: String, geometry: Value, properties: Value) -> Value {
    json!({"type": "Feature", "id": id, "geometry": geometry, "properties": properties})
}

impl Features<'_> {
    fn position(&self, p: Vec2) -> Value {
        let p = self.frame.place(p);
        json!([short(p.x), short(p.y)])
    }

    /// A line of at least two positions, otherwise a point: RFC 7946 has no shorter lines.
    fn line(&self, points: &[Vec2]) -> Value {
        match points {
            [p] => json!({"type": "Point", "coordinates": self.position(*p)}),
            _ => {
                let positions: Vec<Value> = points.iter().map(|p| self.position(*p)).collect();
                json!({"type": "LineString", "coordinates": positions})
            }
        }
    }

    /// A closed ring, counter-clockwise outside and clockwise in holes.
    fn ring(&self, points: &[Vec2], hole: bool) -> Option<Value> {
        if points.len() < 3 {
            return None;
        }
        let twice_m2: f64 = (0..points.len()).map(|i| cross(points[i], points[(i + 1) % points.len()])).sum();
        let mut ring: Vec<Value> = points.iter().map(|p| self.position(*p)).collect();
        if (twice_m2 < 0.0) != hole {
            ring.reverse();
        }
        ring.extend(ring.first().cloned());
        Some(json!(ring))
    }

    fn polygon(&self, area: &Area) -> Option<Value> {
        let outer = self.ring(&area.polygon.xy, false)?;
        let holes = area.holes.iter().filter_map(|hole: &Points| self.ring(&hole.xy, true));
        let rings: Vec<Value> = std::iter::once(outer).chain(holes).collect();
        Some(json!({"type": "Polygon", "coordinates": rings}))
    }

    fn each(&self, options: &ExportOptions, take: &mut dyn FnMut(Value) -> io::Result<()>) -> io::Result<()> {
        let map = &self.scene.map;
        let areas = [
            ("drivable_area", &map.drivable),
            ("crosswalk", &map.crosswalks),
            ("speed_bump", &map.speed_bumps),
            ("driveway", &map.driveways),
        ];
        for (kind, area) in
            areas.into_iter().flat_map(|(kind, list)| list.iter().map(move |area| (kind, area)))
        {
            let Some(polygon) = self.polygon(area) else { continue };
            take(feature(format!("{kind}/{}", area.id), polygon, json!({"kind": kind, "id": area.id})))?;
        }
        for (kind, list) in [("road_edge", &map.road_edges), ("road_line", &map.road_lines)] {
            for line in list {
                take(self.typed_line(kind, line))?;
            }
        }
        map.lanes.iter().try_for_each(|lane| take(self.lane(lane)))?;
        for sign in &map.stop_signs {
            let point = json!({"type": "Point", "coordinates": self.position(sign.position)});
            let about = json!({"kind": "stop_sign", "id": sign.id, "lanes": sign.lanes});
            take(feature(format!("stop_sign/{}", sign.id), point, about))?;
        }
        for (i, signal) in self.scene.signals.iter().enumerate() {
            take(self.signal(i, signal))?;
        }
        self.scene.agents.iter().try_for_each(|agent| self.agent(agent, options.motion, take))?;
        if options.motion == ExportedMotion::Chosen { self.futures(options, take) } else { Ok(()) }
    }

    fn typed_line(&self, kind: &str, line: &TypedLine) -> Value {
        let about = json!({"kind": kind, "id": line.id, "type": line.line_type});
        feature(format!("{kind}/{}", line.id), self.line(&line.points.xy), about)
    }

    fn lane(&self, lane: &Lane) -> Value {
        let about = json!({
            "kind": "lane",
            "id": lane.id,
            "type": lane.lane_type,
            "width_m": lane.width_m,
            "speed_limit_mps": lane.speed_limit_mps,
            "in_junction": lane.interpolating,
            "predecessors": lane.predecessors,
            "successors": lane.successors,
        });
        feature(format!("lane/{}", lane.id), self.line(&lane.points.xy), about)
    }

    fn signal(&self, index: usize, signal: &Signal) -> Value {
        let at = signal.stop.or_else(|| {
            let lane = self.scene.map.lane_index(&signal.lane)?;
            self.scene.map.lanes[lane].points.xy.last().copied()
        });
        let geometry = at.map(|p| json!({"type": "Point", "coordinates": self.position(p)}));
        let runs: Vec<Value> = signal.runs.iter().map(|(step, state)| json!([step, state])).collect();
        let about = json!({"kind": "signal", "lane": signal.lane, "runs": runs});
        feature(format!("signal/{index}"), geometry.unwrap_or(Value::Null), about)
    }

    /// Steps and states as a line, with the properties of each vertex.
    fn motion(&self, states: &[(usize, State)]) -> (Value, Value) {
        let points: Vec<Vec2> = states.iter().map(|(_, state)| state.position()).collect();
        let list = |of: &dyn Fn(&State) -> f64| -> Vec<f64> {
            states.iter().map(|(_, state)| short(of(&self.frame.state(state)))).collect()
        };
        let about = json!({
            "steps": states.iter().map(|(step, _)| step).collect::<Vec<_>>(),
            "headings_rad": list(&|s| s.heading_rad),
            "vx_mps": list(&|s| s.vx_mps),
            "vy_mps": list(&|s| s.vy_mps),
        });
        (if points.is_empty() { Value::Null } else { self.line(&points) }, about)
    }

    fn agent(
        &self,
        agent: &Agent,
        motion: ExportedMotion,
        take: &mut dyn FnMut(Value) -> io::Result<()>,
    ) -> io::Result<()> {
        let shown = self.scene.shown(agent);
        let (agent_type, size) = match motion {
            ExportedMotion::Chosen => (shown.agent_type, shown.size),
            ExportedMotion::Log => (agent.agent_type, agent.size),
        };
        let states: Vec<(usize, State)> =
            agent.track.valid_steps().filter_map(|step| Some((step, *agent.track.at(step)?))).collect();
        let (geometry, vertices) = self.motion(&states);
        let about = json!({
            "kind": "track",
            "agent": agent.id,
            "type": agent_type,
            "subtype": agent.subtype,
            "role": agent.role,
            "length_m": size.length_m,
            "width_m": size.width_m,
            "height_m": size.height_m,
            "vertices": vertices,
        });
        take(feature(format!("track/{}", agent.id), geometry, about))?;
        let conditions = &agent.conditions;
        let Some(goal) = conditions.goal.position else { return Ok(()) };
        let about = json!({
            "kind": "goal",
            "agent": agent.id,
            "heading_rad": conditions.goal.heading_rad.map(|h| crate::frame::wrapped(self.frame.heading(h))),
            "speed_mps": conditions.goal.speed_mps,
            "time_s": conditions.goal.time_s,
        });
        let point = json!({"type": "Point", "coordinates": self.position(goal)});
        take(feature(format!("goal/{}", agent.id), point, about))
    }

    fn futures(
        &self,
        options: &ExportOptions,
        take: &mut dyn FnMut(Value) -> io::Result<()>,
    ) -> io::Result<()> {
        let samples = self.scene.generated.iter().flat_map(|generated| &generated.samples).enumerate();
        for (k, sample) in samples.filter(|(k, _)| options.sample.is_none_or(|s| s == *k)) {
            for (id, futures) in &sample.agents {
                for (mode, future) in futures.modes.iter().enumerate() {
                    let states: Vec<(usize, State)> =
                        (future.first_step..).zip(future.states.iter().copied()).collect();
                    let (geometry, vertices) = self.motion(&states);
                    let about = json!({
                        "kind": "future",
                        "agent": id,
                        "sample": k,
                        "mode": mode,
                        "probability": future.probability,
                        "chosen": mode == futures.chosen,
                        "vertices": vertices,
                    });
                    take(feature(format!("future/{id}/{k}/{mode}"), geometry, about))?;
                }
            }
        }
        Ok(())
    }
}

fn lost(scene: &Scene, motion: ExportedMotion) -> Vec<Loss> {
    let agents = &scene.agents;
    let generated = scene.generated.is_some();
    let rest = |agent: &Agent| {
        let mut rest = agent.conditions.clone();
        rest.goal = scene::Goal::default();
        !rest.is_empty()
    };
    let neighbours = |lane: &Lane| {
        let beside = lane.left_neighbors.iter().chain(&lane.right_neighbors);
        beside.count() + lane.left_boundary.len() + lane.right_boundary.len() > 0
    };
    let heights = agents.iter().any(|agent| agent.track.z_m.is_some())
        || scene.map.lanes.iter().any(|lane| lane.points.z_m.is_some());
    let meta = &scene.meta;
    let noted = !meta.tags.is_empty()
        || !meta.notes.is_empty()
        || meta.parent_id.is_some()
        || !scene.extra.is_empty();
    let all = [
        (agents.iter().any(rest), code::NO_CONDITIONS, "starts, sizes and types that the user fixed"),
        (generated && motion == ExportedMotion::Log, code::NO_MODES, "generated futures"),
        (generated, code::NO_JUDGEMENTS, "anchors, faults, relations and reactions"),
        (
            scene.map.lanes.iter().any(neighbours),
            code::NO_LANE_GRAPH,
            "lanes beside each other, and their sides",
        ),
        (heights, code::NO_Z, "heights"),
        (noted, code::NO_NOTES, "tags, notes and members of other tools"),
    ];
    let there: BTreeSet<Loss> = all
        .into_iter()
        .filter(|(there, ..)| *there)
        .map(|(_, code, detail)| Loss::new(code, detail))
        .collect();
    there.into_iter().collect()
}
