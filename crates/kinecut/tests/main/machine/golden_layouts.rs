//! Golden numbers of layouts (seed 004, section 4): counts, classes, types, cover of directions.

use std::collections::{BTreeMap, BTreeSet};

use kinecut::machine::layouts::{
    Attitude, Layout, LayoutKind, Query, REGULAR_CLASSES, Search, Sizes, class_words, layouts, orders, reach,
};
use kinecut::machine::{CoordinateCode, Elementary, Word};
use serde_json::Value;

use crate::common::golden;

fn count(value: &Value) -> usize {
    usize::try_from(value.as_u64().unwrap()).unwrap()
}

fn texts(value: &Value) -> BTreeSet<String> {
    value.as_array().unwrap().iter().map(|v| v.as_str().unwrap().to_owned()).collect()
}

fn found(search: &str) -> Vec<Layout> {
    layouts(&Query::new(Search::parse(search).unwrap())).unwrap().layouts
}

fn classes<'a>(layouts: impl IntoIterator<Item = &'a Layout>) -> BTreeSet<String> {
    layouts.into_iter().map(|l| l.class.to_string()).collect()
}

/// Classes counted once where a quarter turn makes one of the other.
fn classes_up_to_a_quarter_turn(classes: &BTreeSet<String>) -> usize {
    let swap = |c| match c {
        '1' => '2',
        '2' => '1',
        '4' => '5',
        '5' => '4',
        c => c,
    };
    let turned = |class: &String| {
        let word = Word::parse(&class.chars().map(swap).collect::<String>()).unwrap();
        class.clone().min(word.canonical().to_string())
    };
    classes.iter().map(turned).collect::<BTreeSet<_>>().len()
}

/// Layouts of three translations with each pair of rotary axes.
fn five_axes() -> Vec<Layout> {
    ["XYZAB", "XYZAC", "XYZBC"].into_iter().flat_map(found).collect()
}

#[test]
fn three_axes_have_the_24_layouts_of_vragov() {
    let golden = &golden::file("kinematics")["layouts"]["xyz_3axis"];
    let all = found("XYZ");
    assert_eq!(all.len(), count(&golden["layouts_with_bed"]));
    assert_eq!(classes(&all).len(), count(&golden["kinematic_classes"]));
    for (links, number) in golden["by_links_on_work_side"].as_object().unwrap() {
        let with = all.iter().filter(|l| l.code.bed().to_string() == *links).count();
        assert_eq!(with, count(number), "{links} axes carry the work");
    }
    let both = Query {
        attitudes: vec![Attitude::Vertical, Attitude::Horizontal],
        ..Query::new(Search::parse("XYZ").unwrap())
    };
    assert_eq!(layouts(&both).unwrap().layouts.len(), count(&golden["with_spindle_attitude_hv"]));
    assert_eq!(all.iter().map(|l| l.code.to_string()).collect::<BTreeSet<_>>().len(), 24, "each one once");
}

#[test]
fn four_axes_have_120_layouts() {
    let golden = &golden::file("kinematics")["layouts"];
    for (name, letters) in [("xyz_plus_4", "XYZA"), ("xyz_plus_5", "XYZB"), ("xyz_plus_6", "XYZC")] {
        let (golden, all) = (&golden[name], found(letters));
        assert_eq!(all.len(), count(&golden["layouts_with_bed"]), "{letters}");
        assert_eq!(all.len() / 5, count(&golden["chains"]), "{letters}");
        assert_eq!(classes(&all).len(), count(&golden["kinematic_classes"]), "{letters}");
        let ranks: BTreeSet<usize> = all.iter().map(|l| l.rank).collect();
        let wanted: BTreeSet<usize> = golden["rank_mod_spin"].as_array().unwrap().iter().map(count).collect();
        assert_eq!(ranks, wanted, "{letters}");
    }
}

#[test]
fn five_axes_have_2160_layouts_in_72_classes_of_which_12_are_regular() {
    let golden = &golden::file("kinematics")["layouts"]["xyz_2rot"];
    let all = five_axes();
    let number = |key: &str| count(&golden[key]);
    assert_eq!(all.len(), number("layouts_with_bed_all"));
    assert_eq!(all.len() / 6, number("chains_all"));
    assert_eq!(classes(&all).len(), number("kinematic_classes_all"));

    let full: Vec<&Layout> = all.iter().filter(|l| l.rank == 5).collect();
    assert_eq!(full.len(), number("rank5_layouts_with_bed"));
    assert_eq!(full.len() / 6, number("rank5_chains"));
    let full_classes = classes(full.iter().copied());
    assert_eq!(full_classes.len(), number("rank5_classes"));
    assert_eq!(classes_up_to_a_quarter_turn(&full_classes), number("rank5_classes_mod_xy_swap"));

    let regular: Vec<&Layout> = full.iter().copied().filter(|l| l.regular).collect();
    assert_eq!(regular.len(), number("regular_translations_layouts_with_bed"));
    assert_eq!(regular.len() / 6, number("regular_translations_chains"));
    let regular_classes = classes(regular.iter().copied());
    assert_eq!(regular_classes, texts(&golden["regular_classes"]));
    assert_eq!(regular_classes, REGULAR_CLASSES.map(str::to_owned).into());
    assert_eq!(
        classes_up_to_a_quarter_turn(&regular_classes),
        number("regular_translations_classes_mod_xy_swap")
    );

    for (layouts, key) in [(&full, "rank5_layouts_by_type"), (&regular, "regular_layouts_by_type")] {
        let mut by_kind: BTreeMap<&str, usize> = BTreeMap::new();
        for layout in layouts {
            *by_kind.entry(layout.kind.name()).or_default() += 1;
        }
        for kind in [LayoutKind::TableTable, LayoutKind::HeadTable, LayoutKind::HeadHead] {
            assert_eq!(by_kind[kind.name()], count(&golden[key][kind.name()]), "{key} {kind}");
        }
    }

    let pairs = |rank: usize| -> BTreeSet<Vec<u8>> {
        let pair = |l: &Layout| l.class.0.iter().map(|m| m.digit()).filter(|d| *d > 3).collect();
        all.iter().filter(|l| (l.rank == 5) == (rank == 5)).map(pair).collect()
    };
    for (rank, key) in [(4, "rank4_ordered_rotary_pairs"), (5, "rank5_ordered_rotary_pairs")] {
        let wanted: BTreeSet<Vec<u8>> = serde_json::from_value(golden[key].clone()).unwrap();
        assert_eq!(pairs(rank), wanted, "{key}");
    }
}

#[test]
fn quarter_turns_of_a_vertical_spindle_halve_the_regular_layouts() {
    let regular = Query { quarter_turns_are_one: true, ..Query::new(Search::Regular) };
    assert_eq!(layouts(&regular).unwrap().layouts.len(), 324);
    let horizontal = Query { attitudes: vec![Attitude::Horizontal], ..regular };
    assert_eq!(layouts(&horizontal).unwrap().layouts.len(), 648);
}

#[test]
fn two_translations_and_three_rotations_have_360_chains() {
    let rotations = [Elementary::A, Elementary::B, Elementary::C];
    let shifts = [Elementary::X, Elementary::Y, Elementary::Z];
    let chains: usize = (0..3)
        .map(|left_out| {
            let kept = shifts.iter().enumerate().filter(|(i, _)| *i != left_out).map(|(_, m)| *m);
            orders(&kept.chain(rotations).collect::<Vec<_>>()).unwrap().len()
        })
        .sum();
    assert_eq!(chains, count(&golden::file("kinematics")["layouts"]["t2r3_chains"]));
}

#[test]
fn surfaces_have_the_layouts_of_the_catalogue() {
    let golden = golden::file("kinematics");
    for surface in golden["surfaces"].as_array().unwrap() {
        let code = surface["code"].as_str().unwrap();
        let words = class_words(&Word::parse(code).unwrap()).unwrap();
        assert_eq!(words.len(), count(&surface["layouts"]["chains"]), "{code}");
        assert_eq!(words.len() * (code.len() + 1), count(&surface["layouts"]["with_bed"]), "{code}");
    }
}

#[test]
fn chains_of_machines_are_written_as_in_iso_10791() {
    for machine in golden::file("kinematics")["machines"].as_array().unwrap() {
        let code = CoordinateCode::parse(machine["code"].as_str().unwrap()).unwrap();
        assert_eq!(code.iso(), machine["iso_code"].as_str().unwrap());
        assert_eq!(CoordinateCode::parse_any(&code.iso()).unwrap(), code);
    }
}

#[test]
fn cover_of_directions_is_the_golden_one() {
    let golden = golden::file("kinematics");
    let mut checked = 0;
    for machine in golden["machines"].as_array().unwrap() {
        let Some(cover) = machine["orientation_cover"].as_object() else { continue };
        let code = CoordinateCode::parse(machine["code"].as_str().unwrap()).unwrap();
        let mut sizes = Sizes { rotary: [None; 6], ..Sizes::default() };
        let axis: [f64; 3] = serde_json::from_value(machine["axis0"].clone()).unwrap();
        sizes.spindle = axis.into();
        for (joint, motion) in machine["joints"].as_array().unwrap().iter().zip(&code.word().0) {
            if joint["kind"] != "R" {
                continue;
            }
            let number = |key: &str| joint[key].as_f64().unwrap();
            let ends = [number("lo"), number("hi")].map(|d| (d * number("sign")).to_radians());
            let range = [ends[0].min(ends[1]), ends[0].max(ends[1])];
            sizes.rotary[usize::from(motion.digit()) - 4] = Some(range);
            if motion.digit() > 6 {
                let d: [f64; 3] = serde_json::from_value(joint["dir"].clone()).unwrap();
                sizes.inclined[usize::from(motion.digit()) - 7] = d.into();
            }
        }
        let reach = reach(code.word(), &sizes);
        let near = |a: f64, b: &Value| (a - b.as_f64().unwrap()).abs() < 1e-3;
        assert!(near(reach.cover, &cover["sphere"]), "{code} {reach:?} {cover:?}");
        assert!(near(reach.upper_cover, &cover["half_sphere"]), "{code} {reach:?} {cover:?}");
        checked += 1;
    }
    assert!(checked >= 8);
}
