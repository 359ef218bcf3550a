//! All sentences that a reply can carry as a code with values.

use crate::english;
use scene::message::MessageKind;
use std::collections::{BTreeMap, BTreeSet};

/// Words in sentences, by the name of their value.
fn words() -> BTreeMap<&'static str, BTreeSet<&'static str>> {
    let [files, instead] = formats::kinds::words();
    let lists: [(&str, &[&str]); 8] = [
        ("what", scene::sentences::what::WORDS),
        ("what", formats::refusals::what::WORDS),
        ("what", english::what::WORDS),
        ("expected", scene::sentences::wanted::WORDS),
        ("expected", formats::refusals::wanted::WORDS),
        ("expected", english::wanted::WORDS),
        ("file", &files),
        ("instead", &instead),
    ];
    let mut all: BTreeMap<_, BTreeSet<_>> = BTreeMap::new();
    for (name, words) in lists {
        all.entry(name).or_default().extend(words);
    }
    all
}

/// The sentences of refused requests and files, the engine, map checks and the readers' warnings. Codes are
/// unique.
pub fn all() -> impl Iterator<Item = &'static MessageKind> {
    let tables = [
        english::MESSAGES,
        scene::sentences::MESSAGES,
        experts::sentences::MESSAGES,
        layouts::messages::MESSAGES,
        formats::sentences::MESSAGES,
        formats::refusals::MESSAGES,
    ];
    tables.into_iter().flatten()
}

/// The table as it is committed, for clients that translate the sentences.
pub fn text() -> String {
    let document = serde_json::json!({"sentences": all().collect::<Vec<_>>(), "words": words()});
    let mut text = serde_json::to_string_pretty(&document).unwrap_or_default();
    text.push('\n');
    text
}

#[cfg(test)]
mod tests {
    use crate::english;
    use formats::refusals;
    use scene::sentences;

    #[test]
    fn a_word_stands_in_one_list() {
        let lists = [
            [sentences::what::WORDS, refusals::what::WORDS, english::what::WORDS],
            [sentences::wanted::WORDS, refusals::wanted::WORDS, english::wanted::WORDS],
        ];
        for lists in lists {
            let mut words = lists.concat();
            words.sort_unstable();
            let twice: Vec<_> = words.windows(2).filter(|pair| pair[0] == pair[1]).collect();
            assert!(words.len() > 30 && twice.is_empty(), "{twice:?}");
        }
    }
}
