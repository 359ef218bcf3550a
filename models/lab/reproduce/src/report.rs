//! Results of a run, as Markdown and CSV: amount of data, length of training, both tables.

use crate::paper;
use crate::sets::{Centre, SetOptions, Sets, Shares};
use crate::training::Trained;
use anyhow::{Context, Result};
use lab_eval::sheet::{Cell, Sheet};
use std::fmt::Write as _;
use std::path::Path;

/// File of the tables in the folder of a run.
pub const TABLES_FILE: &str = "tables.md";

/// Everything that the tables are based on.
pub struct Report<'a> {
    /// Options of the sets.
    pub options: &'a SetOptions,
    /// The sets.
    pub sets: &'a Sets,
    /// Whether the test scenes are a separate set.
    pub own_tests: bool,
    /// Trained networks.
    pub trained: &'a [Trained],
    /// Hidden size of the condition's MLP.
    pub condition_width: usize,
    /// Seed.
    pub seed: u64,
    /// Scenes of Table II for pedestrians and cyclists.
    pub interactive: [usize; 2],
    /// Tables I and II.
    pub sheets: &'a [Sheet],
}

impl Report<'_> {
    /// Writes `tables.md`, `table-1.csv` and `table-2.csv`.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<()> {
        write(&folder.join(TABLES_FILE), &self.markdown())?;
        for (i, sheet) in self.sheets.iter().enumerate() {
            write(&folder.join(format!("table-{}.csv", i + 1)), &csv(sheet))?;
        }
        Ok(())
    }

    /// As Markdown.
    pub fn markdown(&self) -> String {
        let Self { options, sets, .. } = self;
        let side_m = options.crop.side_m.unwrap_or(f64::INFINITY);
        let mut out = String::from("# The paper's tables on these data\n\n");
        let _ = writeln!(
            out,
            "{} files ({} without a scene that can be read), {} scenes, {:.1} minutes of recordings, {} intervals of \
             {:.1} s; squares of {side_m:.0} m with at least {} road users; road users known at {} frames and at the \
             interval's end, who move. {} places: {} to learn from, {} for validation, {} for tests{}. Seed {}.\n",
            sets.files,
            sets.unreadable,
            sets.scenes,
            sets.seconds / 60.0,
            sets.intervals,
            options.interval_steps as f64 * scene::STEP_S,
            options.crop.least_agents,
            options.least_frames,
            sets.places.all(),
            sets.places.train,
            sets.places.validation,
            sets.places.test,
            match (self.own_tests, sets.shared_places) {
                (false, _) => ", a tenth each by the hash of the place".to_owned(),
                (true, 0) => ", which lie in a folder of their own; no place is in both".to_owned(),
                (true, n) => format!(
                    ", which lie in a folder of their own; {n} scenes to learn from were of their places and left out"
                ),
            },
            self.seed,
        );
        let _ = writeln!(
            out,
            "From {}. Licence of what was trained and drawn: {}.\n",
            sets.sources.words(),
            sets.sources.licence()
        );
        out += &self.sets_table();
        out += &self.training();
        for sheet in self.sheets {
            out += &sheet.markdown();
        }
        out += &self.reading();
        out
    }

    fn sets_table(&self) -> String {
        let mut sheet = Sheet::new(
            "Sets",
            &["Cases, and the road users in them, to learn from / for validation / for tests."],
            &["set"],
            &[
                "squares",
                "too few road users",
                "nobody to judge",
                "cases",
                "of the paper's",
                "road users",
                "records",
            ],
        );
        let shares = |s: &Shares| Cell::Text(format!("{} / {} / {}", s.train, s.validation, s.test));
        for centre in Centre::ALL {
            let set = &self.sets.sets[centre.index()];
            let part = 100.0 * set.cases.all() as f64 / paper::cases(centre) as f64;
            let cells = vec![
                Cell::Count(set.squares as u64),
                Cell::Count(set.too_few as u64),
                Cell::Count(set.nobody as u64),
                shares(&set.cases),
                Cell::Text(format!("{part:.2} % of {}", paper::cases(centre))),
                shares(&set.judged),
                Cell::Count(set.records as u64),
            ];
            sheet.push([centre.name()], cells);
        }
        sheet.markdown()
    }

    fn training(&self) -> String {
        let note = format!(
            "The condition's MLP is {} wide (the paper: 1024). Of each stage the weights with the least loss on what is \
             held out are kept. The paper: 100 epochs for the denoiser, 150 for regressors, 40 together.",
            self.condition_width
        );
        let mut sheet = Sheet::new("Training", &[&note], &["weights", "stage"], &["steps", "epochs"]);
        for own in self.trained {
            let cells = vec![Cell::Count(own.steps), Cell::Text(format!("{:.1}", own.epochs))];
            sheet.push([own.name.clone(), format!("{:?}", own.stage).to_lowercase()], cells);
        }
        sheet.markdown()
    }

    /// Conclusions that the amount of data supports.
    fn reading(&self) -> String {
        let mut out = String::from("### How far these tables go\n\n");
        for centre in Centre::ALL {
            let set = &self.sets.sets[centre.index()];
            let (learned, judged) = (set.judged.train, set.judged.test);
            let words = match (learned, judged) {
                (_, 0) => "nobody to judge: no figures".to_owned(),
                (0, _) => format!(
                    "{judged} judged, nobody to learn from: lines of networks trained on them are empty"
                ),
                (learned, judged) if judged < 30 => {
                    format!("{judged} judged, learned from {learned}: too few to rank methods by")
                }
                (learned, judged) => format!("{judged} judged, learned from {learned}"),
            };
            let _ = writeln!(out, "- {}: {words}.", centre.name());
        }
        let [pedestrians, cyclists] = self.interactive;
        let _ = writeln!(
            out,
            "- Table II: {} interactive scenes where the paper has 300{}.",
            pedestrians + cyclists,
            if pedestrians + cyclists < 30 { ": its intervals are wide" } else { "" }
        );
        let short = self.trained.iter().map(|own| own.epochs).fold(f64::INFINITY, f64::min);
        if short.is_finite() {
            let _ = writeln!(
                out,
                "- The shortest training saw its records {short:.1} times; networks of all lines but the shipped one have \
                 had the same records. The shipped weights learned from other, synthetic data and for longer."
            );
        }
        out
    }
}

fn write(path: &Path, text: &str) -> Result<()> {
    formats::files::replace(path, text.as_bytes()).with_context(|| format!("write {}", path.display()))
}

/// A sheet as comma-separated values: a figure with its interval takes four columns.
pub fn csv(sheet: &Sheet) -> String {
    let quoted = |text: &str| format!("\"{}\"", text.replace('"', "\"\""));
    let mut head: Vec<String> = sheet.keys.iter().map(|key| quoted(key)).collect();
    let mut last = "";
    for column in &sheet.columns {
        // A column named "paper" belongs to the one before it.
        if column == "paper" {
            head.push(quoted(&format!("{last} paper")));
        } else {
            last = column;
            head.extend(["", " low", " high", " n"].map(|part| quoted(&format!("{column}{part}"))));
        }
    }
    let mut out = head.join(",") + "\n";
    for line in &sheet.lines {
        let mut cells: Vec<String> = line.keys.iter().map(|key| quoted(key)).collect();
        for (cell, column) in line.cells.iter().zip(&sheet.columns) {
            match cell {
                Cell::Estimate { estimate: e, .. } => {
                    cells.extend([e.mean, e.low, e.high].map(|x| format!("{x:.5}")));
                    cells.push(e.samples.to_string());
                }
                Cell::Number { value, .. } => cells.push(format!("{value}")),
                Cell::Count(n) => cells.push(n.to_string()),
                Cell::Text(text) => cells.push(quoted(text)),
                Cell::Nothing => cells.extend(vec![String::new(); if column == "paper" { 1 } else { 4 }]),
            }
        }
        out += &(cells.join(",") + "\n");
    }
    out
}
