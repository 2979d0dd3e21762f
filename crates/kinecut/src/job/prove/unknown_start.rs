//! Moves whose start the program does not say: right programs begin with a rapid, above the part or beside it. One that ends
//! down in the stock, or below the top of a clamp, may have met anything on its way, and so may a move at feed that is not all above
//! them.

use glam::DVec3;

use super::Simulated;
use crate::base::{Code, Finding, Result};
use crate::geom::Aabb;
use crate::job::setup_outcome::SetupOutcome;
use crate::operations::setting::corners;
use crate::tool::Tool;
use crate::trace::Untraced;

/// Distance of a tool from the box of a body above which its end is clear of it [mm].
const MARGIN: f64 = 1.0;

/// Moves from an unknown position that end in the box of the stock or of a fixture: one doubt for each block.
pub(super) fn unknown_start(simulated: &Simulated<'_>) -> Vec<Finding> {
    let one = |(setup, done): (usize, &SetupOutcome)| -> Vec<Finding> {
        let bodies = bodies_on_table(simulated, done, setup);
        let doubt = |untraced: &Untraced| {
            let may_meet = |bounds: Aabb| match untraced.feed {
                true => !is_above(untraced, bounds),
                false => ends_in(simulated, untraced, bounds),
            };
            let (name, _) = bodies.iter().find(|(_, bounds)| may_meet(*bounds))?;
            let what = match (untraced.feed, name) {
                (true, None) => {
                    "a feed move starts where the position is not known: it was not cut, and may have cut anything"
                        .to_owned()
                }
                (true, Some(name)) => {
                    format!("a feed move starts where the position is not known, and may meet `{name}`")
                }
                (false, None) => {
                    "a rapid starts where the position is not known, and ends below the top of the stock".to_owned()
                }
                (false, Some(name)) => {
                    format!("a rapid starts where the position is not known, and ends below the top of `{name}`")
                }
            };
            let finding = Finding::doubt(Code::UNKNOWN_START, what);
            let finding = finding.help("position all axes above the part first, then come down");
            Some(Finding { place: simulated.place(setup, untraced.item), ..finding })
        };
        done.trace.untraced.iter().filter_map(doubt).collect()
    };
    simulated.setups.iter().enumerate().flat_map(one).collect()
}

/// The boxes of the stock, first, and of the fixtures with their names, in the table frame of a setup.
fn bodies_on_table<'a>(
    simulated: &Simulated<'a>,
    done: &SetupOutcome,
    setup: usize,
) -> Vec<(Option<&'a str>, Aabb)> {
    let own = &simulated.job.setups[setup].setup;
    let placed = done.program.setups.first().map_or(own.part_on_table, |setup| setup.part_on_table);
    let to_table = placed.after(&own.part_on_table.inverse());
    let stock = Aabb::of_points(corners(&simulated.job.stock.bounds(), &placed));
    let fixtures = own.fixtures.iter().map(|fixture| {
        let bounds = Aabb::of_points(corners(&fixture.solid.bounds(), &to_table.after(&fixture.place)));
        (Some(fixture.name.as_str()), bounds)
    });
    std::iter::once((None, stock)).chain(fixtures).collect()
}

/// Whether a move of an upright tool is above the box from its start to its end.
fn is_above(untraced: &Untraced, bounds: Aabb) -> bool {
    let above = |end: [Option<f64>; 3]| end[2].is_some_and(|z| z > bounds.max.z + MARGIN);
    untraced.axis == DVec3::Z && above(untraced.start) && above(untraced.end)
}

/// Whether a move may end in the box: of an upright tool by what is known of its end, of a leaning one where all is known.
fn ends_in(simulated: &Simulated<'_>, untraced: &Untraced, bounds: Aabb) -> bool {
    let tool = simulated.job.tools.iter().find(|t| Some(t.number) == untraced.tool);
    let Some((radius, top)) = tool.and_then(|t| size(t).ok()) else { return false };
    let [x, y, z] = untraced.end;
    let (along, reach) = (untraced.axis, radius + MARGIN);
    if along == DVec3::Z {
        // A height that is not known is the operator's.
        let Some(z) = z else { return false };
        let beside =
            |at: Option<f64>, low: f64, high: f64| at.is_some_and(|q| q < low - reach || q > high + reach);
        return z < bounds.max.z
            && !beside(x, bounds.min.x, bounds.max.x)
            && !beside(y, bounds.min.y, bounds.max.y);
    }
    let (Some(x), Some(y), Some(z)) = (x, y, z) else { return false };
    let tip = DVec3::new(x, y, z);
    Aabb::of_points([tip, tip + along * top]).grown(reach).meets(bounds)
}

/// Greatest radius of a tool with its holder, and its height above the tip [mm].
fn size(tool: &Tool) -> Result<(f64, f64)> {
    Ok(tool.profiles()?.iter().fold((0.0f64, 0.0f64), |(radius, top), (profile, at)| {
        (radius.max(profile.max_radius()), top.max(at + profile.top()))
    }))
}
