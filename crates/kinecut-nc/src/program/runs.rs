//! Values of items in their order, of which long runs of neighbours follow from their first.

/// Items between two marks.
const MARK: usize = 64;

/// A value that tells those of the next items where nothing changes.
pub(super) trait Advance: Copy + PartialEq {
    /// The value of the item that comes so many items later in the same run.
    fn advanced(self, steps: u32) -> Self;
}

/// One value an item. A run of items is kept as the value of its first, so that a long program whose items are alike takes
/// next to nothing.
#[derive(Clone, Debug)]
pub(super) struct Runs<T> {
    len: usize,
    /// First item of each run, and its value.
    runs: Vec<(u32, T)>,
    /// Number of runs that begin before every sixty-fourth item: where the search for the run of an item begins.
    marks: Vec<u32>,
    /// One value for each item, once one of them was changed.
    each: Option<Vec<T>>,
}

impl<T> Default for Runs<T> {
    fn default() -> Runs<T> {
        Runs { len: 0, runs: Vec::new(), marks: Vec::new(), each: None }
    }
}

impl<T: Advance> Runs<T> {
    /// Number of items.
    pub(super) fn len(&self) -> usize {
        self.len
    }

    /// Appends the value of the next item.
    #[inline]
    pub(super) fn push(&mut self, value: T) {
        let index = self.len as u32;
        if let Some(each) = &mut self.each {
            each.push(value);
            self.len += 1;
            return;
        }
        if self.len.is_multiple_of(MARK) {
            self.marks.push(self.runs.len() as u32);
        }
        self.len += 1;
        let same = |(first, of_first): &(u32, T)| of_first.advanced(index - first) == value;
        if !self.runs.last().is_some_and(same) {
            self.runs.push((index, value));
        }
    }

    /// The value of an item.
    #[inline]
    pub(super) fn get(&self, index: usize) -> T {
        if let Some(each) = &self.each {
            return each[index];
        }
        assert!(index < self.len, "item {index} of {}", self.len);
        let (first, value) = self.runs[self.run(index)];
        value.advanced(index as u32 - first)
    }

    /// The run of an item.
    #[inline]
    fn run(&self, index: usize) -> usize {
        let mark = index / MARK;
        let from = self.marks[mark] as usize;
        let to = self.marks.get(mark + 1).map_or(self.runs.len(), |m| *m as usize);
        // The run before the mark goes on behind it unless one begins just there.
        from + self.runs[from..to].partition_point(|(first, _)| *first as usize <= index) - 1
    }

    /// The value of the last item.
    pub(super) fn last(&self) -> Option<T> {
        Some(self.get(self.len.checked_sub(1)?))
    }

    /// The first item behind the run of the one at `index`; the number of items where the run is the last.
    pub(super) fn end_of_run(&self, index: usize) -> usize {
        if self.each.is_some() {
            return index + 1;
        }
        self.runs.get(self.run(index) + 1).map_or(self.len, |(first, _)| *first as usize)
    }

    /// Gives one item another value; from then on each has its own.
    pub(super) fn set(&mut self, index: usize, value: T) {
        if self.each.is_none() {
            self.each = Some((0..self.len).map(|i| self.get(i)).collect());
            (self.runs, self.marks) = (Vec::new(), Vec::new());
        }
        if let Some(place) = self.each.as_mut().and_then(|each| each.get_mut(index)) {
            *place = value;
        }
    }

    /// Gives back the memory that was taken for items to come.
    pub(super) fn shrink_to_fit(&mut self) {
        self.runs.shrink_to_fit();
        self.marks.shrink_to_fit();
    }

    /// Bytes that it takes.
    #[cfg(test)]
    pub(super) fn bytes(&self) -> usize {
        let each = self.each.as_ref().map_or(0, Vec::capacity);
        self.runs.capacity() * size_of::<(u32, T)>() + self.marks.capacity() * 4 + each * size_of::<T>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Clone, Copy, Debug, PartialEq)]
    enum Kind {
        Counted(u32),
        Same(u8),
    }

    impl Advance for Kind {
        fn advanced(self, steps: u32) -> Kind {
            match self {
                Kind::Counted(i) => Kind::Counted(i + steps),
                same @ Kind::Same(_) => same,
            }
        }
    }

    /// Runs of many lengths, also of one and of hundreds.
    fn values() -> Vec<Kind> {
        let mut values = Vec::new();
        let mut counted = 0;
        for i in 0..300u32 {
            for _ in 0..(i * i * 7919) % [1, 3, 130][i as usize % 3] + 1 {
                values.push(if i % 2 == 0 { Kind::Counted(counted) } else { Kind::Same((i % 5) as u8) });
                counted += u32::from(i % 2 == 0);
            }
        }
        values
    }

    #[test]
    fn each_item_has_the_value_that_was_pushed() {
        let values = values();
        let mut runs = Runs::default();
        for (i, value) in values.iter().enumerate() {
            runs.push(*value);
            assert_eq!(runs.last(), Some(*value));
            assert_eq!(runs.len(), i + 1);
        }
        assert!((0..values.len()).all(|i| runs.get(i) == values[i]));
        let mut at = 0;
        while at < values.len() {
            let end = runs.end_of_run(at);
            assert!((at..end).all(|i| values[i] == values[at].advanced((i - at) as u32)));
            at = end;
        }
    }

    #[test]
    fn a_changed_value_leaves_the_others() {
        let mut values = values();
        let mut runs = Runs::default();
        values.iter().for_each(|v| runs.push(*v));
        for i in (0..values.len()).step_by(37) {
            values[i] = Kind::Same(9);
            runs.set(i, Kind::Same(9));
        }
        runs.push(Kind::Same(8));
        values.push(Kind::Same(8));
        assert!((0..values.len()).all(|i| runs.get(i) == values[i]));
    }
}
