//! One line per road user: the goal met or missed, with distance and reason, the reactions with their causes, and the
//! faults of the shown future.

use super::GenerateArgs;
use super::made::MadeScene;
use crate::cli::Common;
use batch::engine::has_goal;
use experts::{Limiting, ReachReport, Resolved, Source as From, WarningCode};
use scene::judge::{Fault, FaultKind, Manoeuvre, Reaction, ReactionKind};
use scene::{AgentFutures, Future};

/// Number of faults that are named per future.
const MOST_FAULTS: usize = 3;
/// Goal errors below this are not printed, metres.
const NEAR_M: f64 = 0.005;

/// All lines of an answer, for the first sample. Road users with a goal come first, then those that react.
pub fn lines(made: &MadeScene, args: &GenerateArgs, common: &Common) -> Vec<String> {
    let mut lines: Vec<String> = made.casting.iter().map(|c| format!("template: {}", c.words)).collect();
    let sample = made.scene.generated.as_ref().and_then(|generated| generated.samples.first());
    let agents = sample.into_iter().flat_map(|sample| &sample.agents);
    let mut agents: Vec<_> = agents.filter(|(id, _)| !made.kept.contains(id)).collect();
    agents.sort_by_key(|(id, futures)| {
        (made.resolved.get(*id).and_then(goal).is_none(), futures.reaction.is_none())
    });
    let of_agents = agents.into_iter().map(|(id, f)| format!("{id}: {}", of_one(made.resolved.get(id), f)));
    lines.extend(common.listed(of_agents.collect(), "road users"));
    // Facts of earlier lines are not repeated.
    let warnings = made.warnings.iter().filter(|warning| warning.code != WarningCode::GoalUnreachable);
    let of_warnings = warnings.map(|warning| {
        let subject = warning.agent.as_deref().unwrap_or("scene");
        format!("{subject}: {}: {}", warning.code, warning.detail)
    });
    lines.extend(common.listed(of_warnings.collect(), "warnings"));
    lines.extend(latecomers(made, args));
    if made.all_samples > 1 {
        let kept = made.samples.len();
        lines.push(match &args.filter {
            Some(filter) => format!("{kept} of {} samples hold {}", made.all_samples, filter.text()),
            None => format!("{kept} samples; the lines are about the first"),
        });
    }
    lines.push(format!("code: {}", made.code));
    lines
}

/// One line about a road user.
pub fn of_one(resolved: Option<&Resolved>, futures: &AgentFutures) -> String {
    let mut parts = Vec::new();
    parts.extend(resolved.and_then(goal));
    parts.extend(futures.reaction.as_ref().map(reaction));
    if let Some(chosen) = futures.modes.get(futures.chosen) {
        parts.push(motion(chosen));
        parts.extend(
            chosen
                .about
                .faults
                .iter()
                .filter(|f| f.kind != FaultKind::GoalMissed)
                .take(MOST_FAULTS)
                .map(fault),
        );
    }
    parts.join("; ")
}

/// Whether the requested goal is met; `None` without a goal.
pub fn goal(resolved: &Resolved) -> Option<String> {
    let goal = &resolved.goal;
    if let ReachReport::Unreachable { limiting: Limiting::Relation, words, .. } = &resolved.reach {
        return Some(format!("goal not placed: {}", words.trim_end_matches('.')));
    }
    if !has_goal(resolved) {
        return None;
    }
    let placed = matches!(goal.x_m.from, From::User | From::Relation);
    let time_s = goal.time_s.value;
    Some(match &resolved.reach {
        ReachReport::Reached { position_m, .. } if placed && *position_m > NEAR_M => {
            format!("goal met at {time_s:.1} s, {position_m:.2} m off")
        }
        ReachReport::Reached { .. } => format!("goal met at {time_s:.1} s"),
        ReachReport::Unreachable { nearest, words, .. } => {
            let off_m = (nearest.x_m - goal.x_m.value).hypot(nearest.y_m - goal.y_m.value);
            let off = if placed { format!(" by {off_m:.1} m") } else { String::new() };
            format!("goal missed{off} at {time_s:.1} s: {}", words.trim_end_matches('.'))
        }
    })
}

fn reaction(reaction: &Reaction) -> String {
    let does = match reaction.kind {
        ReactionKind::Waits => "waits for",
        ReactionKind::Slows => "slows for",
        ReactionKind::SpeedsUp => "speeds up for",
        ReactionKind::KeepsClear => "keeps clear of",
        ReactionKind::StaysOut => {
            return format!("does not come in at {:.1} s: {} is there", reaction.time_s, reaction.cause);
        }
    };
    let delay = match reaction.delay_s {
        delay if delay >= 0.05 => format!(", {delay:.1} s later"),
        delay if delay <= -0.05 => format!(", {:.1} s earlier", -delay),
        _ => String::new(),
    };
    format!("{does} {}{delay}, {:.1} m/s at {:.1} s", reaction.cause, reaction.speed_mps, reaction.time_s)
}

fn motion(future: &Future) -> String {
    let does = match future.about.manoeuvre {
        Some(Manoeuvre::Straight) => "goes straight",
        Some(Manoeuvre::Left) => "turns left",
        Some(Manoeuvre::Right) => "turns right",
        Some(Manoeuvre::TurnRound) => "turns round",
        Some(Manoeuvre::LaneLeft) => "changes lane to the left",
        Some(Manoeuvre::LaneRight) => "changes lane to the right",
        Some(Manoeuvre::Stays) => return "stays".into(),
        Some(Manoeuvre::Reverse) => "reverses",
        None => "goes",
    };
    let gone: f64 =
        future.states.windows(2).map(|pair| (pair[1].position() - pair[0].position()).norm()).sum();
    let speed = future.states.last().map_or(0.0, scene::State::speed_mps);
    format!("{does}, {gone:.0} m, {speed:.1} m/s at the end")
}

fn fault(fault: &Fault) -> String {
    let what = match fault.kind {
        FaultKind::Collision => "collides",
        FaultKind::RedLight => "runs a red light",
        FaultKind::WrongWay => "drives against the traffic",
        FaultKind::OverMedian => "drives over a median",
        FaultKind::OffRoad => "leaves the road",
        FaultKind::OffMap => "leaves the map",
        FaultKind::OnCarriageway => "walks on the carriageway",
        FaultKind::Speeding => "exceeds the speed limit",
        FaultKind::HarshBraking => "brakes hard",
        FaultKind::HarshSteering => "steers hard",
        FaultKind::Running => "runs",
        FaultKind::Askew => "ends askew",
        FaultKind::FailsToYield => "does not give way at the crosswalk",
        FaultKind::ForcesBraking => "forces hard braking",
        FaultKind::NearMiss => "nearly collides",
        FaultKind::ViaMissed => "misses a via point",
        FaultKind::GoalMissed => "misses its goal",
    };
    let preposition = match fault.kind {
        FaultKind::FailsToYield => "to",
        FaultKind::ForcesBraking => "of",
        _ => "with",
    };
    let with = fault.with.as_ref().map_or_else(String::new, |with| format!(" {preposition} {with}"));
    format!("{what}{with} at {:.1} s", fault.time_s)
}

/// Counts the road users that enter later and replay the recording, in a scene that is generated completely:
/// the recording does not react to the generated motion.
fn latecomers(made: &MadeScene, args: &GenerateArgs) -> Option<String> {
    let whole = args.agents.is_empty() && args.react.is_empty() && made.casting.is_none();
    let samples = made.scene.generated.iter().flat_map(|generated| &generated.samples);
    let start = args.start_step();
    let late = |agent: &&scene::Agent| {
        agent.state_at(start).is_none()
            && agent.track.last_valid_step() > Some(start)
            && !samples.clone().any(|sample| sample.agents.contains_key(&agent.id))
    };
    let count = made.scene.agents.iter().filter(late).count();
    (whole && count > 0).then(|| entering(count))
}

/// Number of road users that enter later, as text.
fn entering(count: usize) -> String {
    match count {
        1 => "1 road user enters later and replays the recording; --react lets it react".into(),
        _ => format!("{count} road users enter later and replay the recording; --react lets them react"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reactions_and_faults_are_sentences() {
        let waits = Reaction {
            kind: ReactionKind::Waits,
            cause: "6".into(),
            delay_s: 2.26,
            time_s: 3.1,
            x_m: 0.0,
            y_m: 0.0,
            speed_mps: 0.0,
        };
        assert_eq!(reaction(&waits), "waits for 6, 2.3 s later, 0.0 m/s at 3.1 s");
        let hurries = Reaction { kind: ReactionKind::SpeedsUp, delay_s: -0.5, speed_mps: 9.0, ..waits };
        assert_eq!(reaction(&hurries), "speeds up for 6, 0.5 s earlier, 9.0 m/s at 3.1 s");
        let near = Fault {
            kind: FaultKind::NearMiss,
            time_s: 1.2,
            until_s: 1.4,
            x_m: 0.0,
            y_m: 0.0,
            extent: Some(0.3),
            with: Some("7".into()),
            edge: None,
        };
        assert_eq!(fault(&near), "nearly collides with 7 at 1.2 s");
        assert_eq!(entering(1), "1 road user enters later and replays the recording; --react lets it react");
        assert!(entering(2).starts_with("2 road users enter later and replay the recording"));
    }
}
