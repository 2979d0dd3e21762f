//! Contact equations: where a moving tool touches the surface that it envelops.
//!
//! The tool is a chain with two variables, the machine a chain with one or more parameters of motion. The velocity of
//! the tool against the work, in the frame of the tool, is `V = v + w x q`; (w, v) is carried along the chain of the
//! machine: into the frame behind a link it goes by `w' = R^T w`, `v' = R^T (v + w x t)`, and the link adds its own rate.
//! Contact is where `n . V = 0` for each parameter; solved for a variable of the tool where that can be written down.

use glam::DVec3;

use super::super::formula::{cross, dot};
use super::super::{ChainElement, Matrix, ShapeFormula, Vector};
use crate::machine::formula::Expression;
use crate::machine::formula::{name_in_unicode, without_common_factors};

/// Tool, velocity and contact equations as formulas.
///
/// ```
/// # use kinecut_machine as kinecut;
/// use kinecut::machine::surface::{ContactEquations, parse_chain};
/// // The flank of a rack at the angle alpha rolls on the pitch circle rp.
/// let machine = parse_chain("6(phi) 1(rp) 2(-rp*phi)").unwrap();
/// let rack = parse_chain("6(alpha) 1(v) 3(z)").unwrap();
/// let contact = ContactEquations::new(&machine, &rack, ["v", "z"], &["phi"], [None; 3]);
/// assert_eq!(contact.equations()[0].to_string(), "rp*phi*sin(alpha) - v");
/// let v = &contact.equations()[0].zeros("v")[0];
/// assert_eq!(v.to_string(), "rp*phi*sin(alpha)");
/// let involute = contact.envelope(&[("v", v.clone())]);
/// assert_eq!(involute[2].to_string(), "z");
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ContactEquations {
    machine: ShapeFormula,
    tool: ShapeFormula,
    whole: ShapeFormula,
    parameters: Vec<String>,
    normal: Vector,
    velocities: Vec<Vector>,
    equations: Vec<Expression>,
}

impl ContactEquations {
    /// The contact of a tool with two variables that a machine moves by these parameters; one equation a parameter.
    /// `inclined` has the directions of the motions 7, 8, 9.
    pub fn new(
        machine: &[ChainElement],
        tool: &[ChainElement],
        variables: [&str; 2],
        parameters: &[&str],
        inclined: [Option<DVec3>; 3],
    ) -> ContactEquations {
        let whole: Vec<ChainElement> = machine.iter().chain(tool).cloned().collect();
        let [machine, tool, whole] = [machine, tool, &whole].map(|chain| ShapeFormula::new(chain, inclined));
        let names: Vec<&str> = variables.iter().chain(parameters).copied().collect();
        let normal = without_common_factors(&tool.normal(variables));
        let velocities: Vec<Vector> =
            parameters.iter().map(|parameter| velocity(&machine, tool.point(), parameter)).collect();
        let equations = velocities.iter().map(|v| dot(&normal, v).primitive(&names)).collect();
        let parameters = parameters.iter().map(|&name| name.to_owned()).collect();
        ContactEquations { machine, tool, whole, parameters, normal, velocities, equations }
    }

    /// The machine.
    pub fn machine(&self) -> &ShapeFormula {
        &self.machine
    }

    /// The tool.
    pub fn tool(&self) -> &ShapeFormula {
        &self.tool
    }

    /// A normal of the tool in its frame, of any length and sense.
    pub fn normal(&self) -> &Vector {
        &self.normal
    }

    /// Velocity of the tool's point against the work in the frame of the tool, by each parameter of motion [mm per unit
    /// of the parameter].
    pub fn velocities(&self) -> &[Vector] {
        &self.velocities
    }

    /// Expressions that vanish at contact, one for each parameter; without factors that hold neither a variable of the
    /// tool nor a parameter of motion.
    pub fn equations(&self) -> &[Expression] {
        &self.equations
    }

    /// The first of these variables for which each equation can be solved, with all its solutions; each variable for one
    /// equation. None for an equation that cannot be solved so.
    pub fn solutions<'a>(&self, variables: &[&'a str]) -> Vec<Option<(&'a str, Vec<Expression>)>> {
        let mut used: Vec<&str> = Vec::new();
        let solve = |equation: &Expression| {
            let free = variables.iter().copied().filter(|variable| !used.contains(variable));
            let found = free
                .map(|variable| (variable, equation.zeros(variable)))
                .find(|(_, zeros)| !zeros.is_empty());
            used.extend(found.iter().map(|(variable, _)| *variable));
            found
        };
        self.equations.iter().map(solve).collect()
    }

    /// The point of the work that is touched [mm], with variables replaced by their values at contact.
    pub fn envelope(&self, values: &[(&str, Expression)]) -> Vector {
        let with = |name: &str| values.iter().find(|(n, _)| *n == name).map(|(_, value)| value.clone());
        self.whole.point().each_ref().map(|x| x.substitute(&with).simplest())
    }

    /// Normal, velocity, equation, and its solutions for these variables where they can be written down; plain text.
    pub fn text(&self, solved: &[&str]) -> String {
        self.page(solved, Expression::to_string, |name| name.to_owned(), ". V")
    }

    /// The same in Unicode.
    pub fn unicode(&self, solved: &[&str]) -> String {
        self.page(solved, Expression::unicode, name_in_unicode, "· V")
    }

    fn page(
        &self,
        solved: &[&str],
        write: fn(&Expression) -> String,
        name: fn(&str) -> String,
        product: &str,
    ) -> String {
        let vector = |v: &Vector| format!("({})", v.each_ref().map(write).join(", "));
        let mut text = format!("n = {}\n", vector(&self.normal));
        let solutions = self.solutions(solved);
        for (i, parameter) in self.parameters.iter().enumerate() {
            let (velocity, equation) = (&self.velocities[i], &self.equations[i]);
            let by =
                if self.parameters.len() > 1 { format!(" by {}", name(parameter)) } else { String::new() };
            text += &format!("V{by} = {}\n", vector(velocity));
            text += &format!("n {product} = 0{by}: {} = 0\n", write(equation));
            if let Some((variable, zeros)) = &solutions[i] {
                let zeros: Vec<String> = zeros.iter().map(write).collect();
                text += &format!("{} = {}\n", name(variable), zeros.join(" or "));
            }
        }
        text
    }
}

/// Velocity of a point of the tool against the work in the frame of the tool, by a parameter.
fn velocity(machine: &ShapeFormula, point: &Vector, parameter: &str) -> Vector {
    let zero: Vector = std::array::from_fn(|_| Expression::number(0.0));
    let (mut spin, mut shift) = (zero.clone(), zero);
    for (element, matrix) in machine.chain().iter().zip(machine.matrices()) {
        let place: Vector = std::array::from_fn(|i| matrix.0[i][3].clone());
        let carried = cross(&spin, &place);
        let moved: Vector = std::array::from_fn(|i| &shift[i] + &carried[i]);
        spin = turned_back(matrix, &spin);
        shift = turned_back(matrix, &moved);
        let rate = element.law.derivative(parameter);
        let own = if element.motion.is_rotation() { &mut spin } else { &mut shift };
        for (i, component) in machine.direction(element.motion).into_iter().enumerate() {
            own[i] = (&own[i] + &(&rate * &component)).simplest();
        }
    }
    let turning = cross(&spin, point);
    std::array::from_fn(|i| (&shift[i] + &turning[i]).simplest())
}

/// A direction in the frame behind a motion.
fn turned_back(matrix: &Matrix, v: &Vector) -> Vector {
    std::array::from_fn(|i| {
        (0..3).fold(Expression::number(0.0), |sum, k| sum + &v[k] * &matrix.0[k][i]).simplest()
    })
}
