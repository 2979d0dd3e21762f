//! The list of layouts: enumerate, leave out, score, sort.

use std::collections::{BTreeMap, BTreeSet};

use rayon::prelude::*;

use super::criterion::sort;
use super::kind::rotaries;
use super::mobility::{is_regular, rank_without_spin};
use super::reach::{Reach, reach};
use super::strokes::needed_strokes;
use super::workspace::workspace;
use super::{Attitude, Layout, LayoutKind, Query, Scores};
use crate::base::{Code, Finding, Progress, Result, Silent};
use crate::machine::{CoordinateCode, Elementary, Word};

/// An answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Layouts {
    /// Number of layouts before conditions.
    pub enumerated: usize,
    /// Number of layouts that each condition leaves out, taken by itself.
    pub left_out: Vec<(&'static str, usize)>,
    /// The layouts, the best first.
    pub layouts: Vec<Layout>,
    /// Says so when nothing is left.
    pub findings: Vec<Finding>,
}

impl Layouts {
    /// The classes of the layouts, sorted.
    pub fn classes(&self) -> BTreeSet<&Word> {
        self.layouts.iter().map(|l| &l.class).collect()
    }
}

/// All layouts that a query asks for, the best first: by cost (see [`Layout::cost`]), then by digits, a vertical spindle
/// before a horizontal one.
///
/// ```
/// # use kinecut_machine as kinecut;
/// use kinecut::machine::layouts::{Query, Search, layouts};
/// let all = layouts(&Query::new(Search::parse("XYZ").unwrap())).unwrap();
/// assert_eq!(all.layouts.len(), 24); // Vragov
/// ```
///
/// # Errors
/// Those of [`Query::check`] and [`super::Search::codes`].
pub fn layouts(query: &Query) -> Result<Layouts> {
    layouts_watched(query, &Silent)
}

/// The same for a search that may be given up: with sizes of a part it takes seconds from seven motions on.
///
/// # Errors
/// As [`layouts`]; `KC0009` when cancelled.
pub fn layouts_watched(query: &Query, progress: &dyn Progress) -> Result<Layouts> {
    let still_wanted = || match progress.cancelled() {
        true => Err(Finding::error(Code::CANCELLED, "the search for layouts was cancelled")),
        false => Ok(()),
    };
    query.check()?;
    let codes = query.search.codes()?;
    let mut known = Known::default();
    let mut turned = BTreeSet::new();
    let mut left_out: Vec<(&'static str, usize)> = Vec::new();
    let mut answer = Vec::new();
    let mut enumerated = 0;
    for code in codes {
        still_wanted()?;
        let facts = known.of(&code, query);
        for &attitude in &query.attitudes {
            if query.quarter_turns_are_one
                && attitude == Attitude::Vertical
                && !turned.insert(turn_key(&code))
            {
                continue;
            }
            enumerated += 1;
            let mut keep = true;
            for name in broken(&code, &facts, query) {
                keep = false;
                match left_out.iter_mut().find(|l| l.0 == name) {
                    Some(l) => l.1 += 1,
                    None => left_out.push((name, 1)),
                }
            }
            if keep {
                let length = query.sizes.tool_length;
                answer.push(Layout {
                    class: facts.class.clone(),
                    kind: LayoutKind::of(&code),
                    attitude,
                    rank: facts.rank,
                    regular: facts.regular,
                    stroke: facts.stroke,
                    scores: Scores::new(&code, attitude, facts.stroke, length, &query.masses, &query.errors),
                    reach: facts.reach,
                    workspace: None,
                    cost: 0.0,
                    pareto: false,
                    code: code.clone(),
                });
            }
        }
    }
    sort(&mut answer, &query.weights);
    for layout in answer.iter_mut().take(query.listed) {
        still_wanted()?;
        layout.reach = Some(known.reach(&layout.code, query));
    }
    // Each by itself, so that the result does not hang on the number of threads.
    let listed = if query.workspaces { query.listed.min(answer.len()) } else { 0 };
    answer[..listed].par_iter_mut().try_for_each(|layout| {
        layout.workspace = Some(workspace(&layout.code, &query.sizes));
        still_wanted()
    })?;
    let findings = if answer.is_empty() { vec![nothing_left(enumerated, &left_out)] } else { Vec::new() };
    Ok(Layouts { enumerated, left_out, layouts: answer, findings })
}

/// Results that are the same for many layouts, computed once.
#[derive(Default)]
struct Known {
    /// Word of the last layout with its class.
    last: Option<(Word, Word)>,
    /// Rank and regularity of a class.
    classes: BTreeMap<Word, (usize, bool)>,
    /// Strokes by class and number of rotary axes on the work side.
    strokes: BTreeMap<(Word, usize), Option<[f64; 3]>>,
    /// Reach by the sequence of rotary axes.
    reaches: BTreeMap<Vec<Elementary>, Reach>,
}

/// Properties of a layout that are known before it is scored.
struct Facts {
    class: Word,
    rank: usize,
    regular: bool,
    /// Strokes needed, or those given.
    stroke: [f64; 3],
    reach: Option<Reach>,
}

impl Known {
    fn of(&mut self, code: &CoordinateCode, query: &Query) -> Facts {
        let class = match &self.last {
            Some((word, class)) if word == code.word() => class.clone(),
            _ => {
                let class = code.word().canonical();
                self.last = Some((code.word().clone(), class.clone()));
                class
            }
        };
        let (rank, regular) = match self.classes.get(&class) {
            Some(found) => *found,
            None => {
                let found = (rank_without_spin(&class, &query.sizes), is_regular(&class));
                *self.classes.entry(class.clone()).or_insert(found)
            }
        };
        let stroke = if query.sizes.part.is_some() {
            let key = (class.clone(), rotaries(code)[0]);
            *self.strokes.entry(key).or_insert_with(|| needed_strokes(code, &query.sizes))
        } else {
            None
        };
        let reach = query.conditions.tilt.map(|_| self.reach(code, query));
        Facts { class, rank, regular, stroke: stroke.unwrap_or(query.sizes.stroke), reach }
    }

    fn reach(&mut self, code: &CoordinateCode, query: &Query) -> Reach {
        let rotary: Vec<Elementary> = code.word().0.iter().copied().filter(|m| m.is_rotation()).collect();
        *self.reaches.entry(rotary).or_insert_with_key(|r| reach(&Word(r.clone()), &query.sizes))
    }
}

/// Names of the conditions that a layout breaks.
fn broken(code: &CoordinateCode, facts: &Facts, query: &Query) -> Vec<&'static str> {
    let (conditions, sizes) = (&query.conditions, &query.sizes);
    let motions = &code.word().0;
    let (work, tool) = motions.split_at(code.bed());
    let mut names = Vec::new();
    let mut require = |holds: bool, name: &'static str| {
        if !holds {
            names.push(name);
        }
    };
    /// Freedoms of a tool that spins: its place and the direction of its axis.
    const FREE: usize = 5;
    require(!conditions.full_mobility || facts.rank >= motions.len().min(FREE), "full mobility");
    require(!conditions.regular || facts.regular, "regular translations");
    require(conditions.most_work_links.is_none_or(|most| work.len() <= most), "axes on the work side");
    let among = |side: &[Elementary], allowed: &Option<Vec<Elementary>>| {
        allowed.as_ref().is_none_or(|a| side.iter().all(|m| a.contains(m)))
    };
    require(among(work, &conditions.work_motions), "kind of axes on the work side");
    require(among(tool, &conditions.tool_motions), "kind of axes on the tool side");
    require(
        conditions.kinds.as_ref().is_none_or(|kinds| kinds.contains(&LayoutKind::of(code))),
        "place of the rotary axes",
    );
    if let Some(stacking) = conditions.stacking {
        let stacked = tool.iter().filter(|m| !m.is_rotation());
        let longest = stacked.clone().map(|m| facts.stroke[usize::from(m.digit()) - 1]).fold(0.0, f64::max);
        require(stacked.count() <= stacking.most || longest <= stacking.above, "stacked translations");
    }
    if let (Some(tilt), Some(reach)) = (conditions.tilt, facts.reach) {
        require(reach.tilt >= tilt, "tilt of the tool");
    }
    // Strokes are computed, not measured: a rounding error breaks no condition.
    let fits = |need: f64, have: f64| need <= have * (1.0 + 1e-9);
    let needed = facts.stroke.iter().zip(sizes.stroke).all(|(&need, have)| fits(need, have));
    require(!conditions.within_stroke || needed, "strokes");
    names
}

/// The digits of a code or of that which a quarter turn about Z makes of it, whichever comes first; inclined rotations
/// have no counterpart.
fn turn_key(code: &CoordinateCode) -> String {
    let text = code.to_string();
    if code.word().0.iter().any(|m| m.digit() > 6) {
        return text;
    }
    let swap = |c| match c {
        '1' => '2',
        '2' => '1',
        '4' => '5',
        '5' => '4',
        c => c,
    };
    let other: String = text.chars().map(swap).collect();
    text.min(other)
}

fn nothing_left(enumerated: usize, left_out: &[(&'static str, usize)]) -> Finding {
    let counts: Vec<String> = left_out.iter().map(|(name, n)| format!("{name} {n}")).collect();
    Finding::warning(
        Code::LAYOUT_NONE,
        format!("none of {enumerated} layouts satisfies the conditions; left out by {}", counts.join(", ")),
    )
    .help("relax the condition that leaves out most")
}

#[cfg(test)]
mod tests {
    use super::super::{Conditions, Criterion, Search, Stacking};
    use super::*;

    fn five(conditions: Conditions) -> Layouts {
        let motions = "XYZAC".chars().filter_map(|c| Elementary::from_iso(&c.to_string())).collect();
        let query = Query { conditions, listed: 0, ..Query::new(Search::Motions(motions)) };
        layouts(&query).unwrap()
    }

    #[test]
    fn each_condition_leaves_out_what_breaks_it() {
        let all = five(Conditions::default());
        assert_eq!((all.enumerated, all.layouts.len()), (720, 720));
        let sides = |l: &Layout| {
            let (work, tool) = l.code.word().0.split_at(l.code.bed());
            (work.to_vec(), tool.to_vec())
        };
        // Each condition with a check of its own, by the digits of the code.
        type Check = Box<dyn Fn(&Layout) -> bool>;
        let before = |l: &Layout, a: char, b: char| {
            let text = l.code.to_string();
            text.find(a) < text.find(b)
        };
        let cases: Vec<(Conditions, Check)> = vec![
            (
                // C before A: a last C only spins the tool.
                Conditions { full_mobility: true, ..Conditions::default() },
                Box::new(move |l| before(l, '6', '4')),
            ),
            (
                Conditions { most_work_links: Some(1), ..Conditions::default() },
                Box::new(|l| l.code.to_string().find('0') <= Some(1)),
            ),
            (
                Conditions { kinds: Some(vec![LayoutKind::TableTable]), ..Conditions::default() },
                Box::new(move |l| before(l, '4', '0') && before(l, '6', '0')),
            ),
            (
                Conditions {
                    work_motions: Some(vec![Elementary::C, Elementary::X]),
                    ..Conditions::default()
                },
                Box::new(move |l| sides(l).0.iter().all(|m| [1, 6].contains(&m.digit()))),
            ),
            (
                Conditions { tool_motions: Some(vec![Elementary::Z]), ..Conditions::default() },
                Box::new(move |l| sides(l).1.iter().all(|m| m.digit() == 3)),
            ),
            (
                Conditions { stacking: Some(Stacking { most: 1, above: 100.0 }), ..Conditions::default() },
                Box::new(move |l| sides(l).1.iter().filter(|m| m.digit() <= 3).count() <= 1),
            ),
        ];
        for (conditions, check) in cases {
            let kept = five(conditions.clone());
            let wanted = all.layouts.iter().filter(|l| check(l)).count();
            assert!(wanted > 0 && wanted < 720, "{conditions:?}");
            assert_eq!(kept.layouts.len(), wanted, "{conditions:?}");
            assert!(kept.layouts.iter().all(check), "{conditions:?}");
            assert_eq!(kept.left_out.iter().map(|l| l.1).sum::<usize>(), 720 - wanted);
        }
    }

    #[test]
    fn tilt_and_strokes_are_conditions() {
        let tilt = |tilt: f64| five(Conditions { tilt: Some(tilt.to_radians()), ..Conditions::default() });
        // A goes to 120 degrees on both sides; C turns freely.
        assert_eq!(tilt(110.0).layouts.len(), 360);
        assert_eq!(tilt(130.0).layouts.len(), 0);
        assert_eq!(tilt(130.0).findings.len(), 1);
        let mut query = Query::new(Search::parse("2103").unwrap());
        query.conditions.within_stroke = true;
        query.sizes.part = Some([600.0, 500.0, 500.0]);
        assert_eq!(layouts(&query).unwrap().layouts.len(), 24);
        query.sizes.part = Some([601.0, 500.0, 500.0]);
        let none = layouts(&query).unwrap();
        assert_eq!(none.left_out, [("strokes", 24)]);
    }

    #[test]
    fn the_order_is_by_cost_and_then_by_digits() {
        let query =
            Query { weights: vec![(Criterion::WorkLinks, 1.0)], ..Query::new(Search::parse("XYZ").unwrap()) };
        let found = layouts(&query).unwrap().layouts;
        let codes: Vec<String> = found.iter().map(|l| l.code.to_string()).collect();
        assert_eq!(codes[..7], ["0123", "0132", "0213", "0231", "0312", "0321", "1023"]);
        assert_eq!((found[0].cost, found[23].cost), (0.0, 1.0));
        assert!(found[..6].iter().all(|l| l.pareto) && found[6..].iter().all(|l| !l.pareto));
        assert!(found[0].workspace.is_some() && found[0].reach.is_some());
    }

    #[test]
    fn questions_that_contradict_themselves_are_refused() {
        let base = || Query::new(Search::parse("XYZAC").unwrap());
        let mut wrong: Vec<(Query, &str)> = Vec::new();
        let mut query = base();
        query.sizes.stroke[1] = -5.0;
        wrong.push((query, "stroke.y"));
        let mut query = base();
        query.sizes.rotary[0] = Some([1.0, -1.0]);
        wrong.push((query, "the range of A is reversed"));
        let mut query = base();
        query.sizes.inclined[0] = glam::DVec3::ZERO;
        wrong.push((query, "inclined rotation 7"));
        let mut query = base();
        query.masses.work = f64::NAN;
        wrong.push((query, "mass.work"));
        let mut query = base();
        query.weights[0].1 = -1.0;
        wrong.push((query, "weight.tool-rotaries"));
        let mut query = base();
        query.sizes.stroke[1] = 1e308;
        wrong.push((query, "stroke.y"));
        let mut query = base();
        query.conditions.tilt = Some(-5f64.to_radians());
        wrong.push((query, "-5 deg"));
        for (query, said) in wrong {
            let message = layouts(&query).unwrap_err().to_string();
            assert!(message.contains(said), "{message}");
        }
    }
}
