//! A pickle machine that builds values and calls nothing.
//!
//! Python's loader calls every function that a pickle names, so a file can run code. Here every name must be in a
//! short list ([`KNOWN`]), otherwise the file is refused. The results of these names (arrays, ordered dictionaries,
//! sets) are built by this module.

use super::array::{Array, Dtype};
use super::value::{Pickle, PickleObject, PickleValue};
use crate::problem::{FieldProblem, ReadError, code};
use crate::refusals::{self, wanted, what};
use scene::message::{Placeholder, Word};
use std::rc::Rc;

/// Newest supported protocol.
const PROTOCOL: u8 = 5;
/// Most values that a file pushes on the stack, most objects, and most memo entries.
const MAX_VALUES: usize = 1_000_000;
const MAX_OBJECTS: usize = 250_000;
const MAX_MEMO: usize = 500_000;
/// Greatest number of open marks.
const MAX_DEPTH: usize = 64;
/// Longest line of the older protocols, and longest name.
const MAX_LINE: usize = 1 << 20;

/// Meaning of a global name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Known {
    /// Creates an array that a later instruction fills.
    Reconstruct,
    /// Creates an array from a shape, a type and bytes.
    Ndarray,
    /// Copies an array.
    Copy,
    /// An array type.
    Dtype,
    /// A number with an array type.
    Scalar,
    /// Creates an array from bytes, a type and a shape.
    FromBuffer,
    Dict,
    /// A dictionary whose first argument is the default factory.
    DefaultDict,
    List,
    /// A type that serves only as the factory of a dictionary and creates nothing.
    Factory,
    /// Bytes from a text with code points below 256.
    Encode,
}

/// All names that a pickle may have.
const KNOWN: &[(&str, &str, Known)] = &[
    ("numpy.core.multiarray", "_reconstruct", Known::Reconstruct),
    ("numpy._core.multiarray", "_reconstruct", Known::Reconstruct),
    ("numpy.multiarray", "_reconstruct", Known::Reconstruct),
    ("numpy.core.multiarray", "scalar", Known::Scalar),
    ("numpy._core.multiarray", "scalar", Known::Scalar),
    ("numpy.multiarray", "scalar", Known::Scalar),
    ("numpy.core.numeric", "_frombuffer", Known::FromBuffer),
    ("numpy._core.numeric", "_frombuffer", Known::FromBuffer),
    ("numpy.numeric", "_frombuffer", Known::FromBuffer),
    ("numpy", "ndarray", Known::Ndarray),
    ("numpy", "array", Known::Copy),
    ("numpy", "dtype", Known::Dtype),
    ("collections", "OrderedDict", Known::Dict),
    ("collections", "defaultdict", Known::DefaultDict),
    ("builtins", "dict", Known::Dict),
    ("builtins", "list", Known::List),
    ("builtins", "set", Known::List),
    ("__builtin__", "dict", Known::Dict),
    ("__builtin__", "list", Known::List),
    ("__builtin__", "set", Known::List),
    ("builtins", "frozenset", Known::List),
    ("builtins", "tuple", Known::Factory),
    ("builtins", "int", Known::Factory),
    ("builtins", "float", Known::Factory),
    ("builtins", "bool", Known::Factory),
    ("builtins", "str", Known::Factory),
    ("__builtin__", "frozenset", Known::List),
    ("__builtin__", "tuple", Known::Factory),
    ("__builtin__", "int", Known::Factory),
    ("__builtin__", "float", Known::Factory),
    ("__builtin__", "bool", Known::Factory),
    ("__builtin__", "str", Known::Factory),
    ("__builtin__", "long", Known::Factory),
    ("__builtin__", "unicode", Known::Factory),
    ("metadrive.scenario.scenario_description", "ScenarioDescription", Known::Dict),
    ("_codecs", "encode", Known::Encode),
];

/// Reads a pickle.
///
/// # Errors
/// `malformed-file` with the offset of the fault; `pickle-refused` for an unknown name, or for an object that only
/// running code could create; `decoded-too-large`.
pub(super) fn read(bytes: &[u8]) -> Result<Pickle, ReadError> {
    let mut machine = Machine {
        bytes,
        at: 0,
        op: 0,
        stack: Vec::new(),
        marks: Vec::new(),
        memo: Vec::new(),
        objects: Vec::new(),
        pushed: 0,
        made: 0,
    };
    let root = machine.run()?;
    Ok(Pickle { objects: machine.objects, root })
}

struct Machine<'a> {
    bytes: &'a [u8],
    at: usize,
    /// Offset of the current instruction.
    op: usize,
    stack: Vec<PickleValue>,
    marks: Vec<usize>,
    memo: Vec<Option<PickleValue>>,
    objects: Vec<PickleObject>,
    pushed: usize,
    /// Bytes that were built from texts.
    made: usize,
}

type Done<T> = Result<T, ReadError>;

impl<'a> Machine<'a> {
    fn broken(&self, wanted: Word) -> ReadError {
        ReadError::malformed(self.op as u64, refusals::expected(wanted))
    }

    fn cut_off(&self) -> ReadError {
        ReadError::malformed(self.op as u64, refusals::file_ends_inside(what::INSTRUCTION))
    }

    fn refused(&self, found: impl Placeholder) -> ReadError {
        let message = refusals::pickle_holds(self.op, found);
        FieldProblem::new("", code::PICKLE_REFUSED, message).into()
    }

    fn too_many(&self, most: usize, what: Word) -> ReadError {
        ReadError::too_large(code::DECODED_TOO_LARGE, most as u64, refusals::more_than(most, what))
    }

    fn take(&mut self, count: usize) -> Done<&'a [u8]> {
        let end = self.at.checked_add(count).filter(|end| *end <= self.bytes.len());
        let taken = end.and_then(|end| self.bytes.get(self.at..end));
        let Some(taken) = taken else { return Err(self.cut_off()) };
        self.at += count;
        Ok(taken)
    }

    /// A little-endian number of this many bytes.
    fn number(&mut self, size: usize) -> Done<u64> {
        let bytes = self.take(size)?;
        Ok(bytes.iter().rev().fold(0, |number, byte| number << 8 | u64::from(*byte)))
    }

    fn length(&mut self, size: usize) -> Done<usize> {
        let length = self.number(size)?;
        usize::try_from(length).map_err(|_| self.cut_off())
    }

    fn line(&mut self) -> Done<String> {
        let rest = self.bytes.get(self.at..).unwrap_or_default();
        let end = rest.iter().take(MAX_LINE).position(|byte| *byte == b'\n');
        let Some(end) = end else { return Err(self.cut_off()) };
        let line = self.take(end + 1)?;
        let line = line.get(..end).unwrap_or_default();
        // The older protocols have characters of one byte (Latin-1).
        Ok(line.iter().map(|byte| char::from(*byte)).collect())
    }

    fn push(&mut self, value: PickleValue) -> Done<()> {
        self.pushed += 1;
        if self.pushed > MAX_VALUES {
            return Err(self.too_many(MAX_VALUES, what::VALUES));
        }
        self.stack.push(value);
        Ok(())
    }

    fn push_object(&mut self, object: PickleObject) -> Done<()> {
        if self.objects.len() >= MAX_OBJECTS {
            return Err(self.too_many(MAX_OBJECTS, what::MEMORY));
        }
        self.objects.push(object);
        self.push(PickleValue::Object(self.objects.len() - 1))
    }

    fn push_text(&mut self, length: usize) -> Done<()> {
        let bytes = self.take(length)?;
        let text = std::str::from_utf8(bytes).map(Rc::from);
        let text = text.map_err(|_| ReadError::malformed(self.op as u64, refusals::not_utf8(what::TEXT)))?;
        self.push(PickleValue::Text(text))
    }

    fn push_bytes(&mut self, length: usize) -> Done<()> {
        let bytes = Rc::from(self.take(length)?);
        self.push(PickleValue::Bytes(bytes))
    }

    /// A string of Python 2, which is either text or bytes.
    fn push_old_text(&mut self, length: usize) -> Done<()> {
        let bytes = self.take(length)?;
        let value = match std::str::from_utf8(bytes) {
            Ok(text) if text.is_ascii() => PickleValue::Text(Rc::from(text)),
            _ => PickleValue::Bytes(Rc::from(bytes)),
        };
        self.push(value)
    }

    fn pop(&mut self) -> Done<PickleValue> {
        let floor = self.marks.last().copied().unwrap_or(0);
        let value = if self.stack.len() > floor { self.stack.pop() } else { None };
        value.ok_or_else(|| self.broken(wanted::ITEM))
    }

    fn mark(&mut self) -> Done<()> {
        if self.marks.len() >= MAX_DEPTH {
            return Err(ReadError::malformed(self.op as u64, refusals::nested_deeper(MAX_DEPTH)));
        }
        self.marks.push(self.stack.len());
        Ok(())
    }

    /// Pops the stack down to the last mark.
    fn since_mark(&mut self) -> Done<Vec<PickleValue>> {
        let mark = self.marks.pop().ok_or_else(|| self.broken(wanted::MARK))?;
        Ok(self.stack.split_off(mark.min(self.stack.len())))
    }

    fn remember(&mut self, place: usize) -> Done<()> {
        let value = self.stack.last().cloned().ok_or_else(|| self.broken(wanted::ITEM))?;
        if place >= MAX_MEMO {
            return Err(self.too_many(MAX_MEMO, what::REMEMBERED));
        }
        // Memo indices are consecutive; a large one must not allocate all before it.
        if place > self.memo.len() + 1024 {
            return Err(self.broken(wanted::MEMORY));
        }
        if place >= self.memo.len() {
            self.memo.resize(place + 1, None);
        }
        if let Some(slot) = self.memo.get_mut(place) {
            *slot = Some(value);
        }
        Ok(())
    }

    fn recall(&mut self, place: usize) -> Done<()> {
        let value = self.memo.get(place).cloned().flatten();
        let value = value.ok_or_else(|| self.broken(wanted::MEMORY))?;
        self.push(value)
    }

    fn place(&mut self) -> Done<usize> {
        self.line()?.parse().map_err(|_| self.broken(wanted::MEMORY))
    }

    fn global(&mut self, module: &str, name: &str) -> Done<()> {
        match KNOWN.iter().position(|(m, n, _)| *m == module && *n == name) {
            Some(known) => self.push(PickleValue::Known(known)),
            None => {
                let shown =
                    |text: &str| text.chars().filter(|c| !c.is_control()).take(80).collect::<String>();
                let (module, name) = (shown(module), shown(name));
                let message = refusals::pickle_calls(self.op, &format!("{module}.{name}"));
                Err(FieldProblem::new("", code::PICKLE_REFUSED, message).into())
            }
        }
    }

    fn run(&mut self) -> Done<PickleValue> {
        loop {
            self.op = self.at;
            let op = self.take(1)?.first().copied().unwrap_or_default();
            match op {
                b'.' => return self.pop(),
                0x80 => {
                    let protocol = self.number(1)?;
                    if protocol > u64::from(PROTOCOL) {
                        return Err(ReadError::malformed(
                            self.op as u64,
                            refusals::unsupported_version(protocol, u64::from(PROTOCOL)),
                        ));
                    }
                }
                0x95 => {
                    self.take(8)?;
                }
                b'(' => self.mark()?,
                b'0' => match self.marks.last() {
                    Some(mark) if *mark == self.stack.len() => {
                        self.marks.pop();
                    }
                    _ => drop(self.pop()?),
                },
                b'1' => drop(self.since_mark()?),
                b'2' => {
                    let top = self.pop()?;
                    self.stack.push(top.clone());
                    self.push(top)?;
                }
                _ => self.make(op)?,
            }
        }
    }

    /// Instructions that push a new value.
    fn make(&mut self, op: u8) -> Done<()> {
        match op {
            b'N' => self.push(PickleValue::None),
            0x88 => self.push(PickleValue::Bool(true)),
            0x89 => self.push(PickleValue::Bool(false)),
            b'K' => self.number(1).and_then(|v| self.push(PickleValue::Int(v as i64))),
            b'M' => self.number(2).and_then(|v| self.push(PickleValue::Int(v as i64))),
            b'J' => self.number(4).and_then(|v| self.push(PickleValue::Int(i64::from(v as u32 as i32)))),
            b'G' => {
                let eight = self.take(8)?.try_into().unwrap_or_default();
                self.push(PickleValue::Float(f64::from_be_bytes(eight)))
            }
            0x8a => self.length(1).and_then(|length| self.long(length)),
            0x8b => self.length(4).and_then(|length| self.long(length)),
            b'I' | b'L' | b'F' => self.number_line(op),
            b'X' => self.length(4).and_then(|length| self.push_text(length)),
            0x8c => self.length(1).and_then(|length| self.push_text(length)),
            0x8d => self.length(8).and_then(|length| self.push_text(length)),
            b'V' | b'S' => self.text_line(op),
            b'B' => self.length(4).and_then(|length| self.push_bytes(length)),
            b'C' => self.length(1).and_then(|length| self.push_bytes(length)),
            b'T' => self.length(4).and_then(|length| self.push_old_text(length)),
            b'U' => self.length(1).and_then(|length| self.push_old_text(length)),
            0x8e | 0x96 => self.length(8).and_then(|length| self.push_bytes(length)),
            b']' | 0x8f => self.push_object(PickleObject::List(Vec::new())),
            b'}' => self.push_object(PickleObject::Dict(Vec::new())),
            b')' => self.push(PickleValue::Tuple(Rc::from([]))),
            b'l' | 0x91 => self.since_mark().and_then(|items| self.push_object(PickleObject::List(items))),
            b'd' => {
                let entries = self.since_mark().and_then(|items| self.paired(items))?;
                self.push_object(PickleObject::Dict(entries))
            }
            b't' => self.since_mark().and_then(|items| self.push(PickleValue::Tuple(items.into()))),
            0x85..=0x87 => {
                let mut items = Vec::new();
                for _ in 0..=op - 0x85 {
                    items.push(self.pop()?);
                }
                items.reverse();
                self.push(PickleValue::Tuple(items.into()))
            }
            b'q' => self.length(1).and_then(|place| self.remember(place)),
            b'r' => self.length(4).and_then(|place| self.remember(place)),
            b'p' => self.place().and_then(|place| self.remember(place)),
            0x94 => self.remember(self.memo.len()),
            b'h' => self.length(1).and_then(|place| self.recall(place)),
            b'j' => self.length(4).and_then(|place| self.recall(place)),
            b'g' => self.place().and_then(|place| self.recall(place)),
            _ => self.change(op),
        }
    }

    /// Instructions that change values on the stack.
    fn change(&mut self, op: u8) -> Done<()> {
        match op {
            b'a' => {
                let item = self.pop()?;
                self.extend(vec![item])
            }
            b'e' | 0x90 => {
                let items = self.since_mark()?;
                self.extend(items)
            }
            b's' => {
                let (value, key) = (self.pop()?, self.pop()?);
                self.set(vec![(key, value)])
            }
            b'u' => {
                let entries = self.since_mark().and_then(|items| self.paired(items))?;
                self.set(entries)
            }
            b'c' => {
                let (module, name) = (self.line()?, self.line()?);
                self.global(&module, &name)
            }
            0x93 => match (self.pop()?, self.pop()?) {
                (PickleValue::Text(name), PickleValue::Text(module)) => self.global(&module, &name),
                _ => Err(self.broken(wanted::TEXT)),
            },
            b'R' => {
                let (arguments, callee) = (self.pop()?, self.pop()?);
                self.reduce(&callee, &arguments)
            }
            0x81 => {
                let (_, class) = (self.pop()?, self.pop()?);
                self.reduce(&class, &PickleValue::Tuple(Rc::from([])))
            }
            b'b' => {
                let state = self.pop()?;
                self.build(&state)
            }
            b'P' | b'Q' => Err(self.refused(what::OUTER_REFERENCE)),
            b'i' | b'o' | 0x92 => Err(self.refused(what::CLASS_OBJECT)),
            0x82..=0x84 => Err(self.refused(what::REGISTERED_NAME)),
            0x97 | 0x98 => Err(self.refused(what::OUTER_BYTES)),
            _ => Err(self.broken(wanted::INSTRUCTION)),
        }
    }

    fn long(&mut self, length: usize) -> Done<()> {
        let bytes = self.take(length)?;
        let negative = bytes.last().is_some_and(|byte| byte & 0x80 != 0);
        let mut eight = if negative { [0xff; 8] } else { [0; 8] };
        if bytes.len() > 8 {
            return Err(self.broken(wanted::NUMBER_8));
        }
        eight.iter_mut().zip(bytes).for_each(|(to, from)| *to = *from);
        self.push(PickleValue::Int(i64::from_le_bytes(eight)))
    }

    fn number_line(&mut self, op: u8) -> Done<()> {
        let line = self.line()?;
        let text = line.trim().trim_end_matches('L');
        let value = match (op, text) {
            (b'I', "00") => Some(PickleValue::Bool(false)),
            (b'I', "01") => Some(PickleValue::Bool(true)),
            (b'F', _) => text.parse().ok().map(PickleValue::Float),
            _ => text.parse().ok().map(PickleValue::Int),
        };
        let value = value.ok_or_else(|| self.broken(wanted::NUMBER))?;
        self.push(value)
    }

    /// A text on one line, plain or in quotes. Only the Unicode escapes of plain text are decoded.
    fn text_line(&mut self, op: u8) -> Done<()> {
        let line = self.line()?;
        if op == b'S' {
            let quoted = line.trim();
            let inner = ['\'', '"'].iter().find_map(|q| quoted.strip_prefix(*q)?.strip_suffix(*q));
            let inner = inner.ok_or_else(|| self.broken(wanted::QUOTES))?;
            return self.push(PickleValue::Text(Rc::from(inner)));
        }
        let mut text = String::with_capacity(line.len());
        let mut rest = line.as_str();
        while let Some((before, after)) = rest.split_once("\\u") {
            text.push_str(before);
            let letter =
                after.get(..4).and_then(|hex| u32::from_str_radix(hex, 16).ok()).and_then(char::from_u32);
            text.push(letter.ok_or_else(|| self.broken(wanted::LETTER))?);
            rest = after.get(4..).unwrap_or_default();
        }
        text.push_str(rest);
        self.push(PickleValue::Text(text.into()))
    }

    fn paired(&self, items: Vec<PickleValue>) -> Done<Vec<(PickleValue, PickleValue)>> {
        if !items.len().is_multiple_of(2) {
            return Err(self.broken(wanted::KEY_VALUES));
        }
        let mut entries = Vec::with_capacity(items.len() / 2);
        let mut items = items.into_iter();
        while let (Some(key), Some(value)) = (items.next(), items.next()) {
            entries.push((key, value));
        }
        Ok(entries)
    }

    /// The object on top of the stack.
    fn top(&mut self) -> Option<&mut PickleObject> {
        match self.stack.last() {
            Some(PickleValue::Object(at)) => self.objects.get_mut(*at),
            _ => None,
        }
    }

    fn extend(&mut self, items: Vec<PickleValue>) -> Done<()> {
        match self.top() {
            Some(PickleObject::List(list)) => list.extend(items),
            _ => return Err(self.broken(wanted::LIST)),
        }
        Ok(())
    }

    fn set(&mut self, entries: Vec<(PickleValue, PickleValue)>) -> Done<()> {
        match self.top() {
            Some(PickleObject::Dict(dict)) => dict.extend(entries),
            _ => return Err(self.broken(wanted::DICTIONARY)),
        }
        Ok(())
    }

    /// Applies a known name to its arguments.
    fn reduce(&mut self, callee: &PickleValue, arguments: &PickleValue) -> Done<()> {
        let known = match callee {
            PickleValue::Known(at) => KNOWN.get(*at).map(|(.., known)| *known),
            _ => None,
        };
        let Some(known) = known else { return Err(self.refused(what::CALL)) };
        let PickleValue::Tuple(arguments) = arguments else {
            return Err(self.broken(wanted::TUPLE));
        };
        let arguments = Rc::clone(arguments);
        match (known, &*arguments) {
            (Known::Reconstruct, _) => self.push_object(PickleObject::Array(Array::empty())),
            (Known::Dtype, [word, ..]) => {
                let dtype = self.dtype(word)?;
                self.push_object(PickleObject::Dtype(dtype))
            }
            (Known::Ndarray, [shape, dtype, data]) => self.array(shape, dtype, data, false),
            (Known::FromBuffer, [data, dtype, shape, order]) => {
                let fortran = matches!(order, PickleValue::Text(order) if &**order == "F");
                self.array(shape, dtype, data, fortran)
            }
            (Known::Copy, [array, ..]) => self.push(array.clone()),
            (Known::Scalar, [dtype, data]) => {
                self.array(&PickleValue::Tuple(Rc::from([])), dtype, data, false)?;
                match self.pop()? {
                    PickleValue::Object(at) => {
                        let number = match self.objects.get(at) {
                            Some(PickleObject::Array(array)) => array.number(0).map(PickleValue::Float),
                            _ => None,
                        };
                        self.push(number.unwrap_or(PickleValue::None))
                    }
                    _ => Ok(()),
                }
            }
            (Known::Dict, []) | (Known::DefaultDict, []) | (Known::DefaultDict, [_]) => {
                self.push_object(PickleObject::Dict(Vec::new()))
            }
            (Known::Dict, [from]) => self.dict_of(from),
            (Known::List, []) => self.push_object(PickleObject::List(Vec::new())),
            (Known::List, [from]) => {
                let items = self.items(from)?;
                self.push_object(PickleObject::List(items))
            }
            (Known::Encode, [PickleValue::Text(text), ..]) => {
                self.make_bytes(text.len())?;
                let bytes: Option<Vec<u8>> = text.chars().map(|c| u8::try_from(u32::from(c)).ok()).collect();
                let bytes = bytes.ok_or_else(|| self.broken(wanted::BYTES))?;
                self.push(PickleValue::Bytes(bytes.into()))
            }
            _ => Err(self.broken(wanted::ARGUMENTS)),
        }
    }

    /// Counts bytes that are built from a text; more than the file has are refused.
    fn make_bytes(&mut self, count: usize) -> Done<()> {
        self.made += count;
        if self.made > self.bytes.len() {
            return Err(ReadError::malformed(
                self.op as u64,
                refusals::more_than(self.bytes.len(), what::BYTES),
            ));
        }
        Ok(())
    }

    /// A copy of the items of a list or tuple, counted as values.
    fn items(&mut self, from: &PickleValue) -> Done<Vec<PickleValue>> {
        let items = match from {
            PickleValue::Tuple(items) => items.to_vec(),
            PickleValue::Object(at) => match self.objects.get(*at) {
                Some(PickleObject::List(items)) => items.clone(),
                _ => return Err(self.broken(wanted::LIST)),
            },
            _ => return Err(self.broken(wanted::LIST)),
        };
        self.pushed += items.len();
        if self.pushed > MAX_VALUES {
            return Err(self.too_many(MAX_VALUES, what::VALUES));
        }
        Ok(items)
    }

    fn dict_of(&mut self, from: &PickleValue) -> Done<()> {
        let mut entries = Vec::new();
        for pair in self.items(from)? {
            match self.items(&pair)?.as_slice() {
                [key, value] => entries.push((key.clone(), value.clone())),
                _ => return Err(self.broken(wanted::PAIR)),
            }
        }
        self.push_object(PickleObject::Dict(entries))
    }

    fn dtype(&self, value: &PickleValue) -> Done<Dtype> {
        let found = match value {
            PickleValue::Text(word) => Dtype::of(word),
            PickleValue::Object(at) => match self.objects.get(*at) {
                Some(PickleObject::Dtype(dtype)) => Some(*dtype),
                _ => None,
            },
            _ => None,
        };
        found.ok_or_else(|| match value {
            PickleValue::Text(word) => {
                let word: String = word.chars().take(20).collect();
                self.refused(format!("array({word})"))
            }
            _ => self.broken(wanted::ARRAY_TYPE),
        })
    }

    fn shape(&self, value: &PickleValue) -> Done<Vec<usize>> {
        let side = |value: &PickleValue| match value {
            PickleValue::Int(n) => usize::try_from(*n).ok(),
            _ => None,
        };
        let sides = match value {
            PickleValue::Tuple(items) if items.len() <= 8 => items.iter().map(side).collect(),
            value => side(value).map(|n| vec![n]),
        };
        sides.ok_or_else(|| self.broken(wanted::ARRAY_SHAPE))
    }

    fn array(
        &mut self,
        shape: &PickleValue,
        dtype: &PickleValue,
        data: &PickleValue,
        fortran: bool,
    ) -> Done<()> {
        let (shape, dtype) = (self.shape(shape)?, self.dtype(dtype)?);
        let data = match data {
            PickleValue::Bytes(data) => Rc::clone(data),
            PickleValue::Text(text) => {
                self.make_bytes(text.len())?;
                Rc::from(text.as_bytes())
            }
            _ => return Err(self.broken(wanted::BYTES)),
        };
        let array = Array { shape, dtype: Some(dtype), fortran, data };
        if !array.is_whole() {
            return Err(self.broken(wanted::ARRAY_BYTES));
        }
        self.push_object(PickleObject::Array(array))
    }

    /// Fills an object that was created empty.
    fn build(&mut self, state: &PickleValue) -> Done<()> {
        let Some(PickleValue::Object(at)) = self.stack.last().cloned() else {
            return Err(self.refused(what::STATE));
        };
        let filled = match (self.objects.get(at), state) {
            (Some(PickleObject::Array(_)), PickleValue::Tuple(state)) => match &**state {
                [_, shape, dtype, fortran, data] | [shape, dtype, fortran, data] => {
                    let fortran = matches!(fortran, PickleValue::Bool(true) | PickleValue::Int(1));
                    self.array(shape, dtype, data, fortran)?;
                    match self.pop()? {
                        PickleValue::Object(made) => self.objects.get(made).cloned(),
                        _ => None,
                    }
                }
                _ => return Err(self.broken(wanted::ARRAY_STATE)),
            },
            (Some(PickleObject::Dtype(dtype)), PickleValue::Tuple(state)) => {
                let order = state.get(1);
                let big = matches!(order, Some(PickleValue::Text(order)) if &**order == ">");
                Some(PickleObject::Dtype(Dtype { big, ..*dtype }))
            }
            // Attributes of a dictionary object are ignored.
            (Some(PickleObject::Dict(_)), _) => None,
            _ => return Err(self.refused(what::STATE)),
        };
        if let (Some(filled), Some(slot)) = (filled, self.objects.get_mut(at)) {
            *slot = filled;
        }
        Ok(())
    }
}
