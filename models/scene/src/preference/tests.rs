use super::*;
use crate::judge::{Manoeuvre, RelationKind};
use crate::score::tests::straight;
use crate::{AgentFutures, AgentType, Future, LaneMap, Sample, Scene, State};

/// Futures of one road user straight ahead, one per speed, a lane's width apart for each of `aside`.
fn scene_with(speeds: &[f64]) -> (Scene, Vec<Sample>) {
    let scene = Scene::bare(
        "",
        LaneMap::default(),
        vec![crate::Agent::bare("1", AgentType::Vehicle, crate::Subtype::Car, vec![Some(State::default())])],
    );
    let future = |speed: &f64| {
        let actor = straight("1", AgentType::Vehicle, (0.0, 0.0), 0.0, *speed);
        Future::bare(1.0, 1, actor.track.states.iter().take(90).filter_map(|s| *s).collect())
    };
    let modes = speeds.iter().map(future).collect();
    let agents = [("1".to_owned(), AgentFutures::of(0, modes))].into();
    (scene, vec![Sample { agents, ..Sample::default() }])
}

fn candidates(speeds: &[f64]) -> Vec<Candidate> {
    let (scene, samples) = scene_with(speeds);
    Candidate::futures(&scene, &samples, "1")
}

fn paces(count: usize) -> Vec<f64> {
    (0..count).map(|i| 2.0 + 0.5 * i as f64).collect()
}

fn judged(pool: &[Candidate], keep: impl Fn(f64) -> Option<bool>) -> Feedback {
    let answer = |candidate: &Candidate| {
        let verdict = if keep(candidate.features.pace_mps)? { Verdict::Keep } else { Verdict::Reject };
        Some(candidate.judged(verdict, None))
    };
    Feedback { answers: pool.iter().filter_map(answer).collect(), ..Feedback::default() }
}

#[test]
fn features_say_what_a_motion_is_like() {
    let (mut scene, mut samples) = scene_with(&[8.0]);
    scene.agents[0].track.states = (0..91).map(|_| Some(State::default())).collect();
    let future = &mut samples[0].agents.get_mut("1").unwrap().modes[0];
    let relation = |kind, with: &str, gap_s| crate::judge::Relation {
        kind,
        with: with.into(),
        time_s: 1.0,
        x_m: 0.0,
        y_m: 0.0,
        gap_s,
    };
    future.about.relations = vec![
        relation(RelationKind::Before, "2", Some(1.5)),
        relation(RelationKind::GivesWayTo, "3", None),
        relation(RelationKind::Follows, "4", Some(2.5)),
    ];
    future.about.manoeuvre = Some(Manoeuvre::Left);
    let features = Features::of(&scene, [("1", &*future)].into_iter());
    assert!(
        (features.pace_mps - 8.0).abs() < 1e-9
            && features.harshness_mps2 < 1e-9
            && features.standing_s == 0.0
    );
    assert_eq!(features.gap_s, 1.5);
    assert!(features.from_log_m.unwrap() > 30.0);
    let value = |of: Trait| features.value(&of).unwrap();
    let first = |with: &str| Trait::First { who: "1".into(), with: with.into() };
    assert_eq!([first("2"), first("3"), first("4")].map(value), [1.0, -1.0, 0.0]);
    let does = |manoeuvre| Trait::Does { who: "1".into(), manoeuvre };
    assert_eq!([does(Manoeuvre::Left), does(Manoeuvre::Right)].map(value), [1.0, -1.0]);
}

#[test]
fn the_first_round_leads_with_the_first_guess_and_shows_what_there_is() {
    let pool = candidates(&paces(30));
    let round = choose(&pool, &Feedback::default(), 6, 4);
    assert_eq!(round.taken.len(), 6);
    assert!(round.taken.contains(&0) && round.wishes.is_empty());
    assert!((round.shares.iter().sum::<f64>() - 1.0).abs() < 1e-9);
    assert!(round.cards.iter().all(|card| card.fulfils.is_none()));
    // 0.5 m/s is 4.5 m in the end: all differ, and no motion occurs twice.
    let mut taken = round.taken.clone();
    taken.sort_unstable();
    taken.dedup();
    assert_eq!(taken.len(), 6);
    assert_eq!(choose(&pool, &Feedback::default(), 6, 4), round);
    assert_ne!(choose(&pool, &Feedback::default(), 6, 5).taken, round.taken);
}

#[test]
fn what_was_kept_is_liked_and_a_liking_may_have_its_top_in_the_middle() {
    let pool = candidates(&paces(30));
    let draw: Vec<&Features> = pool.iter().map(|c| &c.features).collect();
    let best = |feedback: &Feedback| {
        let taste = Taste::learn(feedback, &draw);
        let likings = draw.iter().map(|features| (taste.liking(features), features.pace_mps));
        likings.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap().1
    };
    let fast = judged(&pool, |pace| (pace as usize).is_multiple_of(2).then_some(pace > 11.0));
    assert!(best(&fast) > 14.0);
    let middling =
        judged(&pool, |pace| (pace as usize).is_multiple_of(2).then_some((8.0..11.0).contains(&pace)));
    assert!((7.5..11.5).contains(&best(&middling)), "{}", best(&middling));
}

#[test]
fn a_wish_is_told_when_three_answers_agree_twice_over() {
    let pool = candidates(&paces(30));
    let wishes = |feedback: &Feedback| choose(&pool, feedback, 6, 1).wishes;
    let mut feedback = judged(&pool[..1], |_| Some(false));
    feedback.answers.push(pool[20].judged(Verdict::Keep, None));
    assert!(wishes(&feedback).is_empty());
    feedback.answers.push(pool[24].judged(Verdict::Keep, None));
    let told = wishes(&feedback);
    let pace = told.iter().find(|learned| learned.wish.of == Trait::Pace).unwrap();
    assert_eq!(
        (pace.wish.wants, pace.said, pace.kept, pace.rejected),
        (WishDirection::More, false, Some((12.0, 14.0)), Some((2.0, 2.0)))
    );
    assert!(pace.strength > 0.2 && pace.strength <= 1.0 && pace.against.is_empty());
    // One contradicting answer is named; a second one withdraws the wish.
    feedback.answers.push(pool[1].judged(Verdict::Keep, None));
    assert_eq!(wishes(&feedback)[0].against, [3]);
    feedback.answers.push(pool[29].judged(Verdict::Reject, None));
    assert!(wishes(&feedback).iter().all(|learned| learned.wish.of != Trait::Pace));
}

#[test]
fn what_is_said_counts_and_what_is_forgotten_does_not() {
    let pool = candidates(&paces(30));
    let pace = |round: &Round| {
        let all = round.cards.iter().map(|card| card.features.pace_mps);
        all.clone().sum::<f64>() / all.count() as f64
    };
    let wants = |wants| Wish { of: Trait::Pace, wants };
    let said = |way| choose(&pool, &Feedback { wishes: vec![wants(way)], ..Feedback::default() }, 6, 2);
    let (fast, slow) = (said(WishDirection::More), said(WishDirection::Less));
    assert!(pace(&fast) > pace(&slow) + 3.0);
    assert!(
        fast.wishes[0].said && fast.cards[0].fulfils == Some(1.0) && slow.cards[0].features.pace_mps < 5.0
    );
    let mut feedback = judged(&pool[..8], |_| Some(false));
    feedback.answers.extend(judged(&pool[20..], |_| Some(true)).answers);
    assert!(!choose(&pool, &feedback, 6, 2).wishes.is_empty());
    feedback.forgotten = vec![Trait::Pace];
    let forgotten = choose(&pool, &feedback, 6, 2);
    assert!(forgotten.wishes.iter().all(|learned| learned.wish.of != Trait::Pace));
    // A reason is an answer too.
    let mut why = judged(&pool[14..16], |_| Some(false));
    let draw: Vec<&Features> = pool.iter().map(|c| &c.features).collect();
    let leaning = |feedback: &Feedback| Taste::learn(feedback, &draw).leaning(&Trait::Pace);
    let before = leaning(&why);
    why.answers[0].why = Some(wants(WishDirection::More));
    let once = leaning(&why);
    why.answers[1].why = Some(wants(WishDirection::More));
    assert!(before < once && once < leaning(&why));
}

#[test]
fn nothing_that_was_judged_comes_again_and_no_rule_is_broken_where_others_keep_it() {
    let mut pool = candidates(&paces(30));
    let feedback = judged(&pool, |pace| (pace > 4.0 && pace < 14.0).then_some(pace > 9.0));
    let round = choose(&pool, &feedback, 6, 3);
    assert!(
        round.cards.iter().all(|card| !(4.1..13.9).contains(&card.features.pace_mps)),
        "{:?}",
        round.taken
    );
    // A fully judged draw gives no more cards.
    let all = judged(&pool, |_| Some(true));
    assert!(choose(&pool, &all, 6, 3).cards.is_empty());
    pool.iter_mut().step_by(2).for_each(|candidate| candidate.break_a_rule());
    let round = choose(&pool, &Feedback::default(), 6, 3);
    assert!(round.taken.iter().all(|i| i % 2 == 1));
}

#[test]
fn several_together_are_one_card() {
    let (scene, samples) = scene_with(&[4.0, 9.0]);
    let mut other = samples[0].clone();
    other.agents.get_mut("1").unwrap().chosen = 1;
    let pool = Candidate::scenes(&scene, &[samples[0].clone(), other]);
    let paces: Vec<f64> = pool.iter().map(|c| c.features.pace_mps).collect();
    assert!((paces[0] - 4.0).abs() < 1e-9 && (paces[1] - 9.0).abs() < 1e-9);
    assert!(pool.iter().all(|c| c.mode.is_none()));
}
