//! The list of scenes, page by page.

use crate::http::extract::QueryParams;
use crate::routes::own::OwnCatalog;
use crate::scenes::store::{PageQuery, SceneSummary, Sort};
use crate::scenes::{SceneItem, tags_of};
use api::{Code, Problem};
use base::id;
use base::problem::Refusal;
use serde::{Deserialize, Serialize};

/// Query of the list.
#[derive(Debug, Deserialize, utoipa::IntoParams)]
#[serde(deny_unknown_fields, default)]
#[into_params(parameter_in = Query)]
pub struct ListParams {
    /// Maximum number of scenes per page, 1 to 200.
    #[param(default = 50, minimum = 1, maximum = 200)]
    limit: usize,
    /// `next` of the previous page.
    after: Option<String>,
    /// Text in the name, case ignored.
    q: Option<String>,
    /// One tag.
    tag: Option<String>,
    /// Scene that the listed ones are variants of.
    parent: Option<String>,
    /// `updated` or `name`, with `-` before it for descending order.
    #[param(default = "-updated", pattern = "^-?(updated|name)$")]
    sort: String,
}

impl Default for ListParams {
    fn default() -> Self {
        Self { limit: 50, after: None, q: None, tag: None, parent: None, sort: "-updated".into() }
    }
}

/// A page of scenes.
#[derive(Debug, Serialize, schemars::JsonSchema)]
pub struct SceneList {
    scenes: Vec<SceneItem>,
    /// Send as `after` for the next page; null on the last.
    next: Option<String>,
}

refusals!(Unlisted: QUERY STORE);

/// Lists scenes without their content: saved ones, demos, and those of the data folder.
#[utoipa::path(get, path = "/v1/scenes", operation_id = "listScenes", tag = "scenes", params(ListParams),
    responses((status = 200, description = "a page", body = ref("#/components/schemas/SceneList")), Unlisted))]
pub async fn list(
    OwnCatalog(catalog): OwnCatalog,
    QueryParams(params): QueryParams<ListParams>,
) -> Result<axum::Json<SceneList>, Refusal> {
    if !(1..=200).contains(&params.limit) {
        return Err(Problem::range("/query/limit", 1.0, 200.0, params.limit as f64).into());
    }
    let sort = sort(&params.sort)?;
    let after = params.after.as_deref().map(place).transpose()?;
    let text = params.q.map(|q| q.to_lowercase());
    let wanted = move |name: &str, tags: &[String], parent_id: Option<&String>| {
        text.as_ref().is_none_or(|q| name.to_lowercase().contains(q))
            && params.tag.as_ref().is_none_or(|tag| tags.contains(tag))
            && params.parent.as_ref().is_none_or(|parent| parent_id == Some(parent))
    };
    // One row more than shown tells whether there is another page.
    let most = params.limit + 1;
    let order = |a: &(String, String), b: &(String, String)| {
        let keys = if sort.falls { b.0.cmp(&a.0) } else { a.0.cmp(&b.0) };
        keys.then_with(|| a.1.cmp(&b.1))
    };
    let place_of = |item: &SceneItem| (sort.key(&item.name, &item.updated_at).to_owned(), item.id.clone());
    let mut items = catalog.library.items();
    items.retain(|item| {
        wanted(&item.name, &item.tags, item.parent_id.as_ref())
            && after.as_ref().is_none_or(|after| order(after, &place_of(item)).is_lt())
    });
    let saved = move |row: &SceneSummary| wanted(&row.name, &tags_of(row), row.parent_id.as_ref());
    let rows = catalog.store.list(PageQuery { sort, after, most }, saved).await?;
    items.extend(rows.into_iter().map(SceneItem::from));
    items.sort_by(|a, b| order(&place_of(a), &place_of(b)));
    let more = items.len() > params.limit;
    items.truncate(params.limit);
    let next = items.last().filter(|_| more).map(|item| {
        let (key, id) = place_of(item);
        let hex: String = key.bytes().map(|byte| format!("{byte:02x}")).collect();
        format!("{hex}~{id}")
    });
    Ok(axum::Json(SceneList { scenes: items, next }))
}

/// Sort key (its bytes in hexadecimal, which need no escaping in a query) and id of the last scene of a page,
/// as in `next`.
fn place(cursor: &str) -> Result<(String, String), Problem> {
    let wrong = || Problem::field("/query/after", Code::InvalidField, "`next` of the page before expected");
    let (hex, id) =
        cursor.rsplit_once('~').filter(|(hex, id)| hex.is_ascii() && id::is_id(id)).ok_or_else(wrong)?;
    let byte = |at: usize| u8::from_str_radix(hex.get(at..at + 2)?, 16).ok();
    let bytes: Option<Vec<u8>> = (0..hex.len()).step_by(2).map(byte).collect();
    let key = bytes.and_then(|bytes| String::from_utf8(bytes).ok()).ok_or_else(wrong)?;
    Ok((key, id.to_owned()))
}

fn sort(word: &str) -> Result<Sort, Problem> {
    let (falls, key) = word.strip_prefix('-').map_or((false, word), |key| (true, key));
    match key {
        "updated" => Ok(Sort { by_name: false, falls }),
        "name" => Ok(Sort { by_name: true, falls }),
        _ => Err(Problem::field(
            "/query/sort",
            Code::InvalidField,
            "updated, -updated, name or -name expected",
        )),
    }
}
