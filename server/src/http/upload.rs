//! Uploaded files: kept as received, and decoded anew for each reading. Not even the parts of a form are
//! assembled.

use super::body::{Blocks, Bounds, Encoding, Kept, Room, Unfolding};
use api::{Code, Problem};
use axum::body::Bytes;
use base::memory::MemoryShare;
use formats::Source;
use formats::limits::memory_for;
use futures_util::stream;
use multer::{Field, Multipart};
use std::future::Future;
use std::io::{self, Read};
use std::pin::pin;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::task::{Context, Poll, Waker};

/// Bytes decoded at a time.
const PIECE: usize = 64 << 10;

/// An uploaded body, with its share of memory.
#[derive(Debug)]
pub struct Upload {
    encoded: Blocks,
    encoding: Encoding,
    bounds: Bounds,
    /// First fault found while decoding.
    fault: Mutex<Option<Problem>>,
    /// Whether a reader has reached the end.
    read: AtomicBool,
    /// Length by which readers limit their memory.
    granted: AtomicU64,
    _kept: Kept,
}

impl Upload {
    pub(super) fn new(encoded: Blocks, encoding: Encoding, bounds: Bounds, kept: Kept) -> Self {
        let (fault, read, granted) = (Mutex::default(), AtomicBool::new(false), encoded.len().into());
        Self { encoded, encoding, bounds, fault, read, granted, _kept: kept }
    }

    /// Takes memory for reading, at most half of the budget. With less than a file of this size may need,
    /// readers refuse what does not fit.
    ///
    /// # Errors
    /// `busy` if it is not free.
    pub fn reserve(&self, room: &Room) -> Result<MemoryShare, Problem> {
        let length = self.encoded.len();
        let (own, shared) = (memory_for(length) - length, room.memory.most() / 2);
        if own > shared {
            // The inverse of `memory_for`.
            let granted = (shared + length).saturating_sub(memory_for(0)) / (memory_for(1) - memory_for(0));
            self.granted.store(granted.min(length), Ordering::Relaxed);
        }
        room.work(own.min(shared))
    }

    /// Estimated decoded size, which determines the expected time.
    pub fn expected_bytes(&self) -> u64 {
        const GROWTH: u64 = 6;
        let packed = self.encoding != Encoding::Identity || self.encoded.starts_with(&[0x1f, 0x8b]);
        self.encoded.len() * if packed { GROWTH } else { 1 }
    }

    fn reader(&self) -> Result<Unpacking<'_>, Problem> {
        let inner = Unfolding::new(self.encoded.reader(), self.encoded.len(), self.encoding, self.bounds)?;
        Ok(Unpacking { upload: self, inner })
    }

    /// Its bytes from an offset on. A body without a coding is not read up to there.
    fn open_at(&self, at: u64) -> io::Result<Box<dyn Read + Send + '_>> {
        if self.encoding == Encoding::Identity {
            return Ok(Box::new(self.encoded.reader_at(at)));
        }
        let mut reader = self.open()?;
        io::copy(&mut reader.by_ref().take(at), &mut io::sink())?;
        Ok(reader)
    }

    fn found(&self, fault: Problem) -> io::Error {
        let told = io::Error::other(fault.detail.clone());
        self.fault.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(fault);
        told
    }

    /// Reports what is wrong with the body itself, even after the part that was read.
    ///
    /// # Errors
    /// `malformed-file`, `decoded-too-large`, `expansion-too-high`.
    pub fn check(&self) -> Result<(), Problem> {
        let found = || self.fault.lock().unwrap_or_else(PoisonError::into_inner).take();
        if let Some(fault) = found() {
            return Err(fault);
        }
        if self.encoding == Encoding::Identity || self.read.load(Ordering::Relaxed) {
            return Ok(());
        }
        // Any fault is recorded while reading.
        let _ = io::copy(&mut self.reader()?, &mut io::sink());
        found().map_or(Ok(()), Err)
    }
}

impl Source for Upload {
    fn open(&self) -> io::Result<Box<dyn Read + Send + '_>> {
        Ok(Box::new(self.reader().map_err(|fault| self.found(fault))?))
    }

    fn encoded_len(&self) -> u64 {
        self.granted.load(Ordering::Relaxed)
    }
}

struct Unpacking<'a> {
    upload: &'a Upload,
    inner: Unfolding<'a>,
}

impl Read for Unpacking<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.inner.next(buffer).map_err(|fault| self.upload.found(fault))?;
        if count == 0 && !buffer.is_empty() {
            self.upload.read.store(true, Ordering::Relaxed);
        }
        Ok(count)
    }
}

/// A part of an uploaded form.
#[derive(Debug)]
pub struct FormPart {
    /// Name of its file, as given.
    pub label: Option<String>,
    form: Arc<Upload>,
    boundary: String,
    /// Offset of the separator line before it, in the decoded form.
    at: u64,
}

fn broken(error: impl ToString) -> Problem {
    Problem::new(Code::MalformedFile, error.to_string()).with(|m| m.offset = Some(0))
}

/// A form that the parser refuses, or whose bytes cannot be read.
fn unread(error: multer::Error) -> Problem {
    match error {
        multer::Error::StreamReadFailed(cause) => broken(cause),
        other => broken(other),
    }
}

/// Limit of the parts of a form, whatever their names.
const MOST_PARTS: usize = 100;
/// Limit of the bytes before a form's first part, and of the head of a part: the parser searches all of them again with
/// each piece.
const MOST_HEAD: u64 = 64 << 10;
/// Limit of the parts of a form times its decoded bytes, if it has a coding: each part is then decoded from the form's
/// start.
const MOST_DECODED: u64 = 512 << 20;

/// The parts with each of these names in a form, in order, at most `most` per name. The form is read once,
/// and each part then from its own offset.
///
/// # Errors
/// `malformed-file`; `invalid-field` for too many parts of a name or an unknown name, because nothing is
/// ignored silently.
pub fn parts<const N: usize>(
    form: &Arc<Upload>,
    content_type: &str,
    names: [(&str, usize); N],
) -> Result<[Vec<FormPart>; N], Problem> {
    let boundary = multer::parse_boundary(content_type)
        .map_err(|_| broken("Invalid `boundary` for `multipart/form-data` request"))?;
    let mut found = [const { Vec::new() }; N];
    let lines = Arc::new(Mutex::new(BoundaryLines::new(&boundary)));
    let mut read = form_of(form, &boundary, 0, Some(Arc::clone(&lines))).map_err(broken)?;
    while let Some(mut field) = now(read.next_field()).map_err(unread)? {
        let index = field.index();
        if index == MOST_PARTS {
            let detail = format!("at most {MOST_PARTS} parts of a form expected");
            return Err(Problem::field("", Code::InvalidField, detail).limit(MOST_PARTS as u64));
        }
        let named = |((name, _), _): &(&(&str, usize), &mut Vec<FormPart>)| Some(*name) == field.name();
        let Some((&(name, most), of_name)) = names.iter().zip(&mut found).find(named) else {
            let known = names.map(|(name, _)| name).join(", ");
            let detail = format!("part {} has another name; {known} expected", index + 1);
            return Err(Problem::field("", Code::InvalidField, detail));
        };
        if of_name.len() == most {
            let detail = format!("at most {most} {name} expected; send the others in calls of their own");
            return Err(Problem::field(&format!("/{name}"), Code::InvalidField, detail).limit(most as u64));
        }
        let label = field.file_name().map(str::to_owned);
        // The separator line before a part has passed when its name is known.
        let at = lines.lock().unwrap_or_else(PoisonError::into_inner).at.get(index).copied();
        let at = at.ok_or_else(|| broken("a part without a line before it"))?;
        of_name.push(FormPart { label, form: Arc::clone(form), boundary: boundary.clone(), at });
        while now(field.chunk()).map_err(unread)?.is_some() {}
    }
    let decoded = lines.lock().unwrap_or_else(PoisonError::into_inner).read;
    let count = found.iter().map(Vec::len).sum::<usize>() as u64;
    if form.encoding != Encoding::Identity && count > 1 && decoded.saturating_mul(count) > MOST_DECODED {
        let most = MOST_DECODED / count;
        let detail = format!(
            "a form of {count} parts with a Content-Encoding has at most {most} bytes when it is decoded; send it without one"
        );
        return Err(Problem::new(Code::DecodedTooLarge, detail).limit(most));
    }
    Ok(found)
}

/// Finds the offsets of the separator lines of a form, read in pieces.
struct BoundaryLines {
    /// A line end followed by the boundary.
    line: Vec<u8>,
    /// Number of its bytes that the latest bytes match.
    matched: usize,
    read: u64,
    /// Offset of the dashes before each boundary, so far.
    at: Vec<u64>,
    /// Where the present head begins, or the text before the first part, and the number of bytes of its end that the
    /// latest bytes match.
    head: Option<(u64, usize)>,
}

impl BoundaryLines {
    fn new(boundary: &str) -> Self {
        // The first separator has no line end before it.
        let line = format!("\r\n--{boundary}").into_bytes();
        Self { line, matched: 2, read: 0, at: Vec::new(), head: Some((0, 0)) }
    }

    /// Reads a piece; false if a head is too long.
    #[must_use]
    fn read(&mut self, piece: &[u8]) -> bool {
        for byte in piece {
            self.read += 1;
            if let Some((from, matched)) = self.head {
                let expected = if matched % 2 == 0 { b'\r' } else { b'\n' };
                let matched = if *byte == expected { matched + 1 } else { usize::from(*byte == b'\r') };
                // The text before the first part ends with its separator line.
                let is_over = matched == 4 && !self.at.is_empty();
                self.head = (!is_over).then_some((from, matched % 4));
                if self.read - from > MOST_HEAD {
                    return false;
                }
            }
            // Its first byte occurs nowhere else in it: a boundary has no carriage return.
            self.matched = match self.line.get(self.matched) {
                Some(expected) if expected == byte => self.matched + 1,
                _ => usize::from(*byte == b'\r'),
            };
            if self.matched == self.line.len() {
                self.at.push(self.read + 2 - self.line.len() as u64);
                self.matched = 0;
                self.head = Some((self.read, 0));
            }
        }
        true
    }
}

/// A form from a separator line on, decoded in pieces.
fn form_of<'a>(
    form: &'a Upload,
    boundary: &str,
    at: u64,
    lines: Option<Arc<Mutex<BoundaryLines>>>,
) -> io::Result<Multipart<'a>> {
    let reader = form.open_at(at)?;
    // The parser takes everything that is ready, so after each piece the stream is pending once.
    let pieces = stream::unfold((reader, lines, false), |(mut reader, lines, pause)| async move {
        if pause {
            pause_once().await;
        }
        let mut piece = vec![0; PIECE];
        match reader.read(&mut piece) {
            Ok(0) => None,
            Ok(count) => {
                piece.truncate(count);
                let fits = |lines: &Mutex<BoundaryLines>| {
                    lines.lock().unwrap_or_else(PoisonError::into_inner).read(&piece)
                };
                let read = if lines.as_deref().is_none_or(fits) {
                    Ok(Bytes::from(piece))
                } else {
                    Err(io::Error::other(format!("a part's head has more than {MOST_HEAD} bytes")))
                };
                Some((read, (reader, lines, true)))
            }
            Err(error) => Some((Err(error), (reader, lines, true))),
        }
    });
    Ok(Multipart::new(pieces, boundary))
}

async fn pause_once() {
    let mut paused = false;
    std::future::poll_fn(
        |_| {
            if std::mem::replace(&mut paused, true) { Poll::Ready(()) } else { Poll::Pending }
        },
    )
    .await;
}

/// The result of a future that needs only repeated polls.
fn now<F: Future>(future: F) -> F::Output {
    let mut future = pin!(future);
    loop {
        if let Poll::Ready(result) = future.as_mut().poll(&mut Context::from_waker(Waker::noop())) {
            return result;
        }
    }
}

impl Source for FormPart {
    fn open(&self) -> io::Result<Box<dyn Read + Send + '_>> {
        let mut form = form_of(&self.form, &self.boundary, self.at, None)?;
        match now(form.next_field()).map_err(io::Error::other)? {
            Some(field) => Ok(Box::new(PartReader { field, piece: Bytes::new() })),
            None => Err(io::ErrorKind::UnexpectedEof.into()),
        }
    }

    /// Size of the whole form.
    fn encoded_len(&self) -> u64 {
        self.form.encoded_len()
    }
}

struct PartReader<'a> {
    field: Field<'a>,
    piece: Bytes,
}

impl Read for PartReader<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        while self.piece.is_empty() {
            match now(self.field.chunk()).map_err(io::Error::other)? {
                Some(piece) => self.piece = piece,
                None => return Ok(0),
            }
        }
        let piece = self.piece.split_to(self.piece.len().min(buffer.len()));
        buffer.iter_mut().zip(piece.iter()).for_each(|(to, from)| *to = *from);
        Ok(piece.len())
    }
}

#[cfg(test)]
mod tests {
    use super::BoundaryLines;

    #[test]
    fn lines_between_parts_are_found_wherever_the_bytes_are_cut() {
        let form = b"--b\r\nname\r\n\r\n\r\r\n--a\r\n-\r\n--b\r\nx--b\r\n\r\n--b--";
        for step in 1..form.len() {
            let mut lines = BoundaryLines::new("b");
            assert!(form.chunks(step).all(|piece| lines.read(piece)));
            assert_eq!(lines.at, [0, 24, 37], "step {step}");
        }
    }

    #[test]
    fn heads_are_bounded_and_contents_are_not() {
        let piece = [b'x'; 64 << 10];
        let reads = |before: &[u8]| {
            let mut lines = BoundaryLines::new("b");
            lines.read(before) && (0..3).all(|_| lines.read(&piece))
        };
        assert!(reads(b"--b\r\nname: a\r\n\r\n"));
        assert!(!reads(b""));
        assert!(!reads(b"--b\r\nname: "));
        assert!(!reads(b"--b\r\nname: a\r\n\r\n1\r\n--b\r\n"));
    }
}
