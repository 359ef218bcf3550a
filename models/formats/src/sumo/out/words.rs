//! Types of road users, with names from which the reader of recordings gets kind and size.

use crate::markup::decimal;
use crate::sumo::kinds;
use scene::{AgentType, Size, Subtype};

/// A type of vehicles or persons.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct VehicleType {
    /// Id such as `car_4.5x1.8x1.5m`, with length, width and height.
    pub id: String,
    /// SUMO's vehicle class, which decides the lanes it may use.
    pub class: &'static str,
    /// Whether it is a type of persons.
    pub person: bool,
}

fn word(agent_type: AgentType, subtype: Subtype) -> (&'static str, &'static str) {
    match (agent_type, subtype) {
        (AgentType::Vehicle, Subtype::Truck) => ("truck", "truck"),
        (AgentType::Vehicle, Subtype::Bus) => ("bus", "bus"),
        (AgentType::Vehicle, Subtype::Van) => ("van", "delivery"),
        (AgentType::Vehicle, Subtype::Motorcycle) => ("motorcycle", "motorcycle"),
        (AgentType::Vehicle, Subtype::Trailer) => ("trailer", "trailer"),
        (AgentType::Vehicle, Subtype::Emergency) => ("emergency", "emergency"),
        (AgentType::Vehicle, _) => ("car", "passenger"),
        (AgentType::Cyclist, Subtype::Scooter) => ("scooter", "scooter"),
        (AgentType::Cyclist, _) => ("bicycle", "bicycle"),
        (AgentType::Pedestrian, Subtype::Child) => ("child", "pedestrian"),
        (AgentType::Pedestrian, Subtype::Wheelchair) => ("wheelchair", "wheelchair"),
        (AgentType::Pedestrian, _) => ("pedestrian", "pedestrian"),
        (AgentType::Other, _) => ("container", "custom1"),
    }
}

/// The type of a road user.
pub(super) fn kind(agent_type: AgentType, subtype: Subtype, size: &Size) -> VehicleType {
    let (word, class) = word(agent_type, subtype);
    let sides = [Some(size.length_m), Some(size.width_m), size.height_m];
    let sides: Vec<String> = sides.into_iter().flatten().map(decimal).collect();
    let id = format!("{word}_{}{}", sides.join("x"), kinds::METRES);
    VehicleType { id, class, person: agent_type == AgentType::Pedestrian }
}
