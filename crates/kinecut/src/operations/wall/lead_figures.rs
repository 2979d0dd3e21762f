//! Figures 3, 4 and 5 of Sorokin, But, Kombarov 2013 for a planned lead-in: the involute with its base circle, the place
//! where it touches the wall, its start.
//!
//! Notation: O the bore's centre; `q`, `q'` support function and derivative at the tangent angle `th` before the turn by
//! psi, with `u = (sin th, -cos th)` and `t = (cos th, sin th)`: the point is `q u + q' t`, the centre of curvature
//! `q' t - q'' u`. A clockwise path is the mirror image in the Y axis, and its psi is counted clockwise.
//!
//! A lens spiral (contact G4, G6) is the involute of an oval: its figures have that instead of the base circle.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec2;
use serde::Serialize;

use crate::geom::{LensOrder, PlaneCurve, SpiralLaw, Support};
use crate::holes::PassFigures;
use crate::num::angle::wrap;
use crate::page::{Along, Angle, Drawing, Look, Stroke, fixed};

/// Room around the wall path, as a share of its radius.
const ROOM: f64 = 1.06;
/// Half the width of what is shown of the base circle, in base radii.
const NEAR_BASE: f64 = 3.4;
/// Angle between two points of a drawn line [rad].
const GRAIN: f64 = 0.02;
/// Osculating circles about the centre that are drawn, the wall path not counted.
const MOST_CIRCLES: u32 = 3;
/// Turns of the involute by less than this are none [rad].
const NO_TURN: f64 = 1e-9;

/// The figures of a finishing pass.
pub(crate) fn lead_drawings(pass: &PassFigures) -> Vec<Drawing> {
    let Some(lead) = Involute::of(pass) else { return Vec::new() };
    vec![lead.whole(), lead.base_circle(), lead.touching(), lead.start()]
}

/// An involute as the figures have it: places from the bore's centre [mm].
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LeadFigure {
    /// Turn about the centre, the paper's psi, counted in the direction of the path [rad].
    pub psi: f64,
    /// Base radius, of a lens spiral its mean [mm].
    pub base_radius: f64,
    /// Centre of the base circle, or the middle of the evolute.
    pub base_centre: [f64; 2],
    /// The evolute of a lens spiral; empty where it is the base circle.
    pub evolute: Vec<[f64; 2]>,
    /// Start, the paper's T_0.
    pub start: [f64; 2],
    /// Place in which it touches the path at the wall, T_psi.
    pub touch: [f64; 2],
    /// The start before the turn by psi, T_P.
    pub unturned_start: [f64; 2],
    /// Centre of curvature at the start.
    pub start_centre: [f64; 2],
    /// The spiral from its cusp to the start, which is not run.
    pub before: Vec<[f64; 2]>,
    /// The whole spiral before the turn by psi; empty where it is not turned.
    pub unturned: Vec<[f64; 2]>,
    /// Radii of the circles about the centre that it osculates after whole turns, the outermost first [mm].
    pub osculated: Vec<f64>,
    /// Turns that are run by the paper's formula, n (1 - rho/R).
    pub visible_turns_formula: f64,
}

/// Angle between two points of a figure that is sent [rad].
const SENT_GRAIN: f64 = 0.08;

/// The involute of a pass; none for curves that are not one.
pub(crate) fn lead_figure(pass: &PassFigures) -> Option<LeadFigure> {
    let lead = Involute::of(pass)?;
    let [cusp, start, wall] = lead.angles;
    let line = |[from, to]: [f64; 2], psi: f64| {
        let points = grained(SENT_GRAIN, from, to, |theta| lead.point(theta, psi));
        points.into_iter().map(|p| p.map(|v| (v * 1e4).round() / 1e4)).collect::<Vec<_>>()
    };
    let [x, y] = lead.point(start, lead.psi);
    let evolute = if lead.is_lens() {
        grained(SENT_GRAIN, 0.0, TAU, |theta| lead.centre(theta, lead.psi))
    } else {
        Vec::new()
    };
    let whole = pass.turns.round() as u32;
    Some(LeadFigure {
        psi: lead.psi,
        base_radius: lead.base_radius,
        base_centre: lead.base(),
        evolute,
        start: [x, y],
        touch: lead.point(wall, lead.psi),
        unturned_start: lead.point(start, 0.0),
        start_centre: lead.centre(start, lead.psi),
        before: if start > cusp { line([cusp, start], lead.psi) } else { Vec::new() },
        unturned: if lead.psi.abs() > NO_TURN { line([cusp, wall], 0.0) } else { Vec::new() },
        osculated: (1..whole)
            .rev()
            .take(MOST_CIRCLES as usize)
            .map(|i| lead.law.radius(TAU * f64::from(i)))
            .collect(),
        visible_turns_formula: pass.turns * (1.0 - x.hypot(y) / pass.path_radius),
    })
}

/// The involute whose end is a lead-in.
struct Involute<'a> {
    pass: &'a PassFigures,
    law: Support,
    order: LensOrder,
    clockwise: bool,
    /// The turn about O [rad].
    psi: f64,
    base_radius: f64,
    /// Tangent angles before the turn of the cusp, the start of the lead-in and the wall [rad].
    angles: [f64; 3],
}

impl Involute<'_> {
    fn of(pass: &PassFigures) -> Option<Involute<'_>> {
        let order = match pass.curves.first()? {
            PlaneCurve::Record(_) => LensOrder::Zero,
            PlaneCurve::Spiral(spiral) => match spiral.law() {
                SpiralLaw::Support(Support::Lens { order, .. }) => *order,
                _ => return None,
            },
        };
        let wall = TAU * pass.turns;
        let base_radius = if pass.base_radius > 0.0 { pass.base_radius } else { pass.path_radius / wall };
        // Zero, but for what a base radius is rounded by for a control.
        let inner = pass.path_radius - wall * base_radius;
        let cusp = if order == LensOrder::Zero { -inner / base_radius } else { 0.0 };
        let clockwise = matches!(pass.curves.last(), Some(PlaneCurve::Record(r)) if r.sense() < 0.0);
        Some(Involute {
            pass,
            law: Support::Lens { inner, base_radius, order },
            order,
            clockwise,
            psi: wrap(if clockwise { PI - pass.psi } else { pass.psi }),
            base_radius,
            angles: [cusp, wall - TAU * pass.visible_turns, wall],
        })
    }

    /// A point of the counter-clockwise involute that touches the wall below O, turned by `psi` and as it is run.
    fn placed(&self, p: DVec2, psi: f64) -> [f64; 2] {
        let p = DVec2::from_angle(psi).rotate(p);
        [if self.clockwise { -p.x } else { p.x }, p.y]
    }

    fn point(&self, theta: f64, psi: f64) -> [f64; 2] {
        let ([q, slope], (sin, cos)) = (self.law.at(theta), theta.sin_cos());
        self.placed(DVec2::new(q * sin + slope * cos, slope * sin - q * cos), psi)
    }

    /// The centre of curvature.
    fn centre(&self, theta: f64, psi: f64) -> [f64; 2] {
        let (_, slope) = self.law.series::<2>(theta);
        let (sin, cos) = theta.sin_cos();
        let [slope, second] = slope.0;
        self.placed(DVec2::new(slope * cos - second * sin, slope * sin + second * cos), psi)
    }

    /// Centre of the base circle; of a lens the middle of its evolute.
    fn base(&self) -> [f64; 2] {
        let [a, b] = [0.0, PI].map(|theta| self.centre(theta, self.psi));
        [0, 1].map(|i| (a[i] + b[i]) / 2.0)
    }

    fn line(&self, [from, to]: [f64; 2], psi: f64) -> Vec<[f64; 2]> {
        sampled(from, to, |theta| self.point(theta, psi))
    }

    /// The base circle, or what a lens has instead.
    fn evolute(&self) -> Vec<[f64; 2]> {
        sampled(0.0, TAU, |theta| self.centre(theta, self.psi))
    }

    /// The lead-in as it is run.
    fn run(&self) -> Vec<[f64; 2]> {
        let [_, start, wall] = self.angles;
        let curves = &self.pass.curves[..self.pass.curves.len() - 1];
        let share = (wall - start) / curves.len() as f64;
        curves
            .iter()
            .flat_map(|c| {
                sampled(0.0, share, |at| c.at(c.length() * (at / share).clamp(0.0, 1.0)).p.to_array())
            })
            .collect()
    }

    /// Whether the lead-in starts where it can be told from O.
    fn is_off_centre(&self) -> bool {
        /// Of the radius of the wall path: less than a pixel.
        const SEEN: f64 = 1e-3;
        let [x, y] = self.point(self.angles[1], self.psi);
        x.hypot(y) > SEEN * self.pass.path_radius
    }

    fn is_lens(&self) -> bool {
        self.order != LensOrder::Zero
    }

    /// Name of the angle at the start: the roll angle, or the tangent angle of a lens.
    fn symbol(&self) -> &'static str {
        if self.is_lens() { "\u{3b8}_0" } else { "\u{3c6}_0" }
    }

    fn start_radius(&self) -> f64 {
        self.law.radius(self.angles[1])
    }

    /// A drawing of the wall path with the axes through O.
    fn drawing(&self, title: &str) -> Drawing {
        let most = ROOM * self.pass.path_radius;
        let mut d = Drawing::new(title, [[-most, -most], [most, most]]);
        d.line(Look::Axis, vec![[-most, 0.0], [most, 0.0]]);
        d.line(Look::Axis, vec![[0.0, -most], [0.0, most]]);
        named(&mut d, Look::Edge, "wall path", circle([0.0, 0.0], self.pass.path_radius));
        d
    }

    /// Figure 3 a.
    fn whole(&self) -> Drawing {
        let [cusp, start, wall] = self.angles;
        let psi = self.psi;
        let mut d = self.drawing("Figure 3 a: the involute and its osculating circles");
        let whole = self.pass.turns.round() as u32;
        let circles: Vec<u32> = (1..whole).rev().take(MOST_CIRCLES as usize).collect();
        let mut places: Vec<f64> = circles.iter().map(|i| TAU * f64::from(*i)).collect();
        if self.is_off_centre() {
            places.push(start);
        }
        for theta in places {
            let (at, centre) = (self.point(theta, psi), self.centre(theta, psi));
            named(&mut d, Look::Third, "osculating circles", circle(centre, self.law.radius(theta)));
            d.line(Look::Hidden, vec![centre, at]);
        }
        named(&mut d, Look::Second, self.evolute_name(), self.evolute());
        named(&mut d, Look::Hidden, "whole involute", self.line([cusp, wall], psi));
        named(&mut d, Look::First, "lead-in", self.run());
        for i in circles {
            let theta = TAU * f64::from(i);
            d.point(self.point(theta, psi), vec![format!("R_{i} {}", fixed(self.law.radius(theta), 3))]);
        }
        if self.is_off_centre() {
            d.point([0.0, 0.0], vec!["O".to_owned()]);
        }
        d.point(
            self.point(start, psi),
            vec![format!("T_0: {} {}", self.symbol(), fixed(self.pass.roll, 4)), self.radius_words()],
        );
        d.point(self.point(wall, psi), vec![format!("T_\u{3c8}: R {}", fixed(self.pass.path_radius, 3))]);
        let r = fixed(self.base_radius, 4);
        let radius = fixed(self.pass.path_radius, 3);
        d.notes.push(if self.is_lens() {
            format!(
                "A lens spiral is the involute of an oval, its evolute, of the mean radius r = R / 2\u{3c0}n = {radius} mm / \
                 2\u{3c0} {whole} = {r} mm. O lies on it: after whole turns the osculating circles are about O."
            )
        } else {
            format!(
                "Base circle r = R / 2\u{3c0}n = {radius} mm / 2\u{3c0} {whole} = {r} mm. O lies on it: after i whole turns the \
                 osculating circle is about O, with the radius R\u{1d62} = 2\u{3c0} r i; the last of them is the wall path, R."
            )
        });
        d
    }

    /// Figure 3 b: the base circle enlarged.
    fn base_circle(&self) -> Drawing {
        let [cusp, start, wall] = self.angles;
        let (psi, r, [x, y]) = (self.psi, self.base_radius, self.base());
        let half = NEAR_BASE * r;
        let title = if self.is_lens() {
            "Figure 3 b: the evolute, with the centres of curvature"
        } else {
            "Figure 3 b: the base circle is the evolute"
        };
        let mut d = Drawing::new(title, [[x - half, y - half], [x + half, y + half]]);
        named(&mut d, Look::Second, self.evolute_name(), self.evolute());
        named(&mut d, Look::Hidden, "whole involute", self.line([cusp, wall], psi));
        named(&mut d, Look::First, "lead-in", self.run());
        // Threads of the first turn, and that of the start: each from its centre of curvature along the tangent there.
        let mut threads: Vec<f64> = (1..4).map(|i| cusp + FRAC_PI_2 * f64::from(i)).collect();
        threads.push(start);
        for theta in threads {
            let ends = vec![self.centre(theta, psi), self.point(theta, psi)];
            named(&mut d, Look::Thin, "radii of curvature", ends);
        }
        let words = format!("{} {}", self.symbol(), fixed(self.pass.roll, 4));
        if self.is_off_centre() {
            d.point(self.centre(start, psi), vec!["centre for T_0".to_owned(), words]);
        }
        d.point(self.centre(wall, psi), vec!["O, centre for T_\u{3c8}".to_owned()]);
        if !self.is_lens() {
            d.point([x, y], vec!["C".to_owned()]);
            let edge = self.centre(cusp + PI, psi);
            d.span(Along::Line, [x, y], edge, format!("r {}", fixed(r, 4)));
        }
        d.notes.push(if self.is_lens() {
            "Each centre of curvature lies on the evolute, and the radius of curvature touches it there. It comes to a point \
             at O, which makes the contact with the wall the higher."
                .to_owned()
        } else {
            format!(
                "The thread that unwinds from the base circle about C is the radius of curvature r \u{3c6}: it touches the circle \
                 in the centre of curvature. C lies at X {} Y {} from O.",
                fixed(x, 3),
                fixed(y, 3)
            )
        });
        d
    }

    /// Figure 4.
    fn touching(&self) -> Drawing {
        let [cusp, _, wall] = self.angles;
        let radius = self.pass.path_radius;
        let mut d = self.drawing("Figure 4: touching the wall path in a given place");
        let (below, there) = (self.point(wall, 0.0), self.point(wall, self.psi));
        if self.psi.abs() > NO_TURN {
            named(&mut d, Look::Hidden, "involute for \u{3c8} = 0", self.line([cusp, wall], 0.0));
            d.line(Look::Thin, vec![[0.0, 0.0], below]);
            self.angle(&mut d, -FRAC_PI_2, 0.4 * radius);
        }
        named(&mut d, Look::First, "involute turned by \u{3c8}", self.line([cusp, wall], self.psi));
        d.line(Look::Thin, vec![[0.0, 0.0], there]);
        d.span(Along::Line, [0.0, 0.0], there, format!("R {}", fixed(radius, 3)));
        d.point([0.0, 0.0], vec!["O".to_owned()]);
        d.point(there, vec!["T_\u{3c8}".to_owned()]);
        let [x, y] = there.map(|v| fixed(v, 3));
        let direction = fixed(there[1].atan2(there[0]).to_degrees(), 3);
        d.notes.push(format!(
            "\u{3c8} = {} rad = {}\u{b0}, {}: the involute that touches the wall path below O is turned about O by it. Then it \
             touches in T\u{3c8}, which lies in the direction {direction}\u{b0} (touch_angle), from O at X {x} Y {y}.",
            fixed(self.psi, 6),
            fixed(self.psi.to_degrees(), 3),
            self.counted(),
        ));
        d
    }

    /// Figure 5.
    fn start(&self) -> Drawing {
        let [cusp, start, wall] = self.angles;
        let psi = self.psi;
        let mut d = self.drawing("Figure 5: the start of the lead-in");
        let from = self.point(start, psi);
        let distance = from[0].hypot(from[1]);
        let off_centre = self.is_off_centre();
        if psi.abs() > NO_TURN && off_centre {
            named(&mut d, Look::Hidden, "involute for \u{3c8} = 0", self.line([cusp, wall], 0.0));
            named(&mut d, Look::Third, "circle of radius \u{3c1}", circle([0.0, 0.0], distance));
            let before = self.point(start, 0.0);
            d.line(Look::Thin, vec![[0.0, 0.0], before]);
            d.point(before, vec!["T_p".to_owned()]);
            let at = if self.clockwise { -before[0] } else { before[0] };
            self.angle(&mut d, before[1].atan2(at), 0.55 * distance);
        }
        named(&mut d, Look::Second, self.evolute_name(), self.evolute());
        named(&mut d, Look::Hidden, "involute turned by \u{3c8}", self.line([cusp, wall], psi));
        named(&mut d, Look::First, "lead-in", self.run());
        if off_centre {
            d.line(Look::Thin, vec![[0.0, 0.0], from]);
            named(&mut d, Look::Thin, "radius of curvature R\u{2099}", vec![self.centre(start, psi), from]);
        }
        d.point(from, vec!["T_0".to_owned(), format!("\u{3c1} {}", fixed(distance, 3)), self.radius_words()]);
        if off_centre {
            d.point([0.0, 0.0], vec!["O".to_owned()]);
        }
        d.point(self.point(wall, psi), vec!["T_\u{3c8}".to_owned()]);
        let roll = format!("{} rad", fixed(self.pass.roll, 6));
        let roll = if self.is_lens() {
            format!("\u{3b8}\u{2080} = {roll} is its tangent angle before the turn by \u{3c8}")
        } else {
            // More than a turn: an arc that grows, about C.
            let [x, y] = [-self.base_radius, 0.0];
            let arc = sampled(cusp, start, |theta| {
                let out = self.base_radius * (1.5 + 0.4 * (theta - cusp) / TAU);
                self.placed(DVec2::new(x, y) + DVec2::from_angle(theta) * out, psi)
            });
            if let Some(end) = arc.last().filter(|_| off_centre) {
                d.level(*end, vec![format!("\u{3c6}_0 {}\u{b0}", fixed(self.pass.roll.to_degrees(), 2))]);
            }
            if off_centre {
                named(&mut d, Look::Fourth, "roll angle \u{3c6}\u{2080}", arc);
            }
            format!(
                "\u{3c6}\u{2080} = {roll} = {}\u{b0}, the thread unwound from the base circle",
                fixed(self.pass.roll.to_degrees(), 2)
            )
        };
        d.notes.push(format!(
            "T\u{2080} lies at X {} Y {} from O, at the distance \u{3c1} = {} mm. {roll}; R\u{2099} = {} mm is the radius of \
             curvature there. \u{3c8} = {}\u{b0}, {}, turns T\u{209a} of the involute for \u{3c8} = 0 into T\u{2080}. From T\u{2080} on \
             the lead-in is {} mm long, {} turns.",
            fixed(from[0], 3),
            fixed(from[1], 3),
            fixed(distance, 3),
            fixed(self.start_radius(), 3),
            fixed(psi.to_degrees(), 3),
            self.counted(),
            fixed(self.pass.length, 3),
            fixed(self.pass.visible_turns, 4),
        ));
        d
    }

    /// The angle psi at O from a direction before the mirror [rad].
    fn angle(&self, d: &mut Drawing, from: f64, radius: f64) {
        let (a, b) = if self.psi < 0.0 { (from + self.psi, from) } else { (from, from + self.psi) };
        let (from, to) = if self.clockwise { (PI - b, PI - a) } else { (a, b) };
        let text = format!("\u{3c8} {}\u{b0}", fixed(self.psi.to_degrees(), 3));
        d.angles.push(Angle { at: [0.0, 0.0], from, to, radius, text });
    }

    fn radius_words(&self) -> String {
        format!("R_n {}", fixed(self.start_radius(), 3))
    }

    fn evolute_name(&self) -> &'static str {
        if self.is_lens() { "evolute" } else { "base circle" }
    }

    fn counted(&self) -> &'static str {
        if self.clockwise { "counted clockwise" } else { "counted counter-clockwise" }
    }
}

/// A line with a name in the legend.
fn named(d: &mut Drawing, look: Look, name: &str, points: Vec<[f64; 2]>) {
    d.strokes.push(Stroke { look, name: name.to_owned(), points });
}

fn circle([x, y]: [f64; 2], radius: f64) -> Vec<[f64; 2]> {
    sampled(0.0, TAU, |at| [x + radius * at.cos(), y + radius * at.sin()])
}

/// Places between two angles, both ends among them.
fn sampled(from: f64, to: f64, at: impl Fn(f64) -> [f64; 2]) -> Vec<[f64; 2]> {
    grained(GRAIN, from, to, at)
}

fn grained(grain: f64, from: f64, to: f64, at: impl Fn(f64) -> [f64; 2]) -> Vec<[f64; 2]> {
    /// More would not be seen.
    const MOST: f64 = 20_000.0;
    let count = ((to - from).abs() / grain).ceil().clamp(1.0, MOST);
    (0..=count as u32).map(|i| at(from + (to - from) * f64::from(i) / count)).collect()
}
