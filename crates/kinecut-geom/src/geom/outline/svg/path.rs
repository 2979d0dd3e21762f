//! Path data and basic shapes, drawn with a [`Pen`].

use glam::DVec2;
use roxmltree::Node;
use svgtypes::{Length, LengthUnit as SvgUnit, PathParser, PathSegment, PointsParser};

use super::pen::Pen;
use crate::base::{Code, Finding, Result};
use crate::geom::LengthUnit;

fn bad(message: String) -> crate::base::Error {
    Finding::error(Code::OUTLINE_FILE, message).into()
}

/// Draws an element; false for an element that draws nothing.
pub(super) fn draw(node: Node<'_, '_>, pen: &mut Pen) -> Result<bool> {
    match node.tag_name().name() {
        "path" => path(node.attribute("d").unwrap_or(""), pen)?,
        "rect" => rect(node, pen)?,
        "circle" => {
            let r = length(node, "r")?.unwrap_or(0.0);
            ellipse(node, DVec2::splat(r), pen)?;
        }
        "ellipse" => {
            let (rx, ry) = (length(node, "rx")?, length(node, "ry")?);
            let axes = DVec2::new(rx.or(ry).unwrap_or(0.0), ry.or(rx).unwrap_or(0.0));
            ellipse(node, axes, pen)?;
        }
        "line" => {
            pen.move_to(DVec2::new(of(node, "x1")?, of(node, "y1")?));
            pen.line_to(DVec2::new(of(node, "x2")?, of(node, "y2")?));
        }
        name @ ("polyline" | "polygon") => {
            let points = PointsParser::from(node.attribute("points").unwrap_or(""));
            for (i, (x, y)) in points.enumerate() {
                let p = finite(DVec2::new(x, y))?;
                if i == 0 { pen.move_to(p) } else { pen.line_to(p) }
            }
            if name == "polygon" {
                pen.close();
            }
        }
        _ => return Ok(false),
    }
    Ok(true)
}

fn ellipse(node: Node<'_, '_>, axes: DVec2, pen: &mut Pen) -> Result<()> {
    if !(axes.x > 0.0 && axes.y > 0.0) {
        return Err(Finding::error(Code::OUTLINE_EDGE, "the radius of a circle or ellipse must be positive")
            .value(if axes.x > 0.0 { axes.y } else { axes.x }, "")
            .into());
    }
    pen.ellipse(DVec2::new(of(node, "cx")?, of(node, "cy")?), axes)
}

/// A rectangle; its corners may be rounded.
fn rect(node: Node<'_, '_>, pen: &mut Pen) -> Result<()> {
    let (low, size) =
        (DVec2::new(of(node, "x")?, of(node, "y")?), DVec2::new(of(node, "width")?, of(node, "height")?));
    if !(size.x > 0.0 && size.y > 0.0) {
        return Err(bad("a rectangle needs a positive width and height".to_owned()));
    }
    let (rx, ry) = (length(node, "rx")?, length(node, "ry")?);
    let round = DVec2::new(rx.or(ry).unwrap_or(0.0), ry.or(rx).unwrap_or(0.0));
    let r = round.clamp(DVec2::ZERO, 0.5 * size);
    let high = low + size;
    let corner = |pen: &mut Pen, p: DVec2| pen.arc_to(r, 0.0, false, true, p);
    pen.move_to(DVec2::new(low.x + r.x, low.y));
    pen.line_to(DVec2::new(high.x - r.x, low.y));
    corner(pen, DVec2::new(high.x, low.y + r.y))?;
    pen.line_to(DVec2::new(high.x, high.y - r.y));
    corner(pen, DVec2::new(high.x - r.x, high.y))?;
    pen.line_to(DVec2::new(low.x + r.x, high.y));
    corner(pen, DVec2::new(low.x, high.y - r.y))?;
    pen.line_to(DVec2::new(low.x, low.y + r.y));
    corner(pen, DVec2::new(low.x + r.x, low.y))?;
    pen.close();
    Ok(())
}

fn path(data: &str, pen: &mut Pen) -> Result<()> {
    // Control points that smooth segments reflect.
    let (mut cubic, mut quadratic): (Option<DVec2>, Option<DVec2>) = (None, None);
    for segment in PathParser::from(data) {
        let segment = segment.map_err(|e| bad(format!("the path is not well formed: {e}")))?;
        let here = pen.here();
        let base = if segment.is_abs() { DVec2::ZERO } else { here };
        let at = |x: f64, y: f64| finite(base + DVec2::new(x, y));
        let (last_cubic, last_quadratic) = (cubic.take(), quadratic.take());
        match segment {
            PathSegment::MoveTo { x, y, .. } => pen.move_to(at(x, y)?),
            PathSegment::LineTo { x, y, .. } => pen.line_to(at(x, y)?),
            PathSegment::HorizontalLineTo { x, .. } => pen.line_to(DVec2::new(at(x, 0.0)?.x, here.y)),
            PathSegment::VerticalLineTo { y, .. } => pen.line_to(DVec2::new(here.x, at(0.0, y)?.y)),
            PathSegment::CurveTo { x1, y1, x2, y2, x, y, .. } => {
                cubic = Some(at(x2, y2)?);
                pen.cubic_to(at(x1, y1)?, at(x2, y2)?, at(x, y)?)?;
            }
            PathSegment::SmoothCurveTo { x2, y2, x, y, .. } => {
                cubic = Some(at(x2, y2)?);
                let first = 2.0 * here - last_cubic.unwrap_or(here);
                pen.cubic_to(first, at(x2, y2)?, at(x, y)?)?;
            }
            PathSegment::Quadratic { x1, y1, x, y, .. } => {
                quadratic = Some(at(x1, y1)?);
                pen.quadratic_to(at(x1, y1)?, at(x, y)?)?;
            }
            PathSegment::SmoothQuadratic { x, y, .. } => {
                let control = 2.0 * here - last_quadratic.unwrap_or(here);
                quadratic = Some(control);
                pen.quadratic_to(control, at(x, y)?)?;
            }
            PathSegment::EllipticalArc { rx, ry, x_axis_rotation, large_arc, sweep, x, y, .. } => {
                let axes = finite(DVec2::new(rx, ry))?;
                pen.arc_to(axes, x_axis_rotation.to_radians(), large_arc, sweep, at(x, y)?)?;
            }
            PathSegment::ClosePath { .. } => pen.close(),
        }
    }
    Ok(())
}

fn finite(p: DVec2) -> Result<DVec2> {
    if p.is_finite() { Ok(p) } else { Err(bad("a coordinate is not finite".to_owned())) }
}

fn of(node: Node<'_, '_>, name: &str) -> Result<f64> {
    Ok(length(node, name)?.unwrap_or(0.0))
}

/// An attribute as a length [user units]; `None` where it is not there or "auto".
fn length(node: Node<'_, '_>, name: &str) -> Result<Option<f64>> {
    let Some(text) = node.attribute(name).map(str::trim).filter(|t| *t != "auto") else { return Ok(None) };
    let not = || bad(format!("{name} is not a length: {:?}", text.chars().take(20).collect::<String>()));
    let found: Length = text.parse().map_err(|_| not())?;
    let unit = match found.unit {
        SvgUnit::None => return Ok(Some(found.number)),
        other => unit_of(other).ok_or_else(|| bad(format!("{name} is relative: {text:?}")))?,
    };
    Ok(Some(found.number * unit.mm() / LengthUnit::Pixel.mm()))
}

/// The unit of a length; `None` for shares and sizes of letters.
pub(super) fn unit_of(unit: SvgUnit) -> Option<LengthUnit> {
    match unit {
        SvgUnit::Mm => Some(LengthUnit::Millimetre),
        SvgUnit::Cm => Some(LengthUnit::Centimetre),
        SvgUnit::In => Some(LengthUnit::Inch),
        SvgUnit::Pt => Some(LengthUnit::Point),
        SvgUnit::Pc => Some(LengthUnit::Pica),
        SvgUnit::Px => Some(LengthUnit::Pixel),
        SvgUnit::None | SvgUnit::Em | SvgUnit::Ex | SvgUnit::Percent => None,
    }
}
