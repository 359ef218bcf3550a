//! Kinds of road users of one seed: driver and body parameters, as SUMO's vehicle types.

use scene::random::Stream;
use scene::{AgentType, Size, Subtype};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// A kind of road user.
#[derive(Clone, Copy, Debug)]
pub struct ActorKind {
    /// Type in scenes.
    pub agent_type: AgentType,
    /// Finer type in scenes.
    pub subtype: Subtype,
    /// Box.
    pub size: Size,
    /// Whether SUMO moves it as a person (pedestrians, and cyclists on sidewalks).
    pub on_foot: bool,
}

/// All kinds of a seed.
#[derive(Clone, Debug, Default)]
pub struct Fleet {
    /// Kinds by SUMO's type id.
    pub kinds: BTreeMap<String, ActorKind>,
    /// Ids by group: `car`, `truck`, `bus`, `moto`, `cycle`, `walker`, `jogger`, `sidewalk_cycle`.
    pub groups: BTreeMap<&'static str, Vec<String>>,
    /// `<vType>` elements.
    pub xml: String,
    /// Lookahead factor of lane choice (`lcStrategic`); SUMO's default is 1.
    strategic: f64,
}

fn size(length: f64, width: f64, height: f64) -> Size {
    Size { length_m: length, width_m: width, height_m: Some(height) }
}

impl Fleet {
    /// Draws the kinds of a seed. Streets are short, so drivers there change lanes with a smaller lookahead
    /// than by default. On a motorway, a vehicle that changes lanes too late for its exit stops and blocks
    /// the road.
    pub fn new(draw: &mut Stream, motorway: bool) -> Self {
        let mut fleet = Self { strategic: if motorway { 4.0 } else { 0.5 }, ..Self::default() };
        for _ in 0..24 {
            fleet.car(draw);
        }
        fleet.heavy(draw);
        fleet.on_two_wheels(draw);
        fleet.on_foot(draw);
        fleet
    }

    /// An id of a group, drawn uniformly; empty if the group is empty.
    pub fn pick(&self, draw: &mut Stream, group: &str) -> &str {
        let ids = self.groups.get(group).map(Vec::as_slice).unwrap_or_default();
        ids.get(draw.below(ids.len())).map(String::as_str).unwrap_or_default()
    }

    fn add(&mut self, group: &'static str, kind: ActorKind, class: &str, rest: &str) {
        let ids = self.groups.entry(group).or_default();
        let id = format!("{group}{}", ids.len());
        ids.push(id.clone());
        let (l, w) = (kind.size.length_m, kind.size.width_m);
        let _ = writeln!(
            self.xml,
            r#"<vType id="{id}" vClass="{class}" length="{l:.2}" width="{w:.2}" {rest}/>"#
        );
        self.kinds.insert(id, kind);
    }

    fn car(&mut self, draw: &mut Stream) {
        let big = draw.chance(0.3);
        let length = draw.clipped(if big { 5.3 } else { 4.65 }, 0.3, 3.9, 6.3);
        let width = draw.clipped(if big { 2.19 } else { 2.04 }, 0.09, 1.81, 2.46);
        // Aggressiveness of the driver; all parameters depend on it.
        let g = draw.normal();
        let accel = draw.clipped(2.6 + 0.35 * g, 0.5, 1.4, 4.5);
        let decel = draw.clipped(2.2 + 0.4 * g, 0.45, 1.2, 4.0);
        let tau = draw.clipped(0.95 - 0.2 * g, 0.2, 0.55, 1.9);
        let gap = draw.clipped(2.9 - 0.2 * g, 0.6, 1.4, 5.0);
        let rest = format!(
            "carFollowModel=\"IDM\" accel=\"{accel:.2}\" decel=\"{decel:.2}\" emergencyDecel=\"8\" tau=\"{tau:.2}\" \
             delta=\"4\" minGap=\"{gap:.2}\" stepping=\"0.1\" speedFactor=\"normc({:.2},0.08,0.65,1.4)\" \
             laneChangeModel=\"SL2015\" lcKeepRight=\"0\" lcSublane=\"1\" lcStrategic=\"{}\" \
             lcSpeedGain=\"{:.2}\" maxSpeedLat=\"{:.2}\" lcAccelLat=\"0.7\" minGapLat=\"0.5\" latAlignment=\"{}\" \
             impatience=\"{:.2}\" jmDriveAfterYellowTime=\"{:.2}\" jmTimegapMinor=\"{:.2}\"",
            1.03 + 0.07 * g,
            self.strategic,
            draw.clipped(0.12, 0.12, 0.0, 0.6),
            draw.clipped(0.9, 0.2, 0.5, 1.4),
            draw.one_of(["center", "center", "arbitrary"]),
            draw.clipped(0.2 + 0.15 * g, 0.1, 0.0, 0.8),
            draw.clipped(1.2, 0.6, 0.0, 3.0),
            draw.clipped(1.2 - 0.2 * g, 0.2, 0.6, 2.1),
        );
        let kind = ActorKind {
            agent_type: AgentType::Vehicle,
            subtype: Subtype::Car,
            size: size(length, width, 1.7),
            on_foot: false,
        };
        self.add("car", kind, "passenger", &rest);
    }

    fn heavy(&mut self, draw: &mut Stream) {
        let model = |accel: f64, decel: f64, tau: f64, factor: &str| {
            format!(
                "carFollowModel=\"IDM\" accel=\"{accel:.2}\" decel=\"{decel:.2}\" emergencyDecel=\"7\" tau=\"{tau:.1}\" \
                 minGap=\"2.8\" laneChangeModel=\"SL2015\" lcKeepRight=\"0\" maxSpeedLat=\"0.7\" minGapLat=\"0.5\" \
                 lcAccelLat=\"0.6\" speedFactor=\"normc({factor})\""
            )
        };
        let kind =
            |subtype, size| ActorKind { agent_type: AgentType::Vehicle, subtype, size, on_foot: false };
        for _ in 0..4 {
            let body = size(draw.clipped(8.5, 1.8, 6.0, 13.0), draw.clipped(2.45, 0.1, 2.2, 2.6), 3.2);
            let rest = model(1.25, 2.1, 1.5, "0.92,0.08,0.7,1.1") + " maxSpeed=\"27\"";
            self.add("truck", kind(Subtype::Truck, body), "truck", &rest);
        }
        let rest = model(0.95, 2.1, 1.7, "0.9,0.06,0.7,1.05") + " maxSpeed=\"25\"";
        self.add("truck", kind(Subtype::Truck, size(16.5, 2.55, 3.9)), "trailer", &rest);
        for length in [12.2, 10.5] {
            let rest = model(1.1, 1.9, 1.5, "0.9,0.06,0.7,1.05");
            self.add("bus", kind(Subtype::Bus, size(length, 2.6, 3.2)), "bus", &rest);
        }
        for _ in 0..2 {
            let rest = model(3.0, 3.0, 1.0, "1.08,0.1,0.8,1.4");
            self.add("moto", kind(Subtype::Motorcycle, size(2.2, 0.85, 1.4)), "motorcycle", &rest);
        }
    }

    fn on_two_wheels(&mut self, draw: &mut Stream) {
        let kind = |width, on_foot| ActorKind {
            agent_type: AgentType::Cyclist,
            subtype: Subtype::Bicycle,
            size: size(1.8, width, 1.75),
            on_foot,
        };
        for _ in 0..6 {
            let rest = format!(
                "carFollowModel=\"IDM\" accel=\"{:.2}\" decel=\"2.2\" tau=\"1.0\" minGap=\"1.0\" maxSpeed=\"{:.2}\" \
                 speedFactor=\"normc(1,0.1,0.6,1.4)\" laneChangeModel=\"SL2015\" latAlignment=\"right\" \
                 minGapLat=\"0.3\" lcKeepRight=\"1\"",
                draw.clipped(1.0, 0.2, 0.5, 1.5),
                draw.clipped(5.0, 1.1, 2.8, 7.5),
            );
            self.add("cycle", kind(0.75, false), "bicycle", &rest);
        }
        for _ in 0..3 {
            let rest = format!(
                "desiredMaxSpeed=\"{:.2}\" maxSpeed=\"6\" minGap=\"0.5\"",
                draw.clipped(3.6, 0.8, 2.0, 5.5)
            );
            self.add("sidewalk_cycle", kind(0.8, true), "pedestrian", &rest);
        }
    }

    fn on_foot(&mut self, draw: &mut Stream) {
        let kind = |size| ActorKind {
            agent_type: AgentType::Pedestrian,
            subtype: Subtype::Adult,
            size,
            on_foot: true,
        };
        for _ in 0..9 {
            let body = size(draw.clipped(0.85, 0.1, 0.6, 1.1), draw.clipped(0.85, 0.1, 0.6, 1.1), 1.75);
            let rest = format!(
                "desiredMaxSpeed=\"{:.2}\" maxSpeed=\"3\" minGap=\"0.25\" speedFactor=\"normc(1,0.08,0.6,1.4)\"",
                draw.clipped(1.42, 0.25, 0.8, 2.2)
            );
            self.add("walker", kind(body), "pedestrian", &rest);
        }
        let rest = "desiredMaxSpeed=\"2.7\" maxSpeed=\"4\" minGap=\"0.3\"";
        self.add("jogger", kind(size(0.6, 0.6, 1.75)), "pedestrian", rest);
    }
}
