//! The drafts of all actors in one sample.

use super::actor::PlannedActor;
use super::candidates::Material;
use super::drafts::Drafts;
use super::others::Others;
use super::repulsion::SceneEnergy;
use super::window_setting::WindowSetting;
use crate::planning::MODES;
use crate::request::ShownLast;

/// Number of alternatives that are weighed beside the driven motion of a road user in a run. With all six, no
/// more road users reach their goals without a fault, and a step takes a third longer.
const ALTERNATIVES: usize = 3;
/// Number of these that are weighed first; the others follow only if the first are insufficient.
const FIRST_ALTERNATIVES: usize = 1;

/// The drafts of one sample, with the agents that they are compared with.
#[derive(Clone, Copy)]
pub(super) struct JointDrafts<'a> {
    pub(super) setting: &'a WindowSetting<'a>,
    pub(super) actors: &'a [PlannedActor],
    /// One entry per actor.
    pub(super) drafts: &'a [Drafts],
    pub(super) others: &'a Others<'a>,
    /// The sample, from 0.
    pub(super) sample: usize,
}

impl<'a> JointDrafts<'a> {
    /// Indices of the actors.
    pub(super) fn indices(&self) -> Vec<usize> {
        (0..self.actors.len()).collect()
    }

    /// The scene's energy.
    pub(super) fn energy(&self) -> SceneEnergy<'a> {
        SceneEnergy { pullback: &self.setting.pullback, tuning: &self.setting.tuning().overlaps }
    }

    /// The last shown future of an actor. It applies only to the first sample of the first window.
    pub(super) fn shown_last(&self, actor: &PlannedActor) -> Option<&'a ShownLast> {
        let first = self.sample == 0 && self.setting.number == 0;
        self.setting.request.shown.get(&actor.id).filter(|_| first)
    }

    /// The material of an actor's candidates.
    pub(super) fn material(&self, i: usize) -> Material<'a> {
        let (actor, drafts) = (&self.actors[i], &self.drafts[i]);
        let (setting, tuning) = (self.setting, &self.setting.tuning().middle);
        let under_way = setting.request.drives(&actor.id);
        let moves = setting.number > 0 || under_way;
        let goes_on = under_way || setting.request.under_way && actor.kept.is_some();
        let weighed = if goes_on { ALTERNATIVES } else { MODES };
        Material { actor, drafts, moves, tuning, shown: self.shown_last(actor), under_way, weighed }
    }

    /// The material of the candidates that are weighed first, and whether there are others.
    pub(super) fn first_material(&self, i: usize) -> (Material<'a>, bool) {
        let material = self.material(i);
        let saves = material.weighed < MODES;
        (Material { weighed: if saves { FIRST_ALTERNATIVES } else { material.weighed }, ..material }, saves)
    }
}
