//! Units of other places.

/// Metres a second in a mile an hour.
pub(crate) const MPS_PER_MPH: f64 = 0.447_04;

/// Miles an hour, to the millionth: the quotient of a product is not always the factor.
pub(crate) fn mph(mps: f64) -> f64 {
    (mps / MPS_PER_MPH * 1e6).round() / 1e6
}
