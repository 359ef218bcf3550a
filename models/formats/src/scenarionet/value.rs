//! Content of a pickle as data that is never called.

use super::array::Array;
use std::rc::Rc;

/// Most entries of a dictionary in which keys are looked up.
const LOOKED_UP: usize = 256;

/// A value. Lists and dictionaries are in the [`Pickle`], since several values may refer to the same one.
#[derive(Clone, Debug)]
pub(super) enum PickleValue {
    None,
    Bool(bool),
    Int(i64),
    Float(f64),
    Text(Rc<str>),
    Bytes(Rc<[u8]>),
    Tuple(Rc<[PickleValue]>),
    /// A list, set, dictionary, array or array type: its index in [`Pickle::objects`].
    Object(usize),
    /// A known global name: its index in the list of known names.
    Known(usize),
}

/// Objects that can change while a pickle is read.
#[derive(Clone, Debug)]
pub(super) enum PickleObject {
    List(Vec<PickleValue>),
    Dict(Vec<(PickleValue, PickleValue)>),
    Array(Array),
    Dtype(super::array::Dtype),
}

/// The content of a pickle.
#[derive(Debug)]
pub(super) struct Pickle {
    pub objects: Vec<PickleObject>,
    pub root: PickleValue,
}

impl Pickle {
    fn object(&self, value: &PickleValue) -> Option<&PickleObject> {
        match value {
            PickleValue::Object(at) => self.objects.get(*at),
            _ => None,
        }
    }

    /// Entries of a dictionary.
    pub fn entries(&self, value: &PickleValue) -> Option<&[(PickleValue, PickleValue)]> {
        match self.object(value)? {
            PickleObject::Dict(entries) => Some(entries),
            _ => None,
        }
    }

    /// Value of a key in a dictionary; the last one if the key repeats, as in Python.
    pub fn get(&self, value: &PickleValue, key: &str) -> Option<&PickleValue> {
        let entries = self.entries(value).filter(|entries| entries.len() <= LOOKED_UP)?;
        let named = |(name, _): &&(PickleValue, PickleValue)| matches!(name, PickleValue::Text(text) if &**text == key);
        entries
            .iter()
            .rev()
            .find(named)
            .map(|(_, value)| value)
            .filter(|value| !matches!(value, PickleValue::None))
    }

    /// Items of a list or tuple.
    pub fn items<'a>(&'a self, value: &'a PickleValue) -> Option<&'a [PickleValue]> {
        match value {
            PickleValue::Tuple(items) => Some(items),
            _ => match self.object(value)? {
                PickleObject::List(items) => Some(items),
                _ => None,
            },
        }
    }

    /// An array.
    pub fn array(&self, value: &PickleValue) -> Option<&Array> {
        match self.object(value)? {
            PickleObject::Array(array) => Some(array),
            _ => None,
        }
    }

    /// A number, or the only one of an array.
    pub fn number(&self, value: &PickleValue) -> Option<f64> {
        match value {
            PickleValue::Bool(value) => Some(f64::from(u8::from(*value))),
            PickleValue::Int(value) => Some(*value as f64),
            PickleValue::Float(value) => Some(*value),
            _ => self.array(value).filter(|array| array.len() == 1).and_then(|array| array.number(0)),
        }
    }

    /// A whole number, as a number or as text.
    pub fn whole(&self, value: &PickleValue) -> Option<i64> {
        match value {
            PickleValue::Text(text) => text.parse().ok(),
            _ => self.number(value).filter(|v| v.fract() == 0.0 && v.abs() < 1e15).map(|v| v as i64),
        }
    }

    /// A text, or a whole number as text: ids may be either.
    pub fn text(&self, value: &PickleValue) -> Option<String> {
        match value {
            PickleValue::Text(text) => Some(text.to_string()),
            _ => self.whole(value).map(|number| number.to_string()),
        }
    }

    /// Number of columns (one for a plain list of numbers), and the numbers of a list or an array row by row.
    pub fn rows(&self, value: &PickleValue, most: usize) -> Option<(usize, Vec<f64>)> {
        if let Some(array) = self.array(value) {
            let across = if array.shape.len() > 1 { array.shape.iter().skip(1).product() } else { 1 };
            return Some((across, (0..array.len().min(most)).map_while(|i| array.number(i)).collect()));
        }
        let items = self.items(value)?;
        let across = items.first().and_then(|item| self.rows_of(item)).map_or(1, <[PickleValue]>::len);
        let mut numbers = Vec::new();
        for item in items.iter().take(most / across.max(1)) {
            match (self.rows_of(item), across) {
                (Some(row), _) if row.len() == across => {
                    for value in row {
                        numbers.push(self.number(value)?);
                    }
                }
                (None, 1) => numbers.push(self.number(item)?),
                (None, _) => {
                    let array = self.array(item).filter(|array| array.len() == across)?;
                    numbers.extend((0..across).map_while(|i| array.number(i)));
                }
                _ => return None,
            }
        }
        Some((across, numbers))
    }

    fn rows_of<'a>(&'a self, item: &'a PickleValue) -> Option<&'a [PickleValue]> {
        self.items(item)
    }
}
