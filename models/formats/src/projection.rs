//! Degrees on the globe as metres on a plane: the transverse Mercator projection about a place.

use scene::Vec2;

/// Ellipsoid of WGS 84: half its width in metres, and its flattening.
const A_M: f64 = 6_378_137.0;
const F: f64 = 1.0 / 298.257_223_563;

/// A transverse Mercator projection with scale 1 at its middle meridian, by the series of Krüger to the third order
/// (below a millimetre within hundreds of kilometres).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TransverseMercator {
    lat_deg: f64,
    lon_deg: f64,
    north_m: f64,
}

impl TransverseMercator {
    /// About the middle of these places (latitude and longitude in degrees), to whole thousandths of a degree.
    pub fn about(places: impl Iterator<Item = (f64, f64)>) -> Option<Self> {
        let corners = places.fold(None, |corners: Option<[f64; 4]>, (lat, lon)| {
            let [south, north, west, east] = corners.unwrap_or([lat, lat, lon, lon]);
            Some([south.min(lat), north.max(lat), west.min(lon), east.max(lon)])
        });
        let [south, north, west, east] = corners?;
        let whole = |a: f64, b: f64| ((a + b) / 2.0 * 1e3).round() / 1e3;
        let (lat_deg, lon_deg) = (whole(south, north), whole(west, east));
        Some(Self { lat_deg, lon_deg, north_m: project(lat_deg, 0.0).y })
    }

    /// A place in metres.
    pub fn metres(&self, lat_deg: f64, lon_deg: f64) -> Vec2 {
        project(lat_deg, lon_deg - self.lon_deg) - Vec2::new(0.0, self.north_m)
    }

    /// As PROJ has it.
    pub fn name(&self) -> String {
        format!("+proj=tmerc +lat_0={} +lon_0={} +k=1 +ellps=WGS84 +units=m", self.lat_deg, self.lon_deg)
    }
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
        let utm = project(43.642_567, -79.387_139 + 81.0) * 0.9996 + Vec2::new(500_000.0, 0.0);
        assert!((utm - Vec2::new(630_084.0, 4_833_438.0)).norm() < 1.0, "{utm:?}");
        // The quarter of a meridian on WGS 84.
        assert!((project(89.999_999_9, 0.0).y - 10_001_965.729).abs() < 0.02);
        let here = TransverseMercator::about([(48.1, 11.5)].into_iter()).unwrap();
        assert_eq!(here.metres(48.1, 11.5), Vec2::zeros());
        let east = here.metres(48.1, 11.50201393269);
        assert!((east - Vec2::new(150.0, 0.0)).norm() < 0.01, "{east:?}");
    }
}
