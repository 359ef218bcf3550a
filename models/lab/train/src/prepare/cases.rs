//! Records of chosen road users of a scene, for sets of cases that are defined elsewhere.

use super::record;
use crate::polylines::Polylines;
use crate::provenance::Provenance;
use crate::scenes::place_key;
use crate::training::{Record, RecordWriter, TrainError};
use experts::planning::world::World;
use scene::random::{Key, Stream};
use scene::routes::LaneGraph;
use scene::{Agent, Goal, HORIZON_STEPS, STEP_S, Scene};
use std::sync::Arc;

/// First step at which an end may be drawn.
const EARLIEST: usize = 20;

/// Conditions of the road users of a record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CaseCondition {
    /// Nothing.
    Nothing,
    /// Position, speed and heading of the end. Half of the records use this step, a quarter the last known one, the
    /// others any step from 2 s on. In half of them the ends of some others are fixed too.
    End(usize),
}

/// Records of some road users of one scene.
pub struct CaseRecords {
    key: u64,
    provenance: Provenance,
    polylines: Polylines,
    records: Vec<Record>,
}

impl CaseRecords {
    /// The records of these road users, each with `draws` drawn conditions.
    pub fn new(scene: &Scene, agents: &[usize], asked: CaseCondition, draws: usize, seed: u64) -> Self {
        let mut provenance = Provenance::default();
        provenance.add(scene);
        let mut out = Self {
            key: place_key(scene),
            provenance,
            polylines: Polylines::new(&scene.map),
            records: Vec::new(),
        };
        let graph = Arc::new(LaneGraph::new(&scene.map));
        let free = World::new(scene, graph.clone(), 0);
        for &index in agents {
            let id = scene.agents[index].id.as_str();
            let mut draw = Key::default().number(seed).words(&["ends", &scene.name, id]).stream();
            for _ in 0..draws {
                let record = match asked {
                    CaseCondition::Nothing => record::record(&free, &out.polylines, index),
                    CaseCondition::End(step) => {
                        let mut conditions = free.conditions.clone();
                        conditions[index].goal = end(&mut draw, &scene.agents[index], step);
                        if draw.chance(0.5) {
                            let share = draw.unit();
                            for (i, other) in scene.agents.iter().enumerate().filter(|(i, _)| *i != index) {
                                if draw.chance(share) {
                                    conditions[i].goal = end(&mut draw, other, step);
                                }
                            }
                        }
                        let world = World::with_conditions(scene, graph.clone(), 0, conditions);
                        record::record(&world, &out.polylines, index)
                    }
                };
                out.records.extend(record);
            }
        }
        out
    }

    /// Number of records.
    pub fn count(&self) -> usize {
        self.records.len()
    }

    /// Adds them to a file.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn write(&self, writer: &mut RecordWriter) -> Result<(), TrainError> {
        if self.records.is_empty() {
            return Ok(());
        }
        writer.comes_from(&self.provenance);
        writer.scene(self.key, &self.polylines.pieces, &self.records)
    }
}

/// The whole state at a step of the recording as a goal; free if the track is too short.
fn end(draw: &mut Stream, agent: &Agent, step: usize) -> Goal {
    let known: Vec<usize> =
        agent.track.valid_steps().filter(|s| (EARLIEST..=HORIZON_STEPS).contains(s)).collect();
    let (choice, any) = (draw.unit(), draw.unit());
    let Some(&last) = known.last() else { return Goal::default() };
    let step = match choice {
        c if c < 0.5 && known.contains(&step) => step,
        c if c < 0.75 => last,
        _ => known[((any * known.len() as f64) as usize).min(known.len() - 1)],
    };
    let Some(state) = agent.state_at(step) else { return Goal::default() };
    Goal {
        position: Some(state.position()),
        heading_rad: Some(state.heading_rad),
        speed_mps: Some(state.speed_mps()),
        time_s: Some(step as f64 * STEP_S),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::{log, scene, shifted};
    use experts::features::OWN_GOAL_POSITION;

    #[test]
    fn ends_are_whole_and_mostly_where_they_are_asked_for() {
        let (agent, mut draw) = (log("a", 8.0, 91), Key::default().number(1).stream());
        let goals: Vec<Goal> = (0..400).map(|_| end(&mut draw, &agent, 60)).collect();
        assert!(
            goals.iter().all(|g| g.position.is_some() && g.heading_rad.is_some() && g.speed_mps.is_some())
        );
        let at = |time_s: f64| goals.iter().filter(|g| g.time_s == Some(time_s)).count();
        assert!((170..240).contains(&at(6.0)) && (70..140).contains(&at(9.0)), "{} {}", at(6.0), at(9.0));
        assert!(end(&mut draw, &log("b", 8.0, 15), 60).is_free());
    }

    #[test]
    fn records_repeat_and_free_ones_ask_for_nothing() {
        let scene = scene(vec![log("a", 8.0, 91), shifted(log("b", 5.0, 91), 30.0, 3.5)]);
        let of = |asked, seed| CaseRecords::new(&scene, &[0, 1], asked, 2, seed);
        let own = |records: &CaseRecords| -> Vec<_> { records.records.iter().map(|r| r.agent.own).collect() };
        assert_eq!(of(CaseCondition::End(60), 1).count(), 4);
        assert_eq!(own(&of(CaseCondition::End(60), 1)), own(&of(CaseCondition::End(60), 1)));
        assert_ne!(own(&of(CaseCondition::End(60), 1)), own(&of(CaseCondition::End(60), 2)));
        assert!(own(&of(CaseCondition::Nothing, 1)).iter().all(|own| own[OWN_GOAL_POSITION] == 0.0));
        assert!(own(&of(CaseCondition::End(60), 1)).iter().all(|own| own[OWN_GOAL_POSITION] == 1.0));
    }
}
