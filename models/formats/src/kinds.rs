//! Kinds of files that are recognised but not read: the refusal names the kind and the alternative.

use crate::problem::{FieldProblem, ReadError, code};
use crate::refusals;
use crate::{unpack, xml};

/// How a kind is recognised.
enum Mark {
    /// Bytes at an offset.
    At(usize, &'static [u8]),
    /// The root element of XML.
    Root(&'static str),
    /// Words that must all occur in a text.
    Words(&'static [&'static str]),
}

/// A kind of file.
struct Kind {
    what: &'static str,
    /// File name endings of the kind.
    ends: &'static [&'static str],
    marks: &'static [Mark],
    /// The alternative.
    instead: &'static str,
}

const UNPACK: &str = "unpack it, and import what is in it";
const PICTURE: &str = "scenes are files of data, not pictures of them";
const DRAWING: &str = "export the roads as OpenDRIVE or Lanelet2, and import that";

const KINDS: &[Kind] = &[
    Kind {
        what: "an OpenSCENARIO 2 text",
        ends: &["osc"],
        marks: &[
            Mark::Words(&["import osc.standard"]),
            Mark::Words(&["scenario ", ":\n", "do serial"]),
            Mark::Words(&["scenario ", ":\n", "do parallel"]),
        ],
        instead: "export XML 1.x",
    },
    Kind {
        what: "a list of SUMO routes",
        ends: &["rou.xml"],
        marks: &[Mark::Root("routes")],
        instead: "run SUMO with --fcd-output, and import what it writes with the network beside it",
    },
    Kind {
        what: "a SUMO configuration",
        ends: &["sumocfg", "netccfg"],
        marks: &[
            Mark::Root("configuration"),
            Mark::Root("sumoConfiguration"),
            Mark::Root("netconvertConfiguration"),
        ],
        instead: "import the network that it names, or run SUMO with --fcd-output",
    },
    Kind {
        what: "an OpenStreetMap extract in PBF",
        ends: &["osm.pbf", "pbf"],
        marks: &[Mark::At(4, b"\x0a\x09OSMHeader")],
        instead: "turn it into XML (osmium cat FILE.osm.pbf -o FILE.osm, or osmconvert FILE.osm.pbf -o=FILE.osm), and import that",
    },
    Kind {
        what: "a GeoJSON file",
        ends: &["geojson"],
        marks: &[Mark::Words(&["\"featurecollection\"", "\"features\""])],
        instead: "it has no lane graph: import the roads as OpenDRIVE, Lanelet2 or an OpenStreetMap extract, and road users as a table",
    },
    Kind { what: "a KML file", ends: &["kml"], marks: &[Mark::Root("kml")], instead: DRAWING },
    Kind {
        what: "a web page",
        ends: &["html", "htm"],
        marks: &[Mark::Root("html"), Mark::Words(&["<!doctype html"]), Mark::Words(&["<html", "<body"])],
        instead: "download the file itself",
    },
    Kind { what: "a PDF document", ends: &["pdf"], marks: &[Mark::At(0, b"%PDF-")], instead: PICTURE },
    Kind {
        what: "an AutoCAD drawing (DWG)",
        ends: &["dwg"],
        marks: &[Mark::At(0, b"AC10")],
        instead: DRAWING,
    },
    Kind {
        what: "a drawing (DXF)",
        ends: &["dxf"],
        marks: &[
            Mark::At(0, b"AutoCAD Binary DXF"),
            Mark::Words(&["SECTION", "HEADER", "$ACADVER"]),
            Mark::Words(&["SECTION", "ENTITIES", "ENDSEC"]),
        ],
        instead: DRAWING,
    },
    Kind {
        what: "a ZIP archive",
        ends: &["zip", "npz", "kmz"],
        marks: &[Mark::At(0, b"PK\x03\x04"), Mark::At(0, b"PK\x05\x06")],
        instead: UNPACK,
    },
    Kind {
        what: "a tar archive",
        ends: &["tar", "tar.gz", "tgz"],
        marks: &[Mark::At(257, b"ustar")],
        instead: UNPACK,
    },
    Kind {
        what: "a 7z archive",
        ends: &["7z"],
        marks: &[Mark::At(0, b"7z\xbc\xaf\x27\x1c")],
        instead: UNPACK,
    },
    Kind { what: "a RAR archive", ends: &["rar"], marks: &[Mark::At(0, b"Rar!\x1a\x07")], instead: UNPACK },
    Kind { what: "a file packed with bzip2", ends: &["bz2"], marks: &[Mark::At(0, b"BZh")], instead: UNPACK },
    Kind {
        what: "a file packed with xz",
        ends: &["xz"],
        marks: &[Mark::At(0, b"\xfd7zXZ\x00")],
        instead: UNPACK,
    },
    Kind {
        what: "a file packed with Zstandard",
        ends: &["zst"],
        marks: &[Mark::At(0, b"\x28\xb5\x2f\xfd")],
        instead: UNPACK,
    },
    Kind {
        what: "an HDF5 file",
        ends: &["h5", "hdf5"],
        marks: &[Mark::At(0, b"\x89HDF\r\n\x1a\n")],
        instead: "write its tracks as a table, and import that",
    },
    Kind {
        what: "an SQLite database that is neither a log nor a map of nuPlan",
        ends: &["db", "db3", "sqlite"],
        marks: &[Mark::At(0, b"SQLite format 3\x00")],
        instead: "write its tracks as a table, and import that",
    },
    Kind {
        what: "a recording of ROS (rosbag)",
        ends: &["bag"],
        marks: &[Mark::At(0, b"#ROSBAG V")],
        instead: "write its tracks as a table, and import that",
    },
    Kind {
        what: "an MCAP recording",
        ends: &["mcap"],
        marks: &[Mark::At(0, b"\x89MCAP0\r\n")],
        instead: "import the scene from which it was made",
    },
    Kind {
        what: "an array of NumPy",
        ends: &["npy"],
        marks: &[Mark::At(0, b"\x93NUMPY")],
        instead: "write it as a table, and import that",
    },
    Kind { what: "a PNG picture", ends: &["png"], marks: &[Mark::At(0, b"\x89PNG\r\n")], instead: PICTURE },
    Kind {
        what: "a JPEG picture",
        ends: &["jpg", "jpeg"],
        marks: &[Mark::At(0, b"\xff\xd8\xff")],
        instead: PICTURE,
    },
    Kind { what: "a GIF picture", ends: &["gif"], marks: &[Mark::At(0, b"GIF8")], instead: PICTURE },
    Kind { what: "an SVG picture", ends: &["svg"], marks: &[Mark::Root("svg")], instead: PICTURE },
];

/// The words of these refusals: kinds of files, and what to do instead.
pub fn words() -> [Vec<&'static str>; 2] {
    [KINDS.iter().map(|kind| kind.what).collect(), KINDS.iter().map(|kind| kind.instead).collect()]
}

/// The refusal of a file with this beginning, if it is of a known kind. `ends` are the file name endings of
/// all formats.
pub(crate) fn refusal(head: &[u8], name: &str, ends: &[&str]) -> Option<ReadError> {
    let unpacked = unpack::head(head);
    let root = xml::root_of(&unpacked);
    let text = String::from_utf8_lossy(unpacked.get(..8 << 10).unwrap_or(&unpacked));
    let lower = text.to_ascii_lowercase();
    let is = |mark: &Mark| match mark {
        Mark::At(at, bytes) => {
            [head, &unpacked].iter().any(|head| head.get(*at..).is_some_and(|rest| rest.starts_with(bytes)))
        }
        Mark::Root(name) => root.as_deref() == Some(*name),
        Mark::Words(words) => words.iter().all(|word| text.contains(*word) || lower.contains(*word)),
    };
    let kind = KINDS.iter().find(|kind| kind.marks.iter().any(is))?;
    let name = name.to_ascii_lowercase();
    let ends_so = |end: &str| name.strip_suffix(end).is_some_and(|stem| stem.ends_with('.'));
    // The longest ending is the most specific: `.net.xml` is not `.xml`.
    let others = KINDS.iter().flat_map(|kind| kind.ends).copied().chain(ends.iter().copied());
    let said = others.filter(|end| ends_so(end)).max_by_key(|end| end.len());
    let message = match said.filter(|_| !kind.ends.iter().any(|end| ends_so(end))) {
        Some(end) => refusals::other_kind_named(kind.what, kind.instead, end),
        None => refusals::other_kind(kind.what, kind.instead),
    };
    Some(FieldProblem::new("", code::FORMAT_UNKNOWN, message).into())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(head: &[u8], name: &str) -> Option<String> {
        refusal(head, name, &["xodr", "xml"]).map(|error| error.problems[0].detail.clone())
    }

    #[test]
    fn kinds_are_told_by_their_content() {
        for (head, name, expected) in [
            (&b"%PDF-1.7\n"[..], "a.pdf", "a PDF document is not read"),
            (
                b"import osc.standard.all\n\nscenario top:\n",
                "a.osc",
                "an OpenSCENARIO 2 text is not read; export XML 1.x",
            ),
            (b"SQLite format 3\0\x10", "log.db", "an SQLite database"),
            (b"PK\x03\x04\x14", "a.zip", "a ZIP archive is not read; unpack it"),
            (b"\x00\x00\x00\x0d\x0a\x09OSMHeader", "a.osm.pbf", "an OpenStreetMap extract in PBF"),
            (b"<!DOCTYPE html><html>", "a.html", "a web page"),
            (
                b"{\"type\": \"FeatureCollection\", \"features\": []}",
                "a.geojson",
                "a GeoJSON file is not read; it has no lane graph",
            ),
        ] {
            let said = said(head, name).unwrap_or_default();
            assert!(said.starts_with(expected) && !said.contains("its name"), "{said}");
        }
        assert_eq!(said(b"{\"a\": 1}", "a.json"), None);
        assert_eq!(said(b"<OpenDRIVE/>", "a.xodr"), None);
        assert_eq!(said(b"", ""), None);
    }

    #[test]
    fn a_name_that_lies_is_told() {
        let said = said(b"\x89PNG\r\n\x1a\n", "MAP.XODR").unwrap();
        assert_eq!(
            said,
            format!(
                "a PNG picture is not read; {PICTURE} (its name ends in .xodr, its content is something else)"
            )
        );
    }

    #[test]
    fn what_is_packed_is_told_by_what_is_in_it() {
        use std::io::Write;
        let mut packed = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
        let mut tar = vec![0; 512];
        tar[257..262].copy_from_slice(b"ustar");
        packed.write_all(&tar).unwrap();
        assert!(said(&packed.finish().unwrap(), "a.tar.gz").unwrap().starts_with("a tar archive"));
    }
}
