//! The tool of a known envelope as a body, and the motion that carries it, with numbers.
//!
//! The chain of the tool gives its surface. Its kind follows from the motions by which it slides in itself: a plane, a
//! ball, a cylinder and an involute flank have exact distances; anything else is a patch whose distance is found foot
//! by foot. The side of the tool follows from one contact, where its normal must face that of the wanted surface.

use glam::{DMat3, DQuat, DVec2, DVec3};

use super::{
    Distance, ElementaryBody, Hollow, InvoluteFlank, Meridian, MeridianPiece, ParametricSurface, Placed,
};
use crate::base::{Code, Finding, Result};
use crate::geom::Rigid;
use crate::machine::surface::{
    ChainElement, EnvelopeMethod, Form, GeneratedSurface, Sample, ShapeFunction, Slide, Variable,
    parse_chain, sliding_group,
};

/// The part of an enveloping tool's frame that matters, and the mounting in a spindle.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Stand {
    /// A ball: only its centre, in the frame of the tool's chain [mm].
    Centre(DVec3),
    /// A body of revolution, or a plane: its axis. Two ways to mount it; either will do.
    Axis([Rigid; 2]),
    /// Anything else: all of the frame.
    Frame,
}

/// An envelope with numbers.
pub(super) struct Touch {
    /// The frame of the tool in the work over the parameters of the motion.
    pub(super) motion: ShapeFunction,
    /// Ranges of the parameters.
    pub(super) domain: [[f64; 2]; 2],
    /// Names of the parameters.
    pub(super) names: [String; 2],
    /// For each parameter the variable of the surface with its name, and how far that is ahead.
    pub(super) follows: [Option<(usize, f64)>; 2],
    /// The tool.
    pub(super) body: Box<dyn Distance>,
    /// True if the sense of the body is open: a plane or a patch has no inside of its own.
    pub(super) open: bool,
    /// The tool in words.
    pub(super) what: String,
    /// The part of its frame that matters, and its mounting.
    pub(super) stand: Stand,
    /// True if the body is only one side of a tooth or a patch, which means nothing far from its contact.
    pub(super) local: bool,
}

impl Touch {
    /// Puts the numbers of a surface into an envelope.
    ///
    /// # Errors
    /// Those of [`EnvelopeMethod::values`], [`ShapeFunction::new`]; `KC1131` for a tool that is no surface.
    pub(super) fn new(surface: &GeneratedSurface, envelope: &EnvelopeMethod) -> Result<Touch> {
        let values = envelope.values(surface)?;
        let number = |formula: &str| -> Result<f64> {
            if formula.is_empty() {
                return Ok(0.0);
            }
            let names: Vec<&str> = values.iter().map(|(n, _)| n.as_str()).collect();
            let numbers: Vec<f64> = values.iter().map(|(_, v)| *v).collect();
            Ok(crate::machine::formula::Expression::parse(formula)?.bind(&names)?.value(&numbers))
        };
        let ahead = number(envelope.ahead)?;
        let follows: [Option<(usize, f64)>; 2] = [0, 1].map(|k| {
            let name = envelope.parameters.get(k)?;
            surface.variables.iter().position(|v| v.name == *name).map(|at| (at, ahead))
        });
        let domain = follows.map(|follow| {
            follow.map_or([0.0, 0.0], |(at, ahead)| {
                let variable = &surface.variables[at];
                [variable.from - ahead, variable.to - ahead]
            })
        });
        let names = [0, 1].map(|k| envelope.parameters.get(k).map_or("", |name| *name).to_owned());
        let carrier = pseudo(&values, [0, 1].map(|k| Variable::new(&names[k], domain[k][0], domain[k][1])));
        let place = if envelope.place.is_empty() { Vec::new() } else { parse_chain(envelope.place)? };
        let machine: Vec<ChainElement> = place.into_iter().chain(parse_chain(envelope.machine)?).collect();
        let motion = ShapeFunction::new(&carrier, &machine)?;

        let tool = parse_chain(envelope.tool)?;
        let ranges = envelope.variables.map(|name| {
            let own = surface.variables.iter().find(|v| v.name == name);
            own.map_or_else(|| Variable::new(name, ANY[0], ANY[1]), Clone::clone)
        });
        let held = pseudo(&values, ranges.clone());
        let edge = ShapeFunction::new(&held, &tool)?;
        let (body, open, what, stand) = tool_body(&held, &tool, &edge, &ranges)?;
        // A plane and a body of revolution are whole.
        let local = open && stand == Stand::Frame;
        Ok(Touch { motion, domain, names, follows, body, open, what, stand, local })
    }

    /// Values of the parameters at which the point of the surface at (u, v) is touched.
    pub(super) fn at(&self, uv: [f64; 2]) -> [f64; 2] {
        self.follows.map(|follow| follow.map_or(0.0, |(k, ahead)| uv[k] - ahead))
    }

    /// Turns the tool over: its inside becomes its outside.
    pub(super) fn turn_over(&mut self) {
        let none: Box<dyn Distance> = Box::new(ElementaryBody::Ball { centre: DVec3::ZERO, radius: 0.0 });
        self.body = Box::new(Hollow(std::mem::replace(&mut self.body, none)));
    }
}

impl Distance for Box<dyn Distance> {
    fn signed(&self, p: DVec3) -> f64 {
        (**self).signed(p)
    }

    fn gradient(&self, p: DVec3) -> DVec3 {
        (**self).gradient(p)
    }
}

/// A surface that only holds parameters and variables for a chain.
fn pseudo(values: &[(String, f64)], variables: [Variable; 2]) -> GeneratedSurface {
    GeneratedSurface {
        name: String::new(),
        title: String::new(),
        parameters: values.to_vec(),
        variables,
        directrix: Vec::new(),
        generatrix: Vec::new(),
        inward: false,
        inclined: [None; 3],
        implicit: None,
    }
}

type ToolBody = (Box<dyn Distance>, bool, String, Stand);

fn tool_body(
    held: &GeneratedSurface,
    chain: &[ChainElement],
    edge: &ShapeFunction,
    ranges: &[Variable; 2],
) -> Result<ToolBody> {
    let mut samples = Vec::with_capacity(SAMPLES * SAMPLES);
    for i in 0..SAMPLES {
        for j in 0..SAMPLES {
            let [a, b] = [(0, i), (1, j)].map(|(k, n)| ranges[k].at((n as f64 + 0.5) / SAMPLES as f64));
            if let Some(normal) = edge.normal(a, b) {
                samples.push(Sample { point: edge.point(a, b), normal, weight: 1.0 });
            }
        }
    }
    let group = sliding_group(&samples, 0.0)?;
    let (Some(first), Some(last)) = (samples.first(), samples.last()) else {
        return Err(Finding::error(Code::GENERATION_INPUT, "the tool of an envelope is no surface").into());
    };
    let turn = group.slides.iter().find_map(|slide| match *slide {
        Slide::Turn { axis, point, .. } => Some((axis, point)),
        Slide::Shift { .. } => None,
    });
    Ok(match (group.form, turn) {
        (Form::Plane, _) => {
            let body = ElementaryBody::HalfSpace { point: first.point, normal: first.normal };
            (Box::new(body), true, "a plane".to_owned(), Stand::Axis(mounts(DVec3::ZERO, first.normal)))
        }
        (Form::Sphere, _) => {
            // All normals pass through the centre.
            let apart = first.normal - last.normal;
            let radius = (first.point - last.point).dot(apart) / apart.length_squared();
            let centre = first.point - first.normal * radius;
            let radius = radius.abs();
            let what = format!("a ball of radius {} mm", Shown(radius));
            (Box::new(ElementaryBody::Ball { centre, radius }), false, what, Stand::Centre(centre))
        }
        (Form::Cylinder, Some((axis, point))) => {
            let stand = mounts(point, axis);
            // Heights from the foot of the frame's origin, as the mount counts them.
            let along = stand[0].rotation.z_axis;
            let heights: Vec<f64> = samples.iter().map(|s| s.point.dot(along)).collect();
            let low = heights.iter().copied().fold(f64::INFINITY, f64::min);
            let high = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let longer = LONGER * (high - low);
            let (low, high) = (low - longer, high + longer);
            let radius = (first.point - point).cross(axis).length();
            let corners = [[0.0, low], [radius, low], [radius, high], [0.0, high]].map(DVec2::from);
            let pieces =
                (0..3).map(|k| MeridianPiece::Line { from: corners[k], to: corners[k + 1] }).collect();
            let body = Placed::new(Meridian::new(pieces)?, stand[0]);
            (Box::new(body), false, format!("a cylinder of radius {} mm", Shown(radius)), Stand::Axis(stand))
        }
        (form, turn) => {
            if let Some(flank) = involute(held, chain, edge, ranges)? {
                let what = format!("an involute flank of base radius {} mm", Shown(flank.base));
                return Ok((Box::new(flank), true, what, Stand::Frame));
            }
            let revolution = turn.filter(|_| form == Form::Revolution);
            let domain = [0, 1].map(|k| {
                let Variable { from, to, .. } = ranges[k];
                let is_angle =
                    chain.first().is_some_and(|e| e.motion.is_rotation() && e.has(&ranges[k].name));
                // A tool of revolution is whole.
                if revolution.is_some() && is_angle {
                    [0.0, std::f64::consts::TAU]
                } else {
                    [from - MARGIN * (to - from), to + MARGIN * (to - from)]
                }
            });
            let stand = revolution.map_or(Stand::Frame, |(axis, point)| Stand::Axis(mounts(point, axis)));
            let body = ParametricSurface::new(edge.clone(), domain, TOOL_CELLS, false)?;
            let what = match revolution {
                Some(_) => "a body of revolution with its own profile".to_owned(),
                None => "a patch of a surface".to_owned(),
            };
            (Box::new(body), true, what, stand)
        }
    })
}

/// The flank, if the tool is an involute cylinder about Z.
fn involute(
    held: &GeneratedSurface,
    chain: &[ChainElement],
    edge: &ShapeFunction,
    ranges: &[Variable; 2],
) -> Result<Option<InvoluteFlank>> {
    let [_, base, ..] = chain else { return Ok(None) };
    let Some(base) = held.with_numbers(&base.law).constant().filter(|b| *b > 0.0) else { return Ok(None) };
    let flank = InvoluteFlank { base, start: 0.0, clockwise: false, teeth: 1 };
    let fits = (1..SAMPLES).all(|i| {
        let share = i as f64 / SAMPLES as f64;
        flank.signed(edge.point(ranges[0].at(share), ranges[1].at(share))).abs() < FITS * base
    });
    Ok(fits.then_some(flank))
}

/// Mounts that lay the axis of a spindle, Z, through a point along a direction, one way and the other.
fn mounts(point: DVec3, axis: DVec3) -> [Rigid; 2] {
    // The sense that needs the smaller turn first.
    let axis = if axis.z < 0.0 { -axis } else { axis };
    [axis, -axis].map(|axis| {
        let rotation = DMat3::from_quat(DQuat::from_rotation_arc(DVec3::Z, axis));
        // The foot of the frame's origin, so that the tip is where the chain has it.
        Rigid { rotation, translation: point - axis * axis.dot(point) }
    })
}

/// A length to a micrometre, without zeros at its end.
struct Shown(f64);

impl std::fmt::Display for Shown {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", (self.0 * 1e3).round() / 1e3)
    }
}

/// Part of a surface of a tool from which it is recognised, where the work does not say [mm or rad]: on all known tools it
/// is regular there.
const ANY: [f64; 2] = [0.2, 1.2];
/// Samples of each variable of the tool.
const SAMPLES: usize = 9;
/// Share of its length by which a cylinder is longer at each end than the surface to touch.
const LONGER: f64 = 0.5;
/// Share by which a patch is continued, so that no foot is on its border.
const MARGIN: f64 = 0.1;
/// Cells of a patch.
const TOOL_CELLS: [usize; 2] = [24, 16];
/// Relative distance at which points lie on an involute: rounding.
const FITS: f64 = 1e-10;
