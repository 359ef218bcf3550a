//! Parameters of a scenario: `$name`, and `${...}` with numbers, parameters and the usual signs.

use crate::problem::{FieldProblem, ReadError, code};
use crate::refusals::{self, wanted, what};
use crate::tree::XmlNode;
use std::collections::HashMap;

/// Most parameters that hold at one place, and deepest brackets of an expression.
const MAX_PARAMETERS: usize = 4_096;
const MAX_DEPTH: usize = 32;
/// Attributes that name a parameter and have no value of one.
const NAMES: [&str; 2] = ["parameterRef", "variableRef"];

/// Parameters that hold at a place.
#[derive(Clone, Debug, Default)]
pub(super) struct Scope {
    values: HashMap<String, String>,
}

impl Scope {
    /// The same with the parameters that an element declares, unless `given` has them.
    ///
    /// # Errors
    /// `invalid-field` for a value that names an unknown parameter, `out-of-range` for too many.
    pub fn declared(&self, node: &XmlNode, given: &HashMap<String, String>) -> Result<Self, ReadError> {
        let mut scope = self.clone();
        let lists = node.all("ParameterDeclarations").chain(node.all("ParameterDeclaration"));
        for list in lists {
            let single = (list.name() == "ParameterDeclaration").then_some(list);
            for declared in list.all("ParameterDeclaration").chain(single) {
                let name = attribute(declared, "name").trim_start_matches('$').to_owned();
                let value = match given.get(&name) {
                    Some(value) => value.clone(),
                    None => scope.value(declared, attribute(declared, "value"))?,
                };
                scope.values.insert(name, value);
            }
        }
        if scope.values.len() > MAX_PARAMETERS {
            let message = refusals::more_than(MAX_PARAMETERS, what::VALUES).at_line(node.element.line);
            return Err(FieldProblem::new("", code::OUT_OF_RANGE, message).into());
        }
        Ok(scope)
    }

    /// Replaces parameters by their values in an element and all in it.
    ///
    /// # Errors
    /// `invalid-field` for an unknown parameter.
    pub fn fill(&self, node: &mut XmlNode) -> Result<(), ReadError> {
        for i in 0..node.element.attributes.len() {
            let Some((name, text)) = node.element.attributes.get(i) else { continue };
            if !text.contains('$') || NAMES.contains(&name.as_str()) {
                continue;
            }
            let value = self.value(node, text)?;
            if let Some((_, text)) = node.element.attributes.get_mut(i) {
                *text = value;
            }
        }
        // Declarations within hold further down: they are resolved where they are read.
        let inner = node.children.iter_mut().filter(|child| child.name() != "ParameterDeclarations");
        for child in inner {
            if child.name() != "Maneuver" {
                self.fill(child)?;
            }
        }
        Ok(())
    }

    fn value(&self, node: &XmlNode, text: &str) -> Result<String, ReadError> {
        let wrong = || node.wrong(text, wanted::PARAMETER);
        if let Some(inner) = text.strip_prefix("${").and_then(|rest| rest.strip_suffix('}')) {
            let mut expression = ParameterExpression { scope: self, rest: inner.as_bytes(), depth: 0 };
            let value = expression.sum().filter(|v| v.is_finite() && expression.is_done());
            return value.map(|value| value.to_string()).ok_or_else(wrong);
        }
        match text.strip_prefix('$') {
            Some(name) => self.values.get(name).cloned().ok_or_else(wrong),
            None => Ok(text.to_owned()),
        }
    }
}

/// An attribute, or nothing.
pub(super) fn attribute<'a>(node: &'a XmlNode, name: &str) -> &'a str {
    node.element.get(name).unwrap_or_default()
}

/// An attribute as a finite number, if it is there.
///
/// # Errors
/// `invalid-field`.
pub(super) fn number(node: &XmlNode, name: &str) -> Result<Option<f64>, ReadError> {
    let Some(text) = node.element.get(name) else { return Ok(None) };
    let value = text.trim().parse().ok().filter(|v: &f64| v.is_finite() && v.abs() < 1e9);
    value.map(Some).ok_or_else(|| node.wrong(text, wanted::NUMBER))
}

/// The rest of an expression.
struct ParameterExpression<'a> {
    scope: &'a Scope,
    rest: &'a [u8],
    depth: usize,
}

impl ParameterExpression<'_> {
    fn sum(&mut self) -> Option<f64> {
        let mut value = self.product()?;
        while let Some(sign) = self.sign(b"+-") {
            let next = self.product()?;
            value = if sign == b'+' { value + next } else { value - next };
        }
        Some(value)
    }

    fn product(&mut self) -> Option<f64> {
        let mut value = self.single()?;
        while let Some(sign) = self.sign(b"*/%") {
            let next = self.single()?;
            value = match sign {
                b'*' => value * next,
                b'/' => value / next,
                _ => value % next,
            };
        }
        Some(value)
    }

    fn single(&mut self) -> Option<f64> {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            return None;
        }
        let value = match self.sign(b"-+(") {
            Some(b'-') => self.single().map(|value| -value),
            Some(b'+') => self.single(),
            Some(_) => self.sum().filter(|_| self.sign(b")").is_some()),
            None => self.atom(),
        };
        self.depth -= 1;
        value
    }

    fn atom(&mut self) -> Option<f64> {
        let named = self.rest.first() == Some(&b'$');
        self.rest = self.rest.get(usize::from(named)..)?;
        let part = |b: &u8| b.is_ascii_alphanumeric() || matches!(b, b'.' | b'_');
        let count = self.rest.iter().position(|b| !part(b)).unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(count);
        self.rest = rest;
        let word = std::str::from_utf8(word).ok()?;
        if named { self.scope.values.get(word)?.parse().ok() } else { word.parse().ok() }
    }

    fn sign(&mut self, signs: &[u8]) -> Option<u8> {
        self.rest = self.rest.trim_ascii_start();
        let first = *self.rest.first().filter(|b| signs.contains(b))?;
        self.rest = self.rest.get(1..)?.trim_ascii_start();
        Some(first)
    }

    fn is_done(&self) -> bool {
        self.rest.trim_ascii().is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn expressions_have_the_usual_order() {
        let values = [("v", "10"), ("name", "a")].map(|(a, b)| (a.to_owned(), b.to_owned())).into();
        let scope = Scope { values };
        let node = XmlNode::default();
        let value = |text: &str| scope.value(&node, text).ok();
        assert_eq!(value("${1 + 2 * ($v - 4) / -3}").as_deref(), Some("-3"));
        assert_eq!((value("$name").as_deref(), value("7 $").as_deref()), (Some("a"), Some("7 $")));
        for wrong in ["$w", "${$w}", "${1 +}", "${(1}", "${1/0}", "${}", "${1 2}"] {
            assert_eq!(value(wrong), None, "{wrong}");
        }
        assert_eq!(value(&format!("${{{}1{}}}", "(".repeat(99), ")".repeat(99))), None);
    }
}
