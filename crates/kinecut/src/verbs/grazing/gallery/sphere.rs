//! The sphere: a great circle, and how much of it.

use super::tools::{ball, lollipop};
use super::{GalleryGroup, PaperClaim, PaperVerdict, case, twist};
use crate::base::Result;
use crate::sweep::{PieceShape, SegmentKind};
use crate::verbs::grazing::GrazingSheet;

/// Distance of a curve from a plane that is rounding, by the sphere's radius.
const ROUNDING: f64 = 1e-12;

/// Of the sphere of a sheet: largest distance of the curve from the plane through the centre square to its velocity, by the
/// radius; the longest branch and the whole of the curve on it [deg].
fn measured(sheet: &GrazingSheet) -> [f64; 3] {
    let mut found = [0.0f64; 3];
    for s in sheet.spans.iter().filter(|s| s.span.kind == SegmentKind::SphereArc) {
        let piece = &sheet.chain.pieces()[s.span.piece];
        let PieceShape::Arc { centre, radius } = piece.shape else { continue };
        let centre = glam::DVec3::new(0.0, 0.0, centre.y);
        let Some(square) = sheet.twist.velocity(centre).try_normalize() else { continue };
        for k in 0..=64 {
            for point in sheet.chain.grazing_points(&s.span, f64::from(k) / 64.0) {
                found[0] = found[0].max((point.point - centre).dot(square).abs() / radius);
            }
        }
        let angles = s.lengths.map(|l| (l / radius).to_degrees());
        found[1] = found[1].max(angles[0]).max(angles[1]);
        found[2] += angles[0] + angles[1];
    }
    found
}

pub(crate) fn sphere() -> Result<GalleryGroup> {
    let shown = |s: &GrazingSheet| {
        let [_, branch, whole] = measured(s);
        if let Some(&(piece, u)) = s.grazing.circles.first() {
            let p = s.chain.pieces()[piece].point(u);
            return format!("the circle of radius {:.3} mm at z {:.3} mm grazes as a whole", p.x, p.y);
        }
        format!("{whole:.1}\u{b0} of a great circle, each branch {branch:.1}\u{b0}")
    };
    let cases = vec![
        case("Ball, ramp", ball()?, twist([1.0, 0.2, -0.4], [0.0; 3]), shown),
        case("Ball, turning", ball()?, twist([0.7, -0.3, 0.2], [0.03, 0.02, 0.0]), shown),
        case("Lollipop, ramp", lollipop()?, twist([1.0, 0.3, -0.5], [0.0; 3]), shown),
        case("Lollipop, plunge", lollipop()?, twist([0.0, 0.0, -1.0], [0.0; 3]), shown),
    ];
    let all: Vec<[f64; 3]> = cases.iter().map(|c| measured(&c.sheet)).collect();
    let off = all.iter().map(|m| m[0]).fold(0.0, f64::max);
    let (branch, whole) = all.iter().fold((0.0f64, 0.0f64), |m, a| (m.0.max(a[1]), m.1.max(a[2])));
    let ball = all[0][2];
    let claims = vec![
        PaperClaim {
            says: "On a sphere the curve is part of a circle.",
            verdict: PaperVerdict::of(off <= ROUNDING),
            found: format!(
                "always of a great circle, square to the centre's velocity: the curves leave its plane by {off:.0e} of the radius"
            ),
        },
        PaperClaim {
            says: "On the sphere of a tool the arc is at most a quarter circle.",
            verdict: PaperVerdict::of(whole <= 90.0),
            found: format!(
                "{ball:.1}\u{b0} on the half sphere of a ball, up to {whole:.1}\u{b0} on a lollipop; one branch up to {branch:.1}\u{b0}"
            ),
        },
    ];
    Ok(GalleryGroup { title: "Sphere", claims, cases, cones: Vec::new() })
}
