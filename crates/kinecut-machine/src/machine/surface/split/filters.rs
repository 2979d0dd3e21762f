//! Elements of a chain that may go into the tool.
//!
//! The tool may take every set of elements that can be brought to the tool end by changing places: the up-closed sets
//! (filters) of the order of dependence, in which i is before j when i precedes j in the chain and the two do not
//! commute. The ends of the chain (its suffixes) are only some of them.

use super::super::ChainElement;

/// All filters as rising indices of the elements in the tool; those of few elements first.
pub fn filters(chain: &[ChainElement]) -> Vec<Vec<usize>> {
    let n = chain.len();
    // Elements that must be in the tool when this one is, as bits.
    let needs: Vec<u32> = (0..n)
        .map(|i| {
            let later = i + 1..n;
            later.filter(|&j| !chain[i].motion.commutes(chain[j].motion)).fold(0, |mask, j| mask | 1 << j)
        })
        .collect();
    let closed = |mask: u32| (0..n).all(|i| mask >> i & 1 == 0 || mask & needs[i] == needs[i]);
    let mut found: Vec<Vec<usize>> = (0..1_u32 << n)
        .filter(|&mask| closed(mask))
        .map(|mask| (0..n).filter(|i| mask >> i & 1 == 1).collect())
        .collect();
    found.sort_by(|a, b| a.len().cmp(&b.len()).then_with(|| a.cmp(b)));
    found
}

#[cfg(test)]
mod tests {
    use super::super::super::parse_chain;
    use super::*;

    /// The cylinder has more than its four suffixes: the overhang, or the circle, can be built into the tool.
    #[test]
    fn tools_take_what_can_be_brought_to_their_end() {
        let chain = parse_chain("6(phi) 1(R) 3(z)").unwrap();
        let wanted: [&[usize]; 6] = [&[], &[1], &[2], &[0, 1], &[1, 2], &[0, 1, 2]];
        assert_eq!(filters(&chain), wanted);
    }
}
