//! What a tool meets that it should not is found however thin the overlap is beside the distance of the lines: slots in
//! random directions and arcs, random steps, tool axes and offsets. What should be met is known from the construction
//! alone: a slot, and a tool that comes back beside its path by a known amount.

use glam::{DQuat, DVec3};
use kinecut::base::Silent;
use kinecut::geom::{Aabb, Arc, Curve, Line, Profile};
use kinecut::stock::TriDexel;
use kinecut::stock::cut::{CutAxis, CutMove, CutOptions, MoveEffect, ToolBody, cut};
use proptest::prelude::*;

/// A block of 60 x 60 x 20 mm along the tool axis, its top at 0, its middle on the axis.
struct Block {
    axis: CutAxis,
    stock: TriDexel,
}

impl Block {
    fn new(axis: CutAxis, step: f64) -> Block {
        let place = |p: DVec3| turn(axis, p);
        let (a, b) = (place(DVec3::new(-30.0, -30.0, -20.0)), place(DVec3::new(30.0, 30.0, 0.0)));
        Block { axis, stock: TriDexel::from_box(Aabb { min: a.min(b), max: a.max(b) }, step).unwrap() }
    }

    fn cut(&mut self, tool: &ToolBody, moves: &[(Curve, bool)]) -> Vec<MoveEffect> {
        let moves: Vec<CutMove> = moves
            .iter()
            .map(|(curve, watch)| {
                let there = kinecut::geom::Rigid {
                    rotation: glam::DMat3::from_quat(quat(self.axis)),
                    translation: DVec3::ZERO,
                };
                CutMove { watch: *watch, ..CutMove::new(curve.moved(&there), self.axis, 0) }
            })
            .collect();
        cut(&mut self.stock, std::slice::from_ref(tool), &moves, &CutOptions::default(), &Silent).unwrap()
    }
}

fn quat(axis: CutAxis) -> DQuat {
    DQuat::from_rotation_arc(DVec3::Z, axis.vector())
}

/// Rounded, so that boxes stay boxes.
fn turn(axis: CutAxis, p: DVec3) -> DVec3 {
    ((quat(axis) * p) * 1e6).round() / 1e6
}

/// A cutter of 12 mm with 6 mm of flutes, a shank as thick, a holder.
fn tool(flutes: f64, shank: Option<f64>, holder: Option<f64>) -> ToolBody {
    ToolBody {
        shank: shank.into_iter().map(|d| (Profile::cylinder(d, 30.0).unwrap(), flutes)).collect(),
        holder: holder.into_iter().map(|d| (Profile::cylinder(d, 30.0).unwrap(), flutes + 2.0)).collect(),
        ..ToolBody::new(Profile::cylinder(12.0, flutes).unwrap())
    }
}

fn way(a: DVec3, b: DVec3) -> Curve {
    Line { start: a, end: b }.into()
}

fn axes() -> impl Strategy<Value = CutAxis> {
    prop_oneof![Just(CutAxis::PlusZ), Just(CutAxis::PlusX), Just(CutAxis::MinusY), Just(CutAxis::MinusZ)]
}

/// Directions of a slot: along the lines, across them, at 45 degrees and at any angle.
fn angles() -> impl Strategy<Value = f64> {
    prop_oneof![Just(0.0), Just(90.0), Just(45.0), Just(-45.0), 0.0..360.0].prop_map(f64::to_radians)
}

/// The slot's path at an angle through a point near the middle, longer than the block's diagonal, at a depth.
fn slot(angle: f64, beside: f64, depth: f64) -> (DVec3, DVec3) {
    let (s, c) = angle.sin_cos();
    let (d, n) = (DVec3::new(c, s, 0.0), DVec3::new(-s, c, 0.0));
    let foot = n * beside - DVec3::Z * depth;
    (foot - d * 60.0, foot + d * 60.0)
}

/// How far an overlap that a finding tells may be from the offset: a wall at 45 degrees is met sqrt 2 farther, the
/// clearance is taken off.
fn tells(overlap: f64, offset: f64) -> bool {
    overlap > 0.0 && overlap < 1.5 * offset && overlap > 0.5 * (offset - 0.001)
}

proptest! {
    #![proptest_config(kinecut_cases::property(80))]
    #[test]
    fn a_tool_that_comes_back_beside_its_slot_is_met(
        axis in axes(), angle in angles(), step in 0.3..2.0, offset in 0.02..0.5, beside in -5.0..5.0, depth in 4.0..12.0,
    ) {
        let mut block = Block::new(axis, step);
        let ((a, b), (c, d)) = (slot(angle, beside, depth), slot(angle, beside + offset, depth));
        let cutter = tool(20.0, None, None);
        let effects = block.cut(&cutter, &[(way(a, b), false), (way(b, a), true), (way(c, d), true)]);
        // Back in the slot it rubs and meets nothing; beside it meets the wall.
        prop_assert!(effects[1].first_contact.is_none() && effects[1].overlap() == 0.0, "{:?}", effects[1]);
        prop_assert!(effects[2].first_contact.is_some(), "{:?}", effects[2]);
        prop_assert!(tells(effects[2].overlap(), offset), "{} {:?}", offset, effects[2]);
        // The point lies in the strip that was met.
        let p = quat(axis).inverse() * DVec3::from_array(effects[2].first_contact.unwrap());
        let across = p.dot(DVec3::new(-angle.sin(), angle.cos(), 0.0)) - beside;
        prop_assert!(across > 6.0 - 1e-4 && across < 6.0 + offset + 1e-4 && p.z <= 1e-4 && p.z >= -depth - 1e-4, "{} {}", across, p);
    }

    #[test]
    fn a_way_that_is_only_looked_at_is_met_and_removes_nothing(
        axis in axes(), angle in angles(), step in 0.3..2.0, offset in 0.02..0.5,
    ) {
        let mut block = Block::new(axis, step);
        let (a, b) = slot(angle, 0.0, 5.0);
        block.cut(&tool(20.0, None, None), &[(way(a, b), false)]);
        let before = block.stock.volumes();
        let (c, d) = slot(angle, 0.0 - offset, 5.0);
        let there = kinecut::geom::Rigid { rotation: glam::DMat3::from_quat(quat(axis)), translation: DVec3::ZERO };
        let look = CutMove { removes: false, ..CutMove::new(way(c, d).moved(&there), axis, 0).watched() };
        let cutter = [tool(20.0, None, None)];
        let met = cut(&mut block.stock, &cutter, &[look], &CutOptions::default(), &Silent).unwrap();
        prop_assert!(tells(met[0].overlap(), offset) && met[0].removed == 0.0, "{:?}", met[0]);
        prop_assert_eq!(block.stock.volumes(), before);
    }

    #[test]
    fn on_arcs_too_and_with_a_slope(
        axis in axes(), step in 0.3..2.0, offset in 0.02..0.5, radius in 8.0..20.0, start in 0.0..6.0, outward: bool,
        rise in prop_oneof![Just(0.0), Just(1.5), Just(-1.5)],
    ) {
        let mut block = Block::new(axis, step);
        let arc = |r: f64, z: f64, rise: f64| -> Curve {
            let (s, c) = f64::sin_cos(start);
            Arc::new(DVec3::new(r * c, r * s, z), DVec3::new(0.0, 0.0, z), DVec3::Z, 4.0, rise).unwrap().into()
        };
        let beside = if outward { radius + offset } else { radius - offset };
        let cutter = tool(20.0, None, None);
        let path = [(arc(radius, -8.0, 0.0), false), (arc(radius, -8.0, 0.0), true), (arc(beside, -6.0, rise), true)];
        let effects = block.cut(&cutter, &path);
        prop_assert!(effects[1].first_contact.is_none(), "{:?}", effects[1]);
        prop_assert!(effects[2].first_contact.is_some() && effects[2].overlap() > 0.0, "{:?}", effects[2]);
    }

    #[test]
    fn shank_and_holder_in_a_wall_are_met(
        axis in axes(), angle in angles(), step in 0.3..2.0, offset in 0.02..0.5, holder: bool, plunging: bool,
    ) {
        let mut block = Block::new(axis, step);
        // A slot as wide as shank or holder, 12 deep; then the tool goes 4 deeper with flutes of 6, beside the middle.
        let (a, b) = slot(angle, 0.0, 12.0);
        let wide: f64 = if holder { 30.0 } else { 12.0 };
        // Along the wall a standing disc overlaps it over a chord.
        let long_enough = 2.0 * f64::sqrt((wide - offset) * offset) > 1.5 * step;
        block.cut(&ToolBody::new(Profile::cylinder(wide, 20.0).unwrap()), &[(way(a, b), false)]);
        let body = || if holder { tool(6.0, None, Some(wide)) } else { tool(6.0, Some(wide), None) };
        let (c, d) = slot(angle, 0.0, 16.0);
        let down = |p: DVec3| way(p + DVec3::Z * 25.0, p);
        let met = |e: &MoveEffect| if holder { e.holder() } else { e.shank() };
        let ways = |(c, d): (DVec3, DVec3)| {
            let middle = 0.5 * (c + d);
            if plunging { vec![(down(middle), false)] } else { vec![(way(c, d), false)] }
        };
        for e in block.cut(&body(), &ways((c, d))) {
            prop_assert!(met(&e).is_none(), "{:?}", e);
        }
        let effects = block.cut(&body(), &ways(slot(angle, offset, 16.0)));
        let contact = met(&effects[0]);
        if plunging && !holder {
            // The edges are as wide and have been by.
            prop_assert!(contact.is_none(), "{:?}", effects[0]);
        } else if !plunging || long_enough {
            prop_assert!(contact.is_some_and(|c| c.overlap() > 0.0), "{:?}", effects[0]);
        }
    }
}

#[test]
fn a_tool_that_rubs_on_curved_walls_meets_nothing() {
    for step in [0.2, 0.37, 0.5, 0.81, 1.3] {
        for axis in [CutAxis::PlusZ, CutAxis::MinusX] {
            let mut block = Block::new(axis, step);
            let cutter = tool(20.0, Some(12.0), Some(12.0));
            let at = |r: f64, a: f64| DVec3::new(r * a.cos(), r * a.sin(), -7.0);
            let round = |r: f64, a: f64, sweep: f64| -> Curve {
                Arc::new(at(r, a), DVec3::new(0.0, 0.0, -7.0), DVec3::Z, sweep, 0.0).unwrap().into()
            };
            // A ring slot in turns of its own, then round it at rapid both ways, and out of it upwards.
            let mut path: Vec<(Curve, bool)> =
                (0..7).map(|i| (round(14.0, 0.9 * f64::from(i), 0.93), false)).collect();
            path.push((round(14.0, 1.0, 6.0), true));
            path.push((round(14.0, 5.0, -6.0), true));
            path.push((way(at(14.0, 2.2), at(14.0, 2.2) + DVec3::Z * 30.0), true));
            path.push((way(at(14.0, 2.2) + DVec3::Z * 30.0, at(14.0, 2.2)), true));
            for (i, e) in block.cut(&cutter, &path).iter().enumerate() {
                let watched = path[i].1;
                assert!(!watched || e.first_contact.is_none(), "{step} {i} {e:?}");
                assert!(e.shank().is_none() && e.holder().is_none(), "{step} {i} {e:?}");
            }
        }
    }
}
