//! The half-profile of a body of revolution about the Z axis.

use crate::base::{Code, Finding, Result};

/// One element of a half-profile, between two heights; the radius never falls with the height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ProfileElement {
    /// A cone, cylinder (equal radii) or disc (equal heights).
    Cone {
        /// Lower height [mm].
        z0: f64,
        /// Radius at the lower height [mm].
        r0: f64,
        /// Upper height [mm].
        z1: f64,
        /// Radius at the upper height [mm].
        r1: f64,
    },
    /// A convex circular arc, from the lowest point of its circle or above up to at most the height of its
    /// centre: a ball (centre on the axis) or the corner of a bull-nose cutter.
    Torus {
        /// Distance of the arc's centre from the axis [mm].
        centre_radius: f64,
        /// Height of the arc's centre [mm].
        centre_z: f64,
        /// Radius of the arc [mm].
        radius: f64,
        /// Lower height [mm].
        z0: f64,
        /// Upper height [mm], at most `centre_z`.
        z1: f64,
    },
}

impl ProfileElement {
    /// Lower height [mm].
    pub fn bottom(&self) -> f64 {
        match *self {
            ProfileElement::Cone { z0, .. } | ProfileElement::Torus { z0, .. } => z0,
        }
    }

    /// Upper height [mm].
    pub fn top(&self) -> f64 {
        match *self {
            ProfileElement::Cone { z1, .. } | ProfileElement::Torus { z1, .. } => z1,
        }
    }

    /// The greatest of `radial * r + axial * z` over its points; `radial` is not negative.
    fn support(&self, radial: f64, axial: f64) -> f64 {
        let of = |r: f64, z: f64| radial * r + axial * z;
        let ends = of(self.lower_radius(), self.bottom()).max(of(self.radius(self.top()), self.top()));
        match *self {
            ProfileElement::Torus { centre_radius, centre_z, radius, z0, z1 } => {
                let length = radial.hypot(axial);
                let z = centre_z + radius * axial / length;
                // Not a number for no direction at all.
                if z > z0 && z < z1 { of(centre_radius, centre_z) + radius * length } else { ends }
            }
            ProfileElement::Cone { .. } => ends,
        }
    }

    /// Radius at a height within the element [mm]; at a disc its outer radius.
    pub fn radius(&self, z: f64) -> f64 {
        match *self {
            ProfileElement::Cone { z0, r0, z1, r1 } => {
                if z1 > z0 {
                    r0 + (r1 - r0) * ((z - z0) / (z1 - z0)).clamp(0.0, 1.0)
                } else {
                    r1
                }
            }
            ProfileElement::Torus { centre_radius, centre_z, radius, z0, z1 } => {
                let h = centre_z - z.clamp(z0, z1);
                centre_radius + ((radius - h) * (radius + h)).clamp(0.0, f64::INFINITY).sqrt()
            }
        }
    }
}

/// A convex or stepped body of revolution about Z: elements stacked upwards whose radius never falls.
/// Between two elements the radius may step outwards (a flat annulus), never inwards.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use kinecut::geom::Profile;
/// let ball = Profile::bull_nose(10.0, 5.0, 30.0).unwrap();
/// assert!((ball.radius(1.0) - 3.0).abs() < 1e-15); // 5 mm ball: sqrt(25 - 16)
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    elements: Vec<ProfileElement>,
}

impl Profile {
    /// A checked profile.
    ///
    /// # Errors
    /// `KC0801` when it is empty, a number is not finite, heights do not join, or a radius falls.
    pub fn new(elements: Vec<ProfileElement>) -> Result<Profile> {
        let fail = |what: &str, value: f64| -> Result<Profile> {
            Err(Finding::error(Code::GEOMETRY, what).value_mm(value).into())
        };
        let (mut z, mut r) = match elements.first() {
            Some(first) => (first.bottom(), 0.0),
            None => return fail("a profile has no element", 0.0),
        };
        for e in &elements {
            let (r0, r1) = (e.lower_radius(), e.radius(e.top()));
            if ![e.bottom(), e.top(), r0, r1].iter().all(|v| v.is_finite()) {
                return fail("a profile has a number that is not finite", f64::NAN);
            }
            if (e.bottom() - z).abs() > 1e-12 {
                return fail("a profile has a gap at this height", e.bottom());
            }
            // Rounding of sqrt and tan at the joints is allowed for.
            if e.top() < e.bottom() || r0 < r - 1e-9 || r1 < r0 - 1e-9 || r0 < 0.0 {
                return fail("the radius of a profile falls with height", r0);
            }
            if let ProfileElement::Torus { centre_z, radius, .. } = *e
                && (e.top() > centre_z + 1e-12 || e.bottom() < centre_z - radius - 1e-12)
            {
                return fail("an arc of a profile reaches beyond its lower half", e.top());
            }
            (z, r) = (e.top(), r1);
        }
        Ok(Profile { elements })
    }

    /// A cylinder with a flat bottom at z = 0: diameter and height [mm].
    ///
    /// # Errors
    /// `KC0801` for numbers that make no body.
    pub fn cylinder(diameter: f64, height: f64) -> Result<Profile> {
        let r = diameter / 2.0;
        Profile::new(vec![ProfileElement::Cone { z0: 0.0, r0: r, z1: height, r1: r }])
    }

    /// A bull-nose (corner radius below half the diameter), ball (equal) or flat (zero) end, then a cylinder up to
    /// `height` [mm].
    ///
    /// # Errors
    /// `KC0801` for numbers that make no body.
    pub fn bull_nose(diameter: f64, corner_radius: f64, height: f64) -> Result<Profile> {
        let r = diameter / 2.0;
        let mut elements = Vec::new();
        if corner_radius > 0.0 {
            elements.push(ProfileElement::Torus {
                centre_radius: r - corner_radius,
                centre_z: corner_radius,
                radius: corner_radius,
                z0: 0.0,
                z1: corner_radius,
            });
        }
        elements.push(ProfileElement::Cone { z0: corner_radius, r0: r, z1: height, r1: r });
        Profile::new(elements)
    }

    /// The elements, from the bottom up.
    pub fn elements(&self) -> &[ProfileElement] {
        &self.elements
    }

    /// Lowest height [mm].
    pub fn bottom(&self) -> f64 {
        self.elements[0].bottom()
    }

    /// Greatest height [mm].
    pub fn top(&self) -> f64 {
        self.elements[self.elements.len() - 1].top()
    }

    /// Greatest distance of a point of the body from the plane through its zero in a direction, by the components of the
    /// direction across the axis (not negative) and along it [mm].
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use kinecut::geom::Profile;
    /// let ball = Profile::bull_nose(10.0, 5.0, 30.0).unwrap();
    /// // Downwards, the axis at 60 degrees to the vertical: the centre is 2.5 mm above the tip, the ball 5 mm below its centre.
    /// let (radial, axial) = (0.75f64.sqrt(), -0.5);
    /// assert!((ball.support(radial, axial) - 2.5).abs() < 1e-12);
    /// ```
    pub fn support(&self, radial: f64, axial: f64) -> f64 {
        self.elements.iter().map(|e| e.support(radial, axial)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Greatest radius [mm].
    pub fn max_radius(&self) -> f64 {
        self.elements[self.elements.len() - 1].radius(self.top())
    }

    /// Radius of the section at a height [mm]; zero outside `[bottom, top]`. At a step it is the outer radius.
    pub fn radius(&self, z: f64) -> f64 {
        self.elements.iter().rev().find(|e| z >= e.bottom() && z <= e.top()).map_or(0.0, |e| e.radius(z))
    }
}

impl ProfileElement {
    /// Radius at the lower end [mm]; of a disc the inner radius.
    fn lower_radius(&self) -> f64 {
        match *self {
            ProfileElement::Cone { r0, .. } => r0,
            ProfileElement::Torus { .. } => self.radius(self.bottom()),
        }
    }
}
