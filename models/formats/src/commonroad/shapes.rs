//! Shapes of obstacles and places of goals, as boxes.

use crate::problem::ReadError;
use crate::refusals::wanted;
use crate::tree::XmlNode;
use scene::geometry::rotate;
use scene::{Vec2, wrap_angle};

/// Greatest distance of a coordinate of a file from its origin, metres.
const MAX_SOURCE_M: f64 = 1e8;

/// A shape as the box around it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Shape {
    pub centre: Vec2,
    pub heading_rad: f64,
    pub length_m: f64,
    pub width_m: f64,
    /// Whether the place has an extent.
    pub is_area: bool,
    /// Whether the shape is not a box itself.
    pub approximated: bool,
}

/// A point.
///
/// # Errors
/// `invalid-field`.
pub(super) fn point(node: &XmlNode) -> Result<Vec2, ReadError> {
    let coordinate = |name: &str| {
        let node = node.required(name)?;
        let value = node.number()?;
        if value.abs() > MAX_SOURCE_M {
            return Err(node.wrong(&node.text, wanted::METRES));
        }
        Ok(value)
    };
    Ok(Vec2::new(coordinate("x")?, coordinate("y")?))
}

/// All shapes in an element.
///
/// # Errors
/// `invalid-field`.
pub(super) fn all(node: &XmlNode) -> Result<Vec<Shape>, ReadError> {
    let mut shapes = Vec::new();
    for child in &node.children {
        shapes.extend(shape(child)?);
    }
    Ok(shapes)
}

fn shape(node: &XmlNode) -> Result<Option<Shape>, ReadError> {
    let centre = || node.child("center").map_or(Ok(Vec2::zeros()), point);
    let plain = Shape {
        centre: Vec2::zeros(),
        heading_rad: 0.0,
        length_m: 0.0,
        width_m: 0.0,
        is_area: true,
        approximated: false,
    };
    let size = |name: &str| {
        let node = node.required(name)?;
        node.number().and_then(|v| if v >= 0.0 { Ok(v) } else { Err(node.wrong(&node.text, wanted::SIZE)) })
    };
    Ok(Some(match node.name() {
        "point" => Shape { centre: point(node)?, is_area: false, ..plain },
        "rectangle" => Shape {
            centre: centre()?,
            heading_rad: wrap_angle(node.child("orientation").map_or(Ok(0.0), XmlNode::number)?),
            length_m: size("length")?,
            width_m: size("width")?,
            ..plain
        },
        "circle" => {
            let across_m = 2.0 * size("radius")?;
            Shape { centre: centre()?, length_m: across_m, width_m: across_m, ..plain }
        }
        "polygon" => {
            let corners = node.all("point").map(point).collect::<Result<Vec<_>, _>>()?;
            match around(&corners) {
                Some(shape) => Shape { approximated: true, ..shape },
                None => return Ok(None),
            }
        }
        _ => return Ok(None),
    }))
}

/// The axis-aligned box around points.
fn around(points: &[Vec2]) -> Option<Shape> {
    let (first, rest) = points.split_first()?;
    let (low, high) = rest.iter().fold((*first, *first), |(low, high), p| (low.inf(p), high.sup(p)));
    let size = high - low;
    Some(Shape {
        centre: (low + high) / 2.0,
        heading_rad: 0.0,
        length_m: size.x,
        width_m: size.y,
        is_area: true,
        approximated: false,
    })
}

/// One box around several shapes.
pub(super) fn enclosing(shapes: &[Shape]) -> Option<Shape> {
    if let [only] = shapes {
        return Some(*only);
    }
    let corners = shapes.iter().flat_map(|shape| {
        let half = Vec2::new(shape.length_m / 2.0, shape.width_m / 2.0);
        [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)]
            .map(|(x, y)| shape.centre + rotate(Vec2::new(half.x * x, half.y * y), shape.heading_rad))
    });
    around(&corners.collect::<Vec<_>>()).map(|shape| Shape { approximated: true, ..shape })
}
