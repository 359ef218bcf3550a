//! Argoverse scenarios as an import and export format.

use super::{export, import, map};
use crate::columnar::{is_parquet, names_in};
use crate::format::{
    ExportOptions, Exported, Format, ImportOptions, Info, NET_POINTER, Scenes, one_scene, only,
};
use crate::loss;
use crate::map_file::{self, MapRead};
use crate::problem::{Imported, ReadError};
use crate::source::{Source, head};
use crate::unpack;
use scene::{Origin, Scene};
use std::io;

/// A scenario with or without its map; a map alone gives a scene without road users.
pub struct Argoverse;

impl Format for Argoverse {
    fn info(&self) -> Info {
        Info {
            id: "av2",
            name: "Argoverse 2 scenario (Parquet, map JSON)",
            media_type: "application/vnd.apache.parquet",
            extensions: &["av2.parquet"],
            import: true,
            export: true,
            many: false,
            takes_net: true,
            notes: "Motion of road users, with the map by `--net`, or a map alone. Sizes follow from the \
                 type, as the format has none; a written scenario has no map.",
            loses: &[
                loss::code::NO_CONDITIONS,
                loss::code::NO_GENERATED,
                loss::code::NO_MODES,
                loss::code::NO_SUBTYPE,
                loss::code::NO_ROLES,
                loss::code::NO_NOTES,
                loss::code::NO_MAP,
                loss::code::NO_SIGNALS,
                loss::code::NO_SIZES,
                loss::code::NO_Z,
                loss::code::NO_UNSEEN,
                loss::code::LONG_RECORD,
                loss::code::IDS_RENUMBERED,
            ],
        }
    }

    fn sniff(&self, head: &[u8], name: &str) -> u8 {
        let name = name.to_ascii_lowercase();
        if is_parquet(head) {
            let known = names_in(head, &["track_id", "focal_track_id", "timestep", "position_x"]);
            return if known { 2 } else { u8::from(name.ends_with(".av2.parquet")) };
        }
        let head = unpack::head(head);
        let has = |text: &[u8]| head.windows(text.len()).any(|window| window == text);
        let map = head.trim_ascii_start().starts_with(b"{")
            && (has(b"\"left_lane_boundary\"") || has(b"\"area_boundary\""));
        if map { 2 } else { 0 }
    }

    fn scenes<'a>(&'a self, file: &'a dyn Source, options: &'a ImportOptions) -> Scenes<'a> {
        only(options, || if is_parquet(&head(file)) { scenario(file, options) } else { place(file, options) })
    }

    fn export(&self, scenes: &[&Scene], options: &ExportOptions) -> io::Result<Exported> {
        one_scene(scenes).and_then(|scene| export::write(scene, options.motion))
    }
}

fn scenario(file: &dyn Source, options: &ImportOptions) -> Result<Imported, ReadError> {
    let map = options.net.as_ref().map(|net| map::read(net)).transpose();
    let map = map.map_err(|error| error.under(NET_POINTER))?;
    import::read(file, map, options.licence.clone())
}

/// Reads a map without scenario.
fn place(file: &dyn Source, options: &ImportOptions) -> Result<Imported, ReadError> {
    let place = map::read(file)?;
    let (middle, size) = place.extent().map(|all| (all.middle(), all.size())).unwrap_or_default();
    let (origin, half) = (middle.map(f64::round), size / 2.0);
    if map_file::is_too_wide(half) {
        return Err(ReadError::map_too_large(map_file::extent(half)));
    }
    let (map, warnings) = place.lane_map(origin);
    let licence = options.licence.clone().unwrap_or_else(|| super::LICENCE.into());
    let origin = Origin { x_m: origin.x, y_m: origin.y, ..Origin::default() };
    MapRead { name: String::new(), map: map.into(), signals: Vec::new(), origin, warnings, part: None }
        .scene("argoverse", Some(licence))
}
