//! From the shape of a tool as written to its contour.

use std::f64::consts::PI;

use crate::base::{Code, FileKind, Finding, Loader, Result};
use crate::geom::{OutlineOptions, SectionAxis};
use crate::job::file::{AptTable, DrillShapeTable, SectionTable, ToolShapeTable};
use crate::tool::{Apt, Contour, ContourRead, DrillPoint, ToolForm};

/// How far the diameter of APT may lie from what the other parameters make of it [mm]: the third decimal, as CLDATA is
/// printed.
const PRINTED: f64 = 1e-3;
/// Largest snap of a drawing of a tool [mm].
const LARGEST_SNAP: f64 = 1.0;

/// The contour of the cutting part, and what is to be said of a drawing.
pub(super) fn shape(table: &ToolShapeTable, loader: &dyn Loader) -> Result<ContourRead> {
    let (name, made) = match table {
        ToolShapeTable::Outline(t) => ("outline", section(t, loader)),
        ToolShapeTable::Contour(t) => ("contour", t.contour().map(plain)),
        other => {
            let (name, form) = form(other);
            (name, form.and_then(|f| f.contour()).map(plain).map_err(renamed))
        }
    };
    made.map_err(|e| e.under(&format!("shape.{name}")))
}

fn plain(contour: Contour) -> ContourRead {
    ContourRead { contour, notes: Vec::new() }
}

/// Keys of dimensions as they are written here.
fn renamed(mut error: crate::base::Error) -> crate::base::Error {
    if error.0.key.as_deref() == Some("length") {
        error.0.key = Some("flute_length".to_owned());
    }
    error
}

fn form(table: &ToolShapeTable) -> (&'static str, Result<ToolForm>) {
    use ToolForm as F;
    use ToolShapeTable as T;
    let rad = f64::to_radians;
    let neck = |diameter: Option<f64>, length: Option<f64>| (diameter.unwrap_or(0.0), length.unwrap_or(0.0));
    match table {
        T::EndMill(t) => ("end-mill", Ok(F::EndMill { diameter: t.diameter, length: t.flute_length })),
        T::BallNose(t) => ("ball-nose", Ok(F::BallNose { diameter: t.diameter, length: t.flute_length })),
        T::BullNose(t) => {
            let (diameter, corner_radius) = (t.diameter, t.corner_radius);
            ("bull-nose", Ok(F::BullNose { diameter, corner_radius, length: t.flute_length }))
        }
        T::Tapered(t) => {
            let (corner_radius, half_angle) = (t.corner_radius, rad(t.half_angle));
            let form =
                F::Tapered { tip_diameter: t.diameter, corner_radius, half_angle, length: t.flute_length };
            ("tapered", Ok(form))
        }
        T::TaperedBall(t) => {
            let (ball_diameter, half_angle) = (t.ball_diameter, rad(t.half_angle));
            ("tapered-ball", Ok(F::TaperedBall { ball_diameter, half_angle, length: t.flute_length }))
        }
        T::Barrel(t) => {
            let (diameter, profile_radius) = (t.diameter, t.profile_radius);
            ("barrel", Ok(F::Barrel { diameter, profile_radius, length: t.flute_length }))
        }
        T::Oval(t) => {
            let (diameter, profile_radius, tip_radius) = (t.diameter, t.profile_radius, t.tip_radius);
            let (neck_diameter, length) = (t.neck_diameter, t.neck_length);
            ("oval", Ok(F::Oval { diameter, profile_radius, tip_radius, neck_diameter, length }))
        }
        T::Tangent(t) => {
            let (diameter, profile_radius, tip_radius) = (t.diameter, t.profile_radius, t.tip_radius);
            ("tangent", Ok(F::Tangent { diameter, profile_radius, tip_radius, length: t.flute_length }))
        }
        T::Taper(t) => {
            let (diameter, profile_radius, tip_radius) = (t.diameter, t.profile_radius, t.tip_radius);
            let (half_angle, length) = (rad(t.half_angle), t.flute_length);
            ("taper", Ok(F::Taper { diameter, profile_radius, tip_radius, half_angle, length }))
        }
        T::Lens(t) => {
            let (diameter, profile_radius, corner_radius) = (t.diameter, t.profile_radius, t.corner_radius);
            ("lens", Ok(F::Lens { diameter, profile_radius, corner_radius, length: t.flute_length }))
        }
        T::Lollipop(t) => {
            let (diameter, neck_diameter) = (t.diameter, t.neck_diameter);
            ("lollipop", Ok(F::Lollipop { diameter, neck_diameter, length: t.neck_length }))
        }
        T::Dovetail(t) => {
            let (neck_diameter, length) = neck(t.neck_diameter, t.neck_length);
            let (diameter, corner_radius, height) = (t.diameter, t.corner_radius, t.height);
            let form =
                F::Dovetail { diameter, angle: rad(t.angle), corner_radius, height, neck_diameter, length };
            ("dovetail", Ok(form))
        }
        T::TSlot(t) => {
            let (neck_diameter, length) = neck(t.neck_diameter, t.neck_length);
            let (diameter, height, corner_radius) = (t.diameter, t.height, t.corner_radius);
            ("t-slot", Ok(F::TSlot { diameter, height, corner_radius, neck_diameter, length }))
        }
        T::Convex(t) => {
            let (neck_diameter, length) = neck(t.neck_diameter, t.neck_length);
            let (diameter, profile_radius) = (t.diameter, t.profile_radius);
            ("convex", Ok(F::Convex { diameter, profile_radius, neck_diameter, length }))
        }
        T::Concave(t) => {
            let (neck_diameter, length) = neck(t.neck_diameter, t.neck_length);
            let (diameter, profile_radius, height) = (t.diameter, t.profile_radius, t.height);
            ("concave", Ok(F::Concave { diameter, profile_radius, height, neck_diameter, length }))
        }
        T::Drill(t) => ("drill", drill(t)),
        T::Countersink(t) => {
            let (diameter, nose_diameter, length) = (t.diameter, t.nose_diameter, t.flute_length);
            ("countersink", Ok(F::Countersink { diameter, angle: rad(t.angle), nose_diameter, length }))
        }
        T::HollowMill(t) => {
            let (diameter, core_diameter, depth) = (t.diameter, t.core_diameter, t.depth);
            ("hollow-mill", Ok(F::HollowMill { diameter, core_diameter, depth, length: t.flute_length }))
        }
        T::CornerRounding(t) => {
            let (tip_diameter, tip_length, radius, length) =
                (t.tip_diameter, t.tip_length, t.radius, t.length);
            let diameter = t.diameter.unwrap_or(tip_diameter + 2.0 * radius);
            ("corner-rounding", Ok(F::CornerRounding { tip_diameter, tip_length, radius, diameter, length }))
        }
        T::Dished(t) => {
            let (diameter, dish_angle) = (t.diameter, rad(t.dish_angle));
            let (corner_radius, length) = (t.corner_radius, t.flute_length);
            ("dished", Ok(F::Dished { diameter, dish_angle, corner_radius, length }))
        }
        T::Apt(t) => ("apt", apt(t).map(F::Apt)),
        // Not forms; the caller has them.
        T::Outline(_) | T::Contour(_) => {
            ("outline", Err(Finding::error(Code::JOB_SHAPE, "an outline has no dimensions").into()))
        }
    }
}

fn drill(t: &DrillShapeTable) -> Result<ToolForm> {
    let point = DrillPoint::of_keys(t.point.as_ref(), t.point_angle, t.diameter)?;
    Ok(ToolForm::Drill { diameter: t.diameter, point, length: t.flute_length })
}

fn apt(t: &AptTable) -> Result<Apt> {
    let centre_radius = match (t.centre_radius, t.diameter) {
        (Some(e), _) => e,
        (None, Some(d)) => 0.5 * d - t.corner_radius,
        (None, None) => {
            return Err(Finding::error(
                Code::JOB_SHAPE,
                "a tool by APT needs its diameter, or the place of its corner",
            )
            .key("diameter")
            .into());
        }
    };
    let apt = Apt {
        corner_radius: t.corner_radius,
        centre_radius,
        centre_height: t.centre_height.unwrap_or(t.corner_radius),
        lower_angle: t.lower_angle.to_radians(),
        upper_angle: t.upper_angle.to_radians(),
        height: t.height,
    };
    if let (Some(_), Some(given)) = (t.centre_radius, t.diameter)
        && (t.lower_angle + t.upper_angle).to_radians() < 0.5 * PI - PRINTED
        && !((given - apt.diameter()).abs() <= PRINTED)
    {
        return Err(Finding::error(
            Code::TOOL_VALUE,
            "the diameter is not what the other parameters make it",
        )
        .value_mm(given)
        .bound_mm(apt.diameter())
        .key("diameter")
        .help("leave it out: it follows from r, e, f, alpha and beta")
        .into());
    }
    Ok(apt)
}

fn section(t: &SectionTable, loader: &dyn Loader) -> Result<ContourRead> {
    let usual = OutlineOptions::default();
    let snap = t.snap.unwrap_or(usual.snap);
    if !(0.0..=LARGEST_SNAP).contains(&snap) {
        return Err(Finding::error(Code::JOB_VALUE, "the snap is out of range")
            .value_mm(snap)
            .bound_mm(if snap < 0.0 { 0.0 } else { LARGEST_SNAP })
            .key("snap")
            .into());
    }
    let options = OutlineOptions {
        unit: t.unit,
        snap,
        layers: t.layers.clone().unwrap_or_default(),
        half_section: Some(t.axis.unwrap_or(SectionAxis::Y)),
        ..usual
    };
    ContourRead::of_drawing(&t.file, &loader.read_as(&t.file, FileKind::Drawing)?, &options)
}
