//! Splines with knots of their own: `G6.2` (LinuxCNC from 2.10, as FANUC's `G06.2`).
//!
//! Each row has its knot `K`, and all but as many rows at the end as the order `P` says have a control point `X Y` with its weight `R`. The
//! curve begins at the first control point, which is the present place, and ends at the last. It is run when its last knot is said, or by `G6.3`.
//! `Q` chooses how the control divides it, which is not followed: the curve itself is.

use glam::DVec2;

use crate::base::Result;
use crate::nc::dialect::AXES;

use super::block::Word;
use super::nurbs::{LARGEST_ORDER, Nurbs};
use super::place::Bytes;
use super::reader::{Reader, take};

/// Largest distance of the first control point from the present place [mm]: the rounding of words.
const APART: f64 = 0.002;

impl<'s> Reader<'s> {
    /// A row of `G6.2`.
    pub(super) fn knot_row(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        self.spline_speed(words)?;
        let here = self.here.clone();
        let start = self.start()?.truncate();
        let (order, weight) = (take(words, "P"), take(words, "R"));
        let Some(knot) = take(words, "K") else {
            return Err(self.lacks(&here, "a row of a spline without its knot K").into());
        };
        take(words, "Q");
        let mut nurbs = match (self.nurbs.take(), order) {
            (Some(nurbs), None) => nurbs,
            (None, Some(order)) => {
                let count = self.count(&order, "the order of a spline")?;
                if !(2..=LARGEST_ORDER).contains(&count) {
                    let finding = self.place.malformed(&order.bytes, "the order of a spline is out of range");
                    return Err(finding
                        .value(f64::from(count), "")
                        .bound(f64::from(LARGEST_ORDER), "")
                        .into());
                }
                Nurbs::with_knots(count as usize)
            }
            (Some(_), Some(order)) => {
                let why = "the order of a spline is in its first row only";
                return Err(self.place.malformed(&order.bytes, why).into());
            }
            (None, None) => {
                return Err(self.lacks(&here, "the first row of a spline without its order P").into());
            }
        };
        if nurbs.knots.last().is_some_and(|before| *before > knot.value) {
            return Err(self.place.malformed(&knot.bytes, "the knots of a spline do not fall").into());
        }
        nurbs.knots.push(knot.value);
        let weight = weight.map_or(1.0, |w| w.value);
        if weight <= 0.0 {
            return Err(self.lacks(&here, "the weight R of a control point is positive").into());
        }
        match [AXES[0], AXES[1]].map(|axis| words.iter().any(|w| !w.used && w.is(axis))) {
            [true, true] if nurbs.knots.len() == nurbs.points.len() + 1 => {
                let last = nurbs.points.last().map_or(start, |p| p.0);
                // Increments count from the control point before.
                self.modal.position = [Some(last.x), Some(last.y), self.modal.position[2]];
                let [x, y, z] = self.end(words)?;
                self.modal.position = [Some(start.x), Some(start.y), z];
                let point = DVec2::new(x.unwrap_or(f64::NAN), y.unwrap_or(f64::NAN));
                if nurbs.points.is_empty() && point.distance(start) > APART {
                    let finding = self.lacks(&here, "a spline begins at its first control point");
                    return Err(finding.value_mm(point.distance(start)).help("move there before it").into());
                }
                nurbs.points.push((point, weight));
            }
            [true, true] => {
                return Err(self.lacks(&here, "a control point behind the last knots of its spline").into());
            }
            [false, false] => {}
            _ => return Err(self.lacks(&here, "a control point needs both X and Y").into()),
        }
        let whole = nurbs.knots.len() == nurbs.points.len() + nurbs.order;
        self.nurbs = Some(nurbs);
        if whole {
            self.modal.motion = None;
            return self.run_spline(&here);
        }
        Ok(())
    }

    /// Refuses knots that leave the ends of the curve open.
    pub(super) fn check_knots(&self, nurbs: &Nurbs, bytes: &Bytes) -> Result<()> {
        let (knots, order, points) = (&nurbs.knots, nurbs.order, nurbs.points.len());
        if knots.is_empty() {
            return Ok(());
        }
        if knots.len() != points + order {
            let finding =
                self.lacks(bytes, "a spline has as many knots as control points and its order together");
            return Err(finding
                .value(knots.len() as f64, "knots")
                .bound((points + order) as f64, "knots")
                .into());
        }
        let level = |range: std::ops::Range<usize>| knots[range].windows(2).all(|w| w[0] == w[1]);
        if !(level(0..order) && level(points..points + order) && knots[0] < knots[points]) {
            let finding = self
                .lacks(bytes, "the first and the last knots of a spline are as many equal ones as its order");
            return Err(finding.help("repeat them, so that the curve goes through its end points").into());
        }
        Ok(())
    }
}
