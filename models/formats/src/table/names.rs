//! Names of the files of a recording.

use serde::Deserialize;

/// Placeholder for the name of the recording in the name of a file.
const RECORDING: char = '*';
/// Most names of one kind, and most bytes of one.
const MOST_NAMES: usize = 8;
const MOST_BYTES: usize = 200;

/// Rows of a table of a recording.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum TableKind {
    /// A row for each road user and time.
    #[default]
    Tracks,
    /// A row for each road user.
    Agents,
    /// One row.
    Recording,
}

/// Names of the files of a recording.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FileNames {
    /// Tables with a row for each road user and time.
    tracks: NameList,
    /// Tables with a row for each road user.
    #[serde(default)]
    agents: NameList,
    /// The id column of these; that of the tracks if absent.
    pub agents_by: Option<String>,
    /// The table with one row.
    #[serde(default)]
    recording: NameList,
}

#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(from = "OneOrMore")]
struct NameList(Vec<String>);

#[derive(Deserialize)]
#[serde(untagged)]
enum OneOrMore {
    One(String),
    More(Vec<String>),
}

impl From<OneOrMore> for NameList {
    fn from(told: OneOrMore) -> Self {
        match told {
            OneOrMore::One(name) => Self(vec![name]),
            OneOrMore::More(names) => Self(names),
        }
    }
}

impl NameList {
    /// The recording to which a file of this name belongs, with the length of the match.
    fn recording_of<'n>(&self, name: &'n str) -> Option<(usize, &'n str)> {
        let found = self.0.iter().filter_map(|pattern| Some((pattern.len(), recording(pattern, name)?)));
        found.max_by_key(|(length, _)| *length)
    }

    /// Index of the first pattern that a name matches.
    fn place_of(&self, name: &str) -> Option<usize> {
        self.0.iter().position(|pattern| recording(pattern, name).is_some())
    }
}

/// The part of a name that matches the placeholder of a pattern.
fn recording<'n>(pattern: &str, name: &'n str) -> Option<&'n str> {
    let (begin, end) = pattern.split_once(RECORDING)?;
    let starts = name.get(..begin.len())?.eq_ignore_ascii_case(begin);
    let rest = name.get(begin.len()..).filter(|_| starts)?;
    let length = rest.len().checked_sub(end.len())?;
    let ends = rest.get(length..)?.eq_ignore_ascii_case(end);
    rest.get(..length).filter(|_| ends)
}

impl FileNames {
    /// Whether each pattern is a possible file name.
    pub fn can_be(&self) -> bool {
        let lists = [&self.tracks, &self.agents, &self.recording];
        let is_name = |name: &String| {
            name.len() <= MOST_BYTES && name.matches(RECORDING).count() == 1 && !name.contains(['/', '\\'])
        };
        !self.tracks.0.is_empty()
            && lists.iter().all(|list| list.0.len() <= MOST_NAMES && list.0.iter().all(is_name))
    }

    /// Kind of a file with this name, with the recording and the length of the match.
    pub fn kind_of<'n>(&self, name: &'n str) -> Option<(usize, &'n str, TableKind)> {
        let lists = [
            (&self.tracks, TableKind::Tracks),
            (&self.agents, TableKind::Agents),
            (&self.recording, TableKind::Recording),
        ];
        let found = lists.into_iter().filter_map(|(list, kind)| Some((list.recording_of(name)?, kind)));
        let ((length, recording), kind) = found.max_by_key(|((length, _), _)| *length)?;
        Some((length, recording, kind))
    }

    /// Index of a table of tracks among those of a recording.
    pub fn place_of(&self, name: &str) -> Option<usize> {
        self.tracks.place_of(name)
    }
}
