//! Conditions on scores, such as `min_ttc_s < 1.5 && collisions == 0`: comparisons of figures with numbers or with
//! each other, joined by `&&`, `||`, `!` and parentheses.
//!
//! A comparison with a missing figure (no approaching pair, no goal) is false.

use super::tokens::{Operand, Order, Placed, Token, Wrong, tokens};

/// Greatest length of a condition, bytes.
const MOST_BYTES: usize = 4_096;
/// Deepest nesting of parentheses and `!`.
const MOST_DEEP: usize = 64;

/// A parsed condition.
#[derive(Clone, Debug, PartialEq)]
pub struct Expression(Node);

#[derive(Clone, Debug, PartialEq)]
enum Node {
    Or(Box<Node>, Box<Node>),
    And(Box<Node>, Box<Node>),
    Not(Box<Node>),
    Compare(Operand, Order, Operand),
}

impl Expression {
    /// Parses a condition; `known` decides which names are figures.
    ///
    /// # Errors
    /// The first fault with its column.
    pub fn parse(text: &str, known: &dyn Fn(&str) -> Result<(), String>) -> Result<Self, Wrong> {
        if text.len() > MOST_BYTES {
            return Err(Wrong {
                column: 1,
                what: format!("{} bytes; at most {MOST_BYTES} expected", text.len()),
            });
        }
        let tokens = tokens(text)?;
        let mut parser = Parser { tokens: &tokens, at: 0, end: text.chars().count() + 1, known };
        let node = parser.either(0)?;
        match parser.peek() {
            None => Ok(Self(node)),
            Some(_) => Err(parser.expected("&&, || or the end")),
        }
    }

    /// Whether it holds for the figures that `value` returns.
    pub fn holds(&self, value: &dyn Fn(&str) -> Option<f64>) -> bool {
        self.0.holds(value)
    }

    /// Distance from holding for the figures that `value` returns; 0 if it holds. `&&` adds the distances of its
    /// comparisons, and `||` takes the least one. A comparison counts at most 1, and 0.5 if it is missed by as
    /// much as its number, or by 1 if the number is 0.
    pub fn miss(&self, value: &dyn Fn(&str) -> Option<f64>) -> f64 {
        self.0.miss(true, value)
    }
}

impl Node {
    fn holds(&self, value: &dyn Fn(&str) -> Option<f64>) -> bool {
        match self {
            Self::Or(a, b) => a.holds(value) || b.holds(value),
            Self::And(a, b) => a.holds(value) && b.holds(value),
            Self::Not(a) => !a.holds(value),
            Self::Compare(a, order, b) => match (a.value(value), b.value(value)) {
                (Some(a), Some(b)) => match order {
                    Order::Less => a < b,
                    Order::AtMost => a <= b,
                    Order::More => a > b,
                    Order::AtLeast => a >= b,
                    Order::Equal => a == b,
                    Order::Unequal => a != b,
                },
                _ => false,
            },
        }
    }
}

impl Node {
    /// Distance from being `wanted`.
    fn miss(&self, wanted: bool, value: &dyn Fn(&str) -> Option<f64>) -> f64 {
        match self {
            Self::Not(a) => a.miss(!wanted, value),
            Self::Or(a, b) | Self::And(a, b) => {
                let (a, b) = (a.miss(wanted, value), b.miss(wanted, value));
                let is_both = matches!(self, Self::And(..)) == wanted;
                if is_both { a + b } else { a.min(b) }
            }
            compare if compare.holds(value) == wanted => 0.0,
            Self::Compare(a, order, b) => match (a.value(value), b.value(value)) {
                (Some(x), Some(y)) if !(wanted && *order == Order::Unequal) => {
                    let scale = [a, b].into_iter().find_map(Operand::number).unwrap_or(0.0).abs();
                    let off = (x - y).abs() / if scale == 0.0 { 1.0 } else { scale };
                    // Equal values miss `<` by zero, but the comparison does not hold.
                    (off / (off + 1.0)).max(f64::MIN_POSITIVE)
                }
                _ => 1.0,
            },
        }
    }
}

impl Operand {
    fn number(&self) -> Option<f64> {
        match self {
            Self::Number(number) => Some(*number),
            Self::Figure(_) => None,
        }
    }

    fn value(&self, value: &dyn Fn(&str) -> Option<f64>) -> Option<f64> {
        match self {
            Self::Number(number) => Some(*number),
            Self::Figure(name) => value(name),
        }
    }
}

struct Parser<'a> {
    tokens: &'a [Placed],
    at: usize,
    /// Column after the end of the text.
    end: usize,
    known: &'a dyn Fn(&str) -> Result<(), String>,
}

impl Parser<'_> {
    fn peek(&self) -> Option<&Token> {
        self.tokens.get(self.at).map(|placed| &placed.token)
    }

    fn take(&mut self, wanted: &Token) -> bool {
        let found = self.peek() == Some(wanted);
        self.at += usize::from(found);
        found
    }

    fn expected(&self, what: &str) -> Wrong {
        match self.tokens.get(self.at) {
            Some(placed) => {
                Wrong { column: placed.column, what: format!("{what} expected, \"{}\" found", placed.text) }
            }
            None => Wrong { column: self.end, what: format!("{what} expected, the end found") },
        }
    }

    fn either(&mut self, deep: usize) -> Result<Node, Wrong> {
        let mut left = self.both(deep)?;
        while self.take(&Token::Or) {
            left = Node::Or(Box::new(left), Box::new(self.both(deep)?));
        }
        Ok(left)
    }

    fn both(&mut self, deep: usize) -> Result<Node, Wrong> {
        let mut left = self.one(deep)?;
        while self.take(&Token::And) {
            left = Node::And(Box::new(left), Box::new(self.one(deep)?));
        }
        Ok(left)
    }

    fn one(&mut self, deep: usize) -> Result<Node, Wrong> {
        if deep > MOST_DEEP {
            return Err(self.expected(&format!("at most {MOST_DEEP} parentheses and ! inside each other")));
        }
        if self.take(&Token::Not) {
            return Ok(Node::Not(Box::new(self.one(deep + 1)?)));
        }
        if self.take(&Token::Open) {
            let inner = self.either(deep + 1)?;
            return if self.take(&Token::Close) { Ok(inner) } else { Err(self.expected("&&, || or )")) };
        }
        let left = self.operand("a figure, a number, ! or (")?;
        let Some(Token::Compare(order)) = self.peek().cloned() else {
            return Err(self.expected("<, <=, >, >=, == or !="));
        };
        self.at += 1;
        Ok(Node::Compare(left, order, self.operand("a figure or a number")?))
    }

    fn operand(&mut self, what: &str) -> Result<Operand, Wrong> {
        let Some(Token::Operand(operand)) = self.peek().cloned() else { return Err(self.expected(what)) };
        if let Operand::Figure(name) = &operand {
            let column = self.tokens[self.at].column;
            (self.known)(name).map_err(|what| Wrong { column, what })?;
        }
        self.at += 1;
        Ok(operand)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn known(name: &str) -> Result<(), String> {
        if ["a", "b", "none", "c.d"].contains(&name) { Ok(()) } else { Err(format!("no figure \"{name}\"")) }
    }

    fn value(name: &str) -> Option<f64> {
        match name {
            "a" => Some(1.0),
            "b" => Some(2.0),
            "c.d" => Some(-0.5),
            _ => None,
        }
    }

    fn holds(text: &str) -> bool {
        Expression::parse(text, &known).unwrap_or_else(|wrong| panic!("{text}: {wrong}")).holds(&value)
    }

    #[test]
    fn comparisons_and_their_joints() {
        let yes = ["a < b", "a<=1&&b>=2", "a == 1 || b == 9", "!(a > b)", "a != b", "c.d == -.5", "1e0 == a"];
        yes.iter().for_each(|text| assert!(holds(text), "{text}"));
        let no = ["a > b", "a == 1 && b == 1", "!(a < b)", "!a==1", "a >= 1.0001"];
        no.iter().for_each(|text| assert!(!holds(text), "{text}"));
        // && binds closer than ||.
        assert!(holds("a == 1 || a == 1 && b == 9") && !holds("(a == 1 || a == 1) && b == 9"));
    }

    #[test]
    fn a_figure_that_is_missing_compares_as_false() {
        for order in ["<", "<=", ">", ">=", "==", "!="] {
            assert!(!holds(&format!("none {order} 1")), "{order}");
            assert!(holds(&format!("!(none {order} 1)")), "{order}");
        }
    }

    fn miss(text: &str) -> f64 {
        Expression::parse(text, &known).unwrap_or_else(|wrong| panic!("{text}: {wrong}")).miss(&value)
    }

    #[test]
    fn a_miss_is_zero_where_a_condition_holds_and_grows_with_the_distance() {
        for text in
            ["a < b", "!(a > b)", "a == 1 || b == 9", "!(none < 1)", "a > 1", "!(a < b)", "a == 1 && b == 1"]
        {
            assert_eq!(miss(text) == 0.0, holds(text), "{text}: {}", miss(text));
        }
        // By a half of 2, by a whole 2, by three times 1; by 1 where the number is 0.
        assert_eq!([miss("a > 2"), miss("a > 4"), miss("a == 0")], [1.0 / 3.0, 3.0 / 7.0, 0.5]);
        assert!(miss("b < 1.9") < miss("b < 1.5") && miss("b < 1.5") < miss("b < 0.1"));
        assert_eq!(miss("a > 2 && b < 1"), 1.0 / 3.0 + 0.5);
        assert_eq!(miss("a > 2 || b < 1"), 1.0 / 3.0);
        assert_eq!(miss("!(a < 2 || b > 1)"), 1.0 / 3.0 + 0.5);
        assert_eq!([miss("none < 1"), miss("a != 1"), miss("!(a == 1)")], [1.0, 1.0, f64::MIN_POSITIVE]);
        assert_eq!(miss("!(a != 2)"), 1.0 / 3.0);
    }

    #[test]
    fn faults_have_their_column() {
        let wrong = |text: &str| Expression::parse(text, &known).unwrap_err().to_string();
        assert_eq!(wrong("a < 1.5 && z == 0"), "column 12: no figure \"z\"");
        assert_eq!(wrong("a < "), "column 5: a figure or a number expected, the end found");
        assert_eq!(wrong("a = 1"), "column 3: \"=\" found; == compares");
        assert_eq!(wrong("a < 1 b"), "column 7: &&, || or the end expected, \"b\" found");
        assert_eq!(wrong("(a < 1"), "column 7: &&, || or ) expected, the end found");
        assert_eq!(wrong("a < 1..2"), "column 5: \"1..2\" is not a number");
        assert_eq!(wrong("a"), "column 2: <, <=, >, >=, == or != expected, the end found");
        assert_eq!(wrong("a < 1 & b < 1"), "column 7: \"&\" found; && joins");
        assert_eq!(wrong("a < 1 && é"), "column 10: no figure \"é\"");
        assert_eq!(wrong("a < $"), "column 5: \"$\" has no meaning here");
        assert_eq!(wrong(""), "column 1: a figure, a number, ! or ( expected, the end found");
        assert!(wrong(&"(".repeat(1_000)).contains("at most 64 parentheses"));
        assert!(wrong(&"a<1&&".repeat(1_000)).contains("at most 4096"));
    }
}
