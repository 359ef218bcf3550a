//! Bytes in a JSON text: base64 (RFC 4648, section 4) with padding.

const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// The text of bytes.
pub(super) fn encoded(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for part in bytes.chunks(3) {
        let byte = |i: usize| part.get(i).copied().map_or(0, u32::from);
        let word = byte(0) << 16 | byte(1) << 8 | byte(2);
        for i in 0..4 {
            let digit = DIGITS[(word >> (18 - 6 * i) & 63) as usize];
            text.push(if i <= part.len() { char::from(digit) } else { '=' });
        }
    }
    text
}

/// The bytes of a text.
///
/// # Errors
/// The place of the first character that does not belong there.
pub(super) fn decoded(text: &str) -> Result<Vec<u8>, usize> {
    let text = text.as_bytes();
    if !text.len().is_multiple_of(4) {
        return Err(text.len());
    }
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3);
    for (k, part) in text.chunks_exact(4).enumerate() {
        let is_last = 4 * (k + 1) == text.len();
        let padding = if is_last { part.iter().rev().take_while(|c| **c == b'=').count().min(2) } else { 0 };
        let mut word = 0;
        for (i, c) in part[..4 - padding].iter().enumerate() {
            let digit = DIGITS.iter().position(|d| d == c).ok_or(4 * k + i)?;
            word |= (digit as u32) << (18 - 6 * i);
        }
        let given = 3 - padding;
        // One text for the same bytes: nothing stands in bits that are cut off.
        if word & ((1 << (8 * padding)) - 1) != 0 {
            return Err(4 * k + 3 - padding);
        }
        bytes.extend(&word.to_be_bytes()[1..=given]);
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::{decoded, encoded};

    #[test]
    fn texts_of_the_standard_and_all_lengths() {
        let known = ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"];
        for (length, text) in known.into_iter().enumerate() {
            assert_eq!(encoded(&b"foobar"[..length]), text);
            assert_eq!(decoded(text).unwrap(), &b"foobar"[..length]);
        }
        let bytes: Vec<u8> = (0..=255).collect();
        assert_eq!(decoded(&encoded(&bytes)).unwrap(), bytes);
        for (bad, at) in [("Zg=", 3), ("Z===", 1), ("Zm9!", 3), ("Zg==Zg==", 2), ("Zh==", 1)] {
            assert_eq!(decoded(bad), Err(at), "{bad}");
        }
    }
}
