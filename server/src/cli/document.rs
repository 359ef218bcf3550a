//! `dragtraffic openapi`, `schema`, `domain` and `info`.

use super::{Common, Exit, Failure, output};
use crate::routes::info;
use base::limits::Limits;
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};

/// Flags of `openapi` and `domain`.
#[derive(Args, Clone, Debug)]
pub struct CheckArgs {
    /// Compare with this file; exit with 1 on a difference.
    #[arg(long, value_name = "FILE")]
    check: Option<PathBuf>,
}

/// Prints or checks the OpenAPI document.
///
/// # Errors
/// Exit 1 on a difference.
pub fn openapi(args: CheckArgs) -> Result<(), Failure> {
    show(&crate::routes::openapi::text(), args.check.as_deref(), "openapi")
}

/// Documents with a JSON Schema.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum SchemaOf {
    /// Scene document.
    Scene,
    /// Plan of a batch.
    Batch,
    /// Pattern: a road with road users.
    Pattern,
}

/// Flags of `schema`.
#[derive(Args, Clone, Debug)]
pub struct SchemaArgs {
    /// Document.
    #[arg(value_enum, default_value = "scene")]
    document: SchemaOf,
    #[command(flatten)]
    check: CheckArgs,
}

/// Prints or checks a JSON Schema.
///
/// # Errors
/// Exit 1 on a difference.
pub fn schema(args: SchemaArgs) -> Result<(), Failure> {
    let (schema, command) = match args.document {
        SchemaOf::Scene => (formats::native::schema(), "schema"),
        SchemaOf::Batch => (batch::plan::schema(), "schema batch"),
        SchemaOf::Pattern => (batch::pattern::document::schema(), "schema pattern"),
    };
    let mut text = serde_json::to_string_pretty(&schema).unwrap_or_default();
    text.push('\n');
    show(&text, args.check.check.as_deref(), command)
}

/// Prints or checks motion limits, ranges of conditions and defaults of requests.
///
/// # Errors
/// Exit 1 on a difference.
pub fn domain(args: CheckArgs) -> Result<(), Failure> {
    show(&api::domain::text(), args.check.as_deref(), "domain")
}

fn show(text: &str, check: Option<&Path>, command: &str) -> Result<(), Failure> {
    let Some(path) = check else { return output::print(text.as_bytes()) };
    if output::read(path)? == text.as_bytes() {
        return Ok(());
    }
    let message =
        format!("{path} is out of date; run: dragtraffic {command} > {path}", path = path.display());
    Err(Failure::new(Exit::Failure, message))
}

/// Flags of `info`.
#[derive(Args, Clone, Debug)]
pub struct InfoArgs {
    /// Part to print, such as formats, weights or limits. Default: all.
    part: Option<String>,
    /// Print the formats as a Markdown table.
    #[arg(long)]
    markdown: bool,
}

/// Prints the reply of `/v1/info`, or a part of it.
///
/// # Errors
/// Exit 2 for an unknown part, 7 without weights.
pub fn info(args: InfoArgs, common: &Common) -> Result<(), Failure> {
    if args.markdown {
        return match args.part.as_deref() {
            Some("formats") => output::print(formats::registry::markdown().as_bytes()),
            _ => Err(Failure::usage("--markdown is for formats: dragtraffic info formats --markdown")),
        };
    }
    let info = serde_json::to_value(info::of(&common.operations()?, &Limits::default())).unwrap_or_default();
    let shown = match &args.part {
        None => Some(&info),
        Some(part) => info.get(part),
    };
    let Some(shown) = shown else {
        let parts: Vec<&str> =
            info.as_object().into_iter().flatten().map(|(name, _)| name.as_str()).collect();
        let message =
            format!("info has no part {}; there are {}", args.part.unwrap_or_default(), parts.join(", "));
        return Err(Failure::usage(message));
    };
    let mut text = serde_json::to_string_pretty(shown).unwrap_or_default();
    text.push('\n');
    output::print(text.as_bytes())
}
