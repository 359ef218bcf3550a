//! Tools that open and close scenes.

use super::describe::{self, Look};
use super::schema::{self, Members, NoRequest};
use super::tools::{ToolAnswer, Toolbox, yes};
use crate::scenes::demos;
use api::import::{Companions, SceneFile};
use api::map::{MapBody, TemplateList};
use api::{Code, Problem};
use base::netconvert::companions;
use experts::Cancel;
use formats::ImportWarning;
use scene::Scene;
use schemars::JsonSchema;
use serde::Deserialize;
use std::path::Path;

/// Number of reader warnings in the answer.
const MOST_WARNINGS: usize = 10;
/// Members that are passed on to a map.
const OF_MAP: [&str; 3] = ["template", "parameters", "name"];

/// Arguments of `list_scenes`.
pub fn list_arguments() -> Members {
    schema::of::<NoRequest, NoRequest>(&[])
}

/// Lists the scenes that can be opened.
pub fn list(tools: &Toolbox, arguments: Members, _: &Cancel) -> Result<ToolAnswer, Problem> {
    schema::read::<NoRequest, NoRequest>(arguments, &[])?;
    let listed = |what: &str, names: Vec<String>| match names.is_empty() {
        true => format!("{what}: none"),
        false => format!("{what}: {}", names.join(", ")),
    };
    let (files, more) = tools.folders.files();
    let title = |item: api::map::TemplateItem| {
        let name = item.layout["template"].as_str().unwrap_or_default();
        format!("{name} ({})", item.title)
    };
    let templates = TemplateList::current().templates.into_iter().map(title).collect();
    let mut text = [
        listed("Open scenes", tools.desk.names()),
        listed("Examples", demos::ids()),
        listed("Files", files),
        listed("Templates of maps", templates),
    ]
    .join("\n");
    if more {
        text.push_str("\nThere are more files.");
    }
    Ok(ToolAnswer::words(text))
}

/// Arguments of `open_scene`.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct OpenCall {
    /// Id of an example; this or `file`.
    #[serde(default)]
    example: Option<String>,
    /// Path of a file in an allowed folder; this or `example`.
    #[serde(default)]
    file: Option<String>,
    /// Format of the file. Default: recognised from the content.
    #[serde(default)]
    format: Option<String>,
    /// Index of the scene in a file of several, from 0.
    #[serde(default)]
    index: u32,
    /// Name for the open scene. Default: that of the example or file.
    #[serde(default)]
    name: Option<String>,
    /// Include a picture in the answer.
    #[serde(default = "yes")]
    picture: bool,
}

/// Arguments of `open_scene`.
pub fn open_arguments() -> Members {
    schema::of::<OpenCall, NoRequest>(&[])
}

/// Opens an example or a file.
pub fn open(tools: &Toolbox, arguments: Members, _: &Cancel) -> Result<ToolAnswer, Problem> {
    let (call, NoRequest {}) = schema::read::<OpenCall, _>(arguments, &[])?;
    let (scene, like, warnings) = match (&call.example, &call.file) {
        (Some(id), None) => {
            let example = demos::file(id).ok_or_else(|| unknown_example(id))?;
            (example.scene?, id.clone(), Vec::new())
        }
        (None, Some(path)) => of_file(tools, path, &call)?,
        _ => {
            let detail = "exactly one of example and file is needed";
            return Err(Problem::field("/example", Code::InvalidField, detail));
        }
    };
    let name = tools.desk.add(call.name.as_deref().unwrap_or(&like), scene)?;
    let more = warnings.len().saturating_sub(MOST_WARNINGS);
    let told =
        warnings.iter().take(MOST_WARNINGS).map(|warning| format!("\n{}: {}", warning.code, warning.detail));
    let mut notes: String = told.collect();
    if more > 0 {
        notes.push_str(&format!("\n{more} more warnings of the reader"));
    }
    opened(tools, &name, &notes, call.picture)
}

fn unknown_example(id: &str) -> Problem {
    let shown: String = id.chars().take(64).collect();
    let detail = format!("no example is named \"{shown}\"; there are {}", demos::ids().join(", "));
    Problem::field("/example", Code::NotFound, detail)
}

fn of_file(
    tools: &Toolbox,
    path: &str,
    call: &OpenCall,
) -> Result<(Scene, String, Vec<ImportWarning>), Problem> {
    let held = tools.folders.read(path)?;
    let name = Path::new(path).file_name().unwrap_or_default().to_string_lossy().into_owned();
    let window = (call.index as usize, 1);
    let beside = Companions { folder: held.folder(&name), ..companions() };
    let file = SceneFile::of(&held.bytes, call.format.as_deref(), &name, &beside, window)?;
    let read = file.read(&held.bytes)?.scenes.into_iter().next();
    let read = read.ok_or_else(|| {
        Problem::field("/index", Code::NotFound, format!("the file has no scene at position {}", call.index))
    })?;
    let stem = name.split('.').next().unwrap_or_default().to_owned();
    Ok((read.scene, stem, read.warnings))
}

/// Describes a scene that was just opened.
fn opened(tools: &Toolbox, name: &str, notes: &str, picture: bool) -> Result<ToolAnswer, Problem> {
    let scene = tools.desk.get(name)?;
    let graph = tools.operations.generator.maps().graph(&scene.map);
    let step = describe::first_step(&scene);
    let words = describe::words(&scene, &graph, Look::brief(step));
    Ok(ToolAnswer::with_picture(format!("Open as \"{name}\".{notes}\n{words}"), &scene, step, picture))
}

/// Arguments of `draw_map` besides those of the request.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct MapCall {
    /// Include a picture in the answer.
    #[serde(default = "yes")]
    picture: bool,
}

/// Arguments of `draw_map`.
pub fn map_arguments() -> Members {
    let mut arguments = schema::of::<MapCall, MapBody>(&OF_MAP);
    arguments.insert("required".into(), vec!["template"].into());
    arguments
}

/// Opens a map that is built from a template.
pub fn draw_map(tools: &Toolbox, arguments: Members, _: &Cancel) -> Result<ToolAnswer, Problem> {
    let (call, body) = schema::read::<MapCall, MapBody>(arguments, &OF_MAP)?;
    let (layout, scene, _) = body.draw()?;
    let name = tools.desk.add(layout.template().name(), scene)?;
    opened(tools, &name, "", call.picture)
}

/// Arguments of `close_scene`.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct CloseCall {
    /// Name of the open scene.
    scene: String,
}

/// Arguments of `close_scene`.
pub fn close_arguments() -> Members {
    schema::of::<CloseCall, NoRequest>(&[])
}

/// Closes a scene.
pub fn close(tools: &Toolbox, arguments: Members, _: &Cancel) -> Result<ToolAnswer, Problem> {
    let (call, NoRequest {}) = schema::read::<CloseCall, _>(arguments, &[])?;
    tools.desk.close(&call.scene)?;
    Ok(ToolAnswer::words(format!("Closed \"{}\".", call.scene)))
}
