//! The paper's statements on the grazing curve, each beside what the closed form gives: pictures, and numbers that decide
//! whether it holds.

mod sphere;
mod tools;
mod torus;

use std::f64::consts::FRAC_PI_2;

use glam::DVec3;
use serde::Serialize;

use self::tools::{annulus, collar, cylinder, flat, stack, taper};
use super::GrazingSheet;
use super::survey::{Survey, survey};
use crate::base::Result;
use crate::machine::Twist;
use crate::sweep::{PieceKind, PieceShape, ProfileChain, SegmentKind};
use crate::tool::Contour;

/// Twists of each count.
const TWISTS: u32 = 10_000;

/// Verdict on a statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum PaperVerdict {
    /// The numbers agree with it.
    #[serde(rename = "right")]
    Holds,
    /// The numbers agree with something more exact, or other.
    Corrected,
    /// It is right, and there is no need for it.
    #[serde(rename = "not needed")]
    Unneeded,
}

impl PaperVerdict {
    /// In a word.
    pub fn word(self) -> &'static str {
        match self {
            PaperVerdict::Holds => "right",
            PaperVerdict::Corrected => "corrected",
            PaperVerdict::Unneeded => "not needed",
        }
    }

    fn of(holds: bool) -> PaperVerdict {
        if holds { PaperVerdict::Holds } else { PaperVerdict::Corrected }
    }
}

/// A statement with the numbers about it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PaperClaim {
    /// Computed result.
    pub found: String,
    /// Statement of the paper.
    pub says: &'static str,
    /// Verdict on it.
    pub verdict: PaperVerdict,
}

/// A tool under a twist.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GalleryCase {
    /// Computed result.
    pub found: String,
    /// Subject of the case; letters, digits and hyphens make a name of a file of it.
    pub name: String,
    /// The sheet.
    pub sheet: GrazingSheet,
}

/// Distance of a chain of cones from the exact curve.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ConesError {
    /// Number of cones.
    pub cones: usize,
    /// Largest distance [mm].
    pub distance: f64,
}

/// Statements about one kind of element.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GalleryGroup {
    /// Pictures.
    pub cases: Vec<GalleryCase>,
    /// Statements.
    pub claims: Vec<PaperClaim>,
    /// Errors of chains of cones, by the case of the same index.
    pub cones: Vec<Vec<ConesError>>,
    /// Heading.
    pub title: &'static str,
}

/// The gallery.
///
/// # Errors
/// None for the tools that it has: the checks of contours and chains pass through.
pub fn gallery() -> Result<Vec<GalleryGroup>> {
    Ok(vec![
        cone()?,
        torus::torus(true)?,
        torus::torus(false)?,
        sphere::sphere()?,
        disc()?,
        parallel_normal()?,
        joining()?,
        torus::cone_chain()?,
    ])
}

/// A case whose name tells its number too.
fn case(
    name: impl Into<String>,
    contour: Contour,
    twist: Twist,
    found: impl FnOnce(&GrazingSheet) -> String,
) -> GalleryCase {
    let name = name.into();
    let sheet = GrazingSheet::new(name.clone(), contour, twist);
    GalleryCase { found: found(&sheet), name, sheet }
}

fn twist(velocity: [f64; 3], turn: [f64; 3]) -> Twist {
    Twist { shift: DVec3::from(velocity), turn: DVec3::from(turn) }
}

/// Numbers of curves on the tool and of spans on the piece.
fn counted(sheet: &GrazingSheet, piece: usize) -> String {
    let spans = sheet.grazing.spans.iter().filter(|s| s.piece == piece).count();
    let curves = sheet.loops.len();
    format!(
        "{} on {}, {} on the tool",
        count(spans, "piece"),
        sheet.piece_words(piece),
        count(curves, "curve")
    )
}

/// A number with its word.
pub(crate) fn count(n: usize, word: &str) -> String {
    format!("{n} {word}{}", if n == 1 { "" } else { "s" })
}

/// The first element that is a line neither along nor across the axis, or else one along it.
fn wall(chain: &ProfileChain) -> usize {
    let steep = |upright: bool| {
        chain.pieces().iter().position(|p| match p.shape {
            PieceShape::Line { normal, .. } => normal.x != 0.0 && (normal.y == 0.0) == upright,
            PieceShape::Arc { .. } => false,
        })
    };
    steep(false).or_else(|| steep(true)).unwrap_or(0)
}

fn cone() -> Result<GalleryGroup> {
    let (cone, cylinder) = (taper()?, cylinder()?);
    let chain = ProfileChain::new(&cone);
    let on = wall(&chain);
    let found = survey(&chain, on, TWISTS);
    let shown = |s: &GrazingSheet| counted(s, wall(&s.chain));
    let pieces = found.outcomes.iter().skip(1).sum::<u32>();
    let circles = |s: &GrazingSheet| {
        let at: Vec<String> = s
            .grazing
            .circles
            .iter()
            .map(|&(i, u)| format!("z {:.3} mm", s.chain.pieces()[i].point(u).y))
            .collect();
        format!("{} graze as a whole: {}", count(at.len(), "circle"), at.join(", "))
    };
    let cases = vec![
        case("Cone, ramp: straight generators", cone.clone(), twist([1.0, 0.3, -0.3], [0.0; 3]), shown),
        case("Cone, a ramp steeper than the cone", cone.clone(), twist([0.15, 0.05, -1.0], [0.0; 3]), shown),
        case(
            "Cone, turning: two pieces with a gap",
            cone,
            twist([0.55, 0.08, 0.25], [0.01, -0.045, 0.0]),
            shown,
        ),
        case(
            "Cylinder, turning about an axis that meets its own",
            cylinder,
            twist([0.6, 0.0, 0.0], [0.0, -0.04, 0.0]),
            circles,
        ),
    ];
    let crossing = &cases[3].sheet;
    let folds = crossing.grazing.spans.iter().filter(|s| s.folds != [false; 2]).count();
    let claims = vec![PaperClaim {
        says: "A rotation whose axis meets the axis of the tool gives two extrema along Oz.",
        verdict: PaperVerdict::of(folds == 2 && crossing.grazing.circles.is_empty()),
        found: format!(
            "{folds} folds: the curve runs through from bottom to top, and where the axes meet a whole circle of the cylinder grazes \
             too. In general folds are roots of a quadratic: of {} twists {pieces} graze the cone, none in more than {}, and {} of \
             them between two folds",
            found.twists,
            count(found.most_spans, "piece"),
            found.outcomes[4]
        ),
    }];
    Ok(GalleryGroup { title: "Cone and cylinder", claims, cases, cones: Vec::new() })
}

/// Straight segments of the curve on a disc.
fn chords(sheet: &GrazingSheet, piece: usize) -> usize {
    let of = sheet.grazing.spans.iter().filter(|s| s.piece == piece && s.kind == SegmentKind::DiscChord);
    // Both branches of a span with a fold are one line.
    of.map(|s| if s.folds == [false; 2] { 2 } else { 1 }).sum()
}

fn disc() -> Result<GalleryGroup> {
    let tool = annulus()?;
    let chain = ProfileChain::new(&tool);
    let is_ring = |p: &crate::sweep::ChainPiece| {
        matches!(p.shape, PieceShape::Line { normal, .. } if normal.y == -1.0) && p.point(p.from).x > 0.0
    };
    let ring = chain.pieces().iter().position(is_ring).unwrap_or(0);
    let shown = move |s: &GrazingSheet| {
        if s.grazing.whole.contains(&ring) {
            return "the whole disc grazes".to_owned();
        }
        let away = s.twist.shift.z.abs() / s.twist.turn.truncate().length();
        format!("{} on the ring, {away:.2} mm from the axis", count(chords(s, ring), "straight segment"))
    };
    let spin = [0.02, 0.05, 0.0];
    let lever = DVec3::from(spin).length();
    let at = |distance: f64| twist([0.2, 0.1, lever * distance], spin);
    let cases = vec![
        case("Disc with a hollow: none", tool.clone(), at(13.0), shown),
        case("Disc with a hollow: one segment", tool.clone(), at(8.0), shown),
        case("Disc with a hollow: two segments", tool.clone(), at(3.0), shown),
        case("Disc with a hollow: whole", tool, twist([1.0, 0.4, 0.0], [0.0; 3]), shown),
    ];
    let seen: Vec<String> = cases
        .iter()
        .map(|c| {
            if c.sheet.grazing.whole.contains(&ring) {
                "the whole disc".to_owned()
            } else {
                chords(&c.sheet, ring).to_string()
            }
        })
        .collect();
    let only = cases.iter().all(|c| matches!(chords(&c.sheet, ring), 1 | 2));
    let claims = vec![PaperClaim {
        says: "On a disc the curve is one or two straight segments.",
        verdict: PaperVerdict::of(only),
        found: format!(
            "{} at the distances |vz| / |w_xy| of 13, 8 and 3 mm and in a move across the axis",
            seen.join(", ")
        ),
    }];
    Ok(GalleryGroup { title: "Disc", claims, cases, cones: Vec::new() })
}

/// Claims about a normal parallel to the axis: the circle between a disc and its edge.
fn parallel_normal() -> Result<GalleryGroup> {
    let tool = flat()?;
    let chain = ProfileChain::new(&tool);
    let edge = chain.pieces().iter().position(|p| p.kind == PieceKind::Edge).unwrap_or(0);
    let radius = chain.pieces()[edge].point(0.0).x;
    let spin = [0.0, 0.06, 0.0];
    // Two points where the discriminant is positive, one where it is zero but for rounding.
    let points = move |s: &GrazingSheet| {
        let v = s.chain.normal_velocity(&s.twist, edge, -FRAC_PI_2);
        let d = v.discriminant() / (v.mean * v.mean).max(1e-300);
        if d > 1e-9 {
            2
        } else if d > -1e-9 {
            1
        } else {
            0
        }
    };
    let shown = |s: &GrazingSheet| {
        format!("{} with a normal along the axis on the circle of radius {radius}", count(points(s), "point"))
    };
    let at = |part: f64| twist([0.4, 0.2, part * radius * spin[1]], spin);
    let cases = vec![
        case("Edge of a disc, |vz| = 0.5 x |w|", tool.clone(), at(0.5), shown),
        case("Edge of a disc, |vz| = x |w|", tool.clone(), at(1.0), shown),
        case("Edge of a disc, |vz| = 1.5 x |w|", tool, at(1.5), shown),
    ];
    let seen: Vec<usize> = cases.iter().map(|c| points(&c.sheet)).collect();
    let claims = vec![PaperClaim {
        says: "A normal parallel to the axis puts the point Q at infinity: boundary points only if the velocity in Q is perpendicular to the axis.",
        verdict: PaperVerdict::of(seen == [0, 0, 0]),
        found: format!(
            "{} points for |vz| of 0.5, 1 and 1.5 times x |w_xy|, none of them with velocities perpendicular to the axis in Q",
            seen.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")
        ),
    }];
    Ok(GalleryGroup { title: "Normal parallel to the axis", claims, cases, cones: Vec::new() })
}

fn joining() -> Result<GalleryGroup> {
    let tools = [("Stepped tool with shank and holder", stack()?), ("Tool with a collar", collar()?)];
    let surveys: Vec<Survey> = tools.iter().map(|(_, t)| survey(&ProfileChain::new(t), 0, TWISTS)).collect();
    let shown = |s: &GrazingSheet| {
        let joins = s.grazing.spans.iter().filter(|p| p.kind == SegmentKind::Join).count();
        let windings: u32 = s.loops.iter().map(|l| u32::from(l.winding)).sum();
        format!(
            "{}, sum of windings {windings}, {} across concave edges",
            count(s.loops.len(), "closed curve"),
            count(joins, "span")
        )
    };
    let motions = [twist([0.9, 0.2, -0.3], [0.0; 3]), twist([-0.5, 0.3, 0.25], [0.02, 0.03, 0.0])];
    let cases = tools.into_iter().zip(motions).map(|((name, t), m)| case(name, t, m, shown)).collect();
    let sum = |f: fn(&Survey) -> u32| surveys.iter().map(f).sum::<u32>();
    let (open, even) = (sum(|s| s.open), sum(|s| s.even));
    let claims = vec![PaperClaim {
        says: "Segments of neighbouring elements are joined where the cutting surface changes to the non-cutting one.",
        verdict: PaperVerdict::of(open == 0 && even == 0),
        found: format!(
            "with \u{201c}cutting\u{201d} read as the sign of the normal velocity: of {} twists on two tools {open} curves stay open, and \
             the windings have an even sum in {even}; up to {} at once",
            2 * TWISTS,
            count(surveys.iter().map(|s| s.most_loops).max().unwrap_or(0), "curve")
        ),
    }];
    Ok(GalleryGroup { title: "Joining the elements", claims, cases, cones: Vec::new() })
}
