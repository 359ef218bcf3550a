//! Values of the flags about single road users: goals, starts, sizes.

use crate::cli::values::{number, within};
use api::generate::request::more_than_a_turn;
use formats::native::{
    GoalDoc, GoalFrame, GoalRelationDoc, MAX_COORDINATE_M, MAX_GOAL_DISTANCE_M, StartDoc, ViaDoc,
};
use scene::relation::{AFTER_S, GAP_M, GAP_S, LANES_LEFT, SLOWER_MPS};

/// Highest speed of a condition, m/s.
const FASTEST_MPS: f64 = 60.0;
/// Largest angle of a condition: a full turn, radians.
const ANGLE_RAD: f64 = api::generate::request::MOST_ANGLE_RAD;
/// Latest time of a goal, seconds.
const LATEST_S: f64 = 80.0;

/// A goal and its frame of reference.
#[derive(Clone, Debug, PartialEq)]
pub struct AskedGoal {
    /// The goal.
    pub goal: GoalDoc,
    /// Its frame: the scene, or the start pose.
    pub frame: GoalFrame,
}

/// One key of a value: its name and the range of its number.
struct Key {
    name: &'static str,
    least: f64,
    most: f64,
    unit: &'static str,
}

/// Unit of angles.
const RADIANS: &str = "radians";

const fn key(name: &'static str, least: f64, most: f64, unit: &'static str) -> Key {
    Key { name, least, most, unit }
}

const PLACE: [Key; 2] =
    [key("x", -MAX_COORDINATE_M, MAX_COORDINATE_M, "m"), key("y", -MAX_COORDINATE_M, MAX_COORDINATE_M, "m")];
const SPEED: Key = key("speed", 0.0, FASTEST_MPS, "m/s");
const HEADING: Key = key("heading", -ANGLE_RAD, ANGLE_RAD, RADIANS);
const TIME: Key = key("time", 0.5, LATEST_S, "s");
const TOLERANCE: Key = key("tolerance", scene::VIA_TOLERANCE_M.0, scene::VIA_TOLERANCE_M.1, "m");
const OFFSET: [Key; 2] = [
    key("ahead", -MAX_GOAL_DISTANCE_M, MAX_GOAL_DISTANCE_M, "m"),
    key("left", -MAX_GOAL_DISTANCE_M, MAX_GOAL_DISTANCE_M, "m"),
];
const TURN: Key = key("turn", -ANGLE_RAD, ANGLE_RAD, RADIANS);
/// Keys of a goal relative to another road user.
const RELATIVE: [Key; 6] = [
    key("ahead", GAP_M.0, GAP_M.1, "m"),
    key("behind", GAP_M.0, GAP_M.1, "m"),
    key("behind_s", GAP_S.0, GAP_S.1, "s"),
    key("after", AFTER_S.0, AFTER_S.1, "s"),
    key("slower", SLOWER_MPS.0, SLOWER_MPS.1, "m/s"),
    key("lanes_left", LANES_LEFT.0, LANES_LEFT.1, "lanes"),
];

impl Key {
    fn read(&self, text: &str) -> Result<f64, String> {
        let value = number(text).map_err(|wrong| format!("{}: {wrong}", self.name))?;
        if self.unit == RADIANS && value.abs() > self.most {
            return Err(format!("{}: {}", self.name, more_than_a_turn(value)));
        }
        within(self.least, self.most, self.unit)(text).map_err(|wrong| format!("{}: {wrong}", self.name))
    }
}

/// Parses values by key, as `ahead:40,speed:0`, or by position in the order of the keys, as `61,3.4,12`. An
/// empty position is free.
fn fields<'k>(text: &str, keys: &[&'k Key], by_place: usize) -> Result<Vec<(&'k str, f64)>, String> {
    let parts: Vec<&str> = text.split(',').map(str::trim).collect();
    if parts.iter().all(|part| !part.contains(':')) {
        if parts.len() > by_place {
            let names: Vec<&str> = keys.iter().take(by_place).map(|key| key.name).collect();
            return Err(format!(
                "{} numbers; at most {} expected",
                parts.len(),
                names.join(",").to_uppercase()
            ));
        }
        let given = keys.iter().zip(parts).filter(|(_, part)| !part.is_empty());
        return given.map(|(key, part)| Ok((key.name, key.read(part)?))).collect();
    }
    let mut out: Vec<(&str, f64)> = Vec::new();
    for part in parts {
        let names = || keys.iter().map(|key| key.name).collect::<Vec<_>>().join(", ");
        let (name, value) = part
            .split_once(':')
            .ok_or_else(|| format!("\"{part}\": KEY:NUMBER expected, keys are {}", names()))?;
        let key = keys.iter().find(|key| key.name == name.trim());
        let key = key.ok_or_else(|| format!("no key is named \"{name}\"; there are {}", names()))?;
        if out.iter().any(|(known, _)| *known == key.name) {
            return Err(format!("{name} is given twice"));
        }
        out.push((key.name, key.read(value)?));
    }
    Ok(out)
}

fn of(fields: &[(&str, f64)], name: &str) -> Option<f64> {
    fields.iter().find(|(known, _)| *known == name).map(|(_, value)| *value)
}

fn together(fields: &[(&str, f64)], a: &str, b: &str) -> Result<(), String> {
    match (of(fields, a), of(fields, b)) {
        (Some(_), None) => Err(format!("{a} needs {b} beside it")),
        (None, Some(_)) => Err(format!("{b} needs {a} beside it")),
        _ => Ok(()),
    }
}

/// A goal relative to the road user `to`. Keys: one of `ahead`, `behind`, `behind_s` and `after`; `slower`, `lanes_left`;
/// `time`, `speed`; and for `after` the place, `x y`.
fn relative_goal(to: &str, text: &str) -> Result<AskedGoal, String> {
    let no_place = || "of needs one of ahead, behind, behind_s and after beside it".to_owned();
    // Numbers without keys have no meaning here.
    if !text.contains(':') {
        return Err(no_place());
    }
    let own = [&PLACE[0], &PLACE[1], &SPEED, &TIME];
    let keys: Vec<&Key> = RELATIVE.iter().chain(own).collect();
    let fields = fields(text, &keys, 0)?;
    let value = |name| of(&fields, name);
    together(&fields, "x", "y")?;
    let places = ["ahead", "behind", "behind_s", "after"].into_iter().filter_map(value).count();
    if places != 1 {
        return Err(no_place());
    }
    let lanes_left = value("lanes_left");
    if lanes_left.is_some_and(|lanes| lanes.fract() != 0.0) {
        return Err("lanes_left: a whole number expected".into());
    }
    let relation = GoalRelationDoc {
        to: to.to_owned(),
        ahead_m: value("ahead"),
        behind_m: value("behind"),
        behind_s: value("behind_s"),
        after_s: value("after"),
        slower_mps: value("slower"),
        lanes_left: lanes_left.map(|lanes| lanes as i32),
    };
    let goal = GoalDoc {
        x_m: value("x"),
        y_m: value("y"),
        speed_mps: value("speed"),
        time_s: value("time"),
        relation: Some(relation),
        ..GoalDoc::default()
    };
    Ok(AskedGoal { goal, frame: GoalFrame::Scene })
}

/// The id after `of:` and the remaining keys, if there is one.
fn relative(text: &str) -> Option<(&str, String)> {
    let id = |part: &&str| part.trim().strip_prefix("of:").is_some();
    let to = text.split(',').find(id)?.trim().strip_prefix("of:")?.trim();
    let rest: Vec<&str> = text.split(',').filter(|part| !id(part)).collect();
    Some((to, rest.join(",")))
}

/// `X,Y[,SPEED[,HEADING[,TIME]]]`, or keys: `x y`, or `ahead left turn` from the start pose; `speed`, `heading`, `time`.
/// With the key `of` it is relative to another road user.
///
/// # Errors
/// What is wrong with it, in one sentence.
pub fn goal(text: &str) -> Result<AskedGoal, String> {
    if let Some((to, rest)) = relative(text) {
        return relative_goal(to, &rest);
    }
    let keys = [&PLACE[0], &PLACE[1], &SPEED, &HEADING, &TIME, &OFFSET[0], &OFFSET[1], &TURN];
    let fields = fields(text, &keys, 5)?;
    let value = |name| of(&fields, name);
    if fields.iter().all(|(name, _)| *name == "time") {
        return Err("a place, a speed or a heading expected".into());
    }
    together(&fields, "x", "y")?;
    let own = value("ahead").is_some() || value("left").is_some() || value("turn").is_some();
    if own && (value("x").is_some() || value("heading").is_some()) {
        return Err(
            "ahead, left and turn are from the start pose, x, y and heading of the scene; not both".into()
        );
    }
    if value("left").is_some() && value("ahead").is_none() {
        return Err("left needs ahead beside it".into());
    }
    let goal = GoalDoc {
        x_m: value("x"),
        y_m: value("y"),
        heading_rad: value("heading"),
        ahead_m: value("ahead"),
        // Straight ahead by default.
        left_m: value("left").or(value("ahead").map(|_| 0.0)),
        turn_rad: value("turn"),
        speed_mps: value("speed"),
        time_s: value("time"),
        ..GoalDoc::default()
    };
    Ok(AskedGoal { goal, frame: if own { GoalFrame::Agent } else { GoalFrame::Scene } })
}

/// `X,Y[,TIME[,TOLERANCE]]`, or keys: `x y time tolerance`.
///
/// # Errors
/// What is wrong with it, in one sentence.
pub fn via(text: &str) -> Result<ViaDoc, String> {
    let fields = fields(text, &[&PLACE[0], &PLACE[1], &TIME, &TOLERANCE], 4)?;
    let value = |name| of(&fields, name);
    let (Some(x_m), Some(y_m)) = (value("x"), value("y")) else {
        return Err("a place expected: x and y".into());
    };
    Ok(ViaDoc { x_m, y_m, tolerance_m: value("tolerance"), time_s: value("time") })
}

/// `X,Y[,SPEED[,HEADING]]`, or keys: `x y speed heading`.
///
/// # Errors
/// What is wrong with it, in one sentence.
pub fn start(text: &str) -> Result<StartDoc, String> {
    let fields = fields(text, &[&PLACE[0], &PLACE[1], &SPEED, &HEADING], 4)?;
    let value = |name| of(&fields, name);
    if fields.is_empty() {
        return Err("a place, a speed or a heading expected".into());
    }
    together(&fields, "x", "y")?;
    Ok(StartDoc {
        x_m: value("x"),
        y_m: value("y"),
        heading_rad: value("heading"),
        speed_mps: value("speed"),
        velocity: None,
    })
}

/// `LENGTHxWIDTH`, metres.
///
/// # Errors
/// What is wrong with it, in one sentence.
pub fn size(text: &str) -> Result<(f64, f64), String> {
    let (length, width) =
        text.split_once('x').ok_or_else(|| "LENGTHxWIDTH in metres expected, as in 12x2.6".to_owned())?;
    Ok((key("length", 0.2, 25.0, "m").read(length)?, key("width", 0.2, 4.0, "m").read(width)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn goals_by_place_and_by_key() {
        let scene = |goal| Ok(AskedGoal { goal, frame: GoalFrame::Scene });
        let at = |x, y| GoalDoc { x_m: Some(x), y_m: Some(y), ..GoalDoc::default() };
        assert_eq!(goal("61,3.4,12"), scene(GoalDoc { speed_mps: Some(12.0), ..at(61.0, 3.4) }));
        assert_eq!(goal("1,2,,0.5"), scene(GoalDoc { heading_rad: Some(0.5), ..at(1.0, 2.0) }));
        assert_eq!(goal(",,0"), scene(GoalDoc { speed_mps: Some(0.0), ..GoalDoc::default() }));
        assert_eq!(goal("y:2, x:1"), scene(at(1.0, 2.0)));
        let own = GoalDoc {
            ahead_m: Some(40.0),
            left_m: Some(3.5),
            speed_mps: Some(0.0),
            time_s: Some(4.0),
            ..GoalDoc::default()
        };
        let relative = goal("ahead:40,left:3.5,speed:0,time:4").unwrap();
        assert_eq!(relative, AskedGoal { goal: own, frame: GoalFrame::Agent });
        assert_eq!(goal("ahead:40").unwrap().goal.left_m, Some(0.0));
    }

    #[test]
    fn goals_relative_to_another_road_user() {
        let cut_in = goal("ahead:12, of:1, time:5, slower:4, lanes_left:1").unwrap();
        let relation = GoalRelationDoc {
            to: "1".into(),
            ahead_m: Some(12.0),
            slower_mps: Some(4.0),
            lanes_left: Some(1),
            ..GoalRelationDoc::default()
        };
        let asked = GoalDoc { time_s: Some(5.0), relation: Some(relation), ..GoalDoc::default() };
        assert_eq!(cut_in, AskedGoal { goal: asked, frame: GoalFrame::Scene });
        let passing = goal("of:a:3,x:4,y:2,after:0.5").unwrap().goal;
        assert_eq!((passing.x_m, passing.y_m), (Some(4.0), Some(2.0)));
        let relation = passing.relation.unwrap();
        assert_eq!((relation.to.as_str(), relation.after_s), ("a:3", Some(0.5)));
        let wrong = |text: &str| goal(text).unwrap_err();
        assert_eq!(wrong("of:1,time:5"), "of needs one of ahead, behind, behind_s and after beside it");
        assert_eq!(wrong("of:1,ahead:5,behind:5"), wrong("of:1"));
        assert_eq!(wrong("of:1,ahead:600"), "ahead: 0 to 500 m expected");
        assert_eq!(wrong("of:1,ahead:5,lanes_left:0.5"), "lanes_left: a whole number expected");
        assert_eq!(wrong("of:1,after:1,x:2"), "x needs y beside it");
    }

    #[test]
    fn bad_goals_are_told_apart() {
        let wrong = |text: &str| goal(text).unwrap_err();
        assert_eq!(wrong("1,NaN"), "y: \"NaN\" is not a number");
        assert_eq!(wrong("1,2,3,4,5,6"), "6 numbers; at most X,Y,SPEED,HEADING,TIME expected");
        assert_eq!(wrong("1"), "x needs y beside it");
        assert_eq!(wrong("speed:80"), "speed: 0 to 60 m/s expected");
        let turn = "heading: 90 rad is more than a turn; 90 degrees are 1.5708 rad";
        assert_eq!(wrong("2,27,5,90"), turn);
        assert_eq!(wrong("left:3"), "left needs ahead beside it");
        assert_eq!(wrong("time:4"), "a place, a speed or a heading expected");
        assert_eq!(wrong("ahead:4,ahead:5"), "ahead is given twice");
        assert!(wrong("ahead:4,x:5,y:6").contains("not both"));
        assert!(wrong("before:4").starts_with("no key is named \"before\"; there are x, y, speed"));
        assert!(wrong("ahead:4,5").starts_with("\"5\": KEY:NUMBER expected"));
        assert_eq!(size("12"), Err("LENGTHxWIDTH in metres expected, as in 12x2.6".into()));
        assert_eq!(size("12x2.6"), Ok((12.0, 2.6)));
        assert_eq!(start("x:1,y:2,speed:3").unwrap().speed_mps, Some(3.0));
        assert!(start("").is_err());
    }
}
