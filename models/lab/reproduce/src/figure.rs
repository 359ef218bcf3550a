//! The paper's qualitative figure, "creating, editing and correction", on the available scenes: its cases (a)
//! to (d) and one of each task, as a page of pictures.

mod choose;
mod panels;

pub use panels::Panel;

use crate::Stop;
use crate::sets::{Centre, Data, SetOptions, Sets, TestCase, each_case};
use anyhow::Result;
use choose::{Found, Role};
use experts::Engine;
use lab_eval::Site;
use lab_train::provenance::Provenance;
use std::fmt::Write as _;

/// File of the page in the folder of a run.
pub const FIGURE_FILE: &str = "figure.html";

/// All panels; panels without a suitable scene are left out and named.
///
/// # Errors
/// When the generator fails, the data have changed, or the run is stopped.
pub fn make(
    data: &Data,
    options: &SetOptions,
    sets: &Sets,
    engine: &Engine,
    seed: u64,
    stop: &Stop,
    progress: &dyn Fn(&str),
) -> Result<Vec<Panel>> {
    // The squares around the ego; if the filters leave none, those around people.
    let of = |centre: Option<Centre>| -> Vec<TestCase> {
        let all = sets.tests.iter().filter(|case| centre.is_none_or(|c| c == case.centre));
        all.cloned().collect()
    };
    let ego = of(Some(Centre::Ego));
    let cases = if ego.is_empty() { of(None) } else { ego };
    let told = |done: usize| progress(&format!("figure: {done} of {} scenes looked at", cases.len()));
    let found = each_case(data, options, &cases, stop, &told, |i, _, cut| {
        if !cut.is_whole() {
            return Ok(Vec::new());
        }
        Ok(choose::found(i, &Site::new(i, &cut.scene)))
    })?;
    let mut best: [Option<Found>; Role::ALL.len()] = Default::default();
    for found in found.into_iter().flatten() {
        let slot = &mut best[found.role.index()];
        if slot.as_ref().is_none_or(|before| found.score > before.score) {
            *slot = Some(found);
        }
    }
    let mut out = Vec::new();
    for found in best.into_iter().flatten() {
        progress(&format!("figure: {}", found.role.name()));
        let case = std::slice::from_ref(&cases[found.case]);
        let made = each_case(data, options, case, stop, &|_| {}, |_, _, cut| {
            panels::draw(&found, &Site::new(0, &cut.scene), engine, seed)
        })?;
        out.extend(made.into_iter().flatten());
    }
    Ok(out)
}

/// One page with all panels.
pub fn page(panels: &[Panel], sources: &Provenance) -> String {
    let mut out = String::from(
        "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<title>Creating, editing, correcting</title>\n\
         <style>\nbody { font: 15px/1.4 sans-serif; margin: 24px; color: #1c2128; }\n\
         main { display: grid; grid-template-columns: repeat(auto-fill, minmax(440px, 1fr)); gap: 24px; }\n\
         figure { margin: 0; }\nfigure svg { width: 100%; height: auto; border: 1px solid #d0d5dd; }\n\
         figcaption { margin-top: 6px; }\nfigcaption b { display: block; }\n</style>\n\
         <h1>Creating, editing, correcting</h1>\n\
         <p>The figure of the paper, on these data. Boxes: blue vehicles, purple pedestrians, orange cyclists, at the first \
         frame. Red: the motion that is generated, with its box each second and dots; black dashes: the recording; green \
         rings: ends that are asked for. Words in red name what the judge finds wrong.</p>\n<main>\n",
    );
    for panel in panels {
        let _ = writeln!(
            out,
            "<figure id=\"{}\">\n{}<figcaption><b>{}</b>{}</figcaption>\n</figure>",
            panel.id, panel.svg, panel.title, panel.words
        );
    }
    let missing: Vec<&str> = Role::ALL
        .iter()
        .filter(|role| !panels.iter().any(|p| p.id.starts_with(role.id())))
        .map(|r| r.name())
        .collect();
    let _ = writeln!(out, "</main>\n<p>Scenes from {}. Licence: {}.</p>", sources.words(), sources.licence());
    if !missing.is_empty() {
        let _ = writeln!(out, "<p>No scene of the tests shows: {}.</p>", missing.join("; "));
    }
    out += "</html>\n";
    out
}
