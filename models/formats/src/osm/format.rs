//! Extracts of OpenStreetMap as an import format.

use super::driving_side::is_left;
use super::extract::{self, Extract};
use crate::around::{Around, Chosen, MapPart};
use crate::format::{ExportOptions, Exported, Format, ImportOptions, Info, Scenes, only, only_read};
use crate::map_file::{MapRead, with_advice};
use crate::osm_items::holds_lanelets;
use crate::problem::{ImportWarning, Imported, ReadError};
use crate::refusals::{self, what};
use crate::sentences;
use crate::source::Source;
use crate::sumo::formats::read_net;
use crate::sumo::import_net::LEFT_HAND;
use crate::{unpack, xml};
use scene::Scene;
use std::io;

/// Licence of OpenStreetMap data, and the attribution that it requires.
const LICENCE: &str = "odbl";
const ATTRIBUTION: &str = "Map data © OpenStreetMap contributors, available under the Open Database License.";
/// Name of the file for netconvert.
const FILE: &str = "extract.osm";
/// Arguments with which netconvert makes usable junctions of roads without lanes. It joins nodes of one
/// junction, adds pavements as the extract states, adds crossings and cycle lanes if they are tagged or
/// usual, and gives signals a fixed program.
const ARGUMENTS: [&str; 16] = [
    "--geometry.remove",
    "--junctions.join",
    "--roundabouts.guess",
    "--ramps.guess",
    "--osm.turn-lanes",
    "--osm.sidewalks",
    "--osm.bike-access",
    "--osm.crossings",
    "--crossings.guess",
    "--tls.guess-signals",
    "--tls.join",
    "--tls.discard-simple",
    "--no-turnarounds",
    "--remove-edges.isolated",
    "--offset.disable-normalization",
    "--no-warnings",
];
/// Vehicle classes whose ways are kept.
const LANES_OF: &str = "passenger,bus,delivery,bicycle,pedestrian";

/// An extract of OpenStreetMap (`.osm`), plain or gzip: a scene with a map and signals, without road users. Needs
/// [`ImportOptions::netconvert`].
pub struct OsmExtract;

impl OsmExtract {
    fn scene(file: &dyn Source, options: &ImportOptions) -> Result<Imported, ReadError> {
        let mut chosen = Chosen::of(options.around);
        let Extract { xml, projection, middle: (lat, lon) } = extract::read(file, &mut chosen)?;
        let left = is_left(lat, lon);
        let network = network(options, &xml, &projection.name(), left)?;
        let circle = options.around.map(|around| {
            let middle = projection.metres(around.y, around.x);
            Around { x: middle.x, y: middle.y, ..around }
        });
        let MapRead { map, signals, mut origin, mut warnings, part, .. } = read_net(&network, circle)?;
        let part = part.zip(options.around).map(|(part, around)| {
            let left_out = chosen.left_out;
            MapPart { around, left_out, what: what::ROADS, ..part }
        });
        origin.crs = Some(projection.name());
        warnings.retain(|warning| warning.code != LEFT_HAND);
        if left {
            warnings.push(ImportWarning::new(LEFT_HAND, sentences::left_hand()));
        }
        let read = MapRead { name: String::new(), map, signals, origin, warnings, part };
        let (mut scene, warnings) = read.scene("openstreetmap", Some(LICENCE.into()))?;
        if let Some(licence) = &options.licence {
            scene.meta.licence = Some(licence.clone());
        }
        scene.meta.notes = ATTRIBUTION.into();
        Ok((scene, warnings))
    }
}

/// The network that netconvert makes from roads.
fn network(options: &ImportOptions, xml: &[u8], projection: &str, left: bool) -> Result<Vec<u8>, ReadError> {
    let missing = || ReadError::other_content(refusals::netconvert_missing());
    let netconvert = options.netconvert.as_ref().ok_or_else(missing)?;
    let mut arguments: Vec<String> = ARGUMENTS.map(str::to_owned).into();
    arguments.extend(left.then(|| "--lefthand".to_owned()));
    for (name, value) in [("--osm-files", FILE), ("--proj", projection), ("--keep-edges.by-vclass", LANES_OF)]
    {
        arguments.extend([name.to_owned(), value.to_owned()]);
    }
    netconvert.network(FILE, xml, &arguments).map_err(|error| match error.kind() {
        io::ErrorKind::NotFound => missing(),
        _ => ReadError::other_content(refusals::netconvert_failed(&error.to_string())),
    })
}

impl Format for OsmExtract {
    fn info(&self) -> Info {
        Info {
            id: "osm",
            name: "OpenStreetMap extract (through netconvert)",
            media_type: "application/xml",
            extensions: &["osm", "osm.gz"],
            import: true,
            export: false,
            many: false,
            takes_net: false,
            notes: "An extract of some kilometres, as saved from the website. SUMO's `netconvert` makes \
                 junctions, turn lanes, pavements, crossings, cycle lanes and signals from it (`pip \
                 install eclipse-sumo` installs it; `DRAGTRAFFIC_NETCONVERT` names it if it is not on the \
                 path). Countries with left-hand traffic are recognised. The licence ODbL and its \
                 attribution stay with the scene. No road users. Plain or gzip.",
            loses: &[],
        }
    }

    fn sniff(&self, head: &[u8], _: &str) -> u8 {
        let head = unpack::head(head);
        if xml::root_of(&head).is_none_or(|root| root != "osm") {
            return 0;
        }
        // A Lanelet2 map has the same beginning. Its lanelets may come much later: `registry::identified`
        // reads the whole file.
        if holds_lanelets(&head.as_slice()) { 0 } else { 2 }
    }

    fn takes_around(&self) -> bool {
        true
    }

    fn scenes<'a>(&'a self, file: &'a dyn Source, options: &'a ImportOptions) -> Scenes<'a> {
        only(options, || Self::scene(file, options).map_err(|error| with_advice(error, options.around)))
    }

    fn export(&self, _: &[&Scene], _: &ExportOptions) -> io::Result<Exported> {
        Err(only_read(&self.info()))
    }
}
