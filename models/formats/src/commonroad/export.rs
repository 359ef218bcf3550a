//! Writes a scene as a scenario.

use super::export_map::MapElements;
use super::export_motion::{self, PlanningTask, ScenarioAgent};
use super::import::{LICENCE, MADE};
use super::words::{TAGS, VERSION};
use crate::format::{ExportOptions, Exported};
use crate::loss::{Loss, code};
use crate::markup::{Markup, decimal};
use crate::numbers::Numbers;
use crate::unwritten;
use scene::{Agent, STEP_S, Scene};
use std::collections::BTreeSet;
use std::io;

/// Writes a scene in its own frame; the location of the file has the origin.
///
/// # Errors
/// `InvalidInput` for a scene without a lane, since a scenario needs one.
pub(super) fn write(scene: &Scene, options: &ExportOptions) -> io::Result<Exported> {
    if scene.map.lanes.is_empty() {
        let message = crate::refusals::file_needs("CommonRoad", crate::refusals::what::LANE);
        return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
    }
    let mut losses = BTreeSet::new();
    let map = &scene.map;
    let own = map.lanes.iter().map(|lane| &lane.id).chain(map.crosswalks.iter().map(|area| &area.id));
    let own = own.chain(map.stop_signs.iter().map(|sign| &sign.id)).chain(scene.agents.iter().map(|a| &a.id));
    let mut ids = Numbers::of(own);
    let (shown, steps) = options.motion.all(scene);
    let drawn = MapElements::of(scene, steps, &mut ids, &mut losses);
    let problem = PlanningTask::of(scene, &shown);
    let made = problem.is_none().then(|| ids.free());
    let name = benchmark_id(scene);
    let mut out = Markup::new(options.bounds());
    let licence = scene.licence().map(|licence| format!("{LICENCE}{licence}")).unwrap_or_default();
    out.open(
        super::document::ROOT,
        &[
            ("commonRoadVersion", VERSION),
            ("benchmarkID", &name),
            ("date", &date(scene)),
            ("author", "unknown"),
            ("affiliation", if problem.is_some() { "unknown" } else { MADE }),
            ("source", &format!("{}{licence}", scene.meta.source)),
            ("timeStepSize", &decimal(STEP_S)),
        ],
    );
    location(scene, &mut out);
    out.open("scenarioTags", &[]);
    let mut tags: Vec<&'static str> = Vec::new();
    for tag in scene.meta.tags.iter().filter_map(|tag| TAGS.into_iter().find(|known| known == tag)) {
        if !tags.contains(&tag) {
            tags.push(tag);
            out.empty(tag, &[]);
        }
    }
    out.close();
    drawn.write(&mut out)?;
    let numbers: Vec<i64> = scene.agents.iter().map(|agent| ids.take(&agent.id)).collect();
    let fixed = |agent: &Agent| unwritten::is_fixed(scene, agent, options.motion);
    let users = scene.agents.iter().zip(&shown).zip(&numbers);
    let users: Vec<ScenarioAgent<'_>> = users
        .map(|((agent, shown), id)| ScenarioAgent { agent, shown, id: *id, is_fixed: fixed(agent) })
        .collect();
    export_motion::write(scene, &users, problem.as_ref(), &mut out, &mut losses);
    if let Some(id) = made {
        export_motion::write_made(scene, id, &mut out);
        let detail = "a scenario has a planning problem, this scene no ego or goal: one along the longest lane is made";
        losses.insert(Loss::new(code::SINGLE_EGO, detail));
    }
    if ids.renumbered {
        let detail = "ids that are no whole numbers above zero, or not unique among all that is in a scenario, got new ones";
        losses.insert(Loss::new(code::IDS_RENUMBERED, detail));
    }
    let foreign = scene.meta.tags.iter().any(|tag| !TAGS.contains(&tag.as_str()));
    if foreign || scene.meta.timestamps_s.is_some() || unwritten::is_noted(scene, &name) {
        let detail = "names and tags that the format has no words for, notes, times of the recording, members of other tools";
        losses.insert(Loss::new(code::NO_NOTES, detail));
    }
    losses.extend(unwritten::futures(scene, options.motion));
    Ok(Exported { bytes: out.finish()?.whole()?, losses: losses.into_iter().collect() })
}

/// The day on which the futures were made, if it is known.
fn date(scene: &Scene) -> String {
    let made = scene.generated.as_ref().and_then(|generated| generated.created_at.get(..10));
    let is_date = |day: &&str| {
        day.bytes().enumerate().all(|(i, b)| if matches!(i, 4 | 7) { b == b'-' } else { b.is_ascii_digit() })
    };
    made.filter(is_date).unwrap_or("1970-01-01").to_owned()
}

/// The scene's own name in its source if that is a benchmark id, otherwise an id made from its name.
fn benchmark_id(scene: &Scene) -> String {
    let own = scene.meta.source_id.as_deref().filter(|id| is_benchmark_id(id));
    let own = own.or(Some(scene.name.as_str()).filter(|id| is_benchmark_id(id)));
    own.map_or_else(
        || {
            let letters: String = scene.name.chars().filter(char::is_ascii_alphanumeric).take(40).collect();
            format!("ZAM_{}-1_1_T-1", if letters.is_empty() { "DragTraffic" } else { &letters })
        },
        str::to_owned,
    )
}

/// A name such as `USA_US101-3_3_T-1`.
fn is_benchmark_id(id: &str) -> bool {
    let Some((country, rest)) = id.strip_prefix("C-").unwrap_or(id).split_once('_') else { return false };
    let Some((map, numbers)) = rest.split_once('-') else { return false };
    let mut parts = numbers.split('_');
    let is_number =
        |text: &str| !text.is_empty() && text.len() < 9 && text.bytes().all(|b| b.is_ascii_digit());
    let prediction = |text: &str| {
        let (kind, numbers) = text.split_once('-').unwrap_or_default();
        matches!(kind, "S" | "T" | "I" | "P") && numbers.split('-').all(is_number)
    };
    country.len() == 3
        && country.bytes().all(|b| b.is_ascii_uppercase())
        && !map.is_empty()
        && map.bytes().all(|b| b.is_ascii_alphanumeric())
        && parts.next().is_some_and(is_number)
        && parts.next().is_none_or(is_number)
        && parts.next().is_none_or(prediction)
        && parts.next().is_none()
}

fn location(scene: &Scene, out: &mut Markup) {
    out.open("location", &[]);
    out.leaf("geoNameId", -999);
    out.leaf("gpsLatitude", "999.0");
    out.leaf("gpsLongitude", "999.0");
    let origin = &scene.meta.origin;
    out.open("geoTransformation", &[]);
    out.leaf("geoReference", origin.crs.as_deref().unwrap_or_default());
    out.open("additionalTransformation", &[]);
    out.leaf("xTranslation", origin.x_m);
    out.leaf("yTranslation", origin.y_m);
    out.leaf("zRotation", origin.rotation_rad);
    out.leaf("scaling", 1);
    (0..3).for_each(|_| out.close());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_benchmarks_are_known() {
        for id in ["USA_US101-3_3_T-1", "ZAM_Zip-1_56_T-1", "C-DEU_B471-1", "ZAM_a-1_1", "DEU_A-2_1_S-1-2-3"]
        {
            assert!(is_benchmark_id(id), "{id}");
        }
        for id in [
            "",
            "a drive",
            "USA_US101",
            "usa_a-1",
            "ZAM_a b-1",
            "ZAM_a-x",
            "ZAM_a-1_1_T-1_2",
            "ZAM_a-1_1_Q-1",
        ] {
            assert!(!is_benchmark_id(id), "{id}");
        }
    }
}
