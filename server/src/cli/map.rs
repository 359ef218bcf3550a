//! `dragtraffic map`: the operation of `POST /v1/map`, to a file.

use super::{Common, Failure, output};
use api::map::{MapBody, TemplateList};
use clap::Args;
use formats::native::{self, AnyDoc};
use layouts::Template;
use serde_json::{Value, json};
use std::path::PathBuf;

/// Flags of `map`.
#[derive(Args, Clone, Debug)]
pub struct MapArgs {
    /// Template to start from. Required unless the file of --parameters names one.
    #[arg(long, value_enum, required_unless_present_any = ["parameters_file", "list"])]
    template: Option<Template>,
    /// Print the templates with their parameters as JSON.
    #[arg(long, exclusive = true)]
    list: bool,
    /// JSON file with `template` and `parameters`, or with only parameters; - is standard input.
    #[arg(long = "parameters", value_name = "FILE")]
    parameters_file: Option<PathBuf>,
    /// Set one parameter by its path, such as kerb_radius_m=6 or arms.1.angle_deg=71. Overrides the file.
    #[arg(long, value_name = "PATH=VALUE", value_parser = setting)]
    set: Vec<Setting>,
    /// Name of the scene.
    #[arg(long)]
    name: Option<String>,
    /// File for the scene; - is standard output.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Print the scene as JSON, also on a terminal.
    #[arg(long, conflicts_with = "output")]
    json: bool,
    /// Overwrite the output.
    #[arg(long)]
    force: bool,
}

/// A parameter and its value.
#[derive(Clone, Debug, PartialEq)]
struct Setting {
    path: Vec<String>,
    value: Value,
}

/// Parses `PATH=VALUE`; a value that is not JSON is text.
fn setting(text: &str) -> Result<Setting, String> {
    let (path, value) = text.split_once('=').ok_or("a place and = expected first, as in kerb_radius_m=6")?;
    let path: Vec<String> = path.split('.').map(str::to_owned).collect();
    if path.iter().any(String::is_empty) {
        return Err("names with dots between them expected before =, as in arms.1.angle_deg=71".into());
    }
    let value = serde_json::from_str(value).unwrap_or_else(|_| Value::from(value));
    Ok(Setting { path, value })
}

/// Builds a map and writes a scene with it.
///
/// # Errors
/// Exit 2, 3, 8.
pub fn run(args: MapArgs, common: &Common) -> Result<(), Failure> {
    if args.list {
        let mut text = serde_json::to_string_pretty(&TemplateList::current()).unwrap_or_default();
        text.push('\n');
        return output::print(text.as_bytes());
    }
    if let Some(path) = &args.output {
        output::keep(path, args.force)?;
    }
    let (_, scene, built) = request(&args)?.draw().map_err(|problem| {
        let faults: Vec<String> = problem
            .members
            .errors
            .iter()
            .flatten()
            .map(|fault| format!("{}: {}", flag(&fault.pointer), fault.detail))
            .collect();
        Failure::usage(faults.join("; "))
    })?;
    for check in &built.checks {
        common.say(&format!("{} {}", if check.passed { "ok  " } else { "LOOK" }, check.text));
    }
    output::write_scene(args.output.as_deref(), &native::write(&scene), args.force, args.json)
}

/// Converts a pointer into the body to the form of `--set`.
fn flag(pointer: &str) -> String {
    pointer.trim_start_matches("/parameters").trim_start_matches('/').replace('/', ".")
}

/// The request of the flags.
fn request(args: &MapArgs) -> Result<MapBody, Failure> {
    let (mut template, mut parameters) = (args.template, json!({}));
    if let Some(path) = &args.parameters_file {
        let bytes = output::read(path)?;
        let AnyDoc(file) = native::from_json::<AnyDoc>(&bytes)
            .map_err(|error| Failure::input(format!("{}: {error}", path.display())))?;
        match file.get("template") {
            Some(named) => {
                let wrong = |error: serde_json::Error| Failure::usage(format!("options: {error}"));
                let named = || serde_json::from_value(named.clone()).map_err(wrong);
                template = Some(template.map_or_else(named, Ok)?);
                parameters = file.get("parameters").cloned().unwrap_or_else(|| json!({}));
            }
            None => parameters = file,
        }
    }
    let template = template.ok_or_else(|| Failure::usage("--template is needed: the file names none"))?;
    for setting in &args.set {
        put(&mut parameters, template, setting)?;
    }
    Ok(MapBody { template, parameters: Some(AnyDoc(parameters)), name: args.name.clone() })
}

/// Sets one value; if it lies within a list, the list is first copied from the template.
fn put(parameters: &mut Value, template: Template, setting: &Setting) -> Result<(), Failure> {
    let unknown = || Failure::usage(format!("--set {}: there is no such parameter", setting.path.join(".")));
    let own = template.all_parameters();
    let first = setting.path.first().ok_or_else(unknown)?;
    if setting.path.len() > 1 && parameters.get(first).is_none() {
        parameters[first.as_str()] = own.get(first).cloned().ok_or_else(unknown)?;
    }
    let mut place = parameters;
    for name in &setting.path {
        place = match place {
            Value::Array(items) => {
                name.parse::<usize>().ok().and_then(|i| items.get_mut(i)).ok_or_else(unknown)?
            }
            Value::Object(members) => members.entry(name.clone()).or_insert(Value::Null),
            _ => return Err(unknown()),
        };
    }
    *place = setting.value.clone();
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_are_put_in_their_place() {
        let mut parameters = json!({});
        for text in [
            "kerb_radius_m=6",
            "arms.1.angle_deg=71",
            "control=equal",
            "program.green_s=20",
            r#"connections.removed=[{"from": "arm2.in1", "to": "arm1.out1"}]"#,
        ] {
            put(&mut parameters, Template::FourArms, &setting(text).unwrap()).unwrap();
        }
        assert_eq!(parameters["kerb_radius_m"], 6);
        assert_eq!(parameters["arms"].as_array().unwrap().len(), 4);
        assert_eq!(parameters["arms"][1]["angle_deg"], 71);
        assert_eq!(
            (&parameters["control"], &parameters["program"]["green_s"]),
            (&json!("equal"), &json!(20))
        );
        assert_eq!(parameters["connections"]["removed"][0]["to"], "arm1.out1");
        for bad in ["arms.9.angle_deg=1", "kerb.a.b=1", "kerb_radius_m.x=1"] {
            assert!(put(&mut parameters, Template::FourArms, &setting(bad).unwrap()).is_err(), "{bad}");
        }
        assert!(setting("kerb").is_err() && setting("a..b=1").is_err());
    }
}
