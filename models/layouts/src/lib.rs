//! Creates lane maps: a template with parameters becomes a map with its signals. Pure and deterministic.
//!
//! All templates are drawn for right-hand traffic. Left-hand traffic is the mirror image of the template with
//! mirrored angles, so that the arms keep their places.
//!
//! ```
//! use layouts::{Layout, Template};
//!
//! let mut layout = Template::FourArms.layout();
//! if let Layout::FourArms(junction) = &mut layout {
//!     junction.kerb_radius_m = 12.0;
//! }
//! let built = layouts::build(&layout).expect("twelve metres are in range");
//! assert!(built.checks.iter().all(|check| check.passed));
//! ```

mod car_park;
mod checks;
mod connect;
mod curve;
mod draft;
mod junction;
mod lights;
mod merge;
pub mod messages;
mod parameters;
mod ranges;
mod road;
mod roadway;
mod roundabout;
mod turns;

pub use checks::{Check, CheckKind};
pub use draft::{ArmPlace, CornerPlace, JunctionPath};
pub use parameters::{
    ARMS, Arm, CarPark, Connection, Connections, Control, Junction, LEAST_BETWEEN_ARMS_DEG, Merge, Program,
    Road, Roundabout, Traffic, Turn, TurnAcross,
};
pub use ranges::{ParameterFault, all as ranges};

use draft::MapDraft;
use scene::objects::Objects;
use scene::{HORIZON_STEPS, LaneMap, Meta, Scene, Signal};
use schemars::JsonSchema;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// Member of a scene that keeps the parameters of its map, so that they can be changed later.
pub const EXTRA: &str = "x_layout";

/// A layout by name, to start from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
#[allow(missing_docs, reason = "the names say it")]
pub enum Template {
    ThreeArms,
    FourArms,
    Roundabout,
    Merge,
    Straight,
    Curve,
    SchoolStreet,
    CarPark,
}

/// All templates, in the order in which they are offered.
pub const TEMPLATES: [Template; 8] = [
    Template::ThreeArms,
    Template::FourArms,
    Template::Roundabout,
    Template::Merge,
    Template::Straight,
    Template::Curve,
    Template::SchoolStreet,
    Template::CarPark,
];

/// A template with its parameters.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "template", content = "parameters", rename_all = "kebab-case")]
#[allow(missing_docs, reason = "the names say it")]
pub enum Layout {
    ThreeArms(Junction),
    FourArms(Junction),
    Roundabout(Roundabout),
    Merge(Merge),
    Straight(Road),
    Curve(Road),
    SchoolStreet(Road),
    CarPark(CarPark),
}

impl Template {
    /// The word for it.
    pub fn name(self) -> &'static str {
        match self {
            Self::ThreeArms => "three-arms",
            Self::FourArms => "four-arms",
            Self::Roundabout => "roundabout",
            Self::Merge => "merge",
            Self::Straight => "straight",
            Self::Curve => "curve",
            Self::SchoolStreet => "school-street",
            Self::CarPark => "car-park",
        }
    }

    /// Display name.
    pub fn title(self) -> &'static str {
        match self {
            Self::ThreeArms => "Three arms",
            Self::FourArms => "Four arms",
            Self::Roundabout => "Roundabout",
            Self::Merge => "Merge",
            Self::Straight => "Straight",
            Self::Curve => "Curve",
            Self::SchoolStreet => "School street",
            Self::CarPark => "Car park",
        }
    }

    /// A layout of this template with its default parameters.
    pub fn layout(self) -> Layout {
        match self {
            Self::ThreeArms => Layout::ThreeArms(Junction::three_arms()),
            Self::FourArms => Layout::FourArms(Junction::default()),
            Self::Roundabout => Layout::Roundabout(Roundabout::default()),
            Self::Merge => Layout::Merge(Merge::default()),
            Self::Straight => Layout::Straight(Road::default()),
            Self::Curve => Layout::Curve(Road::curve()),
            Self::SchoolStreet => Layout::SchoolStreet(Road::school_street()),
            Self::CarPark => Layout::CarPark(CarPark::default()),
        }
    }

    /// The parameters as a document, including those that serialization omits.
    pub fn all_parameters(self) -> Value {
        let mut own = self.layout().parameters();
        if let (Self::ThreeArms | Self::FourArms, Value::Object(members)) = (self, &mut own) {
            let none = serde_json::to_value(Connections::default()).unwrap_or_default();
            members.insert("connections".into(), none);
        }
        own
    }

    /// A layout with some parameters replaced: given members override those of the template, lists replace
    /// lists.
    ///
    /// # Errors
    /// What cannot be read, with its place below the parameters.
    pub fn with(self, given: &Value) -> Result<Layout, ParameterFault> {
        let mut whole = self.layout().parameters();
        lay_over(&mut whole, given);
        Ok(match self {
            Self::ThreeArms => Layout::ThreeArms(read(&whole)?),
            Self::FourArms => Layout::FourArms(read(&whole)?),
            Self::Roundabout => Layout::Roundabout(read(&whole)?),
            Self::Merge => Layout::Merge(read(&whole)?),
            Self::Straight => Layout::Straight(read(&whole)?),
            Self::Curve => Layout::Curve(read(&whole)?),
            Self::SchoolStreet => Layout::SchoolStreet(read(&whole)?),
            Self::CarPark => Layout::CarPark(read(&whole)?),
        })
    }
}

fn lay_over(whole: &mut Value, given: &Value) {
    match (whole, given) {
        (Value::Object(whole), Value::Object(given)) => {
            for (name, value) in given {
                lay_over(whole.entry(name.clone()).or_insert(Value::Null), value);
            }
        }
        (whole, given) => *whole = given.clone(),
    }
}

fn read<T: DeserializeOwned>(value: &Value) -> Result<T, ParameterFault> {
    serde_path_to_error::deserialize(Objects(value)).map_err(|error| ParameterFault::unreadable(&error))
}

impl Layout {
    /// The template.
    pub fn template(&self) -> Template {
        match self {
            Self::ThreeArms(_) => Template::ThreeArms,
            Self::FourArms(_) => Template::FourArms,
            Self::Roundabout(_) => Template::Roundabout,
            Self::Merge(_) => Template::Merge,
            Self::Straight(_) => Template::Straight,
            Self::Curve(_) => Template::Curve,
            Self::SchoolStreet(_) => Template::SchoolStreet,
            Self::CarPark(_) => Template::CarPark,
        }
    }

    /// The parameters as a document.
    pub fn parameters(&self) -> Value {
        let value = match self {
            Self::ThreeArms(p) | Self::FourArms(p) => serde_json::to_value(p),
            Self::Roundabout(p) => serde_json::to_value(p),
            Self::Merge(p) => serde_json::to_value(p),
            Self::Straight(p) | Self::Curve(p) | Self::SchoolStreet(p) => serde_json::to_value(p),
            Self::CarPark(p) => serde_json::to_value(p),
        };
        value.unwrap_or_default()
    }

    /// Side of the road on which traffic drives.
    pub fn traffic(&self) -> Traffic {
        match self {
            Self::ThreeArms(p) | Self::FourArms(p) => p.traffic,
            Self::Roundabout(p) => p.traffic,
            Self::Merge(p) => p.traffic,
            Self::Straight(p) | Self::Curve(p) | Self::SchoolStreet(p) => p.traffic,
            Self::CarPark(p) => p.traffic,
        }
    }
}

/// Result of drawing a layout.
#[derive(Clone, Debug, PartialEq)]
pub struct Built {
    /// The map.
    pub map: LaneMap,
    /// Its signals, over one planning window.
    pub signals: Vec<Signal>,
    /// Results of the checks; a failed check forbids nothing.
    pub checks: Vec<Check>,
    /// Positions of the arms, in the order of the parameters.
    pub arms: Vec<ArmPlace>,
    /// Positions of the bends of the kerbs between them, counter-clockwise.
    pub corners: Vec<CornerPlace>,
    /// Paths from lane to lane through a junction; none if the roads meet otherwise.
    pub ways: Vec<JunctionPath>,
}

/// Draws a layout.
///
/// # Errors
/// Parameters out of their range, and arms that are too close, each with its place below the parameters.
pub fn build(layout: &Layout) -> Result<Built, Vec<ParameterFault>> {
    let faults = ranges::faults(layout);
    if !faults.is_empty() {
        return Err(faults);
    }
    let mut draft = match layout {
        Layout::ThreeArms(p) | Layout::FourArms(p) => junction::draw(&p.clone().without_slivers()),
        Layout::Roundabout(p) => roundabout::draw(&p.clone().without_slivers()),
        Layout::Merge(p) => merge::draw(p),
        Layout::Straight(p) | Layout::Curve(p) | Layout::SchoolStreet(p) => {
            road::draw(&p.clone().without_slivers())
        }
        Layout::CarPark(p) => car_park::draw(&p.clone().without_slivers()),
    };
    if let Layout::ThreeArms(Junction { arms, .. })
    | Layout::FourArms(Junction { arms, .. })
    | Layout::Roundabout(Roundabout { arms, .. }) = layout
    {
        junction::named(&mut draft, arms);
    }
    let checks = checks::all(&draft);
    if layout.traffic() == Traffic::LeftHand {
        draft = draft.mirrored();
    }
    let checks = if layout.traffic() == Traffic::LeftHand {
        checks.into_iter().map(Check::mirrored).collect()
    } else {
        checks
    };
    let ways = draft.ways();
    let MapDraft { map, signals, arms, corners, .. } = draft;
    Ok(Built { map, signals, checks, arms, corners, ways })
}

/// A scene of a layout, without road users. It keeps the parameters of its map under [`EXTRA`].
///
/// # Errors
/// Those of [`build`].
pub fn scene(layout: &Layout, name: &str) -> Result<(Scene, Built), Vec<ParameterFault>> {
    let built = build(layout)?;
    let mut scene = Scene::bare(name, built.map.clone(), Vec::new());
    debug_assert_eq!(scene.time.steps, HORIZON_STEPS + 1);
    scene.signals = built.signals.clone();
    scene.meta = Meta { source: "drawn".into(), licence: Some("cc0".into()), ..Meta::default() };
    scene.extra.insert(EXTRA.into(), serde_json::to_value(layout).unwrap_or_default());
    Ok((scene, built))
}
