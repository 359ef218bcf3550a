//! Smoothing and correlated noise of sampled signals.

use scene::random::Stream;

/// Gaussian low-pass filter; `sigma` in samples. The ends are continued by point reflection, which keeps
/// their slope.
pub fn gaussian(values: &[f64], sigma: f64) -> Vec<f64> {
    let n = values.len();
    if sigma <= 0.0 || n < 3 {
        return values.to_vec();
    }
    let radius = (4.0 * sigma + 0.5) as usize;
    let kernel = kernel(sigma, radius);
    let (first, last) = (values[0], values[n - 1]);
    let long_enough = n > radius;
    let mut padded = Vec::with_capacity(n + 2 * radius);
    for i in (1..=radius).rev() {
        padded.push(if long_enough { 2.0 * first - values[i] } else { first });
    }
    padded.extend_from_slice(values);
    for i in 1..=radius {
        padded.push(if long_enough { 2.0 * last - values[n - 1 - i] } else { last });
    }
    padded.windows(2 * radius + 1).map(|w| w.iter().zip(&kernel).map(|(v, k)| v * k).sum()).collect()
}

fn kernel(sigma: f64, radius: usize) -> Vec<f64> {
    let weight = |i: usize| (-0.5 * ((i as f64 - radius as f64) / sigma).powi(2)).exp();
    let weights: Vec<f64> = (0..=2 * radius).map(weight).collect();
    let sum: f64 = weights.iter().sum();
    weights.into_iter().map(|w| w / sum).collect()
}

/// `n` samples of noise with this standard deviation, smooth over `correlation` samples. With a long
/// correlation, it is drawn on a coarser grid and interpolated.
pub fn noise(draw: &mut Stream, n: usize, correlation: f64, deviation: f64) -> Vec<f64> {
    let step = (correlation / 6.0).max(1.0);
    let sigma = correlation / step;
    let radius = (3.0 * sigma).ceil() as usize;
    let shape = kernel(sigma, radius);
    let power = shape.iter().map(|k| k * k).sum::<f64>().sqrt();
    let coarse = (n as f64 / step) as usize + 4;
    let white: Vec<f64> = (0..coarse + 2 * radius).map(|_| draw.normal()).collect();
    let smooth: Vec<f64> = white
        .windows(2 * radius + 1)
        .map(|w| w.iter().zip(&shape).map(|(v, k)| v * k).sum::<f64>() / power * deviation)
        .collect();
    if step == 1.0 {
        return smooth[..n].to_vec();
    }
    let at = |i: f64| {
        let k = i as usize;
        let t = i - k as f64;
        let p = [smooth[k], smooth[k + 1], smooth[k + 2], smooth[k + 3]];
        // Catmull-Rom between p[1] and p[2].
        let (a, b) = ((p[2] - p[0]) / 2.0, (p[3] - p[1]) / 2.0);
        let (t2, t3) = (t * t, t * t * t);
        p[1] * (2.0 * t3 - 3.0 * t2 + 1.0)
            + a * (t3 - 2.0 * t2 + t)
            + p[2] * (3.0 * t2 - 2.0 * t3)
            + b * (t3 - t2)
    };
    (0..n).map(|i| at(i as f64 / step)).collect()
}

/// Derivative by central differences; `step` is the sample spacing.
pub fn gradient(values: &[f64], step: f64) -> Vec<f64> {
    let n = values.len();
    (0..n)
        .map(|i| {
            let (a, b) = (i.saturating_sub(1), (i + 1).min(n - 1));
            if b > a { (values[b] - values[a]) / ((b - a) as f64 * step) } else { 0.0 }
        })
        .collect()
}

/// Value at `x` of the piecewise linear function through (`xs`, `ys`), constant beyond its ends; `xs` ascend.
pub fn interpolate(xs: &[f64], ys: &[f64], x: f64) -> f64 {
    let i = xs.partition_point(|v| *v <= x);
    if i == 0 {
        return ys[0];
    }
    if i == xs.len() {
        return ys[i - 1];
    }
    let span = xs[i] - xs[i - 1];
    if span < 1e-12 { ys[i] } else { ys[i - 1] + (ys[i] - ys[i - 1]) * (x - xs[i - 1]) / span }
}

/// Removes jumps by full turns from a series of angles.
pub fn unwrap(angles: &[f64]) -> Vec<f64> {
    let mut out: Vec<f64> = Vec::with_capacity(angles.len());
    for &a in angles {
        let next = out.last().map_or(a, |last| last + scene::wrap_angle(a - last));
        out.push(next);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::super::random::Purpose;
    use super::*;

    #[test]
    fn low_pass_keeps_lines() {
        let line: Vec<f64> = (0..100).map(|i| 3.0 + 0.5 * f64::from(i)).collect();
        let smooth = gaussian(&line, 4.0);
        assert!(line.iter().zip(&smooth).all(|(a, b)| (a - b).abs() < 1e-9));
    }

    #[test]
    fn noise_has_its_deviation() {
        let mut draw = Purpose::Motion.stream(3);
        for correlation in [2.5, 14.0, 150.0] {
            let values = noise(&mut draw, 40_000, correlation, 0.2);
            let power = values.iter().map(|v| v * v).sum::<f64>() / values.len() as f64;
            assert!((power.sqrt() - 0.2).abs() < 0.04, "{correlation}: {}", power.sqrt());
        }
    }

    #[test]
    fn unwrap_is_continuous() {
        let wrapped: Vec<f64> = (0..50).map(|i| scene::wrap_angle(0.3 * f64::from(i))).collect();
        assert!(unwrap(&wrapped).windows(2).all(|w| (w[1] - w[0] - 0.3).abs() < 1e-9));
    }
}
