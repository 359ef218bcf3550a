//! `dragtraffic doctor`: checks whether this machine can serve, beyond the options that `serve --check`
//! checks.

use super::listen::ServerEndpoint;
use super::plan::ServePlan;
use super::serve::ServeArgs;
use super::{Common, Exit, Failure, output};
use crate::scenes::store::{self, StoreError};
use base::{clock, descriptors, machine};
use clap::Args;
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

/// Least free disk space of the store: its log, the reserve for deletes, and a few scenes.
const LEAST_DISK_BYTES: u64 = 64 << 20;
/// A clock before this moment (2026-01-01) is wrong, because it precedes this program.
const EARLIEST: Duration = Duration::from_secs(1_767_225_600);

/// Flags of `doctor`: those of the server that is to run.
#[derive(Args, Clone, Debug)]
pub struct DoctorArgs {
    #[command(flatten)]
    serve: ServeArgs,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// Result of one check.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
enum FindingState {
    Ok,
    /// The server works, but not fully as configured.
    Warning,
    /// The server does not start, or loses data.
    Fault,
}

/// One check of the server's needs.
#[derive(Clone, Debug, Serialize)]
struct Finding {
    what: &'static str,
    verdict: FindingState,
    detail: String,
}

fn finding(what: &'static str, verdict: FindingState, detail: impl Into<String>) -> Finding {
    // The texts of system errors, without their numbers.
    Finding { what, verdict, detail: Failure::input(detail).message }
}

/// The findings as JSON.
#[derive(Serialize)]
struct DoctorReport<'a> {
    ok: bool,
    findings: &'a [Finding],
}

/// Checks options and machine, and prints the findings.
///
/// # Errors
/// Exit 1 with a fault.
pub fn run(args: DoctorArgs, common: &Common) -> Result<(), Failure> {
    let mut findings = Vec::new();
    let plan = match ServePlan::of(&args.serve) {
        Ok(plan) => Some(plan),
        Err(failure) => {
            findings
                .extend(failure.message.lines().map(|line| finding("options", FindingState::Fault, line)));
            None
        }
    };
    findings.push(match common.engine() {
        Ok(engine) => {
            let names: Vec<&str> = engine.generator.weights().keys().map(String::as_str).collect();
            finding("weights", FindingState::Ok, names.join(", "))
        }
        Err(failure) => finding("weights", FindingState::Fault, failure.message),
    });
    if let Some(plan) = &plan {
        findings.insert(0, finding("options", FindingState::Ok, "no fault"));
        findings.extend(addresses(plan)?);
        findings.extend(store(&plan.db, plan.limits.store_bytes));
        findings.extend(args.serve.data.as_deref().map(data));
        findings.push(connections(plan.limits.connections));
        findings.push(memory(plan.limits.memory_bytes));
    }
    findings.push(time());
    let ok = findings.iter().all(|found| found.verdict != FindingState::Fault);
    let text = if args.json {
        let mut text =
            serde_json::to_string_pretty(&DoctorReport { ok, findings: &findings }).unwrap_or_default();
        text.push('\n');
        text
    } else {
        let plan = plan.as_ref().map_or_else(String::new, |plan| plan.lines(&args.serve) + "\n");
        plan + &findings.iter().map(line).collect::<String>()
    };
    output::print(text.as_bytes())?;
    if ok { Ok(()) } else { Err(Failure::new(Exit::Failure, "")) }
}

fn line(found: &Finding) -> String {
    let verdict = match found.verdict {
        FindingState::Ok => "ok",
        FindingState::Warning => "warning",
        FindingState::Fault => "FAULT",
    };
    format!("{verdict:<8}{:<12} {}\n", found.what, found.detail)
}

/// Checks the addresses by binding them briefly.
fn addresses(plan: &ServePlan) -> Result<Vec<Finding>, Failure> {
    let runtime = tokio::runtime::Builder::new_current_thread().enable_io().build()?;
    let own = (plan.endpoint.clone(), plan.endpoint.shown());
    let probes = plan.ops.map(|address| (ServerEndpoint::Address(address), format!("{address} for probes")));
    let taken = |(endpoint, shown): (ServerEndpoint, String)| {
        match runtime.block_on(endpoint.listen()) {
            Ok(_) => {
                if let ServerEndpoint::File(path, _) = &endpoint {
                    // The socket file was created for this check.
                    let _ = std::fs::remove_file(path);
                }
                finding("address", FindingState::Ok, format!("{shown} is free"))
            }
            Err(failure) => finding("address", FindingState::Fault, failure.message),
        }
    };
    Ok(std::iter::once(own).chain(probes).map(taken).collect())
}

/// The file of the store, its folder and its disk.
fn store(db: &Path, most_bytes: u64) -> Vec<Finding> {
    let folder = db.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    // The server creates the folders of its default path.
    let there: PathBuf = folder.ancestors().find(|folder| folder.is_dir()).unwrap_or(folder).into();
    let shown = there.display();
    let mut findings = vec![match machine::try_folder(&there) {
        Err((step, error)) => finding("store", FindingState::Fault, format!("{shown}: {step}: {error}")),
        Ok(()) => match machine::network_file_system(&there) {
            Some(kind) => {
                let detail =
                    format!("{shown} is on {kind}: the log of the store needs a disk of this machine");
                finding("store", FindingState::Fault, detail)
            }
            None => finding("store", FindingState::Ok, format!("{shown} takes files, locks and syncs")),
        },
    }];
    if db.exists() {
        findings.push(match store::count(db) {
            Ok(scenes) => {
                finding("store", FindingState::Ok, format!("{}: {scenes} scenes, sound", db.display()))
            }
            Err(StoreError::Empty) => {
                finding("store", FindingState::Ok, format!("{} is empty", db.display()))
            }
            Err(error) => finding("store", FindingState::Fault, format!("{}: {error}", db.display())),
        });
        let writable = std::fs::File::options().append(true).open(db);
        findings.extend(
            writable
                .err()
                .map(|error| finding("store", FindingState::Fault, format!("{}: {error}", db.display()))),
        );
    }
    let used = db.metadata().map_or(0, |found| found.len());
    findings.extend(machine::free_bytes(&there).map(|free| {
        let grows = most_bytes.saturating_sub(used);
        let verdict = match free {
            free if free < LEAST_DISK_BYTES => FindingState::Fault,
            free if free < grows => FindingState::Warning,
            _ => FindingState::Ok,
        };
        let detail = format!(
            "{} free; the store may grow by {} (limit store_bytes)",
            megabytes(free),
            megabytes(grows)
        );
        finding("disk", verdict, detail)
    }));
    findings
}

/// The folder of scenario files.
fn data(folder: &Path) -> Finding {
    match std::fs::read_dir(folder) {
        Ok(_) => finding("data", FindingState::Ok, format!("{} is readable", folder.display())),
        Err(error) => finding("data", FindingState::Fault, format!("{}: {error}", folder.display())),
    }
}

fn connections(wanted: u64) -> Finding {
    let have = descriptors::connections(wanted);
    let verdict = if have < wanted { FindingState::Warning } else { FindingState::Ok };
    let remedy = if have < wanted { "; raise ulimit -n, or LimitNOFILE of the unit" } else { "" };
    finding("descriptors", verdict, format!("enough for {have} of {wanted} connections{remedy}"))
}

fn memory(budget: u64) -> Finding {
    let Some((most, by)) = machine::memory() else {
        return finding(
            "memory",
            FindingState::Ok,
            format!("{} are used at most (--memory)", megabytes(budget)),
        );
    };
    let verdict = if most < budget { FindingState::Warning } else { FindingState::Ok };
    let remedy =
        if most < budget { "; the system would end the server, so give less with --memory" } else { "" };
    let detail = format!(
        "{} by {by}; the server takes up to {} (--memory){remedy}",
        megabytes(most),
        megabytes(budget)
    );
    finding("memory", verdict, detail)
}

fn time() -> Finding {
    let now = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default();
    let verdict = if now < EARLIEST { FindingState::Fault } else { FindingState::Ok };
    let remedy = if now < EARLIEST { "; the clock is wrong, and times of scenes would be" } else { "" };
    finding("clock", verdict, format!("{}{remedy}", clock::now()))
}

fn megabytes(bytes: u64) -> String {
    format!("{} MB", bytes / 1_000_000)
}
