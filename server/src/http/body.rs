//! Request bodies: media type, time, encoded size, Content-Encoding, decoded size, JSON.
//!
//! The encoded bytes are bounded while they arrive, the decoded ones while they are unpacked, so a
//! small body can never become a large one in memory.

use super::extract;
use super::upload::Upload;
use api::{Code, Problem};
use axum::body::{Body, Bytes};
use axum::extract::{FromRef, FromRequest, Request};
use axum::http::{HeaderMap, header};
use axum::response::{IntoResponse, Response};
use base::limits::Limits;
use base::memory::{self, Memory, MemoryShare};
use base::party::Party;
use base::places::{SharedPlaces, TakenPlace};
use base::problem::{ENCODINGS, Refusal};
use http_body_util::BodyExt;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::io::{self, Read};
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio::time::Instant;
use work::{Pool, PoolLane};

/// Decoded sizes below this are never refused for their expansion.
const FREE_EXPANSION: u64 = 1 << 20;

/// Media types of JSON documents.
pub const JSON: &[&str] = &["application/json", "application/vnd.dragtraffic.scene+json"];

/// Resources for reading a body.
#[derive(Clone)]
pub struct Reading {
    /// Limits.
    pub limits: Arc<Limits>,
    /// Pool that decodes and parses long bodies.
    pub pool: Arc<Pool>,
    /// Memory budget of bodies.
    pub room: Arc<Room>,
}

/// Budget for the bodies of all requests: memory, uploads and imports.
#[derive(Debug)]
pub struct Room {
    /// Memory of all requests.
    pub memory: Arc<Memory>,
    /// Share of it for bodies.
    bytes: Arc<Memory>,
    uploads: Arc<SharedPlaces>,
    imports: Arc<Semaphore>,
    /// Places of long imports; short ones never wait for all of these.
    long_imports: Arc<Semaphore>,
}

impl Room {
    /// A budget for as many bodies as the limits allow, within the memory of all requests.
    pub fn new(limits: &Limits, memory: &Arc<Memory>) -> Self {
        let of = |number: u64| (number as usize).min(Semaphore::MAX_PERMITS);
        let places = |number: u64| Arc::new(Semaphore::new(of(number)));
        Self {
            memory: Arc::clone(memory),
            bytes: memory.part(limits.body_bytes),
            uploads: SharedPlaces::new(of(limits.uploads)),
            imports: places(limits.imports),
            long_imports: places(limits.imports.saturating_sub(1).max(1)),
        }
    }

    /// Takes a place among the uploads.
    ///
    /// # Errors
    /// `busy` if all are taken, or all of the party's.
    fn upload(&self, party: Party) -> Result<TakenPlace, Problem> {
        self.uploads.take(party).map_err(|full| {
            let detail = if full.is_own {
                "Other files of this caller are being uploaded."
            } else {
                "Other files are being uploaded."
            };
            Problem::new(Code::Busy, detail).retry_after_ms(full.wait.as_millis() as u64)
        })
    }

    /// Waits for a place among the imports, because the scenes of a file take memory too.
    ///
    /// # Errors
    /// A defect.
    pub async fn import(&self, lane: PoolLane) -> Result<[Option<OwnedSemaphorePermit>; 2], Problem> {
        let long = match lane {
            PoolLane::Patient => Some(Arc::clone(&self.long_imports).acquire_owned().await),
            PoolLane::Quick | PoolLane::Background | PoolLane::Document => None,
        };
        let place = Arc::clone(&self.imports).acquire_owned().await;
        Ok([long.transpose().map_err(Problem::internal)?, Some(place.map_err(Problem::internal)?)])
    }

    /// Takes memory for bytes that are kept.
    ///
    /// # Errors
    /// As [`Self::grow`].
    pub fn keep(&self, bytes: usize) -> Result<Kept, Problem> {
        let mut kept = Kept::default();
        self.grow(&mut kept.room, bytes)?;
        Ok(kept)
    }

    /// Adds `bytes` to the held memory.
    ///
    /// # Errors
    /// `body-too-large` if they can never fit, `busy` if they do not fit now.
    fn grow(&self, held: &mut Option<MemoryShare>, bytes: usize) -> Result<(), Problem> {
        let held = held.get_or_insert_with(|| self.bytes.nothing());
        let most = self.bytes.most();
        if (held.bytes() + bytes) as u64 > most {
            return Err(too_large(most));
        }
        held.grow(bytes).then_some(()).ok_or_else(memory::full)
    }

    /// Takes memory for work that needs up to `bytes` beyond its body, for as long as the result is kept.
    ///
    /// # Errors
    /// `busy` if they do not fit now.
    pub fn work(&self, bytes: u64) -> Result<MemoryShare, Problem> {
        usize::try_from(bytes).ok().and_then(|bytes| self.memory.take(bytes)).ok_or_else(memory::full)
    }
}

/// Memory that is held until this is dropped.
#[derive(Debug, Default)]
pub struct Kept {
    room: Option<MemoryShare>,
    /// Place among the uploads.
    place: Option<TakenPlace>,
}

/// Bytes in the order of their arrival. They are never moved: a growing vector would be copied, and longer
/// than needed.
#[derive(Debug, Default)]
pub(super) struct Blocks(Vec<Vec<u8>>);

impl Blocks {
    const BLOCK: usize = 1 << 20;

    fn push(&mut self, mut data: &[u8]) {
        while !data.is_empty() {
            let full = self.0.last().is_none_or(|block| block.len() >= Self::BLOCK);
            if full {
                // Usually all blocks but the first are filled.
                self.0.push(Vec::with_capacity(if self.0.is_empty() { 0 } else { Self::BLOCK }));
            }
            let Some(block) = self.0.last_mut() else { return };
            let (now, later) = data.split_at(data.len().min(Self::BLOCK - block.len()));
            block.extend_from_slice(now);
            data = later;
        }
    }

    pub fn len(&self) -> u64 {
        self.0.iter().map(|block| block.len() as u64).sum()
    }

    pub fn starts_with(&self, head: &[u8]) -> bool {
        self.0.first().is_some_and(|block| block.starts_with(head))
    }

    pub fn reader(&self) -> impl Read + Send + '_ {
        let mut blocks = self.0.iter();
        BlockReader { now: blocks.next().map_or(&[][..], Vec::as_slice), blocks }
    }

    /// As [`Self::reader`], from an offset on.
    pub fn reader_at(&self, mut at: u64) -> impl Read + Send + '_ {
        let mut blocks = self.0.iter();
        let mut now = &[][..];
        for block in blocks.by_ref() {
            let skipped = usize::try_from(at).unwrap_or(usize::MAX).min(block.len());
            now = block.get(skipped..).unwrap_or_default();
            at -= skipped as u64;
            if !now.is_empty() {
                break;
            }
        }
        BlockReader { now, blocks }
    }

    fn joined(mut self) -> Bytes {
        match self.0.pop() {
            Some(only) if self.0.is_empty() => only.into(),
            Some(last) => {
                self.0.push(last);
                self.0.concat().into()
            }
            None => Bytes::new(),
        }
    }
}

struct BlockReader<'a> {
    now: &'a [u8],
    blocks: std::slice::Iter<'a, Vec<u8>>,
}

impl Read for BlockReader<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.now.is_empty() {
            self.now = self.blocks.next().map_or(&[][..], Vec::as_slice);
        }
        self.now.read(buffer)
    }
}

/// A body in memory, with its share of the budget.
#[derive(Debug, Default)]
pub struct Held {
    bytes: Bytes,
    _kept: Kept,
}

impl Held {
    /// The bytes, valid while this is held.
    pub fn bytes(&self) -> Bytes {
        self.bytes.clone()
    }
}

/// A JSON body parsed into a document type.
pub struct Json<T>(pub T);

impl<S: Send + Sync, T: DeserializeOwned + Send + 'static> FromRequest<S> for Json<T>
where
    Reading: FromRef<S>,
{
    type Rejection = Refusal;

    async fn from_request(request: Request, state: &S) -> Result<Self, Refusal> {
        media_type(request.headers(), JSON)?;
        let reading = Reading::from_ref(state);
        let bytes = reading.json(request).await?;
        Ok(Self(reading.parse(bytes).await?))
    }
}

/// A value as JSON text, serialized in the thread that made the value, because a long one takes time.
pub struct JsonText(Bytes);

impl JsonText {
    /// Serializes a value.
    ///
    /// # Errors
    /// When it cannot be written as JSON.
    pub fn of(value: &impl Serialize) -> Result<Self, Problem> {
        serde_json::to_vec(value).map(|text| Self(text.into())).map_err(Problem::internal)
    }

    /// The text.
    pub fn bytes(&self) -> Bytes {
        self.0.clone()
    }
}

impl From<Bytes> for JsonText {
    /// From text that was serialized before.
    fn from(text: Bytes) -> Self {
        Self(text)
    }
}

impl IntoResponse for JsonText {
    fn into_response(self) -> Response {
        ([(header::CONTENT_TYPE, "application/json")], self.0).into_response()
    }
}

/// Checks the Content-Type against a list and returns the one given, without parameters.
///
/// # Errors
/// `unsupported-media-type` when it is missing or not in the list.
pub fn media_type(headers: &HeaderMap, allowed: &[&str]) -> Result<String, Problem> {
    let given = headers.get(header::CONTENT_TYPE).and_then(|v| v.to_str().ok()).unwrap_or_default();
    let essence = given.split(';').next().unwrap_or_default().trim().to_ascii_lowercase();
    if allowed.contains(&essence.as_str()) {
        return Ok(essence);
    }
    let detail = format!("Content-Type is \"{essence}\"; expected {}.", allowed.join(" or "));
    Err(Problem::new(Code::UnsupportedMediaType, detail))
}

impl Reading {
    /// Reads and unpacks a JSON-sized body.
    ///
    /// # Errors
    /// Every limit of such a body.
    pub async fn json(&self, request: Request) -> Result<Held, Problem> {
        let bounds = Bounds {
            encoded: self.limits.json_encoded_bytes,
            decoded: self.limits.json_decoded_bytes,
            ratio: self.limits.expansion_ratio,
            time: Duration::from_secs(self.limits.body_read_s),
        };
        self.read(request, bounds).await
    }

    /// Receives an uploaded file, which is decoded later.
    ///
    /// # Errors
    /// Every limit of such a body as it arrives.
    pub async fn upload(&self, request: Request) -> Result<Upload, Problem> {
        let place = self.room.upload(extract::party_of(request.extensions()).unwrap_or_default())?;
        let bounds = Bounds {
            encoded: self.limits.import_encoded_bytes,
            decoded: self.limits.import_decoded_bytes,
            ratio: self.limits.expansion_ratio,
            time: Duration::from_secs(self.limits.import_read_s),
        };
        let (encoded, encoding, mut kept) = self.arrived(request, bounds).await?;
        kept.place = Some(place);
        Ok(Upload::new(encoded, encoding, bounds, kept))
    }

    /// Parses JSON, outside the network threads if it is long.
    ///
    /// # Errors
    /// `malformed-json`, or 422 with the place of the fault.
    pub async fn parse<T: DeserializeOwned + Send + 'static>(&self, body: Held) -> Result<T, Problem> {
        let size = body.bytes.len();
        let parse = move || formats::native::from_json(&body.bytes).map_err(Problem::from);
        self.pool.document(size, parse).await
    }

    async fn read(&self, request: Request, bounds: Bounds) -> Result<Held, Problem> {
        let (encoded, encoding, kept) = self.arrived(request, bounds).await?;
        match encoding {
            Encoding::Identity => Ok(Held { bytes: encoded.joined(), _kept: kept }),
            // A few bytes can decode to many, so even the smallest goes to the pool.
            _ => {
                let room = Arc::clone(&self.room);
                let unpack = move || {
                    let _kept = kept;
                    unpack(&encoded, encoding, bounds, &room)
                };
                self.pool.document(usize::MAX, unpack).await
            }
        }
    }

    /// Receives a body as it was sent.
    async fn arrived(&self, request: Request, bounds: Bounds) -> Result<(Blocks, Encoding, Kept), Problem> {
        let encoding = encoding_of(request.headers())?;
        let length = request.headers().get(header::CONTENT_LENGTH);
        let declared: Option<u64> = length.and_then(|v| v.to_str().ok()?.parse().ok());
        if declared.is_some_and(|length| length > bounds.encoded) {
            return Err(too_large(bounds.encoded));
        }
        let encoded = tokio::time::timeout(bounds.time, self.collect(request.into_body(), bounds.encoded));
        let (encoded, kept) = encoded.await.map_err(|_| {
            let detail = format!("The body did not arrive within {} s.", bounds.time.as_secs());
            Problem::new(Code::BodyTimeout, detail)
        })??;
        Ok((encoded, encoding, kept))
    }

    /// Receives a body, and refuses it if it arrives too slowly.
    async fn collect(&self, mut body: Body, limit: u64) -> Result<(Blocks, Kept), Problem> {
        let (mut blocks, mut kept, mut size) = (Blocks::default(), Kept::default(), 0);
        let began = Instant::now();
        loop {
            let allowed_s = self.limits.body_grace_s + size / self.limits.body_rate.max(1);
            let late = |_| {
                let detail = format!("The body came slower than {} bytes a second.", self.limits.body_rate);
                Problem::new(Code::BodyTimeout, detail).limit(self.limits.body_rate)
            };
            let frame = tokio::time::timeout_at(began + Duration::from_secs(allowed_s), body.frame());
            let Some(frame) = frame.await.map_err(late)? else { break };
            let frame = frame.map_err(|_| Problem::new(Code::BadHeader, "The body was cut off."))?;
            let Ok(data) = frame.into_data() else { continue };
            size += data.len() as u64;
            if size > limit {
                return Err(too_large(limit));
            }
            self.room.grow(&mut kept.room, data.len())?;
            blocks.push(&data);
        }
        Ok((blocks, kept))
    }
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    encoded: u64,
    decoded: u64,
    ratio: u64,
    time: Duration,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Identity,
    Gzip,
    Zstd,
}

fn encoding_of(headers: &HeaderMap) -> Result<Encoding, Problem> {
    let mut all = headers.get_all(header::CONTENT_ENCODING).iter();
    let (first, more) = (all.next(), all.next());
    match (first.map(|v| v.as_bytes().to_ascii_lowercase()).as_deref(), more) {
        (None | Some(b"identity"), None) => Ok(Encoding::Identity),
        (Some(b"gzip"), None) => Ok(Encoding::Gzip),
        (Some(b"zstd"), None) => Ok(Encoding::Zstd),
        _ => {
            let detail = "Content-Encoding may be gzip or zstd, once.";
            Err(Problem::new(Code::UnsupportedMediaType, detail).fact(ENCODINGS, "gzip, zstd"))
        }
    }
}

fn too_large(limit: u64) -> Problem {
    Problem::new(Code::BodyTooLarge, format!("The body may have at most {limit} bytes.")).limit(limit)
}

/// A body that is decoded while it is read, within its limits.
pub(super) struct Unfolding<'a> {
    inner: Box<dyn Read + Send + 'a>,
    bounds: Bounds,
    encoded: u64,
    /// Decoded bytes so far; `None` for a body without a coding.
    decoded: Option<u64>,
}

fn undecodable(error: &io::Error) -> Problem {
    Problem::new(Code::MalformedFile, format!("The body cannot be decoded: {error}."))
        .with(|m| (m.offset, m.reason) = (Some(0), Some(error.to_string())))
}

impl<'a> Unfolding<'a> {
    /// `size` is the number of encoded bytes.
    pub fn new(
        encoded: impl Read + Send + 'a,
        size: u64,
        encoding: Encoding,
        bounds: Bounds,
    ) -> Result<Self, Problem> {
        let inner: Box<dyn Read + Send + 'a> = match encoding {
            Encoding::Identity => Box::new(encoded),
            Encoding::Gzip => Box::new(flate2::read::MultiGzDecoder::new(encoded)),
            Encoding::Zstd => {
                let mut decoder = zstd::stream::read::Decoder::new(encoded).map_err(|e| undecodable(&e))?;
                // A frame may ask for a window of gigabytes; level 19 uses 8 MiB.
                decoder.window_log_max(23).map_err(|e| undecodable(&e))?;
                Box::new(decoder)
            }
        };
        let decoded = (encoding != Encoding::Identity).then_some(0);
        Ok(Self { inner, bounds, encoded: size, decoded })
    }

    /// Fills the buffer partly or completely; 0 at the end.
    pub fn next(&mut self, buffer: &mut [u8]) -> Result<usize, Problem> {
        let count = self.inner.read(buffer).map_err(|error| undecodable(&error))?;
        let (Some(size), bounds) = (&mut self.decoded, self.bounds) else { return Ok(count) };
        *size += count as u64;
        if *size > bounds.decoded {
            let detail = format!("The body may decode to at most {} bytes.", bounds.decoded);
            return Err(Problem::new(Code::DecodedTooLarge, detail).limit(bounds.decoded));
        }
        if *size > FREE_EXPANSION && *size > bounds.ratio.saturating_mul(self.encoded) {
            let detail = format!("The body may grow by a factor of at most {} when decoded.", bounds.ratio);
            return Err(Problem::new(Code::ExpansionTooHigh, detail).limit(bounds.ratio));
        }
        Ok(count)
    }
}

fn unpack(encoded: &Blocks, encoding: Encoding, bounds: Bounds, room: &Room) -> Result<Held, Problem> {
    let mut reader = Unfolding::new(encoded.reader(), encoded.len(), encoding, bounds)?;
    let (mut decoded, mut kept) = (Vec::new(), Kept::default());
    let mut chunk = vec![0; 64 << 10];
    loop {
        let count = reader.next(&mut chunk)?;
        let Some(data) = chunk.get(..count).filter(|data| !data.is_empty()) else { break };
        room.grow(&mut kept.room, data.len())?;
        decoded.extend_from_slice(data);
    }
    Ok(Held { bytes: decoded.into(), _kept: kept })
}

#[cfg(test)]
mod tests {
    use super::{Blocks, Bounds, Encoding, Held, Room};
    use api::Problem;
    use base::limits::Limits;
    use base::memory::Memory;
    use base::party::Party;
    use std::io::Write;
    use std::time::Duration;

    const BOUNDS: Bounds =
        Bounds { encoded: 1 << 20, decoded: 8 << 20, ratio: 100, time: Duration::from_secs(1) };

    fn gzip(data: &[u8]) -> Vec<u8> {
        let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::best());
        encoder.write_all(data).unwrap();
        encoder.finish().unwrap()
    }

    fn unpack(encoded: &[u8], encoding: Encoding, bounds: Bounds, room: &Room) -> Result<Held, Problem> {
        let mut blocks = Blocks::default();
        blocks.push(encoded);
        super::unpack(&blocks, encoding, bounds, room)
    }

    #[test]
    fn blocks_keep_what_came() {
        use std::io::Read;
        let bytes: Vec<u8> = (0..3_000_001u32).map(|i| (i % 251) as u8).collect();
        let mut blocks = Blocks::default();
        bytes.chunks(77_777).for_each(|data| blocks.push(data));
        let mut read = Vec::new();
        blocks.reader().read_to_end(&mut read).unwrap();
        assert!(read == bytes && blocks.len() == bytes.len() as u64);
        assert!(blocks.0.iter().all(|block| block.capacity() <= 2 * Blocks::BLOCK));
        assert_eq!(blocks.joined(), bytes);
    }

    fn room(limits: &Limits) -> Room {
        Room::new(limits, &Memory::new(limits.budget_bytes()))
    }

    fn code(encoded: &[u8], encoding: Encoding) -> &'static str {
        let room = room(&Limits::default());
        unpack(encoded, encoding, BOUNDS, &room).map_or_else(|p| p.code.name(), |_| "ok")
    }

    #[test]
    fn bombs_are_stopped() {
        assert_eq!(code(&gzip(&vec![0; 4 << 20]), Encoding::Gzip), "expansion-too-high");
        assert_eq!(code(&gzip(b"{}"), Encoding::Gzip), "ok");
        assert_eq!(code(b"not gzip", Encoding::Gzip), "malformed-file");
        assert_eq!(
            code(&zstd::encode_all(&vec![0; 4 << 20][..], 3).unwrap(), Encoding::Zstd),
            "expansion-too-high"
        );
        let big: Vec<u8> = (0..9u32 << 20).map(|i| (i.wrapping_mul(2_654_435_761) >> 13) as u8).collect();
        let patient = Bounds { ratio: u64::MAX, ..BOUNDS };
        let room = room(&Limits::default());
        let encoded = zstd::encode_all(&big[..], 1).unwrap();
        let refused = unpack(&encoded, Encoding::Zstd, patient, &room);
        assert_eq!(refused.unwrap_err().code.name(), "decoded-too-large");
    }

    #[test]
    fn skippable_frames_decode_to_nothing() {
        let frame = [0x50, 0x2a, 0x4d, 0x18, 4, 0, 0, 0, 1, 2, 3, 4];
        let room = room(&Limits::default());
        assert_eq!(unpack(&frame, Encoding::Zstd, BOUNDS, &room).unwrap().bytes().len(), 0);
    }

    #[test]
    fn bodies_share_the_room() {
        let room = room(&Limits { body_bytes: 100 << 10, uploads: 1, ..Limits::default() });
        let file: Vec<u8> = (0..60u32 << 10).map(|i| (i.wrapping_mul(2_654_435_761) >> 13) as u8).collect();
        let encoded = gzip(&file);
        let unpacked = || unpack(&encoded, Encoding::Gzip, BOUNDS, &room);
        let first = unpacked().unwrap();
        let refused = unpacked().unwrap_err();
        assert_eq!((refused.code.name(), refused.members.retry_after_s), ("busy", Some(1)));
        drop(first);
        assert_eq!(unpacked().unwrap().bytes().len(), file.len());
        let others = room.work(room.memory.most() - (50 << 10)).unwrap();
        assert_eq!(unpacked().unwrap_err().code.name(), "busy");
        drop(others);
        assert_eq!(room.keep(200 << 10).unwrap_err().code.name(), "body-too-large");
    }

    #[test]
    fn a_party_has_half_of_the_places_for_uploads() {
        let room = room(&Limits { uploads: 3, ..Limits::default() });
        let [one, other] = ["one", "other"].map(Party::named);
        let refused = |party| room.upload(party).unwrap_err().code.name();
        let both = [room.upload(one).unwrap(), room.upload(one).unwrap()];
        assert_eq!(refused(one), "busy", "its share is taken");
        let last = room.upload(other).unwrap();
        assert_eq!((refused(one), refused(other)), ("busy", "busy"), "all are taken");
        drop(both);
        assert!(room.upload(one).is_ok() && room.upload(other).is_ok());
        drop(last);
        let again = [one, one, other].map(|party| room.upload(party));
        assert!(again.iter().all(Result::is_ok), "every place was given back");
    }
}
