//! Content hashes of domain values.

use serde::{Serialize, Serializer};
use sha2::{Digest, Sha256};
use std::fmt;
use std::io::{self, Write};

/// SHA-256 of a value's canonical form (its fields in declaration order, numbers in shortest
/// round-trip form). Names a map, a scene's user part or a set of weights.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ContentHash([u8; 32]);

struct HashWriter(Sha256);

impl Write for HashWriter {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.update(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl ContentHash {
    /// Hash of a serialisable value.
    pub fn of<T: Serialize + ?Sized>(value: &T) -> Self {
        let mut writer = HashWriter(Sha256::new());
        // Domain values have string keys and the writer cannot fail, so this cannot fail either. If a type
        // breaks that, its hash differs from that of every other value.
        if let Err(error) = serde_json::to_writer(io::BufWriter::new(&mut writer), value) {
            writer.0.update(error.to_string());
        }
        Self(writer.0.finalize().into())
    }

    /// Hash of bytes as they are.
    pub fn of_bytes(bytes: &[u8]) -> Self {
        Self(Sha256::digest(bytes).into())
    }

    /// The 32 bytes.
    pub fn bytes(&self) -> &[u8; 32] {
        &self.0
    }

    /// 64 lower-case hex digits.
    pub fn hex(&self) -> String {
        self.0.iter().map(|b| format!("{b:02x}")).collect()
    }

    /// Six characters to read aloud: 30 bits in Crockford's base 32, which has no I, L, O and U.
    pub fn short(&self) -> String {
        const DIGITS: [char; 32] = [
            '0', '1', '2', '3', '4', '5', '6', '7', '8', '9', 'A', 'B', 'C', 'D', 'E', 'F', 'G', 'H', 'J',
            'K', 'M', 'N', 'P', 'Q', 'R', 'S', 'T', 'V', 'W', 'X', 'Y', 'Z',
        ];
        let bits = self.0[..4].iter().fold(0_usize, |bits, byte| bits << 8 | usize::from(*byte)) >> 2;
        (0..6).rev().map(|i| DIGITS[bits >> (5 * i) & 31]).collect()
    }

    /// Reads 64 hex digits; `None` for anything else.
    pub fn from_hex(text: &str) -> Option<Self> {
        if text.len() != 64 || !text.is_ascii() {
            return None;
        }
        let mut bytes = [0; 32];
        for (i, byte) in bytes.iter_mut().enumerate() {
            *byte = u8::from_str_radix(text.get(2 * i..2 * i + 2)?, 16).ok()?;
        }
        Some(Self(bytes))
    }
}

impl fmt::Display for ContentHash {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.hex())
    }
}

impl fmt::Debug for ContentHash {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "sha256:{}", self.hex())
    }
}

impl Serialize for ContentHash {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.hex())
    }
}

#[cfg(test)]
mod tests {
    use super::ContentHash;

    #[test]
    fn hex_round_trip() {
        let hash = ContentHash::of("scene");
        assert_eq!(ContentHash::from_hex(&hash.hex()), Some(hash));
        assert_eq!(ContentHash::from_hex("xyz"), None);
    }

    #[test]
    fn equal_values_equal_hashes() {
        assert_eq!(ContentHash::of(&vec![0.1, 0.2]), ContentHash::of(&vec![0.1, 0.2]));
        assert_ne!(ContentHash::of(&vec![0.1, 0.2]), ContentHash::of(&vec![0.1, 0.2000001]));
    }
}
