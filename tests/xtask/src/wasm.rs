//! `wasm`: the engine without clock, threads or files, as in a web page.
//!
//! The standard library for WebAssembly comes from rustup. If rustup cannot reach its server, Debian's
//! compiler for browsers and its sources of that library are unpacked under `target/wasm`.

use crate::system::apt_lock;
use crate::{Outcome, cargo_command, root, run};
use anyhow::{Context, ensure};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

const TARGET: &str = "wasm32-unknown-unknown";
const CRATES: &[&str] = &[
    "dragtraffic-scene",
    "dragtraffic-formats",
    "dragtraffic-layouts",
    "dragtraffic-experts",
    "dragtraffic-api",
];
/// Debian's packages: compiler, sources of the standard library, and the libraries that the compiler loads.
const PACKAGES: &[&str] = &["rustc-web", "rust-web-src", "libstd-rust-web-dev"];
const LOADED: &[&str] = &["libstd-rust-web-", "libllvm"];

/// Checks the crates of the engine for that target.
pub fn check() -> anyhow::Result<Outcome> {
    let mut cargo = cargo_command();
    cargo.args(["check", "--locked", "--target", TARGET]);
    cargo.args(CRATES.iter().flat_map(|name| ["-p", name]));
    if !has_target()? && !quiet(Command::new("rustup").args(["target", "add", TARGET])) {
        let folder = root().join("target/wasm");
        if let Err(why) = unpack(&folder) {
            return Ok(Outcome::Skipped(format!("rustup target add {TARGET} fails, and {why:#}")));
        }
        use_unpacked(&mut cargo, &folder)?;
    }
    run(&mut cargo)
}

/// Whether the available compiler has the standard library of the target.
fn has_target() -> anyhow::Result<bool> {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let sysroot = text_of(Command::new(rustc).args(["--print", "sysroot"]))?;
    Ok(Path::new(sysroot.trim()).join("lib/rustlib").join(TARGET).join("lib").is_dir())
}

/// Downloads and unpacks Debian's packages, once.
///
/// # Errors
/// If the system is not Debian, or lacks the packages.
fn unpack(folder: &Path) -> anyhow::Result<()> {
    if folder.join("complete").is_file() {
        return Ok(());
    }
    let _alone = apt_lock();
    std::fs::create_dir_all(folder.join("packages"))?;
    // Outdated lists make the download fail below.
    let _ = quiet(Command::new("apt-get").args(["update", "-q"]));
    let packages = packages()?;
    let downloaded = Command::new("apt-get")
        .args(["download", "-q"])
        .args(&packages)
        .current_dir(folder.join("packages"))
        .status()?;
    ensure!(downloaded.success(), "{} cannot be downloaded", packages.join(", "));
    for package in std::fs::read_dir(folder.join("packages"))? {
        let package = package?.path();
        let unpacked = Command::new("dpkg").arg("-x").args([&package, folder]).status()?;
        ensure!(unpacked.success(), "{} cannot be unpacked", package.display());
    }
    std::fs::write(folder.join("complete"), packages.join("\n"))?;
    Ok(())
}

/// Names of the packages, with the dependencies that they need to run.
fn packages() -> anyhow::Result<Vec<String>> {
    let mut packages: Vec<String> = PACKAGES.iter().map(|name| (*name).to_owned()).collect();
    let mut next = 0;
    while let Some(package) = packages.get(next) {
        let text = text_of(Command::new("apt-cache").args(["depends", package]))?;
        let needed = text.lines().filter_map(|line| line.trim().strip_prefix("Depends: "));
        let needed = needed.filter(|name| LOADED.iter().any(|start| name.starts_with(start)));
        let new: Vec<String> =
            needed.filter(|name| !packages.iter().any(|known| known == name)).map(str::to_owned).collect();
        packages.extend(new);
        next += 1;
    }
    Ok(packages)
}

/// Makes cargo build with the unpacked compiler and standard library.
fn use_unpacked(cargo: &mut Command, folder: &Path) -> anyhow::Result<()> {
    let libraries = folder.join("usr/lib");
    let triplets: Vec<PathBuf> =
        std::fs::read_dir(&libraries)?.filter_map(|entry| Some(entry.ok()?.path())).collect();
    let loaded = std::env::join_paths(triplets.iter().flat_map(|path| [path.clone(), path.join("lib")]))
        .context("folders of libraries")?;
    cargo.args(["-Z", "build-std=std,panic_abort", "--target-dir"]).arg(folder.join("built"));
    cargo.env("RUSTC", folder.join("usr/bin/rustc")).env("LD_LIBRARY_PATH", loaded);
    // A stable compiler builds the standard library only with this variable.
    cargo.env("RUSTC_BOOTSTRAP", "1");
    Ok(())
}

fn text_of(command: &mut Command) -> anyhow::Result<String> {
    let output = command.stdin(Stdio::null()).output().with_context(|| format!("cannot run {command:?}"))?;
    Ok(String::from_utf8(output.stdout)?)
}

fn quiet(command: &mut Command) -> bool {
    let command = command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command.status().is_ok_and(|status| status.success())
}
