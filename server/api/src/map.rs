//! New maps from templates.

use crate::problem::Problem;
use formats::native::{AnyDoc, MapForm, SceneDoc};
use formats::refusals::parser_words;
use formats::{FieldProblem, ReadError};
use layouts::{
    ArmPlace, Built, Check, CornerPlace, JunctionPath, Layout, ParameterFault, TEMPLATES, Template,
};
use scene::{MAX_NAME_CHARS, Scene};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

/// Body of a new map.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MapBody {
    /// The template.
    pub template: Template,
    /// Parameters that replace those of the template; absent ones stay, and a list replaces a list. `Layout` has their
    /// names and ranges.
    #[serde(default)]
    #[schemars(with = "Option<std::collections::BTreeMap<String, serde_json::Value>>")]
    pub parameters: Option<AnyDoc>,
    /// Name of the scene. Default: that of the template.
    #[serde(default)]
    #[schemars(length(max = 200))]
    pub name: Option<String>,
}

/// A new map.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct MapReply {
    /// A scene with the map and no road users. Its `x_layout` has the template and its parameters.
    pub scene: SceneDoc,
    /// The template with all its parameters.
    pub layout: Layout,
    /// Checks of the map. A failed check is only a notice.
    pub checks: Vec<Check>,
    /// Positions of the arms, in the order of the parameters.
    pub arms: Vec<ArmPlace>,
    /// Bends of the kerbs between the arms.
    pub corners: Vec<CornerPlace>,
    /// Paths from lane to lane where roads meet at grade.
    pub ways: Vec<JunctionPath>,
}

/// A template and its own parameters.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct TemplateItem {
    /// Display name.
    pub title: &'static str,
    /// The template with all its parameters.
    #[schemars(with = "Layout")]
    pub layout: Value,
}

/// All templates.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[allow(missing_docs, reason = "the name says it")]
pub struct TemplateList {
    pub templates: Vec<TemplateItem>,
}

impl TemplateList {
    /// The templates of this build.
    pub fn current() -> Self {
        let item = |template: &Template| {
            let layout = json!({ "template": template.name(), "parameters": template.all_parameters() });
            TemplateItem { title: template.title(), layout }
        };
        Self { templates: TEMPLATES.iter().map(item).collect() }
    }
}

impl MapBody {
    /// Builds the map.
    ///
    /// # Errors
    /// Every fault of the parameters.
    pub fn draw(self) -> Result<(Layout, Scene, Built), Problem> {
        let name = self.name.unwrap_or_else(|| self.template.title().to_owned());
        let length = name.chars().count();
        if length > MAX_NAME_CHARS {
            let fault = FieldProblem::range("/name", 0.0, MAX_NAME_CHARS as f64, length as f64);
            return Err(ReadError::from(fault).into());
        }
        let layout = match self.parameters {
            None => self.template.layout(),
            Some(AnyDoc(given)) => {
                self.template.with(&given).map_err(|fault| refused_parameters(vec![fault]))?
            }
        };
        let (scene, built) = layouts::scene(&layout, &name).map_err(refused_parameters)?;
        Ok((layout, scene, built))
    }

    /// Builds the map and checks it.
    ///
    /// # Errors
    /// Every fault of the parameters.
    pub fn reply(self) -> Result<MapReply, Problem> {
        let (layout, scene, Built { checks, arms, corners, ways, .. }) = self.draw()?;
        let scene = SceneDoc::from_scene(&scene, MapForm::Inline);
        Ok(MapReply { scene, layout, checks, arms, corners, ways })
    }
}

fn refused_parameters(faults: Vec<ParameterFault>) -> Problem {
    let told = |fault: ParameterFault| {
        let pointer = format!("/parameters{}", fault.pointer);
        match fault.range {
            Some((least, most, got)) => FieldProblem::range(pointer, least, most, got),
            None => {
                FieldProblem::new(pointer, formats::problem::code::INVALID_FIELD, parser_words(&fault.reason))
            }
        }
    };
    ReadError::invalid(faults.into_iter().map(told).collect()).into()
}
