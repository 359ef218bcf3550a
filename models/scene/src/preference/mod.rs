//! Learns a person's preference from kept and rejected futures, by features that people can name: pace, gap,
//! smoothness, waiting, distance from the recording, order, manoeuvre. The second future work of DragTraffic
//! (IROS 2024, section V): feedback of users in rounds.
//!
//! A wide draw gives [`Candidate`]s. [`Taste`] is the posterior of a Plackett-Luce model over their features,
//! given the answers so far. [`choose`] takes the next cards from it: the best first, then the best by draws
//! of the posterior. Each is dissimilar to the other cards and to judged ones.

mod features;
mod round;
mod taste;
#[cfg(test)]
mod tests;
mod wishes;

pub use features::{Features, Trait};
pub use round::{Candidate, LEAST_APART_M, Round, RoundCard, choose};
pub use taste::Taste;
pub use wishes::Learned;

use crate::{AgentId, Vec2};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The user's verdict on a card.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// The card is kept.
    Keep,
    /// The card is rejected.
    Reject,
}

/// Direction of a wish.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum WishDirection {
    /// More of it; for an order or a manoeuvre: yes.
    More,
    /// Less of it; for an order or a manoeuvre: no.
    Less,
}

impl WishDirection {
    fn sign(self) -> f64 {
        match self {
            Self::More => 1.0,
            Self::Less => -1.0,
        }
    }
}

/// A wish: a trait and a direction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Wish {
    /// What of the motion.
    #[serde(flatten)]
    pub of: Trait,
    /// Direction of the wish.
    pub wants: WishDirection,
}

/// A card that was judged.
#[derive(Clone, Debug, PartialEq)]
pub struct JudgedCard {
    /// Features of the card.
    pub features: Features,
    /// The person's verdict.
    pub verdict: Verdict,
    /// The trait that was criticized or liked, if any.
    pub why: Option<Wish>,
    /// Box centres at every half second, by road user, so that no similar card is shown again.
    pub places: Places,
}

/// Box centres at every half second from the first state on, by road user, metres.
pub type Places = BTreeMap<AgentId, Vec<Vec2>>;

/// All feedback so far.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Feedback {
    /// Judged cards, the first round's first.
    pub answers: Vec<JudgedCard>,
    /// Explicit wishes.
    pub wishes: Vec<Wish>,
    /// Traits that are ignored, whatever the answers show.
    pub forgotten: Vec<Trait>,
}
