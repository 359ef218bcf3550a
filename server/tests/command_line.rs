//! The program starts and knows its commands. (Having a test here also makes `cargo test --workspace`
//! build the program, which the end-to-end tests then use.)

use std::process::Command;

/// Every command shows two calls that its own flags allow; the program says how commands end.
#[test]
fn every_help_has_examples() {
    let help = |arguments: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_dragtraffic")).args(arguments).output().unwrap();
        assert!(output.status.success(), "{arguments:?}");
        String::from_utf8(output.stdout).unwrap()
    };
    let whole = help(&["--help"]);
    assert!(whole.contains("Exit codes:") && whole.contains("8 the output exists"));
    let commands = whole.split_once("Commands:").unwrap().1.split_once("\n\n").unwrap().0;
    let names: Vec<&str> =
        commands.lines().filter_map(|line| line.split_whitespace().next()).filter(|n| *n != "help").collect();
    assert!(names.len() > 12, "{names:?}");
    for name in names {
        let text = help(&[name, "--help"]);
        let examples: Vec<&str> = text.split_once("Examples:\n").unwrap().1.lines().take(2).collect();
        for example in &examples {
            let call = example.trim().strip_prefix("dragtraffic ").unwrap();
            assert!(call.starts_with(name), "{name}: {call}");
            let flags = call.split_whitespace().filter(|word| word.starts_with("--"));
            for flag in flags {
                assert!(text.contains(flag), "{name} has no {flag}");
            }
        }
        assert_eq!(examples.len(), 2, "{name}");
        assert!(text.contains("Exit codes: 0 done"), "{name}");
    }
}

#[test]
fn it_says_its_version_and_its_commands() {
    let run = |flag: &str| Command::new(env!("CARGO_BIN_EXE_dragtraffic")).arg(flag).output().unwrap();
    let version = run("--version");
    assert!(version.status.success());
    let expected = format!("dragtraffic {}\n", env!("CARGO_PKG_VERSION"));
    assert_eq!(String::from_utf8_lossy(&version.stdout), expected);
    let help = String::from_utf8_lossy(&run("--help").stdout).into_owned();
    for command in [
        "serve",
        "generate",
        "convert",
        "import",
        "export",
        "score",
        "completions",
        "man",
        "info",
        "synthesize",
    ] {
        assert!(help.contains(command), "{command}");
    }
}
