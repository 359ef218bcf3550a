//! `/v1/scenes`: list, read, create, replace, rename, delete, duplicate.

use crate::app::App;
use crate::base::id;
use crate::base::problem::{Code, Problem};
use crate::http::body::{self, Json, Reading};
use crate::http::coding;
use crate::http::extract::{Id, Params, if_match, if_none_match};
use crate::scenes::store::{Expect, Page, SceneSummary, Sort};
use crate::scenes::{Item, bytes_of, not_found, preview, record, tags_of};
use axum::extract::{FromRef, FromRequest, Request, State};
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use formats::native::{self, MapForm, SceneDoc};
use scene::MAX_NAME_CHARS;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Query of the list.
#[derive(Debug, Deserialize, utoipa::IntoParams)]
#[serde(deny_unknown_fields, default)]
#[into_params(parameter_in = Query)]
pub struct ListParams {
    /// Most scenes of a page, 1 to 200.
    #[param(default = 50, minimum = 1, maximum = 200)]
    limit: usize,
    /// `next` of the page before.
    after: Option<String>,
    /// Text in the name, case ignored.
    q: Option<String>,
    /// One tag.
    tag: Option<String>,
    /// Scene that the listed ones are variants of.
    parent: Option<String>,
    /// `updated` or `name`, with `-` before it for falling order.
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
    scenes: Vec<Item>,
    /// Send as `after` for the next page; null on the last.
    next: Option<String>,
}

refusals!(Unlisted: QUERY STORE);

/// Lists scenes without their content: saved ones, demos, and those of the data folder.
#[utoipa::path(get, path = "/v1/scenes", operation_id = "listScenes", tag = "scenes", params(ListParams),
    responses((status = 200, description = "a page", body = ref("#/components/schemas/SceneList")), Unlisted))]
pub async fn list(
    State(app): State<App>,
    Params(params): Params<ListParams>,
) -> Result<axum::Json<SceneList>, Problem> {
    if !(1..=200).contains(&params.limit) {
        return Err(Problem::range("/query/limit", 1.0, 200.0, params.limit as f64));
    }
    let sort = sort(&params.sort)?;
    let after = params.after.as_deref().map(place).transpose()?;
    let text = params.q.map(|q| q.to_lowercase());
    let wanted = move |name: &str, tags: &[String], parent_id: Option<&String>| {
        text.as_ref().is_none_or(|q| name.to_lowercase().contains(q))
            && params.tag.as_ref().is_none_or(|tag| tags.contains(tag))
            && params.parent.as_ref().is_none_or(|parent| parent_id == Some(parent))
    };
    // One more than is shown tells whether there is another page.
    let most = params.limit + 1;
    let order = |a: &(String, String), b: &(String, String)| {
        let keys = if sort.falls { b.0.cmp(&a.0) } else { a.0.cmp(&b.0) };
        keys.then_with(|| a.1.cmp(&b.1))
    };
    let place_of = |item: &Item| (sort.key(&item.name, &item.updated_at).to_owned(), item.id.clone());
    let mut items = app.catalog.library.items();
    items.retain(|item| {
        wanted(&item.name, &item.tags, item.parent_id.as_ref())
            && after.as_ref().is_none_or(|after| order(after, &place_of(item)).is_lt())
    });
    let saved = move |row: &SceneSummary| wanted(&row.name, &tags_of(row), row.parent_id.as_ref());
    let rows = app.catalog.store.list(Page { sort, after, most }, saved).await?;
    items.extend(rows.into_iter().map(Item::from));
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

/// Key (its bytes in hexadecimal, which need no escaping in a query) and id of the last scene of a page, as
/// `next` has them.
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

/// Query of a read.
#[derive(Debug, Default, Deserialize, utoipa::IntoParams)]
#[serde(deny_unknown_fields, default)]
#[into_params(parameter_in = Query)]
pub struct ReadParams {
    /// The map itself or its hash alone: `inline` or `ref`.
    #[param(default = "inline", inline)]
    map: MapParam,
}

/// How the map is given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "lowercase")]
pub enum MapParam {
    /// Whole.
    #[default]
    Inline,
    /// `{"ref":"sha256:HEX"}`.
    Ref,
}

refusals!(Unread: QUERY STORE WORK, NotFound);

/// Reads a scene.
#[utoipa::path(get, path = "/v1/scenes/{id}", operation_id = "readScene", tag = "scenes",
    params(("id" = String, Path), ReadParams),
    responses((status = 200, description = "the scene", body = ref("#/components/schemas/Scene"),
            content_type = "application/vnd.dragtraffic.scene+json"),
        (status = 304, description = "not changed"), Unread))]
pub async fn read(
    State(app): State<App>,
    Id(id): Id,
    Params(params): Params<ReadParams>,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    if let Some(opened) = app.catalog.library.open(&id).await? {
        if !fresh(&headers, &opened.etag) {
            return Ok(not_modified(&opened.etag));
        }
        let form = if params.map == MapParam::Ref { MapForm::Ref } else { MapForm::Inline };
        let json = app.catalog.written(opened.scene, form).await?;
        return scene_reply(&app, headers, &opened.etag, json).await;
    }
    let (summary, json) = app.catalog.store.get(&id).await?.ok_or_else(not_found)?;
    if !fresh(&headers, &summary.etag) {
        return Ok(not_modified(&summary.etag));
    }
    let json = match params.map {
        MapParam::Ref => json,
        MapParam::Inline => app.catalog.with_map(json, &summary.map_sha).await?,
    };
    scene_reply(&app, headers, &summary.etag, json).await
}

/// Does the one who asks not have this version?
fn fresh(headers: &HeaderMap, etag: &str) -> bool {
    let known = if_none_match(headers).unwrap_or_default();
    !known.iter().any(|tag| tag == "*" || tag.trim_start_matches("W/") == etag)
}

async fn scene_reply(app: &App, headers: HeaderMap, etag: &str, json: Vec<u8>) -> Result<Response, Problem> {
    let head = [
        (header::CONTENT_TYPE, native::MEDIA_TYPE.to_owned()),
        (header::VARY, header::ACCEPT_ENCODING.as_str().to_owned()),
    ];
    let bytes = json.len();
    let pack = move || Ok(coding::gzip(&headers, &json).ok_or(json));
    Ok(match app.pool.document(bytes, pack).await? {
        Ok(packed) => {
            let coded = [(header::ETAG, coding::marked(etag)), (header::CONTENT_ENCODING, "gzip".to_owned())];
            (head, coded, packed).into_response()
        }
        Err(json) => (head, [(header::ETAG, etag.to_owned())], json).into_response(),
    })
}

refusals!(Unpreviewed: WORK, NotFound);

/// Reads what a small picture of a scene shows: a scene with its lines in few points, and of each road user who
/// is there at first the first and the last state.
#[utoipa::path(get, path = "/v1/scenes/{id}/preview", operation_id = "previewScene", tag = "scenes",
    params(("id" = String, Path)),
    responses((status = 200, description = "the scene, reduced", body = ref("#/components/schemas/Scene"),
            content_type = "application/vnd.dragtraffic.scene+json"),
        (status = 304, description = "not changed"), Unpreviewed))]
pub async fn preview_of(State(app): State<App>, Id(id): Id, headers: HeaderMap) -> Result<Response, Problem> {
    let opened = app.catalog.open(&id).await?;
    let kept = [(header::CACHE_CONTROL, "private, no-cache")];
    if !fresh(&headers, &opened.etag) {
        return Ok((kept, not_modified(&opened.etag)).into_response());
    }
    let (scene, bytes) = (Arc::clone(&opened.scene), bytes_of(&opened.scene));
    let write = move || Ok(native::write_doc(&preview(&scene)));
    let json = app.pool.document(bytes, write).await?;
    Ok((kept, scene_reply(&app, headers, &opened.etag, json).await?).into_response())
}

fn not_modified(etag: &str) -> Response {
    (StatusCode::NOT_MODIFIED, [(header::ETAG, etag.to_owned())]).into_response()
}

/// What a change gave.
#[derive(Debug, Serialize, schemars::JsonSchema)]
pub struct Saved {
    /// Of the scene.
    id: String,
    /// As in the ETag header.
    etag: String,
}

fn saved(status: StatusCode, id: String, etag: String) -> Response {
    let head = [(header::ETAG, etag.clone()), (header::LOCATION, format!("/v1/scenes/{id}"))];
    (status, head, axum::Json(Saved { id, etag })).into_response()
}

refusals!(Uncreated: CHANGES BODY SCENE STORE WORK, Exists, StoreFull);

/// Saves a new scene; the id of the document is ignored.
#[utoipa::path(post, path = "/v1/scenes", operation_id = "createScene", tag = "scenes",
    request_body(content = ref("#/components/schemas/Scene"), content_type = "application/json"),
    responses((status = 201, description = "stored", body = ref("#/components/schemas/Saved")), Uncreated))]
pub async fn create(State(app): State<App>, Json(doc): Json<SceneDoc>) -> Result<Response, Problem> {
    let id = id::fresh();
    let scene = app.catalog.scene_of(doc).await?;
    let written = app.catalog.save(&id, Expect::Absent, scene).await?;
    Ok(saved(StatusCode::CREATED, id, written.etag))
}

refusals!(Unreplaced: CHANGES BODY SCENE STORE WORK,
    NotFound, StaleEtag, PreconditionRequired, ReadOnly, StoreFull);

/// Replaces a scene (If-Match) or makes one under the client's own id (If-None-Match: *).
#[utoipa::path(put, path = "/v1/scenes/{id}", operation_id = "replaceScene", tag = "scenes",
    params(("id" = String, Path), ("If-Match" = Option<String>, Header), ("If-None-Match" = Option<String>, Header)),
    request_body(content = ref("#/components/schemas/Scene"), content_type = "application/json"),
    responses((status = 200, description = "replaced", body = ref("#/components/schemas/Saved")),
        (status = 201, description = "made", body = ref("#/components/schemas/Saved")), Unreplaced))]
pub async fn replace(State(app): State<App>, Id(id): Id, request: Request) -> Result<Response, Problem> {
    let expect = match (if_match(request.headers()), if_none_match(request.headers())) {
        (Some(tags), _) => Expect::Etags(tags),
        (None, Some(tags)) if tags == ["*"] => Expect::Absent,
        _ => return Err(precondition_required()),
    };
    writable(&app, &id)?;
    let Json(doc) = Json::<SceneDoc>::from_request(request, &app).await?;
    let scene = app.catalog.scene_of(doc).await?;
    let written = app.catalog.save(&id, expect, scene).await.map_err(|problem| match problem.code {
        // PUT could make it: then it is the precondition that fails (RFC 9110, 13.1.1).
        Code::NotFound => Problem::new(Code::StaleEtag, "There is no scene to replace under this id."),
        _ => problem,
    })?;
    let status = if written.created { StatusCode::CREATED } else { StatusCode::OK };
    Ok(saved(status, id, written.etag))
}

fn precondition_required() -> Problem {
    let detail = "Send If-Match with the ETag you read, or If-None-Match: * to create with PUT.";
    Problem::new(Code::PreconditionRequired, detail)
}

fn writable(app: &App, id: &str) -> Result<(), Problem> {
    if app.catalog.library.has(id) {
        let detail = "This scene is read-only; POST to its /duplicate and change the copy.";
        return Err(Problem::new(Code::ReadOnly, detail));
    }
    Ok(())
}

/// Merge patch of what people say about a scene.
#[derive(Debug, Default, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ScenePatch {
    /// New name; null empties it.
    #[serde(deserialize_with = "present")]
    name: Option<Option<String>>,
    /// New tags; null removes all.
    #[serde(deserialize_with = "present")]
    tags: Option<Option<Vec<String>>>,
    /// New notes; null empties them.
    #[serde(deserialize_with = "present")]
    notes: Option<Option<String>>,
}

/// Tells null from absence.
fn present<'de, D: serde::Deserializer<'de>, T: Deserialize<'de>>(
    d: D,
) -> Result<Option<Option<T>>, D::Error> {
    Option::deserialize(d).map(Some)
}

refusals!(Unrenamed: CHANGES BODY SCENE STORE WORK,
    NotFound, StaleEtag, PreconditionRequired, ReadOnly, StoreFull);

/// Renames a scene, or changes its tags or notes (RFC 7396 merge patch).
#[utoipa::path(patch, path = "/v1/scenes/{id}", operation_id = "renameScene", tag = "scenes",
    params(("id" = String, Path), ("If-Match" = String, Header)),
    request_body(content = ref("#/components/schemas/ScenePatch"),
        content_type = "application/merge-patch+json", example = json!({"name": "left turn, late"})),
    responses((status = 200, description = "changed", body = ref("#/components/schemas/Saved")), Unrenamed))]
pub async fn rename(State(app): State<App>, Id(id): Id, request: Request) -> Result<Response, Problem> {
    let tags = if_match(request.headers()).ok_or_else(precondition_required)?;
    body::media_type(request.headers(), &["application/merge-patch+json", "application/json"])?;
    writable(&app, &id)?;
    let reading = Reading::from_ref(&app);
    let patch: ScenePatch = reading.parse(reading.json(request).await?).await?;
    let (summary, json) = app.catalog.store.get(&id).await?.ok_or_else(not_found)?;
    let bytes = json.len();
    let mut doc = app.pool.document(bytes, move || Ok(native::read_doc(&json)?)).await?;
    if let Some(name) = patch.name {
        doc.name = name.unwrap_or_default();
    }
    if let Some(tags) = patch.tags {
        doc.meta.tags = tags.unwrap_or_default();
    }
    if let Some(notes) = patch.notes {
        doc.meta.notes = notes.unwrap_or_default();
    }
    // The whole scene is checked again, so that a patch cannot store what a PUT could not.
    app.catalog.scene_of(doc.clone()).await?;
    let make = move || record::of_doc(&doc, summary.parent_id, summary.meta, summary.map_sha);
    let record = app.pool.document(bytes, make).await?;
    // Between the read above and this write the scene may have changed: the ETag read decides too.
    let held = tags.iter().any(|t| t == "*" || *t == summary.etag);
    let expect = if held { vec![summary.etag] } else { tags };
    let written = app.catalog.save_record(&id, Expect::Etags(expect), record).await?;
    Ok(saved(StatusCode::OK, id, written.etag))
}

refusals!(Undeleted: CHANGES STORE, NotFound, StaleEtag, PreconditionRequired, ReadOnly, StoreFull);

/// Deletes a scene.
#[utoipa::path(delete, path = "/v1/scenes/{id}", operation_id = "deleteScene", tag = "scenes",
    params(("id" = String, Path), ("If-Match" = String, Header)),
    responses((status = 204, description = "deleted"), Undeleted))]
pub async fn remove(State(app): State<App>, Id(id): Id, headers: HeaderMap) -> Result<StatusCode, Problem> {
    let tags = if_match(&headers).ok_or_else(precondition_required)?;
    writable(&app, &id)?;
    app.catalog.delete(&id, Expect::Etags(tags)).await?;
    Ok(StatusCode::NO_CONTENT)
}

/// How the copy is called.
#[derive(Debug, Default, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct DuplicateRequest {
    /// The original's with "copy" after it when absent.
    name: Option<String>,
}

refusals!(Uncopied: CHANGES BODY STORE WORK, NotFound, StoreFull);

/// Copies a scene, read-only ones too; `meta.parent_id` names the original.
#[utoipa::path(post, path = "/v1/scenes/{id}/duplicate", operation_id = "duplicateScene", tag = "scenes",
    params(("id" = String, Path)),
    request_body(content = ref("#/components/schemas/DuplicateRequest"), content_type = "application/json",
        example = json!({"name": "left turn, later"})),
    responses((status = 201, description = "stored", body = ref("#/components/schemas/Saved")), Uncopied))]
pub async fn duplicate(State(app): State<App>, Id(id): Id, request: Request) -> Result<Response, Problem> {
    let typed = request.headers().contains_key(header::CONTENT_TYPE);
    if typed {
        body::media_type(request.headers(), body::JSON)?;
    }
    let reading = Reading::from_ref(&app);
    let bytes = reading.json(request).await?;
    let options: DuplicateRequest = if bytes.bytes().is_empty() && !typed {
        DuplicateRequest::default()
    } else {
        reading.parse(bytes).await?
    };
    let opened = app.catalog.open(&id).await?;
    let mut scene = (*opened.scene).clone();
    scene.name = match options.name {
        Some(name) if name.chars().count() > MAX_NAME_CHARS => {
            return Err(Problem::range("/name", 0.0, MAX_NAME_CHARS as f64, name.chars().count() as f64));
        }
        Some(name) => name,
        // The longest names lose what the word needs.
        None => scene.name.chars().take(MAX_NAME_CHARS - 5).chain(" copy".chars()).collect(),
    };
    scene.meta.parent_id = Some(id);
    let copy = id::fresh();
    let written = app.catalog.save(&copy, Expect::Absent, scene).await?;
    Ok(saved(StatusCode::CREATED, copy, written.etag))
}
