//! Driving side at a position, which extracts lack.

/// Regions with left-hand traffic, as boxes of south, north (degrees of latitude), west, east (of longitude).
/// None of them contains a road of a neighbour with right-hand traffic.
const LEFT: [[f64; 4]; 13] = [
    // Great Britain and Ireland.
    [49.85, 50.4, -7.0, -1.0],
    [50.4, 61.0, -11.0, 1.5],
    [51.2, 53.0, 1.4, 1.8],
    // Japan.
    [30.0, 46.0, 129.5, 146.0],
    [24.0, 30.0, 122.9, 131.5],
    // Australia, New Zealand.
    [-44.0, -10.5, 112.0, 154.0],
    [-48.0, -34.0, 166.0, 179.0],
    // India and Sri Lanka.
    [6.0, 27.5, 69.0, 88.0],
    // Hong Kong; Singapore, the Malay peninsula.
    [22.15, 22.5, 113.82, 114.45],
    [1.15, 6.4, 100.1, 104.5],
    // The south of Africa; Kenya.
    [-35.0, -22.5, 20.0, 31.0],
    [-4.0, 3.0, 35.0, 40.0],
    // Cyprus.
    [34.5, 35.75, 32.2, 34.7],
];

/// Whether traffic drives on the left, as far as is known.
pub(super) fn is_left(lat_deg: f64, lon_deg: f64) -> bool {
    let holds = |[south, north, west, east]: &[f64; 4]| {
        (*south..=*north).contains(&lat_deg) && (*west..=*east).contains(&lon_deg)
    };
    LEFT.iter().any(holds)
}

#[cfg(test)]
mod tests {
    use super::is_left;

    #[test]
    fn places_drive_on_the_side_they_do() {
        let left = [
            (51.5, -0.13),
            (51.13, 1.31),
            (50.1, -5.5),
            (53.35, -6.26),
            (35.68, 139.77),
            (33.59, 130.4),
            (26.2, 127.7),
            (-33.87, 151.2),
            (-36.85, 174.76),
            (12.97, 77.59),
            (22.28, 114.16),
            (1.3, 103.85),
            (-33.92, 25.6),
            (-1.29, 36.82),
            (35.17, 33.36),
        ];
        let right = [
            (50.95, 1.85),
            (50.72, 1.61),
            (49.92, 1.08),
            (49.64, -1.62),
            (35.18, 129.08),
            (25.03, 121.56),
            (48.14, 11.58),
            (40.71, -74.0),
            (22.54, 114.06 + 0.5),
            (22.62, 114.06),
        ];
        assert!(left.iter().all(|(lat, lon)| is_left(*lat, *lon)), "left");
        let wrong: Vec<_> = right.iter().filter(|(lat, lon)| is_left(*lat, *lon)).collect();
        assert!(wrong.is_empty(), "{wrong:?}");
    }
}
