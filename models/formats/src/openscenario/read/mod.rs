//! Reads OpenSCENARIO XML 1.x: road users with their initial states, catalogs, parameters, and trajectories
//! with times. Elements that need a simulation are listed by their place in the file.

mod entities;
mod files;
mod import;
mod lights;
mod motion;
mod parameters;
mod places;
mod unread;

pub(super) use import::scenes;

/// Whether a file with this beginning is a scenario: by its root element, or as a zip that contains a
/// scenario.
pub(super) fn begins(head: &[u8]) -> bool {
    let ends = |end: &[u8]| head.windows(end.len()).any(|part| part.eq_ignore_ascii_case(end));
    if head.starts_with(files::ZIP) {
        return ends(b".xosc");
    }
    let root = crate::xml::root_of(&crate::unpack::head(head));
    root.is_some_and(|root| root == "OpenSCENARIO" || root == "OpenScenario")
}
