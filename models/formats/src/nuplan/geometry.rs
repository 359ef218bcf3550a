//! Geometries of a GeoPackage: a header (OGC 12-128r18, 2.1.3), then well-known binary (OGC 06-103r4, 8.2).

use scene::Vec2;

/// Kinds of well-known binary, without heights.
const LINE: u32 = 2;
const POLYGON: u32 = 3;
const LINES: u32 = 5;
const POLYGONS: u32 = 6;

/// Lines and polygons of a geometry; the first ring of a polygon is its outline, the others are holes.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Geometry {
    pub lines: Vec<Vec<Vec2>>,
    pub polygons: Vec<Vec<Vec<Vec2>>>,
}

impl Geometry {
    /// The geometry of a blob; nothing for an empty or broken blob, or another kind.
    pub fn of(blob: &[u8]) -> Option<Self> {
        let (head, rest) = blob.split_at_checked(8)?;
        let flags = *head.get(3)?;
        if !head.starts_with(b"GP") || flags & 0b0011_0000 != 0 {
            return None;
        }
        let envelope = [0, 32, 48, 48, 64].get(usize::from(flags >> 1 & 0b111)).copied()?;
        let mut bytes = WkbBytes { rest: rest.get(envelope..)?, little: true };
        let mut geometry = Self::default();
        match bytes.kind()? {
            (kind @ (LINES | POLYGONS), _) => {
                for _ in 0..bytes.count()? {
                    let (part, numbers) = bytes.kind()?;
                    if part + LINES - LINE != kind {
                        return None;
                    }
                    geometry.add(&mut bytes, part, numbers)?;
                }
            }
            (kind, numbers) => geometry.add(&mut bytes, kind, numbers)?,
        }
        Some(geometry)
    }

    fn add(&mut self, bytes: &mut WkbBytes<'_>, kind: u32, numbers: usize) -> Option<()> {
        match kind {
            LINE => self.lines.push(bytes.points(numbers)?),
            POLYGON => {
                let mut rings = Vec::new();
                for _ in 0..bytes.count()? {
                    let mut ring = bytes.points(numbers)?;
                    // Rings are closed in the file, and open in a scene.
                    if ring.len() > 1 && ring.first() == ring.last() {
                        ring.pop();
                    }
                    rings.push(ring);
                }
                self.polygons.push(rings);
            }
            _ => return None,
        }
        Some(())
    }
}

/// The unread rest of a geometry.
struct WkbBytes<'a> {
    rest: &'a [u8],
    little: bool,
}

impl WkbBytes<'_> {
    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (taken, rest) = self.rest.split_first_chunk::<N>()?;
        self.rest = rest;
        let mut taken = *taken;
        if !self.little {
            taken.reverse();
        }
        Some(taken)
    }

    fn count(&mut self) -> Option<u32> {
        self.take().map(u32::from_le_bytes)
    }

    /// Kind of the geometry that begins here, and number of coordinates per point.
    fn kind(&mut self) -> Option<(u32, usize)> {
        self.little = self.take::<1>()? != [0];
        let kind = self.count()?;
        let (z, m) = match kind / 1_000 {
            0 => (false, false),
            1 => (true, false),
            2 => (false, true),
            3 => (true, true),
            _ => return None,
        };
        Some((kind % 1_000, 2 + usize::from(z) + usize::from(m)))
    }

    /// The finite points that the data contain: a count alone never allocates memory.
    fn points(&mut self, numbers: usize) -> Option<Vec<Vec2>> {
        let mut points = Vec::new();
        for _ in 0..self.count()? {
            let mut number = || self.take().map(f64::from_le_bytes);
            let point = Vec2::new(number()?, number()?);
            (2..numbers).try_for_each(|_| number().map(|_| ()))?;
            if point.x.is_finite() && point.y.is_finite() {
                points.push(point);
            }
        }
        Some(points)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn blob(flags: u8, wkb: &[u8]) -> Vec<u8> {
        [&b"GP\0"[..], &[flags, 0xe6, 0x10, 0, 0], wkb].concat()
    }

    fn numbers(values: &[f64]) -> Vec<u8> {
        values.iter().flat_map(|value| value.to_le_bytes()).collect()
    }

    #[test]
    fn lines_and_polygons_are_read_in_either_order_of_bytes() {
        let line = [&[1, 2, 0, 0, 0, 2, 0, 0, 0][..], &numbers(&[1.0, 2.0, 3.0, 4.0])].concat();
        let read = Geometry::of(&blob(1, &line)).unwrap();
        assert_eq!(read.lines, [[Vec2::new(1.0, 2.0), Vec2::new(3.0, 4.0)]]);
        let envelope = [numbers(&[0.0; 4]), line.clone()].concat();
        assert_eq!(Geometry::of(&blob(0b11, &envelope)).unwrap(), read);
        // With heights (1002), big-endian.
        let reversed = |values: &[f64]| values.iter().flat_map(|v| v.to_be_bytes()).collect::<Vec<_>>();
        let high = [&[0, 0, 0, 3, 0xea, 0, 0, 0, 2][..], &reversed(&[1.0, 2.0, 9.0, 3.0, 4.0, 9.0])].concat();
        assert_eq!(Geometry::of(&blob(0, &high)).unwrap(), read);
        let ring = numbers(&[0.0, 0.0, 4.0, 0.0, 4.0, 4.0, 0.0, 0.0]);
        let polygon = [&[1, 3, 0, 0, 0, 1, 0, 0, 0, 4, 0, 0, 0][..], &ring].concat();
        let many = [&[1, 6, 0, 0, 0, 1, 0, 0, 0][..], &polygon].concat();
        let read = Geometry::of(&blob(1, &many)).unwrap();
        assert_eq!((read.polygons.len(), read.polygons[0][0].len()), (1, 3), "rings are open");
    }

    #[test]
    fn broken_ones_are_nothing() {
        let line = [&[1, 2, 0, 0, 0, 2, 0, 0, 0][..], &numbers(&[1.0, 2.0, 3.0, 4.0])].concat();
        let whole = blob(1, &line);
        assert!((0..whole.len()).all(|end| Geometry::of(&whole[..end]).is_none()));
        assert_eq!(Geometry::of(&blob(0b1_0001, &line)), None, "an empty geometry");
        assert_eq!(Geometry::of(&blob(1, &[1, 2, 0, 0, 0, 255, 255, 255, 255])), None);
        assert_eq!(Geometry::of(&blob(1, &[1, 1, 0, 0, 0])), None, "a point");
    }
}
