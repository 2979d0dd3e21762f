//! The ends of an envelope: the part of the tool that leaves at the first moment, and the part that enters at the last.
//!
//! The tool is cut in bands by parallel circles: those at which elements, curves and turns of curves begin and end, and on arcs
//! as many between as their chords need. Each is a polygon on the plane of angle and height, bounded by parts of both circles
//! and of the grazing curves, and monotone in the angle. Circles at one place share their vertices, so that an edge of the tool
//! needs no area.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DVec2, DVec3};

use super::polygon::Corner;
use super::slice::{Node, POINT, Slice, step_along, steps_around};
use super::strip::{Builder, Station};
use super::wall::Rail;
use crate::sweep::{PieceShape, ProfileChain};

/// A line of vertices around the tool: an arc of a circle, a whole one cut open, or a point.
type Ring = Vec<Station>;

/// Distance of an end of an arc from its next vertex, as a share of a step of the circle's division: without slivers.
const CLEAR: f64 = 0.2;

pub(super) struct Cap<'a> {
    pub chain: &'a ProfileChain,
    pub slice: &'a Slice,
    pub rail: &'a Rail,
    /// The entering part is wanted, else the leaving one.
    pub entering: bool,
    /// Distance of chords [mm].
    pub chord: f64,
    /// Radius of the widest circle [mm].
    pub widest: f64,
}

/// The vertices of the circle at one place.
struct Circle {
    place: DVec2,
    first: u32,
    count: u32,
}

impl Circle {
    fn step(&self) -> f64 {
        TAU / f64::from(self.count)
    }

    /// The vertices strictly between two angles.
    fn between(&self, from: f64, to: f64) -> impl Iterator<Item = Station> + '_ {
        let step = self.step();
        let first = (from / step + CLEAR).ceil() as i64;
        let last = (to / step - CLEAR).floor() as i64;
        (first..=last).map(move |k| Station {
            along: k as f64 * step,
            vertex: self.first + k.rem_euclid(i64::from(self.count)) as u32,
        })
    }
}

/// The wanted arc of the circle of a node.
#[derive(Clone, Copy)]
struct Reach {
    from: f64,
    to: f64,
    /// Vertices at its ends.
    ends: [u32; 2],
    /// It is no more than a point.
    point: bool,
    /// Height on the plane: the place along the chain.
    along: f64,
}

impl Cap<'_> {
    /// Adds the part of the tool to the mesh.
    pub(super) fn add(&self, builder: &mut Builder) {
        let pieces = self.chain.pieces();
        let mut circle: Option<Circle> = None;
        let mut last: Option<Ring> = None;
        let mut at = (0usize, pieces.first().map_or(0.0, |p| p.from));
        let mut reaches = Vec::new();
        for of in &self.slice.loops {
            let nodes = &self.slice.nodes[of.clone()];
            self.whole(builder, &mut circle, &mut last, at, nodes.first());
            let below =
                last.as_deref().and_then(|ring| Some(0.5 * (ring.first()?.along + ring.last()?.along)));
            self.reaches(nodes, &self.rail.vertices[of.clone()], below, &mut reaches);
            if let (Some(node), Some(reach)) = (nodes.first(), reaches.first()) {
                let ring = self.ring(builder, &mut circle, node, reach);
                join(builder, &mut last, ring);
            }
            let mut i = 0;
            while i + 1 < nodes.len() {
                let k = self.band(nodes, &reaches, i);
                let ring = self.ring(builder, &mut circle, &nodes[k], &reaches[k]);
                let below = last.take().unwrap_or_default();
                fill(builder, &below, &ring, &reaches[i..=k]);
                last = Some(ring);
                i = k;
            }
            if let Some(end) = nodes.last() {
                at = (end.piece as usize, end.u);
            }
        }
        self.whole(builder, &mut circle, &mut last, at, None);
    }

    /// The arcs of the nodes of a loop; each continues the turn of the one below.
    fn reaches(&self, nodes: &[Node], vertices: &[[u32; 2]], below: Option<f64>, reaches: &mut Vec<Reach>) {
        reaches.clear();
        let mut below = below;
        for (node, &[plus, minus]) in nodes.iter().zip(vertices) {
            let piece = node.piece as usize;
            let velocity = self.chain.normal_velocity(&self.slice.jet.twist, piece, node.u);
            let [psi, alpha] = node.still.unwrap_or([velocity.psi(), velocity.alpha()]);
            // A fold is a whole circle or a point, exactly.
            let alpha = match (node.one, alpha > FRAC_PI_2) {
                (true, true) => PI,
                (true, false) => 0.0,
                _ => alpha,
            };
            let (from, to, ends) = if self.entering {
                (psi - alpha, psi + alpha, [minus, plus])
            } else {
                (psi + alpha, psi - alpha + TAU, [plus, minus])
            };
            let middle = 0.5 * (from + to);
            let turns = below.map_or(0.0, |below| ((below - middle) / TAU).round() * TAU);
            below = Some(middle + turns);
            let point = self.chain.pieces()[piece].point(node.u).x < POINT || (node.one && to - from < PI);
            let [from, to] = if point { [middle; 2] } else { [from, to] }.map(|angle| angle + turns);
            reaches.push(Reach { from, to, ends, point, along: node.along });
        }
        // A point of the axis is at all angles: at those of the neighbouring arc.
        let on_axis = |node: &Node| self.chain.pieces()[node.piece as usize].point(node.u).x < POINT;
        let last = nodes.len() - 1;
        for (i, beside) in [(0, 1), (last, last - 1)] {
            if on_axis(&nodes[i]) {
                (reaches[i].from, reaches[i].to) = (reaches[beside].from, reaches[beside].to);
            }
        }
    }

    /// The last node of the band that begins at a node: on one piece, both of its sides without a turn.
    fn band(&self, nodes: &[Node], reaches: &[Reach], i: usize) -> usize {
        let index = nodes[i + 1].piece;
        let piece = &self.chain.pieces()[index as usize];
        let most = match piece.shape {
            PieceShape::Arc { radius, .. } if radius != 0.0 => step_along(radius, self.chord),
            _ => f64::INFINITY,
        };
        let start = if nodes[i].piece == index { nodes[i].u } else { piece.from };
        // Which way each side goes.
        let mut senses = [0.0f64; 2];
        let mut k = i;
        while k + 1 < nodes.len() && nodes[k + 1].piece == index {
            let ways = [reaches[k + 1].from - reaches[k].from, reaches[k + 1].to - reaches[k].to];
            let turns = (0..2).any(|s| ways[s] * senses[s] < 0.0);
            if k > i && (turns || reaches[k].point || (nodes[k + 1].u - start).abs() > most) {
                break;
            }
            for s in 0..2 {
                if ways[s] != 0.0 {
                    senses[s] = ways[s].signum();
                }
            }
            k += 1;
        }
        k
    }

    /// Whole circles from a place to the next curve or to the top, if they are wanted.
    fn whole(
        &self,
        builder: &mut Builder,
        circle: &mut Option<Circle>,
        last: &mut Option<Ring>,
        (piece, u): (usize, f64),
        next: Option<&Node>,
    ) {
        let pieces = self.chain.pieces();
        let (last_piece, last_u) = match next {
            Some(node) => (node.piece as usize, node.u),
            None => (pieces.len() - 1, pieces.last().map_or(0.0, |p| p.to)),
        };
        let middle = if last_piece == piece { 0.5 * (u + last_u) } else { 0.5 * (u + pieces[piece].to) };
        if self.enters(piece, middle) != self.entering {
            if last.is_some() && next.is_some() {
                *last = None;
            }
            return;
        }
        for i in piece..=last_piece {
            let from = if i == piece { u } else { pieces[i].from };
            let to = if i == last_piece { last_u } else { pieces[i].to };
            let parts = match pieces[i].shape {
                PieceShape::Arc { radius, .. } if radius != 0.0 => {
                    ((to - from).abs() / step_along(radius, self.chord)).ceil().max(1.0) as u32
                }
                _ => 1,
            };
            for k in 0..=parts {
                // The circles of the curves' ends are theirs.
                let first = k == 0 && i == piece && last.is_some();
                let closing = k == parts && i == last_piece && next.is_some();
                if first || closing {
                    continue;
                }
                let place = pieces[i].point(from + (to - from) * f64::from(k) / f64::from(parts));
                let begin = last.as_ref().and_then(|ring| ring.first()).map_or(0.0, |s| s.along);
                let ring = self.full(builder, circle, place, begin);
                join(builder, last, ring);
            }
        }
    }

    /// True if the tool enters on the whole circle at a parameter that has no grazing points.
    fn enters(&self, piece: usize, u: f64) -> bool {
        self.chain.normal_velocity(&self.slice.jet.twist, piece, u).mean > 0.0
    }

    /// A whole circle, cut open near an angle.
    fn full(&self, builder: &mut Builder, circle: &mut Option<Circle>, place: DVec2, begin: f64) -> Ring {
        let circle = self.circle(builder, circle, place);
        if circle.count == 1 {
            return vec![Station { along: begin + PI, vertex: circle.first }];
        }
        let begin = (begin / circle.step()).round() * circle.step();
        let slack = (CLEAR + 0.05) * circle.step();
        circle.between(begin - slack, begin + TAU + slack).collect()
    }

    /// The wanted arc of the circle of a node, divided.
    fn ring(&self, builder: &mut Builder, circle: &mut Option<Circle>, node: &Node, reach: &Reach) -> Ring {
        if reach.point {
            let mut ring = vec![Station { along: reach.from, vertex: reach.ends[0] }];
            if reach.to > reach.from {
                ring.push(Station { along: reach.to, vertex: reach.ends[0] });
            }
            return ring;
        }
        let place = self.chain.pieces()[node.piece as usize].point(node.u);
        let circle = self.circle(builder, circle, place);
        let mut ring = vec![Station { along: reach.from, vertex: reach.ends[0] }];
        ring.extend(circle.between(reach.from, reach.to));
        ring.push(Station { along: reach.to, vertex: reach.ends[1] });
        ring
    }

    /// The circle at a place: the one that is there, or a new one.
    fn circle<'c>(&self, builder: &mut Builder, circle: &'c mut Option<Circle>, place: DVec2) -> &'c Circle {
        let there = circle.as_ref().is_some_and(|c| (c.place - place).length() < POINT);
        if !there {
            // A line from a narrow circle to a wide one leaves the cone between them by up to four times what chords of the
            // narrow one do: by the square of what twice the root of the wide radius is of the sum of both roots.
            let share = 0.5 * (1.0 + (place.x / self.widest).sqrt());
            let count = if place.x < POINT { 1 } else { steps_around(place.x, self.chord * share * share) };
            let at = |k: u32| -> DVec3 {
                let turn = TAU * f64::from(k) / f64::from(count);
                self.slice.jet.pose.point((DVec2::from_angle(turn) * place.x).extend(place.y))
            };
            let first = builder.vertex(at(0));
            for k in 1..count {
                builder.vertex(at(k));
            }
            *circle = None;
            return circle.insert(Circle { place, first, count });
        }
        circle.get_or_insert(Circle { place, first: 0, count: 1 })
    }
}

/// Fills the band between two arcs; its sides are the ends of the arcs between.
fn fill(builder: &mut Builder, below: &[Station], above: &[Station], between: &[Reach]) {
    let [first, .., end] = between else { return };
    let corner = |s: &Station, along: f64| Corner { at: DVec2::new(s.along, along), vertex: s.vertex };
    let side = |reach: &Reach, side: usize| {
        let angle = if side == 0 { reach.from } else { reach.to };
        Corner { at: DVec2::new(angle, reach.along), vertex: reach.ends[side] }
    };
    let (mut lower, mut upper): (Vec<Corner>, Vec<Corner>) = (Vec::new(), Vec::new());
    let inner = &between[1..between.len() - 1];
    // A side that leans outwards bounds the band from below, else from above; it begins and ends on both lines.
    if side(end, 0).at.x <= side(first, 0).at.x {
        lower.push(side(end, 0));
        lower.extend(inner.iter().rev().map(|r| side(r, 0)));
    } else {
        upper.push(side(first, 0));
        upper.extend(inner.iter().map(|r| side(r, 0)));
    }
    lower.extend(below.iter().map(|s| corner(s, first.along)));
    upper.extend(above.iter().map(|s| corner(s, end.along)));
    if side(end, 1).at.x >= side(first, 1).at.x {
        lower.extend(inner.iter().map(|r| side(r, 1)));
        lower.push(side(end, 1));
    } else {
        upper.extend(inner.iter().rev().map(|r| side(r, 1)));
        upper.push(side(first, 1));
    }
    builder.polygon(&lower, &upper);
}

/// Joins a line to the one below.
fn join(builder: &mut Builder, last: &mut Option<Ring>, ring: Ring) {
    if let Some(below) = last {
        if is_closed(below) && is_closed(&ring) {
            *below = cut_at(below, ring[0].along);
        }
        builder.strip(below, &ring, false);
    }
    *last = Some(ring);
}

fn is_closed(ring: &[Station]) -> bool {
    ring.len() > 1 && ring.first().map(|s| s.vertex) == ring.last().map(|s| s.vertex)
}

/// A closed line, cut open at the vertex nearest to an angle.
fn cut_at(ring: &[Station], along: f64) -> Ring {
    let open = &ring[..ring.len() - 1];
    let away = |s: &Station| (s.along - along - ((s.along - along) / TAU).round() * TAU).abs();
    let nearest = (0..open.len()).min_by(|&a, &b| away(&open[a]).total_cmp(&away(&open[b]))).unwrap_or(0);
    let turns = ((along - open[nearest].along) / TAU).round() * TAU;
    let mut cut: Ring = Vec::with_capacity(ring.len());
    for k in 0..=open.len() {
        let i = nearest + k;
        let more = if i >= open.len() { TAU } else { 0.0 };
        let station = open[i % open.len()];
        cut.push(Station { along: station.along + turns + more, vertex: station.vertex });
    }
    cut
}
