//! Distance by which a strip between two grazing curves leaves the envelope.
//!
//! The strip is tried in the middle of each of its edges, diagonals among them. A point that stays is seen from the
//! tool, which moves: its place in coordinates of the tool is followed to the second order of time, and its distance
//! from the neighbouring pieces at the moment when it is least is the distance of the point outside, or inside, the
//! envelope. The moment comes from one step of Newton's on the derivative of the distance, whose second derivative is

use glam::{DVec2, DVec3};

use super::face::{Beside, EnvelopeFace};
use super::slice::Slice;
use super::wall::{Rung, any_edge};
use crate::geom::Rigid;
use crate::sweep::{MotionJet, ProfileChain, ToolMotion};

/// The tool at the middle of two moments.
struct Between<'a> {
    faces: &'a [EnvelopeFace],
    jet: MotionJet,
    back: Rigid,
    /// Time between the two moments.
    step: f64,
    /// Distance that is allowed [mm].
    strip: f64,
}

/// Time beyond the two moments to which points are followed, by that between them: curves that run along themselves.
const FOLLOWED: f64 = 1.5;
/// Number of moments on each side of the middle at which a point is looked at whose distance has no least value.
const LOOKS: i32 = 4;
/// Radius below which a point is on the axis [mm].
const ON_AXIS: f64 = 1e-9;

/// The faces of a tool.
pub(super) fn faces(chain: &ProfileChain) -> Vec<EnvelopeFace> {
    chain.pieces().iter().map(EnvelopeFace::new).collect()
}

/// True if a strip between the curves of two moments leaves the envelope by more than allowed.
pub(super) fn strays(
    faces: &[EnvelopeFace],
    motion: &ToolMotion,
    strip: f64,
    (a, b): (&Slice, &Slice),
) -> bool {
    let jet = motion.at(0.5 * (a.t + b.t));
    let between = Between { faces, jet, back: jet.pose.inverse(), step: b.t - a.t, strip };
    any_edge(a, b, |edge| {
        let of = |rung: &Rung| if rung.after { b } else { a };
        let [(p, first), (q, second)] = edge.map(|rung| rung.place(of(rung)));
        // Between circles that graze as a whole faces slide along themselves, to where they end.
        let slides = edge.iter().all(|rung| rung.is_still(of(rung)));
        let pieces = [first[0].min(second[0]), first[1].max(second[1])];
        between.leaves(0.5 * (p + q), pieces, slides)
    })
}

impl Between<'_> {
    /// True if a point of the workpiece leaves the envelope of what lies between two pieces.
    fn leaves(&self, point: DVec3, pieces: [usize; 2], slides: bool) -> bool {
        let p = self.back.point(point);
        let Some((beside, out)) = self.nearest(p, pieces) else { return false };
        let twist = &self.jet.twist;
        let v = twist.velocity(p);
        let drift = self.jet.change.velocity(p) - twist.turn.cross(v);
        let normal = (out * beside.normal.x).extend(beside.normal.y);
        let along = (out * -beside.normal.y).extend(beside.normal.x);
        let around = out.perp().extend(0.0);
        let radius = p.truncate().dot(out);
        let bend_around = if radius > ON_AXIS { beside.normal.x / radius } else { beside.bend };
        let square = |x: DVec3| v.dot(x) * v.dot(x);
        // Derivatives of the distance by time.
        let first = -normal.dot(v);
        let second = beside.bend * square(along) + bend_around * square(around) - normal.dot(drift);
        let at = |time: f64| {
            let then = p - v * time - drift * (0.5 * time * time);
            self.nearest(then, pieces).map_or(beside.distance, |(then, _)| then.distance)
        };
        let found = if second > 0.0 {
            let time = (-first / second).clamp(-FOLLOWED * self.step, FOLLOWED * self.step);
            let drop = 0.5 * time * first;
            // Mostly there is nothing to look at again.
            if beside.distance.abs() < 0.75 * self.strip && drop.abs() < 0.25 * self.strip {
                return false;
            }
            at(time)
        } else {
            // If the distance has no least value, the point is followed from moment to moment, past edges too.
            (-LOOKS..=LOOKS)
                .map(|k| at(0.5 * self.step * f64::from(k) / f64::from(LOOKS)))
                .fold(f64::INFINITY, f64::min)
        };
        let outside = found.min(beside.distance);
        // A hollow face that runs over a point hides it: inside is then what the first derivative says, too.
        let hidden = beside.bend < 0.0 && second <= 0.0;
        let told = beside.distance - 0.5 * self.step * first.abs();
        let inside = if hidden { found.max(told) } else { outside };
        // Points of hollow edges lie inside of what is swept, and bound nothing.
        let hollow = pieces.iter().any(|&i| matches!(self.faces[i], EnvelopeFace::Hollow));
        outside > self.strip || (!(hollow || slides) && inside < -self.strip)
    }

    /// The distance of a point from the nearest of some pieces and their neighbours, and the direction of the point.
    fn nearest(&self, p: DVec3, [a, b]: [usize; 2]) -> Option<(Beside, DVec2)> {
        let across = p.truncate();
        let radius = across.length();
        let out = if radius > 0.0 { across / radius } else { DVec2::X };
        let q = DVec2::new(radius, p.z);
        if a == b
            && let Some(own) = self.faces[a].beside(q)
        {
            return Some((own, out));
        }
        let from = a.min(b).saturating_sub(1);
        let to = (a.max(b) + 2).min(self.faces.len());
        let near = self.faces[from..to].iter().filter_map(|face| face.beside(q));
        let near = near.reduce(|x, y| if y.distance.abs() < x.distance.abs() { y } else { x })?;
        Some((near, out))
    }
}
