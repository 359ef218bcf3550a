//! Example scenes inside the program.

use crate::base::id;
use api::Problem;
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

/// A scene by its id, and the bytes of its file; `None` where there is none.
pub fn file(id: &str) -> Option<(Result<Scene, Problem>, Cow<'static, [u8]>)> {
    let file = DemoScenes::get(&format!("{id}.json"))?;
    Some((native::read(&file.data).map_err(Problem::from), file.data))
}
