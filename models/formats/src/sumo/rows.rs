//! FCD as a stream of rows, from XML (`fcd-export`, SUMO's default) and from CSV.

use super::SumoError;
use super::fcd::ColumnIndices;
use super::import_net::MAX_SOURCE_M;
use crate::problem::ReadError;
use crate::refusals::{self, wanted, what};
use crate::source::Source;
use crate::unpack::{self, Bounds};
use crate::xml::{self, Element, Scanner, XmlEvent};
use scene::Vec2;
use scene::message::{Message, Word};
use std::io::{BufRead, Read};

/// Most bytes of one line or tag.
const MAX_ROW: usize = 64 << 10;
/// Longest id that is read, bytes.
const MAX_ID: usize = 256;
/// Latest time, seconds.
const MAX_TIME_S: f64 = 1e9;

/// Recorded state of one road user at one time.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct FcdRow {
    pub id: String,
    /// Whether it is listed as a person; CSV lists persons among the vehicles.
    pub person: bool,
    /// Name of the vehicle type, cut at the `@` of a distribution.
    pub type_name: String,
    /// Middle of the front bumper of a vehicle, centre of a person; metres, network frame.
    pub point: Vec2,
    /// Heading, radians counter-clockwise from +x.
    pub heading_rad: f64,
    pub speed_mps: f64,
    /// Length and width, metres, if given.
    pub size_m: (Option<f64>, Option<f64>),
}

/// One item of a recording.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum FcdItem {
    /// A time step begins, at this time in seconds. Times ascend.
    Step(f64),
    Row(FcdRow),
    /// An item that a scene does not hold, such as a container, or a person inside a vehicle.
    LeftOut,
    /// A row has a height.
    Height,
}

/// Reads items one by one.
pub(super) enum FcdRows<'a> {
    Xml(XmlRows<'a>),
    Csv(FcdCsvRows<'a>),
}

impl<'a> FcdRows<'a> {
    /// Opens a file, plain or gzip, of at most `most` decoded bytes.
    ///
    /// # Errors
    /// `cannot-represent` for a file that is not FCD; the faults of its first bytes.
    pub fn open(file: &'a dyn Source, most: u64) -> Result<Self, ReadError> {
        let open = || file.open().map_err(|error| unpack::fault(&error, 0));
        let head = unpack::head(open()?);
        let input = unpack::open(open()?, Bounds::of(most)).map_err(|error| unpack::fault(&error, 0))?;
        Self::of(&head, Box::new(input))
    }

    /// Reads unpacked content that begins with `head`.
    ///
    /// # Errors
    /// `cannot-represent` for content that is not FCD.
    pub fn of(head: &[u8], input: Box<dyn BufRead + 'a>) -> Result<Self, ReadError> {
        let first = head.iter().find(|b| !b.is_ascii_whitespace() && !b"\xef\xbb\xbf".contains(b));
        if matches!(first, None | Some(b'<')) || xml::root_of(head).is_some() {
            let scanner = Scanner::new(input, MAX_ROW);
            return Ok(Self::Xml(XmlRows { scanner, root: false, time_s: None, pending: None }));
        }
        FcdCsvRows::new(input).map(Self::Csv)
    }

    /// The next item; `None` at the end.
    ///
    /// # Errors
    /// `malformed-file` for broken XML or gzip, `invalid-field` with the line for an unreadable value, the
    /// limits of a file. Nothing can be read after a fault.
    pub fn next(&mut self) -> Result<Option<FcdItem>, ReadError> {
        match self {
            Self::Xml(rows) => rows.next(),
            Self::Csv(rows) => rows.next(),
        }
    }
}

fn number(text: &str, range: (f64, f64), expected: Word, line: u32) -> Result<f64, SumoError> {
    let value = text.trim().parse::<f64>().ok().filter(|v| (range.0..=range.1).contains(v));
    value.ok_or_else(|| SumoError::value(text, expected, line))
}

fn coordinate(text: &str, line: u32) -> Result<f64, SumoError> {
    number(text, (-MAX_SOURCE_M, MAX_SOURCE_M), wanted::COORDINATE, line)
}

/// Degrees clockwise from north as radians counter-clockwise from +x.
fn heading(text: &str, line: u32) -> Result<f64, SumoError> {
    let angle_deg = number(text, (-720.0, 720.0), wanted::ANGLE, line)?;
    Ok(scene::wrap_angle((90.0 - angle_deg).to_radians()))
}

fn speed(text: &str, line: u32) -> Result<f64, SumoError> {
    number(text, (0.0, 150.0), wanted::SPEED, line)
}

fn side(text: Option<&str>, line: u32) -> Result<Option<f64>, SumoError> {
    let text = text.filter(|t| !t.is_empty());
    text.map(|t| number(t, (0.05, 500.0), wanted::SIZE, line)).transpose()
}

fn id(text: &str, line: u32) -> Result<String, SumoError> {
    if text.is_empty() || text.len() > MAX_ID {
        return Err(SumoError::value(text, wanted::ID_BYTES, line));
    }
    Ok(text.to_owned())
}

fn type_name(text: &str) -> String {
    text.split('@').next().unwrap_or_default().chars().take(MAX_ID).collect()
}

/// A time, which must be after the previous one.
fn time(text: &str, before_s: Option<f64>, line: u32) -> Result<f64, SumoError> {
    let time_s = number(text, (-MAX_TIME_S, MAX_TIME_S), wanted::TIME, line)?;
    if before_s.is_some_and(|before_s| time_s <= before_s) {
        return Err(SumoError::value(text, wanted::TIME_AFTER, line));
    }
    Ok(time_s)
}

/// Rows of `<fcd-export>`: `<timestep time>` with `<vehicle>`, `<person>`, `<container>`.
pub(super) struct XmlRows<'a> {
    scanner: Scanner<Box<dyn BufRead + 'a>>,
    root: bool,
    time_s: Option<f64>,
    pending: Option<FcdItem>,
}

impl XmlRows<'_> {
    fn next(&mut self) -> Result<Option<FcdItem>, ReadError> {
        if let Some(item) = self.pending.take() {
            return Ok(Some(item));
        }
        while let Some(event) = self.scanner.next()? {
            let XmlEvent::Start(element) = event else { continue };
            if !self.root {
                self.root = true;
                if element.name != "fcd-export" {
                    return Err(SumoError::content(refusals::tag(&element.name), wanted::FCD).into());
                }
                continue;
            }
            match element.name.as_str() {
                "timestep" => {
                    let time_s = time(element.required("time")?, self.time_s, element.line)?;
                    self.time_s = Some(time_s);
                    return Ok(Some(FcdItem::Step(time_s)));
                }
                "vehicle" | "person" if self.time_s.is_some() => {
                    if element.get("vehicle").is_some_and(|v| !v.is_empty()) {
                        return Ok(Some(FcdItem::LeftOut));
                    }
                    let row = row_of(&element)?;
                    if element.get("z").is_some() {
                        self.pending = Some(FcdItem::Row(row));
                        return Ok(Some(FcdItem::Height));
                    }
                    return Ok(Some(FcdItem::Row(row)));
                }
                "container" => return Ok(Some(FcdItem::LeftOut)),
                _ => {}
            }
        }
        Ok(None)
    }
}

fn row_of(element: &Element) -> Result<FcdRow, SumoError> {
    let line = element.line;
    let text = |attribute| element.required(attribute);
    Ok(FcdRow {
        id: id(text("id")?, line)?,
        person: element.name == "person",
        type_name: type_name(element.get("type").unwrap_or_default()),
        point: Vec2::new(coordinate(text("x")?, line)?, coordinate(text("y")?, line)?),
        heading_rad: heading(text("angle")?, line)?,
        speed_mps: speed(text("speed")?, line)?,
        size_m: (side(element.get("length"), line)?, side(element.get("width"), line)?),
    })
}

/// Rows of CSV, separated by `;`, with the columns' names in the first line.
pub(super) struct FcdCsvRows<'a> {
    input: Box<dyn BufRead + 'a>,
    groups: Vec<(bool, ColumnIndices)>,
    time: usize,
    heights: bool,
    time_s: Option<f64>,
    time_text: String,
    pending: Option<FcdItem>,
    line: u32,
    offset: u64,
}

impl<'a> FcdCsvRows<'a> {
    fn new(input: Box<dyn BufRead + 'a>) -> Result<Self, ReadError> {
        let mut rows = Self {
            input,
            groups: Vec::new(),
            time: 0,
            heights: false,
            time_s: None,
            time_text: String::new(),
            pending: None,
            line: 0,
            offset: 0,
        };
        let header = rows.read_line()?.unwrap_or_default();
        let names: Vec<&str> = header.trim_start_matches('\u{feff}').split(';').collect();
        let group = |name| ColumnIndices::find(&names, name).map(|columns| (name == "person", columns));
        rows.groups = ["vehicle", "person"].into_iter().filter_map(group).collect();
        let time = names.iter().position(|n| *n == "timestep_time");
        let (Some(time), false) = (time, rows.groups.is_empty()) else {
            return Err(SumoError::content(refusals::quoted(&header), wanted::FCD_COLUMNS).into());
        };
        rows.time = time;
        rows.heights = names.iter().any(|n| n.ends_with("_z"));
        Ok(rows)
    }

    fn read_line(&mut self) -> Result<Option<String>, ReadError> {
        let mut bytes = Vec::new();
        let read = self.input.by_ref().take(MAX_ROW as u64 + 1).read_until(b'\n', &mut bytes);
        read.map_err(|error| unpack::fault(&error, self.offset))?;
        self.line += 1;
        let (start, line) = (self.offset, self.line);
        let broken = |fault: Message| Err(ReadError::malformed(start, fault.at_line(line)));
        if bytes.len() > MAX_ROW {
            return broken(refusals::more_than(MAX_ROW, what::LINE_BYTES));
        }
        self.offset += bytes.len() as u64;
        match String::from_utf8(bytes) {
            Ok(text) if text.is_empty() => Ok(None),
            Ok(text) => Ok(Some(text.trim_end_matches(['\r', '\n']).to_owned())),
            Err(_) => broken(refusals::not_utf8(what::LINE)),
        }
    }

    fn next(&mut self) -> Result<Option<FcdItem>, ReadError> {
        loop {
            if let Some(item) = self.pending.take() {
                return Ok(Some(item));
            }
            if self.heights {
                self.heights = false;
                return Ok(Some(FcdItem::Height));
            }
            let Some(text) = self.read_line()? else { return Ok(None) };
            if text.trim().is_empty() {
                continue;
            }
            let line = self.line;
            let fields: Vec<&str> = text.split(';').collect();
            let field = |column: usize| fields.get(column).copied().unwrap_or_default();
            let found = self.groups.iter().find(|(_, columns)| !field(columns.id).is_empty());
            self.pending = match found {
                Some((person, columns)) => Some(FcdItem::Row(csv_row(*person, columns, &field, line)?)),
                None => None,
            };
            // Rows of one step repeat its time as the same text.
            let now = field(self.time);
            if self.time_s.is_none() || now != self.time_text {
                let time_s = time(now, self.time_s, line)?;
                self.time_text = now.to_owned();
                self.time_s = Some(time_s);
                return Ok(Some(FcdItem::Step(time_s)));
            }
        }
    }
}

fn csv_row<'t>(
    person: bool,
    columns: &ColumnIndices,
    field: &impl Fn(usize) -> &'t str,
    line: u32,
) -> Result<FcdRow, SumoError> {
    let optional = |column: Option<usize>| column.map(field);
    let type_name = type_name(optional(columns.kind).unwrap_or_default());
    // SUMO 1.28 writes persons in the vehicles' columns, with an edge instead of a lane.
    let walks = optional(columns.lane) == Some("") && optional(columns.edge).is_some_and(|e| !e.is_empty());
    Ok(FcdRow {
        id: id(field(columns.id), line)?,
        person: person || walks,
        type_name,
        point: Vec2::new(coordinate(field(columns.x), line)?, coordinate(field(columns.y), line)?),
        heading_rad: heading(field(columns.angle), line)?,
        speed_mps: speed(field(columns.speed), line)?,
        size_m: (side(optional(columns.length), line)?, side(optional(columns.width), line)?),
    })
}
