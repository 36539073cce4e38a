//! Things that are kept for the next picture, until there are too many. What they are is the cache's affair.

use std::collections::HashMap;
use std::hash::Hash;

/// Things by key, each with what it weighs. When they weigh too much, those go first that were not used for longest.
#[derive(Debug)]
pub(crate) struct Kept<K, V> {
    entries: HashMap<K, Entry<V>>,
    limit: u64,
}

#[derive(Debug)]
struct Entry<V> {
    value: V,
    weight: u64,
    /// The picture that used it last.
    used: u64,
}

impl<K: Eq + Hash + Clone, V> Kept<K, V> {
    /// Keeps things up to this weight in all.
    pub(crate) fn new(limit: u64) -> Self {
        Kept { entries: HashMap::new(), limit }
    }

    /// What is kept under a key, used by this picture; made when it is not there. `make` gives it with its weight.
    pub(crate) fn get<E>(
        &mut self,
        key: K,
        picture: u64,
        make: impl FnOnce() -> Result<(V, u64), E>,
    ) -> Result<&mut V, E> {
        use std::collections::hash_map::Entry as Place;
        let entry = match self.entries.entry(key) {
            Place::Occupied(known) => known.into_mut(),
            Place::Vacant(place) => {
                let (value, weight) = make()?;
                place.insert(Entry { value, weight, used: picture })
            }
        };
        entry.used = picture;
        Ok(&mut entry.value)
    }

    /// Forgets what is too much, the oldest first, but nothing that this picture used.
    pub(crate) fn trim(&mut self, picture: u64) {
        let mut weight: u64 = self.entries.values().map(|entry| entry.weight).sum();
        if weight <= self.limit {
            return;
        }
        let mut by_age: Vec<(u64, u64, K)> =
            self.entries.iter().map(|(key, entry)| (entry.used, entry.weight, key.clone())).collect();
        by_age.sort_by_key(|(used, ..)| *used);
        for (used, its_weight, key) in by_age {
            if weight <= self.limit || used == picture {
                return;
            }
            self.entries.remove(&key);
            weight -= its_weight;
        }
    }

    /// How many there are.
    #[cfg(test)]
    fn len(&self) -> usize {
        self.entries.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn get(kept: &mut Kept<u32, u32>, key: u32, picture: u64) -> bool {
        let mut made = false;
        let Ok::<_, ()>(value) = kept.get(key, picture, || {
            made = true;
            Ok((key * 10, 1))
        }) else {
            panic!("it is made");
        };
        assert_eq!(*value, key * 10);
        made
    }

    #[test]
    fn the_oldest_go_and_what_is_in_use_stays() {
        let mut kept = Kept::new(2);
        for (picture, key) in [(1, 1), (2, 2), (3, 1), (4, 3)] {
            get(&mut kept, key, picture);
            kept.trim(picture);
        }
        assert_eq!(kept.len(), 2);
        assert!(!get(&mut kept, 1, 5), "used by picture 3");
        assert!(get(&mut kept, 2, 5), "forgotten for 3");
        // All three are used by one picture: more than the limit, and none is forgotten.
        get(&mut kept, 3, 5);
        kept.trim(5);
        assert_eq!(kept.len(), 3);
        kept.trim(6);
        assert_eq!(kept.len(), 2);
    }
}
