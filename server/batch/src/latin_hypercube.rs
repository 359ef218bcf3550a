//! Latin hypercube samples: a range is divided into as many strata as there are draws, with one draw in each.

use scene::random::Key;

/// Rounds of the shuffle per binary digit of the count; the source proves that six suffice.
const ROUNDS_PER_DIGIT: u32 = 6;

/// Share of a range, 0 to 1, for one of `draws` draws. `key` determines the assignment of strata.
pub fn share(key: &Key, draw: u64, draws: u64) -> f64 {
    let inside = key.clone().number(draw).stream().unit();
    (place(key, draw, draws) as f64 + inside) / draws.max(1) as f64
}

/// Index of an item in a random order of `count` items, computed without the order of the others. The
/// swap-or-not shuffle of Hoang, Morris and Rogaway, "An Enciphering Scheme Based on a Card Shuffle" (2012).
fn place(key: &Key, item: u64, count: u64) -> u64 {
    let rounds = ROUNDS_PER_DIGIT * (u64::BITS - count.leading_zeros());
    (0..rounds).fold(item, |item, round| {
        let key = key.clone().text("order").number(u64::from(round));
        let sum = key.stream().below(count as usize) as u64;
        let partner = (sum + count - item) % count.max(1);
        let swaps = key.number(item.max(partner)).stream().chance(0.5);
        if swaps { partner } else { item }
    })
}

#[cfg(test)]
mod tests {
    use super::{place, share};
    use scene::random::Key;
    use std::collections::BTreeSet;

    fn order(seed: u64, count: u64) -> Vec<u64> {
        let key = Key::default().number(seed);
        (0..count).map(|item| place(&key, item, count)).collect()
    }

    #[test]
    fn every_place_is_taken_once_and_keys_give_other_orders() {
        for count in [1, 2, 3, 10, 64, 257] {
            let mut places = order(1, count);
            places.sort_unstable();
            assert_eq!(places, (0..count).collect::<Vec<_>>(), "{count}");
        }
        let orders: BTreeSet<Vec<u64>> = (0..200).map(|seed| order(seed, 4)).collect();
        assert_eq!(orders.len(), 24, "all orders of four items");
        let fixed = order(5, 200).iter().zip(0..).filter(|(place, item)| **place == *item).count();
        assert!(fixed < 8, "{fixed} of 200 items stay; one is expected");
    }

    #[test]
    fn each_stratum_has_one_draw() {
        let key = Key::default().number(3);
        let strata: BTreeSet<u64> = (0..50).map(|draw| (share(&key, draw, 50) * 50.0) as u64).collect();
        assert_eq!(strata.len(), 50);
        let random: BTreeSet<u64> =
            (0..50).map(|draw| (key.clone().number(draw).stream().unit() * 50.0) as u64).collect();
        assert!(random.len() < 45, "{} strata have a random draw", random.len());
    }
}
