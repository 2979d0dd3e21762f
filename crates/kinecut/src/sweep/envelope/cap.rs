//! The ends of an envelope: the part of the tool that leaves at the first moment, and the part that enters at the last.
//!
//! The tool is cut in parallel circles: those of the nodes of the grazing curves, which give the angles at which an arc begins and
//! ends, and between the curves whole ones. Circles at one place share their vertices, so that an edge of the tool needs no area.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DVec2, DVec3};

use super::slice::{Node, POINT, Slice};
use super::strip::{Builder, Station};
use super::wall::Rail;
use crate::sweep::{PieceShape, ProfileChain};

/// A line of vertices around the tool: an arc of a circle, a whole one cut open, or a point.
type Ring = Vec<Station>;

/// How much of a step of a circle's division an end of an arc keeps from its next vertex: without slivers.
const CLEAR: f64 = 0.2;

pub(super) struct Cap<'a> {
    pub chain: &'a ProfileChain,
    pub slice: &'a Slice,
    pub rail: &'a Rail,
    /// Whether the entering part is wanted, else the leaving one.
    pub entering: bool,
    /// Distance of chords [mm].
    pub chord: f64,
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

impl Cap<'_> {
    /// Adds the part of the tool to the mesh.
    pub(super) fn add(&self, builder: &mut Builder) {
        let pieces = self.chain.pieces();
        let mut circle: Option<Circle> = None;
        let mut last: Option<Ring> = None;
        let mut at = (0usize, pieces.first().map_or(0.0, |p| p.from));
        for of in &self.slice.loops {
            self.whole(builder, &mut circle, &mut last, at, Some(&self.slice.nodes[of.start]));
            for i in of.clone() {
                let node = &self.slice.nodes[i];
                let ring = self.arc(builder, &mut circle, node, self.rail.vertices[i], last.as_deref());
                join(builder, &mut last, ring);
            }
            let end = &self.slice.nodes[of.end - 1];
            at = (end.piece as usize, end.u);
        }
        self.whole(builder, &mut circle, &mut last, at, None);
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
                    let step = (8.0 * self.chord / radius.abs()).sqrt().min(FRAC_PI_2);
                    ((to - from).abs() / step).ceil().max(1.0) as u32
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

    /// Whether the tool enters on the whole circle at a parameter that has no grazing points.
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

    /// The wanted arc of the circle of a node.
    fn arc(
        &self,
        builder: &mut Builder,
        circle: &mut Option<Circle>,
        node: &Node,
        [plus, minus]: [u32; 2],
        last: Option<&[Station]>,
    ) -> Ring {
        let piece = node.piece as usize;
        let place = self.chain.pieces()[piece].point(node.u);
        let velocity = self.chain.normal_velocity(&self.slice.jet.twist, piece, node.u);
        let [psi, alpha] = node.still.unwrap_or([velocity.psi(), velocity.alpha()]);
        // A fold is a whole circle or a point, exactly.
        let alpha = match (node.one, alpha > FRAC_PI_2) {
            (true, true) => PI,
            (true, false) => 0.0,
            _ => alpha,
        };
        let (mut from, mut to, ends) = if self.entering {
            (psi - alpha, psi + alpha, [minus, plus])
        } else {
            (psi + alpha, psi - alpha + TAU, [plus, minus])
        };
        if let Some((first, end)) = last.and_then(|ring| Some((ring.first()?, ring.last()?))) {
            // The turn that continues the circle below.
            let turns = ((0.5 * (first.along + end.along) - 0.5 * (from + to)) / TAU).round() * TAU;
            from += turns;
            to += turns;
        }
        if place.x < POINT || (node.one && to - from < PI) {
            return vec![Station { along: 0.5 * (from + to), vertex: plus }];
        }
        let circle = self.circle(builder, circle, place);
        let mut ring = vec![Station { along: from, vertex: ends[0] }];
        ring.extend(circle.between(from, to));
        ring.push(Station { along: to, vertex: ends[1] });
        ring
    }

    /// The circle at a place: the one that is there, or a new one.
    fn circle<'c>(&self, builder: &mut Builder, circle: &'c mut Option<Circle>, place: DVec2) -> &'c Circle {
        let there = circle.as_ref().is_some_and(|c| (c.place - place).length() < POINT);
        if !there {
            let count = match place.x < POINT {
                true => 1,
                false => (PI / (2.0 * self.chord / place.x).sqrt().min(FRAC_PI_2)).ceil().max(3.0) as u32,
            };
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
