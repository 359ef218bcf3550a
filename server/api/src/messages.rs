//! All sentences that a reply can carry as a code with values.

use scene::message::MessageKind;

/// The table of sentences: of refused requests and files, the engine, map checks and the readers' warnings. Codes are unique.
pub fn all() -> impl Iterator<Item = &'static MessageKind> {
    let tables = [
        crate::english::MESSAGES,
        scene::sentences::MESSAGES,
        experts::sentences::MESSAGES,
        layouts::messages::MESSAGES,
        formats::sentences::MESSAGES,
    ];
    tables.into_iter().flatten()
}

/// The table as it is committed, for clients that write the sentences in another language.
pub fn text() -> String {
    let mut text = serde_json::to_string_pretty(&all().collect::<Vec<_>>()).unwrap_or_default();
    text.push('\n');
    text
}
