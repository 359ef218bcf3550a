//! Tools that describe, draw and write scenes.

use super::describe::{self, Look};
use super::schema::{self, Members, NoRequest};
use super::tools::{ToolAnswer, Toolbox, yes};
use crate::picture::{self as pictures, SceneView};
use api::export::{self, FilePart, MotionChoice};
use api::{Code, Problem};
use experts::Cancel;
use scene::{STEP_S, Scene, Vec2};
use schemars::JsonSchema;
use serde::Deserialize;
use std::fmt::Write as _;

/// Largest file that is returned as text, bytes.
const MOST_TEXT_BYTES: usize = 64 << 10;
/// Largest file that is written, bytes.
const MOST_FILE_BYTES: u64 = 256 << 20;
/// Radius of the described circle around a road user, metres.
const AROUND_M: f64 = 50.0;
/// Side of the square that a picture shows around a place or road user, metres.
const SQUARE_M: f64 = 80.0;

/// A circle of the scene.
#[derive(Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Circle {
    /// Centre, metres.
    x_m: f64,
    /// Centre, metres.
    y_m: f64,
    /// Metres.
    radius_m: f64,
}

/// Arguments of `describe_scene`.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct DescribeCall {
    /// Name of the open scene.
    scene: String,
    /// Scene time, seconds.
    #[serde(default)]
    time_s: f64,
    /// Circle to which the description is limited.
    #[serde(default)]
    near: Option<Circle>,
    /// Limits the description to 50 m around this road user.
    #[serde(default)]
    road_user: Option<String>,
    /// Include lanes, signals and crosswalks.
    #[serde(default = "yes")]
    map: bool,
    /// Maximum number of entries per list.
    #[serde(default = "forty")]
    #[schemars(range(min = 1, max = 400))]
    most: u16,
    /// Include a picture in the answer.
    #[serde(default)]
    picture: bool,
}

fn forty() -> u16 {
    40
}

/// Arguments of `describe_scene`.
pub fn describe_arguments() -> Members {
    schema::of::<DescribeCall, NoRequest>(&[])
}

/// Describes a scene.
pub fn describe(tools: &Toolbox, arguments: Members, _: &Cancel) -> Result<ToolAnswer, Problem> {
    let (call, NoRequest {}) = schema::read::<DescribeCall, _>(arguments, &[])?;
    if !(1..=400).contains(&call.most) {
        return Err(Problem::range("/most", 1.0, 400.0, f64::from(call.most)));
    }
    let scene = tools.desk.get(&call.scene)?;
    let step = step(&scene, call.time_s)?;
    let near = match (&call.near, &call.road_user) {
        (Some(circle), _) => Some((Vec2::new(circle.x_m, circle.y_m), circle.radius_m)),
        (None, Some(id)) => Some((place_of(&scene, id, step)?, AROUND_M)),
        (None, None) => None,
    };
    let look = Look { step, near, most: call.most.into(), with_map: call.map };
    let graph = tools.operations.generator.maps().graph(&scene.map);
    let text = describe::words(&scene, &graph, look);
    Ok(ToolAnswer::with_picture(text, &scene, step, call.picture))
}

/// Arguments of `picture`.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PictureCall {
    /// Name of the open scene.
    scene: String,
    /// Scene time, seconds.
    #[serde(default)]
    time_s: f64,
    /// Centre of the picture, metres; with `y_m` or not at all.
    #[serde(default)]
    x_m: Option<f64>,
    /// Centre of the picture, metres; with `x_m` or not at all.
    #[serde(default)]
    y_m: Option<f64>,
    /// Road user at the centre of the picture.
    #[serde(default)]
    road_user: Option<String>,
    /// Side of the square that is shown, metres: 10 to 2000.
    #[serde(default)]
    width_m: Option<f64>,
}

/// Arguments of `picture`.
pub fn picture_arguments() -> Members {
    schema::of::<PictureCall, NoRequest>(&[])
}

/// Draws a scene.
pub fn picture(tools: &Toolbox, arguments: Members, _: &Cancel) -> Result<ToolAnswer, Problem> {
    let (call, NoRequest {}) = schema::read::<PictureCall, _>(arguments, &[])?;
    let scene = tools.desk.get(&call.scene)?;
    let step = step(&scene, call.time_s)?;
    let centre = match (call.x_m, call.y_m, &call.road_user) {
        (Some(x_m), Some(y_m), _) => Some(Vec2::new(x_m, y_m)),
        (None, None, Some(id)) => Some(place_of(&scene, id, step)?),
        (None, None, None) => None,
        _ => {
            let detail = "x_m and y_m are needed together";
            return Err(Problem::field("/x_m", Code::HalfPosition, detail));
        }
    };
    let whole = SceneView::whole(&scene, step);
    let view = match centre {
        Some(centre) => SceneView::around(centre, call.width_m.unwrap_or(SQUARE_M)),
        None => SceneView::around(whole.centre, call.width_m.unwrap_or(whole.width_m)),
    };
    let png = pictures::png(&scene, view, step).ok_or_else(|| Problem::internal("no picture was made"))?;
    let (time_s, width_m) = (step as f64 * STEP_S, view.width_m);
    let (x_m, y_m) = (view.centre.x, view.centre.y);
    let text = format!(
        "\"{}\" at {time_s:.1} s: {width_m:.0} m by {width_m:.0} m around ({x_m:.1}, {y_m:.1}), north on top. Vehicles are \
         blue, pedestrians purple, cyclists brown; chosen futures red with a dot a second, those of reacting road users \
         orange; goals are green rings.",
        scene.name
    );
    Ok(ToolAnswer { text, picture: Some(png) })
}

/// Step at a time.
fn step(scene: &Scene, time_s: f64) -> Result<usize, Problem> {
    let futures =
        scene.generated.iter().flat_map(|made| &made.samples).flat_map(|sample| sample.agents.values());
    let ends = futures.flat_map(|futures| &futures.modes).map(|mode| mode.first_step + mode.states.len());
    let steps = ends.max().unwrap_or(0).max(scene.time.steps);
    let last_s = (steps - 1) as f64 * STEP_S;
    if !(0.0..=last_s + 1e-6).contains(&time_s) {
        return Err(Problem::range("/time_s", 0.0, last_s, time_s));
    }
    Ok((time_s / STEP_S).round() as usize)
}

/// Position of a road user's shown motion at a step.
fn place_of(scene: &Scene, id: &str, step: usize) -> Result<Vec2, Problem> {
    let agent = scene.agent(id).ok_or_else(|| unknown_road_user(id))?;
    let place = scene.shown(agent).track.at(step).map(scene::State::position);
    place.ok_or_else(|| {
        let time_s = step as f64 * STEP_S;
        Problem::field("/road_user", Code::UnknownAgent, format!("\"{id}\" is not there at {time_s:.1} s"))
    })
}

/// The problem of an id that the scene does not have.
pub fn unknown_road_user(id: &str) -> Problem {
    let shown: String = id.chars().take(64).collect();
    let message = api::english::unknown_agent(&shown);
    Problem::of(Code::UnknownAgent, message).at("/road_user")
}

/// Arguments of `export_scene`.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct ExportCall {
    /// Name of the open scene.
    scene: String,
    /// Id of the format, such as `dragtraffic`, `openscenario`, `csv` or `html`.
    format: String,
    /// Number of the joint scene, from 0. Default: the chosen one.
    #[serde(default)]
    sample: Option<usize>,
    /// `chosen`: chosen futures, and the recording of all other road users; `log`: only the recording.
    #[serde(default)]
    #[schemars(with = "Option<String>")]
    motion: MotionChoice,
    /// Path of the file in an allowed folder; without one, the answer has the file as text, up to 64 KiB.
    #[serde(default)]
    file: Option<String>,
    /// Replace an existing file.
    #[serde(default)]
    overwrite: bool,
}

/// Arguments of `export_scene`.
pub fn export_arguments() -> Members {
    schema::of::<ExportCall, NoRequest>(&[])
}

/// Writes a scene.
pub fn export(tools: &Toolbox, arguments: Members, cancel: &Cancel) -> Result<ToolAnswer, Problem> {
    let (call, NoRequest {}) = schema::read::<ExportCall, _>(arguments, &[])?;
    let scene = tools.desk.get(&call.scene)?;
    let part = FilePart { most_bytes: Some(MOST_FILE_BYTES), cancel: cancel.clone(), ..FilePart::default() };
    let written = export::write(&scene, &call.format, call.sample, call.motion, part)?;
    let bytes = written.bytes.len();
    let mut losses = String::new();
    for loss in &written.losses {
        let _ = write!(losses, "\nlost, {}: {}", loss.code, loss.detail);
    }
    if let Some(path) = &call.file {
        let place = tools.folders.write(path, &written.bytes, call.overwrite)?;
        let text = format!("Wrote {}, {bytes} bytes of {}.{losses}", place.display(), written.media_type);
        return Ok(ToolAnswer::words(text));
    }
    let text = String::from_utf8(written.bytes).ok().filter(|text| text.len() <= MOST_TEXT_BYTES);
    let text = text.ok_or_else(|| {
        let detail = format!("{bytes} bytes of {}: name a file in an allowed folder", written.media_type);
        Problem::field("/file", Code::ReplyTooLarge, detail).limit(MOST_TEXT_BYTES as u64)
    })?;
    Ok(ToolAnswer::words(format!("{bytes} bytes of {}.{losses}\n\n{text}", written.media_type)))
}
