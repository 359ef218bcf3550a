//! Tokens of a condition: names, numbers, comparisons, operators.

use std::fmt;

/// An operand of a comparison.
#[derive(Clone, Debug, PartialEq)]
pub enum Operand {
    /// A number.
    Number(f64),
    /// A figure by name.
    Figure(String),
}

/// A comparison operator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "the names say it")]
pub enum Order {
    Less,
    AtMost,
    More,
    AtLeast,
    Equal,
    Unequal,
}

/// A fault and its column.
#[derive(Clone, Debug, PartialEq)]
pub struct Wrong {
    /// Column from 1, in characters.
    pub column: usize,
    /// Expected and found text.
    pub what: String,
}

impl fmt::Display for Wrong {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "column {}: {}", self.column, self.what)
    }
}

/// A token of a condition.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs, reason = "the names say it")]
pub enum Token {
    And,
    Or,
    Not,
    Open,
    Close,
    Compare(Order),
    Operand(Operand),
}

/// A token with its column.
pub struct Placed {
    /// The token.
    pub token: Token,
    /// Its text.
    pub text: String,
    /// Column from 1, in characters.
    pub column: usize,
}

/// All tokens of a text.
///
/// # Errors
/// The first unknown token, with its column.
pub fn tokens(text: &str) -> Result<Vec<Placed>, Wrong> {
    let chars: Vec<char> = text.chars().collect();
    let (mut tokens, mut at) = (Vec::new(), 0);
    while let Some(c) = chars.get(at) {
        if c.is_whitespace() {
            at += 1;
            continue;
        }
        let (token, length) = token(&chars[at..]).map_err(|what| Wrong { column: at + 1, what })?;
        tokens.push(Placed { token, text: chars[at..at + length].iter().collect(), column: at + 1 });
        at += length;
    }
    Ok(tokens)
}

/// The first token of the rest, and its length in characters.
fn token(rest: &[char]) -> Result<(Token, usize), String> {
    let two: String = rest.iter().take(2).collect();
    let long = match two.as_str() {
        "&&" => Some(Token::And),
        "||" => Some(Token::Or),
        "==" => Some(Token::Compare(Order::Equal)),
        "!=" => Some(Token::Compare(Order::Unequal)),
        "<=" => Some(Token::Compare(Order::AtMost)),
        ">=" => Some(Token::Compare(Order::AtLeast)),
        _ => None,
    };
    if let Some(token) = long {
        return Ok((token, 2));
    }
    let first = rest.first().copied().unwrap_or(' ');
    let short = match first {
        '!' => Some(Token::Not),
        '(' => Some(Token::Open),
        ')' => Some(Token::Close),
        '<' => Some(Token::Compare(Order::Less)),
        '>' => Some(Token::Compare(Order::More)),
        _ => None,
    };
    if let Some(token) = short {
        return Ok((token, 1));
    }
    let run = |keep: &dyn Fn(usize, char) -> bool| {
        rest.iter().enumerate().take_while(|(i, c)| keep(*i, **c)).count()
    };
    if first.is_alphabetic() || first == '_' {
        let length = run(&|_, c| c.is_alphanumeric() || c == '_' || c == '.');
        return Ok((Token::Operand(Operand::Figure(rest[..length].iter().collect())), length));
    }
    if first.is_ascii_digit() || ".-+".contains(first) {
        let exponent = |i: usize| i > 0 && matches!(rest.get(i - 1), Some('e' | 'E'));
        let length =
            run(&|i, c| c.is_alphanumeric() || c == '.' || (i == 0 || exponent(i)) && (c == '-' || c == '+'));
        let text: String = rest[..length].iter().collect();
        let number = text.parse().ok().filter(|n: &f64| n.is_finite());
        let number = number.ok_or_else(|| format!("\"{text}\" is not a number"))?;
        return Ok((Token::Operand(Operand::Number(number)), length));
    }
    Err(match first {
        '=' => "\"=\" found; == compares".into(),
        '&' => "\"&\" found; && joins".into(),
        '|' => "\"|\" found; || joins".into(),
        other => format!("\"{other}\" has no meaning here"),
    })
}
