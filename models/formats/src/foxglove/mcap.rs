//! The container of MCAP files (its specification, version 0): schemas and channels, messages in compressed
//! chunks, and an index after them. Optional checksums are zero.

use std::collections::BTreeMap;
use std::io;

const MAGIC: &[u8] = b"\x89MCAP0\r\n";
/// Approximate bytes of messages in a chunk.
const CHUNK: usize = 1 << 20;
#[cfg(not(target_family = "wasm"))]
const ZSTD_LEVEL: i32 = 3;
/// Name of the chunk compression in the format.
const PACKING: &str = if cfg!(target_family = "wasm") { "" } else { "zstd" };

#[cfg(not(target_family = "wasm"))]
fn pack(records: &[u8]) -> io::Result<Vec<u8>> {
    zstd::encode_all(records, ZSTD_LEVEL)
}

#[cfg(target_family = "wasm")]
fn pack(records: &[u8]) -> io::Result<Vec<u8>> {
    Ok(records.to_vec())
}

/// The bytes of a record's content.
#[derive(Default)]
struct Content(Vec<u8>);

impl Content {
    fn u16(mut self, value: u16) -> Self {
        self.0.extend(value.to_le_bytes());
        self
    }

    fn u32(mut self, value: u32) -> Self {
        self.0.extend(value.to_le_bytes());
        self
    }

    fn u64(mut self, value: u64) -> Self {
        self.0.extend(value.to_le_bytes());
        self
    }

    fn bytes(mut self, bytes: &[u8]) -> Self {
        self.0.extend(bytes);
        self
    }

    /// Adds a text, preceded by its length.
    fn text(self, text: &str) -> Self {
        self.list(text.as_bytes())
    }

    fn list(self, bytes: &[u8]) -> Self {
        self.u32(bytes.len() as u32).bytes(bytes)
    }

    fn texts(self, map: &BTreeMap<String, String>) -> Self {
        let entry = |all: Self, (key, value): (&String, &String)| all.text(key).text(value);
        let entries = map.iter().fold(Self::default(), entry);
        self.list(&entries.0)
    }

    fn numbers(self, map: impl IntoIterator<Item = (u16, u64)>) -> Self {
        let entries = map.into_iter().fold(Self::default(), |all, (key, value)| all.u16(key).u64(value));
        self.list(&entries.0)
    }

    fn record(self, opcode: u8) -> Vec<u8> {
        let mut record = vec![opcode];
        record.extend((self.0.len() as u64).to_le_bytes());
        record.extend(self.0);
        record
    }
}

/// Messages that are not written yet.
#[derive(Default)]
struct Chunk {
    records: Vec<u8>,
    times_ns: Option<(u64, u64)>,
    /// Time and offset of each message, by channel.
    places: BTreeMap<u16, Vec<(u64, u64)>>,
}

/// A file that is being written.
pub(super) struct McapWriter {
    bytes: Vec<u8>,
    /// Schemas and channels, repeated at the end of the file.
    known: Vec<u8>,
    schemas: u16,
    counts: BTreeMap<u16, u64>,
    chunk: Chunk,
    chunk_indexes: Vec<Vec<u8>>,
    times_ns: Option<(u64, u64)>,
    metadata_indexes: Vec<Vec<u8>>,
}

/// The span of times extended by one more.
fn with(times_ns: Option<(u64, u64)>, time_ns: u64) -> Option<(u64, u64)> {
    Some(times_ns.map_or((time_ns, time_ns), |(first, last)| (first.min(time_ns), last.max(time_ns))))
}

impl McapWriter {
    pub fn new(library: &str) -> Self {
        let mut bytes = MAGIC.to_vec();
        bytes.extend(Content::default().text("").text(library).record(0x01));
        Self {
            bytes,
            known: Vec::new(),
            schemas: 0,
            counts: BTreeMap::new(),
            chunk: Chunk::default(),
            chunk_indexes: Vec::new(),
            times_ns: None,
            metadata_indexes: Vec::new(),
        }
    }

    /// Bytes of the file so far.
    pub fn size(&self) -> u64 {
        self.bytes.len() as u64
    }

    /// A schema in JSON Schema.
    pub fn schema(&mut self, name: &str, data: &str) -> u16 {
        self.schemas += 1;
        let schema = Content::default().u16(self.schemas).text(name).text("jsonschema").text(data);
        self.know(schema.record(0x03));
        self.schemas
    }

    /// A topic with messages of a schema, as JSON.
    pub fn channel(&mut self, topic: &str, schema: u16) -> u16 {
        let id = self.counts.len() as u16;
        let channel = Content::default().u16(id).u16(schema).text(topic).text("json").texts(&BTreeMap::new());
        self.know(channel.record(0x04));
        self.counts.insert(id, 0);
        id
    }

    fn know(&mut self, record: Vec<u8>) {
        self.bytes.extend(&record);
        self.known.extend(record);
    }

    /// A message.
    ///
    /// # Errors
    /// Those of the compression; none is expected.
    pub fn message(&mut self, channel: u16, time_ns: u64, data: &[u8]) -> io::Result<()> {
        let count = self.counts.entry(channel).or_default();
        let message =
            Content::default().u16(channel).u32(*count as u32).u64(time_ns).u64(time_ns).bytes(data);
        *count += 1;
        let place = self.chunk.records.len() as u64;
        self.chunk.places.entry(channel).or_default().push((time_ns, place));
        self.chunk.records.extend(message.record(0x05));
        self.chunk.times_ns = with(self.chunk.times_ns, time_ns);
        self.times_ns = with(self.times_ns, time_ns);
        if self.chunk.records.len() >= CHUNK { self.end_chunk() } else { Ok(()) }
    }

    fn end_chunk(&mut self) -> io::Result<()> {
        let Chunk { records, times_ns, places } = std::mem::take(&mut self.chunk);
        let Some((first_ns, last_ns)) = times_ns else { return Ok(()) };
        let packed = pack(&records)?;
        let (start, size) = (self.bytes.len() as u64, records.len() as u64);
        let chunk = Content::default().u64(first_ns).u64(last_ns).u64(size).u32(0).text(PACKING);
        self.bytes.extend(chunk.u64(packed.len() as u64).bytes(&packed).record(0x06));
        let length = self.bytes.len() as u64 - start;
        let mut indexes = Vec::new();
        for (channel, places) in places {
            indexes.push((channel, self.bytes.len() as u64));
            let entry = |all: Content, (time_ns, place): (u64, u64)| all.u64(time_ns).u64(place);
            let places = places.into_iter().fold(Content::default(), entry);
            self.bytes.extend(Content::default().u16(channel).list(&places.0).record(0x07));
        }
        let indexes_length = self.bytes.len() as u64 - start - length;
        let index = Content::default().u64(first_ns).u64(last_ns).u64(start).u64(length).numbers(indexes);
        let index = index.u64(indexes_length).text(PACKING).u64(packed.len() as u64).u64(size);
        self.chunk_indexes.push(index.record(0x08));
        Ok(())
    }

    /// Metadata of the whole file.
    pub fn metadata(&mut self, name: &str, words: &BTreeMap<String, String>) {
        let start = self.bytes.len() as u64;
        self.bytes.extend(Content::default().text(name).texts(words).record(0x0c));
        let length = self.bytes.len() as u64 - start;
        self.metadata_indexes.push(Content::default().u64(start).u64(length).text(name).record(0x0d));
    }

    /// The file.
    ///
    /// # Errors
    /// Those of the compression; none is expected.
    pub fn finish(mut self) -> io::Result<Vec<u8>> {
        self.end_chunk()?;
        self.bytes.extend(Content::default().u32(0).record(0x0f));
        let summary = self.bytes.len() as u64;
        self.bytes.extend(&self.known);
        let (first_ns, last_ns) = self.times_ns.unwrap_or_default();
        let statistics = Content::default()
            .u64(self.counts.values().sum())
            .u16(self.schemas)
            .u32(self.counts.len() as u32)
            .u32(0)
            .u32(self.metadata_indexes.len() as u32)
            .u32(self.chunk_indexes.len() as u32)
            .u64(first_ns)
            .u64(last_ns)
            .numbers(self.counts);
        self.bytes.extend(statistics.record(0x0b));
        self.bytes.extend(self.chunk_indexes.into_iter().flatten());
        self.bytes.extend(self.metadata_indexes.into_iter().flatten());
        self.bytes.extend(Content::default().u64(summary).u64(0).u32(0).record(0x02));
        self.bytes.extend(MAGIC);
        Ok(self.bytes)
    }
}
