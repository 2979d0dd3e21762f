//! Disjoint sets of numbers, joined two at a time.

/// Disjoint sets of the numbers from 0 on; each is known by its least member.
///
/// ```
/// # use kinecut_geom as kinecut;
/// let mut sets = kinecut::num::sets::Sets::new(4);
/// sets.join(3, 1);
/// sets.join(0, 2);
/// assert_eq!([0, 1, 2, 3].map(|n| sets.least(n)), [0, 1, 0, 1]);
/// ```
#[derive(Clone, Debug)]
pub struct Sets(Vec<u32>);

impl Sets {
    /// Each number below `count` by itself.
    pub fn new(count: usize) -> Sets {
        Sets((0..count as u32).collect())
    }

    /// Number of members of all sets.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// True if there are no numbers.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The least member of the set of a number; the ways there are halved as they are gone.
    pub fn least(&mut self, mut of: u32) -> u32 {
        while self.0[of as usize] != of {
            let above = self.0[self.0[of as usize] as usize];
            self.0[of as usize] = above;
            of = above;
        }
        of
    }

    /// Makes one set of those of two numbers.
    pub fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.least(a), self.least(b));
        self.0[a.max(b) as usize] = a.min(b);
    }
}
