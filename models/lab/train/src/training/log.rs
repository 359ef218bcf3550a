//! Log of a run, as JSON lines and as curves.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::run::TrainProgress;
use super::{TrainError, checkpoint};

/// Width and height of a panel, and its margins, in pixels.
const PANEL: [f64; 2] = [560.0, 210.0];
const EDGE: [f64; 2] = [56.0, 34.0];

/// One line of the log.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct LogLine {
    step: u64,
    /// Whether these are means over held-out records; otherwise over the steps since the last line.
    held_out: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    rate: Option<f64>,
    means: BTreeMap<String, f64>,
}

/// The log of a run. Its paths are that of the weights with `.jsonl` and `.svg` appended.
pub(super) struct Log {
    out: PathBuf,
    lines: Vec<LogLine>,
}

impl Log {
    /// A new log, or the existing lines of a run that continues from `step`.
    pub(super) fn open(out: &Path, step: u64) -> Result<Self, TrainError> {
        let mut log = Self { out: out.to_path_buf(), lines: Vec::new() };
        let path = log.beside(".jsonl");
        if step == 0 || !path.exists() {
            return Ok(log);
        }
        let text = std::fs::read_to_string(&path).map_err(TrainError::io(&path))?;
        for (number, line) in text.lines().enumerate() {
            let line: LogLine = serde_json::from_str(line)
                .map_err(|e| TrainError::damaged(&path, format!("line {}: {e}", number + 1)))?;
            log.lines.push(line);
        }
        // Steps after the checkpoint are repeated.
        log.lines.retain(|line| line.step <= step);
        Ok(log)
    }

    fn beside(&self, suffix: &str) -> PathBuf {
        let mut path = self.out.as_os_str().to_owned();
        path.push(suffix);
        path.into()
    }

    /// Adds a line; after a validation both files are rewritten.
    pub(super) fn add(&mut self, progress: &TrainProgress) -> Result<(), TrainError> {
        let means = |metrics: &super::Metrics| metrics.means().map(|(n, v)| (n.to_owned(), v)).collect();
        let line = match progress {
            TrainProgress::Begin { .. } => return Ok(()),
            TrainProgress::Training { step, rate, metrics, .. } => {
                LogLine { step: *step, held_out: false, rate: Some(*rate), means: means(metrics) }
            }
            TrainProgress::Validation { step, metrics } => {
                LogLine { step: *step, held_out: true, rate: None, means: means(metrics) }
            }
        };
        let held_out = line.held_out;
        self.lines.push(line);
        if held_out { self.write() } else { Ok(()) }
    }

    /// Whether the loss on held-out records is the least so far; the distance if there is no loss.
    pub(super) fn is_best(&self, metrics: &super::Metrics) -> bool {
        let Some(name) = ["loss", "refined", "min"].into_iter().find(|name| metrics.mean(name).is_some())
        else {
            return true;
        };
        let held_out = self.lines.iter().filter(|line| line.held_out);
        let before = held_out.filter_map(|line| line.means.get(name)).copied().fold(f64::INFINITY, f64::min);
        metrics.mean(name).is_some_and(|now| now < before)
    }

    /// Rewrites both files with all lines so far.
    pub(super) fn write(&self) -> Result<(), TrainError> {
        let path = self.beside(".jsonl");
        let mut text = String::new();
        for line in &self.lines {
            let line = serde_json::to_string(line);
            text.push_str(&line.map_err(|e| TrainError::damaged(&path, e.to_string()))?);
            text.push('\n');
        }
        checkpoint::replace(&path, text.as_bytes())?;
        checkpoint::replace(&self.beside(".svg"), self.svg().as_bytes())
    }

    /// One panel per metric: a thin line for training, a thick one with dots for held-out records.
    fn svg(&self) -> String {
        let names: BTreeSet<&String> = self.lines.iter().flat_map(|line| line.means.keys()).collect();
        let (width, height) = (PANEL[0] + 2.0 * EDGE[0], PANEL[1] + 2.0 * EDGE[1]);
        let mut out = format!(
            r##"<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{}" font-family="sans-serif" font-size="12"><rect width="100%" height="100%" fill="#fff"/>"##,
            height * names.len().max(1) as f64
        );
        for (row, name) in names.iter().enumerate() {
            let _ =
                write!(out, r#"<g transform="translate({},{})">"#, EDGE[0], height * row as f64 + EDGE[1]);
            self.panel(name, &mut out);
            out.push_str("</g>");
        }
        out.push_str("</svg>\n");
        out
    }

    fn panel(&self, name: &str, out: &mut String) {
        let curve = |held_out: bool| -> Vec<(f64, f64)> {
            let lines = self.lines.iter().filter(|line| line.held_out == held_out);
            let value = |line: &LogLine| Some((line.step as f64, *line.means.get(name)?));
            lines.filter_map(value).filter(|(_, v)| v.is_finite()).collect()
        };
        let curves = [curve(false), curve(true)];
        let values = || curves.iter().flatten().map(|(_, v)| *v);
        let last = curves.iter().flatten().map(|(s, _)| *s).fold(1.0, f64::max);
        // The first lines of a run are far off and would flatten the curve.
        let mut sorted: Vec<f64> = values().collect();
        sorted.sort_by(f64::total_cmp);
        let (low, high) = match (sorted.first(), sorted.get(sorted.len() * 97 / 100)) {
            (Some(low), Some(high)) if high > low => (*low, *high),
            (Some(low), _) => (*low - 0.5, *low + 0.5),
            _ => (0.0, 1.0),
        };
        let x = |step: f64| PANEL[0] * step / last;
        let y = |value: f64| PANEL[1] * (1.0 - ((value - low) / (high - low)).clamp(0.0, 1.02));
        let _ = write!(
            out,
            r##"<text x="0" y="-10" font-weight="bold">{name}</text><path d="M0 0V{1}H{0}" fill="none" stroke="#888"/><text x="-6" y="10" text-anchor="end">{high:.3}</text><text x="-6" y="{1}" text-anchor="end">{low:.3}</text><text x="{0}" y="{2}" text-anchor="end">{last} steps</text>"##,
            PANEL[0],
            PANEL[1],
            PANEL[1] + 16.0
        );
        for (points, stroke, thick) in [(&curves[0], "#9db4d0", 1.2), (&curves[1], "#0b5cad", 2.2)] {
            let line: Vec<String> =
                points.iter().map(|(s, v)| format!("{:.1},{:.1}", x(*s), y(*v))).collect();
            let _ = write!(
                out,
                r#"<polyline points="{}" fill="none" stroke="{stroke}" stroke-width="{thick}"/>"#,
                line.join(" ")
            );
        }
        for (step, value) in &curves[1] {
            let _ =
                write!(out, r##"<circle cx="{:.1}" cy="{:.1}" r="3" fill="#0b5cad"/>"##, x(*step), y(*value));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Metrics;
    use super::*;

    fn training(step: u64, loss: f32) -> TrainProgress {
        let mut metrics = Metrics::new(1);
        metrics.add("loss", loss);
        TrainProgress::Training { step, rate: 1e-3, gradient: 1.0, metrics, speed: 1.0 }
    }

    fn validation(step: u64, loss: f32) -> TrainProgress {
        let mut metrics = Metrics::new(1);
        metrics.add("loss", loss);
        TrainProgress::Validation { step, metrics }
    }

    #[test]
    fn a_log_goes_on_where_its_checkpoint_was() {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("weights");
        let mut log = Log::open(&out, 0).unwrap();
        for step in 1..=4 {
            log.add(&training(100 * step, 4.0 - step as f32)).unwrap();
        }
        log.add(&validation(400, 1.5)).unwrap();
        let svg = std::fs::read_to_string(folder.path().join("weights.svg")).unwrap();
        assert!(svg.contains(">loss</text>") && svg.contains("400 steps"));
        let again = Log::open(&out, 200).unwrap();
        assert_eq!(again.lines, log.lines[..2]);
        assert!(Log::open(&out, 0).unwrap().lines.is_empty());
        std::fs::write(folder.path().join("weights.jsonl"), "{}").unwrap();
        assert!(matches!(Log::open(&out, 200), Err(e) if e.to_string().contains("line 1")));
    }
}
