//! Arrays of numbers in the memory layout of NumPy.

use std::rc::Rc;

/// Most items of one array.
const MAX_ITEMS: usize = 1 << 24;

/// Kind of an array's items.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Dtype {
    /// `b`, `i`, `u`, `f` or `U`.
    pub kind: u8,
    /// Bytes of an item.
    pub size: usize,
    pub big: bool,
}

impl Dtype {
    /// The type with a name such as `<f4` or `bool`.
    pub fn of(word: &str) -> Option<Self> {
        let (big, word) = match word.as_bytes().first()? {
            b'<' | b'|' | b'=' => (false, word.get(1..)?),
            b'>' => (true, word.get(1..)?),
            _ => (false, word),
        };
        let word = match word {
            "bool" | "?" => "b1",
            "float64" | "d" => "f8",
            "float32" | "f" => "f4",
            "float16" => "f2",
            "int64" => "i8",
            "int32" => "i4",
            "int16" => "i2",
            "int8" => "i1",
            "uint64" => "u8",
            "uint32" => "u4",
            "uint16" => "u2",
            "uint8" => "u1",
            word => word,
        };
        let kind = *word.as_bytes().first()?;
        let count: usize = word.get(1..)?.parse().ok()?;
        let known = match kind {
            b'b' => count == 1,
            b'i' | b'u' => matches!(count, 1 | 2 | 4 | 8),
            b'f' => matches!(count, 2 | 4 | 8),
            b'U' => (1..=1 << 10).contains(&count),
            _ => false,
        };
        // A character has four bytes.
        known.then_some(Self { kind, size: if kind == b'U' { 4 * count } else { count }, big })
    }
}

/// An array.
#[derive(Clone, Debug)]
pub(super) struct Array {
    pub shape: Vec<usize>,
    pub dtype: Option<Dtype>,
    /// Whether the order is column-major.
    pub fortran: bool,
    pub data: Rc<[u8]>,
}

impl Array {
    /// An array without content yet.
    pub fn empty() -> Self {
        Self { shape: vec![0], dtype: None, fortran: false, data: Rc::from([]) }
    }

    /// Number of its items.
    pub fn len(&self) -> usize {
        self.shape.iter().try_fold(1, |all: usize, n| all.checked_mul(*n)).unwrap_or(usize::MAX)
    }

    /// Whether its number of bytes matches its shape.
    pub fn is_whole(&self) -> bool {
        let bytes = self.dtype.and_then(|dtype| self.len().checked_mul(dtype.size));
        self.len() <= MAX_ITEMS && bytes == Some(self.data.len())
    }

    /// Type and bytes of the item with an index in row-major order.
    fn item(&self, i: usize) -> Option<(Dtype, &[u8])> {
        let dtype = self.dtype?;
        let i = if self.fortran { self.by_columns(i)? } else { i };
        let begin = i.checked_mul(dtype.size)?;
        self.data.get(begin..begin + dtype.size).map(|bytes| (dtype, bytes))
    }

    /// Index of an item in column-major order.
    fn by_columns(&self, mut i: usize) -> Option<usize> {
        let (mut at, mut stride) = (0, self.len());
        for n in self.shape.iter().rev() {
            stride = stride.checked_div(*n)?;
            at += (i % n) * stride;
            i /= n;
        }
        Some(at)
    }

    /// The number with an index in row-major order.
    pub fn number(&self, i: usize) -> Option<f64> {
        let (dtype, bytes) = self.item(i)?;
        let mut eight = [0; 8];
        for (k, byte) in bytes.iter().enumerate().take(8) {
            let k = if dtype.big { dtype.size - 1 - k } else { k };
            *eight.get_mut(k)? = *byte;
        }
        let bits = u64::from_le_bytes(eight);
        Some(match (dtype.kind, dtype.size) {
            (b'b', _) => f64::from(u8::from(bits != 0)),
            (b'u', _) => bits as f64,
            (b'i', size) => {
                let unused = 64 - 8 * size as u32;
                ((bits << unused) as i64 >> unused) as f64
            }
            (b'f', 8) => f64::from_bits(bits),
            (b'f', 4) => f64::from(f32::from_bits(bits as u32)),
            (b'f', _) => half(bits as u16),
            _ => return None,
        })
    }

    /// The text with an index in row-major order.
    pub fn text(&self, i: usize) -> Option<String> {
        let (dtype, bytes) = self.item(i).filter(|(dtype, _)| dtype.kind == b'U')?;
        let letter = |four: &[u8]| {
            let four: [u8; 4] = four.try_into().ok()?;
            char::from_u32(if dtype.big { u32::from_be_bytes(four) } else { u32::from_le_bytes(four) })
        };
        bytes.chunks(4).map(letter).take_while(|letter| *letter != Some('\0')).collect()
    }
}

/// A number of two bytes (IEEE 754 binary16).
fn half(bits: u16) -> f64 {
    let (exponent, fraction) = (i32::from(bits >> 10 & 0x1f), f64::from(bits & 0x3ff));
    let value = match exponent {
        0 => fraction * f64::powi(2.0, -24),
        31 if fraction == 0.0 => f64::INFINITY,
        31 => f64::NAN,
        _ => (1024.0 + fraction) * f64::powi(2.0, exponent - 25),
    };
    if bits & 0x8000 == 0 { value } else { -value }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn array(word: &str, shape: &[usize], fortran: bool, data: &[u8]) -> Array {
        Array { shape: shape.to_vec(), dtype: Dtype::of(word), fortran, data: Rc::from(data) }
    }

    #[test]
    fn items_of_all_kinds_are_numbers() {
        let numbers = |array: Array| -> Vec<f64> {
            assert!(array.is_whole());
            (0..array.len()).map(|i| array.number(i).unwrap()).collect()
        };
        assert_eq!(numbers(array("|b1", &[2], false, &[0, 1])), [0.0, 1.0]);
        assert_eq!(numbers(array("<i2", &[2], false, &[0xfe, 0xff, 1, 0])), [-2.0, 1.0]);
        assert_eq!(numbers(array(">i2", &[1], false, &[0xff, 0xfe])), [-2.0]);
        assert_eq!(numbers(array("u4", &[1], false, &[0xff; 4])), [4_294_967_295.0]);
        assert_eq!(numbers(array(">f4", &[1], false, &1.5f32.to_be_bytes())), [1.5]);
        assert_eq!(numbers(array("float64", &[1], false, &(-0.1f64).to_le_bytes())), [-0.1]);
        assert_eq!(
            numbers(array("<f2", &[3], false, &[0x00, 0x3c, 0x00, 0xc1, 0x01, 0x00])),
            [1.0, -2.5, f64::powi(2.0, -24)]
        );
        // Two rows of three, column by column.
        assert_eq!(numbers(array("u1", &[2, 3], true, &[1, 4, 2, 5, 3, 6])), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
        let text = array("<U2", &[2], false, &[b'a', 0, 0, 0, b'b', 0, 0, 0, b'c', 0, 0, 0, 0, 0, 0, 0]);
        assert_eq!((text.text(0).as_deref(), text.text(1).as_deref()), (Some("ab"), Some("c")));
    }

    #[test]
    fn an_array_of_another_size_than_its_bytes_is_none() {
        assert!(!array("<f4", &[3], false, &[0; 8]).is_whole());
        assert!(!array("<f4", &[usize::MAX, 4], false, &[]).is_whole());
        assert!(!Array::empty().is_whole());
        assert_eq!(array("<f4", &[3], false, &[0; 8]).number(2), None);
        assert!(
            Dtype::of("O").is_none()
                && Dtype::of("<c16").is_none()
                && Dtype::of("").is_none()
                && Dtype::of("é1").is_none()
        );
    }
}
