//! Trials for as long as one likes: `cargo xtask soak`.

#![allow(clippy::print_stdout, reason = "it talks to people")]

use clap::Parser;

/// Trials of the real program without an end of their own.
#[derive(Parser)]
#[command(name = "cargo xtask soak")]
struct Cli {
    /// Trial.
    #[arg(value_enum)]
    name: Name,
    /// Working time of clients, minutes.
    #[arg(long, default_value_t = 60.0, conflicts_with = "count")]
    minutes: f64,
    /// Number of kills, failing calls, power cuts or schedules; the defaults are 1000, 2000, 1000 and 200.
    #[arg(long)]
    count: Option<u64>,
    /// Seed of all draws.
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

#[derive(Clone, Copy, clap::ValueEnum)]
enum Name {
    /// Clients of all sorts beside those that took a server down once, under `ulimit -v`; memory stays flat.
    Attacks,
    /// Clients of all sorts at the same time; memory stays flat.
    Clients,
    /// Kills while six writers work, every other one on a failing disk; nothing answered is lost.
    Kills,
    /// Failing calls to the disk; the server loses no answered write, reports the fault, stays up and
    /// recovers.
    Faults,
    /// Clients who wait after a refusal as long as it says reach the goodput of those who ask again at once.
    Goodput,
    /// Fifty users with tokens, who drag, edit and save, read, and run scripts; no save is lost, memory stays flat.
    Live,
    /// Power cuts while six writers work; nothing answered is lost, whatever the disk has of what was not synced.
    Power,
    /// All of it in an order drawn by the seed, which can be done again.
    Schedule,
}

#[cfg(target_os = "linux")]
fn main() -> anyhow::Result<()> {
    use dragtraffic_tests::soak::{attacks, clients, faults, goodput, kills, live, power, schedule};
    use std::time::Duration;

    let Cli { name, minutes, count, seed } = Cli::parse();
    let tell = |line: &str| println!("{line}");
    match name {
        Name::Attacks => {
            let report = attacks::attacks(Duration::from_secs_f64(60.0 * minutes), seed, &tell)?;
            println!("{report}");
            report.flat()?;
        }
        Name::Clients => {
            let report = clients::clients(Duration::from_secs_f64(60.0 * minutes), seed, &tell)?;
            println!("{report}");
            report.flat()?;
        }
        Name::Kills => println!("{:?}", kills::kills(count.unwrap_or(1_000), seed, &tell)?),
        Name::Faults => println!("{:?}", faults::faults(count.unwrap_or(2_000), seed, &tell)?),
        Name::Live => {
            let report = live::live(Duration::from_secs_f64(60.0 * minutes), seed, &tell)?;
            println!("{report}");
            report.flat()?;
        }
        Name::Goodput => {
            let report = goodput::goodput(Duration::from_secs_f64(60.0 * minutes), &tell)?;
            println!("{report}");
            report.fair()?;
        }
        Name::Power => println!("{:?}", power::power(count.unwrap_or(1_000), seed, false, &tell)?),
        Name::Schedule => {
            let count = count.unwrap_or(200);
            if count == 1 {
                schedule::steps(seed).iter().for_each(|step| println!("{step:?}"));
            }
            println!("{} steps", schedule::schedules(count, seed, &tell)?);
        }
    }
    println!("passed");
    Ok(())
}

#[cfg(not(target_os = "linux"))]
fn main() {
    let Cli { .. } = Cli::parse();
    println!("skipped: faults of the disk and readings of memory need Linux");
}
