//! Shape-generation functions for reading: plain text, Unicode, MathML.

use super::{Matrix, ShapeFormula};
use crate::machine::formula::Expression;

/// Writer of a formula.
type Writer = fn(&Expression) -> String;

fn plain(formula: &Expression) -> String {
    formula.to_string()
}

impl Matrix {
    /// Four rows of text with aligned columns, entries as they can be read again.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::formula::Expression;
    /// use kinecut::machine::{Elementary, surface::Matrix};
    /// let turned = Matrix::of(Elementary::C, &Expression::parse("-f").unwrap(), glam::DVec3::Z);
    /// assert_eq!(turned.rows_text()[1], "| -sin(f)  cos(f)  0  0 |");
    /// ```
    pub fn rows_text(&self) -> [String; 4] {
        self.rows(plain)
    }

    /// Four rows of Unicode text with aligned columns.
    pub fn rows_unicode(&self) -> [String; 4] {
        self.rows(Expression::unicode)
    }

    fn rows(&self, write: Writer) -> [String; 4] {
        let entries = self.0.each_ref().map(|row| row.each_ref().map(write));
        let widths: [usize; 4] =
            std::array::from_fn(|k| entries.iter().map(|row| row[k].chars().count()).max().unwrap_or(0));
        entries.map(|row| {
            let cells = row.iter().zip(widths);
            let cells = cells.map(|(cell, width)| cell.clone() + &" ".repeat(width - cell.chars().count()));
            format!("| {} |", cells.collect::<Vec<_>>().join("  "))
        })
    }

    /// A MathML table in brackets: the content of `<math>...</math>`.
    pub fn mathml(&self) -> String {
        let row = |row: &[Expression; 4]| {
            let cells: String = row.iter().map(|cell| format!("<mtd>{}</mtd>", cell.mathml())).collect();
            format!("<mtr>{cells}</mtr>")
        };
        let rows: String = self.0.iter().map(row).collect();
        format!("<mrow class=\"matrix\"><mo>(</mo><mtable>{rows}</mtable><mo>)</mo></mrow>")
    }
}

impl ShapeFormula {
    /// The product of the matrices by name: `r0 = A6(phi) A1(R) A5(-alpha) A3(z) e4`.
    pub fn product_text(&self) -> String {
        let factors: String = self.chain().iter().map(|e| format!("A{}({}) ", e.motion, e.law)).collect();
        format!("r0 = {factors}e4")
    }

    /// The product of the matrices by name in Unicode: `r₀ = A⁶(φ) A¹(R) A⁵(−α) A³(z) e⁴`.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::surface::GeneratedSurface;
    /// let cone = GeneratedSurface::named("cone").unwrap().formula();
    /// assert_eq!(cone.product_unicode(), "r₀ = A⁶(φ) A¹(R) A⁵(−α) A³(z) e⁴");
    /// assert_eq!(cone.point_unicode(), "((R − z·sin α)·cos φ, (R − z·sin α)·sin φ, z·cos α)");
    /// ```
    pub fn product_unicode(&self) -> String {
        let raised = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
        let factor = |digit: u8, law: &Expression| {
            format!("A{}({}) ", raised[usize::from(digit.min(9))], law.unicode())
        };
        let factors: String = self.chain().iter().map(|e| factor(e.motion.digit(), &e.law)).collect();
        format!("r₀ = {factors}e⁴")
    }

    /// The point in one line, each coordinate as it can be read again: `(x, y, z)`.
    pub fn point_text(&self) -> String {
        format!("({})", self.point().each_ref().map(plain).join(", "))
    }

    /// The point in one line of Unicode text.
    pub fn point_unicode(&self) -> String {
        format!("({})", self.point().each_ref().map(Expression::unicode).join(", "))
    }

    /// Everything in plain text: the product by name, each matrix with its entries, the point.
    pub fn text(&self) -> String {
        let name = |motion: u8, law: &Expression| format!("A{motion}({law}) = ");
        self.page(&self.product_text(), Matrix::rows_text, name, &format!("r0 = {}", self.point_text()))
    }

    /// Everything in Unicode text: the product by name, each matrix with its entries, the point.
    pub fn unicode(&self) -> String {
        let name = |motion: u8, law: &Expression| format!("A{motion}({}) = ", law.unicode());
        self.page(
            &self.product_unicode(),
            Matrix::rows_unicode,
            name,
            &format!("r₀ = {}", self.point_unicode()),
        )
    }

    fn page(
        &self,
        product: &str,
        rows: fn(&Matrix) -> [String; 4],
        name: impl Fn(u8, &Expression) -> String,
        point: &str,
    ) -> String {
        /// Index of the row next to which the name is written.
        const NAMED: usize = 1;
        let mut text = format!("{product}\n\n");
        for (element, matrix) in self.chain().iter().zip(self.matrices()) {
            let name = name(element.motion.digit(), &element.law);
            let blank = " ".repeat(name.chars().count());
            for (i, row) in rows(matrix).iter().enumerate() {
                text += if i == NAMED { &name } else { &blank };
                text += row;
                text.push('\n');
            }
            text.push('\n');
        }
        text + point + "\n"
    }

    /// The product of the matrices with their entries, and the point: one `<math>` element for a report.
    pub fn mathml(&self) -> String {
        let radius = "<msub><mi>r</mi><mn>0</mn></msub><mo>=</mo>";
        let names: String = self
            .chain()
            .iter()
            .map(|e| {
                let law = e.law.mathml();
                format!("<mrow><msup><mi>A</mi><mn>{}</mn></msup><mo>(</mo>{law}<mo>)</mo></mrow>", e.motion)
            })
            .collect();
        let matrices: String = self.matrices().iter().map(Matrix::mathml).collect();
        let row = |formula: String| format!("<mtr><mtd>{formula}</mtd></mtr>");
        let one = Expression::number(1.0);
        let column = |point: &[Expression; 3]| {
            let rows: String = point.iter().chain([&one]).map(|x| row(x.mathml())).collect();
            format!("<mrow class=\"matrix\"><mo>(</mo><mtable>{rows}</mtable><mo>)</mo></mrow>")
        };
        let zero: [Expression; 3] = std::array::from_fn(|_| Expression::number(0.0));
        format!(
            "<math xmlns=\"http://www.w3.org/1998/Math/MathML\" display=\"block\"><mrow>{radius}{names}\
             <msup><mi>e</mi><mn>4</mn></msup><mo>=</mo>{matrices}{}<mo>=</mo>{}</mrow></math>",
            column(&zero),
            column(self.point()),
        )
    }
}
