//! Selectors of road users: ids, or words for sets of them.

use scene::{AgentType, STANDING_MPS, Scene};
use std::str::FromStr;

/// A selector of road users.
#[derive(Clone, Debug, PartialEq)]
pub enum AgentSelector {
    /// All road users that can be generated.
    All,
    /// Road users that move at the start.
    Moving,
    /// Road users of this type that are present at the start.
    Kind(AgentType),
    /// The recording vehicle.
    Ego,
    /// No road user.
    Nobody,
    /// The road user with this id.
    Id(String),
}

const WORDS: &str = "@all, @moving, @vehicles, @pedestrians, @cyclists, @ego, @none";

impl FromStr for AgentSelector {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "@all" | "all" => Ok(Self::All),
            "@moving" => Ok(Self::Moving),
            "@vehicles" => Ok(Self::Kind(AgentType::Vehicle)),
            "@pedestrians" => Ok(Self::Kind(AgentType::Pedestrian)),
            "@cyclists" => Ok(Self::Kind(AgentType::Cyclist)),
            "@ego" => Ok(Self::Ego),
            "@none" => Ok(Self::Nobody),
            _ if text.starts_with('@') => Err(format!("an id or one of {WORDS} expected")),
            "" => Err("an id expected".into()),
            id => Ok(Self::Id(id.to_owned())),
        }
    }
}

/// The ids that these selectors match in a scene, each once, in the order of the scene. Plain ids pass
/// through, known or not. `None` for all.
///
/// # Errors
/// A sentence about a selector that matches no road user.
pub fn ids(who: &[AgentSelector], scene: &Scene, start_step: usize) -> Result<Option<Vec<String>>, String> {
    let mut ids: Vec<String> = Vec::new();
    for who in who {
        let there = scene.agents.iter().filter(|agent| agent.kind() != AgentType::Other);
        let meant: Vec<String> = match who {
            AgentSelector::All => return Ok(None),
            AgentSelector::Nobody => continue,
            AgentSelector::Id(id) => vec![id.clone()],
            _ => there
                .filter(|agent| who.means(scene, agent, start_step))
                .map(|agent| agent.id.clone())
                .collect(),
        };
        if meant.is_empty() {
            return Err(format!("no road user of the scene is {}", who.words()));
        }
        for id in meant {
            if !ids.contains(&id) {
                ids.push(id);
            }
        }
    }
    Ok(Some(ids))
}

/// The road users of a scene that are present at the start and match these selectors, separately. An id that
/// the scene does not have matches nobody.
pub fn actors(of: &[AgentSelector], scene: &Scene, start_step: usize) -> Vec<String> {
    let mut all: Vec<String> = Vec::new();
    for selector in of {
        let everybody = || scene.agents.iter().map(|agent| agent.id.clone()).collect();
        let meant = ids(std::slice::from_ref(selector), scene, start_step).unwrap_or(Some(Vec::new()));
        for id in meant.unwrap_or_else(everybody) {
            let there = scene.agent(&id).is_some_and(|agent| {
                agent.kind() != AgentType::Other && scene.shown(agent).track.at(start_step).is_some()
            });
            if there && !all.contains(&id) {
                all.push(id);
            }
        }
    }
    all
}

impl AgentSelector {
    fn means(&self, scene: &Scene, agent: &scene::Agent, start_step: usize) -> bool {
        let shown = scene.shown(agent);
        let Some(state) = shown.track.at(start_step) else { return false };
        match self {
            Self::All => true,
            Self::Moving => state.speed_mps() > STANDING_MPS,
            Self::Kind(kind) => shown.agent_type == *kind,
            Self::Ego => agent.role.as_deref() == Some("ego"),
            Self::Nobody => false,
            Self::Id(id) => agent.id == *id,
        }
    }

    fn words(&self) -> String {
        match self {
            Self::All => "there".into(),
            Self::Moving => "moving at the start".into(),
            Self::Kind(AgentType::Pedestrian) => "a pedestrian at the start".into(),
            Self::Kind(AgentType::Cyclist) => "a cyclist at the start".into(),
            Self::Kind(_) => "a vehicle at the start".into(),
            Self::Ego => "the ego".into(),
            Self::Nobody => "none".into(),
            Self::Id(id) => format!("\"{id}\""),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::{Agent, LaneMap, State, Subtype};

    #[test]
    fn words_mean_road_users_of_the_scene() {
        let at = |speed: f64| vec![Some(State { vx_mps: speed, ..State::default() })];
        let agents = vec![
            Agent::bare("car", AgentType::Vehicle, Subtype::Car, at(5.0)),
            Agent::bare("parked", AgentType::Vehicle, Subtype::Car, at(0.0)),
            Agent::bare("walker", AgentType::Pedestrian, Subtype::Adult, at(1.0)),
            Agent::bare("late", AgentType::Cyclist, Subtype::Bicycle, vec![None, Some(State::default())]),
        ];
        let scene = Scene::bare("test", LaneMap::default(), agents);
        let meant = |words: &[&str]| {
            let who: Vec<AgentSelector> = words.iter().map(|word| word.parse().unwrap()).collect();
            ids(&who, &scene, 0)
        };
        let some = |ids: &[&str]| Some(ids.iter().map(|id| (*id).to_owned()).collect::<Vec<_>>());
        assert_eq!(meant(&["@moving"]).unwrap(), some(&["car", "walker"]));
        assert_eq!(meant(&["walker", "@vehicles"]).unwrap(), some(&["walker", "car", "parked"]));
        assert_eq!(meant(&["car", "@all"]).unwrap(), None);
        let nobody = "no road user of the scene is a cyclist at the start";
        assert_eq!(meant(&["@cyclists"]).unwrap_err(), nobody);
        assert!("@everybody".parse::<AgentSelector>().unwrap_err().contains("@moving"));
    }
}
