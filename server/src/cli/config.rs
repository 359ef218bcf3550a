//! Server options from a TOML file. The command line and the environment take precedence.

use clap::{Arg, ArgMatches, Command};
use std::path::Path;

/// Commands with the options of the server.
pub const COMMANDS: [&str; 2] = ["serve", "doctor"];

/// The parsed command line with the file's options as defaults; `None` if no file is named.
///
/// # Errors
/// A sentence about the file.
pub fn with_file(command: Command, matches: &ArgMatches) -> Result<Option<Command>, String> {
    let own = match matches.subcommand() {
        None => matches,
        Some((name, own)) if COMMANDS.contains(&name) => own,
        Some(_) => return Ok(None),
    };
    let Some(path) = own.get_one::<std::path::PathBuf>("config") else { return Ok(None) };
    let wrong = |reason: String| format!("--config {}: {reason}", path.display());
    let options = read(path).map_err(wrong)?;
    for (name, _) in &options {
        if !super::serve::is_option(name) {
            return Err(wrong(format!("\"{name}\" is no option of serve")));
        }
    }
    let filled = |command: Command| {
        command.mut_args(|arg| match options.iter().find(|(name, _)| arg.get_long() == Some(name)) {
            Some((_, values)) => with_default(arg, values),
            None => arg,
        })
    };
    // If `command` is itself one of these commands, it has no such subcommands.
    let named = |name: &&str| command.find_subcommand(name).is_some();
    let named: Vec<&str> = COMMANDS.into_iter().filter(named).collect();
    Ok(Some(filled(named.into_iter().fold(command, |command, name| command.mut_subcommand(name, filled)))))
}

fn with_default(arg: Arg, values: &[String]) -> Arg {
    // Leaked on purpose: read once per process.
    let values = values.iter().map(|value| &*Box::leak(value.clone().into_boxed_str()));
    arg.default_values(values)
}

/// The file's values, by name of the option.
fn read(path: &Path) -> Result<Vec<(String, Vec<String>)>, String> {
    let text = std::fs::read_to_string(path).map_err(|error| error.to_string())?;
    let table: toml::Table = text.parse().map_err(|error: toml::de::Error| error.to_string())?;
    table.into_iter().map(|(name, value)| Ok((name.replace('_', "-"), values(&name, value)?))).collect()
}

fn values(name: &str, value: toml::Value) -> Result<Vec<String>, String> {
    let one = |value: toml::Value| match value {
        toml::Value::String(text) => Ok(text),
        toml::Value::Integer(number) => Ok(number.to_string()),
        toml::Value::Boolean(flag) => Ok(flag.to_string()),
        _ => Err(format!("{name}: a text, a whole number, a boolean or a list of them is expected")),
    };
    match value {
        toml::Value::Array(list) => list.into_iter().map(one).collect(),
        value => Ok(vec![one(value)?]),
    }
}
