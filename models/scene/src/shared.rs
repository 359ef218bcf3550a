//! Values that many scenes hold at once: maps and recordings.

use crate::ContentHash;
use serde::{Serialize, Serializer};
use std::ops::{Deref, DerefMut};
use std::sync::{Arc, OnceLock};

/// A value shared by all its clones, with its content hash, computed once for all of them. A change makes a
/// separate copy without a known hash.
#[derive(Debug, Default)]
pub struct Shared<T>(Arc<Inside<T>>);

#[derive(Debug, Default)]
struct Inside<T> {
    value: T,
    hash: OnceLock<ContentHash>,
}

impl<T: Clone> Clone for Inside<T> {
    /// A copy exists only to be changed, so it drops the hash.
    fn clone(&self) -> Self {
        Self { value: self.value.clone(), hash: OnceLock::new() }
    }
}

impl<T> Shared<T> {
    /// Whether two are clones of one value. Equal values from different sources are not.
    pub fn is_same(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl<T: Serialize> Shared<T> {
    /// Content hash: equal values have equal hashes, whatever their source.
    pub fn hash(&self) -> ContentHash {
        *self.0.hash.get_or_init(|| ContentHash::of(&self.0.value))
    }
}

impl<T> From<T> for Shared<T> {
    fn from(value: T) -> Self {
        Self(Arc::new(Inside { value, hash: OnceLock::new() }))
    }
}

impl<T> Clone for Shared<T> {
    fn clone(&self) -> Self {
        Self(Arc::clone(&self.0))
    }
}

impl<T> Deref for Shared<T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.0.value
    }
}

impl<T: Clone> DerefMut for Shared<T> {
    fn deref_mut(&mut self) -> &mut T {
        let inside = Arc::make_mut(&mut self.0);
        inside.hash.take();
        &mut inside.value
    }
}

impl<T: PartialEq> PartialEq for Shared<T> {
    fn eq(&self, other: &Self) -> bool {
        self.is_same(other) || self.0.value == other.0.value
    }
}

impl<T: Serialize> Serialize for Shared<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.value.serialize(serializer)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    #[test]
    fn a_changed_copy_has_a_hash_of_its_own_and_leaves_the_others_alone() {
        let first = Shared::from(vec![1, 2]);
        let mut second = first.clone();
        let hash = first.hash();
        assert!(second.is_same(&first) && second.hash() == hash);
        second.push(3);
        assert!(!second.is_same(&first) && second != first);
        assert_eq!((first.hash(), first.len(), second.hash()), (hash, 2, ContentHash::of(&[1, 2, 3])));
        second.pop();
        assert!(second == first && second.hash() == hash);
    }

    thread_local! {
        static WRITTEN: Cell<usize> = const { Cell::new(0) };
    }

    #[derive(Clone)]
    struct Counted;

    impl Serialize for Counted {
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            WRITTEN.set(WRITTEN.get() + 1);
            serializer.serialize_unit()
        }
    }

    #[test]
    fn the_hash_is_worked_out_once_for_all_clones() {
        let first = Shared::from(Counted);
        let clones: Vec<_> = (0..5).map(|_| first.clone()).collect();
        assert!(clones.iter().all(|clone| clone.hash() == first.hash()));
        assert_eq!(WRITTEN.get(), 1);
        // A change resets the hash, even if there is only one clone.
        let mut own = Shared::from(Counted);
        let before = own.hash();
        *own = Counted;
        assert_eq!((own.hash(), WRITTEN.get()), (before, 3));
    }
}
