//! Parameters of a scenario: `$name`, and `${...}` with numbers, parameters and the usual operators.

use crate::problem::{FieldProblem, ReadError, code};
use crate::refusals::{self, wanted, what};
use crate::tree::XmlNode;
use std::collections::HashMap;

/// Most parameters in one scope, and deepest brackets of an expression.
const MAX_PARAMETERS: usize = 4_096;
const MAX_DEPTH: usize = 32;
/// Attributes that name a parameter instead of using its value.
const NAMES: [&str; 2] = ["parameterRef", "variableRef"];

/// Parameters of a scope.
#[derive(Clone, Debug, Default)]
pub(super) struct Scope {
    values: HashMap<String, String>,
}

impl Scope {
    /// The scope with the parameters that an element declares, unless `given` has them. A parameter without a
    /// known value is not declared.
    ///
    /// # Errors
    /// `out-of-range` for too many parameters.
    pub fn declared(&self, node: &XmlNode, given: &HashMap<String, String>) -> Result<Self, ReadError> {
        let mut scope = self.clone();
        let lists = node.all("ParameterDeclarations").chain(node.all("ParameterDeclaration"));
        for list in lists {
            let single = (list.name() == "ParameterDeclaration").then_some(list);
            for declared in list.all("ParameterDeclaration").chain(single) {
                let name = attribute(declared, "name").trim_start_matches('$').to_owned();
                let value = given.get(&name).cloned();
                match value.or_else(|| scope.value(attribute(declared, "value"))) {
                    Some(value) => scope.values.insert(name, value),
                    None => scope.values.remove(&name),
                };
            }
        }
        if scope.values.len() > MAX_PARAMETERS {
            let message = refusals::more_than(MAX_PARAMETERS, what::VALUES).at_line(node.element.line);
            return Err(FieldProblem::new("", code::OUT_OF_RANGE, message).into());
        }
        Ok(scope)
    }

    /// Replaces parameters by their values in an element and its content. Text without a value stays
    /// unchanged: [`number`] refuses it if it is needed, and most of it is not.
    pub fn fill(&self, node: &mut XmlNode) {
        for (name, text) in &mut node.element.attributes {
            if !text.contains('$') || NAMES.contains(&name.as_str()) {
                continue;
            }
            if let Some(value) = self.value(text) {
                *text = value;
            }
        }
        // Inner declarations apply to their own content: they are resolved when they are read.
        let inner = node.children.iter_mut().filter(|child| child.name() != "ParameterDeclarations");
        for child in inner {
            if child.name() != "Maneuver" {
                self.fill(child);
            }
        }
    }

    fn value(&self, text: &str) -> Option<String> {
        if let Some(inner) = text.strip_prefix("${").and_then(|rest| rest.strip_suffix('}')) {
            let mut expression = ParameterExpression { scope: self, rest: inner.as_bytes(), depth: 0 };
            let value = expression.sum().filter(|v| v.is_finite() && expression.is_done());
            return value.map(|value| value.to_string());
        }
        match text.strip_prefix('$') {
            Some(name) => self.values.get(name).cloned(),
            None => Some(text.to_owned()),
        }
    }
}

/// An attribute; empty if it is missing.
pub(super) fn attribute<'a>(node: &'a XmlNode, name: &str) -> &'a str {
    node.element.get(name).unwrap_or_default()
}

/// An attribute as a finite number, if it is present.
///
/// # Errors
/// `invalid-field`.
pub(super) fn number(node: &XmlNode, name: &str) -> Result<Option<f64>, ReadError> {
    let Some(text) = node.element.get(name) else { return Ok(None) };
    let value = text.trim().parse().ok().filter(|v: &f64| v.is_finite() && v.abs() < 1e9);
    let expected = if text.contains('$') { wanted::PARAMETER } else { wanted::NUMBER };
    value.map(Some).ok_or_else(|| node.wrong(text, expected))
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
        let ends = |from: usize| {
            let rest = self.rest.get(from..).unwrap_or_default();
            from + rest.iter().position(|b| !part(b)).unwrap_or(rest.len())
        };
        let mut count = ends(0);
        // The sign of an exponent belongs to the number.
        let is_number = !named && self.rest.first().is_some_and(u8::is_ascii_digit);
        let signed = matches!(self.rest.get(count.saturating_sub(1)..), Some([b'e' | b'E', b'+' | b'-', ..]));
        if is_number && signed {
            count = ends(count + 1);
        }
        let (word, rest) = self.rest.split_at(count);
        self.rest = rest;
        let word = std::str::from_utf8(word).ok()?;
        match (named, word) {
            (true, _) => self.scope.values.get(word)?.parse().ok(),
            (false, "pi") => Some(std::f64::consts::PI),
            (false, _) if self.sign(b"(").is_some() => self.function(word),
            (false, _) => word.parse().ok(),
        }
    }

    /// The value of a function; reads from after its opening bracket to after the closing one.
    fn function(&mut self, name: &str) -> Option<f64> {
        let first = self.sum()?;
        let second = if self.sign(b",").is_some() { Some(self.sum()?) } else { None };
        self.sign(b")")?;
        match (name, second) {
            ("abs", None) => Some(first.abs()),
            ("sign", None) => Some(if first == 0.0 { 0.0 } else { first.signum() }),
            ("round", None) => Some(first.round()),
            ("floor", None) => Some(first.floor()),
            ("ceil", None) => Some(first.ceil()),
            ("sqrt", None) => Some(first.sqrt()),
            ("sin", None) => Some(first.sin()),
            ("cos", None) => Some(first.cos()),
            ("tan", None) => Some(first.tan()),
            ("asin", None) => Some(first.asin()),
            ("acos", None) => Some(first.acos()),
            ("atan", None) => Some(first.atan()),
            ("pow", Some(exponent)) => Some(first.powf(exponent)),
            ("min", Some(other)) => Some(first.min(other)),
            ("max", Some(other)) => Some(first.max(other)),
            _ => None,
        }
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
        let value = |text: &str| scope.value(text);
        assert_eq!(value("${1 + 2 * ($v - 4) / -3}").as_deref(), Some("-3"));
        assert_eq!((value("$name").as_deref(), value("7 $").as_deref()), (Some("a"), Some("7 $")));
        for wrong in ["$w", "${$w}", "${1 +}", "${(1}", "${1/0}", "${}", "${1 2}", "${cosh(1)}", "${pow(2)}"]
        {
            assert_eq!(value(wrong), None, "{wrong}");
        }
        assert_eq!(value(&format!("${{{}1{}}}", "(".repeat(99), ")".repeat(99))), None);
        assert_eq!(value(&format!("${{{}1{}}}", "abs(".repeat(99), ")".repeat(99))), None);
    }

    #[test]
    fn expressions_have_functions_and_pi() {
        let values = [("v", "10"), ("a", "2.5")].map(|(a, b)| (a.to_owned(), b.to_owned())).into();
        let scope = Scope { values };
        let number = |text: &str| scope.value(text).and_then(|text| text.parse::<f64>().ok());
        assert_eq!(number("${$v*2 + 0.5*$a*pow( 2, 2 )}"), Some(25.0));
        assert_eq!((number("${1e-3 * 2}"), number("${2E+1-1}")), (Some(0.002), Some(19.0)));
        assert_eq!(number("${-pi}"), Some(-std::f64::consts::PI));
        assert_eq!(number("${sqrt($v * $a) - abs(-3) + min(1, 2) - max(1, 2)}"), Some(1.0));
        assert_eq!(number("${round(2.5) + floor(1.9) + ceil(1.1) + sign(-4) + sign(0)}"), Some(5.0));
        assert_eq!(number("${sqrt(-1)}"), None);
    }

    #[test]
    fn what_has_no_value_is_refused_where_a_number_is_needed_alone() {
        let mut node = XmlNode::default();
        let attributes = [("rule", "$unset"), ("x", "${$unset + 1}"), ("y", "${1 + 1}")];
        node.element.attributes = attributes.map(|(a, b)| (a.to_owned(), b.to_owned())).into();
        let scope = Scope::default();
        scope.fill(&mut node);
        assert_eq!((attribute(&node, "rule"), number(&node, "y").unwrap()), ("$unset", Some(2.0)));
        assert!(number(&node, "x").is_err());
    }
}
