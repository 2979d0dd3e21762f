//! Known envelopes: surfaces of the catalogue by touching and rolling, with the chains of machine and tool.
//!
//! The sense of the cutting speed of a turning tool does not enter: its body is what envelops.

use super::super::{GeneratedSurface, parse_chain};
use super::{ContactEquations, GeneratingMethod};
use crate::base::Result;
use crate::machine::formula::Expression;

/// A way to envelop a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnvelopeMethod {
    /// Name of the surface in the catalogue.
    pub surface: &'static str,
    /// Touching or rolling.
    pub method: GeneratingMethod,
    /// Name of the process.
    pub process: &'static str,
    /// Chain of the machine, in parameters of the surface and `extra`.
    pub machine: &'static str,
    /// Chain of the tool.
    pub tool: &'static str,
    /// Variables of the tool: that for which the contact is solved, and the other.
    pub variables: [&'static str; 2],
    /// Parameters of the motion.
    pub parameters: &'static [&'static str],
    /// For each parameter, index of the solution that is the side of the tool that makes the surface.
    pub sides: &'static [usize],
    /// Further parameters, with usual values [mm or rad] as formulas in the surface's parameters.
    pub extra: &'static [(&'static str, &'static str)],
    /// Workpiece placement that makes this envelope equal to the catalogue surface, as a chain before the machine's;
    /// empty: no placement needed.
    pub place: &'static str,
    /// Lead of the surface's variable over the parameter of the same name at contact, as a formula; empty: zero.
    pub ahead: &'static str,
    /// Relation of the envelope to the surface.
    pub makes: Makes,
}

/// Relation of an envelope to the surface that it is listed for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Makes {
    /// The surface itself.
    Surface,
    /// Walls on both sides of it, as a roller of the tool's size needs them.
    Walls,
    /// A surface that is near it, because the profile of the tool is given and not derived from it.
    Near,
}

const NONE: EnvelopeMethod = EnvelopeMethod {
    surface: "",
    method: GeneratingMethod::Touching,
    process: "",
    machine: "",
    tool: "",
    variables: ["psi", "z"],
    parameters: &["phi"],
    sides: &[0],
    extra: &[("rho", "8")],
    place: "",
    ahead: "",
    makes: Makes::Surface,
};

const ENVELOPES: &[EnvelopeMethod] = &[
    EnvelopeMethod {
        surface: "plane",
        process: "peripheral milling",
        machine: "3(h + rho) 1(v)",
        tool: "5(psi) 3(rho) 2(u)",
        variables: ["psi", "u"],
        parameters: &["v"],
        sides: &[1],
        ..NONE
    },
    EnvelopeMethod {
        surface: "cylinder",
        process: "cylindrical grinding, orbital milling",
        machine: "6(phi) 1(R + rho)",
        tool: "6(psi) 1(rho) 3(z)",
        sides: &[1],
        ..NONE
    },
    EnvelopeMethod {
        surface: "cone",
        process: "taper grinding",
        machine: "6(phi) 1(R) 5(-alpha) 1(rho)",
        tool: "6(psi) 1(rho) 3(z)",
        sides: &[1],
        ..NONE
    },
    EnvelopeMethod {
        surface: "sphere",
        process: "ball-end milling",
        machine: "6(phi) 5(th) 3(R + rho)",
        tool: "4(chi) 5(psi) 3(rho)",
        variables: ["psi", "chi"],
        parameters: &["th", "phi"],
        sides: &[0, 1],
        ..NONE
    },
    EnvelopeMethod {
        surface: "torus",
        process: "ball-end milling",
        machine: "6(phi) 1(R) 5(th) 1(r + rho)",
        tool: "6(chi) 5(psi) 1(rho)",
        variables: ["psi", "chi"],
        parameters: &["th", "phi"],
        sides: &[0, 1],
        ..NONE
    },
    EnvelopeMethod {
        surface: "revolution",
        process: "profile grinding",
        machine: "6(phi) 1(D)",
        tool: "6(psi) 1(D - R0 - a*sin(b*t)) 3(t)",
        variables: ["psi", "t"],
        sides: &[1],
        extra: &[("D", "2*R0")],
        ..NONE
    },
    EnvelopeMethod {
        surface: "extrusion",
        process: "end milling",
        machine: "1(t) 2(t^2/(4*f)) 6(atan(t/(2*f))) 2(rho)",
        tool: "6(psi) 1(rho) 3(z)",
        parameters: &["t"],
        sides: &[1],
        ..NONE
    },
    EnvelopeMethod {
        surface: "scroll",
        process: "end milling",
        machine: "6(phi) 1(a + b*phi) 6(-atan(b/(a + b*phi))) 1(rho)",
        tool: "6(psi) 1(rho) 3(z)",
        sides: &[1],
        ..NONE
    },
    EnvelopeMethod {
        surface: "cylindrical-cam",
        process: "milling with a cutter of the roller's radius",
        machine: "6(phi) 3(H/2*(1 - cos(phi)))",
        tool: "1(r) 4(psi) 2(rho)",
        variables: ["psi", "r"],
        extra: &[("rho", "5")],
        makes: Makes::Walls,
        ..NONE
    },
    EnvelopeMethod {
        surface: "screw",
        process: "thread grinding with an inclined wheel",
        machine: "6(phi) 3(p*phi/(2*pi)) 1(D) 4(tilt)",
        tool: "6(psi) 1(rho + t) 3(t*tan(flank))",
        variables: ["psi", "t"],
        sides: &[0],
        extra: &[("D", "R0 + 30"), ("tilt", "atan(p/(2*pi*R0))"), ("rho", "30"), ("flank", "pi/12")],
        makes: Makes::Near,
        ..NONE
    },
    EnvelopeMethod {
        surface: "involute-cylinder",
        method: GeneratingMethod::Rolling,
        process: "rack planing, grinding with a plane wheel",
        machine: "6(phi) 1(rp) 2(-rp*phi)",
        tool: "6(alpha) 1(v) 3(z)",
        variables: ["v", "z"],
        extra: &[("alpha", "pi/9"), ("rp", "rb/cos(pi/9)")],
        place: "6(tan(alpha) - alpha)",
        ahead: "tan(alpha)",
        ..NONE
    },
    EnvelopeMethod {
        surface: "involute-cylinder",
        method: GeneratingMethod::Rolling,
        process: "pinion shaping",
        machine: "6(phi) 1(A) 6(phi*rb/rt)",
        tool: "6(psi) 1(rt) 2(-rt*psi) 3(z)",
        // The line of contact is (rb + rt) tan(aw) long; it must hold the longest roll of the flank.
        extra: &[("rt", "rb"), ("aw", "pi/6"), ("A", "(rb + rt)/cos(aw)")],
        place: "6((1 + rt/rb)*(tan(aw) - aw) - pi*rt/rb)",
        ahead: "aw - pi*rt/rb + (1 + rt/rb)*(tan(aw) - aw)",
        sides: &[1],
        ..NONE
    },
];

/// The known ways to envelop a surface of the catalogue.
///
/// ```
/// # use kinecut_machine as kinecut;
/// use kinecut::machine::surface::envelopes;
/// let rack = envelopes("involute-cylinder").next().unwrap();
/// assert_eq!(rack.contact().unwrap().equations()[0].to_string(), "rp*phi*sin(alpha) - v");
/// ```
pub fn envelopes(surface: &str) -> impl Iterator<Item = &'static EnvelopeMethod> {
    let surface = surface.to_owned();
    ENVELOPES.iter().filter(move |envelope| envelope.surface == surface)
}

/// The known ways to envelop a surface that has the chain of one of the catalogue, whatever its name, parameters and domain.
///
/// ```
/// # use kinecut_machine as kinecut;
/// use kinecut::machine::surface::{envelopes_of, GeneratedSurface};
/// let shaft = GeneratedSurface { name: "journal".into(), ..GeneratedSurface::named("cylinder").unwrap() };
/// assert_eq!(envelopes_of(&shaft).count(), 1);
/// ```
pub fn envelopes_of(surface: &GeneratedSurface) -> impl Iterator<Item = &'static EnvelopeMethod> + use<> {
    let like = |envelope: &&EnvelopeMethod| {
        GeneratedSurface::named(envelope.surface).is_ok_and(|own| {
            let names = |s: &GeneratedSurface| s.variables.each_ref().map(|v| v.name.clone());
            own.chain() == surface.chain() && names(&own) == names(surface)
        })
    };
    let found: Vec<&'static EnvelopeMethod> = ENVELOPES.iter().filter(like).collect();
    found.into_iter()
}

impl EnvelopeMethod {
    /// The contact of tool and surface.
    ///
    /// # Errors
    /// Those of [`parse_chain`]; the known envelopes have none.
    pub fn contact(&self) -> Result<ContactEquations> {
        let (machine, tool) = (parse_chain(self.machine)?, parse_chain(self.tool)?);
        Ok(ContactEquations::new(&machine, &tool, self.variables, self.parameters, [None; 3]))
    }

    /// The variables of the tool at contact on the side that makes the surface; `None` where an equation cannot be
    /// solved as a formula.
    pub fn solution(&self, contact: &ContactEquations) -> Option<Vec<(&'static str, Expression)>> {
        let side = |(i, found): (usize, Option<(&'static str, Vec<Expression>)>)| {
            let (variable, zeros) = found?;
            let chosen = self.sides.get(i).copied().unwrap_or(0);
            zeros.into_iter().nth(chosen).map(|zero| (variable, zero))
        };
        contact.solutions(&self.variables).into_iter().enumerate().map(side).collect()
    }

    /// Values of the parameters of a surface, and of those that the envelope adds [mm or rad]. Where the material is on
    /// the other side than in the catalogue the tool's radius `rho` counts negative: it is then on the other side too.
    ///
    /// # Errors
    /// `KC1101` and `KC1102`; the known envelopes of the catalogue have none.
    pub fn values(&self, surface: &GeneratedSurface) -> Result<Vec<(String, f64)>> {
        let mut values = surface.parameters.clone();
        for (name, formula) in self.extra {
            let names: Vec<&str> = values.iter().map(|(n, _)| n.as_str()).collect();
            let numbers: Vec<f64> = values.iter().map(|(_, value)| *value).collect();
            let value = Expression::parse(formula)?.bind(&names)?.value(&numbers);
            let turned = *name == "rho" && self.is_turned(surface);
            values.push(((*name).to_owned(), if turned { -value } else { value }));
        }
        Ok(values)
    }

    /// True if the material of a surface is on the other side than in the catalogue.
    fn is_turned(&self, surface: &GeneratedSurface) -> bool {
        GeneratedSurface::named(self.surface).is_ok_and(|own| own.inward != surface.inward)
    }
}
