//! Builds the editor so that it can be embedded: `npm ci` and `npm run build` in `web/` when its
//! sources changed.

use std::path::Path;
use std::process::Command;

fn main() -> Result<(), String> {
    for (name, variable) in [("TARGET", "BUILD_TARGET"), ("PROFILE", "BUILD_PROFILE")] {
        println!("cargo::rustc-env={variable}={}", std::env::var(name).unwrap_or_default());
    }
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=../assets/scenes");
    println!("cargo::rerun-if-env-changed=DRAGTRAFFIC_SKIP_WEB");
    let web = Path::new("../web");
    let page = web.join("dist/index.html");
    if !web.join("package.json").exists() {
        return placeholder(&page, "The editor's sources are not in this checkout.");
    }
    for source in [
        "src",
        "public",
        "index.html",
        "package.json",
        "package-lock.json",
        "vite.config.ts",
        "tsconfig.json",
    ] {
        if web.join(source).exists() {
            println!("cargo::rerun-if-changed={}", web.join(source).display());
        }
    }
    if std::env::var_os("DRAGTRAFFIC_SKIP_WEB").is_some() {
        return if page.exists() { Ok(()) } else { placeholder(&page, "Built with DRAGTRAFFIC_SKIP_WEB.") };
    }
    install(web)?;
    npm(web, &["run", "build"])
}

/// Installs the packages unless the installed ones are as new as the lock file. `cargo xtask` applies the same rule:
/// a second installation would remove the packages under a test that runs at the same time.
fn install(web: &Path) -> Result<(), String> {
    let changed = |path: &str| web.join(path).metadata().and_then(|file| file.modified()).ok();
    let (locked, installed) = (changed("package-lock.json"), changed("node_modules/.package-lock.json"));
    if installed.is_some() && installed >= locked {
        return Ok(());
    }
    npm(web, &["ci", "--no-audit", "--no-fund"])
}

fn npm(web: &Path, arguments: &[&str]) -> Result<(), String> {
    let program = if cfg!(windows) { "npm.cmd" } else { "npm" };
    let run = Command::new(program).args(arguments).current_dir(web).output();
    let output = run.map_err(|error| {
        format!(
            "cannot run npm ({error}). The editor is built with Node.js 20 or later: install it from your \
             system's packages or https://nodejs.org, then build again. To build without the editor, set \
             DRAGTRAFFIC_SKIP_WEB=1."
        )
    })?;
    if output.status.success() {
        return Ok(());
    }
    let text = [output.stdout, output.stderr].concat();
    Err(format!("npm {} failed in web/:\n{}", arguments.join(" "), String::from_utf8_lossy(&text)))
}

fn placeholder(page: &Path, why: &str) -> Result<(), String> {
    let html = format!(
        "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>DragTraffic</title><p>{why} The API is described at <a href=\"/docs\">/docs</a>.</p></html>\n"
    );
    let write =
        page.parent().map_or(Ok(()), std::fs::create_dir_all).and_then(|()| std::fs::write(page, html));
    write.map_err(|error| error.to_string())
}
