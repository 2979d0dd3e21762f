//! Places of the links of a machine: the motion of each from home, in the frame of the bed.
//!
//! In the chain `E0 E1 ... En` from work to tool, the joints before the bed carry the work: seen from the bed, the link
//! of joint `i` there has moved by `(Ei ... Eb-1)^-1`, the link of a joint behind the bed by `Eb ... Ei`.

use super::Kinematics;
use crate::geom::Rigid;
use crate::machine::Link;

impl Kinematics {
    /// Motion of a link from home at joint positions `q` [mm or rad], in the frame of the machine; its first `bed`
    /// joints carry the work. Missing positions count as zero; a missing joint does not move.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use glam::DVec3;
    /// use kinecut::machine::{CoordinateCode, Link, Machine};
    /// let code = CoordinateCode::parse("641203").unwrap(); // C and A tables, X, Y, bed, Z
    /// let chain = Machine::of_code(code).kinematics(0.0);
    /// let q = [0.0, 0.0, 10.0, 0.0, 5.0];
    /// // X at 10 takes the tool 10 mm along the work: the table goes the other way.
    /// assert_eq!(chain.link(4, Link::Axis(0), &q).translation, DVec3::new(-10.0, 0.0, 0.0));
    /// assert_eq!(chain.link(4, Link::Axis(4), &q).translation, DVec3::new(0.0, 0.0, 5.0));
    /// ```
    pub fn link(&self, bed: usize, link: Link, q: &[f64]) -> Rigid {
        let Link::Axis(joint) = link else { return Rigid::IDENTITY };
        if joint >= self.count {
            return Rigid::IDENTITY;
        }
        let range = if joint < bed { joint..bed.min(self.count) } else { bed..joint + 1 };
        let along = range.fold(Rigid::IDENTITY, |before, i| {
            before.after(&self.screws[i].motion(q.get(i).copied().unwrap_or(0.0)))
        });
        if joint < bed { along.inverse() } else { along }
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::machine::{CoordinateCode, Machine};

    /// The tip seen from the table is the same, whether by the chain or by both ends seen from the bed.
    #[test]
    fn both_ends_seen_from_the_bed_give_the_forward_kinematics() {
        for text in ["641203", "0123", "450123", "612035", "6031", "321064"] {
            let code = CoordinateCode::parse(text).unwrap();
            let mut machine = Machine::of_code(code);
            for (i, joint) in machine.joints.iter_mut().enumerate() {
                joint.point = DVec3::new(3.0 * i as f64, 20.0, -7.0 * i as f64);
                joint.sense = if i % 2 == 0 { 1.0 } else { -1.0 };
            }
            machine.spindle.translation = DVec3::new(1.0, 2.0, 30.0);
            let q: Vec<f64> = (0..machine.joints.len()).map(|i| 0.7 - 0.4 * i as f64).collect();
            let [work, tool] = [machine.work_link(), machine.tool_link()].map(|link| machine.link(link, &q));
            let seen = work.inverse().after(&tool).after(&machine.spindle);
            let tip = machine.kinematics(0.0).forward(&q);
            assert!((seen.translation - tip.translation).length() < 1e-12, "{text}");
            assert!((seen.rotation.z_axis - tip.rotation.z_axis).length() < 1e-14, "{text}");
        }
    }

    /// Moving the bed along the chain moves all links by one motion: their places to each other stay.
    #[test]
    fn the_place_of_the_bed_changes_no_place_of_links_to_each_other() {
        let chain = Machine::of_code(CoordinateCode::parse("641203").unwrap()).kinematics(0.0);
        let q = [0.4, -0.3, 10.0, 20.0, -5.0];
        // The gaps between links: gap g lies before joint g; seen from the bed in gap b.
        let gap = |bed: usize, gap: usize| {
            let link = if gap == bed { Link::Bed } else { Link::Axis(if gap < bed { gap } else { gap - 1 }) };
            chain.link(bed, link, &q)
        };
        for bed in 0..=5 {
            for other in 0..=5 {
                for (a, b) in [(0, 5), (1, 3), (2, 4)] {
                    let here = gap(bed, a).inverse().after(&gap(bed, b));
                    let there = gap(other, a).inverse().after(&gap(other, b));
                    assert!((here.translation - there.translation).length() < 1e-12);
                }
            }
        }
    }
}
