//! The events of many scenes, as a table.

use super::{MinedEvent, mine};
use crate::case::facts::type_word;
use formats::columnar::{self, Column, ColumnValues};
use scene::routes::LaneGraph;
use scene::{AgentType, Scene};
use serde::Serialize;
use std::io;

/// A scene with its events.
pub struct MinedScene {
    /// Path of its file, as given.
    pub file: String,
    /// Index of the scene in the file, from 0.
    pub index: u64,
    /// Its name in results.
    pub name: String,
    /// Events by time, each with the types of the actor and of the other.
    events: Vec<(MinedEvent, [Option<AgentType>; 2])>,
}

/// An event as JSON.
#[derive(Serialize)]
pub struct MinedLine<'a> {
    file: &'a str,
    index: u64,
    name: &'a str,
    tag: &'static str,
    time_s: f64,
    actor: &'a str,
    actor_type: Option<&'static str>,
    other: Option<&'a str>,
    other_type: Option<&'static str>,
    x_m: f64,
    y_m: f64,
    figure: &'static str,
    value: Option<f64>,
}

impl MinedScene {
    /// The events of a scene in a file.
    pub fn new(file: String, index: u64, name: String, scene: &Scene) -> Self {
        let graph = LaneGraph::new(&scene.map);
        let kind = |id: &str| scene.agent(id).map(scene::Agent::kind);
        let typed = |event: MinedEvent| {
            let types = [kind(&event.actor), event.other.as_deref().and_then(kind)];
            (event, types)
        };
        let events = mine(scene, &graph, graph.ground()).into_iter().map(typed).collect();
        Self { file, index, name, events }
    }

    /// Its events.
    pub fn events(&self) -> impl Iterator<Item = &MinedEvent> {
        self.events.iter().map(|(event, _)| event)
    }

    /// Its events as JSON.
    pub fn lines(&self) -> impl Iterator<Item = MinedLine<'_>> {
        self.events.iter().map(|(event, [actor_type, other_type])| MinedLine {
            file: &self.file,
            index: self.index,
            name: &self.name,
            tag: event.tag.name(),
            time_s: event.time_s,
            actor: &event.actor,
            actor_type: actor_type.map(type_word),
            other: event.other.as_deref(),
            other_type: other_type.map(type_word),
            x_m: event.x_m,
            y_m: event.y_m,
            figure: event.tag.figure(),
            value: event.value,
        })
    }

    fn columns(self) -> Vec<Column> {
        let lines: Vec<MinedLine<'_>> = self.lines().collect();
        let text = |name, of: fn(&MinedLine<'_>) -> Option<String>| Column {
            name,
            required: false,
            values: ColumnValues::Text(lines.iter().map(of).collect()),
        };
        let number = |name, of: fn(&MinedLine<'_>) -> Option<f64>| Column {
            name,
            required: false,
            values: ColumnValues::Number(lines.iter().map(of).collect()),
        };
        let index = lines.iter().map(|line| i64::try_from(line.index).ok()).collect();
        vec![
            text("file", |line| Some(line.file.to_owned())),
            Column { name: "index", required: false, values: ColumnValues::Whole(index) },
            text("name", |line| Some(line.name.to_owned())),
            text("tag", |line| Some(line.tag.to_owned())),
            number("time_s", |line| Some(line.time_s)),
            text("actor", |line| Some(line.actor.to_owned())),
            text("actor_type", |line| line.actor_type.map(str::to_owned)),
            text("other", |line| line.other.map(str::to_owned)),
            text("other_type", |line| line.other_type.map(str::to_owned)),
            number("x_m", |line| Some(line.x_m)),
            number("y_m", |line| Some(line.y_m)),
            text("figure", |line| Some(line.figure.to_owned())),
            number("value", |line| line.value),
        ]
    }
}

/// The events as Parquet. Equal scenes give equal bytes.
///
/// # Errors
/// None is expected.
pub fn table(scenes: impl IntoIterator<Item = MinedScene>) -> io::Result<Vec<u8>> {
    columnar::write(scenes.into_iter().map(MinedScene::columns), Vec::new())
}
