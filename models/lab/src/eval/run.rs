//! One run over scenes: the tables that were asked for, as sheets, Markdown and JSON, and pictures.

use super::ablation::ablation;
use super::coherence::coherence;
use super::control::control;
use super::cost::cost;
use super::parked::parked;
use super::quality::{Quality, collect};
use super::realism::realism;
use super::refining::refining;
use super::sheet::Sheet;
use super::stats::Bootstrap;
use super::variety::variety;
use super::{Entrants, Judged, Site, picture};
use crate::baselines::Baseline;
use crate::crop::{Crop, Cropped};
use anyhow::{Context, Result};
use scene::Scene;
use serde::Serialize;
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// A table of the evaluation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[allow(missing_docs, reason = "the names say it")]
pub enum Table {
    Quality,
    Coherence,
    Control,
    Realism,
    Variety,
    Cost,
    Ablation,
    Refining,
}

impl Table {
    /// All, numbered from 1.
    pub const ALL: [Self; 8] = [
        Self::Quality,
        Self::Coherence,
        Self::Control,
        Self::Realism,
        Self::Variety,
        Self::Cost,
        Self::Ablation,
        Self::Refining,
    ];

    /// By its number, 1 to 8.
    pub fn numbered(number: usize) -> Option<Self> {
        Self::ALL.get(number.checked_sub(1)?).copied()
    }
}

/// What to make.
#[derive(Clone, Debug)]
pub struct Options {
    /// Tables.
    pub tables: BTreeSet<Table>,
    /// Draws noise, resamples, drags and random pictures.
    pub seed: u64,
    /// Pictures of table 1's best, worst and random cases.
    pub pictures: bool,
    /// Table 2 has a line for the product re-planned after so many steps each, 1..=90.
    pub replan_steps: Vec<usize>,
    /// Which road users count, and how many a scene must have.
    pub crop: Crop,
}

/// What a crop did.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct CropReport {
    /// The crop.
    #[serde(flatten)]
    pub crop: Crop,
    /// Scenes left out for having too few road users.
    pub scenes_left_out: usize,
    /// Road users outside, in the scenes that were kept.
    pub road_users_outside: usize,
}

/// What was found.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Seed.
    pub seed: u64,
    /// Scenes looked at.
    pub scenes: usize,
    /// What was left out beforehand; `None` when nothing was asked to be.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub crop: Option<CropReport>,
    /// Hash of each expert's weights, by name of the judged.
    pub weights: BTreeMap<String, BTreeMap<String, String>>,
    /// Tables 1 to 5, 7 and 8.
    pub sheets: Vec<Sheet>,
    /// Table 6 and the times of table 8: the clock's readings, never the same twice.
    #[serde(skip)]
    pub cost: Vec<Sheet>,
    /// File name and SVG.
    #[serde(skip)]
    pub pictures: Vec<(String, String)>,
}

/// Makes the tables, telling `progress` what is under way. The first of `judged` is in the pictures, and
/// `baselines` stand beside them in tables 1, 2 and 4.
///
/// # Errors
/// When a generator fails, or the crop leaves no scene.
pub fn run(
    judged: Vec<Judged>,
    baselines: &[Baseline],
    scenes: &[Scene],
    options: &Options,
    progress: &dyn Fn(&str),
) -> Result<Report> {
    let seed = options.seed;
    let (scenes, crop) = cropped(scenes, options.crop)?;
    let scenes = scenes.as_ref();
    let wants = |table: Table| options.tables.contains(&table);
    let weights = judged.iter().map(|own| (own.name.clone(), own.generator.hashes()));
    let mut report = Report {
        seed,
        scenes: scenes.len(),
        crop,
        weights: weights.collect(),
        sheets: Vec::new(),
        cost: Vec::new(),
        pictures: Vec::new(),
    };
    let sites: Vec<Site<'_>> = scenes.iter().enumerate().map(|(i, scene)| Site::new(i, scene)).collect();
    let boot = Bootstrap::new(scenes.len(), seed);
    let entrants = Entrants { judged: &judged, baselines };
    if wants(Table::Quality) {
        progress("table 1: quality");
        let outcomes = collect(entrants, &sites, seed)?;
        report.sheets.extend(Quality::new(entrants, &outcomes, &boot).sheets());
        report.sheets.push(parked(&judged, &sites, &boot, seed)?);
        if let Some(own) = judged.first().filter(|_| options.pictures) {
            progress("pictures");
            report.pictures = picture::of_outcomes(&own.generator, &sites, &outcomes, seed)?;
        }
    }
    if wants(Table::Coherence) {
        progress("table 2: coherence");
        report.sheets.push(coherence(entrants, &sites, &boot, &options.replan_steps, seed)?);
    }
    if wants(Table::Control) {
        progress("table 3: control");
        report.sheets.extend(control(&judged, &sites, &boot, seed)?);
    }
    if wants(Table::Realism) {
        progress("table 4: realism");
        report.sheets.extend(realism(entrants, &sites, &boot, seed)?);
    }
    if wants(Table::Variety) {
        progress("table 5: variety");
        report.sheets.extend(variety(&judged, &sites, &boot, seed)?);
    }
    if wants(Table::Ablation) {
        progress("table 7: ablations");
        report.sheets.extend(ablation(&judged, &sites, &boot, seed)?);
    }
    if wants(Table::Refining) {
        progress("table 8: refinement");
        let (sheets, times) = refining(&judged, &sites, &boot, seed)?;
        report.sheets.extend(sheets);
        report.cost.push(times);
    }
    if wants(Table::Cost) {
        progress("table 6: cost");
        report.cost.extend(cost(judged, scenes)?);
    }
    Ok(report)
}

/// The scenes that a crop leaves, and what it did.
fn cropped(scenes: &[Scene], crop: Crop) -> Result<(Cow<'_, [Scene]>, Option<CropReport>)> {
    if crop == Crop::default() {
        return Ok((scenes.into(), None));
    }
    let mut report = CropReport { crop, scenes_left_out: 0, road_users_outside: 0 };
    let mut kept = Vec::new();
    for scene in scenes {
        match crop.apply(scene.clone()) {
            Cropped::Kept(scene, outside) => {
                report.road_users_outside += outside;
                kept.push(*scene);
            }
            Cropped::TooFew(_) => report.scenes_left_out += 1,
        }
    }
    anyhow::ensure!(!kept.is_empty(), "no scene has {} road users that count", crop.least_agents);
    Ok((kept.into(), Some(report)))
}

impl Report {
    /// Tables 1 to 5, 7 and 8 as Markdown.
    pub fn markdown(&self) -> String {
        let mut out = format!("# Evaluation\n\n{} scenes, seed {}. ", self.scenes, self.seed);
        if let Some(CropReport { crop, scenes_left_out, road_users_outside }) = &self.crop {
            if let Some(side_m) = crop.side_m {
                out += &format!(
                    "Road users of a {side_m} m square about the ego alone, {road_users_outside} outside left \
                     out. "
                );
            }
            out += &format!(
                "Scenes with fewer than {} road users at the first step left out: {scenes_left_out}. ",
                crop.least_agents
            );
        }
        out += "Every figure has its 95 % bootstrap interval, resampled by scene.\n\n";
        for (name, hashes) in &self.weights {
            for (expert, hash) in hashes {
                out += &format!("- {name}, {expert}: sha256 {}\n", hash.get(..16).unwrap_or(hash));
            }
        }
        out.push('\n');
        for sheet in &self.sheets {
            out += &sheet.markdown();
        }
        out
    }

    /// Writes `tables.md`, `tables.json`, `cost.md`, `cost.json` and `pictures/`, as far as there are any.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<()> {
        let write = |name: &str, text: &str| -> Result<()> {
            let path = folder.join(name);
            std::fs::write(&path, text).with_context(|| format!("write {}", path.display()))
        };
        std::fs::create_dir_all(folder).with_context(|| format!("make {}", folder.display()))?;
        write("tables.md", &self.markdown())?;
        write("tables.json", &format!("{}\n", serde_json::to_string_pretty(self)?))?;
        if !self.cost.is_empty() {
            write("cost.md", &self.cost.iter().map(Sheet::markdown).collect::<String>())?;
            write("cost.json", &format!("{}\n", serde_json::to_string_pretty(&self.cost)?))?;
        }
        if !self.pictures.is_empty() {
            std::fs::create_dir_all(folder.join("pictures"))?;
            for (name, picture) in &self.pictures {
                write(&format!("pictures/{name}"), picture)?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::super::samples::{log, scene, shifted};
    use super::*;
    use crate::baselines::Kind;
    use experts::Generator;

    fn tables(tables: &[Table], seed: u64, threads: usize) -> Report {
        judge(tables, seed, threads, Crop::default(), &[]).unwrap()
    }

    fn judge(
        tables: &[Table],
        seed: u64,
        threads: usize,
        crop: Crop,
        baselines: &[Baseline],
    ) -> Result<Report> {
        let scenes: Vec<Scene> = (0..2)
            .map(|i| {
                let speed = 8.0 + f64::from(i);
                scene(vec![log("a", speed, 91), shifted(log("b", 6.0, 91), 30.0, 3.5)])
            })
            .collect();
        let generator = Generator::random(1).unwrap().with_threads(threads);
        let judged = vec![Judged { name: "random".into(), generator }];
        let tables = tables.iter().copied().collect();
        let options = Options { tables, seed, pictures: true, replan_steps: vec![30, 90], crop };
        run(judged, baselines, &scenes, &options, &|_| {})
    }

    #[test]
    fn the_same_run_gives_the_same_bytes() {
        let timeless: Vec<Table> = Table::ALL.into_iter().filter(|t| *t != Table::Cost).collect();
        let (first, again) = (tables(&timeless, 5, 1), tables(&timeless, 5, 2));
        assert_eq!(first.markdown(), again.markdown());
        assert_eq!(serde_json::to_string(&first).unwrap(), serde_json::to_string(&again).unwrap());
        assert_eq!(first.pictures, again.pictures);
        assert!(first.pictures.len() > 3);
        for title in [
            "1a", "1b", "1c", "1d", "1e", "1f", "2 ", "3a", "3b", "4a", "4b", "5a", "5b", "7a", "7b", "8a",
            "8b",
        ] {
            assert!(first.sheets.iter().any(|s| s.title.starts_with(title)), "{title}");
        }
        let alone = |seed| tables(&[Table::Coherence], seed, 1).markdown();
        assert_ne!(alone(5), alone(6));
    }

    #[test]
    fn plans_are_made_anew_as_often_as_asked() {
        let report = tables(&[Table::Coherence], 5, 1);
        let cells = |goals: &str, name: &str| {
            let mut lines = report.sheets[0].lines.iter();
            let found = lines.find(|l| l.keys[0] == goals && l.keys[1].ends_with(name));
            found.map(|l| l.cells.clone()).unwrap()
        };
        for goals in ["none", "all fixed"] {
            assert_eq!(cells(goals, "re-planned every 9 s"), cells(goals, "the product"));
        }
        assert_ne!(cells("none", "re-planned every 3 s"), cells("none", "the product"));
    }

    #[test]
    fn learned_rivals_stand_beside_the_experts() {
        let baselines = [
            Baseline::random("free", Kind::TrafficGen),
            Baseline::random("asked", Kind::TrafficGenConditional),
        ];
        let made = |threads| {
            let tables = [Table::Quality, Table::Coherence, Table::Realism];
            judge(&tables, 5, threads, Crop::default(), &baselines).unwrap()
        };
        let report = made(1);
        assert_eq!(report.markdown(), made(2).markdown());
        // Sheet, a word of the line's keys beside the name, and whether each of the two has such a line.
        for (title, word, expected) in [
            ("1a", "none", [true, true]),
            ("1a", "pos", [false, true]),
            ("1b", "none", [true, true]),
            ("1e", "speed", [false, true]),
            ("2 ", "none", [true, true]),
            ("2 ", "all fixed", [false, true]),
            ("4a", "", [true, true]),
            ("4a", ", goals", [false, true]),
        ] {
            let sheet = report.sheets.iter().find(|s| s.title.starts_with(title)).unwrap();
            let has = |name: &str| {
                let named = |keys: &[String]| keys.iter().any(|k| k.starts_with(name));
                let fits = |keys: &[String]| keys.iter().any(|k| k == word || k.ends_with(word));
                sheet.lines.iter().any(|l| named(&l.keys) && fits(&l.keys))
            };
            assert_eq!(["free", "asked"].map(has), expected, "{title} {word}");
        }
    }

    #[test]
    fn crops_are_told() {
        let crop = Crop { side_m: Some(50.0), least_agents: 1 };
        let report = judge(&[Table::Coherence], 5, 1, crop, &[]).unwrap();
        // The second car of each scene is 30 m ahead of the first.
        let told = CropReport { crop, scenes_left_out: 0, road_users_outside: 2 };
        assert_eq!((report.scenes, report.crop), (2, Some(told)));
        let text = report.markdown();
        assert!(text.contains("50 m square about the ego alone, 2 outside left out"), "{text}");
        let json = serde_json::to_value(&report).unwrap();
        assert_eq!(json["crop"]["side_m"].as_f64(), Some(50.0));
        assert!(judge(&[Table::Coherence], 5, 1, Crop::PAPER, &[]).is_err());
        assert!(serde_json::to_value(tables(&[], 5, 1)).unwrap().get("crop").is_none());
    }

    #[test]
    fn writes_everything() {
        let folder = tempfile::tempdir().unwrap();
        let report = tables(&[Table::Quality], 5, 1);
        report.write(folder.path()).unwrap();
        assert_eq!(std::fs::read_to_string(folder.path().join("tables.md")).unwrap(), report.markdown());
        let json = std::fs::read(folder.path().join("tables.json")).unwrap();
        let json: serde_json::Value = serde_json::from_slice(&json).unwrap();
        assert!(json["sheets"].as_array().is_some_and(|s| s.len() == report.sheets.len()));
        assert!(!folder.path().join("cost.md").exists());
        let pictures = std::fs::read_dir(folder.path().join("pictures")).unwrap().count();
        assert_eq!(pictures, report.pictures.len());
    }
}
