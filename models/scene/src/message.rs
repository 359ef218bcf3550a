//! Sentences as data: a code that names the sentence, the values in it, and its English.
//!
//! A crate lists its sentences once with [`messages!`](crate::messages). Clients switch on the code and write the
//! sentence in their own language and units; the English text is what `detail` and the command line show.

use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt;

/// A value in a sentence. Its unit is the suffix of its name (`_m`, `_s`, `_mps`, `_mps2`).
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum MessageValue {
    /// A quantity or a count.
    Number(f64),
    /// An id, a name or a word.
    Text(String),
}

/// One sentence.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Message {
    /// Code of the sentence, which never changes.
    pub code: &'static str,
    /// Values of its placeholders. An absent optional value is left out.
    pub values: BTreeMap<&'static str, MessageValue>,
    /// The sentence in English.
    #[serde(skip)]
    pub english: String,
}

impl Message {
    /// A sentence; [`messages!`](crate::messages) makes functions that call this.
    pub fn new(
        code: &'static str,
        values: &[(&'static str, Option<MessageValue>)],
        english: impl Into<String>,
    ) -> Self {
        let values = values.iter().filter_map(|(name, value)| Some((*name, value.clone()?))).collect();
        Self { code, values, english: english.into() }
    }
}

impl Message {
    /// Adds the line of a text file, from 1.
    #[must_use]
    pub fn at_line(mut self, line: impl Into<u64>) -> Self {
        let line = line.into();
        self.values.insert("line", MessageValue::Number(line as f64));
        self.english.insert_str(0, &format!("line {line}: "));
        self
    }
}

impl std::error::Error for Message {}

impl fmt::Display for Message {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.english)
    }
}

/// A row of the table of sentences.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct MessageKind {
    /// Stable name of the sentence.
    pub code: &'static str,
    /// The sentence in English, its placeholders in braces.
    pub english: &'static str,
    /// The sentence for a count of one, if it differs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub one: Option<&'static str>,
    /// Names of its values.
    pub values: &'static [&'static str],
}

/// A value of a placeholder: its `Display` is the English text, [`value`](Self::value) the value in the
/// document.
pub trait Placeholder: fmt::Display {
    /// The value in the document; `None` leaves it out.
    fn value(&self) -> Option<MessageValue>;
}

impl Placeholder for f64 {
    fn value(&self) -> Option<MessageValue> {
        Some(MessageValue::Number(*self))
    }
}

impl Placeholder for usize {
    fn value(&self) -> Option<MessageValue> {
        Some(MessageValue::Number(*self as f64))
    }
}

impl Placeholder for u64 {
    fn value(&self) -> Option<MessageValue> {
        Some(MessageValue::Number(*self as f64))
    }
}

impl Placeholder for str {
    fn value(&self) -> Option<MessageValue> {
        Some(MessageValue::Text(self.to_owned()))
    }
}

impl Placeholder for String {
    fn value(&self) -> Option<MessageValue> {
        self.as_str().value()
    }
}

impl<T: Placeholder + ?Sized> Placeholder for &T {
    fn value(&self) -> Option<MessageValue> {
        (**self).value()
    }
}

/// A word of a fixed list: the document holds its code, the sentence its English.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Word {
    /// Code in the document.
    pub code: &'static str,
    /// English word in the sentence.
    pub english: &'static str,
}

impl fmt::Display for Word {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.english)
    }
}

impl Placeholder for Word {
    fn value(&self) -> Option<MessageValue> {
        Some(MessageValue::Text(self.code.to_owned()))
    }
}

/// Declares sentences: `name(value: Type, ..) = "code", "English with {value}";`. Each becomes a function that returns
/// a [`Message`](crate::message::Message), and a row of the table `MESSAGES`. The compiler checks the placeholders.
/// `[count] "{count} lane",` before the sentence is its singular, where the value `count` is one.
#[macro_export]
macro_rules! messages {
    ($($name:ident($($value:ident: $kind:ty),* $(,)?) =
        $code:literal, $([$counted:ident] $one:literal,)? $english:literal;)*) => {
        $(
            #[doc = $english]
            pub fn $name($($value: $kind),*) -> $crate::message::Message {
                let values = [$((stringify!($value), $crate::message::Placeholder::value(&$value))),*];
                $(if $counted == 1 {
                    return $crate::message::Message::new($code, &values, format!($one));
                })?
                $crate::message::Message::new($code, &values, format!($english))
            }
        )*
        /// All sentences of this module.
        pub const MESSAGES: &[$crate::message::MessageKind] = &[$(
            $crate::message::MessageKind {
                code: $code,
                english: $english,
                one: [$(Some($one),)? None][0],
                values: &[$(stringify!($value)),*],
            }
        ),*];
    };
}

/// Declares a list of words, which are the same in documents and in English, and its table `WORDS`.
#[macro_export]
macro_rules! words {
    ($($name:ident = $english:literal;)*) => {
        $(
            #[doc = $english]
            pub const $name: $crate::message::Word =
                $crate::message::Word { code: $english, english: $english };
        )*
        /// All words of this list.
        pub const WORDS: &[&str] = &[$($english),*];
    };
}

#[cfg(test)]
mod tests {
    use super::{MessageValue, Word};

    crate::messages! {
        narrow(lane: &str, width_m: f64) = "lane-narrow", "Lane {lane} is {width_m:.1} m wide";
        turns(vehicle: Word) = "turns", "A {vehicle} can turn";
        lanes_lead() = "lanes-lead", "Every lane leads somewhere";
        crossed(count: usize) = "crossed", [count] "{count} lane is crossed", "{count} lanes are crossed";
    }

    #[test]
    fn a_sentence_has_its_code_its_values_and_its_english() {
        let message = narrow("7", 2.25);
        assert_eq!(message.to_string(), "Lane 7 is 2.2 m wide");
        let document = serde_json::to_value(&message).unwrap();
        assert_eq!(
            document,
            serde_json::json!({"code": "lane-narrow", "values": {"lane": "7", "width_m": 2.25}})
        );
    }

    #[test]
    fn a_word_stands_in_the_document_by_its_code() {
        let message = turns(Word { code: "bus", english: "12 m bus" });
        assert_eq!(message.english, "A 12 m bus can turn");
        assert_eq!(message.values["vehicle"], MessageValue::Text("bus".into()));
    }

    #[test]
    fn a_sentence_about_a_line_has_its_number() {
        let message = lanes_lead().at_line(7_u32);
        assert_eq!(message.english, "line 7: Every lane leads somewhere");
        assert_eq!(message.values["line"], MessageValue::Number(7.0));
    }

    #[test]
    fn one_thing_stands_in_the_singular() {
        assert_eq!(crossed(1).english, "1 lane is crossed");
        assert_eq!(crossed(2).english, "2 lanes are crossed");
        assert_eq!(crossed(0).english, "0 lanes are crossed");
    }

    #[test]
    fn the_table_lists_every_sentence_with_its_values() {
        let rows: Vec<(&str, &[&str])> = MESSAGES.iter().map(|row| (row.code, row.values)).collect();
        let none: &[&str] = &[];
        assert_eq!(
            rows,
            [
                ("lane-narrow", &["lane", "width_m"][..]),
                ("turns", &["vehicle"]),
                ("lanes-lead", none),
                ("crossed", &["count"])
            ]
        );
        assert_eq!(MESSAGES[3].one, Some("{count} lane is crossed"));
        assert_eq!(lanes_lead().english, MESSAGES[2].english);
    }
}
