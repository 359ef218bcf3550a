//! The rows of a scenario while it is read, bounded in memory.

use crate::limits::memory_for;
use crate::problem::{FieldProblem, ImportWarning, ReadError, code};
use crate::projection::TransverseMercator;
use crate::recording::{MAX_USERS, RecordedAgent, RecordedState, Recording};
use crate::refusals::{self, what};
use crate::sentences;
use std::collections::HashMap;

/// Most rows in memory, however large a file is.
const MAX_ROWS: u64 = 4_000_000;
/// Memory of a row while its list grows, and of its time while the median is computed, bytes.
const ROW_MEMORY: u64 = (2 * size_of::<RecordedState>() + size_of::<f64>()) as u64;
/// Memory of everything else, bytes.
const BESIDE_ROWS: u64 = 24 << 20;
/// Most possible motions of one scenario.
const MAX_FUTURES: usize = 100_000;

/// A scenario that is being read.
pub(super) struct Gathered {
    pub name: String,
    pub recording: Recording,
    users: HashMap<String, usize>,
    pub futures: HashMap<(usize, u64, u64), usize>,
    /// Rows in memory, and all rows that were read.
    held: usize,
    found: usize,
    /// Rows from this time on are left out, because there were too many.
    before_s: Option<f64>,
    /// Whether every time is that of its step, and the last step.
    pub aligned: bool,
    pub last_step: f64,
    pub unknown_words: usize,
    pub untyped: bool,
    /// Projection of degrees, once there are some.
    pub projection: Option<TransverseMercator>,
    /// Greatest coordinate in the frame of the table, metres.
    pub farthest_m: f64,
}

/// Most rows in memory for a file of this many bytes.
fn most_rows(encoded: u64) -> usize {
    ((memory_for(encoded) - BESIDE_ROWS) / ROW_MEMORY).min(MAX_ROWS) as usize
}

impl Gathered {
    pub fn new(name: String) -> Self {
        Self {
            name,
            recording: Recording::default(),
            users: HashMap::new(),
            futures: HashMap::new(),
            held: 0,
            found: 0,
            before_s: None,
            aligned: true,
            last_step: 0.0,
            unknown_words: 0,
            untyped: false,
            projection: None,
            farthest_m: 0.0,
        }
    }

    /// Counts a row of this time, and returns whether it is added.
    pub fn takes_time(&mut self, time_s: f64) -> bool {
        self.found += 1;
        let takes = self.before_s.is_none_or(|before_s| time_s < before_s);
        self.held += usize::from(takes);
        takes
    }

    /// Index of a road user in the recording.
    pub fn user(&self, id: &str) -> Option<usize> {
        self.users.get(id).copied()
    }

    /// Adds a road user, and returns its index.
    pub fn add_user(&mut self, user: RecordedAgent) -> usize {
        let at = self.recording.users.len();
        self.users.insert(user.id.clone(), at);
        self.recording.users.push(user);
        at
    }

    /// Drops the later half of the rows if there are more than are allowed for a file of this many bytes.
    ///
    /// # Errors
    /// `too-many-agents` when this is impossible.
    pub fn bound(&mut self, encoded: u64) -> Result<(), ReadError> {
        let most = most_rows(encoded);
        let counts = [
            (self.held, most, what::ROWS),
            (self.users.len(), MAX_USERS, what::ROAD_USERS),
            (self.futures.len(), MAX_FUTURES, what::FUTURES),
        ];
        match refusals::exceeded(&counts) {
            Some((most, what)) if !self.futures.is_empty() || !self.leave_out_half() => {
                let message = refusals::more_than(most, what);
                Err(FieldProblem::new("", code::TOO_MANY_AGENTS, message).into())
            }
            _ => Ok(()),
        }
    }

    /// Drops the later half of the rows; false if all have the same time.
    fn leave_out_half(&mut self) -> bool {
        let users = &mut self.recording.users;
        let mut times: Vec<f64> =
            users.iter().flat_map(|user| user.samples.iter().map(|sample| sample.time_s)).collect();
        let first_s = times.iter().copied().fold(f64::INFINITY, f64::min);
        let middle = times.len() / 2;
        if times.is_empty() {
            return false;
        }
        let (_, before_s, _) = times.select_nth_unstable_by(middle, f64::total_cmp);
        let before_s = *before_s;
        if before_s <= first_s {
            return false;
        }
        for user in users.iter_mut() {
            user.samples.retain(|sample| sample.time_s < before_s);
            user.samples.shrink_to_fit();
        }
        users.retain(|user| !user.samples.is_empty());
        self.users = users.iter().enumerate().map(|(at, user)| (user.id.clone(), at)).collect();
        self.held = users.iter().map(|user| user.samples.len()).sum();
        self.before_s = Some(before_s);
        true
    }

    /// The warning about dropped rows.
    pub fn left_out(&self) -> Option<ImportWarning> {
        let before_s = self.before_s?;
        let message = sentences::rows_in_part(self.held, self.found, before_s);
        Some(ImportWarning::new("rows-in-part", message))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::{AgentType, Subtype, Vec2};

    /// Adds a row of a road user.
    fn add(rows: &mut Gathered, id: usize, time_s: f64) -> Result<(), ReadError> {
        if !rows.takes_time(time_s) {
            return Ok(());
        }
        let id = id.to_string();
        let (agent_type, subtype) = (AgentType::Vehicle, Subtype::Car);
        let user = RecordedAgent {
            id: id.clone(),
            agent_type,
            subtype,
            role: None,
            size_m: [None; 3],
            samples: Vec::new(),
        };
        let at = rows.user(&id).unwrap_or_else(|| rows.add_user(user));
        let (at_m, velocity) = (Vec2::zeros(), Vec2::zeros());
        let row = RecordedState { time_s, at: at_m, heading_rad: 0.0, velocity, z_m: 0.0 };
        rows.recording.users[at].samples.push(row);
        rows.bound(0)
    }

    #[test]
    fn of_too_many_rows_the_first_by_time_are_held() {
        let most = most_rows(0);
        let (users, each) = (80, most / 64);
        let mut rows = Gathered::new(String::new());
        // One road user after the other, all at the same times.
        for user in 0..users {
            (0..each).for_each(|row| add(&mut rows, user, row as f64).unwrap());
        }
        let before_s = rows.before_s.unwrap();
        assert_eq!((rows.found, rows.recording.users.len()), (users * each, users));
        assert_eq!(rows.held, users * before_s as usize);
        assert!(rows.held <= most && rows.held > most / 4, "{} of {most}", rows.held);
        assert!(rows.left_out().is_some());
        // Road users that come later have no rows.
        let mut rows = Gathered::new(String::new());
        (0..=most).for_each(|row| add(&mut rows, row / 1_000, row as f64).unwrap());
        assert_eq!(rows.recording.users.len(), most.div_ceil(2).div_ceil(1_000));
    }

    #[test]
    fn too_many_rows_of_one_time_are_refused() {
        let mut rows = Gathered::new(String::new());
        let refused = (0..=MAX_USERS).find_map(|user| add(&mut rows, user, 0.0).err()).unwrap();
        assert_eq!(refused.code(), "too-many-agents");
    }
}
