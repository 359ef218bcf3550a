//! Request bodies: media type, time, encoded size, Content-Encoding, decoded size, JSON.
//!
//! The encoded bytes are bounded while they arrive, the decoded ones while they are unpacked, so a
//! small body can never become a large one in memory.

use crate::base::limits::Limits;
use crate::base::problem::{Code, Problem};
use crate::work::Pool;
use axum::body::{Body, Bytes};
use axum::extract::{FromRef, FromRequest, Request};
use axum::http::{HeaderMap, header};
use axum::response::{IntoResponse, Response};
use http_body_util::BodyExt;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::io::Read;
use std::sync::Arc;
use std::time::Duration;

/// Growth below this size is never too much.
const FREE_EXPANSION: u64 = 1 << 20;

/// Media types of JSON documents.
pub const JSON: &[&str] = &["application/json", "application/vnd.dragtraffic.scene+json"];

/// What reading a body takes.
#[derive(Clone)]
pub struct Reading {
    /// Bounds.
    pub limits: Arc<Limits>,
    /// Where long bodies are decoded and parsed.
    pub pool: Arc<Pool>,
}

/// A JSON body read into a document type.
pub struct Json<T>(pub T);

impl<S: Send + Sync, T: DeserializeOwned + Send + 'static> FromRequest<S> for Json<T>
where
    Reading: FromRef<S>,
{
    type Rejection = Problem;

    async fn from_request(request: Request, state: &S) -> Result<Self, Problem> {
        media_type(request.headers(), JSON)?;
        let reading = Reading::from_ref(state);
        let bytes = reading.json(request).await?;
        reading.parse(bytes).await.map(Self)
    }
}

/// A value as JSON text, made where the value was: a long one takes time.
pub struct JsonText(Vec<u8>);

impl JsonText {
    /// Of a value.
    ///
    /// # Errors
    /// When it cannot be written as JSON.
    pub fn of(value: &impl Serialize) -> Result<Self, Problem> {
        serde_json::to_vec(value).map(Self).map_err(Problem::internal)
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
    pub async fn json(&self, request: Request) -> Result<Bytes, Problem> {
        let bounds = Bounds {
            encoded: self.limits.json_encoded_bytes,
            decoded: self.limits.json_decoded_bytes,
            ratio: self.limits.expansion_ratio,
            time: Duration::from_secs(self.limits.body_read_s),
        };
        self.read(request, bounds).await
    }

    /// Reads and unpacks an uploaded file.
    ///
    /// # Errors
    /// Every limit of such a body.
    pub async fn upload(&self, request: Request) -> Result<Bytes, Problem> {
        let bounds = Bounds {
            encoded: self.limits.import_encoded_bytes,
            decoded: self.limits.import_decoded_bytes,
            ratio: self.limits.expansion_ratio,
            time: Duration::from_secs(self.limits.import_read_s),
        };
        self.read(request, bounds).await
    }

    /// Parses JSON, away from the network threads when it is long.
    ///
    /// # Errors
    /// `malformed-json`, or 422 with the place of the fault.
    pub async fn parse<T: DeserializeOwned + Send + 'static>(&self, bytes: Bytes) -> Result<T, Problem> {
        let size = bytes.len();
        let parse = move || formats::native::from_json(&bytes).map_err(Problem::from);
        self.pool.document(size, parse).await
    }

    async fn read(&self, request: Request, bounds: Bounds) -> Result<Bytes, Problem> {
        let encoding = encoding_of(request.headers())?;
        let length = request.headers().get(header::CONTENT_LENGTH);
        let declared: Option<u64> = length.and_then(|v| v.to_str().ok()?.parse().ok());
        if declared.is_some_and(|length| length > bounds.encoded) {
            return Err(too_large(bounds.encoded));
        }
        let encoded = tokio::time::timeout(bounds.time, collect(request.into_body(), bounds.encoded));
        let encoded = encoded.await.map_err(|_| {
            let detail = format!("The body did not arrive within {} s.", bounds.time.as_secs());
            Problem::new(Code::BodyTimeout, detail)
        })??;
        match encoding {
            Encoding::Identity => Ok(encoded),
            // A few bytes can decode to many, so even the smallest goes to the pool.
            _ => self.pool.document(usize::MAX, move || unpack(&encoded, encoding, bounds)).await,
        }
    }
}

#[derive(Clone, Copy)]
struct Bounds {
    encoded: u64,
    decoded: u64,
    ratio: u64,
    time: Duration,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Encoding {
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
            let mut problem = Problem::new(Code::UnsupportedMediaType, detail);
            let known = axum::http::HeaderValue::from_static("gzip, zstd");
            problem.headers.push((header::ACCEPT_ENCODING, known));
            Err(problem)
        }
    }
}

async fn collect(mut body: Body, limit: u64) -> Result<Bytes, Problem> {
    let mut bytes = Vec::new();
    while let Some(frame) = body.frame().await {
        let frame = frame.map_err(|_| Problem::new(Code::BadHeader, "The body broke off."))?;
        let Ok(data) = frame.into_data() else { continue };
        if (bytes.len() + data.len()) as u64 > limit {
            return Err(too_large(limit));
        }
        bytes.extend_from_slice(&data);
    }
    Ok(bytes.into())
}

fn too_large(limit: u64) -> Problem {
    Problem::new(Code::BodyTooLarge, format!("The body may have {limit} bytes.")).limit(limit)
}

fn unpack(encoded: &[u8], encoding: Encoding, bounds: Bounds) -> Result<Bytes, Problem> {
    let broken = |error: std::io::Error| {
        Problem::new(Code::MalformedFile, format!("The body cannot be decoded: {error}."))
            .with(|m| (m.offset, m.reason) = (Some(0), Some(error.to_string())))
    };
    let mut reader: Box<dyn Read + '_> = match encoding {
        Encoding::Zstd => {
            let mut decoder = zstd::stream::read::Decoder::new(encoded).map_err(broken)?;
            // A frame may ask for gigabytes of window; 8 MiB is what level 19 uses.
            decoder.window_log_max(23).map_err(broken)?;
            Box::new(decoder)
        }
        _ => Box::new(flate2::read::MultiGzDecoder::new(encoded)),
    };
    let mut decoded = Vec::new();
    let mut chunk = vec![0; 64 << 10];
    loop {
        let count = reader.read(&mut chunk).map_err(broken)?;
        let Some(data) = chunk.get(..count).filter(|data| !data.is_empty()) else { break };
        decoded.extend_from_slice(data);
        let size = decoded.len() as u64;
        if size > bounds.decoded {
            let detail = format!("The body may decode to {} bytes.", bounds.decoded);
            return Err(Problem::new(Code::DecodedTooLarge, detail).limit(bounds.decoded));
        }
        if size > FREE_EXPANSION && size > bounds.ratio.saturating_mul(encoded.len() as u64) {
            let detail = format!("The body may grow {} times when decoded.", bounds.ratio);
            return Err(Problem::new(Code::ExpansionTooHigh, detail).limit(bounds.ratio));
        }
    }
    Ok(decoded.into())
}

#[cfg(test)]
mod tests {
    use super::{Bounds, Encoding, unpack};
    use std::io::Write;
    use std::time::Duration;

    const BOUNDS: Bounds =
        Bounds { encoded: 1 << 20, decoded: 8 << 20, ratio: 100, time: Duration::from_secs(1) };

    fn gzip(data: &[u8]) -> Vec<u8> {
        let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::best());
        encoder.write_all(data).unwrap();
        encoder.finish().unwrap()
    }

    fn code(encoded: &[u8], encoding: Encoding) -> &'static str {
        unpack(encoded, encoding, BOUNDS).map_or_else(|p| p.code.name(), |_| "ok")
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
        let refused = unpack(&zstd::encode_all(&big[..], 1).unwrap(), Encoding::Zstd, patient);
        assert_eq!(refused.unwrap_err().code.name(), "decoded-too-large");
    }

    #[test]
    fn skippable_frames_decode_to_nothing() {
        let frame = [0x50, 0x2a, 0x4d, 0x18, 4, 0, 0, 0, 1, 2, 3, 4];
        assert_eq!(unpack(&frame, Encoding::Zstd, BOUNDS).unwrap().len(), 0);
    }
}
