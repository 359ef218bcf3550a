//! Writes all files that SUMO needs of a scene, as one zip.

use super::network::ExportedNetwork;
use super::{net, recording, trips};
use crate::format::{ExportOptions, Exported};
use crate::loss::{Loss, code};
use crate::markup::{Markup, decimal};
use crate::pack;
use crate::sentences;
use crate::written::{BoundedFile, FileBounds};
use scene::{STEP_S, Scene};
use std::collections::BTreeSet;
use std::io;

/// Suffixes of the file names.
pub(in crate::sumo) const NET: &str = ".net.xml";
pub(in crate::sumo) const TRIPS: &str = ".rou.xml";
pub(in crate::sumo) const RECORDING: &str = ".fcd.xml";
pub(in crate::sumo) const CONFIGURATION: &str = ".sumocfg";

/// Writes a scene: its network with trips and a configuration if it has lanes, and its motion if it has road
/// users.
///
/// # Errors
/// `InvalidInput` for a scene with neither.
pub(in crate::sumo) fn write(scene: &Scene, options: &ExportOptions) -> io::Result<Exported> {
    let name = pack::file_name(scene);
    let written = recording::road_users(scene, options);
    let network = ExportedNetwork::of(scene);
    let mut losses: BTreeSet<Loss> = recording::losses(scene, options, &written).into_iter().collect();
    let mut files = Vec::new();
    let steps = recording::steps(scene, &written);
    match net::document(scene, &network, steps, options.bounds())? {
        Some(map) => {
            let (trips, without) = trips::write(scene, &network, &written, options.bounds())?;
            files.push((format!("{name}{CONFIGURATION}"), configuration(&name, steps)?));
            files.push((format!("{name}{NET}"), map));
            files.push((format!("{name}{TRIPS}"), trips));
            losses.extend(net::losses(scene, &network));
            let lost = sentences::loss_users_off_lanes(without);
            losses.extend((without > 0).then(|| Loss::counted(code::NO_TRIPS, lost)));
        }
        None if !scene.signals.is_empty() => {
            losses.insert(Loss::new(code::NO_SIGNALS, "lights of a scene without lanes"));
        }
        None => {}
    }
    if !written.is_empty() {
        files.push((format!("{name}{RECORDING}"), recording::document(scene, &written, options.bounds())?));
    }
    if files.is_empty() {
        let message = crate::refusals::file_needs("SUMO", crate::refusals::what::LANE_OR_USER);
        return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
    }
    Ok(Exported { bytes: pack::zip(files)?, losses: losses.into_iter().collect() })
}

/// Configuration for `sumo -c`: length and step of the scene.
fn configuration(name: &str, steps: usize) -> io::Result<BoundedFile> {
    let mut out = Markup::new(FileBounds::default());
    out.open("configuration", &[]);
    out.open("input", &[]);
    out.empty("net-file", &[("value", &format!("{name}{NET}"))]);
    out.empty("route-files", &[("value", &format!("{name}{TRIPS}"))]);
    out.close();
    out.open("time", &[]);
    out.empty("begin", &[("value", "0")]);
    out.empty("end", &[("value", &decimal(steps as f64 * STEP_S))]);
    out.empty("step-length", &[("value", &decimal(STEP_S))]);
    out.close();
    out.open("processing", &[]);
    // Road users start at their positions, however close to each other.
    out.empty("collision.action", &[("value", "warn")]);
    out.empty("time-to-teleport", &[("value", "-1")]);
    out.close();
    out.close();
    out.finish()
}
