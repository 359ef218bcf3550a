//! Road users of a scenario: their kind, their size, and the position of their box relative to their
//! reference point.

use super::parameters::{Scope, attribute, number};
use crate::format::EGO;
use crate::problem::ReadError;
use crate::recording::kind_of;
use crate::tree::XmlNode;
use scene::{AgentType, Subtype, Vec2};
use std::collections::HashMap;

/// Names that scenarios give their ego.
const EGO_NAMES: [&str; 3] = ["ego", "hero", "ego_vehicle"];

/// Entries of catalogs by the names of the catalog and of the entry.
pub(super) type Catalogs = HashMap<(String, String), XmlNode>;

/// The entry that a `<CatalogReference>` names, with its parameters.
///
/// # Errors
/// `invalid-field` for an unknown parameter.
pub(super) fn entry(
    catalogs: &Catalogs,
    scope: &Scope,
    reference: &XmlNode,
) -> Result<Option<(XmlNode, Scope)>, ReadError> {
    let name = |name| attribute(reference, name).to_owned();
    let Some(found) = catalogs.get(&(name("catalogName"), name("entryName"))) else { return Ok(None) };
    let assigned = reference.all("ParameterAssignments").flat_map(|list| list.all("ParameterAssignment"));
    let given = assigned.map(|one| {
        (
            attribute(one, "parameterRef").trim_start_matches('$').to_owned(),
            attribute(one, "value").to_owned(),
        )
    });
    let scope = scope.declared(found, &given.collect())?;
    let mut found = found.clone();
    scope.fill(&mut found);
    Ok(Some((found, scope)))
}

/// A road user.
#[derive(Clone, Debug)]
pub(super) struct Entity {
    pub name: String,
    pub agent_type: AgentType,
    pub subtype: Subtype,
    pub role: Option<String>,
    pub size_m: [Option<f64>; 3],
    /// Offset of the box's centre from the reference point: ahead and to the left, metres.
    pub middle: Vec2,
}

impl Entity {
    /// The road user of a `<Vehicle>`, `<Pedestrian>` or `<MiscObject>` element.
    ///
    /// # Errors
    /// `invalid-field` for a value that is not a number.
    pub fn of(name: &str, node: &XmlNode) -> Result<Option<Self>, ReadError> {
        let category = |attribute_name| attribute(node, attribute_name).to_ascii_lowercase();
        let (agent_type, subtype) = match node.name() {
            "Vehicle" => match category("vehicleCategory").as_str() {
                "bicycle" => (AgentType::Cyclist, Subtype::Bicycle),
                "motorbike" => (AgentType::Vehicle, Subtype::Motorcycle),
                "semitrailer" | "trailer" => (AgentType::Vehicle, Subtype::Trailer),
                "train" | "tram" => (AgentType::Vehicle, Subtype::Unknown),
                word => kind_of(word).unwrap_or((AgentType::Vehicle, Subtype::Unknown)),
            },
            "Pedestrian" => match category("pedestrianCategory").as_str() {
                "wheelchair" => (AgentType::Pedestrian, Subtype::Wheelchair),
                "animal" => (AgentType::Other, Subtype::Unknown),
                // A name that this program writes.
                _ if attribute(node, "name") == "child" => (AgentType::Pedestrian, Subtype::Child),
                _ if attribute(node, "name") == "adult" => (AgentType::Pedestrian, Subtype::Adult),
                _ => (AgentType::Pedestrian, Subtype::Unknown),
            },
            "MiscObject" => (AgentType::Other, Subtype::Unknown),
            _ => return Ok(None),
        };
        let dimension = |name| match node.at(&["BoundingBox", "Dimensions"]) {
            Some(dimensions) => number(dimensions, name).map(|v| v.filter(|v| (0.05..=100.0).contains(v))),
            None => Ok(None),
        };
        let center = node.at(&["BoundingBox", "Center"]);
        let ahead = |name| center.map_or(Ok(None), |center| number(center, name));
        let properties = || node.all("Properties").flat_map(|list| list.all("Property"));
        let said = |name: &str| {
            let found = properties().find(|one| attribute(one, "name") == name);
            found.map(|one| attribute(one, "value")).filter(|value| !value.is_empty())
        };
        let is_ego = said("type").is_some_and(|kind| kind == "ego_vehicle")
            || EGO_NAMES.contains(&name.to_ascii_lowercase().as_str());
        // A role that this program writes takes precedence over a name.
        let role = said("role").or(is_ego.then_some(EGO));
        Ok(Some(Self {
            name: name.to_owned(),
            agent_type,
            subtype,
            role: role.map(str::to_owned),
            size_m: [dimension("length")?, dimension("width")?, dimension("height")?],
            middle: Vec2::new(ahead("x")?.unwrap_or(0.0), ahead("y")?.unwrap_or(0.0)),
        }))
    }
}
