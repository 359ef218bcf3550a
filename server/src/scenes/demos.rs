//! Example scenes embedded in the program.

use api::Problem;
use base::id;
use formats::native;
use rust_embed::RustEmbed;
use scene::Scene;
use std::borrow::Cow;

/// Files in native JSON.
#[derive(RustEmbed)]
#[folder = "../assets/scenes"]
#[allow_missing = true]
struct DemoScenes;

/// Their ids, sorted.
pub fn ids() -> Vec<String> {
    let id =
        |name: Cow<'static, str>| name.strip_suffix(".json").filter(|id| id::is_id(id)).map(str::to_owned);
    let mut ids: Vec<String> = DemoScenes::iter().filter_map(id).collect();
    ids.sort();
    ids
}

/// An example.
pub struct DemoFile {
    /// The parsed scene.
    pub scene: Result<Scene, Problem>,
    /// The file.
    pub bytes: Cow<'static, [u8]>,
}

/// An example by its id; `None` if it does not exist.
pub fn file(id: &str) -> Option<DemoFile> {
    let file = DemoScenes::get(&format!("{id}.json"))?;
    Some(DemoFile { scene: native::read(&file.data).map_err(Problem::from), bytes: file.data })
}
