//! Little-endian encoding of numbers.

/// Bytes being written.
#[derive(Default)]
pub(super) struct Sink(Vec<u8>);

impl Sink {
    pub(super) fn as_slice(&self) -> &[u8] {
        &self.0
    }

    pub(super) fn bytes(&mut self, bytes: &[u8]) {
        self.0.extend_from_slice(bytes);
    }

    /// A count, as `u32`.
    pub(super) fn count(&mut self, count: usize) {
        self.bytes(&(count as u32).to_le_bytes());
    }

    pub(super) fn u64(&mut self, value: u64) {
        self.bytes(&value.to_le_bytes());
    }

    pub(super) fn floats(&mut self, values: &[f32]) {
        for value in values {
            self.bytes(&value.to_le_bytes());
        }
    }
}

/// Bytes being read.
pub(super) struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Cursor<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0 }
    }

    pub(super) fn position(&self) -> usize {
        self.at
    }

    pub(super) fn take(&mut self, count: usize) -> Result<&'a [u8], String> {
        let end = self.at.checked_add(count).filter(|&end| end <= self.bytes.len());
        let end = end.ok_or_else(|| format!("ends early: {count} bytes wanted at byte {}", self.at))?;
        let taken = &self.bytes[self.at..end];
        self.at = end;
        Ok(taken)
    }

    /// A count of at most `most`.
    pub(super) fn count(&mut self, most: usize) -> Result<usize, String> {
        let bytes = self.take(4)?;
        let count = u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]) as usize;
        if count > most {
            return Err(format!("a count of {count} at byte {}; at most {most} fit", self.at - 4));
        }
        Ok(count)
    }

    pub(super) fn u64(&mut self) -> Result<u64, String> {
        let mut value = [0; 8];
        value.copy_from_slice(self.take(8)?);
        Ok(u64::from_le_bytes(value))
    }

    pub(super) fn fill(&mut self, values: &mut [f32]) -> Result<(), String> {
        let bytes = self.take(values.len() * 4)?;
        for (value, four) in values.iter_mut().zip(bytes.chunks_exact(4)) {
            *value = f32::from_le_bytes([four[0], four[1], four[2], four[3]]);
        }
        Ok(())
    }

    pub(super) fn array<const N: usize>(&mut self) -> Result<[f32; N], String> {
        let mut values = [0.0; N];
        self.fill(&mut values)?;
        Ok(values)
    }

    pub(super) fn float(&mut self) -> Result<f32, String> {
        Ok(self.array::<1>()?[0])
    }

    /// Checks that nothing is left.
    pub(super) fn end(&self) -> Result<(), String> {
        match self.bytes.len() - self.at {
            0 => Ok(()),
            left => Err(format!("{left} bytes are left over")),
        }
    }
}
