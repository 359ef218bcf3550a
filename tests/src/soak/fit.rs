//! Fits a straight line to readings.

/// Rise of a line fitted to equidistant readings, from the first to the last.
pub fn rise(readings: &[f64]) -> f64 {
    let count = readings.len() as f64;
    if readings.len() < 2 {
        return 0.0;
    }
    let (middle, mean) = ((count - 1.0) / 2.0, readings.iter().sum::<f64>() / count);
    let offsets = readings.iter().enumerate().map(|(at, reading)| (at as f64 - middle, reading - mean));
    let (both, square) = offsets.fold((0.0, 0.0), |(both, square), (x, y)| (both + x * y, square + x * x));
    both / square * (count - 1.0)
}

#[cfg(test)]
mod tests {
    use super::rise;

    #[test]
    fn a_line_is_found_through_noise() {
        let noisy: Vec<f64> = (0..100).map(|k| 5.0 + 0.1 * f64::from(k) + f64::from(k % 3)).collect();
        assert!((rise(&noisy) - 9.9).abs() < 0.1, "{}", rise(&noisy));
        assert!(rise(&[7.0; 10]).abs() < 1e-9);
        assert!(rise(&[1.0]).abs() < 1e-9);
    }
}
