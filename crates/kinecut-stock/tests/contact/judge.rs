//! The judge: bodies of another library, and the first time at which two of them are near.

use std::f64::consts::TAU;

use glam::{DMat3, DQuat, DVec3};
use kinecut_stock::contact::{MovingTool, ToolPart};
use kinecut_stock::geom::{Aabb, Mesh, Profile, Rigid, Solid};
use parry3d_f64::math::{Pose, Rotation, Vector};
use parry3d_f64::query::distance;
use parry3d_f64::shape::{Ball, Cuboid, Cylinder, Shape, TriMesh};

/// Random numbers by a formula, the same in every run.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    pub(crate) fn point(&mut self, by: f64) -> DVec3 {
        DVec3::new(self.between(-by, by), self.between(-by, by), self.between(-by, by))
    }

    pub(crate) fn turn(&mut self) -> DMat3 {
        DMat3::from_quat(DQuat::from_scaled_axis(self.point(2.0)))
    }
}

pub(crate) fn pose(rigid: &Rigid) -> Pose {
    let q = DQuat::from_mat3(&rigid.rotation);
    let t = rigid.translation;
    Pose::from_parts(Vector::new(t.x, t.y, t.z), Rotation::from_xyzw(q.x, q.y, q.z, q.w))
}

/// A shape of the judge with its place on what carries it.
pub(crate) struct Shown {
    pub(crate) shape: Box<dyn Shape>,
    pub(crate) place: Rigid,
}

impl Shown {
    /// A cylinder about Z between two heights; the judge has them along Y.
    pub(crate) fn cylinder(radius: f64, low: f64, high: f64) -> Shown {
        let upright = DMat3::from_rotation_x(TAU / 4.0);
        let place = Rigid { rotation: upright, translation: DVec3::Z * 0.5 * (low + high) };
        Shown { shape: Box::new(Cylinder::new(0.5 * (high - low), radius)), place }
    }

    pub(crate) fn ball(radius: f64) -> Shown {
        Shown { shape: Box::new(Ball::new(radius)), place: Rigid::from_translation(DVec3::Z * radius) }
    }
}

/// A tool as both know it.
pub(crate) fn tool(random: &mut Random) -> (MovingTool, Vec<Shown>, f64) {
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
pub(crate) fn wedge(size: DVec3) -> Mesh {
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
pub(crate) fn body(random: &mut Random, at: DVec3) -> (Solid, Rigid, Shown) {
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

/// Distance of two shapes whose carriers are at these places [mm].
pub(crate) fn apart(first: (&Shown, &Rigid), second: (&Shown, &Rigid)) -> f64 {
    let [here, there] = [first, second].map(|(shown, at)| pose(&at.after(&shown.place)));
    distance(&here, &*first.0.shape, &there, &*second.0.shape).expect("a case of these numbers").distance
}

/// The first time from `t` on, in a direction, at which a distance is `touch` or less, and the least distance up to there; it changes
/// by no more than `speed`.
pub(crate) fn meets(
    of: impl Fn(f64) -> f64,
    speed: f64,
    mut t: f64,
    direction: f64,
    touch: f64,
) -> (Option<f64>, f64) {
    let mut least = f64::INFINITY;
    while (0.0..=1.0).contains(&t) {
        let d = of(t);
        least = least.min(d);
        if d <= touch {
            return (Some(t), least);
        }
        t += direction * ((d - touch + 5e-5) / speed).max(1e-7);
    }
    (None, least)
}
