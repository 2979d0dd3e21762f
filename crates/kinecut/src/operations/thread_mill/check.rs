//! Thread milling, checked: the thread read, the tool one for threads.

use std::sync::Arc;

use super::ThreadMillTable;
use super::plan::{PlannedThreadMilling, planned};
use crate::base::bounded::{MAX_LENGTH, bounded, length, positive};
use crate::base::{Code, Finding, Result};
use crate::cutting::StartCut;
use crate::operations::kind::{self, Attempt};
use crate::operations::places::{HolePlace, places};
use crate::operations::thread_depth::thread_depth;
use crate::operations::{
    Around, CalledTool, CuttingKeys, FeedKeys, Milling, PlaneTable, Setting, feed_of, milling_of, spindle,
    tool_of, whole_revolutions,
};
use crate::page::trimmed;
use crate::threading::{Thread, ThreadForm, ThreadSide, ThreadSize};
use crate::tool::{Cutter, Hand, ThreadMill};

/// Deviation of the pitch diameter where the job does not say [mm].
const USUAL_TOLERANCE: f64 = 0.01;
/// Taper of NPT: 1 in so much on the diameter.
const NPT: f64 = 16.0;

/// Milling of one or many threads.
#[derive(Clone, Debug)]
pub struct ThreadMillOperation {
    /// As written.
    pub table: ThreadMillTable,
    /// Tool, speed, coolant, tolerance.
    pub milling: Milling,
    /// The teeth of its tool.
    pub mill: ThreadMill,
    /// Depth of full thread [mm].
    pub depth: f64,
    /// The thread.
    pub thread: Thread,
    /// The places in the order of milling.
    pub places: Vec<HolePlace>,
    /// Feed of the edge at the major diameter [mm/s].
    pub feed: f64,
}

impl ThreadMillOperation {
    /// Name of the thread: "M8x1.25", "M8x1.25 left-hand", "M8x1.25 outside".
    pub fn thread_name(&self) -> String {
        let side = if self.table.side == ThreadSide::Outside { " outside" } else { "" };
        self.thread.name() + side
    }

    /// The thread and a place, for a message.
    pub(super) fn at(&self, [x, y]: [f64; 2]) -> String {
        format!("{} at X{} Y{}", self.thread_name(), trimmed(x, 3), trimmed(y, 3))
    }
}

impl kind::Checked for ThreadMillOperation {
    type Plan = PlannedThreadMilling;

    const NOUN: &'static str = "milled thread";

    fn milling(&self) -> &Milling {
        &self.milling
    }

    fn milling_mut(&mut self) -> &mut Milling {
        &mut self.milling
    }

    fn spring_passes(&self) -> u32 {
        self.table.spring_passes
    }

    fn name(&self) -> String {
        match &self.places[..] {
            [one] => format!("mill thread {}", self.at(one.at)),
            many => format!("mill thread {}, {} places", self.thread_name(), many.len()),
        }
    }

    fn is_left_hand(&self) -> bool {
        self.milling.tool.limits.hand == Hand::Left
    }

    fn not_compared(&self) -> Option<&'static str> {
        Some("the flanks of a milled thread, whose tool is simulated as the cylinder of its crests")
    }

    fn plan(self: &Arc<Self>, setting: &Setting<'_>) -> Result<Attempt<PlannedThreadMilling>> {
        planned(self, setting)
    }
}

impl kind::Table for ThreadMillTable {
    type Of = ThreadMillOperation;

    fn check(&self, around: &Around<'_>) -> Result<ThreadMillOperation> {
        operation(self, around)
    }

    fn called(&mut self) -> &mut CalledTool {
        &mut self.tool
    }

    fn data(&mut self) -> Option<CuttingKeys<'_>> {
        let feed = Some(FeedKeys { feed: &mut self.feed, per_tooth: &mut self.feed_per_tooth });
        Some(CuttingKeys {
            speed: &mut self.speed,
            cutting_speed: &mut self.cutting_speed,
            feed,
            per_rev: None,
            cut: StartCut::ThreadMill,
        })
    }

    fn plane(&self) -> Option<&PlaneTable> {
        self.plane.as_ref()
    }
}

fn operation(t: &ThreadMillTable, around: &Around<'_>) -> Result<ThreadMillOperation> {
    let tool = tool_of(&t.tool, around.tools)?;
    let Cutter::ThreadMill(mill) = tool.cutter else {
        let finding = Finding::error(Code::JOB_REFERENCE, format!("{} is no thread mill", tool.number));
        return Err(finding
            .help("give the tool type = \"thread-mill\" with its pitch and rows")
            .key("tool")
            .into());
    };
    let thread = thread(t)?;
    length("top", t.top, -MAX_LENGTH, MAX_LENGTH)?;
    length("clearance", t.clearance.unwrap_or(0.0), -MAX_LENGTH, MAX_LENGTH)?;
    let depth = thread_depth(t.depth, t.top, t.plane.is_some(), around)?;
    if let Some(core) = t.core {
        if t.side == ThreadSide::Outside {
            let finding = Finding::error(Code::JOB_SHAPE, "a thread on a boss has no core hole");
            return Err(finding.help("leave `core` out").key("core").into());
        }
        positive("core.diameter", core.diameter, MAX_LENGTH, "mm")?;
        positive("core.depth", core.depth.unwrap_or(1.0), MAX_LENGTH, "mm")?;
    }
    let speed = whole_revolutions(spindle(t.speed, t.cutting_speed, ("tool", mill.diameter))?);
    let feed = feed_of("thread milling", t.feed, t.feed_per_tooth, speed, tool.teeth)?;
    let tolerance = Some(t.tolerance.unwrap_or(USUAL_TOLERANCE));
    Ok(ThreadMillOperation {
        places: places(t.points.as_deref(), t.pattern.as_ref())?,
        milling: milling_of(tool, speed, t.coolant, tolerance)?,
        table: t.clone(),
        depth,
        mill,
        thread,
        feed,
    })
}

/// The thread, by its size or by diameter and pitch.
fn thread(t: &ThreadMillTable) -> Result<Thread> {
    let shape = |what: &str, key: &str| {
        Finding::error(Code::JOB_SHAPE, what)
            .help("give size = \"M8\" or \"M20x1.5\", or diameter and pitch")
            .key(key)
    };
    let size = match (&t.size, t.diameter, t.pitch) {
        (Some(size), None, None) => {
            if t.form != ThreadForm::Metric {
                return Err(shape("`size` is that of a metric thread", "size").into());
            }
            ThreadSize::parse(size).map_err(|e| e.under("size"))?
        }
        (None, Some(diameter), Some(pitch)) => ThreadSize { diameter, pitch },
        (Some(_), Some(_), _) => {
            return Err(shape("`size` and `diameter` exclude each other", "diameter").into());
        }
        (Some(_), None, Some(_)) => {
            return Err(shape("`size` and `pitch` exclude each other", "pitch").into());
        }
        (None, Some(_), None) => return Err(shape("the thread needs its pitch", "diameter").into()),
        (None, None, _) => return Err(shape("the thread needs its size", "tool").into()),
    };
    positive("diameter", size.diameter, MAX_LENGTH, "mm")?;
    positive("pitch", size.pitch, MAX_LENGTH, "mm")?;
    let taper = match t.taper.or((t.form == ThreadForm::Npt).then_some(NPT)) {
        Some(one_in) => 1.0 / bounded("taper", one_in, 4.0, 1000.0, "")?,
        None => 0.0,
    };
    Ok(Thread { hand: t.hand, taper, ..Thread::new(t.form, size.diameter, size.pitch) })
}
