//! What must hold for any input whatever. Fuzz targets and a plain test over their corpus run these;
//! a broken promise panics.
#![allow(clippy::panic, clippy::expect_used, reason = "a panic is how a promise is reported broken")]

use crate::format::{ExportedMotion, ImportOptions};
use crate::native::{self, ConditionsDoc, Context, Window};
use crate::registry;
use crate::womd::{self, Options};
use scene::{AgentType, State};

/// A document that is read writes back to an equal scene, and then to the same bytes.
///
/// # Panics
/// When it does not.
pub fn native(bytes: &[u8]) {
    let Ok(scene) = native::read(bytes) else { return };
    let written = native::write(&scene);
    let again = native::read(&written).expect("what was written is read");
    // Futures are rounded by the first writing; from then on nothing changes.
    assert_eq!(native::write(&again), written, "writing is not stable");
}

/// A record that is read writes back to an equal scene. Checksums are not looked at, so that a
/// fuzzer gets past them.
///
/// # Panics
/// When it does not.
pub fn womd(bytes: &[u8]) {
    let options =
        Options { verify_crc: false, max_scenes: 4, max_decoded_bytes: 16 << 20, ..Options::default() };
    for (scene, _) in womd::read_all(bytes, &options).into_iter().flatten() {
        let mut file = Vec::new();
        womd::write(&[&scene], &mut file, false, ExportedMotion::Log).expect("a vector takes all");
        let mut list = womd::read_all(&file, &Options::default());
        assert!(matches!(list.pop(), Some(Ok(_))), "what was written is not read");
    }
}

/// A network or a recording of SUMO that is read is a scene that the native format holds.
///
/// # Panics
/// When it is not.
pub fn sumo(bytes: &[u8]) {
    let options = ImportOptions { max_scenes: 4, ..ImportOptions::default() };
    for format in ["sumo-net", "sumo-fcd"] {
        let format = registry::by_id(format).expect("the format is in the table");
        for (scene, _) in format.import(bytes, &options).into_iter().flatten() {
            native::read(&native::write(&scene)).expect("what was written is read");
        }
    }
}

/// Conditions that resolve are within their ranges and resolve to themselves when written.
///
/// # Panics
/// When they are not.
pub fn conditions(bytes: &[u8]) {
    let Ok(doc) = native::from_json::<ConditionsDoc>(bytes) else { return };
    let start = State { x_m: 3.0, y_m: -7.0, heading_rad: 2.5, vx_mps: 4.0, vy_mps: 0.0 };
    let context = Context {
        agent_type: AgentType::Vehicle,
        start: Some(start),
        window: Window { start_s: 0.0, horizon_s: 9.0 },
    };
    let Ok(resolved) = doc.resolve("", &context) else { return };
    let again = ConditionsDoc::from_conditions(&resolved).resolve("", &context);
    assert_eq!(again.as_ref(), Ok(&resolved), "resolved conditions do not resolve to themselves");
}
