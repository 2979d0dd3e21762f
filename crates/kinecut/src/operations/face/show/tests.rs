//! Pictures and words of a face against its data.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, dvec2};

use super::edges::bad_edges;
use super::figure_map::{map_picture, objective};
use super::figure_plan::{Wanted, plan_view};
use super::frame::{PictureFrame, edge_path};
use super::motion::{first_met, timed};
use super::strokes::{Kind, strokes};
use super::{Dot, MilledFace, Simulated, face_page, face_section, face_words, looks};
use crate::base::Silent;
use crate::facing::optimum::Options;
use crate::facing::{
    BadSet, FaceCase, FacePlan, FaceSpec, PassesChoice, Placement, PlacementChoice, Tooth, bad_length,
    plan_face,
};
use crate::geom::{Outline, OutlineEdge};
use crate::page::picture::figure;
use crate::page::{Block, Ink, Shape, WIDTH, text};

const RADIUS: f64 = 50.0;
const HOSTILE: &str = "<img src=x>\u{1b}[2J&\u{202e}";

/// A plate with a cut corner and a bore; edges have labels.
fn outline() -> Outline {
    let corners =
        [dvec2(0.0, 0.0), dvec2(90.0, 0.0), dvec2(100.0, 20.0), dvec2(100.0, 60.0), dvec2(0.0, 60.0)];
    let mut plate = Outline::polygon(&corners).unwrap().edges().to_vec();
    plate.iter_mut().for_each(|e| *e = e.labelled(1));
    let bore = vec![OutlineEdge::arc(dvec2(40.0, 25.0), 9.0, 0.3, TAU)];
    Outline::new(vec![plate, bore], vec!["bore".to_owned(), HOSTILE.to_owned()]).unwrap()
}

struct Planned {
    plan: FacePlan,
    options: Options,
    teeth: Vec<Tooth>,
    guard: f64,
}

fn planned(left_hand: bool, placement: PlacementChoice, guard: f64) -> Planned {
    let weights = vec![1.0, 1.0, 1.0, 1.0, 1.0, 3.0];
    let case = FaceCase::new(outline(), RADIUS, BadSet::below(PI / 2.0).unwrap()).unwrap();
    let case = case.with_weights(weights).unwrap();
    let options =
        Options { max_nodes: 200, tolerance: 1e-3, irreducible: false, ..Options::for_cutter(RADIUS) };
    let spec = FaceSpec {
        case,
        left_hand,
        guard,
        options: options.clone(),
        placement,
        passes: PassesChoice::One,
        feed: 10.0,
        rapid: 500.0,
        clearance: 5.0,
        compare: false,
    };
    let (plan, _) = plan_face(&spec, &Silent).unwrap();
    let options = if left_hand { options.mirrored() } else { options };
    let teeth = (0..5).map(|k| Tooth { phase: TAU * f64::from(k) / 5.0, radius: RADIUS }).collect();
    Planned { plan, options, teeth, guard }
}

impl Planned {
    fn view(&self) -> MilledFace<'_> {
        MilledFace {
            title: HOSTILE,
            id: "face-1".to_owned(),
            rule: "below 90 degrees",
            notes: &[],
            plan: &self.plan,
            options: self.options.clone(),
            guard: self.guard,
            teeth: &self.teeth,
            feed: 10.0,
            feed_per_revolution: 1.0,
            rapid: 500.0,
            part_turned: 0.0,
            coordinates_turned: 0.0,
            depths: vec![0.5],
            findings: &[],
            events: &[],
            survey: &[],
            from_drawn: None,
            descents: &[],
            map: None,
        }
    }
}

fn given(angle: f64, offset: f64) -> PlacementChoice {
    PlacementChoice::Given { angle, offset: Some(offset) }
}

#[test]
fn strokes_are_the_whole_outline_and_their_bad_ones_the_bad_length() {
    for left in [false, true] {
        let p = planned(left, given(0.2, 38.0), 0.0);
        let face = p.view();
        let case = &p.plan.case;
        for chains in [None, Some(timed(&face, face.chosen()))] {
            let all = strokes(case, face.chosen(), chains.as_ref());
            let long = |s: &super::strokes::Stroke| (s.to - s.from) * case.outline.edges()[s.edge].length();
            let whole: f64 = all.iter().map(long).sum();
            assert!((whole - outline().perimeter()).abs() < 1e-9, "{whole}");
            let bad = all.iter().filter(|s| s.kind == Kind::Bad).map(|s| long(s) * case.weights[s.edge]);
            let placement = face.chosen().placement().unwrap();
            assert!((bad.sum::<f64>() - bad_length(case, placement)).abs() < 1e-9);
            assert_eq!(all.iter().all(|s| s.met.is_some()), chains.is_some());
        }
    }
}

#[test]
fn bad_edges_lie_on_the_edges_of_the_outline_as_given() {
    for left in [false, true] {
        let p = planned(left, given(0.2, 38.0), 0.0);
        let face = p.view();
        let all = bad_edges(&face, face.chosen());
        assert!(all.len() >= 3, "{all:?}");
        let outline = outline();
        for e in &all {
            for k in 0..2 {
                let on = outline.edges()[e.edge].at(e.shares[k]);
                assert!(on.distance(e.ends[k]) < 1e-9, "{left} {e:?}: {on}");
            }
            assert!((e.length - (e.shares[1] - e.shares[0]) * outline.edges()[e.edge].length()).abs() < 1e-9);
            assert!(e.exit_angles[0] > -1e-6 && e.exit_angles[1] < PI / 2.0 + 1e-6, "{e:?}");
        }
        let counted: f64 = all.iter().map(|e| e.counted).sum();
        assert!((counted - face.chosen().bad).abs() < 1e-9);
    }
}

#[test]
fn the_chip_at_the_far_end_is_the_feed_by_the_cosine_of_the_tooth() {
    // Fed along X with the centre line at 35: above it the far end, X 100 up to Y 60, is left badly.
    let p = planned(false, given(0.0, 35.0), 0.0);
    let face = p.view();
    let all = bad_edges(&face, face.chosen());
    let far = all.iter().find(|e| e.ends.iter().all(|q| (q.x - 100.0).abs() < 1e-9)).unwrap();
    let mut y = far.ends.map(|q| q.y);
    y.sort_by(f64::total_cmp);
    assert!((y[0] - 35.0).abs() < 1e-6 && (y[1] - 60.0).abs() < 1e-6, "{far:?}");
    let chip = |y: f64| 0.2 * (1.0 - ((y - 35.0) / RADIUS).powi(2)).sqrt();
    let expected = y.map(chip);
    let least = expected[0].min(expected[1]);
    assert!((far.chip[0] - least).abs() < 1e-6, "{far:?} {expected:?}");
    assert!(far.chip[1] <= 0.2 + 1e-12 && far.chip[1] >= expected[0].max(expected[1]) - 1e-6);
}

#[test]
fn a_point_is_first_met_when_the_circle_first_reaches_it() {
    let p = planned(true, given(0.2, 38.0), 0.0);
    let face = p.view();
    let chains = timed(&face, face.chosen());
    let all = &chains[0];
    let (from, to) = (all[0], all[all.len() - 1]);
    assert!((to.1 - face.chosen().feed_length / 10.0).abs() < 1e-9);
    for edge in p.plan.case.outline.edges() {
        let point = edge.at(0.37);
        let met = first_met(&chains, point, RADIUS).unwrap();
        let n = 20_000;
        let at = |i: i32| from.0 + (to.0 - from.0) * (f64::from(i) / f64::from(n));
        let step = (0..=n).find(|&i| at(i).distance(point) <= RADIUS).unwrap();
        assert!((met - to.1 * f64::from(step) / f64::from(n)).abs() < to.1 / f64::from(n) + 1e-9);
    }
    assert_eq!(first_met(&chains, dvec2(0.0, 1000.0), RADIUS), None);
}

/// The last point of a path's data.
fn last_point(d: &str) -> [f64; 2] {
    let numbers: Vec<f64> =
        d.split(['M', 'L', 'A', ' ']).filter(|s| !s.is_empty()).map(|s| s.parse().unwrap()).collect();
    [numbers[numbers.len() - 2], numbers[numbers.len() - 1]]
}

#[test]
fn arcs_end_where_they_end_and_bulge_to_their_side() {
    for flip in [false, true] {
        let frame = PictureFrame::turned(0.3, flip);
        for sweep in [0.4, -1.3, 3.0, -TAU] {
            let arc = OutlineEdge::arc(dvec2(10.0, -5.0), 20.0, 0.8, sweep);
            let d = edge_path(&frame, &arc, 0.1, 0.9);
            let (have, want) = (last_point(&d), frame.at(arc.at(0.9)));
            assert!((have[0] - want[0]).abs() < 0.011 && (have[1] - want[1]).abs() < 0.011, "{d}");
            // Of one piece the middle lies on the side that its flag tells: to the right of the chord for 1, y down.
            let piece = d.split('A').nth(1).unwrap();
            let flag: u8 = piece.split(' ').nth(4).unwrap().parse().unwrap();
            let pieces = d.matches('A').count() as f64;
            let to = 0.1 + 0.8 / pieces;
            let [a, m, b] = [0.1, 0.5 * (0.1 + to), to].map(|s| DVec2::from_array(frame.at(arc.at(s))));
            let side = (b - a).perp_dot(m - a);
            assert_eq!(flag == 1, side < 0.0, "{flip} {sweep} {d}");
        }
    }
}

#[test]
fn the_plan_view_has_a_stroke_for_each_bad_stretch_and_escapes_labels() {
    for left in [false, true] {
        let p = planned(left, given(0.2, 38.0), 0.0);
        let face = p.view();
        let wanted = Wanted { teeth: true, ..Wanted::default() };
        let picture = plan_view(&face, face.chosen(), HOSTILE, "plan", &wanted);
        let strokes = |ink: Ink| {
            picture.shapes.iter().filter(|s| matches!(s, Shape::Path { ink: i, .. } if *i == ink)).count()
        };
        assert_eq!(strokes(looks::BAD_EXIT), bad_edges(&face, face.chosen()).len());
        assert!(strokes(looks::ENTRY) > 0 && strokes(looks::GOOD_EXIT) > 0 && strokes(looks::TOOTH) > 1);
        let degrees = picture
            .shapes
            .iter()
            .filter(|s| matches!(s, Shape::Word { text, .. } if text.ends_with('\u{b0}')));
        assert!(degrees.count() > 2);
        let svg = figure(&picture).into_string();
        assert!(
            !svg.contains("NaN") && !svg.contains("inf") && !svg.contains("<img") && !svg.contains('\u{1b}')
        );
        assert!(svg.contains("\u{d7}3 bore") && svg.contains("id=\"face-1-plan\""));
        assert!(svg.len() < 40_000, "{}", svg.len());
    }
}

#[test]
fn an_m4_spindle_shows_the_part_as_it_lies() {
    let p = planned(true, given(0.0, 35.0), 0.0);
    let face = p.view();
    let seen = face.seen(face.chosen().placement().unwrap());
    assert!((seen.angle, seen.offset) == (0.0, 35.0), "{seen:?}");
    // Under M3 the far end is left badly above the centre line; the other way round, below it.
    let all = bad_edges(&face, face.chosen());
    let far = all.iter().find(|e| e.ends.iter().all(|q| (q.x - 100.0).abs() < 1e-9)).unwrap();
    assert!(far.ends.iter().all(|q| q.y <= 35.0 + 1e-6), "{far:?}");
    let picture = plan_view(&face, face.chosen(), "t", "plan", &Wanted::default());
    let svg = figure(&picture).into_string();
    assert!(svg.contains("turned by 0.000\u{b0}, centre line at Y 35.000"), "{svg}");
}

#[test]
fn moving_strokes_come_in_order_and_the_way_in_seconds() {
    let p = planned(false, given(0.2, 38.0), 0.0);
    let face = p.view();
    let wanted = Wanted { moving: true, ..Wanted::default() };
    let picture = plan_view(&face, face.chosen(), "t", "plan", &wanted);
    let motion = picture.motion.clone().unwrap();
    let end = motion.way[motion.way.len() - 1][2];
    assert!((end - face.chosen().feed_length / 10.0).abs() < 1e-9);
    let times =
        picture.shapes.iter().filter_map(|s| if let Shape::Path { from, .. } = s { *from } else { None });
    let times: Vec<f64> = times.collect();
    assert!(times.len() > 250 && times.iter().all(|t| (0.0..=end).contains(t)));
    let svg = figure(&picture).into_string();
    assert_eq!(svg.matches("data-t=").count(), times.len());
    assert!(svg.len() < 80_000, "{}", svg.len());
}

#[test]
fn simulated_exits_stand_beside_the_plan_and_differing_ones_are_told() {
    let p = planned(false, given(0.2, 38.0), 0.0);
    let face = p.view();
    let at = outline().edges()[0].at(0.5);
    let dots = [(1.0, Some(1.0)), (1.0, Some(1.1)), (-0.5, None), (2.0, Some(2.0))];
    let dots = dots.map(|(angle, planned)| Dot { at, angle, planned }).to_vec();
    let simulated = Simulated { dots, chains: timed(&face, face.chosen()), program: [3.0, 60.0] };
    let section = face_section(&face, Some(&simulated), Vec::new());
    let plan = section.blocks.iter().find_map(|b| match b {
        Block::Picture(p) if p.id == "face-1-plan" => Some(p),
        _ => None,
    });
    let plan = plan.unwrap();
    for ink in [looks::SIMULATED_BAD, looks::DIFFERING, looks::SIMULATED_ENTRY, looks::SIMULATED_GOOD] {
        let one = plan.shapes.iter().filter_map(|s| match s {
            Shape::Path { ink: i, d, .. } if *i == ink => Some(d.matches('M').count()),
            _ => None,
        });
        assert_eq!(one.collect::<Vec<_>>(), [1], "{ink:?}");
    }
    assert_eq!(plan.motion.as_ref().unwrap().program, Some([3.0, 60.0]));
}

#[test]
fn the_map_covers_what_is_allowed_and_its_optimum_lies_in_it() {
    for left in [false, true] {
        let p = planned(left, PlacementChoice::LeastBurr, 0.03);
        let face = p.view();
        let map = objective(&face).unwrap();
        let picture = map_picture(&face, &map);
        let [width, height] = picture.size;
        let best = picture.shapes.iter().find_map(|s| match s {
            Shape::Circle { ink: looks::BEST, centre, .. } => Some(*centre),
            _ => None,
        });
        let best = best.unwrap();
        assert!(best[0] > 0.0 && best[0] < width && best[1] > 0.0 && best[1] < height);
        // Under the optimum lies a cell of the lowest shades.
        let under = picture.shapes.iter().find_map(|s| match s {
            Shape::Path { ink: Ink::Step(n), d, .. } if holds(d, best) => Some(*n),
            _ => None,
        });
        assert!(under.unwrap() <= 2, "{left} {under:?} {best:?}");
        let svg = figure(&picture).into_string();
        assert!(!svg.contains("NaN") && svg.len() < 300_000, "{}", svg.len());
    }
}

/// Whether a box of a path "Mx yHxVyHxZ" holds a point, by a pixel.
fn holds(d: &str, p: [f64; 2]) -> bool {
    d.split('M').filter(|b| b.contains('H')).any(|b| {
        let n: Vec<f64> =
            b.split([' ', 'H', 'V', 'Z']).filter(|s| !s.is_empty()).filter_map(|s| s.parse().ok()).collect();
        let (x, y) = ([n[0].min(n[2]), n[0].max(n[2])], [n[1].min(n[3]), n[1].max(n[3])]);
        x[0] - 1.0 <= p[0] && p[0] <= x[1] + 1.0 && y[0] - 1.0 <= p[1] && p[1] <= y[1] + 1.0
    })
}

#[test]
fn the_text_says_what_counts_and_steers_no_terminal() {
    let p = planned(false, PlacementChoice::LeastBurr, 0.03);
    let face = p.view();
    let text = text(&[face_words(&face)], WIDTH);
    let optimum = p.plan.optimum.as_ref().unwrap();
    for part in [
        "Below 90 degrees; optimised with a guard: angles within 1.719 degrees".to_owned(),
        format!("found {:.4} mm", optimum.value),
        format!("than {:.4} mm", optimum.lower_bound),
        "bore \u{d7} 3 (56.549 mm)".to_owned(),
        "6 edges (1 circular) in 2 loops, 1 of them outer".to_owned(),
        "0.2 mm/tooth, 1 mm/rev, 600.0".to_owned(),
    ] {
        let flat = text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(flat.contains(&part), "{part}\n{text}");
    }
    assert!(text.lines().all(|l| l.chars().count() <= 130), "{text}");
    assert!(text.chars().all(|c| c == '\n' || !c.is_control()));
}

#[test]
fn of_another_way_the_best_straight_pass_is_drawn_too() {
    let mut p = planned(false, PlacementChoice::LeastBurr, 0.0);
    p.plan.ways[0].angle = None;
    p.plan.ways[0].offset = None;
    let section = face_section(&p.view(), None, Vec::new());
    let ids: Vec<&str> = section
        .blocks
        .iter()
        .filter_map(|b| if let Block::Picture(p) = b { Some(p.id.as_str()) } else { None })
        .collect();
    assert_eq!(ids, ["face-1-plan", "face-1-before", "face-1-straight", "face-1-map"]);
}

#[test]
fn turns_are_said_from_0_to_360() {
    use super::tables::turn;
    for (angle, said) in [(0.0, 0.0), (-1e-12, 0.0), (-PI / 2.0, 270.0), (5.0 * PI, 180.0)] {
        assert!((turn(angle) - said).abs() < 1e-9, "{angle}");
    }
    let p = planned(false, given(-0.3, 20.0), 0.0);
    let seen = p.view().seen(Placement { angle: 1.0, offset: 2.0 });
    assert_eq!((seen.angle, seen.offset), (1.0, 2.0));
}

#[test]
fn the_page_runs_its_script_only_and_lets_nothing_out() {
    use base64::Engine as _;
    use sha2::Digest as _;
    let (a, b) =
        (planned(false, PlacementChoice::LeastBurr, 0.0), planned(true, PlacementChoice::AsDrawn, 0.0));
    let second = MilledFace { id: "face-2".to_owned(), ..b.view() };
    let page = face_page(&[a.view(), second]);
    let script = page.split("<script>").nth(1).unwrap().split("</script>").next().unwrap();
    let hash = base64::engine::general_purpose::STANDARD.encode(sha2::Sha256::digest(script.as_bytes()));
    assert!(page.contains(&format!("script-src 'sha256-{hash}'")));
    assert_eq!(page.matches("<script").count(), 1);
    for word in ["<img", "http://", "https://", "NaN", "\u{1b}", "\u{202e}"] {
        assert!(!page.contains(word), "{word}");
    }
    let mut ids: Vec<&str> = page.split(" id=\"").skip(1).map(|s| s.split('"').next().unwrap()).collect();
    let count = ids.len();
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), count, "names of pictures are unique");
    assert!(ids.contains(&"face-1-before") && !ids.contains(&"face-2-before"), "{ids:?}");
}
