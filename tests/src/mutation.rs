//! Unexpected inputs: corpus files with damage of the kinds that break readers.
//!
//! The n-th input of a seed never changes, so two numbers identify a finding.

use crate::random::Random;
use anyhow::{Context, ensure};
use std::path::Path;

/// Longest input.
const MOST_BYTES: usize = 256 << 10;
/// Most changes of one input.
const MOST_CHANGES: u64 = 6;

/// Replacements for numbers, words and marks.
const EXTREMES: &[&str] = &[
    "0",
    "-0.0",
    "-1",
    "1",
    "0.1",
    "91",
    "255",
    "256",
    "600",
    "601",
    "1e9",
    "1e-320",
    "1e308",
    "1e400",
    "-1e400",
    "NaN",
    "Infinity",
    "9007199254740992",
    "18446744073709551616",
    "-9223372036854775809",
    "null",
    "true",
    "false",
    "\"\"",
    "[]",
    "{}",
    "[[]]",
    "[null]",
    "{\"\":0}",
    "\"\\u0000\"",
    "\"\\ud800\"",
    "\"..\"",
    "\"0\"",
    "\u{feff}",
    "\0",
    "<!DOCTYPE a [<!ENTITY b \"c\">]>",
    "&a;",
    "&#x110000;",
    "<![CDATA[",
    "<!--",
    "-->",
    "\"/>",
    "</",
    "<a>",
    ",",
    ":",
];
/// False lengths.
const LENGTHS: &[u64] =
    &[0, 1, 127, 128, 255, 65_535, 65_536, 1 << 24, (1 << 31) - 1, 1 << 31, (1 << 32) - 1, 1 << 40, u64::MAX];

/// Valid files that are the start of all inputs.
pub struct Corpus {
    files: Vec<Vec<u8>>,
    /// Words and numbers of all files.
    tokens: Vec<Vec<u8>>,
}

impl Corpus {
    /// All files of a folder, in the order of their names.
    ///
    /// # Errors
    /// When there are none, or one cannot be read.
    pub fn read(folder: &Path) -> anyhow::Result<Self> {
        let entries = std::fs::read_dir(folder).with_context(|| folder.display().to_string())?;
        let mut paths: Vec<_> =
            entries.flatten().map(|entry| entry.path()).filter(|path| path.is_file()).collect();
        paths.sort();
        let files: Result<Vec<_>, _> = paths.iter().map(std::fs::read).collect();
        let files = files?;
        ensure!(!files.is_empty(), "{} has no files", folder.display());
        Ok(Self::of(files))
    }

    fn of(files: Vec<Vec<u8>>) -> Self {
        let mut tokens: Vec<Vec<u8>> =
            files.iter().flat_map(|file| spans(file)).map(|token| token.to_vec()).collect();
        tokens.sort();
        tokens.dedup();
        tokens.extend(EXTREMES.iter().map(|token| token.as_bytes().to_vec()));
        Self { files, tokens }
    }

    /// The unchanged files.
    pub fn files(&self) -> &[Vec<u8>] {
        &self.files
    }

    /// The n-th input of a seed.
    pub fn input(&self, seed: u64, n: u64) -> Vec<u8> {
        let mut dice = Random::of_part(seed, n);
        let mut bytes = dice.pick(&self.files).clone();
        // Half of the inputs have a single fault, so that other faults do not hide it.
        let changes = if dice.below(2) == 0 { 1 } else { 2 + dice.below(MOST_CHANGES - 1) };
        for _ in 0..changes {
            self.change(&mut bytes, &mut dice);
            bytes.truncate(MOST_BYTES);
        }
        bytes
    }

    fn change(&self, bytes: &mut Vec<u8>, dice: &mut Random) {
        let at = dice.index(bytes.len() + 1);
        let span = at..bytes.len().min(at + 1 + dice.small());
        match dice.below(18) {
            0 => bytes.iter_mut().skip(at).take(1).for_each(|byte| *byte ^= 1 << dice.below(8)),
            1 => bytes.iter_mut().skip(at).take(1).for_each(|byte| *byte = dice.any() as u8),
            2 => bytes.truncate(at),
            3 => drop(bytes.drain(span)),
            4 => {
                let noise: Vec<u8> = (0..dice.small()).map(|_| dice.any() as u8).collect();
                bytes.splice(at..at, noise);
            }
            5 => {
                // A repeated part: long lists, deep nesting.
                let part = bytes.get(span).unwrap_or_default().to_vec();
                let times = (1usize << dice.below(12)).min(MOST_BYTES / part.len().max(1));
                bytes.splice(at..at, part.repeat(times));
            }
            6 => {
                // The head of this file and the end of another.
                let other = dice.pick(&self.files);
                bytes.truncate(at);
                bytes.extend_from_slice(other.get(dice.index(other.len() + 1)..).unwrap_or_default());
            }
            7 => {
                let length = dice.pick(LENGTHS).to_le_bytes();
                let width = *dice.pick(&[1, 2, 4, 8]);
                let end = bytes.len().min(at + width);
                bytes.splice(at..end, length.into_iter().take(width));
            }
            8 => {
                let varint = varint(*dice.pick(LENGTHS));
                let end = bytes.len().min(at + 1 + dice.index(varint.len()));
                bytes.splice(at..end, varint);
            }
            9 => {
                // Two tokens of this file are exchanged.
                let found = spans(bytes);
                if found.len() > 1 {
                    let (a, b) = (dice.pick(&found).to_vec(), dice.pick(&found).to_vec());
                    self.replace(bytes, dice, |token| if token == a { Some(b.clone()) } else { None });
                }
            }
            _ => {
                let token = dice.pick(&self.tokens).clone();
                self.replace(bytes, dice, |_| Some(token.clone()));
            }
        }
    }

    /// Replaces the first token after a drawn position that has a replacement.
    fn replace(&self, bytes: &mut Vec<u8>, dice: &mut Random, with: impl Fn(&[u8]) -> Option<Vec<u8>>) {
        let found: Vec<(usize, usize)> =
            spans(bytes).iter().map(|token| (offset(bytes, token), token.len())).collect();
        let from = dice.index(found.len().max(1));
        for (at, length) in found.into_iter().skip(from) {
            let token = bytes.get(at..at + length).unwrap_or_default();
            if let Some(new) = with(token) {
                bytes.splice(at..at + length, new);
                return;
            }
        }
    }
}

/// Runs of letters, digits and the other characters of numbers.
fn spans(bytes: &[u8]) -> Vec<&[u8]> {
    let is_part = |byte: &u8| byte.is_ascii_alphanumeric() || b"_-+.".contains(byte);
    bytes.split(|byte| !is_part(byte)).filter(|token| !token.is_empty() && token.len() < 64).collect()
}

fn offset(whole: &[u8], part: &[u8]) -> usize {
    part.as_ptr() as usize - whole.as_ptr() as usize
}

/// A whole number in the encoding of protobuf.
fn varint(mut value: u64) -> Vec<u8> {
    let mut bytes = Vec::new();
    while value >= 128 {
        bytes.push(value as u8 | 128);
        value >>= 7;
    }
    bytes.push(value as u8);
    bytes
}

#[cfg(test)]
mod tests {
    use super::{Corpus, spans, varint};
    use crate::random::Random;

    #[test]
    fn inputs_come_again_and_differ() {
        let corpus = Corpus::of(vec![br#"{"a":[1.5,-2],"b":"c"}"#.to_vec(), b"<x y='1'/>".to_vec()]);
        let inputs: Vec<Vec<u8>> = (0..500).map(|n| corpus.input(7, n)).collect();
        assert_eq!(corpus.input(7, 123), inputs[123]);
        let mut distinct = inputs.clone();
        distinct.sort();
        distinct.dedup();
        assert!(distinct.len() > 350, "{} of 500 differ", distinct.len());
        assert!(inputs.iter().any(|input| input.len() > 1_000) && inputs.iter().any(Vec::is_empty));
    }

    #[test]
    fn tokens_are_words_and_numbers() {
        assert_eq!(spans(br#"{"a_b":-1.5e+3}"#), [&b"a_b"[..], b"-1.5e+3"]);
        assert_eq!(varint(300), [0xac, 2]);
        assert_eq!(varint(u64::MAX).len(), 10);
        let mut dice = Random::of_part(1, 2);
        assert!((0..100).all(|_| dice.index(3) < 3));
    }
}
