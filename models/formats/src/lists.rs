//! Lists with a limit: a few bytes of a document become many bytes of structs, so a document must not need
//! more than a scene can hold.

use serde::de::{Deserialize, Deserializer, Error, IgnoredAny, SeqAccess, Visitor};
use std::fmt;
use std::marker::PhantomData;

struct ListVisitor<T, const N: usize> {
    refuse: bool,
    item: PhantomData<T>,
}

impl<'de, T: Deserialize<'de>, const N: usize> Visitor<'de> for ListVisitor<T, N> {
    type Value = Vec<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Vec<T>, A::Error> {
        let mut list = Vec::new();
        while list.len() < N {
            match seq.next_element()? {
                Some(item) => list.push(item),
                None => return Ok(list),
            }
        }
        while seq.next_element::<IgnoredAny>()?.is_some() {
            if self.refuse {
                return Err(A::Error::custom(format_args!("more than {N} entries")));
            }
        }
        Ok(list)
    }
}

/// Keeps the first `N` entries; the reader refuses lists of that length with the code of their kind.
pub(crate) fn capped<'de, D: Deserializer<'de>, T: Deserialize<'de>, const N: usize>(
    deserializer: D,
) -> Result<Vec<T>, D::Error> {
    deserializer.deserialize_seq(ListVisitor::<T, N> { refuse: false, item: PhantomData })
}

/// Refuses more than `N` entries.
pub(crate) fn bounded<'de, D: Deserializer<'de>, T: Deserialize<'de>, const N: usize>(
    deserializer: D,
) -> Result<Vec<T>, D::Error> {
    deserializer.deserialize_seq(ListVisitor::<T, N> { refuse: true, item: PhantomData })
}

/// [`capped`] as a type.
pub(crate) struct Capped<T, const N: usize>(pub Vec<T>);

impl<'de, T: Deserialize<'de>, const N: usize> Deserialize<'de> for Capped<T, N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        capped::<D, T, N>(deserializer).map(Self)
    }
}
