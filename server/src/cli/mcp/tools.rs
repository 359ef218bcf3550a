//! The tools by name: purpose, arguments and function of each.

use super::desk::SceneDesk;
use super::folders::AllowedFolders;
use super::schema::Members;
use super::{ask, give, judge, open, search};
use crate::picture::{self, SceneView};
use api::{Operations, Problem};
use experts::Cancel;
use rmcp::model::{Tool, ToolAnnotations};
use scene::Scene;
use std::sync::Arc;
use std::time::Duration;

/// What the tools use.
pub struct Toolbox {
    /// The operations, as for all transports.
    pub operations: Operations,
    /// Open scenes.
    pub desk: SceneDesk,
    /// Accessible files.
    pub folders: AllowedFolders,
    /// Time limit of a call.
    pub patience: Duration,
}

/// The answer of a call.
pub struct ToolAnswer {
    /// Text.
    pub text: String,
    /// Picture as PNG.
    pub picture: Option<Vec<u8>>,
}

impl ToolAnswer {
    /// An answer with text only.
    pub fn words(text: impl Into<String>) -> Self {
        Self { text: text.into(), picture: None }
    }

    /// An answer with text and, if wanted, a picture of the whole scene at a step.
    pub fn with_picture(text: String, scene: &Scene, step: usize, wanted: bool) -> Self {
        let drawn = || picture::png(scene, SceneView::whole(scene, step), step);
        Self { text, picture: wanted.then(drawn).flatten() }
    }
}

/// Default for whether an answer has a picture.
pub fn yes() -> bool {
    true
}

/// One tool.
pub struct SceneTool {
    name: &'static str,
    title: &'static str,
    about: &'static str,
    /// Whether it changes neither scenes nor files.
    only_reads: bool,
    arguments: fn() -> Members,
    /// Its function.
    pub run: fn(&Toolbox, Members, &Cancel) -> Result<ToolAnswer, Problem>,
}

/// All tools.
pub const TOOLS: &[SceneTool] = &[
    SceneTool {
        name: "list_scenes",
        title: "List scenes",
        about: "Names of the open scenes, ids of the examples, files of the allowed folders, and templates of maps.",
        only_reads: true,
        arguments: open::list_arguments,
        run: open::list,
    },
    SceneTool {
        name: "open_scene",
        title: "Open a scene",
        about: "Opens an example by its id, or a scene file of an allowed folder in any format that is read. Gives the name by which the other tools call it, a description and a picture.",
        only_reads: false,
        arguments: open::open_arguments,
        run: open::open,
    },
    SceneTool {
        name: "draw_map",
        title: "Draw a map",
        about: "Opens a new scene without road users on a map that is drawn from a template (list_scenes names the templates). place_road_users fills it.",
        only_reads: false,
        arguments: open::map_arguments,
        run: open::draw_map,
    },
    SceneTool {
        name: "close_scene",
        title: "Close a scene",
        about: "Forgets an open scene; what was not exported is lost.",
        only_reads: false,
        arguments: open::close_arguments,
        run: open::close,
    },
    SceneTool {
        name: "describe_scene",
        title: "Describe a scene",
        about: "A scene at a time in words and numbers: road users with place, heading, speed, lane, goal and future; lanes with ends, lengths, limits and links; lights and crosswalks. `near` keeps to a circle, `road_user` to the circle around one.",
        only_reads: true,
        arguments: give::describe_arguments,
        run: give::describe,
    },
    SceneTool {
        name: "picture",
        title: "Picture of a scene",
        about: "A scene at a time as PNG, seen from above with north on top: all of it, or a square around a place or a road user.",
        only_reads: true,
        arguments: give::picture_arguments,
        run: give::picture,
    },
    SceneTool {
        name: "place_road_users",
        title: "Place road users",
        about: "Puts new road users on the map of a scene, so many in all or per kilometre of lane, in the whole map or a region, by type, with arrivals by arm and parked cars. Futures that the scene keeps are dropped.",
        only_reads: false,
        arguments: ask::place_arguments,
        run: ask::place,
    },
    SceneTool {
        name: "set_conditions",
        title: "Set goals and other conditions",
        about: "Replaces the conditions of road users, whole: start, goal (a place, or with frame agent an offset ahead_m and left_m from the start, or a relation to another road user), via points, size, type. {} frees a road user. It can add and remove road users too.",
        only_reads: false,
        arguments: ask::condition_arguments,
        run: ask::set_conditions,
    },
    SceneTool {
        name: "generate_futures",
        title: "Ask for futures",
        about: "Motions of road users for the next seconds: freely, or towards the goals of their conditions; others may react. Says what each does, whether goals are met, who reacts to whom, and what is wrong. The scene keeps the futures.",
        only_reads: false,
        arguments: ask::generate_arguments,
        run: ask::generate,
    },
    SceneTool {
        name: "score_scene",
        title: "Score a scene",
        about: "Collisions, near misses, time to collision, driving off the road, red lights, kinematics and goals of the shown motion: chosen futures, and the recording of all others. `road_user` adds the figures of one.",
        only_reads: true,
        arguments: judge::score_arguments,
        run: judge::score,
    },
    SceneTool {
        name: "search_futures",
        title: "Search for a situation",
        about: "Generates with one seed after the other, until the results hold a condition on the figures of the score, such as `actor.min_ttc_s < 1.5 && collisions == 0`; a template (brake, cut-in, late) casts an actor and its goal anew for each seed. The scene keeps the best result.",
        only_reads: false,
        arguments: search::arguments,
        run: search::search,
    },
    SceneTool {
        name: "export_scene",
        title: "Export a scene",
        about: "A scene as a file of any format that is written (dragtraffic, openscenario, sumo-fcd, csv, html and others; an unknown word lists them): into an allowed folder, or as text where it is short. Says what the format cannot hold.",
        only_reads: false,
        arguments: give::export_arguments,
        run: give::export,
    },
];

/// The tool of this name.
pub fn named(name: &str) -> Option<&'static SceneTool> {
    TOOLS.iter().find(|tool| tool.name == name)
}

impl SceneTool {
    /// The tool in the form of the protocol's list.
    pub fn listed(&self) -> Tool {
        let hints = ToolAnnotations::new().read_only(self.only_reads).destructive(false).open_world(false);
        Tool::new(self.name, self.about, Arc::new((self.arguments)()))
            .with_title(self.title)
            .with_annotations(hints)
    }
}

#[cfg(test)]
mod tests {
    use super::TOOLS;
    use serde_json::Value;

    /// Size limit of a tool's schema, bytes: a model reads it before anything else.
    const MOST_BYTES: usize = 15_000;

    #[test]
    fn tools_have_short_schemas_whose_references_resolve() {
        for tool in TOOLS {
            let schema = Value::Object((tool.arguments)());
            let text = schema.to_string();
            assert!(text.len() < MOST_BYTES, "{}: {} bytes", tool.name, text.len());
            assert_eq!(schema["type"], "object", "{}", tool.name);
            for part in text.split("\"#/$defs/").skip(1) {
                let name = part.split('"').next().unwrap();
                assert!(schema["$defs"][name].is_object(), "{}: {name}", tool.name);
            }
            described(&schema, tool.name);
        }
    }

    /// Asserts that each member has a description.
    fn described(schema: &Value, tool: &str) {
        for (name, member) in schema["properties"].as_object().unwrap() {
            assert!(member["description"].is_string() || member["$ref"].is_string(), "{tool}: {name}");
        }
    }
}
