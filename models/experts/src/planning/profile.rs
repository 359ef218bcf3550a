//! Progress along a path over time: the base of an anchor.

use crate::tuning::fixed::profile::EASING_MPS2;
use scene::{HORIZON_STEPS, STANDING_MPS, STEP_S};

/// Metres along a path at every step, the first zero.
pub type Progress = [f64; HORIZON_STEPS + 1];

/// Speed caps at points one metre apart along a path.
#[derive(Clone, Debug)]
pub struct Caps<'a> {
    arc_m: &'a [f64],
    caps_mps: &'a [f64],
}

impl<'a> Caps<'a> {
    /// Caps at the arc lengths `arc_m` (rising).
    pub fn new(arc_m: &'a [f64], caps_mps: &'a [f64]) -> Self {
        Self { arc_m, caps_mps }
    }

    /// Cap at `s_m`; the last one beyond the end.
    pub fn at(&self, s_m: f64) -> f64 {
        let i = self.arc_m.partition_point(|a| *a < s_m);
        self.caps_mps.get(i.min(self.caps_mps.len().saturating_sub(1))).copied().unwrap_or(f64::INFINITY)
    }
}

/// Integrates a speed wish under the caps; slowing for a cap takes at most `brake` m/s2.
fn integrate(v0: f64, caps: &Caps<'_>, brake: f64, wish: impl Fn(f64) -> f64) -> Progress {
    let mut out = [0.0; HORIZON_STEPS + 1];
    let mut speed = v0;
    for i in 0..HORIZON_STEPS {
        let t = (i + 1) as f64 * STEP_S;
        let capped = wish(t).min(caps.at(out[i])).max(0.0);
        let next = capped.max(speed - brake * STEP_S);
        out[i + 1] = out[i] + 0.5 * (speed + next) * STEP_S;
        speed = next;
    }
    out
}

/// Approaches `speed_mps` by at most 1.5 m/s2 up and 2.5 down and keeps it, under the caps.
pub fn cruising(v0: f64, speed_mps: f64, caps: &Caps<'_>) -> Progress {
    approaching(v0, speed_mps, if speed_mps > v0 { 1.5 } else { 2.5 }, caps)
}

/// Approaches `speed_mps` by `rate_mps2`, up or down, and keeps it, under the caps.
pub fn approaching(v0: f64, speed_mps: f64, rate_mps2: f64, caps: &Caps<'_>) -> Progress {
    let wish = |t: f64| {
        if speed_mps > v0 { (v0 + rate_mps2 * t).min(speed_mps) } else { (v0 - rate_mps2 * t).max(speed_mps) }
    };
    integrate(v0, caps, 4.0, wish)
}

/// A progress that goes on from a step, where it is `from_mps` fast, as [`cruising`] does.
pub fn cruising_from(
    progress: &Progress,
    step: usize,
    from_mps: f64,
    speed_mps: f64,
    caps: &Caps<'_>,
) -> Progress {
    let mut out = *progress;
    let mut speed = from_mps;
    for i in step.min(HORIZON_STEPS)..HORIZON_STEPS {
        let wish = if speed_mps > speed {
            (speed + 1.5 * STEP_S).min(speed_mps)
        } else {
            (speed - 2.5 * STEP_S).max(speed_mps)
        };
        let next = wish.min(caps.at(out[i])).max(speed - 4.0 * STEP_S).max(0.0);
        out[i + 1] = out[i] + 0.5 * (speed + next) * STEP_S;
        speed = next;
    }
    out
}

/// As far as speeding up by `rate_mps2` to `top_mps` leads, under the caps.
pub fn fastest(v0: f64, rate_mps2: f64, top_mps: f64, caps: &Caps<'_>) -> Progress {
    integrate(v0, caps, 8.0, |t| (v0 + rate_mps2 * t).min(top_mps.max(v0)))
}

/// As far as braking by `rate_mps2` at once leads.
pub fn slowest(v0: f64, rate_mps2: f64) -> Progress {
    approaching(v0, 0.0, rate_mps2, &Caps::new(&[0.0], &[f64::INFINITY]))
}

/// Reaches `speed_mps` at `seconds` by constant acceleration; `sag` bends the way there (m/s at half time).
pub fn reaching_speed(v0: f64, speed_mps: f64, seconds: f64, sag: f64, caps: &Caps<'_>) -> Progress {
    let wish = |t: f64| {
        let f = (t / seconds).min(1.0);
        v0 + (speed_mps - v0) * f + 4.0 * sag * f * (1.0 - f)
    };
    integrate(v0, caps, 8.0, wish)
}

/// Stands as long as there is time to, then speeds up evenly, by `easy_mps2` where that is enough; beyond the end
/// it goes on as fast as it is then.
fn setting_off(length_m: f64, seconds: f64, easy_mps2: f64) -> Progress {
    let rate = easy_mps2.max(2.0 * length_m / (seconds * seconds));
    let wait = (seconds - (2.0 * length_m / rate).sqrt()).max(0.0);
    std::array::from_fn(|i| {
        let t = i as f64 * STEP_S;
        let driven = (t.min(seconds) - wait).max(0.0);
        0.5 * rate * driven * driven + rate * driven * (t - seconds).max(0.0)
    })
}

/// Covers `length_m` in `seconds`, ending at `end_mps` when that is given, with the smoothest speed of a
/// one-parameter family (linear acceleration that fades out, or a parabola through both speeds). A standing
/// agent with a free end speed leaves as late as `easy_mps2` allows.
pub fn arriving(v0: f64, length_m: f64, seconds: f64, end_mps: Option<f64>, easy_mps2: f64) -> Progress {
    if v0 < STANDING_MPS && end_mps.is_none() && length_m > 0.0 {
        return setting_off(length_m, seconds, easy_mps2);
    }
    let step = (seconds / STEP_S).round().clamp(1.0, HORIZON_STEPS as f64) as usize;
    let wish = |shape: f64| {
        move |t: f64| {
            let t = t.min(seconds);
            match end_mps {
                Some(end) => v0 + (end - v0) * t / seconds + shape * t * (seconds - t),
                None => v0 + shape * (t - t * t / (2.0 * seconds)),
            }
        }
    };
    let free = Caps::new(&[0.0], &[f64::INFINITY]);
    let (mut low, mut high) = (-30.0, 30.0);
    for _ in 0..26 {
        let middle = 0.5 * (low + high);
        if integrate(v0, &free, 8.0, wish(middle))[step] < length_m { low = middle } else { high = middle }
    }
    integrate(v0, &free, 8.0, wish(high))
}

/// A progress that is free from a step on: it goes on as fast as it is then, under the caps.
pub fn going_on(mut progress: Progress, step: usize, caps: &Caps<'_>) -> Progress {
    let mut speed = speed_at(&progress, step);
    for i in step.clamp(1, HORIZON_STEPS)..HORIZON_STEPS {
        let next = speed.min(caps.at(progress[i])).max(speed - EASING_MPS2 * STEP_S);
        progress[i + 1] = progress[i] + 0.5 * (speed + next) * STEP_S;
        speed = next;
    }
    progress
}

/// Speed of a progress at a step, m/s.
pub fn speed_at(progress: &Progress, step: usize) -> f64 {
    let i = step.clamp(1, HORIZON_STEPS);
    (progress[i] - progress[i - 1]) / STEP_S
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrives_where_and_when_asked() {
        for (v0, length, seconds, end) in [
            (8.0, 60.0, 9.0, None),
            (8.0, 20.0, 9.0, Some(0.0)),
            (0.0, 30.0, 6.0, Some(8.0)),
            (10.0, 90.0, 9.0, Some(10.0)),
            (0.0, 12.0, 9.0, None),
            (0.1, 90.0, 6.0, None),
        ] {
            let p = arriving(v0, length, seconds, end, 1.1);
            let step = (seconds / STEP_S).round() as usize;
            assert!((p[step] - length).abs() < 0.1, "{} for {length}", p[step]);
            assert!(p.windows(2).all(|w| w[1] >= w[0]));
            if let Some(end) = end {
                assert!((speed_at(&p, step) - end).abs() < 0.6);
            }
        }
    }

    #[test]
    fn who_stands_leaves_when_it_must() {
        let near = arriving(0.0, 5.0, 9.0, None, 1.1);
        assert!(near[50] < 0.01 && (near[90] - 5.0).abs() < 1e-9);
        let far = arriving(0.0, 60.0, 9.0, None, 1.1);
        assert!(far[10] > 0.5 && (far[90] - 60.0).abs() < 1e-9);
        // A goal that is met before the end is driven past.
        let early = arriving(0.0, 5.0, 6.0, None, 1.1);
        assert!(early[90] > early[60] + 3.0 * 0.9 * speed_at(&early, 60));
    }

    #[test]
    fn caps_hold_while_cruising() {
        let arc: Vec<f64> = (0..100).map(f64::from).collect();
        let caps: Vec<f64> = arc.iter().map(|s| if (20.0..40.0).contains(s) { 5.0 } else { 15.0 }).collect();
        let p = cruising(5.0, 15.0, &Caps::new(&arc, &caps));
        for i in 1..p.len() {
            // Braking for the cap takes a few metres.
            if (28.0..39.0).contains(&p[i]) {
                assert!(speed_at(&p, i) < 5.1);
            }
        }
    }
}
