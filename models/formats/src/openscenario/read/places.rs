//! Positions of a scenario, as far as its road network resolves them.

use super::parameters::{attribute, number};
use crate::opendrive::places::RoadPlaces;
use crate::problem::ReadError;
use crate::tree::XmlNode;
use scene::Vec2;
use scene::geometry::rotate;
use std::collections::HashMap;
use std::f64::consts::PI;

/// Pose of a road user's reference point, in the frame of the map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pose {
    pub at: Vec2,
    /// Heading, radians; `None` if the file neither states nor implies it.
    pub heading_rad: Option<f64>,
}

/// Objects to which positions refer.
#[derive(Default)]
pub(super) struct ScenarioPlaces {
    pub roads: Option<RoadPlaces>,
    /// Initial poses by the name of the entity.
    pub entities: HashMap<String, Pose>,
}

/// Attributes that are offsets along and across something.
type Offsets = (f64, f64);

impl ScenarioPlaces {
    /// The pose of a `<Position>`; nothing for one that cannot be resolved.
    ///
    /// # Errors
    /// `invalid-field` for a value that is not a number.
    pub fn of(&self, position: &XmlNode) -> Result<Option<Pose>, ReadError> {
        let Some(node) = position.children.first() else { return Ok(None) };
        let value = |name| Ok::<f64, ReadError>(number(node, name)?.unwrap_or(0.0));
        let pair = |a, b| Ok::<Offsets, ReadError>((value(a)?, value(b)?));
        Ok(match node.name() {
            "WorldPosition" => {
                let (x, y) = pair("x", "y")?;
                let at = self.roads.as_ref().map_or(Vec2::new(x, y), |roads| roads.local(Vec2::new(x, y)));
                Some(Pose { at, heading_rad: number(node, "h")? })
            }
            "RelativeWorldPosition" => match self.entity(node) {
                Some(entity) => {
                    let (dx, dy) = pair("dx", "dy")?;
                    Some(turned(entity.at + Vec2::new(dx, dy), entity.heading_rad, node)?)
                }
                None => None,
            },
            "RelativeObjectPosition" => match self.entity(node) {
                Some(Pose { at, heading_rad: Some(heading_rad) }) => {
                    let (dx, dy) = pair("dx", "dy")?;
                    Some(turned(at + rotate(Vec2::new(dx, dy), heading_rad), Some(heading_rad), node)?)
                }
                _ => None,
            },
            "RoadPosition" => self.on_road(node, attribute(node, "roadId"), pair("s", "t")?)?,
            "LanePosition" => {
                let lane = attribute(node, "laneId").trim().parse::<i32>().ok();
                let (s_m, offset_m) = pair("s", "offset")?;
                match lane {
                    Some(lane) => self.on_lane(node, attribute(node, "roadId"), lane, (s_m, offset_m))?,
                    None => None,
                }
            }
            "RelativeRoadPosition" => match self.found(node) {
                Some((road, (s_m, t_m), _)) => {
                    let (ds, dt) = pair("ds", "dt")?;
                    self.on_road(node, &road, (s_m + ds, t_m + dt))?
                }
                None => None,
            },
            "RelativeLanePosition" => match self.found(node) {
                // Lanes with traffic along the road have negative numbers from its middle: the next lane to
                // the left has the next number.
                Some((road, (s_m, _), Some(lane))) if lane < 0 => {
                    let (lanes, offset_m) = pair("dLane", "offset")?;
                    let along = number(node, "ds")?.or(number(node, "dsLane")?).unwrap_or(0.0);
                    let target = lane + lanes as i32;
                    if target < 0 {
                        self.on_lane(node, &road, target, (s_m + along, offset_m))?
                    } else {
                        None
                    }
                }
                _ => None,
            },
            _ => None,
        })
    }

    fn entity(&self, node: &XmlNode) -> Option<Pose> {
        self.entities.get(attribute(node, "entityRef")).copied()
    }

    fn found(&self, node: &XmlNode) -> Option<(String, Offsets, Option<i32>)> {
        self.roads.as_ref()?.found(self.entity(node)?.at)
    }

    fn on_road(&self, node: &XmlNode, road: &str, at: Offsets) -> Result<Option<Pose>, ReadError> {
        let found = self.roads.as_ref().and_then(|roads| roads.road(road, at.0, at.1));
        found.map(|(at, along_rad)| turned(at, Some(along_rad), node)).transpose()
    }

    /// Without an orientation, the heading is that of the lane.
    fn on_lane(&self, node: &XmlNode, road: &str, lane: i32, at: Offsets) -> Result<Option<Pose>, ReadError> {
        let found = self.roads.as_ref().and_then(|roads| roads.lane(road, lane, at.0, at.1));
        let Some((at, along_rad, against)) = found else { return Ok(None) };
        if against && node.child("Orientation").is_none() {
            return Ok(Some(Pose { at, heading_rad: Some(along_rad + PI) }));
        }
        turned(at, Some(along_rad), node).map(Some)
    }
}

/// A pose with the orientation of a position, which is relative to a heading unless it is absolute.
fn turned(at: Vec2, base_rad: Option<f64>, node: &XmlNode) -> Result<Pose, ReadError> {
    let Some(orientation) = node.child("Orientation") else { return Ok(Pose { at, heading_rad: base_rad }) };
    let h = number(orientation, "h")?;
    let relative = attribute(orientation, "type") == "relative";
    let heading_rad = match (h, relative) {
        (Some(h), true) => base_rad.map(|base| base + h),
        (Some(h), false) => Some(h),
        (None, _) => base_rad,
    };
    Ok(Pose { at, heading_rad })
}
