//! The catalogue of surfaces with their generating lines (after Reshetov and Portman, and Fedotenok).
//!
//! All of them are of outer material; of a bore `inward` is the other way round ([`GeneratedSurface::reversed`]).

use std::sync::LazyLock;

use super::{GeneratedSurface, Variable, parse_chain};
use crate::base::{Code, Finding, Result};
use crate::machine::formula::Expression;

/// A row of the catalogue; parameters and domains in mm and rad.
struct Row {
    name: &'static str,
    title: &'static str,
    parameters: &'static [(&'static str, f64)],
    variables: [(&'static str, f64, f64); 2],
    lines: [&'static str; 2],
    implicit: &'static str,
    inward: bool,
}

/// Most of a turn: the ends of a full one would coincide.
const TURN: f64 = 6.0;

const ROWS: &[Row] = &[
    Row {
        name: "plane",
        title: "plane by two straight lines (planing)",
        parameters: &[("h", 10.0)],
        variables: [("u", 0.0, 40.0), ("v", 0.0, 30.0)],
        lines: ["3(h) 2(u)", "1(v)"],
        implicit: "Z - h",
        inward: true,
    },
    Row {
        name: "plane-facing",
        title: "plane by circles and a radial line (facing)",
        parameters: &[("h", 10.0)],
        variables: [("phi", 0.0, TURN), ("r", 5.0, 30.0)],
        lines: ["3(h) 6(phi)", "1(r)"],
        implicit: "Z - h",
        inward: true,
    },
    Row {
        name: "cylinder",
        title: "circular cylinder",
        parameters: &[("R", 20.0)],
        variables: [("phi", 0.0, TURN), ("z", 0.0, 40.0)],
        lines: ["6(phi) 1(R)", "1(R) 3(z)"],
        implicit: "sqrt(X^2 + Y^2) - R",
        inward: false,
    },
    Row {
        name: "cone",
        title: "circular cone",
        parameters: &[("R", 30.0), ("alpha", 0.35)],
        variables: [("phi", 0.0, TURN), ("z", 0.0, 50.0)],
        lines: ["6(phi) 1(R)", "1(R) 5(-alpha) 3(z)"],
        implicit: "(sqrt(X^2 + Y^2) - R + Z*tan(alpha))*cos(alpha)",
        inward: false,
    },
    Row {
        name: "sphere",
        title: "sphere, its meridian by a rotation",
        parameters: &[("R", 25.0)],
        variables: [("phi", 0.0, TURN), ("th", 0.05, 1.5)],
        lines: ["6(phi)", "5(th) 3(R)"],
        implicit: "sqrt(X^2 + Y^2 + Z^2) - R",
        inward: true,
    },
    Row {
        name: "sphere-ring",
        title: "sphere by a tilted circle (cup wheel, whirling ring)",
        parameters: &[("rho", 15.0), ("h", 20.0), ("bet", 0.643_501_108_793_284_4)],
        variables: [("phi", 0.0, TURN), ("psi", 0.3, 2.8)],
        lines: ["6(phi)", "5(bet) 3(h) 6(psi) 1(rho)"],
        implicit: "sqrt(X^2 + Y^2 + Z^2) - sqrt(rho^2 + h^2)",
        inward: false,
    },
    Row {
        name: "torus",
        title: "torus",
        parameters: &[("R", 40.0), ("r", 12.0)],
        variables: [("phi", 0.0, TURN), ("th", -1.4, -0.1)],
        lines: ["6(phi) 1(R)", "1(R) 5(th) 1(r)"],
        implicit: "sqrt((sqrt(X^2 + Y^2) - R)^2 + Z^2) - r",
        inward: true,
    },
    Row {
        name: "revolution",
        title: "surface of revolution of a profile x = f(t), z = t",
        parameters: &[("R0", 30.0), ("a", 4.0), ("b", 0.12)],
        variables: [("phi", 0.0, TURN), ("t", 0.0, 40.0)],
        lines: ["6(phi)", "1(R0 + a*sin(b*t)) 3(t)"],
        implicit: "sqrt(X^2 + Y^2) - (R0 + a*sin(b*Z))",
        inward: false,
    },
    Row {
        name: "extrusion",
        title: "general cylinder: a contour extruded (a parabola)",
        parameters: &[("f", 15.0)],
        variables: [("t", -20.0, 20.0), ("z", 0.0, 30.0)],
        lines: ["1(t) 2(t^2/(4*f))", "3(z)"],
        implicit: "Y - X^2/(4*f)",
        inward: true,
    },
    Row {
        name: "elliptic-cylinder",
        title: "elliptic cylinder by two linked rotations (polygon turning), half axes r + e and r - e",
        parameters: &[("e", 6.0), ("r", 24.0)],
        variables: [("phi", 0.0, TURN), ("z", 0.0, 30.0)],
        lines: ["6(phi) 1(e) 6(-2*phi) 1(r)", "3(z)"],
        implicit: "(X/(e + r))^2 + (Y/(r - e))^2 - 1",
        inward: true,
    },
    Row {
        name: "hyperbolic-paraboloid",
        title: "hyperbolic paraboloid z = x y/c, ruled",
        parameters: &[("c", 40.0)],
        variables: [("u", -20.0, 20.0), ("v", 1.0, 30.0)],
        lines: ["1(u)", "4(atan(u/c)) 2(v)"],
        implicit: "Z - X*Y/c",
        inward: false,
    },
    Row {
        name: "ruled",
        title: "ruled surface: a ruling that tilts along a helix (flank milling, wire cutting)",
        parameters: &[("R", 30.0), ("k", 8.0), ("b0", 0.2), ("tau", 0.3)],
        variables: [("u", 0.0, 1.5), ("v", 0.0, 40.0)],
        lines: ["1(R*cos(u)) 2(R*sin(u)) 3(k*u)", "6(u) 5(b0 + tau*u) 3(v)"],
        implicit: "",
        inward: false,
    },
    Row {
        name: "right-helicoid",
        title: "right helicoid (flank of a square thread) of pitch p",
        parameters: &[("p", 12.0)],
        variables: [("phi", -3.0, 3.0), ("r", 10.0, 18.0)],
        lines: ["6(phi) 3(p*phi/(2*pi))", "1(r)"],
        implicit: "Z - p*atan2(Y, X)/(2*pi)",
        inward: true,
    },
    Row {
        name: "inclined-helicoid",
        title: "inclined helicoid (flank of a V thread) of pitch p",
        parameters: &[("p", 6.0), ("r0", 12.0), ("bet", std::f64::consts::FRAC_PI_6)],
        variables: [("phi", -3.0, 3.0), ("v", 0.0, 3.0)],
        lines: ["6(phi) 3(p*phi/(2*pi)) 1(r0)", "5(bet) 1(v)"],
        implicit: "(Z - p*atan2(Y, X)/(2*pi) + (sqrt(X^2 + Y^2) - r0)*tan(bet))*cos(bet)",
        inward: true,
    },
    Row {
        name: "screw",
        title: "screw surface of an axial profile (a complete thread) of pitch p",
        parameters: &[("p", 10.0), ("R0", 20.0), ("a", 2.0)],
        variables: [("phi", -3.0, 3.0), ("t", 0.0, 10.0)],
        lines: ["6(phi) 3(p*phi/(2*pi))", "1(R0 + a*cos(2*pi*t/p)) 3(t)"],
        implicit: "sqrt(X^2 + Y^2) - (R0 + a*cos(2*pi*(Z - p*atan2(Y, X)/(2*pi))/p))",
        inward: false,
    },
    Row {
        name: "cylindrical-cam",
        title: "track of a cylindrical cam with radial rulings, stroke H",
        parameters: &[("H", 16.0)],
        variables: [("phi", -3.0, 3.0), ("r", 25.0, 35.0)],
        lines: ["6(phi) 3(H/2*(1 - cos(phi)))", "1(r)"],
        implicit: "Z - H/2*(1 - cos(atan2(Y, X)))",
        inward: true,
    },
    Row {
        name: "involute-cylinder",
        title: "involute cylinder (flank of a spur gear): a straight edge rolling on the base circle rb",
        parameters: &[("rb", 40.0)],
        variables: [("phi", 0.05, 1.0), ("z", 0.0, 20.0)],
        lines: ["6(phi) 1(rb) 2(-rb*phi)", "3(z)"],
        implicit: "atan2(Y, X) - (sqrt((X^2 + Y^2)/rb^2 - 1) - atan(sqrt((X^2 + Y^2)/rb^2 - 1)))",
        inward: true,
    },
    Row {
        name: "hyperboloid",
        title: "hyperboloid of one sheet by a skew straight edge",
        parameters: &[("a", 20.0), ("bet", 0.4)],
        variables: [("phi", 0.0, TURN), ("v", -25.0, 25.0)],
        lines: ["6(phi) 1(a)", "4(bet) 3(v)"],
        implicit: "sqrt(X^2 + Y^2) - sqrt(a^2 + Z^2*tan(bet)^2)",
        inward: false,
    },
    Row {
        name: "scroll",
        title: "Archimedean scroll",
        parameters: &[("a", 30.0), ("b", 1.5)],
        variables: [("phi", -3.0, 3.0), ("z", 0.0, 8.0)],
        lines: ["6(phi) 1(a + b*phi)", "3(z)"],
        implicit: "sqrt(X^2 + Y^2) - (a + b*atan2(Y, X))",
        inward: false,
    },
];

impl Row {
    fn surface(&self) -> Result<GeneratedSurface> {
        let [directrix, generatrix] = self.lines;
        let implicit = (!self.implicit.is_empty()).then(|| Expression::parse(self.implicit)).transpose()?;
        Ok(GeneratedSurface {
            name: self.name.to_owned(),
            title: self.title.to_owned(),
            parameters: self.parameters.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect(),
            variables: self.variables.map(|(name, from, to)| Variable::new(name, from, to)),
            directrix: parse_chain(directrix)?,
            generatrix: parse_chain(generatrix)?,
            inward: self.inward,
            inclined: [None; 3],
            implicit,
        })
    }
}

static SURFACES: LazyLock<Vec<GeneratedSurface>> = LazyLock::new(|| {
    let read = |row: &Row| row.surface().expect("the rows are constants, and a test reads each of them");
    ROWS.iter().map(read).collect()
});

/// All surfaces of the catalogue, with their usual parameters and domains.
pub fn catalogue() -> &'static [GeneratedSurface] {
    &SURFACES
}

impl GeneratedSurface {
    /// The surface of the catalogue of this name.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::surface::GeneratedSurface;
    /// let cone = GeneratedSurface::named("cone").unwrap();
    /// assert_eq!(cone.code().to_string(), "6153");
    /// assert!(GeneratedSurface::named("kone").unwrap_err().to_string().contains("cone"));
    /// ```
    ///
    /// # Errors
    /// `KC1107` for a name that the catalogue does not have; the message has the nearest one.
    pub fn named(name: &str) -> Result<GeneratedSurface> {
        let wanted = name.trim().to_lowercase().replace(['_', ' '], "-");
        if let Some(found) = catalogue().iter().find(|s| s.name == wanted) {
            return Ok(found.clone());
        }
        let nearest = catalogue()
            .iter()
            .map(|s| (strsim::jaro_winkler(&s.name, &wanted), s.name.as_str()))
            .max_by(|a, b| a.0.total_cmp(&b.0))
            .map_or("", |(_, name)| name);
        let all = catalogue().iter().map(|s| s.name.as_str()).collect::<Vec<_>>().join(", ");
        Err(Finding::error(Code::SURFACE_UNKNOWN, format!("there is no surface `{name}`"))
            .help(format!("the nearest name is `{nearest}`; the catalogue has {all}"))
            .into())
    }

    /// The same surface with the material on its other side: of a shaft the bore.
    #[must_use]
    pub fn reversed(mut self) -> GeneratedSurface {
        self.inward = !self.inward;
        self.implicit = self.implicit.and_then(|f| Expression::parse(&format!("-({f})")).ok());
        self
    }
}
