//! Groups files into recordings by their names.

use super::columns::{Columns, PRESETS};
use super::names::{FileNames, TableKind};
use crate::source::Source;
use std::collections::{BTreeMap, BTreeSet, HashSet};

/// The files of one recording, by their indices in a list of names.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TableGroup {
    /// Name of the recording: the common part of its file names, otherwise their folder.
    pub name: String,
    /// Tables with a row for each road user and time, one or more.
    pub tracks: Vec<usize>,
    /// Tables with a row for each road user.
    pub agents: Vec<usize>,
    /// Tables about the recording as a whole.
    pub recording: Vec<usize>,
}

impl TableGroup {
    /// A group of a single table.
    pub(super) fn alone(at: usize, name: String) -> Self {
        Self { name, tracks: vec![at], ..Self::default() }
    }

    /// All indices, those of the tracks first.
    pub fn all(&self) -> impl Iterator<Item = usize> + '_ {
        self.tracks.iter().chain(&self.agents).chain(&self.recording).copied()
    }
}

/// File name endings of maps.
const MAPS: [&str; 6] = [".osm", ".osm.gz", ".xodr", ".xodr.gz", ".net.xml", ".net.xml.gz"];

/// Whether the name is that of a map that may lie beside a table.
pub fn is_map(name: &str) -> bool {
    let name = name.to_ascii_lowercase();
    MAPS.iter().any(|end| name.ends_with(end))
}

/// Whether the name is that of a table.
pub(super) fn is_table(name: &str) -> bool {
    plain(&name.to_ascii_lowercase()).ends_with(".csv")
}

/// The name of a file without the ending of a compression.
fn plain(name: &str) -> &str {
    name.strip_suffix(".gz").unwrap_or(name)
}

/// The names in a column file, otherwise those of the public data sets.
fn sets(columns: Option<&dyn Source>) -> Vec<FileNames> {
    let read = |columns: &dyn Source| Columns::read(columns).ok();
    match columns {
        Some(columns) => read(columns).and_then(|columns| columns.files).into_iter().collect(),
        None => PRESETS.iter().filter_map(|(set, _)| read(&set.as_bytes())?.files).collect(),
    }
}

/// The role of a path by the set with the longest match: the set, the recording, and the kind of table.
fn place<'n>(sets: &[FileNames], path: &'n str) -> Option<(usize, &'n str, TableKind)> {
    let name = plain(base(path));
    let of = |(at, set): (usize, &FileNames)| {
        let (length, recording, kind) = set.kind_of(name)?;
        Some((length, at, recording, kind))
    };
    let best =
        sets.iter().enumerate().filter_map(of).min_by_key(|(length, at, ..)| (usize::MAX - length, *at));
    best.map(|(_, at, recording, kind)| (at, recording, kind))
}

/// Each table as a recording of its own.
pub(super) fn each_alone(names: &[&str]) -> Vec<TableGroup> {
    let name = |path: &str| base(path).split('.').next().unwrap_or_default().to_owned();
    let tables = names.iter().enumerate().filter(|(_, path)| is_table(path));
    tables.map(|(at, path)| TableGroup::alone(at, name(path))).collect()
}

/// The name of a file without its folders.
fn base(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or_default()
}

/// The recordings of tables with these names (paths in a folder or zip), in the order of the names. The names
/// come from a column file, otherwise from the public data sets. Files of no recording are left out; of a
/// table that is both plain and compressed, the compressed one is kept.
pub fn groups(names: &[&str], columns: Option<&dyn Source>) -> Vec<TableGroup> {
    let sets = sets(columns);
    let all: HashSet<&str> = names.iter().copied().collect();
    let mut found: BTreeMap<(usize, &str, &str), TableGroup> = BTreeMap::new();
    for (i, path) in names.iter().enumerate() {
        let twice = plain(path) != *path && all.contains(plain(path));
        let Some((set, recording, kind)) = place(&sets, path).filter(|_| !twice) else { continue };
        let folder = path.get(..path.len() - base(path).len()).unwrap_or_default();
        let group = found.entry((set, folder, recording)).or_default();
        let called =
            if recording.is_empty() { base(folder.trim_end_matches(['/', '\\'])) } else { recording };
        called.clone_into(&mut group.name);
        match kind {
            TableKind::Tracks => group.tracks.push(i),
            TableKind::Agents => group.agents.push(i),
            TableKind::Recording => group.recording.push(i),
        }
    }
    for ((set, ..), group) in &mut found {
        // The first table in the set's list is the most informative, such as that of the vehicles.
        let place = |at: &usize| {
            let name = names.get(*at).map_or("", |path| base(path));
            sets.get(*set).and_then(|set| set.place_of(plain(name)))
        };
        group.tracks.sort_by_key(place);
    }
    let mut groups: Vec<TableGroup> = found.into_values().filter(|group| !group.tracks.is_empty()).collect();
    groups.sort_by_key(|group| group.all().min());
    groups
}

/// The first table of tracks of each recording with these names, by which it is opened.
pub fn firsts(names: &[&str], columns: Option<&dyn Source>) -> Vec<usize> {
    groups(names, columns).iter().filter_map(|group| group.tracks.first().copied()).collect()
}

/// The tables that are read with the first one of their recording, and are not opened by themselves.
pub fn followers(names: &[&str], columns: Option<&dyn Source>) -> BTreeSet<usize> {
    groups(names, columns).iter().flat_map(|group| group.all().skip(1).collect::<Vec<_>>()).collect()
}

/// The files of a folder that are read with the table of tracks of this name: the other tables of its
/// recording, and all maps. None if no set has tracks with such a name; the names of the folder are requested
/// only otherwise.
///
/// # Errors
/// When the names cannot be listed.
pub fn beside<E>(
    own: &str,
    columns: Option<&dyn Source>,
    names: impl FnOnce() -> Result<Vec<String>, E>,
) -> Result<Vec<String>, E> {
    let is_tracks = |(.., kind): (usize, &str, TableKind)| kind == TableKind::Tracks;
    if !(is_table(own) && place(&sets(columns), own).is_some_and(is_tracks)) {
        return Ok(Vec::new());
    }
    let mut names = names()?;
    // The table itself comes first, instead of a compressed or plain copy of it.
    names.retain(|name| plain(name) != plain(own));
    names.insert(0, own.to_owned());
    let list: Vec<&str> = names.iter().map(String::as_str).collect();
    let mut found: BTreeSet<usize> =
        (1..list.len()).filter(|at| list.get(*at).is_some_and(|name| is_map(name))).collect();
    if let Some(group) = groups(&list, columns).into_iter().find(|group| group.tracks.contains(&0)) {
        found.extend(group.all().filter(|at| *at > 0));
    }
    let mut at = 0..;
    names.retain(|_| at.next().is_some_and(|at| found.contains(&at)));
    names.sort();
    Ok(names)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_has_its_own_recording_and_the_maps_of_its_folder_beside_it() {
        let folder = [
            "00_tracks.csv",
            "00_tracks.csv.gz",
            "00_tracksMeta.csv",
            "00_tracksMeta.csv.gz",
            "00_recordingMeta.csv",
            "01_tracks.csv",
            "01_tracksMeta.csv",
            "here.osm",
            "there.xodr",
            "manifest.csv",
            "notes.txt",
            "vehicle_tracks_003.csv",
            "pedestrian_tracks_003.csv",
            "pedestrian_tracks_004.csv",
            "a.net.xml",
        ];
        let of = |own: &str, columns: Option<&dyn Source>| {
            let names = || Ok::<_, ()>(folder.map(str::to_owned).to_vec());
            beside(own, columns, names).unwrap().join(" ")
        };
        let maps = "a.net.xml here.osm there.xodr";
        assert_eq!(of("00_tracks.csv", None), "00_recordingMeta.csv 00_tracksMeta.csv ".to_owned() + maps);
        assert_eq!(of("00_tracks.csv.gz", None), "00_recordingMeta.csv 00_tracksMeta.csv ".to_owned() + maps);
        assert_eq!(of("01_tracks.csv", Some(&"ind".as_bytes())), "01_tracksMeta.csv ".to_owned() + maps);
        let both = "a.net.xml here.osm pedestrian_tracks_003.csv there.xodr";
        assert_eq!(of("vehicle_tracks_003.csv", None), both);
        assert_eq!(of("pedestrian_tracks_003.csv", None), maps.to_owned() + " vehicle_tracks_003.csv");
        // Tables of no recording, of another set and about tracks have no companions, and no folder is
        // listed.
        let unasked = |own: &str, columns: Option<&dyn Source>| beside(own, columns, || Err(own.to_owned()));
        for own in ["manifest.csv", "00_tracksMeta.csv", "00_tracks.json", "here.osm"] {
            assert_eq!(unasked(own, None), Ok(Vec::new()));
        }
        assert_eq!(unasked("00_tracks.csv", Some(&"sind".as_bytes())), Ok(Vec::new()));
        assert_eq!(unasked("00_tracks.csv", None), Err("00_tracks.csv".to_owned()));
    }

    #[test]
    fn files_of_a_recording_are_found_by_their_names() {
        let names = [
            "inD/data/00_recordingMeta.csv",
            "inD/data/00_tracks.csv.gz",
            "inD/data/00_tracksMeta.csv",
            "inD/data/01_tracks.csv",
            "inD/data/02_tracksMeta.csv",
            "SinD/8_2_1/Ped_smoothed_tracks.csv",
            "SinD/8_2_1/Veh_smoothed_tracks.csv",
            "DR_X/pedestrian_tracks_003.csv",
            "DR_X/vehicle_tracks_003.csv",
            "readme.txt",
        ];
        let group = |name: &str, tracks: &[usize], agents: &[usize], recording: &[usize]| TableGroup {
            name: name.to_owned(),
            tracks: tracks.to_vec(),
            agents: agents.to_vec(),
            recording: recording.to_vec(),
        };
        let all = [
            group("00", &[1], &[2], &[0]),
            group("01", &[3], &[], &[]),
            group("8_2_1", &[6, 5], &[], &[]),
            group("003", &[8, 7], &[], &[]),
        ];
        assert_eq!(groups(&names, None), all);
        assert_eq!(groups(&names, Some(&"ind".as_bytes()))[0], all[0]);
        let own = r#"{"files": {"tracks": "DR*.csv"}}"#;
        assert_eq!(groups(&["a/DR1.csv", "a/xDR.csv", "DR.csv"], Some(&own.as_bytes())).len(), 2);
        assert_eq!(groups(&["a.csv", "b.csv"], Some(&"ngsim".as_bytes())), []);
        assert_eq!(groups(&["a.csv"], Some(&"no columns".as_bytes())), []);
    }
}
