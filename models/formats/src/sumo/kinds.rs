//! Kinds of road users by the name of their vehicle type. FCD has only the name; classes and default sizes
//! are those of SUMO (`Vehicle_Type_Parameter_Defaults` of its documentation).

use scene::{AgentType, Size, Subtype};

/// Kind and default size of a road user of SUMO.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct AgentKind {
    pub agent_type: AgentType,
    pub subtype: Subtype,
    pub size: Size,
}

type Row = (&'static [&'static str], AgentType, Subtype, (f64, f64, f64));

/// Parts of names, of which the first match counts; length, width, height in metres.
const ROWS: &[Row] = &[
    (
        &["pedestrian", "pedtype", "person", "walker"],
        AgentType::Pedestrian,
        Subtype::Adult,
        (0.85, 0.85, 1.75),
    ),
    (&["child"], AgentType::Pedestrian, Subtype::Child, (0.5, 0.5, 1.2)),
    (&["wheelchair"], AgentType::Pedestrian, Subtype::Wheelchair, (1.1, 0.7, 1.3)),
    (&["motorcycle", "motorbike", "moped"], AgentType::Vehicle, Subtype::Motorcycle, (2.2, 0.9, 1.5)),
    (&["bicycle", "bike", "cycl"], AgentType::Cyclist, Subtype::Bicycle, (1.6, 0.65, 1.7)),
    (&["scooter"], AgentType::Cyclist, Subtype::Scooter, (1.2, 0.5, 1.7)),
    (&["trailer", "semi"], AgentType::Vehicle, Subtype::Truck, (16.5, 2.55, 4.0)),
    (&["truck", "lorry", "hgv"], AgentType::Vehicle, Subtype::Truck, (7.1, 2.4, 2.4)),
    (&["coach"], AgentType::Vehicle, Subtype::Bus, (14.0, 2.6, 4.0)),
    (&["tram"], AgentType::Other, Subtype::Unknown, (22.0, 2.4, 3.2)),
    (&["rail", "train", "subway"], AgentType::Other, Subtype::Unknown, (36.5, 3.0, 3.6)),
    (&["bus"], AgentType::Vehicle, Subtype::Bus, (12.0, 2.5, 3.4)),
    (&["delivery", "van"], AgentType::Vehicle, Subtype::Van, (6.5, 2.16, 2.86)),
    (
        &["emergency", "ambulance", "police", "fire"],
        AgentType::Vehicle,
        Subtype::Emergency,
        (6.5, 2.16, 2.86),
    ),
    (&["ship", "aircraft", "drone", "container"], AgentType::Other, Subtype::Unknown, (6.0, 2.5, 3.0)),
];

/// Unit after the sizes in a type name, such as `car_4.5x1.8x1.5m`: length, width and height.
pub(super) const METRES: &str = "m";

/// The box in a type's name; the height is optional.
pub(super) fn size_of(type_name: &str) -> Option<Size> {
    let (_, sides) = type_name.strip_suffix(METRES)?.rsplit_once('_')?;
    let side = |text: &str| text.parse::<f64>().ok().filter(|side| (0.05..=60.0).contains(side));
    let mut sides = sides.split('x');
    let (length, width, height) = (sides.next()?, sides.next()?, sides.next());
    let height_m = match height {
        Some(height) => Some(side(height)?),
        None => None,
    };
    Some(Size { length_m: side(length)?, width_m: side(width)?, height_m })
}

/// The kind in a type's name, otherwise a passenger car. `person` marks FCD's persons, whatever their name.
pub(super) fn of(type_name: &str, person: bool) -> AgentKind {
    let name = type_name.to_ascii_lowercase();
    let fits = |row: &&Row| row.0.iter().any(|part| name.contains(part));
    let on_foot = |row: &&Row| row.1 == AgentType::Pedestrian;
    let found = match person {
        true => ROWS.iter().filter(on_foot).find(fits).or(ROWS.first()),
        false => ROWS.iter().find(fits),
    };
    let car = (AgentType::Vehicle, Subtype::Car, (5.0, 1.8, 1.5));
    let (agent_type, subtype, (length_m, width_m, height_m)) = found.map_or(car, |row| (row.1, row.2, row.3));
    let usual = Size { length_m, width_m, height_m: Some(height_m) };
    AgentKind { agent_type, subtype, size: size_of(type_name).unwrap_or(usual) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_tell_sizes() {
        let size = size_of("my_bus_12.5x2.5x3m").unwrap();
        assert_eq!((size.length_m, size.width_m, size.height_m), (12.5, 2.5, Some(3.0)));
        assert_eq!(size_of("car_4x2m").unwrap().height_m, None);
        for name in ["car", "car_4x2", "car_4m", "4x2m", "car_4x0m", "car_4xNaNm", "car_4x2xm"] {
            assert_eq!(size_of(name), None, "{name}");
        }
    }

    #[test]
    fn names_tell_kinds() {
        let kinds = [
            ("DEFAULT_VEHTYPE", false, AgentType::Vehicle, Subtype::Car),
            ("DEFAULT_BIKETYPE", false, AgentType::Cyclist, Subtype::Bicycle),
            ("motorbike3", false, AgentType::Vehicle, Subtype::Motorcycle),
            ("veh_Truck", false, AgentType::Vehicle, Subtype::Truck),
            ("bus", false, AgentType::Vehicle, Subtype::Bus),
            ("tram_7", false, AgentType::Other, Subtype::Unknown),
            ("DEFAULT_PEDTYPE", false, AgentType::Pedestrian, Subtype::Adult),
            ("", true, AgentType::Pedestrian, Subtype::Adult),
            ("truck", true, AgentType::Pedestrian, Subtype::Adult),
            ("a_wheelchair", true, AgentType::Pedestrian, Subtype::Wheelchair),
        ];
        for (name, person, agent_type, subtype) in kinds {
            let kind = of(name, person);
            assert_eq!((kind.agent_type, kind.subtype), (agent_type, subtype), "{name}");
        }
    }
}
