//! Figures of a situation: drawn for each seed, or fixed by the caller.

use crate::random::Stream;
use std::collections::BTreeMap;

/// A figure that a situation draws.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TemplateFigure {
    /// Its name, with its unit.
    pub name: &'static str,
    /// Range of drawn values, uniform.
    pub drawn: (f64, f64),
    /// Range of values that a caller may fix.
    pub allowed: (f64, f64),
}

/// Draws the figures of one casting.
pub(super) struct FigureDraw<'a> {
    pub(super) stream: Stream,
    /// Fixed values by name.
    pub(super) fixed: &'a BTreeMap<String, f64>,
}

impl FigureDraw<'_> {
    /// The fixed value, else a drawn one. A number is drawn in either case, so that later figures do not
    /// change.
    pub(super) fn value(&mut self, figure: &TemplateFigure) -> f64 {
        let drawn = self.stream.between(figure.drawn.0, figure.drawn.1);
        self.fixed.get(figure.name).copied().unwrap_or(drawn)
    }
}
