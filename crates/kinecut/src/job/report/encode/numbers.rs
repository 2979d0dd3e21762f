//! Streams of integers: variable length, differences of the order that is shortest, deflated, in base64.
//!
//! An integer is zigzag coded when it may be negative (0, -1, 1, -2 become 0, 1, 2, 3) and written seven bits a byte, low
//! bits first, high bit set when more follow (LEB128). A column of integers begins with the order of its differences: 0 for
//! the numbers themselves, 1 for each less the one before, and so on. The reader is `viewer/src/decode.ts`.

use std::io::Write as _;

use base64::Engine as _;
use flate2::{Compression, write::DeflateEncoder};

/// Greatest number of a column: its differences stay exact in JavaScript (2^53), zigzag coded as well.
pub(super) const GREATEST: i64 = 1 << 48;
/// Highest order of differences.
const HIGHEST: usize = 3;
/// Level of deflate: a higher one takes longer and saves less than one part in a hundred.
const LEVEL: u32 = 6;

/// A length in whole steps, at most [`GREATEST`]; 0 for what is not finite.
pub(super) fn steps(value: f64, step: f64) -> i64 {
    let n = (value / step).round();
    let limit = GREATEST as f64;
    if n.is_finite() { n.clamp(-limit, limit) as i64 } else { 0 }
}

pub(super) fn zigzag(n: i64) -> u64 {
    ((n << 1) ^ (n >> 63)) as u64
}

/// The bytes deflated, without head or checksum, in base64.
pub(super) fn packed(bytes: &[u8]) -> String {
    let mut deflate = DeflateEncoder::new(Vec::with_capacity(bytes.len() / 4 + 64), Compression::new(LEVEL));
    // Writing to memory cannot fail; an empty stream makes the viewer say that there is nothing to show.
    let _ = deflate.write_all(bytes);
    base64::engine::general_purpose::STANDARD.encode(deflate.finish().unwrap_or_default())
}

/// Bytes of a stream.
#[derive(Default)]
pub(super) struct Numbers(pub(super) Vec<u8>);

impl Numbers {
    pub(super) fn unsigned(&mut self, mut n: u64) {
        while n >= 0x80 {
            self.0.push(n as u8 | 0x80);
            n >>= 7;
        }
        self.0.push(n as u8);
    }

    pub(super) fn signed(&mut self, n: i64) {
        self.unsigned(zigzag(n));
    }

    /// Numbers that are alike or change evenly; their count is known to the reader.
    pub(super) fn column(&mut self, column: &[i64]) {
        let order = shortest(column);
        self.unsigned(order as u64);
        let mut last = [0; HIGHEST];
        for &n in column {
            self.signed(difference(&mut last[..order], n));
        }
    }
}

/// The difference of a number from the ones before, of the order that is the length of `last`.
fn difference(last: &mut [i64], mut n: i64) -> i64 {
    for last in last {
        (n, *last) = (n - *last, n);
    }
    n
}

/// The order of differences that takes the fewest bits.
fn shortest(column: &[i64]) -> usize {
    let mut bits = [0u64; HIGHEST + 1];
    let mut last = [0; HIGHEST];
    for &n in column {
        let mut n = n;
        bits[0] += length(n);
        for (bits, last) in bits[1..].iter_mut().zip(&mut last) {
            (n, *last) = (n - *last, n);
            *bits += length(n);
        }
    }
    (0..=HIGHEST).min_by_key(|&order| bits[order]).unwrap_or(0)
}

/// Bits of a number in zigzag code.
fn length(n: i64) -> u64 {
    u64::from(u64::BITS - zigzag(n).leading_zeros())
}

#[cfg(test)]
pub(super) mod tests {
    use std::io::Read as _;

    use super::*;

    /// The bytes of a packed text.
    pub(in super::super) fn unpacked(text: &str) -> Vec<u8> {
        let bytes = base64::engine::general_purpose::STANDARD.decode(text).unwrap();
        let mut out = Vec::new();
        flate2::read::DeflateDecoder::new(&bytes[..]).read_to_end(&mut out).unwrap();
        out
    }

    /// Reads a stream back with arithmetic of its own: powers of 128, halves for the sign, sums for differences.
    pub(in super::super) struct Reader(std::vec::IntoIter<u8>);

    impl Reader {
        pub(in super::super) fn of(bytes: Vec<u8>) -> Reader {
            Reader(bytes.into_iter())
        }

        pub(in super::super) fn unsigned(&mut self) -> i128 {
            let (mut n, mut weight) = (0i128, 1i128);
            loop {
                let byte = i128::from(self.0.next().expect("the stream goes on"));
                n += byte % 128 * weight;
                weight *= 128;
                if byte < 128 {
                    return n;
                }
            }
        }

        pub(in super::super) fn column(&mut self, count: usize) -> Vec<i128> {
            let order = self.unsigned();
            let mut column: Vec<i128> = (0..count)
                .map(|_| match self.unsigned() {
                    n if n % 2 == 0 => n / 2,
                    n => -(n + 1) / 2,
                })
                .collect();
            for _ in 0..order {
                let mut sum = 0;
                for n in &mut column {
                    sum += *n;
                    *n = sum;
                }
            }
            column
        }

        pub(in super::super) fn is_done(&self) -> bool {
            self.0.len() == 0
        }
    }

    #[test]
    fn zigzag_orders_small_numbers_first() {
        assert_eq!([0, -1, 1, -2, 2].map(zigzag), [0, 1, 2, 3, 4]);
        assert_eq!(zigzag(i64::MIN), u64::MAX);
    }

    #[test]
    fn columns_come_back_whatever_they_hold() {
        let even: Vec<i64> = (0..500).map(|i| 7 * i - 900).collect();
        let smooth: Vec<i64> = (0..500).map(|i| i * i * i - 40 * i * i).collect();
        let torn: Vec<i64> = (0..500).map(|i| if i % 2 == 0 { GREATEST } else { -GREATEST }).collect();
        let still = vec![3; 500];
        for (column, bytes) in [(even, 506), (smooth, 510), (torn, 4100), (still, 501), (Vec::new(), 1)] {
            let mut numbers = Numbers::default();
            numbers.column(&column);
            assert!(numbers.0.len() <= bytes, "{} of {bytes}", numbers.0.len());
            let packed = packed(&numbers.0);
            let mut reader = Reader::of(unpacked(&packed));
            let back = reader.column(column.len());
            assert!(reader.is_done());
            assert_eq!(back, column.iter().map(|n| i128::from(*n)).collect::<Vec<_>>());
        }
    }

    #[test]
    fn differences_stay_exact_as_doubles() {
        let mut last = [0; HIGHEST];
        let worst = (0..8).map(|i| if i % 2 == 0 { GREATEST } else { -GREATEST });
        let worst = worst.map(|n| zigzag(difference(&mut last, n))).max().unwrap();
        assert!(worst <= 1 << 53, "{worst}");
    }
}
