//! Compressed replies for clients that accept them.

use axum::http::{HeaderMap, header};
use flate2::Compression;
use flate2::write::GzEncoder;
use std::io::Write;

/// Replies shorter than this are not compressed, bytes.
const LEAST_BYTES: usize = 1_024;
/// Suffix of the ETag of a compressed reply: two encodings of one scene are two representations (RFC 9110,
/// 8.8.3.3).
const MARK: &str = "-gzip\"";

/// Whether Accept-Encoding accepts this coding: its name, or `*`, with a weight above zero.
pub fn takes(headers: &HeaderMap, coding: &str) -> bool {
    let lines = headers.get_all(header::ACCEPT_ENCODING).iter().filter_map(|v| v.to_str().ok());
    let mut any = None;
    for item in lines.flat_map(|line| line.split(',')) {
        let mut parts = item.split(';').map(str::trim);
        let name = parts.next().unwrap_or_default();
        let weight = parts.find_map(|p| p.strip_prefix("q="));
        let wanted = weight.is_none_or(|q| q.parse::<f32>().is_ok_and(|q| q > 0.0));
        if name.eq_ignore_ascii_case(coding) {
            return wanted;
        }
        if name == "*" {
            any = Some(wanted);
        }
    }
    any.unwrap_or(false)
}

/// The compressed bytes, if the client accepts them and there are enough.
pub fn gzip(headers: &HeaderMap, bytes: &[u8]) -> Option<Vec<u8>> {
    if bytes.len() < LEAST_BYTES || !takes(headers, "gzip") {
        return None;
    }
    let mut encoder = GzEncoder::new(Vec::with_capacity(bytes.len() / 3), Compression::fast());
    encoder.write_all(bytes).ok()?;
    encoder.finish().ok()
}

/// The ETag of the compressed reply.
pub fn marked(etag: &str) -> String {
    etag.strip_suffix('"').map_or_else(|| etag.to_owned(), |tag| format!("{tag}{MARK}"))
}

/// The ETag without that suffix, whether the reply was compressed or not.
pub fn unmarked(tag: &str) -> String {
    tag.strip_suffix(MARK).map_or_else(|| tag.to_owned(), |tag| format!("{tag}\""))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a failed test panics")]
mod tests {
    use super::*;
    use std::io::Read;

    fn accepting(value: &str) -> HeaderMap {
        HeaderMap::from_iter([(header::ACCEPT_ENCODING, value.parse().unwrap())])
    }

    #[test]
    fn a_coding_is_taken_when_it_is_named() {
        for (value, taken) in [
            ("gzip, deflate, br", true),
            ("br;q=1.0, GZIP;q=0.5", true),
            ("*", true),
            ("gzip;q=0, *", false),
            ("*;q=0", false),
            ("br", false),
            ("gzip;q=high", false),
            ("", false),
        ] {
            assert_eq!(takes(&accepting(value), "gzip"), taken, "{value}");
        }
        assert!(!takes(&HeaderMap::new(), "gzip"));
    }

    #[test]
    fn what_is_compressed_reads_back() {
        let text = "scene ".repeat(1_000).into_bytes();
        let packed = gzip(&accepting("gzip"), &text).unwrap();
        let mut back = Vec::new();
        flate2::read::GzDecoder::new(packed.as_slice()).read_to_end(&mut back).unwrap();
        assert_eq!(back, text);
        assert_eq!(gzip(&accepting("gzip"), b"short"), None);
        assert_eq!(gzip(&accepting("br"), &text), None);
    }

    #[test]
    fn an_etag_keeps_its_version_under_a_mark() {
        assert_eq!(marked("\"3-ab\""), "\"3-ab-gzip\"");
        assert_eq!(unmarked("\"3-ab-gzip\""), "\"3-ab\"");
        assert_eq!(unmarked("\"3-ab\""), "\"3-ab\"");
        assert_eq!(unmarked("*"), "*");
    }
}
