//! Sobol points: each power of two of them has one point in each interval of a range, also in several
//! dimensions at once. Owen scrambling makes seeds differ with the same spread.

use scene::random::Key;

/// Binary digits of a coordinate.
const DIGITS: u32 = 32;
/// Dimensions that have their own direction numbers.
pub const DIMENSIONS: usize = DIRECTIONS.len() + 1;
/// Polynomial and first direction numbers of each dimension but the first. From Joe and Kuo, "Constructing Sobol
/// sequences with better two-dimensional projections" (2008), file `new-joe-kuo-6.21201`.
const DIRECTIONS: [(u32, &[u32]); 27] = [
    (0, &[1]),
    (1, &[1, 3]),
    (1, &[1, 3, 1]),
    (2, &[1, 1, 1]),
    (1, &[1, 1, 3, 3]),
    (4, &[1, 3, 5, 13]),
    (2, &[1, 1, 5, 5, 17]),
    (4, &[1, 1, 5, 5, 5]),
    (7, &[1, 1, 7, 11, 19]),
    (11, &[1, 1, 5, 1, 1]),
    (13, &[1, 1, 1, 3, 11]),
    (14, &[1, 3, 5, 5, 31]),
    (1, &[1, 3, 3, 9, 7, 49]),
    (13, &[1, 1, 1, 15, 21, 21]),
    (16, &[1, 3, 1, 13, 27, 49]),
    (19, &[1, 1, 1, 15, 7, 5]),
    (22, &[1, 3, 1, 15, 13, 25]),
    (25, &[1, 1, 5, 5, 19, 61]),
    (1, &[1, 3, 7, 11, 23, 15, 103]),
    (4, &[1, 3, 7, 13, 13, 15, 69]),
    (7, &[1, 1, 3, 13, 7, 35, 63]),
    (8, &[1, 3, 5, 9, 1, 25, 53]),
    (14, &[1, 3, 1, 13, 9, 35, 107]),
    (19, &[1, 3, 1, 5, 27, 61, 31]),
    (21, &[1, 1, 5, 11, 19, 41, 61]),
    (28, &[1, 3, 5, 3, 3, 13, 69]),
    (31, &[1, 1, 7, 13, 1, 19, 1]),
];

/// Share of a range for a point in a dimension, between 0 and 1 exclusive. `key` determines the scrambling of
/// the dimension.
pub fn share(key: &Key, dimension: usize, point: u64) -> f64 {
    let digits = scrambled(coordinate(dimension, point), key);
    (f64::from(digits) + 0.5) / 2_f64.powi(DIGITS as i32)
}

/// Coordinate of a point as a binary fraction. Points beyond 2^32 and dimensions beyond the table wrap
/// around.
fn coordinate(dimension: usize, point: u64) -> u32 {
    let directions = directions(dimension % DIMENSIONS);
    let of_point = directions.iter().enumerate().filter(|(digit, _)| point >> digit & 1 == 1);
    of_point.fold(0, |sum, (_, direction)| sum ^ direction)
}

/// Direction numbers of a dimension as binary fractions: one per binary digit of the point's number.
fn directions(dimension: usize) -> [u32; DIGITS as usize] {
    let mut all = [0; DIGITS as usize];
    // The first dimension reverses the digits of the number.
    let (polynomial, first) = dimension.checked_sub(1).map_or((0, &[][..]), |row| DIRECTIONS[row]);
    let degree = first.len();
    for i in 0..all.len() {
        all[i] = match first.get(i) {
            Some(number) => number << (DIGITS as usize - 1 - i),
            None if degree == 0 => 1 << (DIGITS as usize - 1 - i),
            None => {
                let own = all[i - degree] ^ (all[i - degree] >> degree);
                let terms = (1..degree).filter(|term| polynomial >> (degree - 1 - term) & 1 == 1);
                terms.fold(own, |sum, term| sum ^ all[i - term])
            }
        };
    }
    all
}

/// Nested uniform scrambling: each digit is flipped at random, depending on the digits before it. Owen,
/// "Randomly permuted (t,m,s)-nets and (t,s)-sequences" (1995).
fn scrambled(digits: u32, key: &Key) -> u32 {
    (0..DIGITS).fold(0, |out, digit| {
        let before = u64::from(digits) >> (DIGITS - digit);
        let flip = key.clone().number(u64::from(digit)).number(before).stream().chance(0.5);
        let own = digits >> (DIGITS - 1 - digit) & 1;
        out << 1 | (own ^ u32::from(flip))
    })
}

#[cfg(test)]
mod tests {
    use super::{DIGITS, DIMENSIONS, coordinate, share};
    use scene::random::Key;
    use std::collections::BTreeSet;

    /// Scrambled points, one per row.
    fn points(seed: u64, count: u64, dimensions: usize) -> Vec<Vec<f64>> {
        let of = |point| move |d: usize| share(&Key::default().number(seed).number(d as u64), d, point);
        (0..count).map(|point| (0..dimensions).map(of(point)).collect()).collect()
    }

    fn random(seed: u64, count: u64, dimensions: usize) -> Vec<Vec<f64>> {
        let mut stream = Key::default().number(seed).stream();
        (0..count).map(|_| (0..dimensions).map(|_| stream.unit()).collect()).collect()
    }

    /// Number of boxes with a point, if two dimensions are cut into 2^a and 2^b intervals.
    fn boxes(points: &[Vec<f64>], a: i32, b: i32) -> usize {
        let of = |point: &Vec<f64>| ((point[0] * 2_f64.powi(a)) as u64, (point[1] * 2_f64.powi(b)) as u64);
        points.iter().map(of).collect::<BTreeSet<_>>().len()
    }

    /// Root mean square, over all boxes from the origin, of the share of points in a box minus its volume.
    /// Warnock, "Computational investigations of low-discrepancy point sets" (1972).
    fn discrepancy(points: &[Vec<f64>]) -> f64 {
        let n = points.len() as f64;
        let product = |f: &dyn Fn(usize) -> f64| (0..points[0].len()).map(f).product::<f64>();
        let single: f64 = points.iter().map(|x| product(&|d| (1.0 - x[d] * x[d]) / 2.0)).sum();
        let pairs: f64 = points
            .iter()
            .flat_map(|x| points.iter().map(move |y| (x, y)))
            .map(|(x, y)| product(&|d| 1.0 - x[d].max(y[d])))
            .sum();
        (3_f64.powi(-(points[0].len() as i32)) - 2.0 / n * single + pairs / (n * n)).sqrt()
    }

    #[test]
    fn the_first_points_are_those_of_the_source() {
        let row = |point| -> Vec<f64> {
            (0..3).map(|d| f64::from(coordinate(d, point)) / 2_f64.powi(DIGITS as i32)).collect()
        };
        assert_eq!([row(0), row(1)], [[0.0; 3], [0.5; 3]]);
        assert_eq!([row(2), row(3)], [[0.25, 0.75, 0.75], [0.75, 0.25, 0.25]]);
        assert_eq!(row(4), [0.125, 0.625, 0.375]);
    }

    #[test]
    fn each_dimension_has_one_point_in_each_interval() {
        let (sobol, random) = (points(7, 64, DIMENSIONS), random(7, 64, DIMENSIONS));
        let strata = |points: &[Vec<f64>], d: usize| {
            points.iter().map(|point| (point[d] * 64.0) as u64).collect::<BTreeSet<_>>().len()
        };
        for dimension in 0..DIMENSIONS {
            assert_eq!(strata(&sobol, dimension), 64, "{dimension}");
            assert!(strata(&random, dimension) < 60);
        }
    }

    #[test]
    fn two_dimensions_have_one_point_in_each_box_of_equal_size() {
        let (sobol, random) = (points(1, 64, 2), random(1, 64, 2));
        for a in 0..=6 {
            assert_eq!(boxes(&sobol, a, 6 - a), 64, "2^{a} intervals of the first dimension");
            assert!(boxes(&random, a, 6 - a) < 60);
        }
    }

    #[test]
    fn points_spread_better_than_random_ones_whatever_the_seed() {
        for seed in 0..5 {
            let (sobol, random) = (discrepancy(&points(seed, 256, 3)), discrepancy(&random(seed, 256, 3)));
            assert!(sobol < 0.5 * random, "seed {seed}: {sobol} beside {random}");
        }
        assert_ne!(points(1, 4, 2), points(2, 4, 2));
    }
}
