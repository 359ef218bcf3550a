//! One run over scenes: the requested tables, one after another.

use super::report::{CropReport, EvalReport};
use super::stats::Bootstrap;
use super::table::{TableSpec, Trial};
use super::tables::TABLES;
use super::{Judged, Site};
use anyhow::Result;
use lab_train::baselines::Baseline;
use lab_train::scenes::{Crop, Cropped};
use scene::Scene;
use std::borrow::Cow;

/// Options of an evaluation.
#[derive(Clone, Debug)]
pub struct EvalOptions {
    /// Tables, in any order.
    pub tables: Vec<&'static TableSpec>,
    /// Draws noise, resamples, drags and random pictures.
    pub seed: u64,
    /// Pictures of table 1's best, worst and random cases.
    pub pictures: bool,
    /// Steps between replans of the product, 1..=90; each has a line in table 2.
    pub replan_steps: Vec<usize>,
    /// Crop: which road users count, and how many a scene needs.
    pub crop: Crop,
}

/// Makes the tables. `progress` is told the current step, and `made` the results after each table. The first
/// of `judged` is in the pictures, and `baselines` are compared in tables 1, 2 and 4.
///
/// # Errors
/// When a generator or `made` fails, or the crop leaves no scene.
pub fn run(
    judged: Vec<Judged>,
    baselines: &[Baseline],
    scenes: &[Scene],
    options: &EvalOptions,
    progress: &dyn Fn(&str),
    made: &dyn Fn(&EvalReport) -> Result<()>,
) -> Result<EvalReport> {
    let seed = options.seed;
    let (scenes, crop) = cropped(scenes, options.crop)?;
    let weights = judged.iter().map(|own| (own.name.clone(), own.generator.hashes()));
    let mut report = EvalReport {
        seed,
        scenes: scenes.len(),
        crop,
        weights: weights.collect(),
        sheets: Vec::new(),
        cost: Vec::new(),
        pictures: Vec::new(),
    };
    let mut trial = Trial {
        judged,
        baselines,
        scenes: &scenes,
        sites: scenes.iter().enumerate().map(|(i, scene)| Site::new(i, scene)).collect(),
        boot: Bootstrap::new(scenes.len(), seed),
        seed,
        replan_steps: &options.replan_steps,
        pictures: options.pictures,
    };
    for table in TABLES.iter().filter(|table| options.tables.iter().any(|own| own.number == table.number)) {
        progress(&format!("table {}: {}", table.number, table.name));
        let new = (table.make)(&mut trial)?;
        report.sheets.extend(new.sheets);
        report.cost.extend(new.times);
        report.pictures.extend(new.pictures);
        made(&report)?;
    }
    Ok(report)
}

/// The scenes that a crop leaves, and its effect.
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

#[cfg(test)]
mod tests {
    use super::*;
    use experts::Generator;
    use lab_train::baselines::BaselineKind;
    use lab_train::samples::{log, scene, shifted};

    fn tables(tables: &[usize], seed: u64, threads: usize) -> EvalReport {
        judge(tables, seed, threads, Crop::default(), &[]).unwrap()
    }

    fn judge(
        tables: &[usize],
        seed: u64,
        threads: usize,
        crop: Crop,
        baselines: &[Baseline],
    ) -> Result<EvalReport> {
        let scenes: Vec<Scene> = (0..2)
            .map(|i| {
                let speed = 8.0 + f64::from(i);
                scene(vec![log("a", speed, 91), shifted(log("b", 6.0, 91), 30.0, 3.5)])
            })
            .collect();
        let generator = Generator::random(1).unwrap().with_threads(threads);
        let judged = vec![Judged { name: "random".into(), generator }];
        let tables = tables.iter().filter_map(|number| TableSpec::numbered(*number)).collect();
        let options = EvalOptions { tables, seed, pictures: true, replan_steps: vec![30, 90], crop };
        run(judged, baselines, &scenes, &options, &|_| {}, &|_| Ok(()))
    }

    #[test]
    fn each_table_is_handed_over_as_it_is_made() {
        let scenes = [scene(vec![log("a", 8.0, 91)])];
        let judged = vec![Judged { name: "random".into(), generator: Generator::random(1).unwrap() }];
        let tables = [1, 2].into_iter().filter_map(TableSpec::numbered).collect();
        let options =
            EvalOptions { tables, seed: 5, pictures: false, replan_steps: vec![90], crop: Crop::default() };
        let folder = tempfile::tempdir().unwrap();
        let count = std::cell::Cell::new(0);
        // A stop after the first table leaves that table complete.
        let made = |report: &EvalReport| {
            report.write(folder.path())?;
            count.set(count.get() + 1);
            anyhow::bail!("stopped")
        };
        assert!(run(judged, &[], &scenes, &options, &|_| {}, &made).is_err());
        let tables = std::fs::read_to_string(folder.path().join("tables.md")).unwrap();
        assert!(count.get() == 1 && tables.contains("### 1a") && !tables.contains("### 2 "), "{tables}");
    }

    #[test]
    fn the_same_run_gives_the_same_bytes() {
        let timeless = [1, 2, 3, 4, 5, 7, 8];
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
        let alone = |seed| tables(&[2], seed, 1).markdown();
        assert_ne!(alone(5), alone(6));
    }

    #[test]
    fn plans_are_made_anew_as_often_as_asked() {
        let report = tables(&[2], 5, 1);
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
            Baseline::random("free", BaselineKind::TrafficGen).unwrap(),
            Baseline::random("asked", BaselineKind::TrafficGenConditional).unwrap(),
        ];
        let made = |threads| {
            let tables = [1, 2, 4];
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
        let report = judge(&[2], 5, 1, crop, &[]).unwrap();
        // The second car of each scene is 30 m ahead of the first.
        let told = CropReport { crop, scenes_left_out: 0, road_users_outside: 2 };
        assert_eq!((report.scenes, report.crop), (2, Some(told)));
        let text = report.markdown();
        assert!(text.contains("50 m square about the ego alone, 2 outside left out"), "{text}");
        let json = serde_json::to_value(&report).unwrap();
        assert_eq!(json["crop"]["side_m"].as_f64(), Some(50.0));
        assert!(judge(&[2], 5, 1, Crop::PAPER, &[]).is_err());
        assert!(serde_json::to_value(tables(&[], 5, 1)).unwrap().get("crop").is_none());
    }

    #[test]
    fn writes_everything() {
        let folder = tempfile::tempdir().unwrap();
        let report = tables(&[1], 5, 1);
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
