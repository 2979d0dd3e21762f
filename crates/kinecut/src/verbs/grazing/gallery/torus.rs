//! The torus: its outcomes, counted and shown, and its approximation by cones.

use super::tools::{bull, rim, rounding, shallow};
use super::{ConesError, GalleryCase, GalleryGroup, PaperClaim, PaperVerdict, TWISTS, case, count, twist};
use crate::base::Result;
use crate::sweep::{ProfileChain, cone_chain_error};
use crate::tool::Contour;
use crate::verbs::grazing::GrazingSheet;
use crate::verbs::grazing::survey::{PieceOutcome, first_arc, survey, twist_with};

/// Twists that are tried for a picture of an outcome.
const TRIES: u32 = 20_000;

/// The torus that bulges outwards, or inwards: a quarter, a rim over most of a half circle, and a part between. On a quarter
/// alone, whose normals reach those across the axis, some curve always passes.
pub(crate) fn torus(outwards: bool) -> Result<GalleryGroup> {
    let quarter = if outwards { bull()? } else { rounding()? };
    let tools = [quarter, rim(outwards)?, shallow(outwards)?];
    let chains = tools.each_ref().map(ProfileChain::new);
    let word = if outwards { "outward" } else { "inward" };
    let cases: Vec<GalleryCase> = PieceOutcome::ALL
        .into_iter()
        .filter_map(|outcome| {
            let found = |(chain, tool): (&ProfileChain, &Contour)| {
                let on = first_arc(chain);
                let twist = twist_with(chain, on, outcome, TRIES)?;
                let name = format!("Torus {word}: {}", outcome.words());
                Some(case(name, tool.clone(), twist, |s| folds_words(s, on)))
            };
            chains.iter().zip(&tools).find_map(found)
        })
        .collect();
    let surveys = chains.each_ref().map(|chain| survey(chain, first_arc(chain), TWISTS));
    let twists: u32 = surveys.iter().map(|s| s.twists).sum();
    let counts: [u32; 6] = std::array::from_fn(|k| surveys.iter().map(|s| s.outcomes[k]).sum());
    let shares: Vec<String> = PieceOutcome::ALL
        .iter()
        .zip(&counts)
        .map(|(o, n)| format!("{} {:.1} %", o.words(), 100.0 * f64::from(*n) / f64::from(twists)))
        .collect();
    // The statement: always one loop with one or two extrema, mostly a closed one.
    let holds = counts[4] > twists / 2 && counts[0] == 0 && counts[1] == 0;
    let claims = vec![PaperClaim {
        says: "A torus has one or two extrema along Oz; one loop is the general case.",
        verdict: PaperVerdict::of(holds),
        found: format!(
            "of {twists} twists on three tori: {}; never more than {} on an element",
            shares.join(", "),
            count(surveys.iter().map(|s| s.most_folds).max().unwrap_or(0), "fold")
        ),
    }];
    let title = if outwards { "Torus that bulges outwards" } else { "Torus that bulges inwards" };
    Ok(GalleryGroup { title, claims, cases, cones: Vec::new() })
}

fn folds_words(sheet: &GrazingSheet, on: usize) -> String {
    let mut at: Vec<String> = Vec::new();
    for span in sheet.grazing.spans.iter().filter(|s| s.piece == on) {
        for (fold, u) in [(span.folds[0], span.from), (span.folds[1], span.to)] {
            if fold {
                at.push(format!("{:.3}\u{b0}", u.to_degrees()));
            }
        }
    }
    let curves = count(sheet.loops.len(), "curve");
    match at.is_empty() {
        true => format!("no folds on the torus, {curves} on the tool"),
        false => format!("folds at normal angles of {}; {curves} on the tool", at.join(" and ")),
    }
}

/// Cones of the chains.
const CONES: [usize; 6] = [4, 8, 16, 32, 64, 128];

/// The chain of cones as a baseline.
pub(crate) fn cone_chain() -> Result<GalleryGroup> {
    let motions = [
        ("Ramp", twist([1.0, 0.0, -0.3], [0.0; 3])),
        ("Ramp while the tool turns", twist([0.8, 0.1, -0.25], [0.01, 0.03, 0.0])),
    ];
    let tools = [("bulging outward", bull()?), ("bulging inward", rounding()?)];
    let (mut cases, mut cones) = (Vec::new(), Vec::new());
    for ((name, motion), (which, tool)) in motions.into_iter().zip(tools) {
        let error = |cones| Ok(ConesError { cones, distance: cone_chain_error(&tool, &motion, cones)? });
        let errors: Vec<ConesError> = CONES.into_iter().map(error).collect::<Result<_>>()?;
        let last = errors.last().map_or(0.0, |e| e.distance);
        let found = format!("128 cones leave {:.1} \u{b5}m", 1e3 * last);
        cases.push(case(format!("{name}, torus {which}"), tool, motion, |_| found));
        cones.push(errors);
    }
    let factor = |e: &Vec<ConesError>| e[0].distance / e[CONES.len() - 1].distance;
    let claims = vec![PaperClaim {
        says: "The torus may be approximated by a chain of cones.",
        verdict: PaperVerdict::Unneeded,
        found: format!(
            "from 4 to 128 cones the largest distance from the exact curve falls by {} only: as 1/n. The exact curve of the \
             torus costs as much as that of one cone",
            cones.iter().map(|e| format!("{:.0}", factor(e))).collect::<Vec<_>>().join(" and ")
        ),
    }];
    Ok(GalleryGroup { title: "The torus as a chain of cones", claims, cases, cones })
}
