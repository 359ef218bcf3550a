//! Converts degrees on the globe to metres on a plane: the transverse Mercator projection about a point.

use scene::Vec2;

/// Ellipsoid of WGS 84: half its width in metres, and its flattening.
const A_M: f64 = 6_378_137.0;
const F: f64 = 1.0 / 298.257_223_563;
/// Scale of UTM at the middle of its zones.
const UTM_SCALE: f64 = 0.9996;

/// Metres of a degree of latitude, about, and steps from metres to degrees.
const DEGREE_M: f64 = 111_200.0;
const INVERSE_STEPS: usize = 12;
/// Degrees within this distance of 0, 0, where there is no land, are metres of a local frame that a tool
/// converted with UTM.
const NO_LAND_DEG: f64 = 0.2;
/// The meridian of the zone of UTM at 0, 0.
const NO_LAND_LON_DEG: f64 = 3.0;

/// A transverse Mercator projection, by the series of Krüger to the third order (below a millimetre within hundreds of
/// kilometres).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TransverseMercator {
    lat_deg: f64,
    lon_deg: f64,
    /// At the middle meridian.
    scale: f64,
    /// Coordinates of the origin in the projection, metres.
    origin: Vec2,
}

impl TransverseMercator {
    /// A projection about the middle of these positions (latitude and longitude in degrees), rounded to 0.001
    /// degrees.
    pub fn about(places: impl Iterator<Item = (f64, f64)>) -> Option<Self> {
        let corners = places.fold(None, |corners: Option<[f64; 4]>, (lat, lon)| {
            let [south, north, west, east] = corners.unwrap_or([lat, lat, lon, lon]);
            Some([south.min(lat), north.max(lat), west.min(lon), east.max(lon)])
        });
        let [south, north, west, east] = corners?;
        let whole = |a: f64, b: f64| ((a + b) / 2.0 * 1e3).round() / 1e3;
        let (lat_deg, lon_deg) = (whole(south, north), whole(west, east));
        Some(Self { lat_deg, lon_deg, scale: 1.0, origin: project(lat_deg, 0.0) })
    }

    /// The projection whose metres were stored as degrees near 0, 0; nothing for degrees elsewhere.
    pub fn of_no_land(mut places: impl Iterator<Item = (f64, f64)>) -> Option<Self> {
        let near = places.all(|(lat, lon)| lat.abs() <= NO_LAND_DEG && lon.abs() <= NO_LAND_DEG);
        let origin = project(0.0, -NO_LAND_LON_DEG) * UTM_SCALE;
        near.then_some(Self { lat_deg: 0.0, lon_deg: NO_LAND_LON_DEG, scale: UTM_SCALE, origin })
    }

    /// A position in metres.
    pub fn metres(&self, lat_deg: f64, lon_deg: f64) -> Vec2 {
        project(lat_deg, lon_deg - self.lon_deg) * self.scale - self.origin
    }

    /// The projection with a name: one that [`Self::name`] gives, or a UTM zone.
    pub fn named(name: &str) -> Option<Self> {
        if let Some(zone) = UtmZone::named(name) {
            return Some(zone.projection());
        }
        let (lat_deg, lon_deg) = (value(name, "lat_0")?, value(name, "lon_0")?);
        let plain =
            name.contains("+proj=tmerc") && value(name, "k") == Some(1.0) && value(name, "x_0").is_none();
        plain.then(|| Self { lat_deg, lon_deg, scale: 1.0, origin: project(lat_deg, 0.0) })
    }

    /// Latitude and longitude in degrees of a position in metres.
    pub fn degrees(&self, p: Vec2) -> (f64, f64) {
        let (mut lat, mut lon) = (self.lat_deg, self.lon_deg);
        // Each step reduces the error to less than a hundredth.
        for _ in 0..INVERSE_STEPS {
            let left = p - self.metres(lat, lon);
            lat = (lat + left.y / DEGREE_M).clamp(-89.0, 89.0);
            lon += left.x / (DEGREE_M * lat.to_radians().cos());
        }
        (lat, lon)
    }

    /// Whether the metres belong to a position on the globe.
    pub fn has_place(&self) -> bool {
        self.origin.x == 0.0
    }

    /// Name in the form of PROJ.
    pub fn name(&self) -> String {
        format!("+proj=tmerc +lat_0={} +lon_0={} +k=1 +ellps=WGS84 +units=m", self.lat_deg, self.lon_deg)
    }
}

/// A zone of UTM on WGS 84.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct UtmZone {
    /// 1 to 60.
    number: u32,
    south: bool,
}

impl UtmZone {
    /// The zone with this EPSG code; nothing for a code of another projection.
    pub fn of_epsg(code: u32) -> Option<Self> {
        let (south, number) = (code / 100 == 327, code % 100);
        ((code / 100 == 326 || south) && (1..=60).contains(&number)).then_some(Self { number, south })
    }

    /// The zone of a position (latitude and longitude in degrees), with the exceptions of Norway and
    /// Svalbard.
    pub fn at(lat_deg: f64, lon_deg: f64) -> Self {
        let whole = ((lon_deg + 180.0) / 6.0).floor().rem_euclid(60.0) as u32 + 1;
        let number = match (lat_deg, lon_deg) {
            (56.0..64.0, 3.0..12.0) => 32,
            (72.0..=84.0, 0.0..9.0) => 31,
            (72.0..=84.0, 9.0..21.0) => 33,
            (72.0..=84.0, 21.0..33.0) => 35,
            (72.0..=84.0, 33.0..42.0) => 37,
            _ => whole,
        };
        Self { number, south: lat_deg < 0.0 }
    }

    /// The zone of a name such as [`Self::name`] gives.
    fn named(name: &str) -> Option<Self> {
        let number = value(name, "zone").filter(|number| (1.0..=60.0).contains(number))?;
        name.contains("+proj=utm").then_some(Self { number: number as u32, south: name.contains("+south") })
    }

    fn projection(self) -> TransverseMercator {
        let north_m = if self.south { 10_000_000.0 } else { 0.0 };
        let lon_deg = f64::from(self.number) * 6.0 - 183.0;
        let origin = -Vec2::new(500_000.0, north_m);
        TransverseMercator { lat_deg: 0.0, lon_deg, scale: UTM_SCALE, origin }
    }

    /// A place in metres.
    pub fn metres(self, lat_deg: f64, lon_deg: f64) -> Vec2 {
        self.projection().metres(lat_deg, lon_deg)
    }

    /// Name in the form of PROJ.
    pub fn name(self) -> String {
        let south = if self.south { " +south" } else { "" };
        format!("+proj=utm +zone={}{south} +datum=WGS84 +units=m", self.number)
    }
}

/// A number in the name of a projection.
fn value(name: &str, key: &str) -> Option<f64> {
    let pair =
        name.split_whitespace().find_map(|part| part.strip_prefix('+')?.strip_prefix(key)?.strip_prefix('='));
    pair?.parse().ok().filter(|value: &f64| value.is_finite())
}

/// Metres east of a meridian and north of the equator.
fn project(lat_deg: f64, east_deg: f64) -> Vec2 {
    let n = F / (2.0 - F);
    let rectified_m = A_M / (1.0 + n) * (1.0 + n * n / 4.0 + n.powi(4) / 64.0);
    let alpha = [
        n / 2.0 - 2.0 / 3.0 * n * n + 5.0 / 16.0 * n.powi(3),
        13.0 / 48.0 * n * n - 3.0 / 5.0 * n.powi(3),
        61.0 / 240.0 * n.powi(3),
    ];
    let (lat, lon) = (lat_deg.to_radians(), east_deg.to_radians());
    let e = 2.0 * n.sqrt() / (1.0 + n);
    let t = (lat.sin().atanh() - e * (e * lat.sin()).atanh()).sinh();
    let (xi, eta) = (t.atan2(lon.cos()), (lon.sin() / (1.0 + t * t).sqrt()).atanh());
    let mut p = Vec2::new(eta, xi);
    for (i, a) in alpha.iter().enumerate() {
        let k = 2.0 * (i as f64 + 1.0);
        p += Vec2::new((k * xi).cos() * (k * eta).sinh(), (k * xi).sin() * (k * eta).cosh()) * *a;
    }
    p * rectified_m
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_where_utm_has_them() {
        // The tower of Toronto: zone 17, 630084 m east, 4833438 m north.
        let utm = UtmZone::of_epsg(32_617).unwrap().metres(43.642_567, -79.387_139);
        assert!((utm - Vec2::new(630_084.0, 4_833_438.0)).norm() < 1.0, "{utm:?}");
        let south = UtmZone::of_epsg(32_717).unwrap();
        assert!((south.metres(0.0, -81.0) - Vec2::new(500_000.0, 10_000_000.0)).norm() < 1e-6);
        assert!(south.name().contains("+zone=17 +south") && UtmZone::of_epsg(4326).is_none());
        for (lat, lon, epsg) in [
            (50.78, 6.07, 32_632),
            (-33.9, 151.2, 32_756),
            (60.4, 5.3, 32_632),
            (78.2, 15.6, 32_633),
            (0.0, 180.0, 32_601),
            (0.0, -180.0, 32_601),
        ] {
            assert_eq!(Some(UtmZone::at(lat, lon)), UtmZone::of_epsg(epsg), "{lat} {lon}");
        }
        // The quarter of a meridian on WGS 84.
        assert!((project(89.999_999_9, 0.0).y - 10_001_965.729).abs() < 0.02);
        let zone = UtmZone::of_epsg(32_632).unwrap();
        for name in [zone.name(), "+proj=tmerc +lat_0=48.1 +lon_0=11.5 +k=1 +ellps=WGS84 +units=m".into()] {
            let projection = TransverseMercator::named(&name).unwrap();
            let there = projection.metres(48.2, 11.6);
            let (lat, lon) = projection.degrees(there);
            assert!((lat - 48.2).abs().max((lon - 11.6).abs()) < 1e-9, "{name}: {lat} {lon}");
        }
        assert!(TransverseMercator::named("+proj=lcc +lat_0=1 +lon_0=2").is_none());
        let here = TransverseMercator::about([(48.1, 11.5)].into_iter()).unwrap();
        assert_eq!(here.metres(48.1, 11.5), Vec2::zeros());
        // As the tools of Lanelet2 write x 1000, y 500 about 0, 0.
        let local = TransverseMercator::of_no_land([(0.004_523, 0.008_974)].into_iter()).unwrap();
        assert!(local.metres(0.0, 0.0).norm() < 1e-9 && !local.has_place());
        let utm = UtmZone::of_epsg(32_631).unwrap();
        let expected = utm.metres(0.004_523, 0.008_974) - utm.metres(0.0, 0.0);
        assert!((local.metres(0.004_523, 0.008_974) - expected).norm() < 1e-9, "{expected}");
        assert!(TransverseMercator::of_no_land([(0.0, 0.0), (48.1, 11.5)].into_iter()).is_none());
        let east = here.metres(48.1, 11.50201393269);
        assert!((east - Vec2::new(150.0, 0.0)).norm() < 0.01, "{east:?}");
    }
}
