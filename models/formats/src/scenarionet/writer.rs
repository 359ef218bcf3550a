//! Writer of pickles: protocol 3, only values and arrays of numbers.

/// A pickle that is being written.
pub(super) struct PickleWriter(Vec<u8>);

impl PickleWriter {
    pub fn new() -> Self {
        Self(vec![0x80, 3])
    }

    /// The complete pickle of the written value.
    pub fn finish(mut self) -> Vec<u8> {
        self.0.push(b'.');
        self.0
    }

    fn sized(&mut self, op: u8, bytes: &[u8]) {
        self.0.push(op);
        self.0.extend(u32::try_from(bytes.len()).unwrap_or(u32::MAX).to_le_bytes());
        self.0.extend(bytes);
    }

    pub fn text(&mut self, text: &str) {
        self.sized(b'X', text.as_bytes());
    }

    pub fn bool(&mut self, value: bool) {
        self.0.push(if value { 0x88 } else { 0x89 });
    }

    pub fn int(&mut self, value: usize) {
        self.0.extend([0x8a, 8]);
        self.0.extend((value as u64).to_le_bytes());
    }

    pub fn float(&mut self, value: f64) {
        self.0.push(b'G');
        self.0.extend(value.to_be_bytes());
    }

    /// Writes a dictionary; `fill` writes its entries with [`PickleWriter::entry`].
    pub fn dict(&mut self, fill: impl FnOnce(&mut Self)) {
        self.0.extend(b"}(");
        fill(self);
        self.0.push(b'u');
    }

    /// Writes an entry of a dictionary; `write` writes its value.
    pub fn entry(&mut self, key: &str, write: impl FnOnce(&mut Self)) {
        self.text(key);
        write(self);
    }

    /// Writes a list; `write` writes each item.
    pub fn list<T>(&mut self, items: impl IntoIterator<Item = T>, mut write: impl FnMut(&mut Self, T)) {
        self.0.extend(b"](");
        items.into_iter().for_each(|item| write(self, item));
        self.0.push(b'e');
    }

    /// A writable array: a copy of an array over the bytes, since an array over `bytes` is read-only. All
    /// versions of NumPy have both functions.
    fn array(&mut self, dtype: &str, shape: &[usize], bytes: &[u8]) {
        self.0.extend(b"cnumpy\narray\ncnumpy\nndarray\n(");
        shape.iter().for_each(|n| self.int(*n));
        self.0.push(b't');
        self.text(dtype);
        self.sized(b'B', bytes);
        self.0.extend([0x87, b'R', 0x85, b'R']);
    }

    /// Rows of numbers in single precision; one-dimensional if a row has one number.
    pub fn floats(&mut self, across: usize, numbers: &[f64]) {
        let bytes: Vec<u8> = numbers.iter().flat_map(|v| (*v as f32).to_le_bytes()).collect();
        let rows = numbers.len() / across.max(1);
        let shape = if across == 1 { vec![rows] } else { vec![rows, across] };
        self.array("<f4", &shape, &bytes);
    }

    /// An array of booleans.
    pub fn bools(&mut self, values: &[bool]) {
        let bytes: Vec<u8> = values.iter().map(|v| u8::from(*v)).collect();
        self.array("|b1", &[values.len()], &bytes);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenarionet::machine;

    #[test]
    fn what_is_written_is_read() {
        let mut writer = PickleWriter::new();
        writer.dict(|w| {
            w.entry("a", |w| w.floats(2, &[1.0, 2.0, 3.0, -4.5]));
            w.entry("b", |w| w.list(["x", "y"], PickleWriter::text));
            w.entry("c", |w| w.bools(&[true, false]));
            w.entry("d", |w| w.int(70_000));
            w.entry("e", |w| w.float(-0.25));
            w.entry("f", |w| w.bool(true));
        });
        let bytes = writer.finish();
        let pickle = machine::read(&bytes).unwrap();
        let get = |key: &str| pickle.get(&pickle.root, key).unwrap();
        assert_eq!(pickle.rows(get("a"), 9), Some((2, vec![1.0, 2.0, 3.0, -4.5])));
        assert_eq!(
            pickle.items(get("b")).unwrap().iter().filter_map(|v| pickle.text(v)).collect::<Vec<_>>(),
            ["x", "y"]
        );
        assert_eq!(pickle.rows(get("c"), 9), Some((1, vec![1.0, 0.0])));
        assert_eq!(
            (pickle.whole(get("d")), pickle.number(get("e")), pickle.number(get("f"))),
            (Some(70_000), Some(-0.25), Some(1.0))
        );
    }
}
