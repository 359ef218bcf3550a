//! Provenance of training data: scenes pass it to records, and records to weights.

use scene::licence::{UNKNOWN, is_open, strictest};
use scene::{AgentType, Scene};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Licence of weights if the data have no terms.
const OWN: &str = "MIT OR Apache-2.0";

/// Sources of records.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Provenance {
    /// Name of the expert that the records are for.
    pub expert: String,
    /// Scenes by source and licence.
    pub scenes: BTreeMap<String, BTreeMap<String, u64>>,
}

impl Provenance {
    /// An empty provenance for an expert.
    pub fn of(agent_type: AgentType) -> Self {
        let expert = experts::weights::EXPERTS.iter().find(|(known, _)| *known == agent_type);
        Self { expert: expert.map(|(_, name)| (*name).to_owned()).unwrap_or_default(), ..Self::default() }
    }

    /// Counts a scene.
    pub fn add(&mut self, scene: &Scene) {
        let licence = scene.licence().unwrap_or_else(|| UNKNOWN.to_owned());
        let source = if scene.meta.source.is_empty() { UNKNOWN } else { &scene.meta.source };
        *self.scenes.entry(source.to_owned()).or_default().entry(licence).or_default() += 1;
    }

    /// Counts the scenes of other records.
    pub fn merge(&mut self, other: &Self) {
        for (source, licences) in &other.scenes {
            for (licence, count) in licences {
                *self.scenes.entry(source.clone()).or_default().entry(licence.clone()).or_default() += count;
            }
        }
    }

    /// Licence of weights that learned from it: the program's own if the data have no terms, otherwise the
    /// strictest of the data's.
    pub fn licence(&self) -> String {
        let of_data = strictest(self.scenes.values().flat_map(|l| l.keys().map(String::as_str)));
        of_data.filter(|licence| !is_open(licence)).unwrap_or_else(|| OWN.to_owned())
    }

    /// A description for the weights' header.
    pub fn words(&self) -> String {
        let one = |(source, licences): (&String, &BTreeMap<String, u64>)| {
            let parts: Vec<String> = licences
                .iter()
                .map(|(licence, count)| format!("{count} scenes of {source} ({licence})"))
                .collect();
            parts.join(", ")
        };
        self.scenes.iter().map(one).collect::<Vec<_>>().join(", ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::{log, scene};

    #[test]
    fn the_strictest_source_decides() {
        let of = |source: &str, licence: Option<&str>| {
            let mut scene = scene(vec![log("a", 8.0, 91)]);
            (scene.meta.source, scene.meta.licence) = (source.into(), licence.map(str::to_owned));
            let mut provenance = Provenance::of(AgentType::Vehicle);
            provenance.add(&scene);
            provenance
        };
        let mut all = of("synthetic", Some("cc0"));
        assert_eq!(all.licence(), OWN);
        all.merge(&of("womd", Some("waymo-nc")));
        all.merge(&of("womd", Some("waymo-nc")));
        assert_eq!((all.licence().as_str(), all.expert.as_str()), ("waymo-nc", "vehicle"));
        assert_eq!(all.words(), "1 scenes of synthetic (cc0), 2 scenes of womd (waymo-nc)");
        assert_eq!(of("drawn", None).licence(), UNKNOWN);
    }
}
