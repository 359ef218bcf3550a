//! Contents of a scenario that a scene does not show, by their place in the file.

use crate::problem::ImportWarning;
use crate::sentences;

/// Most places that are listed.
const LISTED: usize = 20;
/// Longest place, characters.
const PLACE_CHARS: usize = 300;

/// Places of elements that are not read.
#[derive(Debug, Default)]
pub(super) struct Unread {
    places: Vec<String>,
    count: usize,
}

impl Unread {
    pub fn push(&mut self, place: &str) {
        self.count += 1;
        if self.places.len() < LISTED {
            self.places.push(place.chars().take(PLACE_CHARS).collect());
        }
    }

    pub fn warning(&self) -> Option<ImportWarning> {
        let more = self.count - self.places.len();
        let listed = self.places.join(", ");
        let message = || match more {
            0 => sentences::unread_by_place(self.count, &listed),
            more => sentences::unread_places(self.count, &listed, more),
        };
        (self.count > 0).then(|| ImportWarning::new("parts-unread", message()))
    }
}
