//! `dragtraffic openapi`, `schema`, `domain` and `info`.

use super::{Common, Exit, Failure, output};
use crate::base::limits::Limits;
use crate::routes::info::Info;
use clap::Args;
use std::path::{Path, PathBuf};

/// Flags of `openapi`, `schema` and `domain`.
#[derive(Args, Clone, Debug)]
pub struct CheckArgs {
    /// Compare with this file and exit 1 on a difference.
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

/// Prints or checks the scene's JSON Schema.
///
/// # Errors
/// Exit 1 on a difference.
pub fn schema(args: CheckArgs) -> Result<(), Failure> {
    let mut text = serde_json::to_string_pretty(&formats::native::schema()).unwrap_or_default();
    text.push('\n');
    show(&text, args.check.as_deref(), "schema")
}

/// Prints or checks motion limits, ranges of conditions and defaults of requests.
///
/// # Errors
/// Exit 1 on a difference.
pub fn domain(args: CheckArgs) -> Result<(), Failure> {
    show(&crate::base::domain::text(), args.check.as_deref(), "domain")
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

/// Prints what `/v1/info` gives.
///
/// # Errors
/// Exit 7 without weights.
pub fn info(common: &Common) -> Result<(), Failure> {
    let experts::Engine { generator, placer } = common.engine()?;
    let info = Info::new(&generator, &placer, &Limits::default());
    let mut text = serde_json::to_string_pretty(&info).unwrap_or_default();
    text.push('\n');
    output::print(text.as_bytes())
}
