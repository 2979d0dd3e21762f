//! Tool axes along the coordinate axes, and the frame in which a tool is upright.

use glam::{DMat3, DVec3};

use crate::geom::Rigid;
use crate::stock::Axis;

/// A direction from tip to holder along an axis of the stock.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum CutAxis {
    /// +X.
    PlusX,
    /// -X.
    MinusX,
    /// +Y.
    PlusY,
    /// -Y.
    MinusY,
    /// +Z: the spindle above the part.
    PlusZ,
    /// -Z.
    MinusZ,
}

impl CutAxis {
    /// All six.
    pub const ALL: [CutAxis; 6] =
        [CutAxis::PlusX, CutAxis::MinusX, CutAxis::PlusY, CutAxis::MinusY, CutAxis::PlusZ, CutAxis::MinusZ];

    /// Sine of the angle below which a direction counts as along an axis: over a reach of 1 m the tool is then
    /// off by 1 nm, less than an end point is rounded.
    const ALIGNED: f64 = 1e-9;

    /// The tool axis of a direction, if it runs along an axis of the stock.
    ///
    /// ```
    /// # use kinecut_stock as kinecut;
    /// use kinecut::stock::cut::CutAxis;
    /// assert_eq!(CutAxis::of([0.0, -2.0, 0.0].into()), Some(CutAxis::MinusY));
    /// assert_eq!(CutAxis::of([0.0, 0.1, 1.0].into()), None);
    /// ```
    pub fn of(direction: DVec3) -> Option<CutAxis> {
        let d = direction.try_normalize()?;
        CutAxis::ALL.into_iter().find(|a| (d - a.vector()).length() <= CutAxis::ALIGNED)
    }

    /// The unit vector.
    pub fn vector(self) -> DVec3 {
        let mut v = DVec3::ZERO;
        v[self.along().index()] = self.sign();
        v
    }

    /// The axis without its sign.
    pub fn along(self) -> Axis {
        match self {
            CutAxis::PlusX | CutAxis::MinusX => Axis::X,
            CutAxis::PlusY | CutAxis::MinusY => Axis::Y,
            CutAxis::PlusZ | CutAxis::MinusZ => Axis::Z,
        }
    }

    /// +1 or -1.
    pub(crate) fn sign(self) -> f64 {
        match self {
            CutAxis::PlusX | CutAxis::PlusY | CutAxis::PlusZ => 1.0,
            CutAxis::MinusX | CutAxis::MinusY | CutAxis::MinusZ => -1.0,
        }
    }
}

/// The frame of an upright tool: coordinates u, v across and w up along the tool axis, right-handed; each is a
/// coordinate of the stock, and only w may be reversed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ToolFrame {
    /// Stock axes of u, v, w.
    pub(super) axes: [Axis; 3],
    /// +1, or -1 when w runs against its stock axis.
    pub(super) sign: f64,
}

impl ToolFrame {
    pub(super) fn new(axis: CutAxis) -> ToolFrame {
        let (a, b) = axis.along().others();
        let sign = axis.sign();
        let (u, v) = if sign > 0.0 { (a, b) } else { (b, a) };
        ToolFrame { axes: [u, v, axis.along()], sign }
    }

    /// Coordinates of the frame from those of the stock.
    pub(super) fn rotation(&self) -> Rigid {
        let mut columns = [DVec3::ZERO; 3];
        for (i, axis) in self.axes.iter().enumerate() {
            columns[axis.index()][i] = if i == 2 { self.sign } else { 1.0 };
        }
        Rigid { rotation: DMat3::from_cols(columns[0], columns[1], columns[2]), translation: DVec3::ZERO }
    }

    /// A point or vector of the frame in the stock.
    pub(super) fn stock(&self, local: DVec3) -> DVec3 {
        let mut world = DVec3::ZERO;
        for (i, axis) in self.axes.iter().enumerate() {
            world[axis.index()] = if i == 2 { self.sign * local[i] } else { local[i] };
        }
        world
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_right_handed_and_upright() {
        for axis in CutAxis::ALL {
            let frame = ToolFrame::new(axis);
            let r = frame.rotation();
            assert_eq!(r.rotation.determinant(), 1.0);
            assert_eq!(r.vector(axis.vector()), DVec3::Z);
            let p = DVec3::new(1.0, 2.0, 3.0);
            assert_eq!(frame.stock(r.point(p)), p);
        }
    }
}
