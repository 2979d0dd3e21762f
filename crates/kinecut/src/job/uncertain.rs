//! Tools past the stock where zeros, tool lengths and the raw stock may be off.
//!
//! A tool is looked at where its program has it, and the stock is taken as large as it can be seen from there: the raw stock is grown by all
//! that may be off; what the tool cuts itself in the same setup it cuts where it is, as both are off by the same; other tools leave as much as their
//! lengths against its own may be off, and those of earlier setups also what the two zeros may be off ([`Spared`]). So each tool
//! of a setup has a pass of its own over all moves before its last one; where no length may be off one pass serves all.

use glam::DVec3;

use super::check::{Job, Uncertainty};
use super::closer::{Quiet, Story};
use super::raw::{drill_sparing, take_out_sparing};
use super::simulate;
use crate::base::{Finding, Location, Progress, Result, Severity};
use crate::operations::measured::Loose;
use crate::stock::TriDexel;
use crate::stock::cut::{CutList, CutMove, CutOptions, MoveEffect, Spared, ToolBody, cut_list};
use crate::tool::{Tool, ToolNumber};
use crate::trace::Trace;

/// Difference of two directions that counts as none.
const PARALLEL: f64 = 1e-9;

/// Contacts with the stock that are possible where something is off.
#[derive(Clone, Debug, PartialEq)]
pub struct UncertainStock {
    /// Distances that were counted in.
    pub uncertainty: Uncertainty,
    /// For each setup, what each move may meet.
    pub effects: Vec<Vec<MoveEffect>>,
    /// Tools whose axis turns in a setup: what they have cut themselves is taken as cut where the program has it.
    pub turning: Vec<ToolNumber>,
}

/// The stock model that passes need, grown as they need it [bytes].
pub(super) fn memory(job: &Job, step: f64) -> u64 {
    job.uncertainty.map_or(0, |off| TriDexel::memory(job.stock.bounds().grown(off.of_raw()), step))
}

/// Looks at all tools past the stock as it may be; nothing where nothing may be off.
pub(super) fn look(story: &Story<'_>, progress: &dyn Progress) -> Result<Option<UncertainStock>> {
    let Some(uncertainty) = story.job.uncertainty else { return Ok(None) };
    let mut effects: Vec<Vec<MoveEffect>> =
        story.moves.iter().map(|list| vec![MoveEffect::default(); list.moves().len()]).collect();
    let mut turning = Vec::new();
    let axes: Vec<Vec<Option<DVec3>>> = (story.traces.iter())
        .map(|trace| story.job.tools.iter().map(|tool| axis(trace, tool)).collect())
        .collect();
    let passes: Vec<(usize, Vec<usize>)> = (0..story.moves.len())
        .flat_map(|setup| {
            let used = used(story.moves[setup].moves(), story.bodies.len());
            let together = uncertainty.length == 0.0;
            let groups: Vec<Vec<usize>> =
                if together { vec![used] } else { used.into_iter().map(|body| vec![body]).collect() };
            groups.into_iter().map(move |group| (setup, group))
        })
        .collect();
    progress.stage("cut with what may be off", passes.len() as u64);
    for (setup, group) in passes {
        let pass = Pass { story, uncertainty, axes: &axes, setup, group };
        if uncertainty.length > 0.0 {
            let turn = |body: &&usize| axes[setup][**body].is_none();
            turning.extend(pass.group.iter().filter(turn).map(|body| story.job.tools[*body].number));
        }
        pass.run(&mut effects[setup], progress)?;
        progress.advance(1);
    }
    turning.sort_unstable();
    turning.dedup();
    Ok(Some(UncertainStock { uncertainty, effects, turning }))
}

/// The tools that make some move, by their bodies.
fn used(moves: &[CutMove], count: usize) -> Vec<usize> {
    let mut is_used = vec![false; count];
    moves.iter().for_each(|one| is_used[one.body as usize] = true);
    (0..count).filter(|body| is_used[*body]).collect()
}

/// The one axis of a tool in all its moves.
fn axis(trace: &Trace, tool: &Tool) -> Option<DVec3> {
    let mut own = trace.segments.iter().filter(|s| s.tool == Some(tool.number));
    let first = own.next()?;
    let alike = |s: &crate::trace::Segment| s.turning.is_none() && (s.axis - first.axis).length() < PARALLEL;
    (alike(first) && own.all(alike)).then_some(first.axis)
}

/// A pass for some tools of a setup.
struct Pass<'a> {
    story: &'a Story<'a>,
    uncertainty: Uncertainty,
    /// For each setup and tool the one axis of all its moves.
    axes: &'a [Vec<Option<DVec3>>],
    setup: usize,
    group: Vec<usize>,
}

impl Pass<'_> {
    /// Material that a tool may leave in a setup, against the tools of the pass.
    fn spared(&self, setup: usize, body: usize) -> Spared {
        let Uncertainty { offset, length, .. } = self.uncertainty;
        if setup == self.setup && self.group.contains(&body) {
            return Spared::NOTHING;
        }
        // Two zeros in earlier setups, one in its own.
        let zeros = if setup == self.setup { 0.0 } else { 2.0 * offset };
        let own = self.axes[setup][body];
        let alike = |other: &usize| {
            own.zip(self.axes[self.setup][*other]).is_some_and(|(a, b)| (a - b).length() < PARALLEL)
        };
        // Both lengths along one axis, or the other one in some direction.
        match self.group.iter().all(alike) {
            true => Spared { around: zeros, along: 2.0 * length },
            false => Spared { around: zeros + length, along: length },
        }
    }

    /// Material that may remain of a core that is taken out in a setup.
    fn spared_of_core(&self, setup: usize) -> Spared {
        let Uncertainty { offset, length, .. } = self.uncertainty;
        let zeros = if setup == self.setup { 0.0 } else { 2.0 * offset };
        Spared { around: zeros + if setup == self.setup { 0.0 } else { length }, along: 2.0 * length }
    }

    fn run(&self, effects: &mut [MoveEffect], progress: &dyn Progress) -> Result<()> {
        let Story { job, traces, loose, moves, bodies } = self.story;
        let grown = self.uncertainty.of_raw();
        let mut stock = TriDexel::from_solid_grown(&job.stock, grown, job.step)?;
        drill_sparing(&mut stock, job, Spared { around: grown, along: 0.0 })?;
        for setup in 0..=self.setup {
            let own = setup == self.setup;
            let is_own = |one: &CutMove| own && self.group.contains(&(one.body as usize));
            let all = moves[setup].moves();
            let until = match own {
                true => all.iter().rposition(is_own).map_or(0, |last| last + 1),
                false => all.len(),
            };
            let watched = |one: &CutMove| CutMove { watch: one.watch && is_own(one), ..one.clone() };
            let some: Vec<CutMove> = all[..until].iter().map(watched).collect();
            let spared: Vec<Spared> = (0..bodies.len()).map(|body| self.spared(setup, body)).collect();
            let bare = |(i, body): (usize, &ToolBody)| match own && self.group.contains(&i) {
                true => body.clone(),
                false => ToolBody { shank: Vec::new(), holder: Vec::new(), ..body.clone() },
            };
            let bodies: Vec<ToolBody> = bodies.iter().enumerate().map(bare).collect();
            let list = CutList::sparing(&bodies, &spared, some, &CutOptions::default(), job.step)?;
            let mut cores: Vec<&Loose> = loose.get(setup).into_iter().flatten().collect();
            cores.sort_by_key(|core| core.item);
            let mut done = 0;
            let mut cut = |stock: &mut TriDexel, to: usize| -> Result<()> {
                let range = done..to.clamp(done, until);
                done = range.end;
                for (i, effect) in range.clone().zip(cut_list(stock, &list, range, &Quiet(progress))?) {
                    if is_own(&list.moves()[i]) {
                        effects[i] = effect;
                    }
                }
                Ok(())
            };
            for core in cores {
                let at = traces[setup].segments.partition_point(|s| s.item < core.item);
                if own && at > until {
                    break;
                }
                cut(&mut stock, at)?;
                take_out_sparing(&mut stock, core, 0, self.spared_of_core(setup))?;
            }
            cut(&mut stock, until)?;
        }
        Ok(())
    }
}

/// Doubts of what tools may meet where something is off, without that which they meet anyway (`known`, of the same moves).
pub(super) fn findings(
    trace: &Trace,
    (off, effects): (Uncertainty, &[MoveEffect]),
    known: &[MoveEffect],
    tools: &[Tool],
    place: impl Fn(u32) -> Option<Location>,
) -> Vec<Finding> {
    let met: Vec<(u32, crate::base::Code)> =
        simulate::faults(trace, known, tools).into_iter().map(|(item, f)| (item, f.code)).collect();
    let new = simulate::faults(trace, effects, tools).into_iter();
    new.filter(|(item, f)| !met.contains(&(*item, f.code)))
        .map(|(item, f)| Finding {
            severity: Severity::Doubt,
            message: off.possible(&f.message),
            place: place(item),
            ..f
        })
        .collect()
}

/// Whether tools of a setup may meet stock that they should not.
pub(super) fn is_clear(trace: &Trace, effects: &[MoveEffect], tools: &[Tool]) -> bool {
    simulate::faults(trace, effects, tools).is_empty()
}
