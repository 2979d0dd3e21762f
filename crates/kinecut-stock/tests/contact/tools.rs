//! Tools past standing bodies.

use glam::DVec3;
use kinecut_stock::base::Silent;
use kinecut_stock::contact::{Body, MovingTool, ToolPart, Watched, meetings};
use kinecut_stock::geom::{Arc, Line, Profile, Rigid, Solid};
use kinecut_stock::machine::kinematics::Twist;
use kinecut_stock::sweep::ToolMotion;

use crate::judge::{Random, Shown, apart, body, meets, tool, wedge};

/// A move of three axes, of five, or of a screw.
fn motion(random: &mut Random) -> ToolMotion {
    let start = random.point(40.0);
    let axis = DVec3::new(random.between(-1.0, 1.0), random.between(-1.0, 1.0), 1.5).normalize_or_zero();
    match (random.next() * 4.0) as u32 {
        0 => {
            let end = start + random.point(60.0);
            ToolMotion::fixed(Line { start, end }.into(), DVec3::Z).expect("a case of these numbers")
        }
        1 => {
            let centre = start + random.point(30.0).with_z(0.0);
            let arc = Arc::new(start, centre, DVec3::Z, random.between(-7.0, 7.0), random.between(-9.0, 9.0));
            ToolMotion::fixed(arc.expect("a case of these numbers").into(), axis)
                .expect("a case of these numbers")
        }
        2 => {
            let end = start + random.point(50.0);
            let to = (axis + random.point(0.8)).normalize_or_zero();
            ToolMotion::between(Line { start, end }.into(), axis, to).expect("a case of these numbers")
        }
        _ => {
            let start = Rigid { rotation: random.turn(), translation: start };
            ToolMotion::screw(start, Twist { turn: random.point(0.6), shift: random.point(40.0) })
                .expect("a case of these numbers")
        }
    }
}

/// A move as the judge sees it.
struct Judge<'a> {
    motion: &'a ToolMotion,
    tool: &'a [Shown],
    body: &'a Shown,
    /// No point of the tool is faster than this [mm by `t`].
    speed: f64,
}

impl Judge<'_> {
    fn distance(&self, t: f64) -> f64 {
        let at = self.motion.pose(t);
        let one = |shown: &Shown| apart((shown, &at), (self.body, &Rigid::IDENTITY));
        self.tool.iter().map(one).fold(f64::INFINITY, f64::min)
    }

    /// The first time from `t` on, in a direction, at which the distance is `touch` or less, and the least distance up to there.
    fn meets(&self, t: f64, direction: f64, touch: f64) -> (Option<f64>, f64) {
        meets(|t| self.distance(t), self.speed, t, direction, touch)
    }
}

/// Speeds do not change much in these moves: the largest of many, with room.
fn speed(motion: &ToolMotion, reach: f64) -> f64 {
    1.1 * (0..=50).map(|i| motion.speed(f64::from(i) / 50.0, reach)).fold(0.0, f64::max)
}

#[test]
fn contacts_and_near_misses_are_those_of_another_library() {
    const NEAR: f64 = 0.5;
    let mut random = Random(7);
    let (mut contacts, mut misses, mut clear) = (0, 0, 0);
    while contacts < 300 || misses < 200 {
        let (moving, shown, reach) = tool(&mut random);
        let motion = motion(&mut random);
        let at =
            motion.pose(random.next()).point(DVec3::Z * random.between(-10.0, 90.0)) + random.point(60.0);
        let (solid, place, mut judged) = body(&mut random, at);
        let speed = speed(&motion, reach);
        let judge = |body: &Shown, touch: f64, from: f64, way: f64| {
            Judge { motion: &motion, tool: &shown, body, speed }.meets(from, way, touch)
        };
        let (met, least) = judge(&judged, 1e-4, 0.0, 1.0);
        let watched = [Watched { motion: motion.clone(), tool: 0 }];
        let find_off = |by: DVec3, off: f64| {
            let place = Rigid { translation: place.translation + by, ..place };
            let standing = [Body::new("clamp", &solid, place, NEAR).unwrap().off_by(off)];
            meetings(std::slice::from_ref(&moving), &standing, &watched, DVec3::Z, &Silent).unwrap()
        };
        let find = |by: DVec3| find_off(by, 0.0);
        if let Some(first) = met {
            // A mesh of the judge has no inside: a tool that begins within is no case for it.
            if judged.shape.as_trimesh().is_some() && least == 0.0 && first == 0.0 {
                continue;
            }
            let found = find(DVec3::ZERO);
            let touched: Vec<_> = found.iter().filter_map(|m| m.contact).collect();
            assert!(
                !touched.is_empty(),
                "a contact at {first} is not found: {judged_place:?}",
                judged_place = judged.place
            );
            let from = touched.iter().map(|c| c.from).fold(1.0, f64::min);
            let to = touched.iter().map(|c| c.to).fold(0.0, f64::max);
            let last = judge(&judged, 1e-4, 1.0, -1.0).0.unwrap();
            // A tool that comes near slowly touches within a hundredth of a millimetre long before: then that is what counts.
            let [sooner, later] =
                [judge(&judged, 0.01, 0.0, 1.0).0.unwrap(), judge(&judged, 0.01, 1.0, -1.0).0.unwrap()];
            let room = 0.01 / speed;
            assert!(from <= first + room && from >= sooner - room, "{from} {first} {sooner} {}", room);
            assert!(to >= last - room && to <= later + room, "{to} {last} {later} {}", room);
            contacts += 1;
            // Lifted by that much, and no less, it clears.
            if contacts % 10 == 0 {
                let lift = touched[0].clears_by.unwrap();
                assert!(touched.iter().all(|c| c.clears_by == Some(lift)));
                let lower = |by: f64| {
                    let place =
                        Rigid { translation: judged.place.translation - DVec3::Z * by, ..judged.place };
                    Shown { shape: judged.shape.clone_dyn(), place }
                };
                assert!(judge(&lower(lift), 1e-3, 0.0, 1.0).0.is_none());
                assert!(judge(&lower(lift - 0.03), 0.02, 0.0, 1.0).0.is_some());
            }
        } else if least > 0.2 {
            assert!(find(DVec3::ZERO).iter().all(|m| m.contact.is_none()));
            clear += 1;
            // Moved to 0.2 mm: nearer by what it was farther, along the shortest way.
            let steps: Vec<f64> = (0..=400).map(|i| f64::from(i) / 400.0).collect();
            let one = Judge { motion: &motion, tool: &shown, body: &judged, speed };
            let nearest =
                steps.into_iter().min_by(|a, b| one.distance(*a).total_cmp(&one.distance(*b))).unwrap();
            let slope = |axis: DVec3| {
                let place =
                    |by: f64| Rigid { translation: judged.place.translation + axis * by, ..judged.place };
                let there = |by: f64| {
                    let moved = Shown { shape: judged.shape.clone_dyn(), place: place(by) };
                    Judge { motion: &motion, tool: &shown, body: &moved, speed }.distance(nearest)
                };
                (there(1e-3) - there(-1e-3)) / 2e-3
            };
            let away = DVec3::new(slope(DVec3::X), slope(DVec3::Y), slope(DVec3::Z)).normalize_or_zero();
            let by = away * (0.2 - least);
            judged.place.translation += by;
            let least = judge(&judged, 1e-4, 0.0, 1.0).1;
            if !(0.1..0.3).contains(&least) {
                continue;
            }
            let found = find(by);
            assert!(found.iter().all(|m| m.contact.is_none()), "{least}");
            let nearest = found.iter().map(|m| m.distance).fold(f64::INFINITY, f64::min);
            // The judge steps by the distance: it is at least half a step off the nearest.
            assert!(nearest <= least + 2e-3, "{nearest} {least}");
            // A clamp off by more may be met, from where it is as near; one off by less is not.
            let off = least + random.between(0.01, 0.5);
            let may: Vec<_> =
                find_off(by, off).into_iter().filter_map(|m| Some((m.contact?, m.distance))).collect();
            let from = may.iter().map(|(c, _)| c.from).fold(f64::INFINITY, f64::min);
            let to = may.iter().map(|(c, _)| c.to).fold(0.0, f64::max);
            let times = |touch: f64| {
                [judge(&judged, touch, 0.0, 1.0).0, judge(&judged, touch, 1.0, -1.0).0].map(Option::unwrap)
            };
            let ([first, last], [sooner, later]) = (times(off - 1e-3), times(off + 0.01));
            let room = 0.01 / speed;
            assert!(from <= first + room && from >= sooner - room, "{from} {first} {sooner} {off} {least}");
            assert!(to >= last - room && to <= later + room, "{to} {last} {later} {off} {least}");
            assert!(may.iter().all(|(c, _)| !c.certain));
            let nearest = may.iter().map(|(_, distance)| *distance).fold(f64::INFINITY, f64::min);
            assert!(nearest <= least + 2e-3, "{nearest} {least}");
            assert!(find_off(by, nearest - 0.03).iter().all(|m| m.contact.is_none()));
            misses += 1;
        }
    }
    assert!(clear >= misses);
}

#[test]
fn a_tool_within_a_mesh_meets_it_all_the_way_whichever_way_its_triangles_turn() {
    let cutter = Profile::cylinder(2.0, 3.0).unwrap();
    let tool = [MovingTool::new([(ToolPart::Cutter, &cutter, 0.0)])];
    for turned in [false, true] {
        let mut mesh = wedge(DVec3::splat(50.0));
        if turned {
            mesh.triangles.iter_mut().for_each(|t| t.swap(1, 2));
        }
        let body = [Body::new("vise", &Solid::Mesh(mesh), Rigid::IDENTITY, 0.0).unwrap()];
        let contact = |from: [f64; 3], to: [f64; 3]| {
            let line = Line { start: from.into(), end: to.into() };
            let motion = ToolMotion::fixed(line.into(), DVec3::Z).unwrap();
            let found = meetings(&tool, &body, &[Watched { motion, tool: 0 }], DVec3::Z, &Silent).unwrap();
            found.first().and_then(|m| m.contact)
        };
        let within = contact([-9.0, 0.0, -20.0], [9.0, 2.0, -25.0]).unwrap();
        assert_eq!((within.from, within.to), (0.0, 1.0));
        // Out through its side at X 35 (half of its height): from the begin; and back in: to the end.
        let out = contact([0.0, 0.0, 0.0], [80.0, 0.0, 0.0]).unwrap();
        assert!(out.from == 0.0 && (out.to * 80.0 - 36.0).abs() < 0.05, "{out:?}");
        let back = contact([80.0, 0.0, 0.0], [0.0, 0.0, 0.0]).unwrap();
        assert!(back.to == 1.0 && ((1.0 - back.from) * 80.0 - 36.0).abs() < 0.05, "{back:?}");
        // Beside it, within its box.
        assert_eq!(contact([46.0, 0.0, 40.0], [48.0, 0.0, 40.0]), None);
    }
}

#[test]
fn many_short_moves_find_what_each_finds_by_itself() {
    const NEAR: f64 = 4.0;
    let mut random = Random(23);
    let (mut contacts, mut passes) = (0, 0);
    for _ in 0..12 {
        let (moving, ..) = tool(&mut random);
        let tool = [moving];
        let at = random.point(40.0);
        let bodies: Vec<Body> = (0..4)
            .map(|i| {
                let there = at + random.point(90.0);
                let (solid, place, _) = body(&mut random, there);
                Body::new(format!("body {i}"), &solid, place, NEAR).unwrap().off_by(0.3 * f64::from(i))
            })
            .collect();
        // A walk in steps of a tenth of a millimetre to a few, now and then far away.
        let mut start = at;
        let mut moves = Vec::new();
        for k in 0..400 {
            let by = if k % 97 == 96 { 60.0 } else { 0.1 * f64::from(1 + k % 30) };
            let end = start + random.point(by);
            let line = Line { start, end };
            let axis = DVec3::new(random.between(-0.3, 0.3), 0.1, 1.0);
            let motion = match k % 5 {
                0 => ToolMotion::between(line.into(), axis, axis + random.point(0.01)),
                _ => ToolMotion::fixed(line.into(), DVec3::Z),
            };
            moves.push(Watched { motion: motion.unwrap(), tool: 0 });
            start = end;
        }
        let all = meetings(&tool, &bodies, &moves, DVec3::Z, &Silent).unwrap();
        let touched = |found: &[kinecut_stock::contact::Meeting], by: u32| -> Vec<_> {
            let own = found.iter().filter_map(|m| m.contact.map(|c| (m, c)));
            own.map(|(m, c)| (m.watched + by, m.body, m.part, c.from.to_bits(), c.to.to_bits())).collect()
        };
        let mut alone = Vec::new();
        let mut nearest = std::collections::BTreeMap::new();
        for (i, one) in (0..).zip(&moves) {
            let found = meetings(&tool, &bodies, std::slice::from_ref(one), DVec3::Z, &Silent).unwrap();
            alone.extend(touched(&found, i));
            for pass in found.iter().filter(|m| m.contact.is_none()) {
                let least = nearest.entry((pass.body, pass.part)).or_insert(pass.distance);
                *least = pass.distance.min(*least);
            }
        }
        assert_eq!(touched(&all, 0), alone);
        contacts += alone.len();
        let found: Vec<_> = all.iter().filter(|m| m.contact.is_none()).collect();
        assert_eq!(found.len(), nearest.len());
        for pass in found {
            let least = nearest[&(pass.body, pass.part)];
            assert!((pass.distance - least).abs() <= 4e-3, "{} {least}", pass.distance);
            passes += 1;
        }
    }
    assert!(contacts > 100 && passes > 20, "{contacts} {passes}");
}
