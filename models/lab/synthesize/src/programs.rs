//! SUMO's programs as child processes.

use super::network::Character;
use super::{DT_S, RECORDED_S, WARM_UP_S};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Why a program of SUMO failed.
#[derive(Debug, thiserror::Error)]
pub enum ProgramError {
    /// Not installed, or not found.
    #[error(
        "{program} not found. Install SUMO (`pip install eclipse-sumo==1.28.0`) and set SUMO_HOME to its \
         folder, put its programs on PATH, or name the folder by option"
    )]
    Missing {
        /// Name of the program.
        program: &'static str,
    },
    /// It could not be started or monitored.
    #[error("cannot run {program}")]
    Io {
        /// Name of the program.
        program: &'static str,
        /// Error of the system.
        source: std::io::Error,
    },
    /// It exceeded its time limit and was ended.
    #[error("{program} did not finish within {limit_s} s")]
    Timeout {
        /// Name of the program.
        program: &'static str,
        /// The limit.
        limit_s: u64,
    },
    /// It failed.
    #[error("{program} failed: {message}")]
    Failed {
        /// Name of the program.
        program: &'static str,
        /// The end of its output.
        message: String,
    },
}

/// Location of SUMO.
#[derive(Clone, Debug)]
pub struct Sumo {
    home: Option<PathBuf>,
    netconvert: PathBuf,
    sumo: PathBuf,
}

impl Sumo {
    /// Finds the programs: in the given folder, else in `SUMO_HOME`, else on `PATH`.
    ///
    /// # Errors
    /// [`ProgramError::Missing`] with what to install.
    pub fn find(home: Option<&Path>) -> Result<Self, ProgramError> {
        let home = home.map(Path::to_owned).or_else(|| std::env::var_os("SUMO_HOME").map(PathBuf::from));
        let path = std::env::var_os("PATH").unwrap_or_default();
        let find = |program: &'static str| {
            let folders =
                home.iter().flat_map(|h| [h.join("bin"), h.clone()]).chain(std::env::split_paths(&path));
            let file = format!("{program}{}", std::env::consts::EXE_SUFFIX);
            folders.map(|f| f.join(&file)).find(|f| f.is_file()).ok_or(ProgramError::Missing { program })
        };
        let (netconvert, sumo) = (find("netconvert")?, find("sumo")?);
        Ok(Self { home, netconvert, sumo })
    }

    /// Converts `n.*.xml` of a folder to `net.xml`.
    ///
    /// # Errors
    /// When the program fails or takes too long.
    pub fn build_network(&self, folder: &Path, character: &Character) -> Result<(), ProgramError> {
        let (cycle, crosswalk) = (character.cycle_s.to_string(), format!("{:.1}", character.crosswalk));
        let options = [
            ("-n", "n.nod.xml"),
            ("-e", "n.edg.xml"),
            ("-x", "n.con.xml"),
            ("-o", "net.xml"),
            ("--no-turnarounds", "true"),
            // Smooth connectors; the default of 5 points gives corners of about 18 degrees.
            ("--junctions.internal-link-detail", "20"),
            ("--junctions.corner-detail", "8"),
            ("--crossings.guess", "true"),
            ("--crossings.guess.speed-threshold", "18"),
            ("--walkingareas", "true"),
            ("--default.crossing-width", &crosswalk),
            // Limits the mean lateral acceleration of a connector; factors of the drivers are applied to it.
            ("--junctions.limit-turn-speed", "2.0"),
            ("--tls.default-type", if character.actuated { "actuated" } else { "static" }),
            ("--tls.cycle.time", &cycle),
            ("--tls.left-green.time", "6"),
            ("--tls.layout", if character.opposites { "opposites" } else { "incoming" }),
            ("--offset.disable-normalization", "true"),
            ("--geometry.remove", "false"),
            ("--no-warnings", "true"),
        ];
        self.run("netconvert", &self.netconvert, folder, &options, Duration::from_secs(60))
    }

    /// Simulates `net.xml` with `r.rou.xml` and `a.add.xml` of a folder into `fcd.csv` and `tls.xml`.
    ///
    /// # Errors
    /// When the program fails or takes too long (a jammed network takes several times the median).
    pub fn simulate(&self, folder: &Path, seed: u64) -> Result<(), ProgramError> {
        let (seed, end) = ((seed & 0x7fff_ffff).to_string(), (WARM_UP_S + RECORDED_S).to_string());
        let (begin, step) = (WARM_UP_S.to_string(), DT_S.to_string());
        let options = [
            ("-n", "net.xml"),
            ("-r", "r.rou.xml"),
            ("-a", "a.add.xml"),
            ("--seed", &seed),
            ("--step-length", &step),
            ("--end", &end),
            ("--step-method.ballistic", "true"),
            ("--default.action-step-length", "0.4"),
            ("--lateral-resolution", "0.6"),
            ("--time-to-impatience", "60"),
            // No vehicle disappears, neither by teleport nor after a collision.
            ("--time-to-teleport", "-1"),
            ("--collision.action", "warn"),
            ("--collision.check-junctions", "true"),
            ("--max-depart-delay", "30"),
            ("--ignore-route-errors", "true"),
            ("--device.rerouting.probability", "0"),
            ("--pedestrian.striping.stripe-width", "0.45"),
            ("--pedestrian.striping.dawdling", "0.2"),
            ("--pedestrian.striping.walkingarea-detail", "12"),
            ("--fcd-output", "fcd.csv"),
            ("--fcd-output.attributes", "id,x,y,angle,speed,type"),
            ("--device.fcd.begin", &begin),
            ("--precision", "3"),
            ("--no-warnings", "true"),
            ("--no-step-log", "true"),
            ("--duration-log.disable", "true"),
        ];
        self.run("sumo", &self.sumo, folder, &options, Duration::from_secs(180))
    }

    fn run(
        &self,
        program: &'static str,
        file: &Path,
        folder: &Path,
        options: &[(&str, &str)],
        limit: Duration,
    ) -> Result<(), ProgramError> {
        let io = |source| ProgramError::Io { program, source };
        let log = folder.join("log.txt");
        let output = std::fs::File::create(&log).map_err(io)?;
        let mut command = Command::new(file);
        command
            .args(options.iter().flat_map(|(name, value)| [OsStr::new(name), OsStr::new(value)]))
            .current_dir(folder)
            .stdin(Stdio::null())
            .stdout(output.try_clone().map_err(io)?)
            .stderr(output);
        if let Some(home) = &self.home {
            command.env("SUMO_HOME", home);
        }
        let mut child = command.spawn().map_err(io)?;
        let start = Instant::now();
        let status = loop {
            if let Some(status) = child.try_wait().map_err(io)? {
                break status;
            }
            if start.elapsed() > limit {
                // Both calls fail only if the child has just ended.
                let _ = child.kill();
                let _ = child.wait();
                return Err(ProgramError::Timeout { program, limit_s: limit.as_secs() });
            }
            std::thread::sleep(Duration::from_millis(15));
        };
        if status.success() {
            return Ok(());
        }
        let text = String::from_utf8_lossy(&std::fs::read(&log).unwrap_or_default()).into_owned();
        let skip = text.chars().count().saturating_sub(500);
        Err(ProgramError::Failed { program, message: text.chars().skip(skip).collect() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn missing_program_says_what_to_install() {
        let error = ProgramError::Missing { program: "sumo" };
        assert!(error.to_string().contains("pip install eclipse-sumo==1.28.0"));
    }

    #[cfg(unix)]
    #[test]
    fn failures_and_timeouts_are_told_apart() {
        let folder = tempfile::tempdir().unwrap();
        let sumo = Sumo { home: None, netconvert: "sh".into(), sumo: "sh".into() };
        let run = |script: &str, limit_ms| {
            let limit = Duration::from_millis(limit_ms);
            sumo.run("sumo", Path::new("/bin/sh"), folder.path(), &[("-c", script)], limit)
        };
        assert!(run("exit 0", 5000).is_ok());
        let failed = run("echo broken >&2; exit 3", 5000).unwrap_err();
        assert_eq!(failed.to_string(), "sumo failed: broken\n");
        assert!(matches!(run("sleep 30", 50), Err(ProgramError::Timeout { .. })));
    }
}
