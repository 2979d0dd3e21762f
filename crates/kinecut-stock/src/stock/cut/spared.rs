//! Material that a cut is not counted on to take.

/// Material along the faces of what a tool takes that stays: where the tool may be off, it may leave that.
///
/// ```
/// # use kinecut_stock as kinecut;
/// use glam::DVec3;
/// use kinecut::base::Silent;
/// use kinecut::geom::{Aabb, Line, Profile};
/// use kinecut::stock::TriDexel;
/// use kinecut::stock::cut::{CutAxis, CutList, CutMove, CutOptions, Spared, ToolBody, cut_list};
/// let plate = Aabb { min: [0.0, 0.0, -10.0].into(), max: [40.0, 20.0, 0.0].into() };
/// let mut stock = TriDexel::from_box(plate, 0.25).unwrap();
/// let mill = [ToolBody::new(Profile::cylinder(8.0, 30.0).unwrap())];
/// let line = Line { start: DVec3::new(-10.0, 10.0, -4.0), end: DVec3::new(50.0, 10.0, -4.0) };
/// let moves = vec![CutMove::new(line, CutAxis::PlusZ, 0)];
/// let spared = [Spared { around: 0.5, along: 0.25 }];
/// let list = CutList::sparing(&mill, &spared, moves, &CutOptions::default(), 0.25).unwrap();
/// cut_list(&mut stock, &list, 0..1, &Silent).unwrap();
/// // A slot 7 mm wide and 3.25 mm deep: at the floor both count.
/// assert!((stock.volume() - (8000.0 - 7.0 * 3.25 * 40.0)).abs() < 1e-6);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spared {
    /// In every direction [mm].
    pub around: f64,
    /// Beyond that along the tool's axis, at both ends [mm].
    pub along: f64,
}

impl Spared {
    /// Nothing: the tool takes all that it sweeps.
    pub const NOTHING: Spared = Spared { around: 0.0, along: 0.0 };
}
