//! `/openapi.json`, `/docs`, `/docs/problems`: pages made from the document and the table of codes, without
//! scripts or external resources.

use super::openapi;
use api::Code;
use axum::http::header;
use axum::response::{Html, IntoResponse};
use base::base_path;
use base::problem::status_of;
use serde_json::Value;
use std::fmt::Write;
use std::sync::OnceLock;

/// The document.
pub async fn document() -> impl IntoResponse {
    static TEXT: OnceLock<String> = OnceLock::new();
    let text = TEXT.get_or_init(openapi::text).as_str();
    ([(header::CONTENT_TYPE, "application/json")], text)
}

/// Its style sheet.
pub async fn style() -> impl IntoResponse {
    ([(header::CONTENT_TYPE, "text/css; charset=utf-8")], include_str!("../../openapi/docs.css"))
}

/// All operations on one page.
pub async fn reference() -> Html<&'static str> {
    static PAGE: OnceLock<String> = OnceLock::new();
    Html(PAGE.get_or_init(|| page("DragTraffic HTTP API", &operations())).as_str())
}

/// All codes on one page; `type` of a problem points here.
pub async fn problems() -> Html<&'static str> {
    static PAGE: OnceLock<String> = OnceLock::new();
    Html(PAGE.get_or_init(|| page("DragTraffic problems", &codes())).as_str())
}

fn page(title: &str, body: &str) -> String {
    let base = base_path::base();
    format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{title}</title>\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\
         <link rel=\"stylesheet\" href=\"{base}/docs/style.css\"></head><body><main>\
         <nav><a href=\"{base}/\">Editor</a> <a href=\"{base}/docs\">API</a> \
         <a href=\"{base}/docs/problems\">Problems</a> <a href=\"{base}/openapi.json\">openapi.json</a></nav><h1>{title}</h1>{body}</main></body></html>\n"
    )
}

fn codes() -> String {
    let mut html = String::from("<p>Every refusal is <code>application/problem+json</code> (RFC 9457).</p>");
    for code in Code::ALL {
        let _ = write!(
            html,
            "<section id=\"{name}\"><h2><code>{name}</code> <small>{status}</small></h2><p><b>{title}.</b> {when}</p></section>",
            name = code.name(),
            status = status_of(*code),
            title = escape(code.title()),
            when = escape(code.when()),
        );
    }
    html
}

fn operations() -> String {
    let document = openapi::document();
    let mut html = format!("<p>{}</p>", escape(document["info"]["description"].as_str().unwrap_or_default()));
    for (path, item) in document["paths"].as_object().into_iter().flatten() {
        for (method, operation) in item.as_object().into_iter().flatten() {
            one_operation(&mut html, path, method, operation);
        }
    }
    let _ = write!(html, "<h2>Schemas</h2>");
    for (name, schema) in document["components"]["schemas"].as_object().into_iter().flatten() {
        let text = serde_json::to_string_pretty(schema).unwrap_or_default();
        let _ = write!(
            html,
            "<details id=\"schema-{name}\"><summary><code>{name}</code></summary><pre>{}</pre></details>",
            escape(&text)
        );
    }
    html
}

fn one_operation(html: &mut String, path: &str, method: &str, operation: &Value) {
    let text = |key: &str| escape(operation[key].as_str().unwrap_or_default());
    let _ = write!(
        html,
        "<section id=\"{}\"><h2><b>{}</b> <code>{}</code></h2><p>{}</p><p>{}</p>",
        text("operationId"),
        method.to_uppercase(),
        escape(path),
        text("summary"),
        text("description"),
    );
    if let Some(parameters) = operation["parameters"].as_array() {
        let _ = write!(html, "<h3>Parameters</h3><ul>");
        for parameter in parameters {
            let word = |key: &str| escape(parameter[key].as_str().unwrap_or_default());
            let _ = write!(
                html,
                "<li><code>{}</code> ({}) {}</li>",
                word("name"),
                word("in"),
                word("description")
            );
        }
        let _ = write!(html, "</ul>");
    }
    for (media, content) in operation["requestBody"]["content"].as_object().into_iter().flatten() {
        let _ = write!(html, "<h3>Body</h3><p>{} {}</p>", escape(media), schema_link(&content["schema"]));
        if content["example"].is_object() {
            let example = serde_json::to_string_pretty(&content["example"]).unwrap_or_default();
            let _ = write!(html, "<pre>{}</pre>", escape(&example));
        }
    }
    let _ = write!(html, "<h3>Replies</h3><ul>");
    for (status, reply) in operation["responses"].as_object().into_iter().flatten() {
        let description = escape(reply["description"].as_str().unwrap_or_default());
        let _ = write!(html, "<li><b>{status}</b> {description}");
        if status.starts_with('2') {
            for (media, content) in reply["content"].as_object().into_iter().flatten() {
                let _ = write!(html, " {} {}", escape(media), schema_link(&content["schema"]));
            }
        }
        let _ = write!(html, "</li>");
    }
    let _ = write!(html, "</ul></section>");
}

fn schema_link(schema: &Value) -> String {
    let name = schema["$ref"].as_str().and_then(|r| r.rsplit('/').next());
    name.map(|name| format!("<a href=\"#schema-{name}\">{name}</a>")).unwrap_or_default()
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
