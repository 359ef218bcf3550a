//! The sentences of the checks of a map.

use scene::message::Word;

/// The vehicle that must be able to turn at a junction.
pub const BUS: Word = Word { code: "bus", english: "12 m bus" };
/// The vehicle that must be able to turn in a car park.
pub const CAR: Word = Word { code: "car", english: "5 m car" };

scene::messages! {
    lanes_lead() = "lanes-lead", "Every lane leads somewhere";
    lane_leads_nowhere(lane: &str) = "lane-leads-nowhere", "Lane {lane} leads nowhere";
    lane_unreached(lane: &str) = "lane-unreached", "No lane leads to lane {lane}";
    vehicle_turns(vehicle: Word) = "vehicle-turns", "A {vehicle} can turn";
    movement_tight(from: &str, to: &str, radius_m: f64, vehicle: Word, needed_m: f64) =
        "movement-tight",
        "{from} to {to} is too tight: radius {radius_m:.1} m, a {vehicle} needs {needed_m:.1} m";
    lane_tight(lane: &str, radius_m: f64, vehicle: Word, needed_m: f64) =
        "lane-tight", "Lane {lane} is too tight: radius {radius_m:.1} m, a {vehicle} needs {needed_m:.1} m";
    lanes_wide() = "lanes-wide", "Every lane is wide enough";
    lane_narrow(lane: &str, width_m: f64) = "lane-narrow", "Lane {lane} is {width_m:.1} m wide";
    greens_apart() = "greens-apart", "No two conflicting movements have green at the same time";
    greens_conflict(first: &str, second: &str) =
        "greens-conflict", "{first} and {second} conflict and have green at the same time";
}
