//! Generated surfaces against the golden file, and against formulas that share nothing with the library.

use std::f64::consts::TAU;

use glam::{DMat3, DVec2, DVec3};
use kinecut::base::Silent;
use kinecut::geom::Rigid;
use kinecut::machine::generation::{
    Distance, ElementaryBody, InvoluteFlank, Left, Meridian, MeridianPiece, ParametricSurface, Placed,
    ToolEnvelope, coverage, residual,
};
use kinecut::num::minimum::minimum_along;

use crate::common::golden::{self, number, vector};

fn turn_z(angle: f64) -> Rigid {
    Rigid { rotation: DMat3::from_rotation_z(angle), translation: DVec3::ZERO }
}

fn shift(x: f64, y: f64, z: f64) -> Rigid {
    Rigid::from_translation(DVec3::new(x, y, z))
}

/// Straight flank of the rack: a half-plane through the origin of the tool, turned by the pressure angle.
fn rack_flank(alpha: f64) -> ElementaryBody {
    ElementaryBody::HalfSpace { point: DVec3::ZERO, normal: DVec3::new(-alpha.sin(), alpha.cos(), 0.0) }
}

#[test]
fn a_rack_that_rolls_leaves_an_involute() {
    let g = golden::file("kinematics")["rolling_rack"].clone();
    let (rp, alpha, rb) = (number(&g, "rp"), number(&g, "alpha"), number(&g, "rb"));
    // Edge of the tool: 6(alpha) 1(v), so its normal is Y turned by alpha.
    let flank = rack_flank(alpha);
    let motion = |u: [f64; 2]| turn_z(u[0]).after(&shift(rp, -rp * u[0], 0.0));
    // From the base circle on: at a roll below zero the flank would undercut what it has made.
    let domain = [[-alpha.tan(), 0.8], [0.0, 0.0]];
    let envelope = ToolEnvelope { tool: &flank, motion: &motion, domain, cells: [16, 0] };
    let start = -(alpha.tan() - alpha);
    for row in g["points"].as_array().unwrap() {
        let (phi, p) = (number(row, "phi"), vector(&row["p"]));
        // Which side of the half-plane is the tool decides the sign; the flank touches without crossing.
        let Left { residual, at, at_end } = nearest(&envelope, p);
        assert!(residual.abs() < 1e-9 && !at_end, "{phi}: {residual}");
        assert!((at[0] - phi).abs() < 2e-5, "{phi}: {}", at[0]);
        assert!(envelope.contact(p, [phi, 0.0])[0].abs() < 1e-8);
        let edge = motion([phi, 0.0]).after(&turn_z(alpha)).point(DVec3::X * number(row, "v"));
        assert!(edge.distance(p) < 1e-9);
        let wanted = InvoluteFlank { base: rb, start, clockwise: false, teeth: 1 };
        assert!(wanted.signed(p).abs() < 1e-9, "{}", wanted.signed(p));
    }
    let undercut = ToolEnvelope { domain: [[-0.8, 0.8], [0.0, 0.0]], ..envelope };
    assert!(nearest(&undercut, vector(&g["points"][0]["p"])).residual < -0.1);
    // Away from the contact the equation does not hold.
    let p = vector(&g["points"][4]["p"]);
    assert!(envelope.contact(p, [0.3, 0.0])[0].abs() > 0.1);
}

/// The residual on whichever side of the flank the material is.
fn nearest<T: Distance, M: Fn([f64; 2]) -> Rigid + Sync>(
    envelope: &ToolEnvelope<'_, T, M>,
    p: DVec3,
) -> Left {
    let other = kinecut::machine::generation::Hollow(envelope.tool);
    let turned = ToolEnvelope {
        tool: &other,
        motion: envelope.motion,
        domain: envelope.domain,
        cells: envelope.cells,
    };
    let (a, b) = (envelope.left(p), turned.left(p));
    if a.residual.abs() < b.residual.abs() { a } else { b }
}

#[test]
fn a_roller_in_a_cam_touches_both_walls_and_gouges_neither() {
    let g = golden::file("kinematics")["cam_envelope"].clone();
    let (h, rho) = (number(&g, "H"), number(&g, "rho"));
    let rise = |phi: f64| h / 2.0 * (1.0 - phi.cos());
    // The roller reaches from radius 20 to 40; an endless one would cut the other side of the drum too.
    let corners = [[0.0, 20.0], [rho, 20.0], [rho, 40.0], [0.0, 40.0]].map(DVec2::from);
    let line = |k: usize| MeridianPiece::Line { from: corners[k], to: corners[k + 1] };
    let upright = Meridian::new((0..3).map(line).collect()).unwrap();
    let along_x = DMat3::from_rotation_y(std::f64::consts::FRAC_PI_2);
    let roller = Placed::new(upright, Rigid { rotation: along_x, translation: DVec3::ZERO });
    let motion = |u: [f64; 2]| turn_z(u[0]).after(&shift(0.0, 0.0, rise(u[0])));
    let envelope =
        ToolEnvelope { tool: &roller, motion: &motion, domain: [[-3.0, 3.0], [0.0, 0.0]], cells: [48, 0] };
    let mut points = Vec::new();
    let mut offset_error = 0.0f64;
    for row in g["points"].as_array().unwrap() {
        let (phi, p) = (number(row, "phi"), vector(&row["p"]));
        points.push(p);
        let left = envelope.left(p);
        assert!(left.residual.abs() < 1e-9 && (left.at[0] - phi).abs() < 2e-5, "{phi}: {left:?}");
        assert!(envelope.contact(p, [phi, 0.0])[0].abs() < 1e-6);
        // The distance of the point from the roller's axis, written out: rho, and stationary.
        let distance = |f: f64| (p.y * f.cos() - p.x * f.sin()).hypot(p.z - rise(f));
        assert!((distance(phi) - rho).abs() < 1e-9);
        assert!(((distance(phi + 1e-4) - distance(phi - 1e-4)) / 2e-4).abs() < 1e-5);
        let track = rise(p.y.atan2(p.x)) - number(row, "side") * rho;
        offset_error = offset_error.max((p.z - track).abs());
    }
    let expected =
        number(&golden::file("kinematics")["verification"]["cam_roller_vs_offset_track"], "max_abs_mm");
    assert!((offset_error - expected).abs() < 1e-9, "{offset_error}");
    let all = envelope.left_over(&points, &Silent).unwrap();
    assert!(all.greatest.0 < 1e-9 && all.least.0 > -1e-9 && all.rms < 1e-9);
    // A track that is taken for the offset of the ruled one is gouged or left by the same roller.
    let shifted = turn_z(-0.7).after(&shift(25.0, 0.0, rise(-0.7) + rho)).point(DVec3::ZERO);
    assert!(envelope.left(shifted).residual.abs() > 1e-3);
}

#[test]
fn a_ball_that_steps_over_a_plane_leaves_its_scallop() {
    let g = golden::file("kinematics")["verification"]["ball_scallop"].clone();
    let (radius, step) = (number(&g, "R"), number(&g, "step"));
    let ball = ElementaryBody::Ball { centre: DVec3::Z * radius, radius };
    // Rows at whole multiples of the step, each along Y.
    let row = |k: f64| move |u: [f64; 2]| shift(k * step, u[0], 0.0);
    let left = |p: DVec3| {
        let rows = [-1.0, 0.0, 1.0, 2.0].map(|k| {
            let motion = row(k);
            ToolEnvelope { tool: &ball, motion: &motion, domain: [[-9.0, 9.0], [0.0, 0.0]], cells: [18, 0] }
                .left(p)
                .residual
        });
        rows.into_iter().fold(f64::INFINITY, f64::min)
    };
    let worst = minimum_along(|x| -left(DVec3::new(x, 0.37, 0.0)), 0.0, step, 8);
    assert!((-worst.1 * 1e3 - number(&g, "exact_sdf_um")).abs() < 1e-6, "{worst:?}");
    assert!((worst.0 - step / 2.0).abs() < 1e-6);
    assert!(left(DVec3::ZERO).abs() < 1e-12);
    // The vertical height is that of the crossing of two balls: there nothing is left.
    let height = number(&g, "predicted_vertical_um") * 1e-3;
    assert!(left(DVec3::new(step / 2.0, 0.37, height)).abs() < 1e-9);
}

#[test]
fn a_finite_number_of_cuts_leaves_facets() {
    let g = golden::file("kinematics")["verification"]["generating_facets"].clone();
    let (rb, t, dt) = (number(&g, "rb"), number(&g, "t"), number(&g, "dt"));
    // Each stroke is a half-plane that touches the involute at a roll; material is on its negative side.
    let stroke = |t: f64| {
        let (s, c) = t.sin_cos();
        ElementaryBody::HalfSpace {
            point: DVec3::new(c + t * s, s - t * c, 0.0) * rb,
            normal: DVec3::new(s, -c, 0.0),
        }
    };
    let (before, after) = (stroke(t - dt / 2.0), stroke(t + dt / 2.0));
    let wanted = InvoluteFlank { base: rb, start: 0.0, clockwise: false, teeth: 1 };
    // The corner of both facets: where a point on the first also lies on the second.
    let ElementaryBody::HalfSpace { point, normal } = before else { unreachable!() };
    let along = DVec3::new(-normal.y, normal.x, 0.0);
    let (s, _) = minimum_along(|s| after.signed(point + along * s).abs(), -9.0, 9.0, 20);
    let height = wanted.signed(point + along * s) * 1e3;
    // The golden figure is the least over a grid of rolls, which is too high by up to 2.4e-4 um.
    assert!((-3e-4..1e-9).contains(&(height - number(&g, "exact_um"))), "{height}");
    assert!((number(&g, "predicted_um") - rb * t * dt * dt / 8.0 * 1e3).abs() < 1e-6);
}

#[test]
fn a_skew_edge_turns_a_hyperboloid_instead_of_a_cylinder() {
    let g = golden::file("kinematics")["verification"]["skew_edge_cylinder"].clone();
    let (radius, half, skew) = (25.0, 25.0, 0.5f64.to_radians());
    let edge = half / skew.cos();
    let turned = |f: f64, v: f64| turn_z(f).point(DVec3::new(radius, -v * skew.sin(), v * skew.cos()));
    let wanted = ElementaryBody::Cylinder { point: DVec3::ZERO, axis: DVec3::Z, radius };
    let found = residual(&turned, [[0.0, 6.0], [-edge, edge]], [12, 40], &wanted, &Silent).unwrap();
    assert!((found.greatest.distance * 1e3 - number(&g, "max_um")).abs() < 1e-6);
    assert!((found.greatest.distance * 1e3 - number(&g, "predicted_um")).abs() < 1e-6);
    assert!(found.least.distance.abs() < 1e-9 && found.least.at[1].abs() < 1e-3);
    // A parabola over the length: greatest / sqrt 5 (the golden figure is the mean over a grid with both ends).
    assert!((found.rms * 1e3 - number(&g, "max_um") / 5f64.sqrt()).abs() < 1e-4, "{}", found.rms * 1e3);
    assert!((found.area - 6.0 * radius * 2.0 * half).abs() < 0.1);
    // The slope of the greatest deviation along the axis.
    let tilt = (half * skew.tan().powi(2) / radius).atan();
    assert!((found.tilt - tilt).abs() < 1e-5, "{} {tilt}", found.tilt);
    assert_eq!(found.finding(1e-3), None);
    let finding = found.finding(0.5e-3).unwrap();
    assert_eq!(finding.code.as_str(), "KC1133");
    assert!(finding.to_string().contains("0.95196 um"), "{finding}");
}

/// The thread flank of the golden catalogue: 6(phi) 3(p phi/2pi) 1(r0) 5(beta) 1(v).
fn flank(pitch: f64) -> impl Fn(f64, f64) -> DVec3 + Sync + Clone {
    let beta = std::f64::consts::FRAC_PI_6;
    move |phi, v| {
        turn_z(phi).point(DVec3::new(12.0 + v * beta.cos(), 0.0, pitch * phi / TAU - v * beta.sin()))
    }
}

#[test]
fn a_wrong_pitch_shows_as_a_normal_error_of_the_flank() {
    let g = golden::file("kinematics")["verification"]["pitch_error_thread"].clone();
    let domain = [[0.0, 10.0 * TAU], [0.5, 2.5]];
    // The wanted flank reaches beyond, so that no foot is on its border.
    let wanted =
        ParametricSurface::new(flank(6.0), [[-1.0, 10.0 * TAU + 1.0], [0.0, 3.0]], [256, 2], false).unwrap();
    let found = residual(&flank(number(&g, "machine_pitch")), domain, [40, 2], &wanted, &Silent).unwrap();
    let worst = found.worst().distance.abs() * 1e3;
    // The golden figure leaves the lead angle out: the normal of the helicoid leans by it too.
    let lead = 6.0 / TAU;
    let lean = |r: f64| {
        let (c, s) = (30f64.to_radians().cos(), 30f64.to_radians().sin());
        // r_u x r_v of the flank, its axial part over its length.
        let n = DVec3::new(-r * s, -lead * c, -r * c);
        n.z.abs() / n.length()
    };
    let radius = 12.0 + 2.5 * 30f64.to_radians().cos();
    assert!((worst - 30.0 * lean(radius)).abs() < 0.01, "{worst} {}", 30.0 * lean(radius));
    assert!((worst - number(&g, "flank_normal_um")).abs() < 0.1, "{worst}");
    let exact = residual(&flank(6.0), domain, [16, 2], &wanted, &Silent).unwrap();
    assert!(exact.worst().distance.abs() < 1e-9 && exact.tilt < 1e-6, "{exact:?}");
}

#[test]
fn the_cone_of_the_paper_and_its_wrong_sign() {
    let g = golden::file("kinematics")["verification"].clone();
    let (r, alpha) = (30.0, 0.35f64);
    let apex = DVec3::Z * (r / alpha.tan());
    let wanted = ElementaryBody::Cone { apex, axis: DVec3::NEG_Z, half_angle: alpha };
    let turned = |sign: f64| {
        move |f: f64, z: f64| {
            let ruling = DMat3::from_rotation_y(sign * alpha) * (DVec3::Z * z);
            turn_z(f).point(DVec3::X * r + ruling)
        }
    };
    let domain = [[0.0, 6.0], [0.0, 50.0]];
    let right = residual(&turned(-1.0), domain, [8, 8], &wanted, &Silent).unwrap();
    assert!(right.worst().distance.abs() < 1e-12, "{right:?}");
    let wrong = residual(&turned(1.0), domain, [8, 8], &wanted, &Silent).unwrap();
    let expected = number(&g["cone_wrong_A5_sign"], "max_um");
    assert!((wrong.greatest.distance * 1e3 - expected).abs() < 1e-6, "{}", wrong.greatest.distance);
}

#[test]
fn what_is_not_reached_is_told_with_its_place() {
    let wanted = |u: f64, v: f64| DVec3::new(20.0 * u.cos(), 20.0 * u.sin(), v);
    let whole = [[0.0, TAU], [0.0, 40.0]];
    // The edge is a quarter too short: the last 10 mm stay.
    let made = ParametricSurface::new(wanted, [[0.0, TAU], [0.0, 30.0]], [24, 6], false).unwrap();
    let reach = |p: DVec3| made.foot(p).1.distance(p);
    let found = coverage(&wanted, whole, [24, 40], [true, false], reach, 1e-6, &Silent).unwrap();
    assert!((found.share - 0.75).abs() < 1e-9, "{found:?}");
    let gap = found.largest_gap.unwrap();
    assert!((gap.area / found.area - 0.25).abs() < 1e-9);
    assert!((gap.point.z - 39.5).abs() < 1e-9 && (gap.distance - 9.5).abs() < 1e-6);
    assert_eq!(
        coverage(&wanted, whole, [4, 4], [true, false], |_| 0.0, 0.0, &Silent).unwrap().largest_gap,
        None
    );
    assert!(coverage(&wanted, whole, [0, 4], [true, false], |_| 0.0, 0.0, &Silent).is_err());
}

#[test]
fn a_mill_of_two_variables_and_a_placed_tool() {
    // Face milling: the cutter's end stands on the plane wherever it goes; above it everything is cut.
    let mill = Placed::new(
        ElementaryBody::Cylinder { point: DVec3::ZERO, axis: DVec3::Z, radius: 8.0 },
        Rigid::IDENTITY,
    );
    let motion = |u: [f64; 2]| shift(u[0], 3.0 * u[1], 0.0);
    let envelope =
        ToolEnvelope { tool: &mill, motion: &motion, domain: [[0.0, 50.0], [0.0, 10.0]], cells: [20, 20] };
    // A wall along X at the farthest row.
    let left = envelope.left(DVec3::new(20.0, 38.0, 0.0));
    assert!(left.residual.abs() < 1e-9 && left.at_end);
    assert!((envelope.left(DVec3::new(20.0, 40.0, 0.0)).residual - 2.0).abs() < 1e-9);
    assert!((envelope.left(DVec3::new(20.0, 15.0, 0.0)).residual + 8.0).abs() < 1e-9);
}
