//! Tasks that owe lines across their axis, with the patches where they do; the next ones are made ready while some are paid.

use rayon::prelude::*;

use super::super::axis::ToolFrame;
use super::super::task::Task;
use super::field::Field;
use super::gathered::Gathered;
use super::late::{Late, Open};
use super::layers::Layers;
use super::patch::{Known, Patch};
use crate::base::Progress;

/// Tasks that owe lines on open patches, as many as are paid at once.
pub(super) struct Owed<'a> {
    pub(super) tasks: Vec<Task<'a>>,
    /// By patch, the tasks that may reach it and are wanted there.
    bins: Vec<Vec<u32>>,
    /// The first move after theirs.
    pub(super) end: usize,
}

impl<'a> Owed<'a> {
    /// The tasks from a move on.
    pub(super) fn new(
        late: &'a Late,
        from: usize,
        frame: &ToolFrame,
        (field, open, patches): (&Field, &Open, usize),
    ) -> Owed<'a> {
        let (tasks, end) = late.tasks(from, frame, field, open);
        let mut bins: Vec<Vec<u32>> = vec![Vec::new(); patches];
        field.each_near(&tasks, |patch, i| {
            if open.wants(patch, tasks[i as usize].index as usize) {
                bins[patch].push(i);
            }
        });
        Owed { tasks, bins, end }
    }

    /// Their claims on the ways of a field below their ceilings.
    pub(super) fn claims(
        &self,
        field: &Field,
        ceilings: &[Known],
        layers: &Layers,
        progress: &dyn Progress,
    ) -> Gathered {
        let of_patch = |(p, bin): (usize, &Vec<u32>)| {
            let mut claims = [Vec::new(), Vec::new()];
            if bin.is_empty() {
                return claims;
            }
            let mut patch = Patch::new(field, p, ceilings[p].as_deref());
            patch.keep_covers(true);
            for i in bin {
                if progress.cancelled() {
                    break;
                }
                // A watched task was clear, and has met nothing.
                let task = &self.tasks[*i as usize];
                if !task.watch {
                    patch.claim(layers, *i, task, &mut claims);
                }
            }
            claims
        };
        let of_patches = self.bins.par_iter().enumerate().with_max_len(1).map(of_patch).collect();
        Gathered { of_patches, across: field.patches()[0] }
    }
}
