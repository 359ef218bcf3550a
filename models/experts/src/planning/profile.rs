//! Progress along a path over time: the base of an anchor.

use crate::tuning::fixed::profile::{BRAKING_MPS2, CRUISING_MPS2, EASING_MPS2, HARDEST_MPS2, OVER_CAP};
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
    /// Caps at the arc lengths `arc_m`, in ascending order.
    pub fn new(arc_m: &'a [f64], caps_mps: &'a [f64]) -> Self {
        Self { arc_m, caps_mps }
    }

    /// Largest ratio of a progress's speed to its cap, up to `step`; at most one if it keeps all caps.
    fn excess(&self, from_m: f64, progress: &Progress, step: usize) -> f64 {
        let share = |i: usize| speed_at(progress, i) / self.at(from_m + progress[i - 1]).max(0.1);
        (1..=step.min(HORIZON_STEPS)).map(share).fold(0.0, f64::max)
    }

    /// Cap at `s_m`; the last one beyond the end.
    pub fn at(&self, s_m: f64) -> f64 {
        let i = self.arc_m.partition_point(|a| *a < s_m);
        self.caps_mps.get(i.min(self.caps_mps.len().saturating_sub(1))).copied().unwrap_or(f64::INFINITY)
    }
}

/// Integrates a wanted speed under the caps; slowing down for a cap takes at most `brake` m/s2.
fn integrate(v0: f64, caps: &Caps<'_>, brake: f64, wish: impl Fn(f64) -> f64) -> Progress {
    driven(v0, |s| caps.at(s), (f64::INFINITY, brake), wish)
}

/// Integrates a wanted speed under a cap at each progress, within rates of acceleration and braking, m/s2.
fn driven(v0: f64, cap: impl Fn(f64) -> f64, (up, down): (f64, f64), wish: impl Fn(f64) -> f64) -> Progress {
    let mut out = [0.0; HORIZON_STEPS + 1];
    let mut speed = v0;
    for i in 0..HORIZON_STEPS {
        let t = (i + 1) as f64 * STEP_S;
        let capped = wish(t).min(cap(out[i])).max(0.0);
        let next = capped.clamp(speed - down * STEP_S, speed + up * STEP_S);
        out[i + 1] = out[i] + 0.5 * (speed + next) * STEP_S;
        speed = next;
    }
    out
}

/// Approaches `speed_mps` at usual rates and keeps it, under the caps.
pub fn cruising(v0: f64, speed_mps: f64, caps: &Caps<'_>) -> Progress {
    approaching(v0, speed_mps, if speed_mps > v0 { CRUISING_MPS2.0 } else { CRUISING_MPS2.1 }, caps)
}

/// Approaches `speed_mps` at `rate_mps2`, up or down, and keeps it, under the caps.
pub fn approaching(v0: f64, speed_mps: f64, rate_mps2: f64, caps: &Caps<'_>) -> Progress {
    let wish = |t: f64| {
        if speed_mps > v0 { (v0 + rate_mps2 * t).min(speed_mps) } else { (v0 - rate_mps2 * t).max(speed_mps) }
    };
    integrate(v0, caps, BRAKING_MPS2, wish)
}

/// Continues a progress from a step, where its speed is `from_mps`, in the manner of [`cruising`].
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
            (speed + CRUISING_MPS2.0 * STEP_S).min(speed_mps)
        } else {
            (speed - CRUISING_MPS2.1 * STEP_S).max(speed_mps)
        };
        let next = wish.min(caps.at(out[i])).max(speed - BRAKING_MPS2 * STEP_S).max(0.0);
        out[i + 1] = out[i] + 0.5 * (speed + next) * STEP_S;
        speed = next;
    }
    out
}

/// Accelerates at `rate_mps2` to `top_mps`, under the caps: the farthest reachable progress.
pub fn fastest(v0: f64, rate_mps2: f64, top_mps: f64, caps: &Caps<'_>) -> Progress {
    integrate(v0, caps, HARDEST_MPS2, |t| (v0 + rate_mps2 * t).min(top_mps.max(v0)))
}

/// Brakes at `rate_mps2` at once: the shortest possible progress.
pub fn slowest(v0: f64, rate_mps2: f64) -> Progress {
    approaching(v0, 0.0, rate_mps2, &Caps::new(&[0.0], &[f64::INFINITY]))
}

/// Reaches `speed_mps` at `seconds`, at constant acceleration if `sag` is zero; `sag` is the deviation from
/// that speed at half time, m/s.
pub fn reaching_speed(v0: f64, speed_mps: f64, seconds: f64, sag: f64, caps: &Caps<'_>) -> Progress {
    let wish = |t: f64| {
        let f = (t / seconds).min(1.0);
        v0 + (speed_mps - v0) * f + 4.0 * sag * f * (1.0 - f)
    };
    integrate(v0, caps, HARDEST_MPS2, wish)
}

/// Stands for as long as the time allows, then accelerates evenly, at `easy_mps2` if that is enough. Beyond
/// the end it keeps its speed.
fn setting_off(length_m: f64, seconds: f64, easy_mps2: f64) -> Progress {
    let rate = easy_mps2.max(2.0 * length_m / (seconds * seconds));
    let wait = (seconds - (2.0 * length_m / rate).sqrt()).max(0.0);
    std::array::from_fn(|i| {
        let t = i as f64 * STEP_S;
        let driven = (t.min(seconds) - wait).max(0.0);
        0.5 * rate * driven * driven + rate * driven * (t - seconds).max(0.0)
    })
}

/// A distance to cover in a given time.
#[derive(Clone, Copy, Debug)]
pub struct TimedLeg {
    /// Speed at its beginning, m/s.
    pub v0: f64,
    /// Where it begins along the path, metres.
    pub from_m: f64,
    /// Length, metres.
    pub length_m: f64,
    /// Time for it, seconds.
    pub seconds: f64,
    /// Speed at its end, m/s; `None` leaves it free.
    pub end_mps: Option<f64>,
    /// Rate at which a standing agent sets off if it has time, m/s2.
    pub easy_mps2: f64,
}

impl TimedLeg {
    fn step(&self) -> usize {
        (self.seconds / STEP_S).round().clamp(1.0, HORIZON_STEPS as f64) as usize
    }

    /// Whether it begins at rest and may end at any speed.
    fn sets_off(&self) -> bool {
        self.v0 < STANDING_MPS && self.end_mps.is_none() && self.length_m > 0.0
    }

    /// Speed at a time, in a family with one parameter: linear acceleration that fades out, or a parabola
    /// through both speeds.
    fn wish(&self, shape: f64, t: f64) -> f64 {
        let Self { v0, seconds, .. } = *self;
        let t = t.min(seconds);
        match self.end_mps {
            Some(end) => v0 + (end - v0) * t / seconds + shape * t * (seconds - t),
            None => v0 + shape * (t - t * t / (2.0 * seconds)),
        }
    }

    /// Covers the length with the smoothest speed of the family, ignoring bends. A standing agent with a free
    /// end speed leaves as late as its easy rate allows.
    pub fn arriving(&self) -> Progress {
        if self.sets_off() {
            return setting_off(self.length_m, self.seconds, self.easy_mps2);
        }
        let go = |shape: f64| {
            driven(self.v0, |_| f64::INFINITY, (f64::INFINITY, HARDEST_MPS2), |t| self.wish(shape, t))
        };
        self.reached((-30.0, 30.0), go)
    }

    /// The parameter within `range` at which the length is covered; progress increases with it.
    fn reached(&self, (mut low, mut high): (f64, f64), go: impl Fn(f64) -> Progress) -> Progress {
        for _ in 0..26 {
            let middle = 0.5 * (low + high);
            if go(middle)[self.step()] < self.length_m { low = middle } else { high = middle }
        }
        go(high)
    }

    /// The same under speed caps and within rates of acceleration and braking; `None` if the time is too
    /// short for that.
    fn arriving_under(&self, caps: &Caps<'_>, rates: (f64, f64)) -> Option<Progress> {
        let cap = |s: f64| caps.at(self.from_m + s);
        if driven(self.v0, cap, rates, |_| f64::INFINITY)[self.step()] < self.length_m {
            return None;
        }
        if self.sets_off() {
            let up = rates.0.max(self.easy_mps2);
            let go =
                |early: f64| driven(0.0, cap, (up, rates.1), |t| up * (t + early - self.seconds).max(0.0));
            return Some(self.reached((0.0, self.seconds), go));
        }
        Some(self.reached((-30.0, 30.0), |shape| driven(self.v0, cap, rates, |t| self.wish(shape, t))))
    }

    /// Covers the length as comfortably as the time allows. Each manner, tried in turn, has its caps and its
    /// rates of acceleration and braking, m/s2. If none arrives, as [`TimedLeg::arriving`].
    pub fn arriving_in_comfort<'a>(
        &self,
        manners: impl IntoIterator<Item = (Caps<'a>, (f64, f64))>,
    ) -> Progress {
        let straight = self.arriving();
        let mut manners = manners.into_iter();
        let found = manners.find_map(|(caps, rates)| {
            let holds = caps.excess(self.from_m, &straight, self.step()) <= OVER_CAP;
            if holds { Some(straight) } else { self.arriving_under(&caps, rates) }
        });
        found.unwrap_or(straight)
    }
}

/// Continues a progress freely from a step: at its speed there, under the caps.
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

    fn leg(v0: f64, length_m: f64, seconds: f64, end_mps: Option<f64>) -> TimedLeg {
        TimedLeg { v0, from_m: 0.0, length_m, seconds, end_mps, easy_mps2: 1.1 }
    }

    #[test]
    fn a_bend_on_the_way_is_slowed_for_while_there_is_time() {
        let arc: Vec<f64> = (0..200).map(f64::from).collect();
        // A bend from 30 to 45 m that takes 5 m/s in comfort and 7 m/s in a hurry.
        let capped = |bend: f64, brake: f64| -> Vec<f64> {
            let before = |s: f64| (bend * bend + 2.0 * brake * (30.0 - s).max(0.0)).sqrt();
            arc.iter().map(|s| if *s < 45.0 { before(*s) } else { 30.0 }).collect()
        };
        let (comfort, hurry) = (capped(5.0, 2.0), capped(7.0, 3.0));
        let manners = || [(Caps::new(&arc, &comfort), (1.5, 2.0)), (Caps::new(&arc, &hurry), (2.5, 3.0))];
        let slowest = |p: &Progress| {
            let inside = (1..=90).filter(|i| (31.0..44.0).contains(&p[*i]));
            inside.map(|i| speed_at(p, i)).fold(0.0, f64::max)
        };
        for (v0, length, fastest) in [(10.0, 60.0, 5.1), (10.0, 75.0, 7.1), (0.0, 40.0, 5.1)] {
            let p = leg(v0, length, 9.0, None).arriving_in_comfort(manners());
            assert!((p[90] - length).abs() < 0.2, "{} for {length}", p[90]);
            assert!(slowest(&p) < fastest, "{} for {length}", slowest(&p));
        }
        // Only the hurried manner covers the distance in time.
        let far = leg(10.0, 120.0, 9.0, None);
        assert_eq!(far.arriving_in_comfort(manners()), far.arriving());
    }

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
            let p = leg(v0, length, seconds, end).arriving();
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
        let near = leg(0.0, 5.0, 9.0, None).arriving();
        assert!(near[50] < 0.01 && (near[90] - 5.0).abs() < 1e-9);
        let far = leg(0.0, 60.0, 9.0, None).arriving();
        assert!(far[10] > 0.5 && (far[90] - 60.0).abs() < 1e-9);
        // After a goal that is met before the end, the agent continues.
        let early = leg(0.0, 5.0, 6.0, None).arriving();
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
