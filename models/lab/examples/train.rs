//! Trains an expert from files of records:
//!
//! `train --stage initializer --out vehicle.safetensors [--option value ..] a.records b.records`

use std::path::PathBuf;
use std::process::ExitCode;

use lab::train::{Options, Stage, run};

#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

const USAGE: &str = "options: --stage denoiser|initializer|joint --out FILE [--expert NAME] [--init FILE] \
[--steps N] [--batch N] [--rate X] [--threads N] [--seed N] [--minutes X] [--validate-every N] [--resume] \
[--trained-on TEXT] [--licence TEXT] RECORDS..
Set MIMALLOC_PURGE_DELAY=-1 CANDLE_NUM_THREADS=1 RAYON_NUM_THREADS=1: training is twice as fast with them.";

fn main() -> ExitCode {
    let result = parse(std::env::args().skip(1)).and_then(|options| {
        run(&options, &mut |line| eprintln!("{line}")).map(|_| ()).map_err(|error| error.to_string())
    });
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn parse(mut words: impl Iterator<Item = String>) -> Result<Options, String> {
    let mut options = Options::new(Vec::new(), Stage::Initializer, PathBuf::new());
    while let Some(word) = words.next() {
        let Some(name) = word.strip_prefix("--") else {
            options.records.push(word.into());
            continue;
        };
        if name == "resume" {
            options.resume = true;
            continue;
        }
        let value = words.next().ok_or_else(|| format!("--{name} needs a value\n{USAGE}"))?;
        let bad = |_| format!("--{name} {value}: not a number");
        match name {
            "stage" => options.stage = stage(&value)?,
            "out" => options.out = value.into(),
            "init" => options.init = Some(value.into()),
            "expert" => options.expert = value,
            "licence" => options.licence = value,
            "trained-on" => options.trained_on = value,
            "steps" => options.steps = value.parse().map_err(bad)?,
            "batch" => options.batch = value.parse().map_err(bad)?,
            "threads" => options.threads = value.parse().map_err(bad)?,
            "seed" => options.seed = value.parse().map_err(bad)?,
            "validate-every" => options.validate_every = value.parse().map_err(bad)?,
            "rate" => options.rate = value.parse().map_err(|_| format!("--rate {value}: not a number"))?,
            "minutes" => {
                options.minutes =
                    Some(value.parse().map_err(|_| format!("--minutes {value}: not a number"))?);
            }
            _ => return Err(format!("--{name} is unknown\n{USAGE}")),
        }
    }
    if options.out.as_os_str().is_empty() || options.records.is_empty() {
        return Err(USAGE.into());
    }
    Ok(options)
}

fn stage(name: &str) -> Result<Stage, String> {
    match name {
        "denoiser" => Ok(Stage::Denoiser),
        "initializer" => Ok(Stage::Initializer),
        "joint" => Ok(Stage::Joint),
        _ => Err(format!("--stage {name}: denoiser, initializer or joint")),
    }
}
