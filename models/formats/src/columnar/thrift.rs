//! The compact protocol of Thrift, as far as the headers of Parquet need it: numbers of structs; everything
//! else is skipped.

/// Greatest nesting of structs and lists.
const MAX_DEPTH: usize = 24;

const STRUCT: u8 = 12;

/// A field of a struct.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct ThriftField {
    pub id: i16,
    kind: u8,
}

/// Reads from the beginning of a slice; `None` if the slice is too short or inconsistent.
pub(super) struct ThriftReader<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> ThriftReader<'a> {
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0 }
    }

    /// Bytes that were read.
    pub fn position(&self) -> usize {
        self.at
    }

    fn byte(&mut self) -> Option<u8> {
        let byte = *self.bytes.get(self.at)?;
        self.at += 1;
        Some(byte)
    }

    fn pass(&mut self, count: u64) -> Option<()> {
        let count = usize::try_from(count).ok()?;
        self.at = self.at.checked_add(count).filter(|at| *at <= self.bytes.len())?;
        Some(())
    }

    fn unsigned(&mut self) -> Option<u64> {
        let mut value = 0;
        for shift in (0..64).step_by(7) {
            let byte = self.byte()?;
            value |= u64::from(byte & 0x7f) << shift;
            if byte & 0x80 == 0 {
                return Some(value);
            }
        }
        None
    }

    fn signed(&mut self) -> Option<i64> {
        let value = self.unsigned()?;
        Some((value >> 1) as i64 ^ -((value & 1) as i64))
    }

    /// Calls `take` for each field of the struct that begins here; `take` returns whether it has read the
    /// value, which is skipped otherwise.
    pub fn each(&mut self, mut take: impl FnMut(&mut Self, ThriftField) -> Option<bool>) -> Option<()> {
        self.fields(0, &mut take)
    }

    fn fields(
        &mut self,
        depth: usize,
        take: &mut dyn FnMut(&mut Self, ThriftField) -> Option<bool>,
    ) -> Option<()> {
        let mut id: i16 = 0;
        loop {
            let head = self.byte()?;
            if head == 0 {
                return Some(());
            }
            let (delta, kind) = (head >> 4, head & 0x0f);
            id = if delta == 0 {
                i16::try_from(self.signed()?).ok()?
            } else {
                id.checked_add(i16::from(delta))?
            };
            if !take(self, ThriftField { id, kind })? {
                self.skip(kind, depth)?;
            }
        }
    }

    /// The integer of a field; nothing for other types.
    pub fn whole(&mut self, field: ThriftField) -> Option<i64> {
        match field.kind {
            3 => self.byte().map(|byte| i64::from(byte as i8)),
            4..=6 => self.signed(),
            _ => None,
        }
    }

    /// Length of a field's list of structs; their fields follow.
    pub fn structs(&mut self, field: ThriftField) -> Option<u64> {
        let (kind, count) = if field.kind == 9 { self.list()? } else { return None };
        (kind == STRUCT || count == 0).then_some(count)
    }

    fn list(&mut self) -> Option<(u8, u64)> {
        let head = self.byte()?;
        let count = match head >> 4 {
            15 => self.unsigned()?,
            count => u64::from(count),
        };
        // Each element takes at least one byte.
        (count <= (self.bytes.len() - self.at) as u64).then_some((head & 0x0f, count))
    }

    fn skip(&mut self, kind: u8, depth: usize) -> Option<()> {
        if depth > MAX_DEPTH {
            return None;
        }
        match kind {
            1 | 2 => Some(()),
            3 => self.pass(1),
            4..=6 => self.unsigned().map(drop),
            7 => self.pass(8),
            8 => {
                let length = self.unsigned()?;
                self.pass(length)
            }
            9 | 10 => {
                let (kind, count) = self.list()?;
                for _ in 0..count {
                    match kind {
                        1 | 2 => self.pass(1)?,
                        kind => self.skip(kind, depth + 1)?,
                    }
                }
                Some(())
            }
            STRUCT => self.fields(depth + 1, &mut |_, _| Some(false)),
            // These headers contain no maps.
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_are_found_and_the_rest_passed_over() {
        // 1: i32 = 5, 2: "ab", 4: list of one struct {1: i32 = -1}, 5: true.
        let bytes = [0x15, 10, 0x18, 2, b'a', b'b', 0x29, 0x1c, 0x15, 1, 0, 0x11, 0];
        let mut found = Vec::new();
        let mut reader = ThriftReader::new(&bytes);
        let all = reader.each(|reader, field| match field.id {
            1 => {
                found.push(reader.whole(field)?);
                Some(true)
            }
            4 => {
                assert_eq!(reader.structs(field)?, 1);
                reader.each(|reader, field| {
                    found.push(reader.whole(field)?);
                    Some(true)
                })?;
                Some(true)
            }
            _ => Some(false),
        });
        assert_eq!((all, found), (Some(()), vec![5, -1]));
        assert_eq!(reader.position(), bytes.len());
    }

    #[test]
    fn lies_and_depth_are_refused() {
        let passed = |bytes: &[u8]| ThriftReader::new(bytes).each(|_, _| Some(false));
        assert_eq!(passed(&[0x18, 200, 1]), None);
        assert_eq!(passed(&[0x19, 0xfc, 255, 255, 255, 15]), None);
        assert_eq!(passed(&[0x1c; 100]), None);
        assert_eq!(passed(&[0x15]), None);
    }
}
