//! What training needs to know: observations of recorded scenes and the form of the weights.

pub use super::model::{FORMAT, Histogram, PlacementModel, Rate, SPEED_CLASSES, TypeModel, VERSION, kinds};
pub use super::observe::{CellCounts, Observation, SEEN_M, observe};
pub use super::pose::{heading_classes, lateral_classes};
pub use super::sites::SiteKind;
pub use super::speed::{ANY_CONTEXT, group_context};

/// Number of classes of each fact of a kind of place.
pub fn fact_classes(kind: SiteKind) -> &'static [usize] {
    kind.classes()
}
