//! Signal programs of a network (`tlLogic`): the state of each link at a time, if it depends only on the
//! clock.

use super::signals::state_of;
use scene::SignalState;

/// One signal program.
#[derive(Clone, Debug, PartialEq)]
pub struct SignalProgram {
    /// SUMO's id of the signal.
    pub id: String,
    /// `static`, `actuated` and others: only a static program depends on the time alone.
    pub kind: String,
    /// Start of the first phase, seconds.
    pub offset_s: f64,
    /// Phases in order: duration in seconds, and one letter per link.
    pub phases: Vec<(f64, Vec<u8>)>,
    /// Whether a phase names its successor (`next`), so that the phases do not follow in order.
    pub jumps: bool,
}

impl SignalProgram {
    /// Whether the state depends only on the time, with phases in order.
    pub fn is_simple(&self) -> bool {
        self.kind == "static" && !self.jumps
    }

    /// State of a link at a time in seconds; `None` for a link or a program without phases.
    pub fn at(&self, link: usize, time_s: f64) -> Option<SignalState> {
        let cycle_s: f64 = self.phases.iter().map(|(duration_s, _)| duration_s).sum();
        // Slightly later, so that a change at exactly this time is included.
        let mut left_s =
            if cycle_s > 0.0 { (time_s + 1e-6 - self.offset_s).rem_euclid(cycle_s) } else { 0.0 };
        let last = self.phases.last()?;
        let mut phase = last;
        for candidate in &self.phases {
            if left_s < candidate.0 {
                phase = candidate;
                break;
            }
            left_s -= candidate.0;
        }
        phase.1.get(link).map(|letter| state_of(*letter))
    }

    /// Run-length encoded states of a link over `steps` steps of `step_s` from `start_s`, in the form of a
    /// scene. A program that is not simple keeps its state at `start_s`.
    pub fn runs(&self, link: usize, start_s: f64, step_s: f64, steps: usize) -> Vec<(usize, SignalState)> {
        let mut runs: Vec<(usize, SignalState)> = Vec::new();
        for step in 0..if self.is_simple() { steps } else { 1 } {
            let state = self.at(link, start_s + step as f64 * step_s).unwrap_or_default();
            if runs.last().is_none_or(|(_, last)| *last != state) {
                runs.push((step, state));
            }
        }
        runs
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn program() -> SignalProgram {
        let phases = vec![(5.0, b"Gr".to_vec()), (2.0, b"yr".to_vec()), (3.0, b"rG".to_vec())];
        SignalProgram { id: "c".into(), kind: "static".into(), offset_s: 1.0, phases, jumps: false }
    }

    #[test]
    fn phases_follow_the_clock() {
        use SignalState::{Caution, Go, Stop};
        let program = program();
        let shown: Vec<_> = [0.0, 1.0, 5.9, 6.0, 8.0, 11.0].map(|t| program.at(0, t).unwrap()).into();
        assert_eq!(shown, [Stop, Go, Go, Caution, Stop, Go]);
        assert_eq!(program.runs(0, 5.5, 0.1, 91), [(0, Go), (5, Caution), (25, Stop), (55, Go)]);
        assert_eq!(program.at(9, 0.0), None);
    }

    #[test]
    fn what_reacts_to_traffic_is_not_foretold() {
        let actuated = SignalProgram { kind: "actuated".into(), ..program() };
        assert_eq!(actuated.runs(0, 1.0, 0.1, 91), [(0, SignalState::Go)]);
        let empty = SignalProgram { phases: Vec::new(), ..program() };
        assert_eq!(empty.at(0, 3.0), None);
    }
}
