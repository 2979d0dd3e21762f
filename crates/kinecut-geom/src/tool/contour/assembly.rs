//! A tool as clamped in the spindle: cutting part, shank and holder, one on the other.

use super::pen::Pen;
use super::{Contour, ElementRole, ToolForm};
use crate::base::{Code, Finding, Result};
use crate::tool::dimension::{positive, refuse};
use crate::tool::{Cutter, Holder, HolderSegment, Tool};

/// A cutting part with the shank and holder that carry it [mm].
#[derive(Clone, Debug, PartialEq)]
pub struct Assembly {
    /// The cutting part, its tip at height 0 as a rule.
    pub cutting: Contour,
    /// Diameter of the shank, which begins where the cutting part ends; none: the holder begins there.
    pub shank_diameter: Option<f64>,
    /// Height of the holder's face, and of the shank's end.
    pub stickout: f64,
    /// Segments of the holder, from its face upwards.
    pub holder: Vec<HolderSegment>,
}

impl Assembly {
    /// The whole as one contour. The cutting part is body 0; shank and holder follow, those that are there.
    ///
    /// # Errors
    /// `KC0701` with the name of the dimension: a stickout below the cutting part's end or, with a holder and no shank,
    /// beyond it; a segment without size.
    pub fn contour(&self) -> Result<Contour> {
        let end = self.cutting.height();
        let mut bodies = vec![(self.cutting.clone(), 0.0)];
        if !(self.stickout >= end) {
            return Err(refuse("stickout", "the stickout must cover the cutting part", self.stickout, end));
        }
        if let Some(diameter) = self.shank_diameter {
            positive("shank_diameter", diameter)?;
            if !self.stickout.is_finite() {
                return Err(refuse("stickout", "the stickout is not finite", self.stickout, end));
            }
            if self.stickout > end {
                let (radius, top) = (0.5 * diameter, self.stickout);
                bodies.push((
                    Pen::at(end).role(ElementRole::Shank).to(radius, end).to(radius, top).cap(top)?,
                    0.0,
                ));
            }
        } else if self.stickout > end && !self.holder.is_empty() {
            let what = "without a shank the holder must begin where the cutting part ends";
            return Err(refuse("stickout", what, self.stickout, end));
        }
        if !self.holder.is_empty() {
            bodies.push((holder(&self.holder, self.stickout)?, 0.0));
        }
        if bodies.len() == 1 { Ok(self.cutting.clone()) } else { Contour::stack(&bodies) }
    }
}

/// A holder with its face at a height.
fn holder(segments: &[HolderSegment], face: f64) -> Result<Contour> {
    let mut pen = Pen::at(face).role(ElementRole::Holder);
    let mut z = face;
    for (i, s) in segments.iter().enumerate() {
        for (key, value) in
            [("height", s.height), ("lower_diameter", s.lower_diameter), ("upper_diameter", s.upper())]
        {
            positive(key, value).map_err(|e| e.under(&format!("holder[{i}]")))?;
        }
        pen = pen.to(0.5 * s.lower_diameter, z);
        z += s.height;
        pen = pen.to(0.5 * s.upper(), z);
    }
    pen.cap(z)
}

impl Contour {
    /// The contour of a tool as the jobs know it: cutting part, shank and holder. Unlike the profiles by which a job is
    /// simulated it keeps hollows of a drill's edge and a holder that narrows upwards.
    ///
    /// # Errors
    /// `KC0701` when the numbers make no tool.
    pub fn of_tool(tool: &Tool) -> Result<Contour> {
        tool.check()?;
        let flute_length = tool.flute_length;
        let form = match tool.cutter {
            Cutter::EndMill { diameter } => ToolForm::EndMill { diameter, flute_length },
            Cutter::BallNose { diameter } => ToolForm::BallNose { diameter, flute_length },
            Cutter::BullNose { diameter, corner_radius } => {
                ToolForm::BullNose { diameter, corner_radius, flute_length }
            }
            Cutter::Tapered { tip_diameter: diameter, half_angle } => {
                ToolForm::Tapered { diameter, corner_radius: 0.0, half_angle, flute_length }
            }
            Cutter::Drill { diameter, ref point } => {
                ToolForm::Drill { diameter, point_angle: None, point: Some(point.clone()), flute_length }
            }
            Cutter::Tap(tap) => ToolForm::EndMill { diameter: tap.minor_diameter(), flute_length },
            Cutter::ThreadMill(mill) => match mill.neck.filter(|neck| neck.top > flute_length) {
                Some(neck) => ToolForm::TSlot {
                    diameter: mill.diameter,
                    height: flute_length,
                    corner_radius: 0.0,
                    neck_diameter: neck.diameter,
                    neck_length: neck.top,
                },
                None => ToolForm::EndMill { diameter: mill.diameter, flute_length },
            },
        };
        let segments = |holder: &Holder| holder.segments.clone();
        let assembly = Assembly {
            cutting: form.contour()?,
            shank_diameter: Some(tool.shank_diameter),
            stickout: tool.stickout,
            holder: tool.holder.as_ref().map(segments).unwrap_or_default(),
        };
        assembly.contour().map_err(|mut e| {
            if e.code() == Code::TOOL_VALUE {
                let Finding { message, .. } = &mut *e.0;
                *message = format!("{}: {message}", tool.number);
            }
            e
        })
    }
}
