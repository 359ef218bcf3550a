//! Units of other places.

/// One mile per hour in m/s.
pub(crate) const MPS_PER_MPH: f64 = 0.447_04;

/// Miles per hour, rounded to a millionth: the quotient of a product is not always the factor.
pub(crate) fn mph(mps: f64) -> f64 {
    (mps / MPS_PER_MPH * 1e6).round() / 1e6
}
