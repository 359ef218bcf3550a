//! A person's feedback on earlier cards, as input of a generation.

use crate::english::what;
use formats::native::Members;
use formats::refusals::at_most;
use formats::{FieldProblem, pointer_token};
use scene::Vec2;
use scene::preference::{Features, Feedback, JudgedCard, Places, Trait, Verdict, Wish};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// Most judged cards.
const MOST_ANSWERS: usize = 200;
/// Most wishes, and most ignored traits.
const MOST_WISHES: usize = 32;
/// Most different traits of all cards and wishes together.
const MOST_TRAITS: usize = 64;
/// Most places of a road user: every half second of the longest answer.
const MOST_PLACES: usize = 41;

/// Rounds of cards: the reply is the next round, chosen from a wide draw by the verdicts on earlier cards. `feedback`
/// of the reply has the features of each card; the client returns them with its verdict.
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct FeedbackDoc {
    /// Judged cards in the order of the rounds, without cards that were neither kept nor rejected.
    #[schemars(length(max = 200))]
    pub answers: Vec<AnswerDoc>,
    /// Preferences that the user stated.
    #[schemars(length(max = 32))]
    pub wishes: Vec<Wish>,
    /// Traits to ignore, whatever the verdicts are.
    #[schemars(length(max = 32))]
    pub forgotten: Vec<Trait>,
}

/// A judged card.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AnswerDoc {
    /// Features of the card, as in the reply.
    pub features: Features,
    /// The user's verdict.
    pub verdict: Verdict,
    /// The reason for the verdict.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub why: Option<Wish>,
    /// Positions of the card, as in the reply; later rounds have no similar card.
    #[serde(default)]
    pub places: Members<Vec<[f64; 2]>>,
}

impl FeedbackDoc {
    /// Converts the judged cards, wishes and ignored traits.
    ///
    /// # Errors
    /// Lists that are too long and numbers out of their range, each with its place.
    pub fn resolve(&self) -> Result<Feedback, Vec<FieldProblem>> {
        let mut faults = Vec::new();
        let lengths = [
            ("answers", what::ENTRIES, self.answers.len(), MOST_ANSWERS),
            ("wishes", what::ENTRIES, self.wishes.len(), MOST_WISHES),
            ("forgotten", what::ENTRIES, self.forgotten.len(), MOST_WISHES),
            ("answers", what::TRAITS, self.traits().len(), MOST_TRAITS),
        ];
        for (name, what, count, most) in lengths {
            if count > most {
                let message = at_most(count, what, most);
                faults.push(FieldProblem::new(format!("/feedback/{name}"), "invalid-field", message));
            }
        }
        if !faults.is_empty() {
            return Err(faults);
        }
        let answers = self.answers.iter().enumerate();
        let answers =
            answers.map(|(i, doc)| doc.resolve(&format!("/feedback/answers/{i}"), &mut faults)).collect();
        let feedback = Feedback { answers, wishes: self.wishes.clone(), forgotten: self.forgotten.clone() };
        if faults.is_empty() { Ok(feedback) } else { Err(faults) }
    }

    fn traits(&self) -> BTreeSet<Trait> {
        let judged = self.answers.iter().flat_map(|answer| answer.features.traits());
        judged.chain(self.wishes.iter().map(|wish| wish.of.clone())).collect()
    }
}

impl AnswerDoc {
    fn resolve(&self, pointer: &str, faults: &mut Vec<FieldProblem>) -> JudgedCard {
        for (name, value, most) in self.features.quantities() {
            if !(0.0..=most).contains(&value) {
                faults.push(FieldProblem::range(format!("{pointer}/features/{name}"), 0.0, most, value));
            }
        }
        let mut places = Places::new();
        for (id, points) in &self.places.0 {
            let at = format!("{pointer}/places/{}", pointer_token(id));
            if points.len() > MOST_PLACES {
                let message = at_most(points.len(), what::PLACES, MOST_PLACES);
                faults.push(FieldProblem::new(at, "invalid-field", message));
                continue;
            }
            if let Some(far) = points.iter().flatten().find(|v| v.abs() > scene::MAX_COORDINATE_M) {
                let most = scene::MAX_COORDINATE_M;
                faults.push(FieldProblem::range(at, -most, most, *far));
            }
            places.insert(id.clone(), points.iter().map(|[x, y]| Vec2::new(*x, *y)).collect());
        }
        JudgedCard { features: self.features.clone(), verdict: self.verdict, why: self.why.clone(), places }
    }
}
