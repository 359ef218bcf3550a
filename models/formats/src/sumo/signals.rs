//! Reader of recorded signal states (`SaveTLSStates` output).

use super::SumoError;
use crate::refusals::wanted;
use crate::xml::{Scanner, XmlEvent};
use scene::SignalState;
use std::collections::HashMap;

/// Most bytes of one row, which has a letter for each link of a signal.
const MAX_TAG: usize = 64 << 10;

/// States of all signal programs over time.
#[derive(Clone, Debug, Default)]
pub struct SignalLog {
    programs: HashMap<String, Vec<(f64, Vec<u8>)>>,
}

impl SignalLog {
    /// Reads a log.
    ///
    /// # Errors
    /// When the text is not XML or a time is not a number.
    pub fn read(text: &str) -> Result<Self, SumoError> {
        let mut scanner = Scanner::new(text.as_bytes(), MAX_TAG);
        let mut log = Self::default();
        while let Some(event) = scanner.next()? {
            let XmlEvent::Start(row) = event else { continue };
            let (true, Some(id), Some(time), Some(state)) =
                (row.name == "tlsState", row.get("id"), row.get("time"), row.get("state"))
            else {
                continue;
            };
            let time_s: f64 = time.parse().map_err(|_| SumoError::value(time, wanted::TIME, row.line))?;
            let rows = log.programs.entry(id.to_owned()).or_default();
            if rows.last().is_none_or(|(_, last)| last != state.as_bytes()) {
                rows.push((time_s, state.as_bytes().to_vec()));
            }
        }
        Ok(log)
    }

    /// State of a link at a time; `None` before the first row or for an unknown program.
    pub fn at(&self, program: &str, link: usize, time_s: f64) -> Option<SignalState> {
        let rows = self.programs.get(program)?;
        let row = rows.partition_point(|(t, _)| *t <= time_s + 1e-6).checked_sub(1)?;
        rows[row].1.get(link).map(|c| state_of(*c))
    }

    /// Run-length encoded states of a link over `steps` steps of `step_s` from `start_s`, in the form of a
    /// scene.
    pub fn runs(
        &self,
        program: &str,
        link: usize,
        start_s: f64,
        step_s: f64,
        steps: usize,
    ) -> Vec<(usize, SignalState)> {
        let mut runs: Vec<(usize, SignalState)> = Vec::new();
        for step in 0..steps {
            let state = self.at(program, link, start_s + step as f64 * step_s).unwrap_or_default();
            if runs.last().is_none_or(|(_, last)| *last != state) {
                runs.push((step, state));
            }
        }
        runs
    }
}

/// SUMO's link state letter as a signal state.
pub(super) fn state_of(letter: u8) -> SignalState {
    match letter {
        b'G' | b'g' => SignalState::Go,
        b'y' | b'Y' | b'u' => SignalState::Caution,
        b'r' | b'R' | b's' => SignalState::Stop,
        b'o' => SignalState::FlashingCaution,
        _ => SignalState::Unknown,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_follow_the_rows() {
        let text = r#"<tlsStates><tlsState time="0.0" id="c" programID="0" phase="0" state="Gr"/>
            <tlsState time="0.1" id="c" programID="0" phase="0" state="Gr"/>
            <tlsState time="0.3" id="c" programID="0" phase="1" state="yr"/>
            <tlsState time="0.5" id="c" programID="0" phase="2" state="rG"/></tlsStates>"#;
        let log = SignalLog::read(text).unwrap();
        let runs = log.runs("c", 0, 0.1, 0.1, 6);
        assert_eq!(runs, [(0, SignalState::Go), (2, SignalState::Caution), (4, SignalState::Stop)]);
        assert_eq!(log.at("c", 1, 0.5), Some(SignalState::Go));
        assert_eq!(log.at("c", 9, 0.5), None);
        assert_eq!(log.at("d", 0, 0.5), None);
    }
}
