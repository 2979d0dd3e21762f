//! The give of a tool under a force across its axis.

use std::f64::consts::TAU;

use crate::cutting::{CuttingForce, MillingCut, RoundPart, tip_deflection};
use crate::tool::{Cutter, Tool};

/// Share of the cutting force that presses a mill away from the wall beside which it cuts.
pub(super) const RADIAL: f64 = 0.5;
/// Arc of contact up to which a mill cuts beside a wall [rad]: the teeth of a wider cut press it to several sides.
pub(super) const BESIDE: f64 = 0.25 * TAU + 1e-6;
/// Diameter of a round bar that is as stiff as the flutes, in diameters of the cutter.
const FLUTED: f64 = 0.8;

/// Deflection at the tip for each newton across the axis at the tip (mm/N); `None` where form or material of the tool is not known, and of
/// tools that work along their axis.
pub(super) fn give(tool: &Tool) -> Option<f64> {
    let (Cutter::EndMill { diameter } | Cutter::BallNose { diameter } | Cutter::BullNose { diameter, .. }) =
        tool.cutter
    else {
        return None;
    };
    let shank = RoundPart { length: tool.stickout - tool.flute_length, diameter: tool.shank_diameter };
    let flutes = RoundPart { length: tool.flute_length, diameter: FLUTED * diameter };
    Some(tip_deflection(1.0, tool.elasticity?, &[shank, flutes]))
}

/// Deflection of a tool's tip [mm] away from the wall beside which it makes a cut, by half of the force while teeth cut; `None` where it
/// cuts with more than a quarter of its circle, and where its give is not known.
pub(crate) fn deflection_beside(cut: &MillingCut, force: &CuttingForce, tool: &Tool) -> Option<f64> {
    let arc = cut.chip().engagement;
    if arc > BESIDE {
        return None;
    }
    let cutting = f64::from(cut.teeth.max(1)) * arc / TAU;
    Some(RADIAL * cut.load(force).force / cutting.min(1.0) * give(tool)?)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::job::file::{EdgeName, ToolTable, tool};

    #[test]
    fn a_longer_and_a_thinner_tool_gives_more() {
        let of = |diameter: f64, stickout: f64, material: Option<EdgeName>| {
            let flute_length = 13.0;
            let table = ToolTable {
                diameter,
                flute_length,
                stickout: Some(stickout),
                material,
                ..ToolTable::bare(1)
            };
            give(&tool(&table, &BTreeMap::new()).unwrap())
        };
        // 100 N on 20 mm of shank and 13 mm of flutes of a 6 mm mill of carbide.
        assert!((100.0 * of(6.0, 33.0, None).unwrap() - 0.034_148_467_568_859_725).abs() < 1e-9);
        let steel =
            of(6.0, 33.0, Some(EdgeName::Hss)).unwrap() / of(6.0, 33.0, Some(EdgeName::Carbide)).unwrap();
        assert!((steel - 600.0 / 210.0).abs() < 1e-12);
        // The body of a cutter with inserts is not known.
        assert!(of(25.0, 60.0, None).is_none() && of(25.0, 60.0, Some(EdgeName::Hss)).is_some());
    }
}
