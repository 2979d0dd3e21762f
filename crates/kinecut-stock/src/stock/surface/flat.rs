//! Flat leaves united beyond the size of a block.
//!
//! Eight neighbouring blocks, or united blocks, become one leaf if along one axis each of their four columns holds
//! one flat part, all facing the same way, over material and under void (or the reverse), and one plane is within the
//! tolerance of the end points of all four. The surface in them is then still a graph over a square.

use glam::DVec3;

use super::crossing::Lines;
use super::forest::{Content, Forest};
use super::rows::BLOCK;
use super::tree::Flat;
use crate::stock::{Axis, DexelGrid};

#[derive(Clone, Copy, Debug)]
enum FlatPart {
    Alike(bool),
    Flat(Flat),
    Other,
}

/// Memory of the parts of all blocks, and of those united of them, by the number of padded points [bytes].
pub(super) fn bytes(counts: [u64; 3]) -> u64 {
    let blocks = Forest::blocks(counts).into_iter().product::<u64>();
    // An eighth of them, an eighth of these, and so on.
    (blocks + blocks / 4) * size_of::<FlatPart>() as u64
}

/// Unites flat leaves to the largest that stay flat.
pub(super) fn merge<G: DexelGrid + ?Sized>(forest: &mut Forest, lines: &Lines<'_, G>, tolerance: f64) {
    let mut counts = forest.counts;
    let mut parts: Vec<FlatPart> = places(counts)
        .map(|p| match forest.content(p) {
            Content::Alike(solid) => FlatPart::Alike(solid),
            Content::Tree(t) => forest.trees[t as usize].flat.map_or(FlatPart::Other, FlatPart::Flat),
        })
        .collect();
    let mut size = 1;
    while counts.into_iter().max() > Some(1) {
        let get = |p: [u32; 3]| {
            let inside = (0..3).all(|i| p[i] < counts[i]);
            if inside { parts[index(counts, p)] } else { FlatPart::Alike(false) }
        };
        let above = counts.map(|n| n.div_ceil(2));
        size *= 2;
        let mut united = Vec::with_capacity(above.into_iter().product::<u32>() as usize);
        let mut any = false;
        for place in places(above) {
            let eight =
                std::array::from_fn(|n| get(std::array::from_fn(|i| 2 * place[i] + (n as u32 >> i & 1))));
            let part = unite(&eight, place, size, lines, tolerance);
            if let FlatPart::Flat(flat) = part {
                any = true;
                let number = forest.merged.len() as u32;
                forest.merged.push(flat.vertex);
                let low = place.map(|p| p * size);
                for block in places([size; 3]) {
                    if let Content::Tree(t) = forest.content(std::array::from_fn(|i| low[i] + block[i])) {
                        forest.trees[t as usize].merged = Some(number);
                    }
                }
            }
            united.push(part);
        }
        (parts, counts) = (united, above);
        if !any {
            break;
        }
    }
}

/// Eight parts as one, if they are a larger flat one or all alike.
fn unite<G: DexelGrid + ?Sized>(
    eight: &[FlatPart; 8],
    place: [u32; 3],
    size: u32,
    lines: &Lines<'_, G>,
    tolerance: f64,
) -> FlatPart {
    if let FlatPart::Alike(solid) = eight[0]
        && eight.iter().all(|p| matches!(p, FlatPart::Alike(s) if *s == solid))
    {
        return FlatPart::Alike(solid);
    }
    let Some(first) = eight.iter().find_map(|p| if let FlatPart::Flat(f) = p { Some(*f) } else { None })
    else {
        return FlatPart::Other;
    };
    let (axis, (u, v)) = (first.axis, first.axis.others());
    let mut four = [first; 4];
    for (n, flat) in four.iter_mut().enumerate() {
        let base = (n & 1) << u.index() | (n >> 1) << v.index();
        *flat = match (eight[base], eight[base | 1 << axis.index()]) {
            (FlatPart::Flat(f), FlatPart::Alike(above)) if above != f.leaving => f,
            (FlatPart::Alike(below), FlatPart::Flat(f)) if below == f.leaving => f,
            _ => return FlatPart::Other,
        };
        if flat.axis != axis || flat.leaving != first.leaving {
            return FlatPart::Other;
        }
    }
    plane(&four, axis, place, size, lines, tolerance).map_or(FlatPart::Other, FlatPart::Flat)
}

/// One plane for four flat parts, the first two along the first of `axis.others()`.
fn plane<G: DexelGrid + ?Sized>(
    four: &[Flat; 4],
    axis: Axis,
    place: [u32; 3],
    size: u32,
    lines: &Lines<'_, G>,
    tolerance: f64,
) -> Option<Flat> {
    let (u, v) = axis.others();
    let (width, half) = (f64::from(size * BLOCK), size * BLOCK / 2);
    let middle = place.map(|p| p * size * BLOCK + half);
    let (mu, mv) = (f64::from(middle[u.index()]), f64::from(middle[v.index()]));
    // Middles of the four are half a width apart.
    let h = four.map(|f| f.vertex[axis.index()]);
    let slopes = [(h[1] + h[3] - h[0] - h[2]) / width, (h[2] + h[3] - h[0] - h[1]) / width];
    let guess = four.iter().map(|f| f.height(mu, mv)).sum::<f64>() / 4.0;
    // The vertex is put on the line in the middle, where the surface is exact.
    let mut edge = middle;
    // A surface through a lattice point ends the edge below it; above the last point there is no further edge.
    let last = f64::from(lines.counts[axis.index()]) - 2.0;
    edge[axis.index()] = guess.floor().clamp(0.0, last) as u32;
    let exact = lines.crossing(axis, edge, four[0].leaving).at;
    let mut vertex = DVec3::from_array(middle.map(f64::from));
    vertex[axis.index()] = if (exact - guess).abs() <= tolerance { exact } else { guess };
    let mut flat = Flat { axis, leaving: four[0].leaving, vertex, slopes, residual: 0.0 };
    for (n, part) in four.iter().enumerate() {
        let (du, dv) = ((n & 1) as f64 - 1.0, (n >> 1) as f64 - 1.0);
        for (cu, cv) in [(0.0, 0.0), (0.5, 0.0), (0.0, 0.5), (0.5, 0.5)] {
            let (pu, pv) = (mu + (0.5 * du + cu) * width, mv + (0.5 * dv + cv) * width);
            let residual = (flat.height(pu, pv) - part.height(pu, pv)).abs() + part.residual;
            flat.residual = flat.residual.max(residual);
        }
    }
    (flat.residual <= tolerance).then_some(flat)
}

fn places(counts: [u32; 3]) -> impl Iterator<Item = [u32; 3]> {
    let [nx, ny, nz] = counts;
    (0..nz).flat_map(move |z| (0..ny).flat_map(move |y| (0..nx).map(move |x| [x, y, z])))
}

fn index(counts: [u32; 3], p: [u32; 3]) -> usize {
    ((p[2] * counts[1] + p[1]) * counts[0] + p[0]) as usize
}
