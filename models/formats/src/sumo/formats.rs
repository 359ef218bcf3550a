//! The two import formats of SUMO: a road network, and a recording (FCD) with or without its network.

use super::import_fcd::{FcdContext, Windows};
use super::import_net::{self, NetScene};
use super::out::{net, recording};
use super::rows::FcdRows;
use crate::around::Around;
use crate::format::{
    ExportOptions, Exported, Format, ImportOptions, Info, MAP_TIMING, NET_POINTER, Scenes, one, one_scene,
};
use crate::limits::MAX_DECODED_BYTES;
use crate::loss::code;
use crate::map_file::{MapFile, MapRead};
use crate::problem::ReadError;
use crate::source::Source;
use crate::{unpack, xml};
use scene::Scene;
use std::io;

/// `meta.source` of the scenes.
pub(super) const SOURCE: &str = "sumo";

/// A network (`net.xml`), plain or compressed with gzip: a scene with a map and signals, without road users.
/// The frame is that of the network, moved by whole metres so that the network's middle is the origin.
pub(crate) static SUMO_NET: MapFile = MapFile {
    id: "sumo-net",
    name: "SUMO network",
    extensions: &["net.xml", "net.xml.gz"],
    root: "net",
    source: SOURCE,
    notes: "Lanes, crossings, sidewalks, kerbs, and signals of static programs from time 0; no road users. \
         In a written network, lanes side by side form an edge, and paths through junctions keep their \
         shape, with right of way and changing signals. Plain or gzip.",
    loses: &[
        code::NO_ROAD_USERS,
        code::NO_NOTES,
        code::NO_MAP,
        code::NO_SIGNALS,
        code::NO_LANE_GRAPH,
        code::NO_Z,
        code::NO_DRIVABLE,
        code::NO_LANE_WIDTH,
        code::NO_LANE_TYPE,
        code::NO_LINES,
        code::NO_AREAS,
        code::NO_NEIGHBORS,
        code::NO_SIGNAL_STATES,
        code::GEOMETRY_APPROXIMATED,
        code::NO_IDS,
        code::NO_SPEED_LIMITS,
    ],
    read: read_net,
    write: Some(net::write),
};

/// A recording (`--fcd-output`), XML or CSV, plain or compressed with gzip: scenes of 9.1 s. Angles are
/// degrees clockwise from north, and positions are the middle of the front bumper, as SUMO documents for FCD
/// output.
pub struct SumoFcd;

/// A network as a map: see [`SUMO_NET`].
pub(crate) fn read_net(file: &dyn Source, around: Option<Around>) -> Result<MapRead, ReadError> {
    import_net::read(file, around).map(of_net)
}

/// The map of a network without recording.
pub(super) fn of_net(net: NetScene) -> MapRead {
    MapRead {
        name: String::new(),
        signals: net.signals(0.0, MAP_TIMING.steps),
        map: net.map,
        origin: net.place,
        warnings: net.warnings,
        part: net.part,
    }
}

impl Format for SumoFcd {
    fn info(&self) -> Info {
        Info {
            id: "sumo-fcd",
            name: "SUMO floating-car data (XML or CSV)",
            media_type: "application/xml",
            extensions: &["fcd.xml", "fcd.xml.gz", "fcd.csv", "fcd.csv.gz"],
            import: true,
            export: true,
            many: true,
            takes_net: true,
            notes: "Positions of road users at each step. XML or CSV is read, XML is written; scenes of 9.1 \
                 s at 0.1 s. Sizes follow from the name of the type, and a written type has its size in \
                 metres. Lanes and signals come only from the network (`--net`). Plain or gzip.",
            loses: &[
                code::NO_CONDITIONS,
                code::NO_GENERATED,
                code::NO_MODES,
                code::NO_SUBTYPE,
                code::NO_ROLES,
                code::NO_LICENCE,
                code::NO_NOTES,
                code::NO_MAP,
                code::NO_SIGNALS,
                code::NO_SIZES,
                code::NO_TIMING,
                code::NO_Z,
                code::NO_UNSEEN,
                code::NO_VELOCITY,
                code::IDS_RENUMBERED,
            ],
        }
    }

    fn sniff(&self, head: &[u8], name: &str) -> u8 {
        let head = unpack::head(head);
        let first = head.split(|b| *b == b'\n').next().unwrap_or_default();
        let has = |text: &[u8]| first.windows(text.len()).any(|w| w == text);
        let columns = has(b"timestep_time") && (has(b"vehicle_") || has(b"person_"));
        if columns || xml::root_of(&head).is_some_and(|root| root == "fcd-export") {
            return 2;
        }
        let name = name.to_ascii_lowercase();
        u8::from(self.info().extensions.iter().any(|end| name.ends_with(end)))
    }

    fn scenes<'a>(&'a self, file: &'a dyn Source, options: &'a ImportOptions) -> Scenes<'a> {
        let net = match options.net.as_ref().map(|net| import_net::read(net, None)).transpose() {
            Ok(net) => net,
            Err(error) => return one(Err(error.under(NET_POINTER))),
        };
        let common = FcdContext { net, licence: options.licence.clone() };
        match FcdRows::open(file, MAX_DECODED_BYTES) {
            Ok(rows) => Box::new(Windows::new(rows, common).skip(options.skip).take(options.max_scenes)),
            Err(error) => one(Err(error)),
        }
    }

    fn export(&self, scenes: &[&Scene], options: &ExportOptions) -> io::Result<Exported> {
        one_scene(scenes).and_then(|scene| recording::write(scene, options))
    }
}
