//! An edge that a ball breaks, in numbers.

/// A break of an edge by a ball: as wide as it is high, and a little hollow.
///
/// The ball's centre lies on the line at 45 degrees through the edge, on the side of the air, so that both ends of the break lie
/// equally far from it. Source: the chord of the break in the circle of the ball.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::contouring::BallBreak;
/// let ball = BallBreak { radius: 2.0, width: 0.5 };
/// // 1.1419 beside the wall and above the edge, the tip 0.8581 below it, hollow by 0.0315.
/// assert!((ball.offset() - 1.141_941_0).abs() < 1e-7 && (ball.depth() - 0.858_058_9).abs() < 1e-7);
/// assert!((ball.hollow() - 0.031_498_0).abs() < 1e-7);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallBreak {
    /// Radius of the ball [mm].
    pub radius: f64,
    /// Width and height of the break [mm], below the radius.
    pub width: f64,
}

impl BallBreak {
    /// Distance of the axis from the wall, and height of the ball's centre over the edge [mm].
    pub fn offset(&self) -> f64 {
        let square = 0.5 * (self.radius * self.radius - 0.5 * self.width * self.width);
        if square > 0.0 { square.sqrt() - 0.5 * self.width } else { 0.0 }
    }

    /// Depth of the tip below the edge [mm].
    pub fn depth(&self) -> f64 {
        self.radius - self.offset()
    }

    /// Radius of the ball at the height of the edge [mm].
    pub fn top_radius(&self) -> f64 {
        self.offset() + self.width
    }

    /// Depth of the break's middle below the straight chamfer between its ends [mm].
    pub fn hollow(&self) -> f64 {
        let square = self.radius * self.radius - 0.5 * self.width * self.width;
        self.radius - if square > 0.0 { square.sqrt() } else { 0.0 }
    }
}
