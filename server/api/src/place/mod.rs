//! Placement of road users on a map.

mod checks;
mod reply;
pub mod request;

pub use reply::PlaceReply;
pub use request::PlaceBody;

use crate::code::Code;
use crate::problem::Problem;
use experts::placement::Placement;
use experts::{Cancel, GenerateError, Placer};
use request::ArrivalsDoc;
use scene::Scene;
use std::collections::HashSet;
use std::sync::Arc;

impl PlaceBody {
    /// Checks the options and places road users.
    ///
    /// # Errors
    /// Every fault of the options; a cancelled call.
    pub fn run(&self, scene: &Arc<Scene>, placer: &Placer, cancel: &Cancel) -> Result<Placement, Problem> {
        let request = self.engine_request(scene)?;
        placer.place(&request, cancel).map_err(|error| match error {
            GenerateError::UnknownAgent(_) => Problem::field("/keep", Code::UnknownAgent, error.to_string()),
            GenerateError::UnknownArm { ref arm, .. } => {
                let named = |a: &&ArrivalsDoc| a.arm.chars().take(64).eq(arm.chars());
                let at = self.arrivals.iter().position(|a| named(&a)).unwrap_or(0);
                Problem::field(&format!("/arrivals/{at}/arm"), Code::InvalidField, error.to_string())
            }
            other => other.into(),
        })
    }

    /// The scene with the placed road users and those of its own that stay. Its futures are dropped, because
    /// they were planned among other road users.
    pub fn placed(&self, scene: &Scene, placement: Placement) -> Scene {
        let mut scene = scene.clone();
        if let Some(keep) = &self.keep {
            let keep: HashSet<&String> = keep.iter().collect();
            scene.agents.retain(|agent| keep.contains(&agent.id));
        }
        scene.agents.extend(placement.agents);
        scene.generated = None;
        scene
    }
}
