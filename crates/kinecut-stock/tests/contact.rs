//! Contacts of a moving tool with standing bodies, against distances by another library over dense time.
//!
//! The judge knows the tool as a ball and cylinders, the bodies as a cuboid, a cylinder and a mesh, and goes through a move in steps that
//! are no longer than the distance at that moment: it passes over no contact.

use std::f64::consts::TAU;

use glam::{DMat3, DQuat, DVec3};
use kinecut_stock::base::Silent;
use kinecut_stock::contact::{MovingTool, StandingBody, ToolPart, Watched, meetings};
use kinecut_stock::geom::{Aabb, Arc, Line, Mesh, Profile, Rigid, Solid};
use kinecut_stock::machine::kinematics::Twist;
use kinecut_stock::sweep::ToolMotion;
use parry3d_f64::math::{Pose, Rotation, Vector};
use parry3d_f64::query::distance;
use parry3d_f64::shape::{Ball, Cuboid, Cylinder, Shape, TriMesh};

/// Random numbers by a formula, the same in every run.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    fn point(&mut self, by: f64) -> DVec3 {
        DVec3::new(self.between(-by, by), self.between(-by, by), self.between(-by, by))
    }

    fn turn(&mut self) -> DMat3 {
        DMat3::from_quat(DQuat::from_scaled_axis(self.point(2.0)))
    }
}

fn pose(rigid: &Rigid) -> Pose {
    let q = DQuat::from_mat3(&rigid.rotation);
    let t = rigid.translation;
    Pose::from_parts(Vector::new(t.x, t.y, t.z), Rotation::from_xyzw(q.x, q.y, q.z, q.w))
}

/// A shape of the judge with its place on what carries it.
struct Shown {
    shape: Box<dyn Shape>,
    place: Rigid,
}

impl Shown {
    /// A cylinder about Z between two heights; the judge has them along Y.
    fn cylinder(radius: f64, low: f64, high: f64) -> Shown {
        let upright = DMat3::from_rotation_x(TAU / 4.0);
        let place = Rigid { rotation: upright, translation: DVec3::Z * 0.5 * (low + high) };
        Shown { shape: Box::new(Cylinder::new(0.5 * (high - low), radius)), place }
    }

    fn ball(radius: f64) -> Shown {
        Shown { shape: Box::new(Ball::new(radius)), place: Rigid::from_translation(DVec3::Z * radius) }
    }
}

/// A tool as both know it.
fn tool(random: &mut Random) -> (MovingTool, Vec<Shown>, f64) {
    let (r, edges) = (random.between(1.0, 12.0), random.between(15.0, 40.0));
    let (shank, holder) = (random.between(0.5, 0.95) * r, random.between(15.0, 30.0));
    let (stickout, top) = (edges + random.between(5.0, 30.0), edges + 80.0);
    let ball = random.next() < 0.5;
    let cutter = if ball { Profile::bull_nose(2.0 * r, r, edges) } else { Profile::cylinder(2.0 * r, edges) };
    let neck = Profile::cylinder(2.0 * shank, stickout - edges);
    let head = Profile::cylinder(2.0 * holder, top - stickout);
    let (cutter, neck, head) = (
        cutter.expect("a case of these numbers"),
        neck.expect("a case of these numbers"),
        head.expect("a case of these numbers"),
    );
    let profiles = [
        (ToolPart::Cutter, &cutter, 0.0),
        (ToolPart::Shank, &neck, edges),
        (ToolPart::Holder, &head, stickout),
    ];
    let mut shown = vec![
        Shown::cylinder(r, if ball { r } else { 0.0 }, edges),
        Shown::cylinder(shank, edges, stickout),
        Shown::cylinder(holder, stickout, top),
    ];
    if ball {
        shown.push(Shown::ball(r));
    }
    (MovingTool::new(profiles), shown, top.hypot(holder))
}

/// A closed mesh about a box: two corners of its top are drawn out to one place.
fn wedge(size: DVec3) -> Mesh {
    let corner = |x: f64, y: f64, z: f64| DVec3::new(x * size.x, y * size.y, z * size.z);
    let vertices = vec![
        corner(-1.0, -1.0, -1.0),
        corner(1.0, -1.0, -1.0),
        corner(1.0, 1.0, -1.0),
        corner(-1.0, 1.0, -1.0),
        corner(-0.4, 0.0, 1.0),
        corner(0.4, 0.0, 1.0),
    ];
    let triangles =
        vec![[0, 2, 1], [0, 3, 2], [0, 1, 5], [0, 5, 4], [1, 2, 5], [2, 3, 4], [2, 4, 5], [3, 0, 4]];
    Mesh { vertices, triangles }
}

/// A body as both know it, about a place.
fn body(random: &mut Random, at: DVec3) -> (Solid, Rigid, Shown) {
    let place = Rigid { rotation: random.turn(), translation: at };
    let size = DVec3::new(random.between(3.0, 40.0), random.between(3.0, 40.0), random.between(3.0, 40.0));
    match (random.next() * 3.0) as u32 {
        0 => {
            let solid = Solid::Box(Aabb { min: -size, max: size });
            let shape = Cuboid::new(Vector::new(size.x, size.y, size.z));
            (solid, place, Shown { shape: Box::new(shape), place })
        }
        1 => {
            let solid = Solid::Cylinder { base: DVec3::ZERO, radius: size.x, height: size.z };
            let own = Shown::cylinder(size.x, 0.0, size.z);
            (solid, place, Shown { place: place.after(&own.place), ..own })
        }
        _ => {
            let mesh = wedge(size);
            let corners = mesh.vertices.iter().map(|p| Vector::new(p.x, p.y, p.z)).collect();
            let shape = TriMesh::new(corners, mesh.triangles.clone()).expect("a case of these numbers");
            (Solid::Mesh(mesh), place, Shown { shape: Box::new(shape), place })
        }
    }
}

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
        let there = pose(&self.body.place);
        let one = |shown: &Shown| {
            let here = pose(&at.after(&shown.place));
            distance(&here, &*shown.shape, &there, &*self.body.shape)
                .expect("a case of these numbers")
                .distance
        };
        self.tool.iter().map(one).fold(f64::INFINITY, f64::min)
    }

    /// The first time from `t` on, in a direction, at which the distance is `touch` or less, and the least distance up to there.
    fn meets(&self, mut t: f64, direction: f64, touch: f64) -> (Option<f64>, f64) {
        let mut least = f64::INFINITY;
        while (0.0..=1.0).contains(&t) {
            let d = self.distance(t);
            least = least.min(d);
            if d <= touch {
                return (Some(t), least);
            }
            t += direction * ((d - 0.5 * touch) / self.speed).max(1e-7);
        }
        (None, least)
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
        let find = |by: DVec3| {
            let place = Rigid { translation: place.translation + by, ..place };
            let standing = [StandingBody::new("clamp", &solid, place, NEAR).unwrap()];
            meetings(std::slice::from_ref(&moving), &standing, &watched, DVec3::Z, &Silent).unwrap()
        };
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
        let body = [StandingBody::new("vise", &Solid::Mesh(mesh), Rigid::IDENTITY, 0.0).unwrap()];
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
