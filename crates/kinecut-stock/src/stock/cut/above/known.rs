//! The ceilings of all patches, kept packed until somebody reads them all.

use std::ops::Deref;
use std::sync::{Arc, OnceLock};

use super::packed::PackedCeilings;
use super::patch::{Known, PatchCeilings};

/// Ceilings by patch. They are packed until they are read as a list: from then on they are kept open, and shared by the times at which
/// they were the same.
#[derive(Clone, Debug)]
pub(super) struct KnownCeilings {
    /// Of no use once they are open.
    packed: Vec<Option<PackedCeilings>>,
    open: OnceLock<Vec<Known>>,
}

/// Ceilings of a patch as they are to be kept.
pub(super) enum NewCeilings {
    Packed(PackedCeilings),
    Open(Arc<PatchCeilings>),
}

impl KnownCeilings {
    /// None is known of any patch.
    pub(super) fn none(patches: usize) -> KnownCeilings {
        KnownCeilings { packed: vec![None; patches], open: OnceLock::new() }
    }

    /// Those of a patch.
    pub(super) fn of(&self, patch: usize) -> Known {
        match self.open.get() {
            Some(open) => open[patch].clone(),
            None => self.packed[patch].as_ref().map(|packed| Arc::new(packed.unpacked())),
        }
    }

    /// Ceilings in the form in which these are kept.
    pub(super) fn form(&self, ceilings: PatchCeilings) -> NewCeilings {
        match self.open.get() {
            Some(_) => NewCeilings::Open(Arc::new(ceilings)),
            None => NewCeilings::Packed(PackedCeilings::of(&ceilings)),
        }
    }

    /// Replaces those of a patch.
    pub(super) fn set(&mut self, patch: usize, new: NewCeilings) {
        match (new, self.open.get_mut()) {
            (NewCeilings::Open(new), Some(open)) => open[patch] = Some(new),
            (NewCeilings::Packed(new), Some(open)) => open[patch] = Some(Arc::new(new.unpacked())),
            (NewCeilings::Open(new), None) => self.packed[patch] = Some(PackedCeilings::of(&new)),
            (NewCeilings::Packed(new), None) => self.packed[patch] = Some(new),
        }
    }
}

impl Deref for KnownCeilings {
    type Target = Vec<Known>;

    fn deref(&self) -> &Vec<Known> {
        // One after another: who waits for it may be a thread that would be asked to help.
        self.open.get_or_init(|| {
            self.packed.iter().map(|packed| Some(Arc::new(packed.as_ref()?.unpacked()))).collect()
        })
    }
}
