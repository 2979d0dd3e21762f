//! The drawing of a drill point: outline to scale, every parameter with its name and value.
//!
//! Names are those of Belyakov and Seleznev 2023: D, 2φ, 2φ_1, 2φ_2, b_1, b_2, l (half a flat or slot), e (overlap), b
//! (apex), L_vr1 (length of the point). Angles of edges are drawn from the axis where the full angle would need room
//! below the tip.

use std::f64::consts::FRAC_PI_2;

use super::outline::{Core, half, silhouette};
use crate::base::Result;
use crate::page::{Along, Angle, Drawing, Look, fixed};
use crate::tool::DrillPoint;

/// Body drawn above the point, as a share of the diameter.
const BODY: f64 = 0.45;
/// Room at the sides of the body, as a share of the diameter.
const ROOM: f64 = 0.12;
/// Lowest place of an angle's corner below the tip, as a share of the diameter.
const LOWEST: f64 = 0.2;
/// Teeth of the broken end.
const TEETH: u32 = 12;

/// The drawing of a point of a diameter in millimetres.
///
/// ```
/// use kinecut::operations::drill::point_drawing;
/// use kinecut::tool::DrillPoint;
/// let drawing = point_drawing(&DrillPoint::SinglePlane { angle: 118f64.to_radians() }, 20.0).unwrap();
/// assert!(drawing.spans.iter().any(|s| s.text == "L_vr1 6.009"));
/// ```
///
/// # Errors
/// `KC0701` when it makes no point.
pub fn point_drawing(point: &DrillPoint, diameter: f64) -> Result<Drawing> {
    let edge = point.edge(diameter)?;
    let [low, high] = edge.extent();
    let radius = edge.outer_radius();
    let up = high + BODY * diameter;
    let room = ROOM * diameter;
    let title = format!("Point: {}", point.name());
    let window = [[-radius - room, low - room], [radius + room, up + 0.4 * room]];
    let mut pen = Pen { drawing: Drawing::new(title, window), diameter, up };
    pen.body(point, &silhouette(&edge, Core::of(point), 0.0, up));
    let d = &mut pen.drawing;
    d.line(Look::Axis, vec![[0.0, up + 0.4 * room], [0.0, low - room]]);
    d.span(Along::Above, [-radius, up], [radius, up], mm("D", diameter));
    let outer = edge.height(radius).unwrap_or(high);
    let top = if outer == high { [-radius, high] } else { [0.0, high] };
    let lowest = half(&edge).into_iter().find(|p| p[1] == low).unwrap_or([0.0, low]);
    d.span(Along::Left, [-lowest[0], low], top, mm("L_vr1", high - low));
    pen.parameters(point, radius);
    Ok(pen.drawing)
}

/// Name and length [mm].
pub(super) fn mm(name: &str, value: f64) -> String {
    format!("{name} {}", fixed(value, 3))
}

/// An angle [rad] in degrees with the digits that it has, three at most.
pub(super) fn degrees(value: f64) -> String {
    let text = fixed(value.to_degrees(), 3);
    format!("{}\u{b0}", text.trim_end_matches('0').trim_end_matches('.'))
}

struct Pen {
    drawing: Drawing,
    diameter: f64,
    up: f64,
}

impl Pen {
    fn body(&mut self, point: &DrillPoint, silhouette: &[[f64; 2]]) {
        let radius = self.diameter / 2.0;
        let up = self.up;
        let lip = match *point {
            DrillPoint::Cannon { overlap: e, edge_angle } => {
                let k = edge_angle.tan().recip();
                Some(vec![[-e, up], [-e, 0.0], [radius, (radius + e) * k], [radius, up]])
            }
            DrillPoint::Gun { apex, outer_angle, inner_angle } => {
                let apex = apex.unwrap_or(self.diameter / 4.0);
                let (ko, ki) = (outer_angle.tan().recip(), inner_angle.tan().recip());
                Some(vec![
                    [0.0, up],
                    [0.0, apex * ki],
                    [apex, 0.0],
                    [radius, (radius - apex) * ko],
                    [radius, up],
                ])
            }
            _ => None,
        };
        match lip {
            Some(lip) => {
                self.named(Look::Edge, "lip", lip);
                self.named(Look::Hidden, "what it sweeps when it turns", silhouette.to_vec());
            }
            None => self.drawing.line(Look::Edge, silhouette.to_vec()),
        }
        // The broken end.
        let tooth = 0.03 * self.diameter;
        let end = (0..=TEETH).map(|i| {
            let x = -radius + self.diameter * f64::from(i) / f64::from(TEETH);
            [x, up + if i % 2 == 0 { 0.0 } else { tooth }]
        });
        self.drawing.line(Look::Thin, end.collect());
    }

    fn named(&mut self, look: Look, name: &str, points: Vec<[f64; 2]>) {
        self.drawing.strokes.push(crate::page::Stroke { look, name: name.to_owned(), points });
    }

    fn parameters(&mut self, point: &DrillPoint, radius: f64) {
        let cot = |a: f64| (a / 2.0).tan().recip();
        match *point {
            DrillPoint::SinglePlane { angle }
            | DrillPoint::Auger { angle }
            | DrillPoint::Ejector { angle } => {
                self.full_angle([0.0, 0.0], angle, "φ");
            }
            DrillPoint::DoubleGround { angle, second } => {
                self.full_angle([0.0, 0.0], angle, "φ");
                let b1 = 0.2 * self.diameter;
                let r1 = radius - b1 * (second / 2.0).sin();
                self.outer_edge([r1, r1 * cot(angle)], b1, second, "1");
            }
            DrillPoint::CastIron { angle, second, third, slot } => {
                let (b1, b2) = (0.2 * self.diameter, 0.15 * self.diameter);
                let r2 = radius - b2 * (third / 2.0).sin();
                let r1 = r2 - b1 * (second / 2.0).sin();
                let z1 = (r1 - slot) * cot(angle);
                self.slot(slot, "l");
                self.full_angle([slot, 0.0], angle, "φ");
                self.outer_edge([r1, z1], b1, second, "1");
                self.outer_edge([r2, z1 + b1 * (second / 2.0).cos()], b2, third, "2");
            }
            DrillPoint::Rounded { radius: lips } => {
                let a = 0.6 * radius;
                let at = [a, lips - ((lips - a) * (lips + a)).sqrt()];
                self.drawing.level(at, vec![mm("ρ", lips)]);
            }
            DrillPoint::CornerRadius { angle, radius: corner } => {
                self.full_angle([0.0, 0.0], angle, "φ");
                let phi = angle / 2.0;
                let r = radius - corner + corner * phi.cos();
                let centre = [radius - corner, r * cot(angle) + corner * phi.sin()];
                // Half way between the lip's end and the margin.
                let turn = phi / 2.0;
                let at = [centre[0] + corner * turn.cos(), centre[1] - corner * turn.sin()];
                self.drawing.level(at, vec![mm("ρ", corner)]);
            }
            DrillPoint::ThinnedWeb { angle, flat } => {
                self.drawing.span(Along::Below, [0.0, 0.0], [flat, 0.0], mm("flat l", flat));
                self.full_angle([flat, 0.0], angle, "φ");
            }
            DrillPoint::SlottedChisel { angle, slot } => {
                self.slot(slot, "slot l");
                self.full_angle([slot, 0.0], angle, "φ");
            }
            DrillPoint::Annular { core } => {
                self.drawing.span(Along::Below, [-core / 2.0, 0.0], [core / 2.0, 0.0], mm("core d", core));
            }
            DrillPoint::Flat => self.full_angle([0.0, 0.0], std::f64::consts::PI, "φ"),
            DrillPoint::Cannon { overlap: e, edge_angle } => {
                if e > 0.0 {
                    self.drawing.span(Along::Below, [-e, 0.0], [0.0, 0.0], mm("overlap e", e));
                }
                self.edge_angle([-e, 0.0], edge_angle, 1.0, format!("α {}", degrees(edge_angle)));
            }
            DrillPoint::Gun { apex, outer_angle, inner_angle } => {
                let apex = apex.unwrap_or(self.diameter / 4.0);
                self.drawing.span(Along::Below, [0.0, 0.0], [apex, 0.0], mm("apex b", apex));
                self.edge_angle([apex, 0.0], outer_angle, 1.0, format!("α_o {}", degrees(outer_angle)));
                if apex > 0.0 {
                    self.edge_angle([apex, 0.0], inner_angle, -1.0, format!("α_i {}", degrees(inner_angle)));
                }
            }
            DrillPoint::Cone { angle, nose } => {
                if nose > 0.0 {
                    let r = nose / 2.0;
                    self.drawing.span(Along::Below, [-r, 0.0], [r, 0.0], mm("nose d", nose));
                }
                self.full_angle([nose / 2.0, 0.0], angle, "φ");
            }
            DrillPoint::Stepped { angle, .. } | DrillPoint::Centre { angle, .. } => {
                self.full_angle([0.0, 0.0], angle, "φ");
                for (i, s) in point.stages().iter().enumerate() {
                    let (n, r) = (i + 1, s.diameter / 2.0);
                    self.drawing.span(Along::Below, [-r, 0.0], [r, 0.0], mm(&format!("d_{n}"), s.diameter));
                    self.drawing.span(
                        Along::Left,
                        [-r, 0.0],
                        [-r, s.length],
                        mm(&format!("l_{n}"), s.length),
                    );
                    let text = format!("2ψ_{n} {}", degrees(s.shoulder));
                    if s.shoulder < std::f64::consts::PI {
                        self.edge_angle([r, s.length], s.shoulder / 2.0, 1.0, text + " (half)");
                    } else {
                        self.drawing.level([r, s.length], vec![text]);
                    }
                }
            }
        }
    }

    /// A slot across the chisel edge: nothing cuts there.
    fn slot(&mut self, slot: f64, name: &str) {
        if slot > 0.0 {
            self.drawing.span(Along::Below, [0.0, 0.0], [slot, 0.0], mm(name, slot));
        }
    }

    /// The point angle of edges through a point of the right one.
    fn full_angle(&mut self, at: [f64; 2], angle: f64, name: &str) {
        let phi = angle / 2.0;
        let apex = [0.0, at[1] - at[0] * phi.tan().recip()];
        if at[1] - apex[1] > LOWEST * self.diameter {
            let text = format!("2{name} {} (half)", degrees(angle));
            self.edge_angle(at, phi, 1.0, text);
            return;
        }
        if at[0] > 0.0 && apex[1] < at[1] {
            self.drawing.line(Look::Hidden, vec![[-at[0], at[1]], apex, at]);
            let lowest = &mut self.drawing.window[0][1];
            *lowest = lowest.min(apex[1] - 0.3 * ROOM * self.diameter);
        }
        self.drawing.angles.push(Angle {
            at: apex,
            from: FRAC_PI_2 - phi,
            to: FRAC_PI_2 + phi,
            radius: 0.28 * self.diameter,
            text: format!("2{name} {}", degrees(angle)),
        });
    }

    /// The angle of an edge from the axis, drawn at its inner end; to the right or to the left.
    fn edge_angle(&mut self, at: [f64; 2], angle: f64, side: f64, text: String) {
        let radius = 0.2 * self.diameter;
        self.drawing.line(Look::Thin, vec![at, [at[0], at[1] + 1.15 * radius]]);
        let (from, to) =
            if side > 0.0 { (FRAC_PI_2 - angle, FRAC_PI_2) } else { (FRAC_PI_2, FRAC_PI_2 + angle) };
        self.drawing.angles.push(Angle { at, from, to, radius, text });
    }

    /// A second or third edge with its length and angle.
    fn outer_edge(&mut self, from: [f64; 2], length: f64, angle: f64, number: &str) {
        let phi = angle / 2.0;
        let to = [from[0] + length * phi.sin(), from[1] + length * phi.cos()];
        self.drawing.span(Along::Line, from, to, mm(&format!("b_{number}"), length));
        self.edge_angle(from, phi, 1.0, format!("2φ_{number} {} (half)", degrees(angle)));
    }
}
