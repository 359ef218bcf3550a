//! CommonRoad as a format among others.

use super::document::ROOT;
use super::{export, import};
use crate::format::{ExportOptions, Exported, Format, ImportOptions, Info, Scenes, one_scene, only};
use crate::loss;
use crate::source::Source;
use crate::{unpack, xml};
use scene::Scene;
use std::io;

/// CommonRoad scenarios: 2018b and 2020a are read, plain or gzip; 2020a is written.
pub(crate) struct CommonRoad;

impl Format for CommonRoad {
    fn info(&self) -> Info {
        Info {
            id: "commonroad",
            name: "CommonRoad scenario",
            media_type: "application/xml",
            extensions: &["xml"],
            import: true,
            export: true,
            many: false,
            takes_net: false,
            notes: "2018b and 2020a are read, 2020a is written: lanelets, signs, signals with their cycles, \
                 obstacles, planning problems. The first planning problem is the ego with its goal, at \
                 the middle of a goal region. Other steps than 0.1 s are resampled. In a written file, \
                 the ego (else the first road user with a goal) is the planning problem; origin and licence \
                 are kept. CommonRoad's readers take road users that appear late, its schema does not.",
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
                loss::code::NO_TIMING,
                loss::code::NO_Z,
                loss::code::NO_DRIVABLE,
                loss::code::NO_LANE_WIDTH,
                loss::code::NO_LINES,
                loss::code::NO_AREAS,
                loss::code::NO_NEIGHBORS,
                loss::code::NO_VALIDITY_GAPS,
                loss::code::SINGLE_EGO,
                loss::code::NO_SIGNAL_STATES,
                loss::code::LATE_ROAD_USERS,
                loss::code::IDS_RENUMBERED,
            ],
        }
    }

    fn sniff(&self, head: &[u8], _: &str) -> u8 {
        if xml::root_of(&unpack::head(head)).is_some_and(|root| root == ROOT) { 2 } else { 0 }
    }

    fn scenes<'a>(&'a self, file: &'a dyn Source, options: &'a ImportOptions) -> Scenes<'a> {
        only(options, || import::read(file, options))
    }

    fn export(&self, scenes: &[&Scene], options: &ExportOptions) -> io::Result<Exported> {
        one_scene(scenes).and_then(|scene| export::write(scene, options))
    }
}
