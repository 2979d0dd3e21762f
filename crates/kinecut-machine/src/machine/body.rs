//! Bodies of a machine: the solids of its links, for drawings and for checks of what must not meet.
//!
//! A body is a solid of `geom` with its place in the frame of the machine with all axes at zero, and the link that
//! carries it: the bed, or a link that an axis moves. Its place at other positions of the axes follows from the chain
//! ([`crate::machine::Kinematics::link`]).

use glam::{DMat3, DVec3};

use crate::geom::{Aabb, Rigid, Solid};

/// Link of a machine, which carries bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Link {
    /// The bed: the link on the floor.
    Bed,
    /// The link that an axis moves: index of the joint, in the order of the code.
    Axis(usize),
}

/// A body of a machine.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Name in findings and drawings; may be empty.
    pub name: String,
    /// Link that carries it.
    pub link: Link,
    /// Form in a frame of its own [mm]: a cylinder has its base at the zero and Z as its axis.
    pub solid: Solid,
    /// The frame of the body in that of the machine, with all axes at zero.
    pub place: Rigid,
    /// The file that its mesh came from.
    pub file: Option<String>,
    /// The least distance that other bodies are to keep from it [mm]; nearer is a warning, zero asks for none.
    pub near: f64,
}

impl Body {
    /// The least distance of other bodies, if nothing says it [mm].
    pub const NEAR: f64 = 0.5;

    /// A box along the axes of the machine.
    pub fn cuboid(link: Link, bounds: Aabb) -> Body {
        Body::of(link, Solid::Box(bounds), Rigid::IDENTITY)
    }

    /// A cylinder whose base is centred on `base`, along `axis` (a unit vector) [mm].
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use glam::DVec3;
    /// use kinecut::machine::{Body, Link};
    /// let drum = Body::cylinder(Link::Bed, DVec3::new(10.0, 0.0, 0.0), DVec3::X, 20.0, 50.0);
    /// let bounds = drum.bounds();
    /// assert!((bounds.max - DVec3::new(60.0, 20.0, 20.0)).length() < 1e-12);
    /// assert!((bounds.min - DVec3::new(10.0, -20.0, -20.0)).length() < 1e-12);
    /// ```
    pub fn cylinder(link: Link, base: DVec3, axis: DVec3, radius: f64, height: f64) -> Body {
        let solid = Solid::Cylinder { base: DVec3::ZERO, radius, height };
        let place = Rigid { rotation: along(axis), translation: base };
        Body::of(link, solid, place)
    }

    /// A solid at a place, without a name.
    pub fn of(link: Link, solid: Solid, place: Rigid) -> Body {
        Body { name: String::new(), link, solid, place, file: None, near: Body::NEAR }
    }

    /// The box about it with all axes at zero, in the frame of the machine [mm].
    pub fn bounds(&self) -> Aabb {
        self.bounds_at(&Rigid::IDENTITY)
    }

    /// The box about it when its link has moved from home by this motion [mm]; exact for every form.
    pub fn bounds_at(&self, moved: &Rigid) -> Aabb {
        let place = moved.after(&self.place);
        match &self.solid {
            Solid::Cylinder { base, radius, height } => {
                let axis = place.rotation.z_axis;
                // A disc reaches `radius sin` of the angle between its axis and a direction.
                let disc = (DVec3::ONE - axis * axis).max(DVec3::ZERO).map(f64::sqrt) * *radius;
                let ends = [place.point(*base), place.point(*base + DVec3::Z * *height)];
                Aabb::of_points(ends.into_iter().flat_map(|end| [end - disc, end + disc]))
            }
            Solid::Mesh(mesh) => Aabb::of_points(mesh.vertices.iter().map(|&v| place.point(v))),
            Solid::Box(b) => {
                let (centre, half) = (place.point(0.5 * (b.min + b.max)), 0.5 * b.size());
                let r = place.rotation;
                let reach = r.x_axis.abs() * half.x + r.y_axis.abs() * half.y + r.z_axis.abs() * half.z;
                Aabb { min: centre - reach, max: centre + reach }
            }
        }
    }
}

/// A frame whose Z is this unit vector, bit by bit, so that writing and reading a machine gives the same one.
fn along(axis: DVec3) -> DMat3 {
    // The component that is smallest gives the best conditioned second direction.
    let helper = if axis.x.abs() <= axis.y.abs() && axis.x.abs() <= axis.z.abs() {
        DVec3::X
    } else if axis.y.abs() <= axis.z.abs() {
        DVec3::Y
    } else {
        DVec3::Z
    };
    let x = (helper - axis * axis.dot(helper)).try_normalize().unwrap_or(DVec3::X);
    DMat3::from_cols(x, axis.cross(x), axis)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_body_keeps_its_axis_bit_by_bit_and_its_frame_is_right_handed() {
        for v in [DVec3::X, DVec3::NEG_Y, DVec3::NEG_Z, DVec3::new(0.3, -0.2, 0.9), DVec3::ONE] {
            let axis = v.try_normalize().unwrap();
            let frame = along(axis);
            assert_eq!(frame.z_axis, axis);
            assert!((frame.determinant() - 1.0).abs() < 1e-14);
            assert!(
                (frame * frame.transpose() - DMat3::IDENTITY).to_cols_array().iter().all(|c| c.abs() < 1e-14)
            );
        }
    }

    #[test]
    fn the_box_about_a_moved_body_is_tight() {
        let turn = Rigid { rotation: DMat3::from_rotation_z(0.7), translation: DVec3::new(5.0, 0.0, 0.0) };
        let block = Body::cuboid(Link::Bed, Aabb { min: DVec3::ZERO, max: DVec3::new(4.0, 2.0, 1.0) });
        let found = block.bounds_at(&turn);
        let corners = (0..8)
            .map(|i| turn.point(DVec3::new(4.0 * f64::from(i & 1), f64::from(i & 2), f64::from(i >> 2))));
        let wanted = Aabb::of_points(corners);
        assert!((found.min - wanted.min).length() + (found.max - wanted.max).length() < 1e-12);
        let axis = DVec3::new(1.0, 2.0, 2.0) / 3.0;
        let drum = Body::cylinder(Link::Bed, DVec3::ONE, axis, 3.0, 7.0);
        let (place, mut rim) = (turn.after(&drum.place), Aabb::EMPTY);
        for i in 0..3600 {
            let (sin, cos) = (f64::from(i) * 0.1f64.to_radians()).sin_cos();
            for z in [0.0, 7.0] {
                rim = rim.union(Aabb::of_points([place.point(DVec3::new(3.0 * cos, 3.0 * sin, z))]));
            }
        }
        let found = drum.bounds_at(&turn);
        assert!((found.min - rim.min).length() + (found.max - rim.max).length() < 1e-5);
        assert!((found.min - found.min.min(rim.min)).length() < 1e-12, "it holds all of the body");
    }
}
