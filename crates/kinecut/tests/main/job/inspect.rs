//! Sections and points of a cut part against closed forms.

use crate::common::random::Random;
use glam::{DVec2, DVec3};
use kinecut::base::{Code, Silent};
use kinecut::job::inspect::{CutBy, Place};
use kinecut::job::{
    GivenFile, GivenJob, GivenStock, InspectWants, Inspection, Outcome, PartSurface, ProgramWants,
    StockWants, given_alone, report, simulate_given,
};

/// A slot 8 mm wide and 3 mm deep along X at Y 15, and a drilled hole through the block at X 30, Y 5.
const PROGRAM: &str = "G21 G90 G17\nT1 M6\nS8000 M3\nG0 X-10 Y15\nG0 Z5\nG1 Z-3 F500\nG1 X50\nG0 Z20\n\
                       T2 M6\nS8000 M3\nG0 X30 Y5\nG0 Z5\nG1 Z-14 F200\nG0 Z20\nM2\n";
const TOOLS: &str = "[[tool]]\nnumber = 1\ntype = \"end-mill\"\ndiameter = 8.0\nflute_length = 20.0\nstickout = 40.0\n\
                     [[tool]]\nnumber = 2\ntype = \"end-mill\"\ndiameter = 4.0\nflute_length = 20.0\nstickout = 40.0\n";

fn outcome() -> Outcome {
    cut(PROGRAM, TOOLS, None)
}

fn cut(program: &str, tools: &str, step: Option<f64>) -> Outcome {
    simulate_given(given(program, tools, step), &Silent).unwrap()
}

fn given(program: &str, tools: &str, step: Option<f64>) -> GivenJob {
    let program = GivenFile { name: "P.ngc", bytes: program.as_bytes() };
    let wants = ProgramWants {
        step,
        stock: Some(GivenStock::Block([0.0, 0.0, -10.0, 40.0, 30.0, 0.0])),
        tools: Some(("tools.toml".to_owned(), tools.to_owned())),
        ..ProgramWants::default()
    };
    given_alone(program, &wants, true).unwrap()
}

fn near(value: f64, wanted: f64, within: f64) {
    assert!((value - wanted).abs() <= within, "{value} is not {wanted} within {within}");
}

#[test]
fn sections_have_the_areas_and_edges_of_slot_and_hole() {
    let sections = ["z=-1", "z=-5", "x=10", "y=5", "z=-3", "z=7", "z=-5.0"].map(|p| p.parse().unwrap());
    let wants = InspectWants { sections: sections.to_vec(), ..InspectWants::default() };
    let seen = Inspection::of(&outcome(), &wants).unwrap().unwrap();
    // The same plane in another spelling is shown once.
    assert_eq!(seen.sections.len(), 6);
    let hole = std::f64::consts::PI * 4.0;
    let off = seen.within;
    let around = 4.0 * std::f64::consts::PI;
    let areas = [1200.0 - 320.0 - hole, 1200.0 - hole, 300.0 - 24.0, 400.0 - 40.0, 1200.0 - hole, 0.0];
    for (section, area) in seen.sections.iter().zip(areas) {
        near(section.area, area, section.area_bound);
        // Of no use if it were wide.
        assert!(section.area_bound <= 260.0 * off, "{section:?}");
        assert_eq!(section.file.is_some(), area > 0.0);
    }
    let [cut, whole, across, ..] = seen.sections.as_slice() else { panic!("{seen:?}") };
    assert_eq!(cut.outlines.iter().map(|o| o.hole).collect::<Vec<_>>(), [false, false, true]);
    assert_eq!((whole.outlines.len(), whole.file.as_deref()), (2, Some("section-z-5.svg")));
    near(whole.outlines[1].high[0], 32.0, off);
    near(whole.outlines[1].length, around, 4.0 * off);
    near(across.outlines[0].length, 2.0 * (30.0 + 10.0) + 2.0 * 3.0, off);
    // Corners of flat faces only: eight of them.
    assert_eq!(across.outlines[0].points.len(), 8, "{:?}", across.outlines[0].points);
    let pictures: Vec<_> = seen.pictures().collect();
    assert_eq!(pictures.len(), 5);
    // Seen along X: Y to the right, Z upwards; along Y: X to the right, Z upwards.
    for (i, shown) in [
        (2, "width=\"32mm\" height=\"12mm\" viewBox=\"-1 -1 32 12\""),
        (3, "width=\"42mm\" height=\"12mm\" viewBox=\"-1 -1 42 12\""),
    ] {
        assert!(pictures[i].1.contains(shown), "{}", pictures[i].1);
    }
}

#[test]
fn points_know_the_surfaces_about_them_and_the_lines_that_cut_them() {
    let points =
        [[10.0, 15.0, -1.0], [10.0, 15.0, -5.0], [30.0, 5.0, -5.0], [5.0, 5.0, 0.0], [5.0, 15.0, -3.0]];
    let wants = InspectWants { points: points.map(Into::into).to_vec(), ..InspectWants::default() };
    let outcome = outcome();
    let seen = Inspection::of(&outcome, &wants).unwrap().unwrap();
    let places: Vec<Place> = seen.points.iter().map(|p| p.place).collect();
    assert_eq!(places, [Place::Outside, Place::Material, Place::Outside, Place::Surface, Place::Surface]);
    let off = seen.within;
    let line = |n: u32| CutBy::Line { program: "P.ngc".to_owned(), line: n, of_all: n - 1 };
    let all = [
        // In the slot: floor and walls, open above and to the ends.
        vec![("nearest", 2.0, line(7)), ("-Y", 4.0, line(7)), ("+Y", 4.0, line(7)), ("-Z", 2.0, line(7))],
        // Under it.
        vec![
            ("nearest", 2.0, line(7)),
            ("-X", 10.0, CutBy::RawStock),
            ("+X", 30.0, CutBy::RawStock),
            ("-Y", 15.0, CutBy::RawStock),
            ("+Y", 15.0, CutBy::RawStock),
            ("-Z", 5.0, CutBy::RawStock),
            ("+Z", 2.0, line(7)),
        ],
        // In the hole: its wall on four sides, nothing below or above.
        ["nearest", "-X", "+X", "-Y", "+Y"].map(|towards| (towards, 2.0, line(13))).to_vec(),
    ];
    for (point, wanted) in seen.points.iter().zip(all) {
        assert_eq!(point.surfaces.len(), wanted.len(), "{point:?}");
        for (surface, (towards, distance, by)) in point.surfaces.iter().zip(wanted) {
            assert_eq!((surface.towards, &surface.cut_by), (towards, &by), "{point:?}");
            near(surface.distance, distance, off);
        }
    }
    assert!(seen.to_json().contains("\"line\": 13"), "{}", seen.to_json());
    assert!(Inspection::of(&outcome, &InspectWants::default()).unwrap().is_none());
}

#[test]
fn distances_tell_webs_and_slots_between_two_points_and_the_lines_that_cut_them() {
    let outcome = outcome();
    let line = |n: u32| Some(CutBy::Line { program: "P.ngc".to_owned(), line: n, of_all: n - 1 });
    let stock = || Some(CutBy::RawStock);
    // Across the slot from outside to outside; through the hole at an angle, and out of the bottom; in the slot; beside the part.
    let along = 5f64.sqrt();
    type Wanted = Vec<(bool, f64, Option<CutBy>)>;
    let cases: [([[f64; 3]; 2], Wanted); 4] = [
        (
            [[10.0, -5.0, -1.0], [10.0, 40.0, -1.0]],
            vec![
                (false, 5.0, stock()),
                (true, 11.0, line(7)),
                (false, 8.0, line(7)),
                (true, 11.0, stock()),
                (false, 10.0, None),
            ],
        ),
        (
            [[25.0, 5.0, -4.0], [41.0, 5.0, -12.0]],
            vec![
                (true, 1.5 * along, line(13)),
                (false, 2.0 * along, line(13)),
                (true, 2.5 * along, stock()),
                (false, 2.0 * along, None),
            ],
        ),
        ([[5.0, 13.0, -2.0], [35.0, 17.0, -0.5]], vec![(false, 916f64.sqrt().hypot(1.5), None)]),
        ([[-5.0, -5.0, 3.0], [-5.0, 30.0, 3.0]], vec![(false, 35.0, None)]),
    ];
    let measures = cases.iter().map(|(ends, _)| ends.map(DVec3::from_array)).collect();
    let seen =
        Inspection::of(&outcome, &InspectWants { measures, ..InspectWants::default() }).unwrap().unwrap();
    for (measure, (ends, wanted)) in seen.measures.iter().zip(&cases) {
        near(measure.distance, DVec3::from_array(ends[0]).distance(ends[1].into()), 1e-12);
        assert_eq!(measure.stretches.len(), wanted.len(), "{measure:?}");
        let mut sum = 0.0;
        for (stretch, (material, length, by)) in measure.stretches.iter().zip(wanted) {
            assert_eq!((stretch.material, &stretch.cut_by), (*material, by), "{measure:?}");
            let within = stretch.within.unwrap();
            near(stretch.length, *length, within + 1e-12);
            // Of no use if it were wide: at 63 degrees from the surface and both ends on it.
            assert!(within <= 2.0 * 2.3 * seen.within, "{measure:?}");
            sum += stretch.length;
            let from = DVec3::from_array(measure.from);
            near(from.distance(stretch.end.into()), sum, 1e-9);
        }
        near(sum, measure.distance, 1e-9);
    }
    let text = seen.to_json();
    assert!(text.contains("\"material\": true") && text.contains("\"cut_by\": null"), "{text}");
}

/// Distance of a point from the upright body that a tool sweeps along a line: of radius `r` about the segment seen from above, with a
/// round or flat end at the height `z`, open above.
fn from_sweep(p: DVec3, [from, to]: [DVec2; 2], r: f64, z: f64, is_round: bool) -> f64 {
    let (q, along) = (p.truncate() - from, to - from);
    let share = (q.dot(along) / along.length_squared().max(1e-300)).clamp(0.0, 1.0);
    let aside = q.distance(along * share);
    match is_round {
        true => aside.hypot((p.z - z - r).min(0.0)) - r,
        false => (aside - r).max(0.0).hypot((z - p.z).max(0.0)),
    }
}

#[test]
fn distances_in_a_coarse_part_are_within_what_is_said() {
    let groove = "T3 M6\nS8000 M3\nG0 X-10 Y25\nG0 Z5\nG1 Z-2 F500\nG1 X50\nG0 Z20\nM2\n";
    let program = PROGRAM.replace("M2\n", groove);
    let ball =
        "[[tool]]\nnumber = 3\ntype = \"ball-nose\"\ndiameter = 6.0\nflute_length = 20.0\nstickout = 40.0\n";
    let outcome = cut(&program, &format!("{TOOLS}{ball}"), Some(0.5));
    let (low, high) = (DVec3::new(0.0, 0.0, -10.0), DVec3::new(40.0, 30.0, 0.0));
    let mut random = Random(5);
    let mut points = Vec::new();
    for _ in 0..4000 {
        points.push(low + DVec3::from_array([0; 3].map(|_| random.share())) * (high - low));
    }
    let wants = InspectWants { points, ..InspectWants::default() };
    let seen = Inspection::of(&outcome, &wants).unwrap().unwrap();
    assert!(seen.within < 0.05, "{}", seen.within);
    let (mut inside, mut farthest) = (0, 0.0f64);
    for point in &seen.points {
        let p = DVec3::from_array(point.at);
        let line = |y| [DVec2::new(-10.0, y), DVec2::new(50.0, y)];
        let hole = [DVec2::new(30.0, 5.0); 2];
        // From inside the nearest place is on a face of the block, or on one of the bodies taken out.
        let faces = (p - low).min(high - p).min_element();
        let exact = faces
            .min(from_sweep(p, line(15.0), 4.0, -3.0, false))
            .min(from_sweep(p, hole, 2.0, -14.0, false))
            .min(from_sweep(p, line(25.0), 3.0, -2.0, true));
        if exact > seen.within {
            assert!(point.place == Place::Material || exact < 2.0 * seen.within, "{point:?} {exact}");
            if point.place == Place::Material {
                inside += 1;
                farthest = farthest.max((point.surfaces[0].distance - exact).abs());
            }
        } else if exact < -seen.within {
            assert_ne!(point.place, Place::Material, "{point:?} {exact}");
        }
    }
    assert!(inside > 2000 && farthest <= seen.within, "{inside} {farthest}");
}

#[test]
fn planes_that_are_none_are_refused() {
    for text in ["", "z", "q=1", "z=", "z=NaN", "z=1e999", "z=1=2"] {
        let error = text.parse::<kinecut::job::SectionPlane>().unwrap_err();
        assert_eq!(error.code(), Code::JOB_VALUE);
        assert!(error.0.help.contains("z=-5"), "{error}");
    }
    assert_eq!("z=-0".parse::<kinecut::job::SectionPlane>().unwrap().to_string(), "Z 0");
}

#[test]
fn without_a_surface_the_verdict_is_the_same_and_what_needs_one_says_so() {
    // With a rapid that stays in the slot, and one that runs into its wall.
    let into_wall = PROGRAM.replace("X50\nG0 Z20\nT2", "X50\nX20\nG0 Y16\nG0 Z20\nT2");
    for (program, meets) in [(PROGRAM, false), (&into_wall, true)] {
        let whole = cut(program, TOOLS, Some(0.2));
        let mut alone = given(program, TOOLS, Some(0.2));
        alone.simulated(&StockWants { surface: PartSurface::None, ..StockWants::default() }).unwrap();
        let lines = simulate_given(alone, &Silent).unwrap();
        assert!(lines.part.triangles.is_empty() && !whole.part.triangles.is_empty());
        assert!(lines.verdict.to_json() == whole.verdict.to_json());
        assert_eq!(lines.verdict.found.iter().any(|f| f.code == Code::RAPID_IN_STOCK), meets);
        let exact = 40.0 * 8.0 * 3.0 + std::f64::consts::PI * 4.0 * 10.0;
        for removed in [lines.removed, whole.removed] {
            // The rapid takes some of the wall with it.
            let more = if meets { 30.0 } else { 0.0 };
            assert!((-removed.bound..removed.bound + more).contains(&(removed.value - exact)), "{removed:?}");
        }
        assert!(whole.removed.bound < lines.removed.bound && lines.removed.bound < 0.1 * exact);
        let wants = InspectWants { sections: vec!["z=-1".parse().unwrap()], ..InspectWants::default() };
        assert_eq!(Inspection::of(&lines, &wants).unwrap_err().code(), Code::GEOMETRY);
        assert!(report::of_job(&lines).part.is_none() && report::of_job(&whole).part.is_some());
    }
}
