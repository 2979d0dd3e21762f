//! Machines from configurations of LinuxCNC against the formulas of its modules, and what is told of each line.

use glam::DVec3;
use kinecut::base::Code;
use kinecut::job::machine::{machine_toml, read};
use kinecut::machine::Machine;
use kinecut::machine::linuxcnc::{Fate, hal_files, import};

/// A configuration with a module, units and HAL commands.
fn ini(module: &str, coordinates: &str, unit: &str, commands: &[&str]) -> String {
    let mut text = format!(
        "# a comment\n[EMC]\nVERSION = 1.1\nMACHINE = mill\n\n[KINS]\n KINEMATICS = {module}\n[TRAJ]\n\
         COORDINATES = {coordinates}\nLINEAR_UNITS = {unit}\nANGULAR_UNITS = deg\n[HAL]\n"
    );
    for command in commands {
        text += &format!("HALCMD = {command}\n");
    }
    for n in 0..6 {
        text += &format!(
            "[JOINT_{n}]\nTYPE = ANY\nMIN_LIMIT = -{}\nMAX_LIMIT = 100\nMAX_VELOCITY = 30\nMAX_ACCELERATION = 300\n",
            90 + n
        );
    }
    text
}

/// Tip and tool direction of a machine at values of its letters (mm, degrees).
fn tip(machine: &Machine, at: &[(char, f64)]) -> DVec3 {
    let value = |letter: char| at.iter().find(|(l, _)| *l == letter).map_or(0.0, |(_, v)| *v);
    let q: Vec<f64> = machine
        .joints
        .iter()
        .map(|j| if j.motion.is_rotation() { value(j.letter).to_radians() } else { value(j.letter) })
        .collect();
    machine.kinematics(0.0).forward(&q).translation
}

/// Values of joints that leave nothing at zero, different for each case.
fn samples() -> impl Iterator<Item = [f64; 6]> {
    (0..40).map(|k| {
        std::array::from_fn(|i| (f64::from(k) * (1.7 + i as f64) * 13.0 + 11.0 * i as f64) % 97.0 - 48.0)
    })
}

#[test]
fn the_tilting_tables_are_those_of_the_modules_formulas() {
    let pins =
        ["x-rot-point 3", "y-rot-point -4", "z-rot-point 5", "x-offset 21", "y-offset 20", "z-offset 10"];
    for (module, sense) in
        [("xyzac-trt-kins", -1.0), ("xyzbc-trt-kins", -1.0), ("xyzac-trt-kins", 1.0), ("xyzbc-trt-kins", 1.0)]
    {
        let mut commands: Vec<String> = pins.iter().map(|p| format!("setp {module}.{p}")).collect();
        if sense > 0.0 {
            commands.push(format!("setp {module}.conventional-directions 1"));
        }
        let commands: Vec<&str> = commands.iter().map(String::as_str).collect();
        let text = ini(module, "XYZAC", "mm", &commands);
        let machine = import(("m.ini", &text), &[], None).unwrap().machine;
        let tilt = if module.contains("xyzac") { 'A' } else { 'B' };
        for [x, y, z, a, c, _] in samples() {
            let found = tip(&machine, &[('X', x), ('Y', y), ('Z', z), (tilt, a), ('C', c)]);
            // The module's forward function, which has the sines of its default sense.
            let (sa, ca) = (-sense * a).to_radians().sin_cos();
            let (sc, cc) = (-sense * c).to_radians().sin_cos();
            let (px, py, pz) = (x - 3.0, y + 4.0, z - 5.0);
            let wanted = if tilt == 'A' {
                let (dy, dz) = (20.0, 10.0);
                DVec3::new(
                    cc * px + sc * ca * (py - dy) + sc * sa * (pz - dz) + sc * dy + 3.0,
                    -sc * px + cc * ca * (py - dy) + cc * sa * (pz - dz) + cc * dy - 4.0,
                    -sa * (py - dy) + ca * (pz - dz) + dz + 5.0,
                )
            } else {
                let (dx, dz) = (21.0, 10.0);
                DVec3::new(
                    cc * ca * (px - dx) + sc * py - cc * sa * (pz - dz) + cc * dx + 3.0,
                    -sc * ca * (px - dx) + cc * py + sc * sa * (pz - dz) - sc * dx - 4.0,
                    sa * (px - dx) + ca * (pz - dz) + dz + 5.0,
                )
            };
            assert!((found - wanted).length() < 1e-11, "{module} {sense}: {found} {wanted}");
        }
    }
}

#[test]
fn the_dual_table_and_the_bridge_are_those_of_the_modules_formulas() {
    let commands = [
        "setp xyzab_tdr_kins.x-rot-point 7",
        "setp xyzab_tdr_kins.y-rot-point 8",
        "setp xyzab_tdr_kins.z-rot-point 9",
        "setp xyzab_tdr_kins.z-offset -10",
    ];
    let tables =
        import(("m.ini", &ini("xyzab_tdr_kins", "XYZAB", "mm", &commands)), &[], None).unwrap().machine;
    assert_eq!(tables.code.to_string(), "450123");
    let bridge = ini("5axiskins coordinates=xyzbcw", "XYZBCW", "mm", &["setp 5axiskins.pivot-length 310"]);
    let bridge = import(("m.ini", &bridge), &[], None).unwrap().machine;
    assert_eq!(bridge.code.to_string(), "012365");
    for [x, y, z, a, b, c] in samples() {
        let (sa, ca) = a.to_radians().sin_cos();
        let (sb, cb) = b.to_radians().sin_cos();
        let (px, py, pz) = (x - 7.0, y - 8.0, z - 9.0);
        let wanted = DVec3::new(
            cb * px + sb * pz + 7.0,
            sa * sb * px + ca * py - cb * sa * pz - sa * 10.0 + 8.0,
            -ca * sb * px + sa * py + ca * cb * pz + ca * 10.0 + 9.0 - 10.0,
        );
        let found = tip(&tables, &[('X', x), ('Y', y), ('Z', z), ('A', a), ('B', b)]);
        assert!((found - wanted).length() < 1e-11, "{found} {wanted}");
        // Spherical coordinates of the module: radius L, azimuth C, zenith 180 - B.
        let (sp, cp) = (180.0 - b).to_radians().sin_cos();
        let (st, ct) = c.to_radians().sin_cos();
        let wanted = DVec3::new(x + 310.0 * sp * ct, y + 310.0 * sp * st, z + 310.0 * cp + 310.0);
        let found = tip(&bridge, &[('X', x), ('Y', y), ('Z', z), ('B', b), ('C', c)]);
        assert!((found - wanted).length() < 1e-10, "{found} {wanted}");
    }
}

#[test]
fn the_nutating_head_is_that_of_the_modules_formula() {
    let p = "xyzacb_trsrn_kins";
    let hal = format!(
        "setp {p}.y-pivot 50\nsetp {p}.z-pivot 120\nnet :dx {p}.x-offset gui.x\nsets :dx 13\n\
         setp {p}.y-offset \\\n  -27\nsetp {p}.y-rot-axis 31 # table\nsetp {p}.z-rot-axis -120\nsetp {p}.nut-angle [HEAD]NU\n"
    );
    let text = ini("xyzacb_trsrn", "XYZABC", "mm", &[]) + "[HEAD]\nNU = 55\n";
    let read = import(("m.ini", &text), &[("head.hal", &hal)], None).unwrap();
    assert_eq!(read.machine.code.to_string(), "4012367");
    let used =
        |part: &str| read.lines.iter().any(|l| l.text.contains(part) && matches!(&l.fate, Fate::Used(_)));
    assert!(used("sets :dx 13") && used("net :dx") && used("nut-angle 55"), "{:#?}", read.lines);
    let (ly, lz, dx, dy, yr, zr) = (50.0, 120.0, 13.0, -27.0, 31.0, -120.0);
    let (sv, cv) = 55f64.to_radians().sin_cos();
    for [x, y, z, a, b, c] in samples() {
        let (sw, cw) = a.to_radians().sin_cos();
        let (ss, cs) = b.to_radians().sin_cos();
        let (sp, cp) = c.to_radians().sin_cos();
        let (r, s, t) = (cs + sv * sv * (1.0 - cs), cs + cv * cv * (1.0 - cs), sv * cv * (1.0 - cs));
        let (ray, raz) = (yr - dy - ly, zr - lz);
        let wanted = DVec3::new(
            -(cp * sv * ss - sp * t) * lz - cp * dx + (cp * cv * ss + sp * r) * ly + dy * sp + dx + x,
            -cp * cw * dy - cw * dx * sp - cw * (ray - y) - (cw * sp * sv * ss + cp * cw * t - sw * s) * lz
                + (cv * ss * cw * sp - cp * cw * r + sw * t) * ly
                + (raz - z) * sw
                + ray
                + dy
                + ly,
            -cp * dy * sw - dx * sp * sw - cw * (raz - z) - (sp * sv * ss * sw + cp * sw * t + cw * s) * lz
                + (cv * ss * sp * sw - cp * sw * r - cw * t) * ly
                - (ray - y) * sw
                + raz
                + lz,
        );
        let found = tip(&read.machine, &[('X', x), ('Y', y), ('Z', z), ('A', a), ('B', b), ('C', c)]);
        assert!((found - wanted).length() < 1e-10, "{found} {wanted}");
    }
}

#[test]
fn the_check_values_of_the_reported_sense() {
    // LinuxCNC issue 2435, conventional directions, no offsets: where the tip (1, 0, 2) is at B 90, and at C 90.
    let text = ini("xyzbc-trt-kins", "XYZBC", "mm", &["setp xyzbc-trt-kins.conventional-directions 1"]);
    let machine = import(("m.ini", &text), &[], None).unwrap().machine;
    let at = tip(&machine, &[('X', -2.0), ('Z', 1.0), ('B', 90.0)]);
    assert!((at - DVec3::new(1.0, 0.0, 2.0)).length() < 1e-12, "{at}");
    let at = tip(&machine, &[('Y', -1.0), ('Z', 2.0), ('C', 90.0)]);
    assert!((at - DVec3::new(1.0, 0.0, 2.0)).length() < 1e-12, "{at}");
}

#[test]
fn inches_become_millimetres_and_limits_are_those_of_the_joints() {
    let text = ini("xyzac-trt-kins", "XYZAC", "inch", &["setp xyzac-trt-kins.y-offset 2"]);
    let read = import(("m.ini", &text), &[], None).unwrap();
    let m = &read.machine;
    assert_eq!(m.joint('A').unwrap().1.point, DVec3::new(0.0, 50.8, 0.0));
    // Joints are numbered as the coordinates: X 0, Y 1, Z 2, A 3, C 4.
    assert!((m.travel('Y').unwrap()[0] + 91.0 * 25.4).abs() < 1e-9);
    assert!((m.travel('C').unwrap()[0].to_degrees() + 94.0).abs() < 1e-12);
    let (_, a) = m.joint('A').unwrap();
    assert!((a.dynamics.rapid.unwrap().to_degrees() - 30.0).abs() < 1e-12);
    assert!((m.joint('X').unwrap().1.dynamics.acceleration.unwrap() - 7620.0).abs() < 1e-9);
    assert_eq!((m.name.as_str(), read.module.as_str()), ("mill", "xyzac-trt-kins"));
    // Every line with a key is told once.
    let keys = text.lines().filter(|l| l.contains('=')).count();
    assert_eq!(read.lines.len(), keys);
    assert!(read.lines.iter().any(|l| l.text.contains("JOINT_5") && matches!(&l.fate, Fate::Ignored(_))));
    assert!(read.missing.iter().any(|m| m.name.contains("z-offset") && m.instead.starts_with('0')));
    assert!(read.remarks.iter().any(|r| r.contains("against ISO 841")), "{:?}", read.remarks);
    // And the machine file that is written of it is the same machine.
    let again = kinecut::job::machine::read("again.toml", &machine_toml(m)).unwrap();
    for at in samples() {
        let at: Vec<(char, f64)> = "XYZAC".chars().zip(at).collect();
        assert!((tip(m, &at) - tip(&again, &at)).length() < 1e-11);
    }
}

#[test]
fn a_limit_without_end_is_no_limit() {
    let text =
        ini("trivkins coordinates=XYZ", "XYZ", "mm", &[]).replace("MIN_LIMIT = -90", "MIN_LIMIT = -1e99");
    let read = import(("m.ini", &text), &[], None).unwrap();
    assert_eq!((read.machine.travel('X'), read.machine.travel('Y')), (None, Some([-91.0, 100.0])));
    assert_eq!(read.machine.code.to_string(), "2103");
}

#[test]
fn trivkins_with_rotary_axes_needs_a_code() {
    let text = ini("trivkins coordinates=XYZA", "XYZA", "mm", &[]);
    let error = import(("m.ini", &text), &[], None).unwrap_err();
    assert_eq!((error.code(), error.0.place.as_ref().unwrap().line), (Code::MACHINE_IMPORT, 7), "{error}");
    assert!(error.0.help.contains("--code"), "{error}");
    let code = kinecut::machine::CoordinateCode::parse("41203").unwrap();
    let read = import(("m.ini", &text), &[], Some(&code)).unwrap();
    assert!((read.machine.travel('A').unwrap()[0].to_degrees() + 93.0).abs() < 1e-12);
    let other = kinecut::machine::CoordinateCode::parse("61203").unwrap();
    assert_eq!(import(("m.ini", &text), &[], Some(&other)).unwrap_err().code(), Code::MACHINE_CODE);
}

#[test]
fn what_cannot_be_read_is_refused_with_its_line() {
    let good = ini("xyzac-trt-kins", "XYZAC", "mm", &["setp xyzac-trt-kins.y-offset 20"]);
    let cases: &[(&str, &str, u32, &str)] = &[
        ("KINEMATICS = xyzac-trt-kins", "KINEMATICS = maxkins", 7, "pivot by C"),
        ("KINEMATICS = xyzac-trt-kins", "KINEMATICS = genhexkins", 7, "not known"),
        ("KINEMATICS = xyzac-trt-kins", "KINEMATICS = xyzac-trt-kins coordinates=XYZA", 7, "coordinate C"),
        ("KINEMATICS = xyzac-trt-kins", "KINEMATICS = xyzac-trt-kins coordinates=XYQAC", 7, "`Q`"),
        ("KINEMATICS = xyzac-trt-kins", "KINEMATICS = xyzacb_trsrn", 0, "nut-angle"),
        ("KINEMATICS = xyzac-trt-kins", "NOTHING = 1", 0, "no kinematics module"),
        ("LINEAR_UNITS = mm", "LINEAR_UNITS = ell", 10, "`ell`"),
        ("ANGULAR_UNITS = deg", "ANGULAR_UNITS = hour", 11, "`hour`"),
        ("y-offset 20", "y-offset twenty", 13, "`twenty`"),
        ("MIN_LIMIT = -90", "MIN_LIMIT = low", 16, "`low`"),
        ("MIN_LIMIT = -90", "MIN_LIMIT -90", 16, "KEY = value"),
        ("MIN_LIMIT = -90", "MIN_LIMIT = 900", 0, "reversed"),
        ("[JOINT_0]", "[JOINT_0", 14, "not closed"),
    ];
    for (from, to, line, part) in cases {
        assert!(good.contains(from), "{from}");
        let error = import(("m.ini", &good.replacen(from, to, 1)), &[], None).expect_err(to);
        assert!(error.to_string().contains(part), "{to}: {error}");
        if *line > 0 {
            assert_eq!(error.0.place.as_ref().map(|p| p.line), Some(*line), "{to}: {error}");
        }
    }
}

#[test]
fn hal_files_are_named_by_the_ini_file() {
    let text = "[HAL]\nHALFILE = LIB:basic_sim.tcl\nHALFILE = mill.hal\nPOSTGUI_HALFILE = gui.hal\nHALFILE = a.tcl\n";
    assert_eq!(hal_files(text), ["mill.hal", "gui.hal"]);
    assert!(read("x.toml", text).is_err());
}
