//! Writing and reading are inverse, on random programs; spatial angles are those of the plane.

use super::*;
use proptest::prelude::*;

/// What a move does, in the coordinates of the work offset.
#[derive(Debug)]
enum Does {
    /// The tip, rotary axes as far as they are known, a direction.
    Tip(DVec3, [Option<f64>; 3], Option<DVec3>, Tcp),
    Joints([Option<f64>; 6]),
    Orient(DVec3, Option<RotarySolution>),
    /// Where, and the heights of a hole in the plane or the work offset.
    Drill(DVec3, [f64; 3]),
}

/// What a program does, move by move.
fn does(program: &Program) -> Vec<Does> {
    let mut rotary = [None; 3];
    let mut at = DVec3::NAN;
    let mut frame = FrameId(u32::MAX);
    let mut out = Vec::new();
    for i in 0..program.items.len() {
        let state = program.state(i);
        if state.frame != frame {
            (frame, at) = (state.frame, DVec3::NAN);
        }
        let (motion, branch) = match program.in_tilted(frame) {
            Some((_, motion, branch)) => (motion, Some(branch)),
            None => (program.in_work(frame).unwrap().1, None),
        };
        match program.items.get(i) {
            Item::Move(Move { end: Target::Tip { point, axis }, .. }) => {
                at = DVec3::from_array([0, 1, 2].map(|k| if point[k].is_nan() { at[k] } else { point[k] }));
                let mut vector = None;
                match axis {
                    ToolAxis::Rotary(said) => (0..3).for_each(|k| rotary[k] = said[k].or(rotary[k])),
                    ToolAxis::Vector(v) => (rotary, vector) = ([None; 3], Some(motion.rotation * v)),
                    _ => {}
                }
                out.push(Does::Tip(motion.point(at), rotary, vector, state.tcp));
            }
            Item::Move(Move { end: Target::Joints(joints), .. }) => {
                (0..3).for_each(|k| rotary[k] = joints[k + 3].or(rotary[k]));
                at = DVec3::NAN;
                out.push(Does::Joints(joints));
            }
            Item::Move(Move { end: Target::Orient, .. }) => {
                (rotary, at) = ([None; 3], DVec3::NAN);
                out.push(Does::Orient(motion.rotation * DVec3::Z, branch));
            }
            Item::Cycle(cycle, steps) => {
                let Cycle::Drill { reference, bottom, retract, .. } = *cycle else { panic!("{cycle:?}") };
                let raise = if branch.is_none() { motion.translation.z } else { 0.0 };
                out.push(Does::Drill(motion.point(at), [reference, bottom, retract].map(|h| h + raise)));
                if let Some(kinecut::program::CycleStep::Rapid(height)) = steps.last() {
                    at.z = *height;
                }
            }
            _ => {}
        }
    }
    out
}

/// Largest distance of two points that are one: half a step of the coordinates, and what is said of the angles.
fn near(a: DVec3, b: DVec3, rounding: f64) -> bool {
    (a - b).length() <= 3f64.sqrt() * rounding + 1e-9
}

fn angles_near<const N: usize>(a: &[Option<f64>; N], b: &[Option<f64>; N], tolerance: f64) -> bool {
    a.iter().zip(b).all(|(a, b)| match (a, b) {
        (Some(a), Some(b)) => (a - b).abs() <= tolerance,
        (None, None) => true,
        _ => false,
    })
}

/// Half a step of four decimals of a degree.
const HALF_STEP: f64 = 0.5e-4 * std::f64::consts::PI / 180.0 + 1e-12;

fn alike(a: &Does, b: &Does, rounding: f64) -> bool {
    match (a, b) {
        (Does::Tip(p, r, v, t), Does::Tip(q, s, w, u)) => {
            let directions = match (v, w) {
                (Some(v), Some(w)) => (*v - *w).length() < 2e-8,
                (None, None) => true,
                _ => false,
            };
            near(*p, *q, rounding) && angles_near(r, s, HALF_STEP) && directions && t == u
        }
        (Does::Joints(a), Does::Joints(b)) => {
            angles_near(a.first_chunk::<3>().unwrap(), b.first_chunk::<3>().unwrap(), 1e-4)
                && angles_near(a.last_chunk::<3>().unwrap(), b.last_chunk::<3>().unwrap(), HALF_STEP)
        }
        (Does::Orient(z, b), Does::Orient(y, c)) => (*z - *y).length() < 4e-6 && b == c,
        (Does::Drill(p, c), Does::Drill(q, d)) => {
            near(*p, *q, rounding) && c.iter().zip(d).all(|(c, d)| (c - d).abs() < 1e-9)
        }
        _ => false,
    }
}

/// One thing a program does next.
#[derive(Clone, Debug)]
enum Step {
    Plain([f64; 3], bool),
    Rotary([f64; 3], [Option<f64>; 3], bool),
    Vector([f64; 3], [f64; 3]),
    Tcp(Tcp),
    Joints([Option<f64>; 6]),
    Shift([f64; 3], f64),
    Plane([f64; 3], f64, [f64; 3], u8),
    Orient,
    Back,
    Drill,
    Tool,
}

fn steps() -> impl Strategy<Value = Step> {
    let place = || prop::array::uniform3((-200_000i32..200_000).prop_map(|v| f64::from(v) / 1000.0));
    let angle = || prop::option::of((-3_600_000i32..3_600_000).prop_map(|v| f64::from(v) / 1e4));
    let joint = || prop::option::of((-5_000i32..5_000).prop_map(|v| f64::from(v) / 100.0));
    let unit = || {
        prop::array::uniform3(-1.0..1.0f64)
            .prop_filter("a direction", |v| DVec3::from_array(*v).length() > 0.1)
    };
    prop_oneof![
        3 => (place(), any::<bool>()).prop_map(|(p, f)| Step::Plain(p, f)),
        4 => (place(), prop::array::uniform3(angle()), any::<bool>()).prop_map(|(p, a, f)| Step::Rotary(p, a, f)),
        2 => (place(), unit()).prop_map(|(p, v)| Step::Vector(p, v)),
        3 => prop_oneof![Just(Tcp::Off), Just(Tcp::Axes), Just(Tcp::Vector)].prop_map(Step::Tcp),
        1 => (prop::array::uniform3(joint()), prop::array::uniform3(angle())).prop_map(|([x, y, z], [a, b, c])| {
            Step::Joints([x, y, z, a.map(f64::to_radians), b.map(f64::to_radians), c.map(f64::to_radians)])
        }),
        1 => (place(), -180.0..180.0f64).prop_map(|(p, a)| Step::Shift(p, (a * 10.0).round() / 10.0)),
        3 => (unit(), -180.0..180.0f64, place(), 0u8..3).prop_map(|(v, a, p, b)| Step::Plane(v, a, p, b)),
        2 => Just(Step::Orient),
        2 => Just(Step::Back),
        1 => Just(Step::Drill),
        1 => Just(Step::Tool),
    ]
}

/// The program of these steps, as far as the control can say them.
fn build(steps: &[Step]) -> Builder {
    let mut b = Builder::new();
    b.line(0.0, 0.0, 100.0, RAPID);
    let mut tool = 4;
    // Whether the tip is where the program has said it, in the coordinates in force.
    let mut known = true;
    for step in steps {
        let in_plane = b.program.in_tilted(b.state.frame).is_some();
        let speed = |feed: bool| if feed && known { FEED } else { RAPID };
        match *step {
            Step::Plain([x, y, z], feed) => {
                b.tip(x, y, z, degrees([None; 3]), speed(feed));
                known = true;
            }
            Step::Rotary([x, y, z], angles, feed) if !in_plane => {
                b.tip(x, y, z, degrees(angles), speed(feed));
                known = true;
            }
            Step::Vector([x, y, z], v) if !in_plane && b.state.tcp != Tcp::Off => {
                let axis = ToolAxis::Vector(DVec3::from_array(v).try_normalize().unwrap());
                b.tip(x, y, z, axis, speed(true));
                known = true;
            }
            Step::Tcp(tcp) if !in_plane => {
                known &= b.state.tcp == tcp;
                b.state.tcp = tcp;
            }
            Step::Joints(joints) if joints.iter().any(Option::is_some) => {
                b.to(Target::Joints(joints), RAPID);
                known = false;
            }
            Step::Shift(to, angle) => {
                b.work();
                let parent = b.state.frame;
                let motion = Rigid { rotation: about(DVec3::Z, angle), translation: DVec3::from_array(to) };
                b.state.frame = b.program.add_frame(Frame::Shift { parent, motion });
                known = false;
            }
            Step::Plane(axis, angle, to, branch) => {
                let branch = [RotarySolution::Free, RotarySolution::Positive, RotarySolution::Negative]
                    [usize::from(branch)];
                b.state.tcp = Tcp::Off;
                b.tilt(
                    about(DVec3::from_array(axis).try_normalize().unwrap(), angle),
                    DVec3::from_array(to),
                    branch,
                );
                known = false;
            }
            Step::Orient => {
                b.state.tcp = Tcp::Off;
                b.to(Target::Orient, RAPID);
                known = false;
            }
            Step::Back => {
                b.work();
                known = false;
            }
            Step::Drill if known => {
                b.state.speed = FEED;
                b.program.push_cycle(drill(), &b.state, Origin::default()).unwrap();
            }
            Step::Tool => {
                tool += 1;
                b.program.push_tool(ToolNumber(tool), Some(1), Some(1), &b.state, Origin::default());
                known = false;
            }
            _ => {}
        }
    }
    b
}

proptest! {
    #![proptest_config(kinecut_cases::property(400))]

    #[test]
    fn writing_and_reading_are_inverse(steps in prop::collection::vec(steps(), 1..25)) {
        let b = build(&steps);
        let posted = b.post().unwrap();
        let read = read_text(&posted.text);
        prop_assert!(read.findings.is_empty(), "{:?}\n{}", read.findings, posted.text);
        let (planned, found) = (does(&b.program), does(&read.program));
        // A move to where the tool is already leaves no block.
        let mut next = found.iter();
        for (index, does) in planned.iter().enumerate() {
            let stays = matches!(does, Does::Tip(..)) && index > 0 && alike(does, &planned[index - 1], 0.0);
            if stays {
                continue;
            }
            let back = next.next();
            prop_assert!(back.is_some_and(|b| alike(does, b, posted.notes.rounding + posted.notes.tilt)), "{does:?} {back:?}\n{}", posted.text);
        }
        prop_assert!(next.next().is_none(), "{}", posted.text);
        // What is read is written with the same words.
        let again = Builder { program: read.program, state: b.state }.post().unwrap();
        let lines = |text: &str| text.lines().filter(|l| !l.starts_with(';')).map(str::to_owned).collect::<Vec<_>>();
        let (first, second) = (lines(&posted.text), lines(&again.text));
        prop_assert_eq!(first.len(), second.len());
        for (a, b) in first.iter().zip(&second) {
            prop_assert!(a.split(' ').count() == b.split(' ').count() && a.split(' ').zip(b.split(' ')).all(same_word), "{a}\n{b}");
        }
    }

    /// The angles of any plane, those near SPB = +-90 deg too, are within their rounding of the plane that was meant.
    #[test]
    fn spatial_angles_are_those_of_the_plane(
        a in -180.0..180.0f64,
        b in prop_oneof![3 => -180.0..180.0f64, 1 => Just(90.0), 1 => Just(-90.0), 2 => -1e-3..1e-3f64, 2 => 89.9999..90.0001f64],
        c in -180.0..180.0f64,
    ) {
        let wanted = about(DVec3::Z, c) * about(DVec3::Y, b) * about(DVec3::X, a);
        let found = written_plane(&wanted);
        // Three angles, half a step each.
        prop_assert!(same_rotation(&found, &wanted, 3.0 * HALF_STEP), "{found:?} {wanted:?}");
    }
}

/// Whether words are equal; the last digit of a direction may be another, since reading makes it a unit vector.
fn same_word((a, b): (&str, &str)) -> bool {
    let number =
        |word: &str| word.strip_prefix('T').and_then(|w| w.get(1..)).and_then(|w| w.parse::<f64>().ok());
    a == b || number(a).zip(number(b)).is_some_and(|(v, w)| a[..2] == b[..2] && (v - w).abs() < 1.5e-8)
}

/// The rotation of the angles in the text, by Rodrigues' formula.
fn written_plane(rotation: &DMat3) -> DMat3 {
    let mut b = Builder::new();
    b.tilt(*rotation, DVec3::ZERO, RotarySolution::Free);
    b.to(Target::Orient, RAPID);
    let text = b.post().unwrap().text;
    let line = text.lines().find(|l| l.starts_with("PLANE SPATIAL")).unwrap();
    let angle = |name: &str| -> f64 {
        line.split(' ').skip(2).find_map(|w| w.strip_prefix(name)).unwrap().parse().unwrap()
    };
    about(DVec3::Z, angle("SPC")) * about(DVec3::Y, angle("SPB")) * about(DVec3::X, angle("SPA"))
}

#[test]
fn planes_that_lie_along_the_axes_have_whole_angles() {
    // All 24 of them: each in its text again, to the last bit.
    let mut count = 0;
    for z in [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z] {
        for x in [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z] {
            if x.dot(z) != 0.0 {
                continue;
            }
            count += 1;
            let wanted = DMat3::from_cols(x, z.cross(x), z);
            let mut b = Builder::new();
            b.tilt(wanted, DVec3::ZERO, RotarySolution::Free);
            b.to(Target::Orient, RAPID);
            let program = read_text(&b.post().unwrap().text).program;
            let (motion, _) = tilted(&program, &moves(&program)[0].1);
            assert_eq!(motion.rotation, wanted);
            assert!(same_rotation(&written_plane(&wanted), &wanted, 1e-15));
        }
    }
    assert_eq!(count, 24);
}
