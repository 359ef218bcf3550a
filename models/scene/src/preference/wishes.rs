//! Learned wishes, as statements that a person can check and withdraw.

use super::taste::Taste;
use super::{Feedback, JudgedCard, Trait, Verdict, Wish, WishDirection};
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeSet;

/// A wish is reported if this many answers agree with it...
const LEAST_AGREED: usize = 3;
/// ...and they are this many times those that contradict it.
const AGREED_TIMES: usize = 2;

/// A learned wish with its evidence.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "LearnedWish")]
pub struct Learned {
    /// The wish.
    #[serde(flatten)]
    pub wish: Wish,
    /// Confidence, 0 to 1.
    pub strength: f64,
    /// Whether the user stated it.
    pub said: bool,
    /// Least and greatest value of the kept cards, in the unit of the trait; absent if none were kept.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kept: Option<(f64, f64)>,
    /// Least and greatest value of the rejected cards.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rejected: Option<(f64, f64)>,
    /// Indices of the answers that contradict it.
    pub against: Vec<usize>,
}

/// The wishes on which the answers agree, the most certain first.
pub(super) fn learned(taste: &Taste, feedback: &Feedback) -> Vec<Learned> {
    let judged = feedback.answers.iter().flat_map(|answer| answer.features.traits());
    let traits: BTreeSet<Trait> = judged.chain(feedback.wishes.iter().map(|wish| wish.of.clone())).collect();
    let mut all: Vec<Learned> = traits.into_iter().filter_map(|of| about(taste, feedback, of)).collect();
    all.sort_by(|a, b| b.strength.total_cmp(&a.strength));
    all
}

fn about(taste: &Taste, feedback: &Feedback, of: Trait) -> Option<Learned> {
    if feedback.forgotten.contains(&of) {
        return None;
    }
    let spoken = feedback.wishes.iter().rfind(|wish| wish.of == of);
    // Correlated traits cannot be separated: the wish follows the answers, its strength the posterior.
    let shown = mean(feedback, Verdict::Keep, &of).zip(mean(feedback, Verdict::Reject, &of));
    let way = shown.map_or(WishDirection::More, |(kept, rejected)| {
        if kept < rejected { WishDirection::Less } else { WishDirection::More }
    });
    let wish = Wish { wants: spoken.map_or(way, |wish| wish.wants), of };
    let (kept, rejected) =
        (range(feedback, Verdict::Keep, &wish.of), range(feedback, Verdict::Reject, &wish.of));
    let middle = middle(feedback, &wish.of);
    let (mut agree, mut against) = (0, Vec::new());
    for (i, answer) in feedback.answers.iter().enumerate() {
        match middle.and_then(|middle| agrees(answer, &wish, middle)) {
            Some(true) => agree += 1,
            Some(false) => against.push(i),
            None => (),
        }
    }
    let said = spoken.is_some();
    let told = said || agree >= LEAST_AGREED && agree >= AGREED_TIMES * against.len();
    let strength = (wish.wants.sign() * taste.leaning(&wish.of)).max(0.0);
    told.then_some(Learned { wish, strength, said, kept, rejected, against })
}

/// Whether an answer agrees with a wish or contradicts it.
fn agrees(answer: &JudgedCard, wish: &Wish, middle: f64) -> Option<bool> {
    let value = answer.features.value(&wish.of)?;
    let wished = is_wished(value, middle, wish.wants)?;
    Some(wished == (answer.verdict == Verdict::Keep))
}

/// Whether a value lies on the wished side of the middle.
fn is_wished(value: f64, middle: f64, wants: WishDirection) -> Option<bool> {
    let beyond = wants.sign() * (value - middle);
    (beyond.abs() > 1e-9).then_some(beyond > 0.0)
}

fn values<'a>(feedback: &'a Feedback, verdict: Verdict, of: &'a Trait) -> impl Iterator<Item = f64> + 'a {
    let answers = feedback.answers.iter().filter(move |answer| answer.verdict == verdict);
    answers.filter_map(|answer| answer.features.value(of))
}

fn range(feedback: &Feedback, verdict: Verdict, of: &Trait) -> Option<(f64, f64)> {
    let widened = |(low, high): (f64, f64), v: f64| (low.min(v), high.max(v));
    let (low, high) = values(feedback, verdict, of).fold((f64::INFINITY, f64::NEG_INFINITY), widened);
    (low <= high).then_some((low, high))
}

/// Half way between the average of the kept and that of the rejected.
fn middle(feedback: &Feedback, of: &Trait) -> Option<f64> {
    Some(0.5 * (mean(feedback, Verdict::Keep, of)? + mean(feedback, Verdict::Reject, of)?))
}

fn mean(feedback: &Feedback, verdict: Verdict, of: &Trait) -> Option<f64> {
    let add = |(sum, count), value| (sum + value, count + 1);
    let (sum, count) = values(feedback, verdict, of).fold((0.0, 0), add);
    (count > 0).then(|| sum / f64::from(count))
}

/// The share of the wishes that a motion fulfils; `None` without wishes.
pub(super) fn fulfilled(
    wishes: &[Learned],
    feedback: &Feedback,
    features: &super::Features,
    usual: &[&super::Features],
) -> Option<f64> {
    let judged = wishes.iter().filter_map(|learned| {
        let of = &learned.wish.of;
        let value = features.value(of)?;
        let mean = || {
            let values: Vec<f64> = usual.iter().filter_map(|f| f.value(of)).collect();
            (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
        };
        let middle = if of.is_quantity() { middle(feedback, of).or_else(mean)? } else { 0.0 };
        Some(is_wished(value, middle, learned.wish.wants).unwrap_or(false))
    });
    let judged: Vec<bool> = judged.collect();
    let met = judged.iter().filter(|met| **met).count();
    (!judged.is_empty()).then(|| met as f64 / judged.len() as f64)
}
