//! Mobility: the motions of the tool relative to the work that the joints of a chain span.
//!
//! A cutter of revolution may spin, a surface may slide in itself: these motions cost nothing and are divided out. The
//! task is feasible at a pose when every wanted motion lies in the span of the joints and the free motions.

use super::{Jacobian, Kinematics, Twist};
use crate::machine::{JointValues, MOST_JOINTS};

/// Length that makes shifts comparable with turns [mm]: the size of ordinary parts.
const LENGTH: f64 = 100.0;
/// A unit motion whose part outside of the span of the others is shorter than this depends on them.
const DEPENDENT: f64 = 1e-7;

type Column = [f64; 6];

/// An orthonormal basis that grows.
struct Basis {
    basis: [Column; 6],
    len: usize,
}

impl Basis {
    fn new() -> Basis {
        Basis { basis: [[0.0; 6]; 6], len: 0 }
    }

    /// The part of a column outside of the span; twice, because once leaves rounding of the long parts.
    fn outside(&self, mut column: Column) -> Column {
        for _ in 0..2 {
            for unit in &self.basis[..self.len] {
                let along = dot(unit, &column);
                for (x, u) in column.iter_mut().zip(unit) {
                    *x -= along * u;
                }
            }
        }
        column
    }

    /// Adds columns, the one that lies farthest outside first; returns how many were independent.
    fn add(&mut self, columns: &[Column]) -> usize {
        let before = self.len;
        while self.len < 6 {
            let mut farthest = [0.0; 6];
            let mut length = 0.0;
            for column in columns {
                let outside = self.outside(*column);
                let size = dot(&outside, &outside).sqrt();
                if size > length {
                    (farthest, length) = (outside, size);
                }
            }
            if length < DEPENDENT {
                break;
            }
            self.basis[self.len] = farthest.map(|x| x / length);
            self.len += 1;
        }
        self.len - before
    }
}

fn dot(a: &Column, b: &Column) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

impl Jacobian {
    /// Number of independent motions of the tool beyond those of `modulo`: with the [`Jacobian::spin`] of the tool there, 5
    /// for a machine that can do everything with a cutter of revolution.
    pub fn rank(&self, modulo: &[Twist]) -> usize {
        let mut span = Basis::new();
        span.add(&self.columns(modulo));
        span.add(&self.columns(self.twists()))
    }

    /// True if the joints can make a motion, up to those of `modulo`.
    pub fn spans(&self, wanted: &Twist, modulo: &[Twist]) -> bool {
        let mut span = Basis::new();
        span.add(&self.columns(modulo));
        span.add(&self.columns(self.twists()));
        span.add(&self.columns(&[*wanted])) == 0
    }

    /// Unit columns of motions, their shift taken at the tip.
    fn columns(&self, twists: &[Twist]) -> Vec<Column> {
        let column = |twist: &Twist| {
            let (w, v) = (twist.turn, twist.velocity(self.frame.translation) / LENGTH);
            let column = [w.x, w.y, w.z, v.x, v.y, v.z];
            let length = dot(&column, &column).sqrt();
            if length > 0.0 { column.map(|x| x / length) } else { column }
        };
        twists.iter().map(column).collect()
    }
}

/// Poses tried for the mobility of a chain: rank is lost on a set without volume, so one would do.
const POSES: usize = 3;

impl Kinematics {
    /// [`Jacobian::rank`] at joint positions `q` [mm or rad].
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::{CoordinateCode, Machine};
    /// let code = CoordinateCode::parse("641203").unwrap();
    /// let chain = Machine::new(code, [None; 3], Default::default()).unwrap().kinematics(0.0);
    /// let spin = chain.jacobian(&[0.0; 5]).spin();
    /// assert_eq!(chain.rank(&[0.0; 5], &[spin]), 4); // at home C is parallel to the tool
    /// assert_eq!(chain.mobility(), 5);
    /// ```
    pub fn rank(&self, q: &[f64], modulo: &[Twist]) -> usize {
        self.jacobian(q).rank(modulo)
    }

    /// Number of independent motions of tip and direction of the tool at poses in general position.
    pub fn mobility(&self) -> usize {
        let ranks = (0..POSES).map(|pose| {
            let jacobian = self.jacobian(&self.general_position(pose));
            jacobian.rank(&[jacobian.spin()])
        });
        ranks.max().unwrap_or(0)
    }

    /// Positions in general position: those of home are often singular.
    pub fn general_position(&self, pose: usize) -> JointValues {
        // Multiples of the golden ratio are spread evenly and meet no ratio of small numbers.
        const GOLDEN: f64 = 0.618_033_988_749_894_9;
        let mut q = JointValues::zero(self.count);
        for (i, (value, screw)) in q.iter_mut().zip(&self.screws).enumerate() {
            let share = ((1 + i + pose * MOST_JOINTS) as f64 * GOLDEN).fract() - 0.5;
            *value = share * if screw.rotary { 2.5 } else { 2.0 * LENGTH };
        }
        q
    }
}
