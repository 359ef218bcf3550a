//! Synthetic traffic: procedural road networks and demand, driven by the traffic simulator SUMO (a
//! separate program), cleaned until it looks recorded, and cut into windows of 9 seconds.
//!
//! One seed decides everything about one network and its traffic; the same seed gives the same file.
//!
//! ```
//! use lab_synthesize::statistics::Statistics;
//! use scene::{Agent, AgentType, LaneMap, Scene, State, Subtype};
//!
//! let walking = |step: i32| State { x_m: 0.14 * f64::from(step), vx_mps: 1.4, ..State::default() };
//! let track = (0..91).map(|step| Some(walking(step))).collect();
//! let walker = Agent::bare("w", AgentType::Pedestrian, Subtype::Unknown, track);
//! let mut seen = Statistics::default();
//! seen.add(&Scene::bare("", LaneMap::default(), vec![walker]));
//! let speed = seen.summary("pedestrian_speed").unwrap();
//! assert!((speed.mean - 1.4).abs() < 1e-9);
//! ```

mod demand;
pub mod demo;
mod demo_check;
mod demo_clip;
mod demo_mend;
mod demo_networks;
mod filters;
mod fleet;
mod footpath;
mod network;
mod parked;
mod programs;
mod random;
mod recording;
mod scripted;
mod sight;
pub mod statistics;
mod streets;
mod tracks;
mod ways;
mod windows;

pub use programs::ProgramError;
pub use recording::RecordError;
pub use windows::{NOW, STEPS};

use formats::womd;
use network::Network;
use programs::Sumo;
use random::Purpose;
use scene::map::LaneType;
use scene::random::Stream;
use scene::{AgentType, STEP_S, Scene};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

/// Simulated seconds before recording begins.
const WARM_UP_S: f64 = 90.0;
/// Recorded seconds.
const RECORDED_S: f64 = 120.0;
/// Step of the simulation, seconds.
const DT_S: f64 = STEP_S;

/// Kind of network.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Template {
    /// One junction with its arms and side streets.
    Crossing,
    /// Street grid of a residential area or a town centre.
    Grid,
    /// Arterial with signals.
    Arterial,
    /// Car park beside a street.
    Lot,
    /// Roundabout.
    Roundabout,
    /// Motorway with ramps.
    Motorway,
    /// District of a town: crossing arterials among residential streets.
    Quarter,
}

impl Template {
    /// All templates, each with its share of the seeds when none is requested.
    pub const SHARES: [(Self, f64); 7] = [
        (Self::Crossing, 0.32),
        (Self::Grid, 0.20),
        (Self::Arterial, 0.22),
        (Self::Lot, 0.10),
        (Self::Roundabout, 0.07),
        (Self::Motorway, 0.03),
        (Self::Quarter, 0.06),
    ];

    fn build(self, draw: &mut Stream) -> Network {
        let mut network = match self {
            Self::Crossing => streets::crossing(draw),
            Self::Grid => streets::grid(draw),
            Self::Arterial => streets::arterial(draw),
            Self::Lot => streets::parking_lot(draw),
            Self::Roundabout => ways::roundabout(draw),
            Self::Motorway => ways::motorway(draw),
            Self::Quarter => streets::quarter(draw),
        };
        network.expand(draw);
        network
    }
}

/// Share of car parks without lanes in the map.
const UNMAPPED_LOTS: f64 = 0.4;

/// Options of a synthesis.
#[derive(Clone, Debug)]
pub struct SynthesizeOptions {
    /// Seeds; each gives one file.
    pub seeds: Range<u64>,
    /// Folder of the files; created if missing.
    pub out_dir: PathBuf,
    /// Seeds processed in parallel; 0 means one per core.
    pub threads: usize,
    /// Folder of SUMO, with `bin/` in it. Default: `SUMO_HOME`, else `PATH`.
    pub sumo_home: Option<PathBuf>,
    /// Windows cut from each seed's two minutes.
    pub per_seed: usize,
    /// Kind of all networks; drawn by [`Template::SHARES`] when free.
    pub template: Option<Template>,
}

impl Default for SynthesizeOptions {
    fn default() -> Self {
        Self {
            seeds: 0..1,
            out_dir: PathBuf::new(),
            threads: 0,
            sumo_home: None,
            per_seed: 40,
            template: None,
        }
    }
}

/// One finished seed.
#[derive(Clone, Debug)]
pub struct SeedProgress {
    /// Its seed.
    pub seed: u64,
    /// Windows in its file; `None` if the file existed already.
    pub windows: Option<usize>,
    /// Number of finished seeds, this one included, and number of all seeds.
    pub finished: (u64, u64),
}

/// Results of a run.
#[derive(Clone, Debug, Default)]
pub struct SynthesizeReport {
    /// Files written.
    pub written: u64,
    /// Files that existed already.
    pub skipped: u64,
    /// Windows in the files written.
    pub windows: u64,
    /// Vehicles, pedestrians and cyclists in those windows.
    pub agents: [u64; 3],
    /// Seeds without a file, each with the reason.
    pub failed: Vec<(u64, String)>,
}

/// Why a run could not start. Failures of single seeds are in the [`SynthesizeReport`].
#[derive(Debug, thiserror::Error)]
pub enum SynthesizeError {
    /// SUMO is missing.
    #[error(transparent)]
    Program(#[from] ProgramError),
    /// The folder cannot be created.
    #[error("cannot make the folder {path}")]
    Folder {
        /// The folder.
        path: PathBuf,
        /// Error of the system.
        source: std::io::Error,
    },
}

/// The windows of one seed.
fn make(sumo: &Sumo, seed: u64, template: Option<Template>, count: usize) -> Result<Vec<Scene>, RecordError> {
    let mut draw = Purpose::Network.stream(seed);
    let drawn = draw.weighted(Template::SHARES);
    let network = template.unwrap_or(drawn).build(&mut draw);
    let mut recording = recording::record(sumo, network, None, seed)?;
    if Purpose::Map.stream(seed).chance(UNMAPPED_LOTS) {
        recording.unmap_lots();
    }
    let (scenes, _) = windows::cut(&recording, seed, count, &mut Purpose::Windows.stream(seed));
    Ok(scenes)
}

/// Writes one file of windows per seed. A seed with an existing file is skipped, so that an interrupted run
/// continues where it stopped.
///
/// # Errors
/// When SUMO is missing or the folder cannot be created. A seed that fails does not stop the others.
pub fn run(
    options: &SynthesizeOptions,
    progress: &(dyn Fn(SeedProgress) + Sync),
) -> Result<SynthesizeReport, SynthesizeError> {
    let sumo = Sumo::find(options.sumo_home.as_deref())?;
    std::fs::create_dir_all(&options.out_dir)
        .map_err(|source| SynthesizeError::Folder { path: options.out_dir.clone(), source })?;
    let total = options.seeds.end.saturating_sub(options.seeds.start);
    let cores = std::thread::available_parallelism().map_or(1, |n| n.get());
    let threads = if options.threads == 0 { cores } else { options.threads };
    let (next, finished) = (AtomicU64::new(options.seeds.start), AtomicU64::new(0));
    let report = Mutex::new(SynthesizeReport::default());
    let work = || {
        loop {
            let seed = next.fetch_add(1, Ordering::Relaxed);
            if seed >= options.seeds.end {
                return;
            }
            let result = one(&sumo, options, seed);
            let mut report = report.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
            let windows = report.add(seed, result);
            let done = finished.fetch_add(1, Ordering::Relaxed) + 1;
            progress(SeedProgress { seed, windows, finished: (done, total) });
        }
    };
    std::thread::scope(|scope| {
        for number in 1..threads.min(total.max(1) as usize) {
            let thread = std::thread::Builder::new().name(format!("synthesize-{number}"));
            // If the system refuses another thread, the existing ones do the work.
            if thread.spawn_scoped(scope, work).is_err() {
                break;
            }
        }
        work();
    });
    let mut report = report.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    report.failed.sort();
    Ok(report)
}

/// Result of one seed.
enum SeedOutcome {
    Skipped,
    Written(Vec<Scene>),
}

fn one(sumo: &Sumo, options: &SynthesizeOptions, seed: u64) -> Result<SeedOutcome, String> {
    let path = options.out_dir.join(format!("{seed:06}.tfrecord.gz"));
    if path.exists() {
        return Ok(SeedOutcome::Skipped);
    }
    let scenes = make(sumo, seed, options.template, options.per_seed).map_err(|e| with_causes(&e))?;
    if scenes.is_empty() {
        return Err("no window could be cut".to_owned());
    }
    write(&path, &scenes).map_err(|e| e.to_string())?;
    Ok(SeedOutcome::Written(scenes))
}

/// An error with its causes.
fn with_causes(error: &dyn std::error::Error) -> String {
    let all = std::iter::successors(Some(error), |error| error.source());
    all.map(ToString::to_string).collect::<Vec<_>>().join(": ")
}

/// Writes windows to a temporary file and then renames it: a file with the final name is complete.
fn write(path: &Path, scenes: &[Scene]) -> std::io::Result<()> {
    let partial = path.with_extension(format!("tmp{}", std::process::id()));
    let plain: Vec<Scene> = scenes.iter().map(without_footways).collect();
    let file = std::io::BufWriter::new(std::fs::File::create(&partial)?);
    womd::write(&plain.iter().collect::<Vec<_>>(), file, true, formats::ExportedMotion::Log)?;
    std::fs::rename(&partial, path)
}

/// The scene without the types of lanes that the format lacks: they would become untyped lanes, on which
/// readers allow cars.
fn without_footways(scene: &Scene) -> Scene {
    let mut map = (*scene.map).clone();
    map.lanes.retain(|l| !matches!(l.lane_type, LaneType::Sidewalk | LaneType::Parking));
    Scene { map: map.into(), ..scene.clone() }
}

impl SynthesizeReport {
    fn add(&mut self, seed: u64, result: Result<SeedOutcome, String>) -> Option<usize> {
        match result {
            Ok(SeedOutcome::Skipped) => {
                self.skipped += 1;
                None
            }
            Ok(SeedOutcome::Written(scenes)) => {
                self.written += 1;
                self.windows += scenes.len() as u64;
                for agent in scenes.iter().flat_map(|s| &s.agents) {
                    match agent.agent_type {
                        AgentType::Vehicle => self.agents[0] += 1,
                        AgentType::Pedestrian => self.agents[1] += 1,
                        AgentType::Cyclist => self.agents[2] += 1,
                        AgentType::Other => {}
                    }
                }
                Some(scenes.len())
            }
            Err(reason) => {
                self.failed.push((seed, reason));
                Some(0)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Runs a small job, or reports why it cannot.
    fn made(name: &str, seed: u64) -> Option<(tempfile::TempDir, SynthesizeOptions, SynthesizeReport)> {
        let folder = tempfile::tempdir().unwrap();
        let options = SynthesizeOptions {
            seeds: seed..seed + 1,
            out_dir: folder.path().join(name),
            threads: 1,
            per_seed: 4,
            template: Some(Template::Crossing),
            ..SynthesizeOptions::default()
        };
        match run(&options, &|_| {}) {
            Ok(report) => Some((folder, options, report)),
            Err(SynthesizeError::Program(error)) => {
                println!("skipped: {error}");
                None
            }
            Err(error) => panic!("{error}"),
        }
    }

    #[test]
    fn a_seed_makes_one_file_and_the_same_one_again() {
        let Some((_a, options, report)) = made("a", 3) else { return };
        assert_eq!((report.written, report.skipped, report.failed.len()), (1, 0, 0), "{report:?}");
        let again = run(&options, &|p| assert_eq!(p.windows, None)).unwrap();
        assert_eq!((again.written, again.skipped), (0, 1));
        let Some((_b, other, _)) = made("b", 3) else { return };
        let read = |o: &SynthesizeOptions| std::fs::read(o.out_dir.join("000003.tfrecord.gz")).unwrap();
        assert_eq!(read(&options), read(&other));
    }

    #[test]
    fn windows_come_back_from_their_file_and_obey_physics() {
        let Some((_folder, options, report)) = made("c", 5) else { return };
        let bytes = std::fs::read(options.out_dir.join("000005.tfrecord.gz")).unwrap();
        let scenes = womd::read_all(&bytes, &womd::Options::default());
        assert_eq!(scenes.len() as u64, report.windows);
        for scene in scenes {
            let (scene, _) = scene.unwrap();
            assert_eq!((scene.time.steps, scene.time.now_step), (STEPS, NOW));
            assert!(scene.meta.source_id.as_deref().is_some_and(|id| id.starts_with("synth-5-")));
            assert_eq!(scene.meta.licence.as_deref(), Some("cc0"));
            let ids: std::collections::HashSet<_> = scene.map.lanes.iter().map(|l| &l.id).collect();
            let links = scene.map.lanes.iter().flat_map(|l| l.successors.iter().chain(&l.predecessors));
            assert!(links.into_iter().all(|id| ids.contains(id)));
            for agent in &scene.agents {
                check_motion(agent);
            }
        }
    }

    fn check_motion(agent: &scene::Agent) {
        for pair in agent.track.states.windows(2) {
            let [Some(a), Some(b)] = pair else { continue };
            let moved = (b.position() - a.position()).norm();
            assert!(moved <= a.speed_mps().max(b.speed_mps()) * STEP_S + 0.2, "{}: {moved}", agent.id);
            assert!((b.velocity() - a.velocity()).norm() / STEP_S < 12.0, "{}", agent.id);
        }
    }
}
