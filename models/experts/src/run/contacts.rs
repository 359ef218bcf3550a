//! The faults of one step: boxes that begin to overlap, and corners that leave the road.

use crate::tuning::fixed::run::PAST_EDGE_M;
use scene::geometry::obb::{OrientedBox, overlaps};
use scene::judge::{Fault, FaultKind};
use scene::routes::LaneGraph;
use scene::{AgentId, AgentType, Size, State, Vec2};

/// A fault and its road user.
#[derive(Clone, Debug, PartialEq)]
pub struct RunFault {
    /// In a collision, the one that drove into the other: its own velocity closes the gap more.
    pub agent: AgentId,
    /// The fault, with time and place.
    pub fault: Fault,
}

/// A road user at the end of a step, and at its beginning if it was present then.
pub(super) struct Stepped<'a> {
    pub(super) id: &'a AgentId,
    pub(super) agent_type: AgentType,
    pub(super) size: Size,
    pub(super) now: State,
    pub(super) before: Option<State>,
}

impl Stepped<'_> {
    fn outline(&self, state: &State) -> OrientedBox {
        OrientedBox::of_state(state, &self.size)
    }
}

/// Faults that begin in a step that ends at this scene time.
pub(super) fn faults(stepped: &[Stepped<'_>], time_s: f64, graph: &LaneGraph) -> Vec<RunFault> {
    let boxes: Vec<OrientedBox> = stepped.iter().map(|s| s.outline(&s.now)).collect();
    let mut found = Vec::new();
    for (i, a) in stepped.iter().enumerate() {
        for (j, b) in stepped.iter().enumerate().skip(i + 1) {
            let met = overlaps(&boxes[i], &boxes[j], 0.0);
            let met_before = || match (&a.before, &b.before) {
                (Some(p), Some(q)) => overlaps(&a.outline(p), &b.outline(q), 0.0),
                _ => false,
            };
            if met && !met_before() {
                found.push(collision(a, b, time_s));
            }
        }
        found.extend(off_road(a, &boxes[i], time_s, graph));
    }
    found
}

fn collision(a: &Stepped<'_>, b: &Stepped<'_>, time_s: f64) -> RunFault {
    let closes = |own: &Stepped<'_>, other: &Stepped<'_>| {
        let apart = other.now.position() - own.now.position();
        own.now.velocity().dot(&apart) / apart.norm().max(1e-6)
    };
    let (by_a, by_b) = (closes(a, b), closes(b, a));
    let (own, other) = if by_b > by_a { (b, a) } else { (a, b) };
    let fault = fault(FaultKind::Collision, time_s, own.now.position(), (by_a + by_b).max(0.0));
    RunFault { agent: own.id.clone(), fault: Fault { with: Some(other.id.clone()), ..fault } }
}

fn off_road(own: &Stepped<'_>, outline: &OrientedBox, time_s: f64, graph: &LaneGraph) -> Option<RunFault> {
    let before = own.before.filter(|_| own.agent_type == AgentType::Vehicle)?;
    let past = |outline: &OrientedBox| graph.ground().box_outside_m(outline).unwrap_or(0.0);
    let past_m = past(outline);
    let leaves = past_m > PAST_EDGE_M && past(&own.outline(&before)) <= PAST_EDGE_M;
    leaves.then(|| RunFault {
        agent: own.id.clone(),
        fault: fault(FaultKind::OffRoad, time_s, own.now.position(), past_m),
    })
}

fn fault(kind: FaultKind, time_s: f64, at: Vec2, extent: f64) -> Fault {
    let extent = Some((extent * 1e3).round() / 1e3);
    Fault { kind, time_s, until_s: time_s, x_m: at.x, y_m: at.y, extent, with: None, edge: None }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::{LaneMap, Subtype};

    #[test]
    fn a_collision_is_told_once_and_is_that_of_who_drove_into_the_other() {
        let ids = ["a".to_owned(), "b".to_owned()];
        let at = |i: usize, x_m: f64, vx_mps: f64, before_m: f64| {
            let state = |x_m| State { x_m, vx_mps, ..State::default() };
            let size = Size::default_for(AgentType::Vehicle, Subtype::Car);
            let (now, before) = (state(x_m), Some(state(before_m)));
            Stepped { id: &ids[i], agent_type: AgentType::Vehicle, size, now, before }
        };
        let graph = LaneGraph::new(&LaneMap::default());
        let found = faults(&[at(0, 5.0, 2.0, 4.8), at(1, 1.0, 9.0, 0.0)], 3.0, &graph);
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!((found[0].agent.as_str(), found[0].fault.with.as_deref()), ("b", Some("a")));
        assert_eq!((found[0].fault.kind, found[0].fault.extent), (FaultKind::Collision, Some(7.0)));
        assert!(faults(&[at(0, 5.0, 2.0, 4.8), at(1, 1.0, 9.0, 0.9)], 3.0, &graph).is_empty(), "met before");
    }
}
