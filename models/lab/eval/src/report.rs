//! Results of an evaluation, as Markdown, JSON and files.

use super::sheet::Sheet;
use anyhow::{Context, Result};
use lab_train::scenes::Crop;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::Path;

/// The tables as Markdown, in the folder of a run.
pub const TABLES_FILE: &str = "tables.md";

/// Effect of a crop.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct CropReport {
    /// The crop.
    #[serde(flatten)]
    pub crop: Crop,
    /// Scenes that were left out because they have too few road users.
    pub scenes_left_out: usize,
    /// Road users outside the crop, in the scenes that were kept.
    pub road_users_outside: usize,
}

/// Results of an evaluation.
#[derive(Clone, Debug, Serialize)]
pub struct EvalReport {
    /// Seed.
    pub seed: u64,
    /// Scenes evaluated.
    pub scenes: usize,
    /// Effect of the crop before the evaluation; `None` without a crop.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub crop: Option<CropReport>,
    /// Hash of each expert's weights, by the name of the evaluated weights.
    pub weights: BTreeMap<String, BTreeMap<String, String>>,
    /// All tables except table 6 and the times of table 8.
    pub sheets: Vec<Sheet>,
    /// Table 6 and the times of table 8, which differ in each run.
    #[serde(skip)]
    pub cost: Vec<Sheet>,
    /// File name and SVG.
    #[serde(skip)]
    pub pictures: Vec<(String, String)>,
}

impl EvalReport {
    /// All tables except table 6 and the times of table 8, as Markdown.
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
            formats::files::replace(&path, text.as_bytes())
                .with_context(|| format!("write {}", path.display()))
        };
        write(TABLES_FILE, &self.markdown())?;
        write("tables.json", &format!("{}\n", serde_json::to_string_pretty(self)?))?;
        if !self.cost.is_empty() {
            write("cost.md", &self.cost.iter().map(Sheet::markdown).collect::<String>())?;
            write("cost.json", &format!("{}\n", serde_json::to_string_pretty(&self.cost)?))?;
        }
        for (name, picture) in &self.pictures {
            write(&format!("pictures/{name}"), picture)?;
        }
        Ok(())
    }
}
