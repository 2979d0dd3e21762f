//! Arcs in corners: as large as the tolerance and half of each move allow, and no larger than the speed asks for.
//!
//! Moves along arcs are taken as their chords first; the arc in the corner is then fitted to the circles.
//! Source: LinuxCNC 2.10, `src/emc/tp/blendmath.c` and `tp.c` (`tpCreateLineLineBlend` and its three sisters).

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;

use super::corner::{Between, choose};
use super::element::{Element, Passage};
use super::shape::{Arc, Corner, Shape};
use super::{Bounds, CYCLE, NORMAL_SHARE};

/// Cycles below which what is left of a line goes into the arc.
const GAP: f64 = 4.0;
/// Half of the enclosed angle, and how far it is from straight, below which there is no arc [rad].
const LEAST_ANGLE: f64 = 1e-6;

/// A corner: its point, the directions of both moves there and of their chords, and the limits in their plane.
struct Setting {
    point: DVec3,
    tangents: [DVec3; 2],
    chords: [DVec3; 2],
    binormal: DVec3,
    /// Half of the angle that the chords enclose [rad].
    half: f64,
    /// Lengths that each move can give [mm].
    lengths: [f64; 2],
    tolerance: f64,
}

/// A side of a corner.
struct Side<'a> {
    /// `None` for a line.
    arc: Option<&'a Arc>,
    /// Largest angle that is cut off from an arc [rad].
    most: f64,
    /// Whether the corner's arc lies inside of it.
    is_inside: bool,
}

/// What is left of a move.
enum Rest {
    Line,
    Arc(Arc),
}

/// Size and speeds of the arc.
struct Size {
    radius: f64,
    speed: f64,
    asked: f64,
    acceleration: f64,
}

/// Puts an arc between two elements, or passes from one to the other in another way where that is faster; `None` where no
/// arc fits.
pub(super) fn blend_arc<'a>(
    before: &mut Element<'a>,
    next: &mut Element<'a>,
    bounds: &Bounds,
) -> Option<Between<'a>> {
    let tangents = [before.shape.tangent(true), next.shape.tangent(false)];
    let half = 0.5 * (-tangents[0].dot(tangents[1])).clamp(-1.0, 1.0).acos();
    if FRAC_PI_2 - half < LEAST_ANGLE || half < LEAST_ANGLE {
        return None;
    }
    let binormal = tangents[0].cross(tangents[1]).normalize_or_zero();
    let point = match (&next.shape, &before.shape) {
        (Shape::Line { from, .. }, _) => DVec3::from_slice(from),
        (_, Shape::Line { .. }) => position(&before.shape, before.length),
        (Shape::Arc(arc), _) => arc.point(0.0),
        _ => return None,
    };
    let mut setting = Setting {
        point,
        tangents,
        chords: tangents,
        binormal,
        half,
        lengths: [before.length.min(0.5 * before.nominal), 0.5 * next.length],
        tolerance: tolerance(before, next),
    };
    let (first, second) = (before.shape.clone(), next.shape.clone());
    let sides = [side(&mut setting, &first, 0, half)?, side(&mut setting, &second, 1, half)?];
    let arcs = sides.iter().filter(|side| side.arc.is_some()).count();
    if arcs == 2 && setting.half < PI / 12.0 {
        return None;
    }
    let size = size(&setting, before, next, bounds, arcs > 0)?;
    let (centre, trims) = place(&setting, &size, &sides)?;
    let rests = [rest(&sides[0], trims[0], false)?, rest(&sides[1], trims[1], true)?];
    let line_left = before.length - trims[0];
    let is_taken =
        matches!(rests[0], Rest::Line) && !before.overlaps_before && line_left / size.speed < GAP * CYCLE;
    let corner = Corner {
        line: if is_taken { line_left } else { 0.0 },
        rotary: rotary(&next.shape),
        ..corner(&setting, centre, &rests, trims)?
    };
    if !touches(&corner, &rests, &size) {
        return None;
    }
    let element = element(before, corner, &size);
    if !choose(before, next, element.fastest) {
        return Some(Between::Nothing);
    }
    let [before_rest, next_rest] = rests;
    shorten(next, next_rest, trims[1], true);
    next.overlaps_before = false;
    if is_taken {
        return Some(Between::Instead(Box::new(element)));
    }
    shorten(before, before_rest, trims[0], false);
    before.end = Passage::Tangent;
    Some(Between::Arc(Box::new(element)))
}

/// What a cut leaves of a side: a length [mm] of a line, an angle [rad] of an arc; `None` if it takes too much.
fn rest(side: &Side, trim: f64, keeps_end: bool) -> Option<Rest> {
    let Some(arc) = side.arc else { return Some(Rest::Line) };
    let angle = (trim <= side.most).then_some(arc.angle - trim)?;
    arc.cut(angle, keeps_end).map(Rest::Arc)
}

/// The arc about a centre between the ends of what is left.
fn corner(setting: &Setting, centre: DVec3, rests: &[Rest; 2], trims: [f64; 2]) -> Option<Corner> {
    /// Radius below which it is none [mm].
    const NONE: f64 = 1e-12;
    let Setting { point, tangents, binormal, .. } = *setting;
    let start = match &rests[0] {
        Rest::Line => point - tangents[0] * trims[0],
        Rest::Arc(arc) => arc.point(arc.angle),
    };
    let end = match &rests[1] {
        Rest::Line => point + tangents[1] * trims[1],
        Rest::Arc(arc) => arc.point(0.0),
    };
    let radii = [start - centre, end - centre];
    let angle = radii[0].normalize_or_zero().dot(radii[1].normalize_or_zero()).acos();
    let is_one = radii.iter().all(|radius| radius.length() > NONE) && angle >= LEAST_ANGLE;
    is_one.then_some(Corner {
        line: 0.0,
        along: tangents[0],
        binormal,
        start,
        centre,
        radii,
        angle,
        rotary: [0.0; 3],
    })
}

/// Whether it goes on from the arcs that it joins, but for a quarter of the acceleration across it in a cycle.
fn touches(corner: &Corner, rests: &[Rest; 2], size: &Size) -> bool {
    let allowed = 0.25 * NORMAL_SHARE * size.acceleration * CYCLE / size.speed;
    [false, true].into_iter().zip(rests).all(|(at_end, rest)| {
        let Rest::Arc(arc) = rest else { return true };
        let circle = arc.tangent(if at_end { 0.0 } else { arc.angle });
        circle.dot(corner.tangent(at_end)).clamp(-1.0, 1.0).acos() <= allowed
    })
}

fn position(shape: &Shape, s: f64) -> DVec3 {
    DVec3::from_slice(&shape.at(s).map(|jet| jet.q))
}

fn rotary(shape: &Shape) -> [f64; 3] {
    let jets = shape.at(0.0);
    [3, 4, 5].map(|a| jets[a].q)
}

/// Distance by which the corner may be left: never more than a quarter of a move [mm].
fn tolerance(before: &Element, next: &Element) -> f64 {
    let of = |e: &Element| {
        let quarter = 0.25 * e.nominal;
        if e.tolerance == 0.0 { quarter } else { e.tolerance.min(quarter) }
    };
    of(before).min(of(next))
}

/// The side of a corner before (0) or behind it (1); `None` of an arc in another plane.
fn side<'a>(setting: &mut Setting, shape: &'a Shape<'_>, i: usize, half: f64) -> Option<Side<'a>> {
    let Shape::Arc(arc) = shape else { return Some(Side { arc: None, most: 0.0, is_inside: false }) };
    /// Square of the angle between the arc's axis and that of the corner [rad^2].
    const PLANE: f64 = 1e-12;
    let off = [arc.normal - setting.binormal, arc.normal + setting.binormal];
    if off.iter().all(|off| off.length_squared() >= PLANE) {
        return None;
    }
    let towards = (setting.point - arc.centre).dot(setting.tangents[1 - i]);
    let is_inside = if i == 0 { towards < 0.0 } else { towards >= 0.0 };
    let part = if i == 0 { 2.0 / 3.0 } else { 1.0 / 3.0 };
    let most = (part * arc.angle).min(if is_inside { half } else { FRAC_PI_2 });
    if is_inside {
        let at = if i == 0 { arc.angle - 0.5 * most } else { 0.5 * most };
        let chord = (setting.point - arc.point(at)).normalize_or_zero();
        setting.chords[i] = if i == 0 { chord } else { -chord };
        setting.half = setting.half.min(half - 0.25 * most);
        setting.lengths[i] = (0.25 * most).sin() * arc.radius();
    } else {
        setting.lengths[i] = most * arc.radius();
    }
    Some(Side { arc: Some(arc), most, is_inside })
}

/// Size and speed of the arc; `None` if it would be none.
fn size(
    setting: &Setting,
    before: &Element,
    next: &Element,
    bounds: &Bounds,
    has_arcs: bool,
) -> Option<Size> {
    let acceleration = bounds.in_plane(bounds.acceleration, setting.binormal);
    let across = NORMAL_SHARE * acceleration;
    let phi = PI - 2.0 * setting.half;
    // The component of both largest velocities that is common to them.
    let cosine = phi.min(0.49 * PI).cos();
    let v = before.fastest.min(next.fastest / cosine);
    let w = next.fastest.min(before.fastest / cosine);
    let base = (setting.chords[1] * w - setting.chords[0] * v).length();
    let altitude = if has_arcs { 0.0 } else { v * w * phi.sin() / base };
    let most = altitude.max(bounds.in_plane(bounds.velocity, setting.binormal));
    let asked = before.target().max(next.target());
    let (sine, cosine) = setting.half.sin_cos();
    let within = cosine * setting.tolerance / (1.0 - sine);
    let distance = setting.lengths[0].min(setting.lengths[1]).min(within);
    let widest = sine / cosine * distance;
    let speed = (across * widest).sqrt().min(asked).min(most);
    // As much of both moves as an overlap would take.
    let parabolic = 0.5 * acceleration;
    let time = (2.0 * parabolic * distance).sqrt().min(speed) / parabolic;
    let radius = (speed * speed / across).max((time * speed / phi).min(widest));
    (radius >= 1e-12 && radius * phi >= 1e-6).then_some(Size { radius, speed, asked, acceleration })
}

/// Centre of the arc, and what it takes from each move: a length [mm] of a line, an angle [rad] of an arc.
fn place(setting: &Setting, size: &Size, [first, second]: &[Side; 2]) -> Option<(DVec3, [f64; 2])> {
    let Setting { point, binormal, .. } = *setting;
    let away =
        |arc: &Arc, side: &Side| arc.radius() + if side.is_inside { -size.radius } else { size.radius };
    let within = |from: DVec3| from.length() - size.radius <= setting.tolerance;
    let angle = |centre: DVec3, arc: &Arc| {
        let [p, c] = [point, centre].map(|q| (q - arc.centre).normalize_or_zero());
        p.dot(c).clamp(-1.0, 1.0).acos()
    };
    // Beside a line that leads to the corner or, `ahead`, away from it: where the arc touches it, the other move a circle.
    let beside = |u: DVec3, ahead: f64, arc: &Arc, side: &Side| {
        let across = binormal.cross(u).normalize_or_zero();
        let to = arc.centre - point;
        let (b, n) = (to.dot(u), to.dot(across));
        let square = away(arc, side).powi(2) - (size.radius - n).powi(2);
        let root = (square >= 0.0).then(|| square.sqrt())?;
        let distance = (root - b).abs().min((root + b).abs());
        let from = across * size.radius + u * (ahead * distance);
        within(from).then(|| (point + from, distance))
    };
    match (first.arc, second.arc) {
        (None, None) => {
            let normal = (setting.tangents[1] - setting.tangents[0]).normalize_or_zero();
            let trim = size.radius / setting.half.tan();
            Some((point + normal * (size.radius / setting.half.sin()), [trim; 2]))
        }
        (None, Some(arc)) => {
            let (centre, distance) = beside(setting.chords[0], -1.0, arc, second)?;
            Some((centre, [distance, angle(centre, arc)]))
        }
        (Some(arc), None) => {
            let (centre, distance) = beside(setting.chords[1], 1.0, arc, first)?;
            Some((centre, [angle(centre, arc), distance]))
        }
        (Some(one), Some(other)) => {
            let between = other.centre - one.centre;
            let (far, unit) = (between.length(), between.normalize_or_zero());
            let (r, s) = (away(one, first), away(other, second));
            let x = (r * r - s * s + far * far) / (2.0 * far);
            let y = (r * r - x * x).max(0.0).sqrt();
            let across = binormal.cross(unit).normalize_or_zero();
            let from = one.centre - point + unit * x;
            let both = [from + across * y, from - across * y];
            let nearest = if both[1].length() < both[0].length() { both[1] } else { both[0] };
            let centre = point + nearest;
            (far > 0.0 && within(nearest)).then(|| (centre, [angle(centre, one), angle(centre, other)]))
        }
    }
}

/// The arc as an element of the queue.
fn element<'a>(before: &Element<'a>, corner: Corner, size: &Size) -> Element<'a> {
    let length = corner.length();
    let mut element = Element {
        shape: Shape::Corner(corner),
        length,
        nominal: length,
        feed: size.asked,
        fastest: size.speed,
        acceleration: size.acceleration,
        kink: None,
        taken: [0.0; 2],
        overlaps_before: false,
        end: Passage::Tangent,
        last_speed: 0.0,
        is_fixed: false,
        ..before.clone()
    };
    element.fix();
    element
}

/// Leaves off what the arc takes of an element, at its end or, of the element behind, at its start.
fn shorten(element: &mut Element, rest: Rest, trim: f64, at_start: bool) {
    match (&mut element.shape, rest) {
        (Shape::Line { from, rates }, Rest::Line) => {
            element.length -= trim;
            if at_start {
                for (from, rate) in from.iter_mut().zip(rates) {
                    *from += *rate * trim;
                }
            }
        }
        (shape, Rest::Arc(arc)) => {
            element.length = arc.length();
            *shape = Shape::Arc(arc);
        }
        _ => {}
    }
}
