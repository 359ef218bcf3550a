//! An index of recordings: a table of moving road users, by which queries select scenes.

use crate::case::facts::{self, CaseFacts, RecordedFacts};
use formats::columnar::{self, Column, ColumnValues};
use scene::score::Drivable;
use scene::{STEP_S, Scene};
use std::io;

/// A recorded scene in the index.
pub struct IndexedScene {
    /// Path of its file, as given.
    pub file: String,
    /// Index of the scene in the file, from 0.
    pub index: u64,
    /// Its name in results.
    pub name: String,
    road_users: u64,
    signals: u64,
    duration_s: f64,
    moving: Vec<RecordedFacts>,
}

impl IndexedScene {
    /// The entry of a scene in a file.
    pub fn new(file: String, index: u64, name: String, scene: &Scene) -> Self {
        let moving = facts::recorded(scene, &Drivable::new(&scene.map));
        let duration_s = scene.time.steps.saturating_sub(1) as f64 * STEP_S;
        let (road_users, signals) = (scene.agents.len() as u64, scene.signals.len() as u64);
        Self { file, index, name, road_users, signals, duration_s, moving }
    }

    /// Number of its rows: one per moving road user.
    pub fn rows(&self) -> usize {
        self.moving.len()
    }

    fn columns(self) -> Vec<Column> {
        let rows = self.moving.len();
        let text = |value: &str| ColumnValues::Text(vec![Some(value.to_owned()); rows]);
        let whole = |value: u64| ColumnValues::Whole(vec![i64::try_from(value).ok(); rows]);
        let column = |name, values| Column { name, required: true, values };
        let ids = self.moving.iter().map(|of| Some(of.id.clone())).collect();
        let mut columns = vec![
            column("file", text(&self.file)),
            column("index", whole(self.index)),
            column("name", text(&self.name)),
            column("road_users", whole(self.road_users)),
            column("moving", whole(rows as u64)),
            column("signals", whole(self.signals)),
            column("duration_s", ColumnValues::Number(vec![Some(self.duration_s); rows])),
            column("actor", ColumnValues::Text(ids)),
        ];
        columns.extend(CaseFacts::table(self.moving.iter().map(|of| &of.facts)));
        columns
    }
}

/// The index as Parquet. Equal scenes give equal bytes.
///
/// # Errors
/// None is expected.
pub fn table(scenes: impl IntoIterator<Item = IndexedScene>) -> io::Result<Vec<u8>> {
    columnar::write(scenes.into_iter().map(IndexedScene::columns), Vec::new())
}
