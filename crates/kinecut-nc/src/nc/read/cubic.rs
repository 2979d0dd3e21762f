//! Cubics: `G5` of LinuxCNC as exact curves.
//!
//! X and Y only, in G17, without cutter compensation. P and Q lead from the end to the second control point, I and J
//! from the start to the first, in `G90.1` too; both may be left out right after another cubic, whose direction then
//! goes on. The interpreter of LinuxCNC itself takes a first cubic without I and J and uses what a former one left
//! behind: that is refused here, as its manual says.

use glam::DVec2;

use crate::base::{Code as FindingCode, Finding, Result};
use crate::geom::CubicSpan;
use crate::nc::dialect::{Code, OFFSETS, Plane};
use crate::program::{Comp, Path};

use super::block::Word;
use super::reader::{Reader, take};

/// Biarcs of equal steps of the parameter as which the control runs a cubic (its `NURBS_FEED`: four to a control point).
const BIARCS: u32 = 16;
/// Distance of these from the cubic that is not worth a word [mm].
const RUN_WITHIN: f64 = 1e-3;

impl<'s> Reader<'s> {
    pub(super) fn cubic(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        let here = self.here.clone();
        if self.code(|c| c == Code::Cubic).is_none() {
            return Err(self.no_cubic("a cubic without its G5: it is not modal").help("program G5").into());
        }
        if self.modal.comp != Comp::Off {
            return Err(self.while_on(&here).into());
        }
        if self.modal.plane != Plane::Xy {
            return Err(self.no_cubic("a cubic runs in G17 only").help("program G17").into());
        }
        if let Some(z) = words.iter().find(|w| !w.used && w.is("Z")) {
            let finding = self.place.error(FindingCode::NC_ARC, &z.bytes, "a cubic moves X and Y only");
            return Err(finding.help("move Z in a block of its own").into());
        }
        let speed = self.feed_speed()?;
        let start = self.start()?;
        let said = self.end(words)?;
        let [x, y, _] = said.map(|v| v.unwrap_or(f64::NAN));
        let end = DVec2::new(x, y);
        let unit = self.modal.length_unit;
        let mut pair = |names: [&str; 2]| names.map(|name| take(words, name).map(|v| v.value * unit));
        let [first, second] = [pair([OFFSETS[0], OFFSETS[1]]), pair(["P", "Q"])];
        let [Some(p), Some(q)] = second else {
            return Err(self.no_cubic("a cubic without P and Q").help("program both").into());
        };
        let ahead = match (first, self.modal.cubic_end) {
            ([Some(i), Some(j)], _) => DVec2::new(i, j),
            ([None, None], Some(before)) => -before,
            ([None, None], None) => {
                let finding = self.no_cubic("the first cubic of a chain needs I and J");
                return Err(finding.help("program I and J").into());
            }
            _ => return Err(self.no_cubic("a cubic with only one of I and J").help("program both").into()),
        };
        let behind = DVec2::new(p, q);
        let from = start.truncate();
        let span = CubicSpan::new([from, from + ahead, end + behind, end]);
        let span = span.map_err(|e| e.0.at(self.place.sources.locate(self.place.span(&here))))?;
        if !(span.off_biarcs(BIARCS) <= RUN_WITHIN) {
            self.warn(
                &here,
                "LinuxCNC runs a cubic as 16 biarcs: this one is so long or sharp that they leave it by more than 1 um",
            );
        }
        self.push_tip(said, Path::Bezier { span }, speed);
        self.modal.cubic_end = Some(behind);
        Ok(())
    }

    fn no_cubic(&self, message: &str) -> Finding {
        self.place.error(FindingCode::NC_ARC, &self.here, message)
    }
}
