//! `fuzz [TARGET…] [--seconds N] [--seed S]`, `fuzz READER --file PATH`: tests readers and requests with
//! unexpected inputs. `cargo xtask fuzz` builds and runs it.
//!
//! Each target runs in its own process with bounded memory, so that a crash is a finding like any other.
//! Inputs come from `fuzz/corpus/TARGET`; seed and number identify each, and failing ones are written to
//! `target/fuzz`. `cargo fuzz` (see `fuzz/`) searches deeper, with a nightly compiler.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "it talks to people")]

use anyhow::{Context, bail, ensure};
use dragtraffic_tests::mutation::Corpus;
use dragtraffic_tests::program::{peak_memory_mb, program, root};
use dragtraffic_tests::requests::{self, Caller};
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{Seek, SeekFrom, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// An input that takes longer than this counts as a hang, on a busy machine too.
const HANGS: Duration = Duration::from_secs(60);
/// Inputs that take more core time are reported.
const SLOW: Duration = Duration::from_secs(1);
/// Address space of a reader under test, KB.
const MEMORY_KB: u64 = 4 << 20;
/// Findings after which a target is stopped.
const ENOUGH: usize = 10;

struct Options {
    names: Vec<String>,
    seconds: u64,
    seed: u64,
    /// This is the process of one target.
    inside: bool,
    /// The single input to run instead of drawn ones.
    file: Option<PathBuf>,
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match run(&arguments) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("{error:#}");
            ExitCode::from(2)
        }
    }
}

/// Runs the targets in turn; returns whether nothing was found.
fn run(arguments: &[String]) -> anyhow::Result<bool> {
    let options = options(arguments)?;
    std::fs::create_dir_all(folder())?;
    match (&options.file, &options.names[..]) {
        (Some(file), [name]) => return one(name, file),
        (None, [name]) if options.inside => return inside(name, &options),
        (Some(_), _) => bail!("--file takes one target"),
        _ => {}
    }
    let mut failed = Vec::new();
    for name in &options.names {
        if let Some(why) = outside(name, &options)? {
            println!("{why}");
            failed.push(name.as_str());
        }
    }
    if !failed.is_empty() {
        println!("findings in {}: see {}", failed.join(", "), folder().display());
    }
    Ok(failed.is_empty())
}

fn options(arguments: &[String]) -> anyhow::Result<Options> {
    let mut options = Options { names: Vec::new(), seconds: 60, seed: 1, inside: false, file: None };
    let readers = formats::checks::TARGETS.iter().map(|(name, _)| *name);
    let all: Vec<&str> = readers.chain(requests::TARGETS.iter().map(|target| target.name)).collect();
    let mut arguments = arguments.iter();
    while let Some(argument) = arguments.next() {
        let mut number = || -> anyhow::Result<u64> {
            arguments
                .next()
                .and_then(|text| text.parse().ok())
                .with_context(|| format!("{argument} takes a number"))
        };
        match argument.as_str() {
            "--seconds" => options.seconds = number()?,
            "--seed" => options.seed = number()?,
            "--inside" => options.inside = true,
            "--file" => options.file = Some(arguments.next().context("--file takes a path")?.into()),
            name if all.contains(&name) => options.names.push(name.to_owned()),
            other => bail!("no target is named {other}; targets: {}", all.join(", ")),
        }
    }
    if options.names.is_empty() {
        options.names = all.into_iter().map(str::to_owned).collect();
    }
    Ok(options)
}

fn folder() -> PathBuf {
    root().join("target/fuzz")
}

/// File in which a target's process records its current input.
fn place(name: &str) -> PathBuf {
    folder().join(format!("{name}.at"))
}

fn corpus(name: &str) -> anyhow::Result<Corpus> {
    Corpus::read(&root().join("fuzz/corpus").join(name))
}

/// Saves an input that caused a failure.
fn keep(name: &str, seed: u64, n: u64) -> anyhow::Result<String> {
    let path = folder().join(format!("{name}-{seed}-{n}"));
    std::fs::write(&path, corpus(name)?.input(seed, n))?;
    Ok(path.display().to_string())
}

/// Runs a target in its own process; returns the current input if the process died.
fn outside(name: &str, options: &Options) -> anyhow::Result<Option<String>> {
    let program = std::env::current_exe()?;
    let is_request = requests::TARGETS.iter().any(|target| target.name == name);
    let mut command = if cfg!(unix) && !is_request {
        let mut shell = Command::new("sh");
        shell.args(["-c", &format!("ulimit -v {MEMORY_KB} && exec \"$0\" \"$@\"")]).arg(program);
        shell
    } else {
        Command::new(program)
    };
    let (seconds, seed) = (options.seconds.to_string(), options.seed.to_string());
    command.args(["--inside", name, "--seconds", &seconds, "--seed", &seed]);
    let status = command.current_dir(root()).status()?;
    if status.success() {
        return Ok(None);
    }
    if status.code() == Some(1) {
        return Ok(Some(format!("{name}: findings")));
    }
    let n = std::fs::read(place(name))?.try_into().map(u64::from_le_bytes);
    let n = n.ok().context("no place is told")?;
    Ok(Some(format!(
        "{name}: {status} at input {n} of seed {}: {}",
        options.seed,
        keep(name, options.seed, n)?
    )))
}

/// Counts of a target.
#[derive(Default)]
struct Tally {
    executions: u64,
    slowest: Duration,
    findings: Vec<String>,
    /// Replies by status, or inputs that were read.
    outcomes: BTreeMap<String, u64>,
}

impl Tally {
    fn add(&mut self, took: Duration, outcome: Result<String, String>, told: impl FnOnce() -> String) {
        self.executions += 1;
        self.slowest = self.slowest.max(took);
        let outcome = match outcome {
            Ok(_) if took > SLOW => Err(format!("took {:.1} s", took.as_secs_f64())),
            other => other,
        };
        match outcome {
            Ok(word) => *self.outcomes.entry(word).or_default() += 1,
            Err(why) => {
                let finding = format!("{}: {why}", told());
                println!("{finding}");
                self.findings.push(finding);
            }
        }
    }
}

/// Runs one target in this process until its time is over.
fn inside(name: &str, options: &Options) -> anyhow::Result<bool> {
    let began = Instant::now();
    watch(began);
    let reader = formats::checks::TARGETS.iter().find(|(reader, _)| *reader == name);
    let target = requests::TARGETS.iter().find(|target| target.name == name);
    let (tally, memory_mb) = match (reader, target) {
        (Some((_, check)), _) => {
            let read = |bytes: &[u8]| Ok(if check(bytes) { "read" } else { "refused" }.to_owned());
            (drive(name, options, began, read)?, peak_memory_mb("self"))
        }
        (None, Some(target)) => {
            let server = requests::server(program())?;
            let mut caller = Caller::new(target, &server)?;
            let call = |bytes: &[u8]| {
                caller.call(bytes).map(|status| status.to_string()).map_err(|e| format!("{e:#}"))
            };
            let tally = drive(name, options, began, call)?;
            ensure!(server.get("/healthz")?.status == 200, "the server is gone");
            (tally, peak_memory_mb(&server.pid().to_string()))
        }
        (None, None) => bail!("no target is named {name}"),
    };
    let seconds = began.elapsed().as_secs_f64();
    let outcomes: Vec<String> =
        tally.outcomes.iter().map(|(word, count)| format!("{word} {count}")).collect();
    println!(
        "{name:<18} {:>9} executions in {seconds:.0} s ({:.0}/s), slowest {:.0} ms, peak memory {} MB; {}; {} findings",
        tally.executions,
        tally.executions as f64 / seconds,
        tally.slowest.as_secs_f64() * 1e3,
        memory_mb.map_or("?".to_owned(), |mb| mb.to_string()),
        outcomes.join(", "),
        tally.findings.len(),
    );
    Ok(tally.findings.is_empty())
}

/// Runs one reader on one file.
fn one(name: &str, file: &Path) -> anyhow::Result<bool> {
    let reader = formats::checks::TARGETS.iter().find(|(reader, _)| *reader == name);
    let (_, check) = reader.with_context(|| format!("{name} is no reader"))?;
    let bytes = std::fs::read(file).with_context(|| file.display().to_string())?;
    let start = worked();
    let word = if check(&bytes) { "read" } else { "refused" };
    println!("{word}, {:.3} s", worked().saturating_sub(start).as_secs_f64());
    Ok(true)
}

/// When the current input was begun, milliseconds from the start; 0 for none.
static BEGUN_MS: AtomicU64 = AtomicU64::new(0);

/// Ends the process when an input hangs; the recorded place identifies the input.
fn watch(began: Instant) {
    std::thread::spawn(move || {
        loop {
            std::thread::sleep(Duration::from_millis(500));
            let since = BEGUN_MS.load(Ordering::Relaxed);
            if since > 0 && began.elapsed().as_millis() as u64 > since + HANGS.as_millis() as u64 {
                eprintln!("an input takes more than {} s", HANGS.as_secs());
                std::process::exit(3);
            }
        }
    });
}

fn drive(
    name: &str,
    options: &Options,
    began: Instant,
    mut run: impl FnMut(&[u8]) -> Result<String, String>,
) -> anyhow::Result<Tally> {
    let corpus = corpus(name)?;
    let mut at = File::create(place(name))?;
    let mut tally = Tally::default();
    for n in 0.. {
        if began.elapsed().as_secs() >= options.seconds || tally.findings.len() >= ENOUGH {
            break;
        }
        at.seek(SeekFrom::Start(0))?;
        at.write_all(&u64::to_le_bytes(n))?;
        let input = corpus.input(options.seed, n);
        BEGUN_MS.store(began.elapsed().as_millis() as u64 + 1, Ordering::Relaxed);
        let start = worked();
        let outcome = catch_unwind(AssertUnwindSafe(|| run(&input)));
        let took = worked().saturating_sub(start);
        BEGUN_MS.store(0, Ordering::Relaxed);
        let outcome = outcome.unwrap_or_else(|_| Err("a panic".to_owned()));
        tally.add(took, outcome, || keep(name, options.seed, n).unwrap_or_else(|error| format!("{error:#}")));
    }
    Ok(tally)
}

/// Core time of this thread, if the system reports it, so that other load does not count. Requests run on
/// other threads, and the server has its own limits for them.
fn worked() -> Duration {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    Duration::from_nanos(text.split(' ').next().and_then(|ns| ns.parse().ok()).unwrap_or(0))
}
