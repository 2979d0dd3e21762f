//! Solids of a picture: blocks, drums, and bodies of any form as flat faces.
//!
//! Places are [right, back, up] in mm; the viewer stands in front, to the right, above.

use glam::{DMat3, DVec3};

use crate::geom::{Aabb, Rigid, Solid as Form};
use crate::page::Tint;
use crate::page::draw::{Facets, View};

/// A place: right, back, up [mm].
pub(crate) type Point3 = [f64; 3];

/// A drum about the axis of a rotation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Hub {
    pub(crate) centre: Point3,
    pub(crate) radius: f64,
    /// Half of its length.
    pub(crate) half: f64,
}

/// The form of a body as a machine file could give it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Shape {
    Block(Aabb),
    /// About this axis, of the size of the hub.
    Drum(DVec3),
    /// Any other.
    Given,
}

/// A body of a picture.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Solid {
    pub(crate) shape: Shape,
    pub(crate) facets: Facets,
    pub(crate) tint: Tint,
    /// Of a drum: what an arrow goes round.
    pub(crate) hub: Option<Hub>,
}

impl Solid {
    /// A block by centre and size.
    pub(crate) fn block(tint: Tint, centre: Point3, size: Point3) -> Solid {
        let (centre, half) = (DVec3::from(centre), 0.5 * DVec3::from(size).abs());
        let bounds = Aabb { min: centre - half, max: centre + half };
        let form = Form::Box(bounds);
        Solid { shape: Shape::Block(bounds), facets: Facets::of(&form, &Rigid::IDENTITY), tint, hub: None }
    }

    /// A drum about an axis of length one.
    pub(crate) fn drum(tint: Tint, centre: Point3, axis: Point3, radius: f64, half: f64) -> Solid {
        let direction = DVec3::from(axis);
        let (u, v) = direction.any_orthonormal_pair();
        let place = Rigid { rotation: DMat3::from_cols(u, v, direction), translation: DVec3::from(centre) };
        let form = Form::Cylinder { base: DVec3::new(0.0, 0.0, -half), radius, height: 2.0 * half };
        let facets = Facets::of(&form, &place);
        Solid { shape: Shape::Drum(direction), facets, tint, hub: Some(Hub { centre, radius, half }) }
    }

    /// The box about it.
    pub(crate) fn bounds(&self) -> [Point3; 2] {
        self.facets.bounds().map(|c| c.to_array())
    }

    /// Its corners on paper [px].
    pub(crate) fn outline(&self, view: &View) -> impl Iterator<Item = [f64; 2]> {
        self.facets.corners.iter().map(|&c| view.px(c))
    }
}

/// The direction of a vector; right of one without length.
pub(crate) fn unit(a: Point3) -> Point3 {
    DVec3::from(a).try_normalize().unwrap_or(DVec3::X).to_array()
}
