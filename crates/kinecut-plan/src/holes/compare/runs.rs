//! The runs of all strategies.

use rayon::prelude::*;

use super::run::run;
use super::{ComparedStrategy, Terms};
use crate::base::Result;

/// Feeds of the runs, in feeds asked for.
const FEEDS: [f64; 3] = [1.0, 3.0, 6.0];

/// Runs each strategy at each feed; keeps the motion of the first.
pub(super) fn add(rows: &mut [ComparedStrategy], terms: &Terms) -> Result<()> {
    let possible = || rows.iter().filter_map(|row| row.figures.as_ref());
    let tasks = possible().flat_map(|figures| FEEDS.map(|factor| (figures, factor * terms.limits.feed)));
    let tasks: Vec<_> = tasks.collect();
    // One by one: they take longer the longer their paths are.
    let runs = tasks.par_iter().with_max_len(1).map(|(figures, feed)| run(&figures.chain, terms, *feed));
    let mut runs = runs.collect::<Result<Vec<_>>>()?.into_iter();
    for figures in rows.iter_mut().filter_map(|row| row.figures.as_mut()) {
        for (i, (run, profile)) in runs.by_ref().take(FEEDS.len()).enumerate() {
            figures.runs.push(run);
            if i == 0 {
                figures.profile = profile;
            }
        }
    }
    Ok(())
}
