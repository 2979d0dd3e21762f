//! The grazing curves at one moment as points, in workpiece coordinates.
//!
//! A curve is a chain of nodes along the profile, each with its two points on one parallel circle. Where the chain ends at a
//! circle that grazes as a whole, the half of it on which the tool would enter, were it to yield by anything, closes the curve:
//! zero counts as leaving.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::ops::Range;

use glam::{DVec2, DVec3};

use crate::sweep::twist::clean;
use crate::sweep::{
    ChainPiece, Grazing, GrazingPoint, GrazingSpan, Motion, MotionJet, PieceShape, ProfileChain, SegmentKind,
};

/// One parallel circle with its two points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    /// Piece of the chain.
    pub piece: u32,
    /// Parameter on the piece.
    pub u: f64,
    /// Place along the chain: the piece, and the part of it.
    pub along: f64,
    /// Place along each branch of the curve: its stretch, and the part of it; on an edge the part of its way, else that of the
    /// profile.
    pub place: [f64; 2],
    /// Points of the plus and the minus branch [workpiece].
    pub points: [DVec3; 2],
    /// Both are one: a fold, or a point of the axis.
    pub one: bool,
    /// Middle and half of the ingress angle on a circle that grazes as a whole.
    pub still: Option<[f64; 2]>,
}

/// Fineness of the division of a slice.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fineness {
    /// Distance of chords from the curve [mm].
    pub chord: f64,
    /// Time to the next slice: longer steps along a curve that turns meanwhile make warped cells.
    pub step: f64,
    /// Distance of chords of the tool's faces that it bounds [mm]; infinite where it bounds none.
    pub cap: f64,
}

/// All grazing curves at one moment.
#[derive(Clone, Debug)]
pub(super) struct Slice {
    pub t: f64,
    pub jet: MotionJet,
    pub nodes: Vec<Node>,
    /// Ranges of nodes, in order along the chain.
    pub loops: Vec<Range<usize>>,
    /// Stretches of each loop: equal where places along two curves mean the same.
    pub kinds: Vec<Vec<(usize, [End; 2])>>,
}

/// End of a stretch of a span.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    /// The curve goes on.
    Open,
    /// A fold, or the axis.
    Closed,
    /// A circle that grazes as a whole.
    Still,
}

/// Part of a span between circles that graze as a whole.
struct Stretch<'a> {
    span: &'a GrazingSpan,
    /// Place along the curve.
    order: f64,
    parts: [f64; 2],
    ends: [End; 2],
}

/// Parts of a span before the first halving.
const FIRST: u32 = 2;
/// Most halvings between two nodes.
const DEEPEST: u32 = 14;
/// Distance of a circle from the end of a span that it ends, by the length of the span.
const AT_END: f64 = 1e-9;
/// Radius below which a parallel circle is a point [mm].
pub(super) const POINT: f64 = 1e-9;
/// Distance below which a node is the one before [mm]: on an edge whose points stay.
const SAME: f64 = 1e-9;
/// Width along the chain that a circle is given which grazes as a whole: none that counts, but an order.
pub(super) const WIDTH: f64 = 1e-7;
/// Part of a stretch by which the direction near a circle is taken.
const INSIDE: f64 = 1e-5;

impl Slice {
    pub(super) fn new(chain: &ProfileChain, t: f64, jet: MotionJet, fineness: Fineness) -> Slice {
        let twist = clean(&jet.twist, chain.reach()).0;
        let jet = MotionJet { twist, ..jet };
        let grazing = chain.grazing(&jet.twist);
        let mut slice =
            Slice { t, jet, nodes: Vec::with_capacity(128), loops: Vec::new(), kinds: Vec::new() };
        if grazing.motion == Motion::Plunge {
            slice.silhouettes(chain, fineness.chord);
            return slice;
        }
        for of in &grazing.loops {
            let mut start = slice.nodes.len();
            let mut kind = Vec::new();
            for mut stretch in stretches(chain, &grazing, of.spans.clone()) {
                stretch.order = kind.len() as f64;
                kind.push((stretch.span.piece, stretch.ends));
                slice.add(chain, &stretch, fineness);
                if stretch.ends[1] != End::Open {
                    slice.close(chain, &mut start, std::mem::take(&mut kind));
                }
            }
            slice.close(chain, &mut start, kind);
        }
        slice
    }

    /// Ends a loop.
    fn close(&mut self, chain: &ProfileChain, start: &mut usize, kind: Vec<(usize, [End; 2])>) {
        // The normals of a tip are all at one point.
        let on_axis = |node: &Node| chain.pieces()[node.piece as usize].point(node.u).x < POINT;
        let open = &self.nodes[*start..];
        let first = open.iter().take_while(|node| on_axis(node)).count().saturating_sub(1);
        let last = open.iter().rev().take_while(|node| on_axis(node)).count().saturating_sub(1);
        if first + last < open.len() {
            self.nodes.truncate(self.nodes.len() - last);
            self.nodes.drain(*start..*start + first);
        }
        let end = self.nodes.len();
        if end > *start + 1 {
            self.nodes[*start].one = true;
            self.nodes[end - 1].one = true;
            let one = |node: &mut Node| node.points[1] = node.points[0];
            one(&mut self.nodes[*start]);
            one(&mut self.nodes[end - 1]);
            self.loops.push(*start..end);
            self.kinds.push(kind);
        } else {
            self.nodes.truncate(*start);
        }
        *start = self.nodes.len();
    }

    /// First and last place of a loop along the chain.
    pub(super) fn extent(&self, of: &Range<usize>) -> [f64; 2] {
        [self.nodes[of.start].along, self.nodes[of.end - 1].along]
    }

    fn push(&mut self, piece: &ChainPiece, at: NodeAt, u: f64, points: [DVec3; 2]) {
        let points = points.map(|p| self.jet.pose.point(p));
        let along = at.piece as f64 + (u - piece.from) / (piece.to - piece.from);
        self.nodes.push(Node {
            piece: at.piece as u32,
            u,
            along,
            place: [at.order + at.part; 2],
            points,
            one: false,
            still: None,
        });
    }

    fn add(&mut self, chain: &ProfileChain, stretch: &Stretch, fineness: Fineness) {
        let (span, [a, b]) = (stretch.span, stretch.parts);
        let piece = &chain.pieces()[span.piece];
        let inside = (b - a) * INSIDE;
        let fan = piece.is_fan();
        let opened = self.nodes.len();
        let place = |part: f64| NodeAt { piece: span.piece, order: stretch.order, part };
        match stretch.ends[0] {
            End::Still => self.still(chain, stretch, place(a), a + inside, false, fineness.chord),
            start if start != End::Open || self.nodes.is_empty() => {
                let points = span.points(piece, a);
                self.push(piece, place(a), points[0].u, points.map(|p| p.point));
            }
            _ => {}
        }
        let start = self.nodes.len().saturating_sub(1);
        let (mut step, mut around) = (f64::INFINITY, f64::INFINITY);
        if fineness.cap.is_finite() && !fan {
            let widest = piece.point(piece.from).x.max(piece.point(piece.to).x);
            match piece.shape {
                PieceShape::Arc { radius, .. } => step = step_along(radius, fineness.cap),
                PieceShape::Line { .. } => around = TAU / f64::from(steps_around(widest, fineness.cap)),
            }
        }
        let straight = matches!(span.kind, SegmentKind::Generator);
        let first = if straight { 1 } else { FIRST };
        let cut = |k: u32| a + (b - a) * f64::from(k) / f64::from(first);
        let mut from = span.points(piece, a);
        let job = Divide {
            span,
            piece,
            place: place(a),
            turn: self.jet.twist.turn,
            step,
            around,
            straight,
            fineness,
        };
        for k in 1..=first {
            let to = span.points(piece, cut(k));
            self.divide(&job, (cut(k - 1), &from), (cut(k), &to), 0);
            self.push_moved(piece, place(cut(k)), &to, fan && self.nodes.len() > opened + 1);
            from = to;
        }
        if fan {
            self.by_way(start, [stretch.order + a, b - a]);
        }
        if stretch.ends[1] == End::Still {
            self.still(chain, stretch, place(b), b - inside, true, fineness.chord);
        }
    }

    /// Places along an edge by the way around it: near a fold the curve runs along the edge while its normal hardly turns, the
    /// less, the more the motion is one that slides along a face.
    fn by_way(&mut self, start: usize, [from, width]: [f64; 2]) {
        for branch in 0..2 {
            let way = |pair: &[Node]| (pair[1].points[branch] - pair[0].points[branch]).length();
            let all: f64 = self.nodes[start..].windows(2).map(way).sum();
            if all < POINT {
                continue;
            }
            let mut gone = 0.0;
            for i in start + 1..self.nodes.len() {
                gone += way(&self.nodes[i - 1..=i]);
                self.nodes[i].place[branch] = from + width * (gone / all);
            }
        }
    }

    /// Adds a node unless, on an edge, both of its points are those of the last one.
    fn push_moved(&mut self, piece: &ChainPiece, at: NodeAt, points: &[GrazingPoint; 2], replaces: bool) {
        let before = self.nodes.len();
        self.push(piece, at, points[0].u, points.map(|p| p.point));
        if replaces && before > 1 {
            let (last, new) = (self.nodes[before - 1], self.nodes[before]);
            let same = (0..2).all(|i| (last.points[i] - new.points[i]).length_squared() < SAME * SAME);
            if same && last.still.is_none() {
                self.nodes.swap_remove(before - 1);
            }
        }
    }

    /// Nodes strictly between two parts.
    fn divide(
        &mut self,
        job: &Divide,
        a: (f64, &[GrazingPoint; 2]),
        b: (f64, &[GrazingPoint; 2]),
        depth: u32,
    ) {
        let parts = job.parts([a.1, b.1]);
        if parts == 1 || depth == DEEPEST {
            return;
        }
        let mut from = (a.0, *a.1);
        for k in 1..=parts {
            let to = if k == parts {
                (b.0, *b.1)
            } else {
                let part = a.0 + (b.0 - a.0) * f64::from(k) / f64::from(parts);
                (part, job.span.points(job.piece, part))
            };
            self.divide(job, (from.0, &from.1), (to.0, &to.1), depth + 1);
            if k < parts {
                let place = NodeAt { part: to.0, ..job.place };
                self.push_moved(job.piece, place, &to.1, job.piece.is_fan());
            }
            from = to;
        }
    }

    /// The curves of a motion along the axis: the circles between what enters and what leaves.
    fn silhouettes(&mut self, chain: &ProfileChain, chord: f64) {
        let mut before: Option<bool> = None;
        for (index, piece) in chain.pieces().iter().enumerate() {
            // On an arc the normal passes across the axis at most once inside of it.
            let level = (piece.from.min(piece.to) / PI).ceil() * PI;
            let inside = level > piece.from.min(piece.to) && level < piece.from.max(piece.to);
            let cut = match piece.shape {
                PieceShape::Arc { .. } if inside => Some(level),
                _ => None,
            };
            let ends = [Some((piece.from, cut.unwrap_or(piece.to))), cut.map(|u| (u, piece.to))];
            for (from, to) in ends.into_iter().flatten() {
                let enters = piece.normal(0.5 * (from + to)).y * self.jet.twist.shift.z > 0.0;
                if before.is_some_and(|before| before != enters) && piece.point(from).x > POINT {
                    let mut start = self.nodes.len();
                    let at = NodeAt { piece: index, order: 0.0, part: 0.0 };
                    self.circle(piece, at, from, [0.0, PI], before == Some(true), chord);
                    self.close(chain, &mut start, vec![(index, [End::Still; 2])]);
                }
                before = Some(enters);
            }
        }
    }

    /// Nodes of one circle: the ingress angle about `psi` opens from nothing to `alpha`, or the other way round.
    fn circle(
        &mut self,
        piece: &ChainPiece,
        at: NodeAt,
        u: f64,
        [psi, alpha]: [f64; 2],
        closes: bool,
        chord: f64,
    ) {
        let place = piece.point(u);
        let step = (8.0 * chord / place.x.max(chord)).sqrt().min(FRAC_PI_2);
        let count = (alpha / step).ceil().max(1.0) as u32;
        for k in 0..=count {
            let k = if closes { count - k } else { k };
            let half = alpha * f64::from(k) / f64::from(count);
            let points =
                [psi + half, psi - half].map(|theta| (DVec2::from_angle(theta) * place.x).extend(place.y));
            self.push(piece, at, u, points);
            if let Some(last) = self.nodes.last_mut() {
                last.still = Some([psi, half]);
                last.one = k == 0;
                // In order along the chain too, although at one place.
                let before = 1.0 - f64::from(k) / f64::from(count);
                let by = if closes { before } else { -before } * WIDTH;
                last.along += by;
                last.place = last.place.map(|place| place + by);
            }
        }
    }

    /// The half of a circle that grazes as a whole, from the fold to both neighbouring points, or the other way round.
    fn still(
        &mut self,
        chain: &ProfileChain,
        stretch: &Stretch,
        at: NodeAt,
        beside: f64,
        closes: bool,
        chord: f64,
    ) {
        let (span, piece) = (stretch.span, &chain.pieces()[stretch.span.piece]);
        let u = span.points(piece, at.part)[0].u;
        let near = span.points(piece, beside)[0].u;
        let velocity = chain.normal_velocity(&self.jet.twist, span.piece, near);
        let (psi, alpha) = (velocity.psi(), velocity.alpha());
        if closes {
            // The node at the end of the stretch is the first of these, and did not know its side.
            self.nodes.pop();
        }
        self.circle(piece, at, u, [psi, alpha], closes, chord);
    }
}

/// Place of a node along the chain.
#[derive(Clone, Copy)]
struct NodeAt {
    piece: usize,
    order: f64,
    part: f64,
}

/// Inputs of a division of a span.
struct Divide<'a> {
    span: &'a GrazingSpan,
    piece: &'a ChainPiece,
    place: NodeAt,
    turn: DVec3,
    /// Longest step of the parameter.
    step: f64,
    /// Longest step of the angle about the axis.
    around: f64,
    straight: bool,
    fineness: Fineness,
}

/// Most parts of a division: after it the bend is looked at again.
const MOST_PARTS: f64 = 4.0;

impl Divide<'_> {
    /// In how many parts a stretch between two places is divided.
    fn parts(&self, [a, b]: [&[GrazingPoint; 2]; 2]) -> u32 {
        if self.straight {
            return 1;
        }
        let Fineness { chord, step, cap } = self.fineness;
        let mut parts = (b[0].u - a[0].u).abs() / self.step;
        for (p, q) in a.iter().zip(b) {
            let d = q.point - p.point;
            // A chord leaves a surface by a quarter of what it leaves the tangential planes at its ends; how far it leaves the
            // curve along the surface does not matter, but on edges.
            let off = match self.piece.is_fan() {
                true => d.length_squared() / (8.0 * p.point.truncate().length().max(POINT)),
                false => p.normal.dot(d).abs().max(q.normal.dot(d).abs()) / 4.0,
            };
            parts = parts.max((off / chord).sqrt());
            // Warp of a cell of the mesh.
            let warp = 0.5 * (p.normal + q.normal).dot(self.turn.cross(d)).abs() * step / 4.0;
            parts = parts.max(warp / chord);
            if self.around.is_finite() && d.length_squared() > cap * cap {
                parts = parts.max(p.point.truncate().angle_to(q.point.truncate()).abs() / self.around);
            }
        }
        parts.min(MOST_PARTS).ceil().max(1.0) as u32
    }
}

/// The stretches of a curve, from the bottom up.
fn stretches<'a>(chain: &ProfileChain, grazing: &'a Grazing, spans: Range<usize>) -> Vec<Stretch<'a>> {
    let mut all: Vec<Stretch> = Vec::new();
    for span in &grazing.spans[spans] {
        let ends = span.folds.map(|fold| if fold { End::Closed } else { End::Open });
        all.push(Stretch { span, order: 0.0, parts: [0.0, 1.0], ends });
        for &(_, u) in grazing.circles.iter().filter(|c| c.0 == span.piece) {
            let part = (u - span.from) / (span.to - span.from);
            let Some(last) = all.last_mut() else { continue };
            if (-AT_END..=AT_END).contains(&part) {
                last.ends[0] = End::Still;
            } else if (part - 1.0).abs() <= AT_END {
                last.ends[1] = End::Still;
            } else if part > 0.0 && part < 1.0 {
                // The inverse of the pace of parts along a span.
                let at = 0.5 - ((1.0 - 2.0 * part).asin() / 3.0).sin();
                let (end, upper) = (last.ends[1], last.parts[1]);
                last.ends[1] = End::Still;
                last.parts[1] = at;
                all.push(Stretch { span, order: 0.0, parts: [at, upper], ends: [End::Still, end] });
            }
        }
    }
    let count = all.len();
    for i in 0..count {
        let beside = |at: Option<&Stretch>, end: usize| at.map(|s| s.ends[end]);
        let before = if i > 0 { beside(all.get(i - 1), 1) } else { None };
        let after = beside(all.get(i + 1), 0);
        let stretch = &mut all[i];
        for (end, neighbour) in [(0, before), (1, after)] {
            if stretch.ends[end] != End::Open {
                continue;
            }
            let u = if end == 0 { stretch.span.from } else { stretch.span.to };
            let on_axis = chain.pieces()[stretch.span.piece].point(u).x.abs() < POINT;
            stretch.ends[end] = match neighbour {
                Some(End::Still) => End::Still,
                Some(_) => End::Open,
                None if on_axis => End::Closed,
                None => End::Still,
            };
        }
    }
    all
}

/// Steps around a circle whose chords keep this distance.
pub(super) fn steps_around(radius: f64, chord: f64) -> u32 {
    (PI / (2.0 * chord / radius).sqrt().min(FRAC_PI_2)).ceil().max(3.0) as u32
}

/// Longest step of the angle of an arc whose chords keep this distance.
pub(super) fn step_along(radius: f64, chord: f64) -> f64 {
    (8.0 * chord / radius.abs()).sqrt().min(FRAC_PI_2)
}
