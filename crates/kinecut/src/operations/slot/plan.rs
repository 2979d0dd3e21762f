//! A planned slot: that of its pocket.

use crate::base::Result;
use crate::operations::kind::{self, Judged};
use crate::operations::pocket::{PlannedPocket, PocketJson, section};
use crate::operations::wanted::WantedWall;
use crate::operations::{Found, MadePlane, Pen, PostedPlan, Shown, WearRegister};
use crate::page::Section;

/// A planned slot.
#[derive(Clone, Debug)]
pub struct PlannedSlot {
    /// All of it: a pocket with a centre line.
    pub pocket: PlannedPocket,
}

impl kind::Plan for PlannedSlot {
    type Json = PocketJson;

    const LIST: &'static str = "slots";

    fn wear(&self) -> Option<WearRegister> {
        self.pocket.wear()
    }

    fn write(&mut self, pen: &mut Pen<'_>) -> Result<()> {
        self.pocket.write(pen)
    }

    fn breakthrough(&self) -> f64 {
        self.pocket.breakthrough()
    }

    fn walls(&self) -> Vec<WantedWall> {
        self.pocket.walls()
    }

    fn made_plane(&self) -> Option<MadePlane> {
        self.pocket.made_plane()
    }

    fn judge(&mut self, name: &str, posted: &PostedPlan<'_>, found: &Found<'_>) -> Judged {
        self.pocket.judge(name, posted, found)
    }

    fn sections(all: &[(&PlannedSlot, &Shown<'_>)]) -> Vec<Section> {
        all.iter().map(|(plan, shown)| section(&plan.pocket, shown)).collect()
    }

    fn json(&self, shown: &Shown<'_>) -> Option<PocketJson> {
        Some(PocketJson::new(&self.pocket, shown.number))
    }
}
