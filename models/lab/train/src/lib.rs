//! Training of experts: records from recorded scenes, training, the learned rivals trained by the same means,
//! and the weights of placement.
//!
//! ```
//! use lab_train::scenes::{Crop, Cropped};
//! use scene::{Agent, AgentType, LaneMap, Scene, State, Subtype};
//!
//! let stands = |id: &str, x_m: f64| {
//!     let state = State { x_m, ..State::default() };
//!     Agent::bare(id, AgentType::Vehicle, Subtype::Car, vec![Some(state); 91])
//! };
//! let scene = Scene::bare("", LaneMap::default(), vec![stands("near", 0.0), stands("far", 70.0)]);
//! // The paper's square of 120 m contains one of the two and requires 32.
//! assert_eq!(Crop::PAPER.apply(scene), Cropped::TooFew(1));
//! ```

pub mod baselines;
pub mod placement;
pub mod polylines;
pub mod prepare;
pub mod provenance;
#[cfg(any(test, feature = "samples"))]
pub mod samples;
pub mod scenes;
pub mod training;

/// Linear interpolation between the two nearest of sorted values; zero without values.
pub fn quantile(sorted: &[f64], share: f64) -> f64 {
    let Some(last) = sorted.len().checked_sub(1) else { return 0.0 };
    let at = share.clamp(0.0, 1.0) * last as f64;
    let (below, f) = (at.floor() as usize, at.fract());
    let above = (below + 1).min(last);
    sorted[below] + f * (sorted[above] - sorted[below])
}

#[cfg(test)]
mod tests {
    use super::quantile;

    #[test]
    fn quantiles_lie_between_the_nearest_values() {
        assert_eq!(quantile(&[0.0, 10.0], 0.25), 2.5);
        assert_eq!((quantile(&[], 0.5), quantile(&[3.0], 0.9)), (0.0, 3.0));
    }
}
