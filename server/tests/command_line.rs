//! The program starts and knows its commands. (Having a test here also makes `cargo test --workspace`
//! build the program, which the end-to-end tests then use.)

#![allow(clippy::unwrap_used, reason = "a failed test panics")]

use std::process::Command;

fn help(arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_dragtraffic")).args(arguments).output().unwrap();
    assert!(output.status.success(), "{arguments:?}");
    String::from_utf8(output.stdout).unwrap()
}

/// Names of the commands in a help.
fn commands(help: &str) -> Vec<&str> {
    let commands = help.split_once("Commands:").unwrap().1.split_once("\n\n").unwrap().0;
    commands
        .lines()
        .filter_map(|line| line.split_whitespace().next())
        .filter(|name| *name != "help")
        .collect()
}

/// Every command shows two calls that its own flags allow, and names the global options in one line.
fn shows_examples(text: &str, command: &str) {
    let (own, end) = text.split_once("Examples:\n").unwrap();
    let examples: Vec<&str> = end.lines().take(2).collect();
    for example in &examples {
        let call = example.trim().strip_prefix("dragtraffic ").unwrap();
        assert!(call.starts_with(command), "{command}: {call}");
        for flag in call.split_whitespace().filter(|word| word.starts_with("--")) {
            assert!(text.contains(flag), "{command} has no {flag}");
        }
    }
    assert_eq!(examples.len(), 2, "{command}");
    assert!(end.contains("Exit codes: 0 done"), "{command}");
    assert!(!own.contains("--log-level") && !own.contains("--quiet"), "{command} repeats the global options");
}

#[test]
fn every_help_has_examples() {
    let whole = help(&["--help"]);
    assert!(whole.contains("Exit codes:") && whole.contains("8 the output exists"));
    let names = commands(&whole);
    assert!(names.len() > 12, "{names:?}");
    for name in names.into_iter().filter(|name| *name != "lab") {
        shows_examples(&help(&[name, "--help"]), name);
    }
    let of_lab = help(&["lab", "--help"]);
    for name in commands(&of_lab) {
        shows_examples(&help(&["lab", name, "--help"]), &format!("lab {name}"));
    }
}

/// The one line of a command names every option that the program's own help describes as global.
#[test]
fn global_options_stand_in_one_line_of_each_command() {
    let whole = help(&["--help"]);
    let described = whole.split_once("Global options:").unwrap().1.split_once("Exit codes:").unwrap().0;
    let line = help(&["score", "--help"]);
    let line = line.lines().find(|line| line.starts_with("Global options:")).unwrap();
    let options = described.lines().filter_map(|line| line.trim_start().strip_prefix('-'));
    let names: Vec<&str> = options
        .filter_map(|option| option.split([',', ' ']).next())
        .filter(|name| !name.is_empty())
        .collect();
    assert!(names.len() == 5, "{names:?}");
    for name in names {
        assert!(line.contains(&format!("-{name}")), "{name}: {line}");
    }
}

#[test]
fn what_a_user_does_stands_before_the_lab() {
    let whole = help(&["-h"]);
    let names = commands(&whole);
    let first = ["serve", "generate", "batch", "replay", "index", "mine", "match", "map", "place"];
    assert_eq!(names[..first.len()], first);
    assert_eq!(names.last(), Some(&"lab"));
    let output =
        Command::new(env!("CARGO_BIN_EXE_dragtraffic")).args(["train", "a.records"]).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("dragtraffic lab train"));
}

#[test]
fn it_says_its_version_and_its_commands() {
    let run = |flag: &str| Command::new(env!("CARGO_BIN_EXE_dragtraffic")).arg(flag).output().unwrap();
    let version = run("--version");
    assert!(version.status.success());
    let expected = format!("dragtraffic {}\n", env!("CARGO_PKG_VERSION"));
    assert_eq!(String::from_utf8_lossy(&version.stdout), expected);
    let help = String::from_utf8_lossy(&run("--help").stdout).into_owned();
    for command in
        ["serve", "generate", "convert", "import", "export", "score", "completions", "man", "info", "lab"]
    {
        assert!(help.contains(command), "{command}");
    }
}
