//! From the user units of a page to mm: Y upwards, the origin in the lower left corner of the page.

use glam::{DAffine2, DMat2, DVec2};
use roxmltree::Node;
use svgtypes::{Length, ViewBox};

use super::path::unit_of;
use crate::base::Result;
use crate::geom::LengthUnit;
use crate::geom::outline::source::Source;

/// Difference of the scales across and up that is rounding of their digits.
const SAME_SCALE: f64 = 1e-3;

/// User units to mm, and notes.
pub(super) fn page(
    root: Node<'_, '_>,
    source: &Source,
    unit: Option<LengthUnit>,
    notes: &mut Vec<String>,
) -> Result<DAffine2> {
    let offset = root.range().start;
    let size = |name: &str| -> Option<(f64, Option<LengthUnit>)> {
        let length: Length = root.attribute(name)?.trim().parse().ok()?;
        let sound = length.number > 0.0 && length.number.is_finite();
        sound.then_some((length.number, unit_of(length.unit)))
    };
    let view: Option<ViewBox> = match root.attribute("viewBox") {
        None => None,
        Some(text) => {
            let view: Option<ViewBox> = text.parse().ok();
            let view =
                view.filter(|v| v.w > 0.0 && v.h > 0.0 && [v.x, v.y, v.w, v.h].iter().all(|x| x.is_finite()));
            Some(view.ok_or_else(|| source.error(offset, "the viewBox of the SVG file is not valid"))?)
        }
    };
    let (width, height) = (size("width"), size("height"));
    let scale = match (unit, &view) {
        (Some(unit), _) => unit.mm(),
        (None, Some(view)) => {
            let of = |size: Option<(f64, Option<LengthUnit>)>, whole: f64| {
                size.and_then(|(n, u)| Some(n * u?.mm() / whole))
            };
            match (of(width, view.w), of(height, view.h)) {
                (None, None) => return Err(unknown(source, offset)),
                (Some(one), None) | (None, Some(one)) => one,
                (Some(x), Some(y)) if (x - y).abs() <= SAME_SCALE * x => x,
                (Some(x), Some(y)) => {
                    let stretched =
                        root.attribute("preserveAspectRatio").is_some_and(|a| a.trim().starts_with("none"));
                    if stretched {
                        let what = "the SVG page is stretched: its scales across and up differ";
                        return Err(source
                            .error(offset, what)
                            .value(x, "mm a unit")
                            .bound(y, "mm a unit")
                            .help("make width and height fit the viewBox")
                            .into());
                    }
                    let least = if x < y { x } else { y };
                    notes.push(format!(
                        "width and height do not fit the viewBox: {least} mm a unit is taken, not {}",
                        if x < y { y } else { x }
                    ));
                    least
                }
            }
        }
        // Without a viewBox a user unit is a pixel, if lengths have units at all.
        (None, None) => match (width, height) {
            (Some((_, Some(_))), _) | (_, Some((_, Some(_)))) => LengthUnit::Pixel.mm(),
            _ => return Err(unknown(source, offset)),
        },
    };
    let low = match view {
        Some(view) => DVec2::new(view.x, view.y + view.h),
        None => {
            let up = height.map_or(0.0, |(n, u)| match (unit, u) {
                (None, Some(u)) => n * u.mm() / LengthUnit::Pixel.mm(),
                _ => n,
            });
            DVec2::new(0.0, up)
        }
    };
    let matrix = DMat2::from_diagonal(DVec2::new(scale, -scale));
    Ok(DAffine2::from_mat2_translation(matrix, -(matrix * low)))
}

fn unknown(source: &Source, offset: usize) -> crate::base::Error {
    source
        .error(offset, "unknown units: the width and height of the SVG file have no unit of length")
        .help("say the unit, for example mm, or give width and height in mm beside the viewBox")
        .into()
}
