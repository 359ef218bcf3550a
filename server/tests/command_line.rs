//! The program starts and knows its commands. (Having a test here also makes `cargo test --workspace`
//! build the program, which the end-to-end tests then use.)

use std::process::Command;

#[test]
fn it_says_its_version_and_its_commands() {
    let run = |flag: &str| Command::new(env!("CARGO_BIN_EXE_dragtraffic")).arg(flag).output().unwrap();
    let version = run("--version");
    assert!(version.status.success());
    let expected = format!("dragtraffic {}\n", env!("CARGO_PKG_VERSION"));
    assert_eq!(String::from_utf8_lossy(&version.stdout), expected);
    let help = String::from_utf8_lossy(&run("--help").stdout).into_owned();
    for command in
        ["serve", "generate", "convert", "import", "export", "score", "openapi", "info", "synthesize"]
    {
        assert!(help.contains(command), "{command}");
    }
}
