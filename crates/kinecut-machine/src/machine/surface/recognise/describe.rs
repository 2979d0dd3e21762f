//! Recognised faces in words.

use std::fmt;

use super::{Form, Primitive, RecognisedFace};

/// A number with at most four decimals.
fn short(value: f64) -> f64 {
    (value * 1e4).round() / 1e4 + 0.0
}

impl fmt::Display for Primitive {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Primitive::Plane { normal, .. } => {
                let [x, y, z] = normal.to_array().map(short);
                write!(f, "plane with normal ({x}, {y}, {z})")
            }
            Primitive::Cylinder { radius } => write!(f, "circular cylinder of radius {} mm", short(radius)),
            Primitive::Cone { half_angle, .. } => {
                write!(f, "circular cone of half angle {} deg", short(half_angle.to_degrees()))
            }
            Primitive::Sphere { radius, .. } => write!(f, "sphere of radius {} mm", short(radius)),
            Primitive::Torus { major, minor } => {
                write!(f, "torus of radii {} and {} mm", short(major), short(minor))
            }
            Primitive::Revolution { radii: [from, to] } => {
                write!(f, "surface of revolution with radii from {} to {} mm", short(from), short(to))
            }
            Primitive::Screw { lead, radii: [from, to] } => {
                let hand = if lead < 0.0 { "left" } else { "right" };
                let lead = short(lead.abs());
                write!(
                    f,
                    "{hand}-handed screw surface of pitch {lead} mm, radii from {} to {} mm",
                    short(from),
                    short(to)
                )
            }
            Primitive::Extrusion { direction } => {
                let [x, y, z] = direction.to_array().map(short);
                write!(f, "extrusion along ({x}, {y}, {z})")
            }
            Primitive::General => write!(f, "general surface"),
        }
    }
}

impl RecognisedFace {
    /// Name in the catalogue of the surface whose generating lines fit, if there is one.
    pub fn catalogue_name(&self) -> Option<&'static str> {
        match self.primitive {
            Primitive::Plane { .. } => Some("plane"),
            Primitive::Cylinder { .. } => Some("cylinder"),
            Primitive::Cone { .. } => Some("cone"),
            Primitive::Sphere { .. } => Some("sphere"),
            Primitive::Torus { .. } => Some("torus"),
            Primitive::Revolution { .. } => Some("revolution"),
            Primitive::Screw { .. } => Some("screw"),
            Primitive::Extrusion { .. } => Some("extrusion"),
            Primitive::General => None,
        }
    }

    /// Generation of the face, in words: the motions that come for free, and those that the tool or a linked motion
    /// must bring.
    pub fn generation(&self) -> &'static str {
        match self.group.form {
            Form::Plane => {
                "two translations, or a translation and the rotation, make it with a point; one with an edge"
            }
            Form::Sphere => {
                "two rotations about axes through the centre make it with a point; one with an arc or a ring"
            }
            Form::Cylinder => {
                "the rotation and the translation make it with a point; either one with an edge"
            }
            Form::Revolution => {
                "the rotation is one motion; the profile comes from a linked motion or a form tool"
            }
            Form::Screw => {
                "the screw is one linked motion; the profile comes from a second motion or a form tool"
            }
            Form::Extrusion => {
                "the translation is one motion; the contour comes from a linked motion or a form tool"
            }
            Form::General => "no motion slides along it: both lines need motions of their own, or a die",
        }
    }
}

/// "right-handed screw surface of pitch 10 mm ...; free: right-handed screw of 10 mm per turn about the axis ...".
impl fmt::Display for RecognisedFace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.primitive)?;
        for (i, slide) in self.group.slides.iter().enumerate() {
            write!(f, "{} {slide}", if i == 0 { "; free:" } else { "," })?;
        }
        write!(f, "; {}", self.generation())?;
        if !self.outliers.is_empty() {
            write!(f, "; {} facets do not belong to it", self.outliers.len())?;
        }
        Ok(())
    }
}
