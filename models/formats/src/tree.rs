//! Reads XML elements with their content, one at a time, for formats whose files are lists of small elements.

use crate::problem::{FieldProblem, ReadError, code};
use crate::refusals::{self, shown, wanted, what};
use crate::xml::{Element, Missing, Scanner, XmlEvent};
use scene::message::Word;
use std::io::BufRead;

/// Most elements within one, and most bytes of their names, attributes and texts.
const MAX_NODES: usize = 100_000;
const MAX_BYTES: usize = 16 << 20;

/// An element with its attributes, its text and the elements in it.
#[derive(Clone, Debug, Default)]
pub(crate) struct XmlNode {
    pub element: Element,
    pub children: Vec<XmlNode>,
    /// Trimmed text; all pieces of it.
    pub text: String,
}

impl XmlNode {
    /// Reads the content that follows a start tag, up to its end tag.
    ///
    /// # Errors
    /// Those of the scanner; `out-of-range` for an element with too much content.
    pub fn read<R: BufRead>(scanner: &mut Scanner<R>, element: Element) -> Result<Self, ReadError> {
        let (line, mut nodes, mut bytes) = (element.line, 1, 0);
        let mut open = vec![Self { element, ..Self::default() }];
        while let Some(event) = scanner.next()? {
            match event {
                XmlEvent::Start(element) => {
                    nodes += 1;
                    bytes += element.name.len();
                    bytes += element
                        .attributes
                        .iter()
                        .map(|(name, value)| name.len() + value.len())
                        .sum::<usize>();
                    open.push(Self { element, ..Self::default() });
                }
                XmlEvent::Text(text) => {
                    bytes += text.len();
                    if let Some(node) = open.last_mut() {
                        node.text.push_str(&text);
                    }
                }
                XmlEvent::End => {
                    let Some(mut node) = open.pop() else { break };
                    node.children.shrink_to_fit();
                    match open.last_mut() {
                        Some(parent) => parent.children.push(node),
                        None => return Ok(node),
                    }
                }
            }
            let counts = [(nodes, MAX_NODES, what::NESTED), (bytes, MAX_BYTES, what::BYTES)];
            if let Some((most, what)) = refusals::exceeded(&counts) {
                let message = refusals::more_than(most, what).at_line(line);
                return Err(FieldProblem::new("", code::OUT_OF_RANGE, message).into());
            }
        }
        // The scanner reports unclosed elements.
        Ok(open.swap_remove(0))
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.element.name
    }

    /// The first element of this name in it.
    pub fn child(&self, name: &str) -> Option<&Self> {
        self.children.iter().find(|child| child.name() == name)
    }

    /// The first element at the end of this path.
    pub fn at(&self, way: &[&str]) -> Option<&Self> {
        way.iter().try_fold(self, |node, name| node.child(name))
    }

    /// All elements of this name in it.
    pub fn all<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a Self> {
        self.children.iter().filter(move |child| child.name() == name)
    }

    /// The first element of this name in it.
    ///
    /// # Errors
    /// `invalid-field` when there is none.
    pub fn required(&self, name: &str) -> Result<&Self, ReadError> {
        let missing = || refusals::element_lacks_child(&shown(self.name()), name).at_line(self.element.line);
        self.child(name).ok_or_else(|| FieldProblem::new("", code::INVALID_FIELD, missing()).into())
    }

    /// Its text as a finite number.
    ///
    /// # Errors
    /// `invalid-field`.
    pub fn number(&self) -> Result<f64, ReadError> {
        let number = self.text.parse().ok().filter(|v: &f64| v.is_finite());
        number.ok_or_else(|| self.wrong(&self.text, wanted::NUMBER))
    }

    /// An attribute as an integer.
    ///
    /// # Errors
    /// `invalid-field`.
    pub fn whole(&self, attribute: &'static str) -> Result<i64, ReadError> {
        let text = self.element.required(attribute).map_err(|missing: Missing| ReadError::from(missing))?;
        text.trim().parse().map_err(|_| self.wrong(text, wanted::WHOLE))
    }

    /// Refusal with the value found and the value expected.
    pub fn wrong(&self, found: &str, expected: Word) -> ReadError {
        let message = refusals::found_in_element(&shown(found), &shown(self.name()), expected);
        FieldProblem::new("", code::INVALID_FIELD, message.at_line(self.element.line)).into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<XmlNode, ReadError> {
        let mut scanner = Scanner::new(text.as_bytes(), 1 << 10).with_texts();
        match scanner.next()? {
            Some(XmlEvent::Start(element)) => XmlNode::read(&mut scanner, element),
            _ => panic!("an element expected"),
        }
    }

    #[test]
    fn elements_are_found_by_their_way() {
        let node = read("<a id='7'>\n<b><c> 1.5 </c></b><b/>x</a>").unwrap();
        assert_eq!(node.at(&["b", "c"]).unwrap().number().unwrap(), 1.5);
        assert_eq!((node.all("b").count(), node.text.as_str(), node.whole("id").unwrap()), (2, "x", 7));
        let missing = node.required("d").unwrap_err();
        assert_eq!(missing.problems[0].detail, "line 1: <a> has no <d>");
        let wrong = node.child("b").unwrap().number().unwrap_err();
        assert_eq!(wrong.problems[0].detail, "line 2: \"\" found in <b>, a number expected");
    }

    #[test]
    fn an_element_does_not_grow_for_ever() {
        let many = format!("<a>{}</a>", "<b/>".repeat(MAX_NODES));
        assert_eq!(read(&many).unwrap_err().code(), "out-of-range");
        assert!(read("<a><b>").is_err());
    }
}
