//! The order in which faces are drawn, exact for any bodies: a division of space by the planes of the faces themselves
//! (Fuchs, Kedem and Naylor 1980).
//!
//! A face whose plane parts another one cuts it; what lies behind a plane, seen from its face, is drawn before it, the rest
//! after it. Cuts are no edges: they are not drawn.

use glam::DVec3;

use super::facets::SeenFace;

/// Planes tried for each division; the one that cuts least is taken.
const TRIED: usize = 6;
/// From this number of faces on, planes through their middle are tried as well: those of a bent surface have all others on one
/// side.
const MANY: usize = 256;
/// Faces within this share of the picture's size of a plane lie in it.
const THICK: f64 = 1e-9;
/// Most pieces; what is left then is ordered by its middle.
const MOST_PIECES: usize = 40_000;

/// A face, or a piece of one, with what it belongs to.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct FacePiece {
    pub(crate) face: SeenFace,
    /// The body.
    pub(crate) body: usize,
}

/// Side of a plane that a face lies on.
enum Side {
    In,
    Behind,
    Before,
    Both,
}

/// Drawing tasks left, the last first.
enum Task {
    Divide(Vec<FacePiece>),
    Draw(Vec<FacePiece>),
}

/// The pieces in the order in which they are drawn, the farthest first; all of them face the viewer.
pub(crate) fn painted(pieces: Vec<FacePiece>, viewer: DVec3) -> Vec<FacePiece> {
    let size = pieces.iter().flat_map(|p| &p.face.outline).map(|p| p.abs().max_element()).fold(1.0, f64::max);
    let thick = THICK * size;
    let mut count = pieces.len();
    let mut done = Vec::with_capacity(pieces.len());
    let mut tasks = vec![Task::Divide(pieces)];
    while let Some(task) = tasks.pop() {
        let list = match task {
            Task::Draw(list) => {
                done.extend(list);
                continue;
            }
            Task::Divide(list) if list.len() < 2 => {
                done.extend(list);
                continue;
            }
            Task::Divide(list) => list,
        };
        let Some((normal, level)) = plane(&list, viewer, thick).filter(|_| count <= MOST_PIECES) else {
            let mut list = list;
            list.sort_by(|a, b| near(&a.face, viewer).total_cmp(&near(&b.face, viewer)));
            done.extend(list);
            continue;
        };
        let (mut within, mut behind, mut before) = (Vec::new(), Vec::new(), Vec::new());
        for piece in list {
            match side(&piece.face, normal, level, thick) {
                Side::In => within.push(piece),
                Side::Behind => behind.push(piece),
                Side::Before => before.push(piece),
                Side::Both => {
                    count += 1;
                    let parts = [-1.0, 1.0].map(|s| clipped(&piece.face, normal * s, level * s));
                    let [b, f] = parts.map(|face| FacePiece { face, body: piece.body });
                    behind.push(b);
                    before.push(f);
                }
            }
        }
        tasks.push(Task::Divide(before));
        tasks.push(Task::Draw(within));
        tasks.push(Task::Divide(behind));
    }
    done
}

/// Nearness of the middle of a face to the viewer.
fn near(face: &SeenFace, viewer: DVec3) -> f64 {
    face.outline.iter().sum::<DVec3>().dot(viewer) / face.outline.len().max(1) as f64
}

/// The plane of one of the faces, or one through their middle: of those tried, that which cuts the fewest others, and of these the
/// one with about as many before as behind. Its normal is turned to the viewer. No plane where none of those tried parts
/// anything: the normal of a sliver is rounding, and its own plane may miss it.
fn plane(list: &[FacePiece], viewer: DVec3, thick: f64) -> Option<(DVec3, f64)> {
    let mut best = None;
    let mut least = usize::MAX;
    let faces = TRIED.min(list.len());
    let mut tried = Vec::with_capacity(faces + 3);
    for n in 0..faces {
        let face = &list[n * list.len() / faces].face;
        let level = face.outline.first().map_or(0.0, |&p| face.normal.dot(p));
        tried.push((face.normal, level));
    }
    if list.len() >= MANY {
        let sum: DVec3 = list.iter().filter_map(|p| p.face.outline.first()).sum();
        let middle = sum / list.len() as f64;
        tried.extend(DVec3::AXES.map(|axis| {
            let normal = axis * axis.dot(viewer).signum();
            (normal, normal.dot(middle))
        }));
    }
    for (normal, level) in tried {
        let (mut cuts, mut behind, mut before) = (0usize, 0usize, 0usize);
        for other in list {
            match side(&other.face, normal, level, thick) {
                Side::Both => cuts += 1,
                Side::Behind => behind += 1,
                Side::Before => before += 1,
                Side::In => {}
            }
        }
        if behind.max(before) == list.len() {
            // It parts nothing, and no face lies in it.
            continue;
        }
        let price = 4 * cuts + behind.abs_diff(before) / 2;
        if price < least {
            (least, best) = (price, Some((normal, level)));
        }
    }
    best
}

fn side(face: &SeenFace, normal: DVec3, level: f64, thick: f64) -> Side {
    let (mut behind, mut before) = (false, false);
    for &p in &face.outline {
        let height = normal.dot(p) - level;
        behind |= height < -thick;
        before |= height > thick;
    }
    match (behind, before) {
        (false, false) => Side::In,
        (true, false) => Side::Behind,
        (false, true) => Side::Before,
        (true, true) => Side::Both,
    }
}

/// The part of a face above a plane; the cut is no edge.
fn clipped(face: &SeenFace, normal: DVec3, level: f64) -> SeenFace {
    let height = |p: DVec3| normal.dot(p) - level;
    let mut part = SeenFace { outline: Vec::new(), drawn: Vec::new(), normal: face.normal };
    for (i, &a) in face.outline.iter().enumerate() {
        let b = face.outline[(i + 1) % face.outline.len()];
        let (ha, hb) = (height(a), height(b));
        let cross = || a + (b - a) * (ha / (ha - hb));
        if ha >= 0.0 {
            part.outline.push(a);
            part.drawn.push(face.drawn[i]);
            if hb < 0.0 {
                part.outline.push(cross());
                part.drawn.push(false);
            }
        } else if hb > 0.0 {
            part.outline.push(cross());
            part.drawn.push(face.drawn[i]);
        }
    }
    part
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Aabb, Rigid, Solid};
    use crate::page::draw::{Facets, View};

    const VIEWER: DVec3 = DVec3::new(1.0, -1.0, 1.0);

    fn project(p: DVec3) -> [f64; 2] {
        View::isometric().px(p)
    }

    /// Faces whose planes part nothing, not even themselves, are drawn by their distance: the division ends.
    #[test]
    fn faces_that_miss_their_own_planes_are_drawn_once() {
        let sliver = |x: f64| SeenFace {
            outline: vec![
                DVec3::new(x, 0.0, 0.0),
                DVec3::new(x + 1.0, 0.0, 0.0),
                DVec3::new(x + 1.0, 1e-6, 0.0),
            ],
            drawn: vec![true; 3],
            normal: DVec3::X,
        };
        let pieces = [4.0, 0.0].map(|x| FacePiece { face: sliver(x), body: x as usize });
        let before = pieces.to_vec();
        let drawn = painted(vec![pieces[0].clone(), pieces[0].clone(), pieces[1].clone()], VIEWER);
        assert_eq!(drawn.len(), 3);
        assert!(drawn.iter().all(|p| before.contains(p)));
    }

    /// Of a sphere of many faces, of which none is behind the plane of another, each is drawn once, and no more are cut than the
    /// planes through the middle need.
    #[test]
    fn a_bent_surface_of_many_faces_is_parted_through_its_middle() {
        let ring = 60u32;
        let at = |i: u32, j: u32| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(j) / f64::from(ring)).sin_cos();
            let (r, z) = (std::f64::consts::PI * f64::from(i) / f64::from(ring)).sin_cos();
            DVec3::new(30.0 * r * cos, 30.0 * r * sin, 30.0 * z)
        };
        let corners = (0..=ring).flat_map(|i| (0..ring).map(move |j| at(i, j))).collect();
        let c = |i: u32, j: u32| i * ring + j % ring;
        let faces = (0..ring)
            .flat_map(|i| (0..ring).map(move |j| (i, j)))
            .flat_map(|(i, j)| {
                [vec![c(i, j), c(i + 1, j), c(i + 1, j + 1)], vec![c(i, j), c(i + 1, j + 1), c(i, j + 1)]]
            })
            .collect();
        let seen: Vec<SeenFace> = Facets { corners, faces }.seen(VIEWER).into_iter().map(|f| f.1).collect();
        let area = |face: &SeenFace| {
            let q: Vec<[f64; 2]> = face.outline.iter().map(|&c| project(c)).collect();
            let n = q.len();
            (0..n).map(|i| q[i][0] * q[(i + 1) % n][1] - q[(i + 1) % n][0] * q[i][1]).sum::<f64>().abs() / 2.0
        };
        let whole: f64 = seen.iter().map(area).sum();
        let count = seen.len();
        assert!(count > 3000, "{count}");
        let drawn = painted(seen.into_iter().map(|face| FacePiece { face, body: 0 }).collect(), VIEWER);
        let again: f64 = drawn.iter().map(|p| area(&p.face)).sum();
        assert!((again / whole - 1.0).abs() < 1e-9, "nothing is lost: {again} {whole}");
        assert!(drawn.len() < 2 * count, "{} of {count}", drawn.len());
    }

    /// At places of the paper the piece drawn last must be that which a ray from the viewer meets first.
    #[test]
    fn what_is_drawn_last_is_what_a_ray_meets_first() {
        let mut n = 11u64;
        let mut noise = || {
            n = n.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (n >> 11) as f64 / (1u64 << 53) as f64
        };
        // Bodies that pass through one another, turned anyhow.
        let mut pieces = Vec::new();
        for body in 0..9 {
            let solid = if body % 3 == 0 {
                Solid::Cylinder {
                    base: DVec3::ZERO,
                    radius: 20.0 + 30.0 * noise(),
                    height: 80.0 * noise() + 5.0,
                }
            } else {
                Solid::Box(Aabb { min: DVec3::ZERO, max: DVec3::new(noise(), noise(), noise()) * 90.0 + 5.0 })
            };
            let turn =
                glam::DMat3::from_euler(glam::EulerRot::ZYX, 6.0 * noise(), 6.0 * noise(), 6.0 * noise());
            let place = Rigid { rotation: turn, translation: DVec3::new(noise(), noise(), noise()) * 80.0 };
            let faces = Facets::of(&solid, &place).seen(VIEWER).into_iter().map(|f| f.1);
            pieces.extend(faces.map(|face| FacePiece { face, body }));
        }
        let whole = pieces.clone();
        let drawn = painted(pieces, VIEWER);
        assert!(drawn.len() > whole.len(), "bodies that meet are cut");
        let inside = |face: &SeenFace, p: [f64; 2]| {
            let q: Vec<[f64; 2]> = face.outline.iter().map(|&c| project(c)).collect();
            let side = |i: usize| {
                let (a, b) = (q[i], q[(i + 1) % q.len()]);
                (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
            };
            // The paper's y goes down, so that faces that are seen run the other way round.
            (0..q.len()).all(|i| side(i) < 0.0)
        };
        let depth = |face: &SeenFace, p: [f64; 2]| {
            // A point over this place of the paper, and the way along the ray to the plane of the face.
            let (sum, difference) = (p[0] / (3f64.sqrt() / 2.0), 2.0 * p[1]);
            let foot = DVec3::new(0.5 * (sum + difference), 0.5 * (sum - difference), 0.0);
            face.normal.dot(face.outline[0] - foot) / face.normal.dot(VIEWER)
        };
        let mut met = 0;
        for _ in 0..4000 {
            let p = project(DVec3::new(noise(), noise(), noise()) * 140.0);
            let first = whole
                .iter()
                .filter(|w| inside(&w.face, p))
                .max_by(|a, b| depth(&a.face, p).total_cmp(&depth(&b.face, p)));
            let last = drawn.iter().rev().find(|d| inside(&d.face, p));
            if let (Some(first), Some(last)) = (first, last) {
                met += 1;
                let apart = depth(&first.face, p) - depth(&last.face, p);
                assert!(apart.abs() < 1e-6, "{apart} {p:?}");
            }
        }
        assert!(met > 1500, "{met}");
    }
}
