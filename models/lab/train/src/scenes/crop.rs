//! The part of a scene that is used: a square about the ego, and the least number of road users in it.

use scene::geometry::rotate;
use scene::{AgentType, Scene};
use serde::Serialize;

/// Selection of a scene's road users. The map stays complete, so that a road user that leaves the square
/// still has lanes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Crop {
    /// Side of the square, metres. Its centre is the ego, its sides lie along and across the ego's heading at
    /// the first step. If the ego is absent, the first present road user replaces it. `None` takes all.
    pub side_m: Option<f64>,
    /// Scenes with fewer road users (vehicles, pedestrians and cyclists) there at the first step are left
    /// out.
    pub least_agents: usize,
}

/// A scene after its crop.
#[derive(Clone, Debug, PartialEq)]
pub enum Cropped {
    /// The scene with the selected road users, and the number of removed ones.
    Kept(Box<Scene>, usize),
    /// Too few road users; this many would remain.
    TooFew(usize),
}

impl Crop {
    /// The crop of the paper: a square of 120 m, at least 32 road users.
    pub const PAPER: Self = Self { side_m: Some(120.0), least_agents: 32 };

    /// Removes road users outside the square at the first step.
    pub fn apply(&self, scene: Scene) -> Cropped {
        self.about(scene, None)
    }

    /// Crops about the road user of this index instead of the ego.
    pub fn about(&self, mut scene: Scene, middle: Option<usize>) -> Cropped {
        let before = scene.agents.len();
        if let Some(side_m) = self.side_m {
            let here = || scene.agents.iter().filter_map(|a| Some((a, a.state_at(0)?)));
            let ego = || here().find(|(a, _)| a.role.as_deref() == Some("ego")).or_else(|| here().next());
            let middle = match middle {
                Some(index) => scene.agents.get(index).and_then(|agent| agent.state_at(0)),
                None => ego().map(|(_, state)| state),
            };
            scene.agents.retain(|agent| {
                let (Some(state), Some(middle)) = (agent.state_at(0), middle) else { return false };
                let local = rotate(state.position() - middle.position(), -middle.heading_rad);
                local.x.abs().max(local.y.abs()) <= 0.5 * side_m
            });
        }
        let counts = |a: &&scene::Agent| a.agent_type != AgentType::Other && a.state_at(0).is_some();
        let left = scene.agents.iter().filter(counts).count();
        if left < self.least_agents {
            return Cropped::TooFew(left);
        }
        let outside = before - scene.agents.len();
        Cropped::Kept(Box::new(scene), outside)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::{log, scene, shifted};

    fn ids(cropped: Cropped) -> (Vec<String>, usize) {
        match cropped {
            Cropped::Kept(scene, outside) => (scene.agents.into_iter().map(|a| a.id).collect(), outside),
            Cropped::TooFew(left) => panic!("only {left} left"),
        }
    }

    #[test]
    fn the_square_lies_about_the_ego_and_along_its_heading() {
        let mut ego = shifted(log("ego", 5.0, 91), 100.0, 0.0);
        ego.role = Some("ego".into());
        let mut agents = vec![
            shifted(log("first", 5.0, 91), 39.0, 0.0),
            shifted(log("near", 5.0, 91), 141.0, 0.0),
            shifted(log("corner", 5.0, 91), 159.0, 59.0),
            ego,
        ];
        // A road user that enters later is absent at the first step.
        agents.push(log("late", 5.0, 91));
        agents[4].track.first_step = 5;
        let whole = scene(agents);
        let crop = Crop { side_m: Some(120.0), least_agents: 0 };
        assert_eq!(ids(crop.apply(whole.clone())), (vec!["near".into(), "corner".into(), "ego".into()], 2));
        // Turned by 45 degrees the corner is 83 m ahead, and the first 43 m behind and 43 m aside.
        let mut turned = whole.clone();
        for state in turned.agents[3].track.states.iter_mut().flatten() {
            state.heading_rad = std::f64::consts::FRAC_PI_4;
        }
        assert_eq!(ids(crop.apply(turned)), (vec!["first".into(), "near".into(), "ego".into()], 2));
        // Without an ego the square is about the first present road user.
        let mut strangers = whole.clone();
        strangers.agents[3].role = None;
        assert_eq!(ids(crop.apply(strangers)).0, ["first"]);
        assert_eq!(ids(crop.about(whole.clone(), Some(3))).0, ["near", "corner", "ego"]);
        assert_eq!(ids(crop.about(whole.clone(), Some(0))).0, ["first"]);
        assert_eq!(ids(Crop::default().apply(whole)).1, 0);
    }

    #[test]
    fn too_few_leave_the_scene_out() {
        let mut whole = scene(vec![log("a", 5.0, 91), shifted(log("b", 5.0, 91), 0.0, 61.0)]);
        let least = |least_agents| Crop { side_m: None, least_agents };
        assert_eq!(ids(least(2).apply(whole.clone())).1, 0);
        assert_eq!(least(3).apply(whole.clone()), Cropped::TooFew(2));
        assert_eq!(Crop::PAPER.apply(whole.clone()), Cropped::TooFew(1));
        whole.agents[1].agent_type = AgentType::Other;
        assert_eq!(least(2).apply(whole), Cropped::TooFew(1));
    }
}
