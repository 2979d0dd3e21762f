//! Criteria by which layouts are compared, and the order that follows.

use super::Layout;

/// A criterion by which layouts are compared; less is better.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Criterion {
    /// Axes that carry the work.
    WorkLinks,
    /// Rotary axes that carry the work.
    WorkRotaries,
    /// Rotary axes that carry the tool.
    ToolRotaries,
    /// Sum over the axes of the mass that each one moves.
    MovedMass,
    /// Mass that the vertical axis lifts.
    LiftedMass,
    /// Strokes that do not run on the bed.
    Overhang,
    /// Shift of the tip by the errors of the links.
    ErrorGain,
    /// Sum of the strokes.
    Stroke,
}

impl Criterion {
    /// All of them.
    pub const ALL: [Criterion; 8] = [
        Criterion::WorkLinks,
        Criterion::WorkRotaries,
        Criterion::ToolRotaries,
        Criterion::MovedMass,
        Criterion::LiftedMass,
        Criterion::Overhang,
        Criterion::ErrorGain,
        Criterion::Stroke,
    ];

    /// The usual ones with equal weights: stiffness, masses, overhang, errors.
    pub const USUAL: [(Criterion, f64); 5] = [
        (Criterion::ToolRotaries, 1.0),
        (Criterion::MovedMass, 1.0),
        (Criterion::LiftedMass, 1.0),
        (Criterion::Overhang, 1.0),
        (Criterion::ErrorGain, 1.0),
    ];

    /// Its name for users.
    pub fn name(self) -> &'static str {
        match self {
            Criterion::WorkLinks => "work-links",
            Criterion::WorkRotaries => "work-rotaries",
            Criterion::ToolRotaries => "tool-rotaries",
            Criterion::MovedMass => "moved-mass",
            Criterion::LiftedMass => "lifted-mass",
            Criterion::Overhang => "overhang",
            Criterion::ErrorGain => "error-gain",
            Criterion::Stroke => "stroke",
        }
    }

    /// The criterion of a name.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::layouts::Criterion;
    /// assert_eq!(Criterion::parse("moved-mass"), Some(Criterion::MovedMass));
    /// ```
    pub fn parse(name: &str) -> Option<Criterion> {
        Criterion::ALL.into_iter().find(|c| c.name() == name)
    }

    /// The raw number of a layout.
    pub fn value(self, layout: &Layout) -> f64 {
        let scores = &layout.scores;
        match self {
            Criterion::WorkLinks => scores.work_links as f64,
            Criterion::WorkRotaries => scores.work_rotaries as f64,
            Criterion::ToolRotaries => scores.tool_rotaries as f64,
            Criterion::MovedMass => scores.moved_mass,
            Criterion::LiftedMass => scores.lifted_mass,
            Criterion::Overhang => scores.overhang,
            Criterion::ErrorGain => scores.error_gain,
            Criterion::Stroke => layout.stroke.iter().sum(),
        }
    }
}

/// Puts costs and Pareto marks on layouts, and sorts them by cost, then by their digits, a vertical spindle first.
///
/// The cost is the sum of weight times `(value - least) / (greatest - least)` over the layouts given. A layout has the
/// Pareto mark when no other one is as good in all that counts and better in something.
pub(super) fn sort(layouts: &mut Vec<Layout>, weights: &[(Criterion, f64)]) {
    let counting: Vec<(Criterion, f64)> = weights.iter().copied().filter(|w| w.1 > 0.0).collect();
    let mut values: Vec<Vec<f64>> =
        layouts.iter().map(|l| counting.iter().map(|(c, _)| c.value(l)).collect()).collect();
    for (k, (_, weight)) in counting.iter().enumerate() {
        let column = || values.iter().map(|v| v[k]);
        let least = column().fold(f64::INFINITY, f64::min);
        let width = column().fold(f64::NEG_INFINITY, f64::max) - least;
        for (layout, v) in layouts.iter_mut().zip(&mut values) {
            v[k] = if width > 0.0 { (v[k] - least) / width } else { 0.0 };
            layout.cost += weight * v[k];
        }
    }
    for (layout, mark) in layouts.iter_mut().zip(pareto(&values)) {
        layout.pareto = mark;
    }
    let mut keyed: Vec<(f64, String, Layout)> =
        layouts.drain(..).map(|l| (l.cost, l.code.to_string(), l)).collect();
    keyed.sort_by(|a, b| {
        // Costs are sums of the same numbers in the same order, so that equal ones are equal to the last bit.
        a.0.total_cmp(&b.0).then_with(|| a.1.cmp(&b.1)).then(a.2.attitude.cmp(&b.2.attitude))
    });
    layouts.extend(keyed.into_iter().map(|k| k.2));
}

/// True for each vector that no other one dominates.
fn pareto(values: &[Vec<f64>]) -> Vec<bool> {
    // A vector that dominates another one has a smaller sum, so those before in the order of sums suffice, and of those
    // the ones that are not dominated themselves.
    let sum = |i: usize| values[i].iter().sum::<f64>();
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&i, &j| {
        // The better one is first in the order of words also if rounding makes the sums equal.
        let words = || values[i].iter().zip(&values[j]).map(|(a, b)| a.total_cmp(b)).find(|o| o.is_ne());
        sum(i).total_cmp(&sum(j)).then_with(|| words().unwrap_or(std::cmp::Ordering::Equal))
    });
    let dominates = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(x, y)| x <= y) && a != b;
    let mut front: Vec<usize> = Vec::new();
    let mut marks = vec![false; values.len()];
    for i in order {
        if front.iter().any(|&f| values[f] == values[i]) {
            marks[i] = true;
        } else if !front.iter().any(|&f| dominates(&values[f], &values[i])) {
            marks[i] = true;
            front.push(i);
        }
    }
    marks
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        #[test]
        fn the_pareto_marks_are_those_of_all_pairs(
            values in proptest::collection::vec(proptest::collection::vec(0u8..4, 3), 0..40)
        ) {
            let values: Vec<Vec<f64>> =
                values.into_iter().map(|v| v.into_iter().map(f64::from).collect()).collect();
            let beaten = |b: &Vec<f64>| values.iter().any(|a| a.iter().zip(b).all(|(x, y)| x <= y) && a != b);
            prop_assert_eq!(pareto(&values), values.iter().map(|v| !beaten(v)).collect::<Vec<_>>());
        }
    }
}
