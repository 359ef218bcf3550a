//! Compares two answers.

use serde_json::Value;
use std::fmt;

/// Numbers that differ by less are equal: metres, m/s, radians, shares.
const TOLERANCE: f64 = 1e-4;
/// Limit of printed differences.
const SHOWN: usize = 12;

/// Differences between two answers.
#[derive(Default)]
pub struct Differences {
    /// JSON pointer, before, after.
    found: Vec<(String, String, String)>,
    largest: f64,
}

impl Differences {
    /// All differences between `before` and `after`.
    pub fn between(before: &Value, after: &Value) -> Self {
        let mut out = Self::default();
        out.compare("", before, after);
        out
    }

    /// Whether nothing differs by more than the tolerance.
    pub fn is_empty(&self) -> bool {
        self.found.is_empty()
    }

    /// The largest change of a number.
    pub fn largest(&self) -> f64 {
        self.largest
    }

    fn compare(&mut self, at: &str, before: &Value, after: &Value) {
        match (before, after) {
            (Value::Number(a), Value::Number(b)) => {
                let change = (a.as_f64().unwrap_or(f64::NAN) - b.as_f64().unwrap_or(f64::NAN)).abs();
                self.largest = self.largest.max(change);
                // A NaN is a difference.
                if !matches!(change.partial_cmp(&TOLERANCE), Some(std::cmp::Ordering::Less)) {
                    self.found.push((at.into(), a.to_string(), b.to_string()));
                }
            }
            (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
                for (i, (a, b)) in a.iter().zip(b).enumerate() {
                    self.compare(&format!("{at}/{i}"), a, b);
                }
            }
            (Value::Object(a), Value::Object(b)) if a.keys().eq(b.keys()) => {
                for (name, value) in a {
                    self.compare(&format!("{at}/{name}"), value, &b[name]);
                }
            }
            _ if before == after => {}
            _ => self.found.push((at.into(), short(before), short(after))),
        }
    }
}

impl fmt::Display for Differences {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (at, before, after) in self.found.iter().take(SHOWN) {
            writeln!(f, "  {at}: {before} -> {after}")?;
        }
        let more = self.found.len().saturating_sub(SHOWN);
        write!(f, "  {more} more; largest change of a number {:.6}", self.largest)
    }
}

/// A value on one line: the value itself if it is small, otherwise a summary of its content.
fn short(value: &Value) -> String {
    match value {
        Value::Array(list) => format!("a list of {}", list.len()),
        Value::Object(members) => {
            format!("members {}", members.keys().cloned().collect::<Vec<_>>().join(", "))
        }
        small => small.to_string(),
    }
}

/// The stored form: one line per state, so that changes are readable.
pub fn text(value: &Value) -> String {
    let mut out = String::new();
    write(&mut out, value, 0);
    out
}

fn write(out: &mut String, value: &Value, depth: usize) {
    let flat = |v: &Value| match v {
        Value::Array(list) => list.iter().all(|v| !v.is_array() && !v.is_object()),
        Value::Object(_) => false,
        _ => true,
    };
    let open = |out: &mut String| {
        out.push('\n');
        out.extend(std::iter::repeat_n(' ', depth + 1));
    };
    match value {
        Value::Array(list) if !flat(value) => {
            out.push('[');
            for (i, item) in list.iter().enumerate() {
                if i > 0 {
                    out.push(',');
                }
                open(out);
                write(out, item, depth + 1);
            }
            out.push(']');
        }
        Value::Object(members) => {
            out.push('{');
            for (i, (name, item)) in members.iter().enumerate() {
                if i > 0 {
                    out.push(',');
                }
                open(out);
                out.push_str(&format!("{}: ", Value::String(name.clone())));
                write(out, item, depth + 1);
            }
            out.push('}');
        }
        _ => out.push_str(&value.to_string()),
    }
}

#[test]
fn differences_say_where() {
    use serde_json::json;
    let before = json!({"a": [1.0, 2.0], "b": "x"});
    assert!(Differences::between(&before, &json!({"a": [1.0, 2.00005], "b": "x"})).is_empty());
    let moved = Differences::between(&before, &json!({"a": [1.0, 2.001], "b": "x"}));
    assert!(moved.to_string().contains("/a/1: 2.0 -> 2.001"), "{moved}");
    for other in [json!({"a": [1.0], "b": "x"}), json!({"a": [1.0, 2.0]}), json!({"a": [1.0, 2.0], "b": "y"})]
    {
        assert!(!Differences::between(&before, &other).is_empty(), "{other}");
    }
    assert_eq!(serde_json::from_str::<Value>(&text(&before)).ok(), Some(before));
}
