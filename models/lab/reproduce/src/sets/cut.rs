//! Cuts one scene into the squares of one interval.

use super::{Centre, SetCounts, SetOptions};
use lab_train::scenes::{Crop, Cropped, stretch};
use scene::{Agent, HORIZON_STEPS, Scene};

/// Least distance that an evaluated road user moves from its start, metres: a standing one gives no
/// information.
const MOVES_M: f64 = 2.0;

/// A square of one interval, with up to 9 s of the recording from its start.
#[derive(Clone, Debug)]
pub struct Cut {
    /// Road users of the square on the whole map.
    pub scene: Scene,
    /// First step in the recording.
    pub start: usize,
    /// Id of the road user in the middle, unless it is the ego.
    pub middle: Option<String>,
    /// Indices of the road users for training or evaluation.
    pub judged: Vec<usize>,
    /// Standing road users of the same type: some are used for training, none for evaluation.
    pub standing: Vec<usize>,
}

impl Cut {
    /// Whether the recording covers the whole 9 s.
    pub fn is_whole(&self) -> bool {
        self.scene.time.steps > HORIZON_STEPS
    }

    /// The interval only, on which Table I is measured.
    pub fn interval(&self, steps: usize) -> Scene {
        stretch(&self.scene, 0, steps)
    }
}

/// First steps of the whole intervals of a recording.
pub(super) fn starts(scene: &Scene, options: &SetOptions) -> impl Iterator<Item = usize> + use<> {
    let (every, steps) = (options.interval_steps.max(1), scene.time.steps);
    (0..).map(move |i| i * every).take_while(move |start| start + every < steps)
}

/// All squares of a scene about one kind of centre, in the order of time and of road users.
pub(super) fn cases(scene: &Scene, centre: Centre, options: &SetOptions, counts: &mut SetCounts) -> Vec<Cut> {
    let mut out = Vec::new();
    for start in starts(scene, options) {
        out.extend(cases_at(scene, centre, start, None, options, counts));
    }
    out
}

/// The squares of one interval, or only the square about one road user.
pub(super) fn cases_at(
    scene: &Scene,
    centre: Centre,
    start: usize,
    about: Option<&str>,
    options: &SetOptions,
    counts: &mut SetCounts,
) -> Vec<Cut> {
    let window = stretch(scene, start, HORIZON_STEPS);
    let known = |agent: &Agent| agent.agent_type == centre.judged() && is_known(agent, options);
    let judged = |agent: &Agent| known(agent) && moves(agent, options);
    let middles: Vec<Option<usize>> = match centre {
        Centre::Ego => vec![None],
        Centre::Pedestrian | Centre::Cyclist => {
            let all = window.agents.iter().enumerate();
            let wanted = all.filter(|(_, a)| judged(a) && about.is_none_or(|id| id == a.id));
            wanted.map(|(i, _)| Some(i)).collect()
        }
    };
    let crop = Crop { side_m: Some(options.crop.side_m.unwrap_or(f64::INFINITY)), ..options.crop };
    let mut out = Vec::new();
    for middle in middles {
        counts.squares += 1;
        let id = middle.map(|i| window.agents[i].id.clone());
        let Cropped::Kept(square, _) = crop.about(window.clone(), middle) else {
            counts.too_few += 1;
            continue;
        };
        let all = square.agents.iter().enumerate();
        let own = all.filter(|(_, a)| judged(a) && id.as_ref().is_none_or(|id| *id == a.id));
        let judged: Vec<usize> = own.map(|(i, _)| i).collect();
        if judged.is_empty() {
            counts.nobody += 1;
            continue;
        }
        let stands = |(_, a): &(usize, &Agent)| known(a) && !moves(a, options);
        let standing = square.agents.iter().enumerate().filter(stands).map(|(i, _)| i).collect();
        out.push(Cut { scene: *square, start, middle: id, judged, standing });
    }
    out
}

/// Whether it is present at the first frame and at the interval's end, and known for long enough between.
fn is_known(agent: &Agent, options: &SetOptions) -> bool {
    let ends = [0, options.interval_steps].iter().all(|step| agent.track.at(*step).is_some());
    ends && agent.track.valid_steps().filter(|s| (1..=options.interval_steps).contains(s)).count()
        >= options.least_frames
}

fn moves(agent: &Agent, options: &SetOptions) -> bool {
    let Some(start) = agent.state_at(0) else { return false };
    let mut way = agent.track.valid_steps().filter(|s| *s <= options.interval_steps);
    way.any(|s| agent.state_at(s).is_some_and(|q| (q.position() - start.position()).norm() > MOVES_M))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::{options, walker};
    use lab_train::samples::{log, scene, shifted};

    fn long() -> Scene {
        let mut ego = log("ego", 5.0, 200);
        ego.role = Some("ego".into());
        let far = shifted(log("far", 5.0, 200), 90.0, 0.0);
        let mut gone = shifted(log("gone", 5.0, 200), 20.0, 3.5);
        gone.track.states[60] = None;
        let stands = shifted(log("stands", 0.0, 200), 10.0, 3.5);
        let mut scene =
            scene(vec![ego, far, gone, stands, walker("w", 1.2, (4.0, 6.0)), walker("v", 1.1, (8.0, 6.0))]);
        scene.time.steps = 200;
        scene
    }

    #[test]
    fn intervals_follow_each_other_and_squares_lie_about_their_centres() {
        let mut counts = SetCounts::default();
        let cut = cases(&long(), Centre::Ego, &options(), &mut counts);
        // 20 s: three whole intervals of 6 s, and 2 s are left.
        assert_eq!(cut.iter().map(|c| c.start).collect::<Vec<_>>(), [0, 60, 120]);
        assert_eq!((counts.squares, counts.too_few, counts.nobody), (3, 0, 0));
        // The road user 90 m ahead is outside; one that is missing at the end is not evaluated, nor is a
        // standing one.
        let judged = |cut: &Cut| -> Vec<String> {
            cut.judged.iter().map(|i| cut.scene.agents[*i].id.clone()).collect()
        };
        assert_eq!(judged(&cut[0]), ["ego"]);
        assert_eq!(cut[0].scene.agents[cut[0].standing[0]].id, "stands");
        // In the second it is absent at the first frame; in the third it is always present.
        assert_eq!(
            (judged(&cut[1]), judged(&cut[2])),
            (vec!["ego".into()], vec!["ego".into(), "gone".into()])
        );
        assert!(cut[0].is_whole() && cut[1].is_whole() && !cut[2].is_whole());
        assert_eq!(cut[2].interval(60).time.steps, 61);
        let walkers = cases(&long(), Centre::Pedestrian, &options(), &mut counts);
        assert_eq!(walkers.len(), 6);
        assert!(walkers.iter().all(|c| c.judged.len() == 1));
        assert!(cases(&long(), Centre::Cyclist, &options(), &mut counts).is_empty());
    }

    #[test]
    fn squares_with_too_few_are_counted_and_left_out() {
        let mut counts = SetCounts::default();
        let options = SetOptions { crop: Crop::PAPER, ..options() };
        assert!(cases(&long(), Centre::Ego, &options, &mut counts).is_empty());
        assert_eq!((counts.squares, counts.too_few), (3, 3));
    }
}
