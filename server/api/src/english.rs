//! English of what the operations refuse: one sentence a code, with places for values.
//!
//! A carrier that speaks another language has the same table with the same codes and names of values.

use serde_json::Value;
use std::collections::BTreeMap;

/// Values of a sentence by name.
pub type Values = BTreeMap<&'static str, Value>;

macro_rules! sentences {
    ($($variant:ident $code:literal $text:literal;)*) => {
        /// What a refusal says.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[allow(missing_docs, reason = "the table says it")]
        pub enum Sentence { $($variant,)* }

        impl Sentence {
            /// All sentences.
            pub const ALL: &'static [Self] = &[$(Self::$variant,)*];

            /// The word that names it in every language.
            pub fn code(self) -> &'static str { match self { $(Self::$variant => $code,)* } }

            /// English, with the names of values in braces.
            pub fn text(self) -> &'static str { match self { $(Self::$variant => $text,)* } }
        }
    };
}

sentences! {
    UnknownAgent "unknown-agent" "the scene has no road user \"{id}\"";
    NobodyAsked "nobody-asked" "\"all\" or at least one id expected, or somebody who reacts";
    TooManyRegenerated "too-many-regenerated" "{count} road users to regenerate; at most {most}";
    TooManyPoints "too-many-points" "the reply would have {points} points; at most {most}";
    NoFutureKept "no-future-kept" "the scene keeps no future of this road user from the start on";
    ReplanInterval "replan-interval" "{got} s; null, 3, 6 or 9 expected";
    UnknownEdge "unknown-edge" "the id of a road edge of the map expected";
    UnequalColumns "unequal-columns" "{count} values, as many as x_m ({expected}) expected";
    MoreThanATurn "more-than-a-turn" "{got} rad is more than a turn; {got} degrees are {radians} rad";
    OneScene "one-scene" "exactly one of scene and scene_id is needed";
    ChangedScene "changed-scene" "The stored scene is another than the one you read.";
    NoNetwork "no-network" "a file of format {format} comes without a network";
    NoColumns "no-columns" "a file of format {format} has no columns to name";
    UnknownFormat "unknown-format" "No format is named \"{format}\"; there are {formats}.";
    Defect "defect" "The server failed; its log says more.";
}

impl Sentence {
    /// The sentence with its values. A text stands as it is, a number in its shortest form.
    pub fn english(self, values: &Values) -> String {
        let (mut out, mut rest) = (String::new(), self.text());
        while let Some((before, name, after)) = placeholder(rest) {
            out.push_str(before);
            match values.get(name) {
                Some(Value::String(text)) => out.push_str(text),
                Some(other) => out.push_str(&other.to_string()),
                None => out.push('?'),
            }
            rest = after;
        }
        out + rest
    }
}

/// What stands before the first place of a text, the place's name, and what stands behind it.
fn placeholder(text: &str) -> Option<(&str, &str, &str)> {
    let (before, rest) = text.split_once('{')?;
    let (name, after) = rest.split_once('}')?;
    Some((before, name, after))
}

#[cfg(test)]
mod tests {
    use super::{Sentence, Values, placeholder};
    use std::collections::BTreeSet;

    #[test]
    fn codes_are_unique_and_places_have_plain_names() {
        let codes: BTreeSet<&str> = Sentence::ALL.iter().map(|sentence| sentence.code()).collect();
        assert_eq!(codes.len(), Sentence::ALL.len());
        for sentence in Sentence::ALL {
            let mut rest = sentence.text();
            while let Some((_, name, after)) = placeholder(rest) {
                assert!(name.chars().all(|c| c.is_ascii_lowercase() || c == '_'), "{}", sentence.code());
                rest = after;
            }
            assert!(!rest.contains(['{', '}']), "{}", sentence.code());
        }
    }

    #[test]
    fn values_take_their_places() {
        let values = Values::from([("count", 3.into()), ("most", 2.into())]);
        let words = Sentence::TooManyRegenerated.english(&values);
        assert_eq!(words, "3 road users to regenerate; at most 2");
        let values = Values::from([("id", "a b".into())]);
        assert_eq!(Sentence::UnknownAgent.english(&values), "the scene has no road user \"a b\"");
        assert!(Sentence::UnknownAgent.english(&Values::new()).contains('?'));
    }
}
