//! Pages of the list, read in order from the end of the last page, never the whole store.

use super::records::{SUMMARY, summary};
use super::{SceneSummary, Store, StoreError};

/// Order of a list; equal keys are ordered by rising id.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sort {
    /// Sort by name instead of the time of the last change.
    pub by_name: bool,
    /// Descending order.
    pub falls: bool,
}

impl Sort {
    /// Sort key.
    pub fn key<'a>(self, name: &'a str, updated_at: &'a str) -> &'a str {
        if self.by_name { name } else { updated_at }
    }
}

/// A requested page.
#[derive(Clone, Debug)]
pub struct PageQuery {
    /// Order.
    pub sort: Sort,
    /// Key and id of the last scene of the previous page.
    pub after: Option<(String, String)>,
    /// Most rows.
    pub most: usize,
}

impl Store {
    /// Scenes of a page that the viewer may see and the query selects, without their bodies.
    pub async fn list(
        &self,
        page: PageQuery,
        wanted: impl Fn(&SceneSummary) -> bool + Send + 'static,
    ) -> Result<Vec<SceneSummary>, StoreError> {
        let viewer = self.viewer.clone();
        self.read(move |connection| {
            let PageQuery { sort, after, most } = page;
            let key = if sort.by_name { "name" } else { "updated_at" };
            let (beyond, falling) = if sort.falls { ("<", "DESC") } else { (">", "ASC") };
            let from = after.is_some();
            let (last_key, last_id) = after.unwrap_or_default();
            let sql = format!(
                "SELECT {SUMMARY} FROM scenes
                 WHERE NOT ?1 OR {key} {beyond} ?2 OR ({key} = ?2 AND id > ?3)
                 ORDER BY {key} {falling}, id"
            );
            let mut query = connection.prepare_cached(&sql)?;
            let rows = query.query_map(rusqlite::params![from, last_key, last_id], summary)?;
            let seen = |row: &SceneSummary| viewer.sees(&row.ownership) && wanted(row);
            let wanted = rows.filter(|row| row.as_ref().map_or(true, seen));
            Ok(wanted.take(most).collect::<Result<_, _>>()?)
        })
        .await
    }
}
