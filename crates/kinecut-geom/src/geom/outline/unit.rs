//! Units of length of drawings.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Unit of the numbers of a drawing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
pub enum LengthUnit {
    /// A thousandth of a millimetre.
    #[serde(rename = "um")]
    Micrometre,
    /// Millimetre.
    #[serde(rename = "mm")]
    Millimetre,
    /// Centimetre.
    #[serde(rename = "cm")]
    Centimetre,
    /// Decimetre.
    #[serde(rename = "dm")]
    Decimetre,
    /// Metre.
    #[serde(rename = "m")]
    Metre,
    /// A thousandth of an inch.
    #[serde(rename = "thou")]
    Thou,
    /// Inch.
    #[serde(rename = "in")]
    Inch,
    /// Foot.
    #[serde(rename = "ft")]
    Foot,
    /// Printer's point, 1/72 inch.
    #[serde(rename = "pt")]
    Point,
    /// Pica, 12 points.
    #[serde(rename = "pc")]
    Pica,
    /// Pixel of the web, 1/96 inch.
    #[serde(rename = "px")]
    Pixel,
}

impl LengthUnit {
    /// All units.
    pub const ALL: [LengthUnit; 11] = {
        use LengthUnit::{
            Centimetre, Decimetre, Foot, Inch, Metre, Micrometre, Millimetre, Pica, Pixel, Point, Thou,
        };
        [Micrometre, Millimetre, Centimetre, Decimetre, Metre, Thou, Inch, Foot, Point, Pica, Pixel]
    };

    /// Its length [mm].
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use kinecut::geom::LengthUnit;
    /// assert_eq!(LengthUnit::Inch.mm(), 25.4);
    /// assert_eq!(LengthUnit::of_dxf(4), Some(LengthUnit::Millimetre));
    /// assert_eq!(LengthUnit::of_dxf(0), None);
    /// ```
    pub fn mm(self) -> f64 {
        match self {
            LengthUnit::Micrometre => 1e-3,
            LengthUnit::Millimetre => 1.0,
            LengthUnit::Centimetre => 10.0,
            LengthUnit::Decimetre => 100.0,
            LengthUnit::Metre => 1000.0,
            LengthUnit::Thou => 0.0254,
            LengthUnit::Inch => 25.4,
            LengthUnit::Foot => 304.8,
            LengthUnit::Point => 25.4 / 72.0,
            LengthUnit::Pica => 25.4 / 6.0,
            LengthUnit::Pixel => 25.4 / 96.0,
        }
    }

    /// Its short name, as in files: "mm", "in".
    pub fn symbol(self) -> &'static str {
        match self {
            LengthUnit::Micrometre => "um",
            LengthUnit::Millimetre => "mm",
            LengthUnit::Centimetre => "cm",
            LengthUnit::Decimetre => "dm",
            LengthUnit::Metre => "m",
            LengthUnit::Thou => "thou",
            LengthUnit::Inch => "in",
            LengthUnit::Foot => "ft",
            LengthUnit::Point => "pt",
            LengthUnit::Pica => "pc",
            LengthUnit::Pixel => "px",
        }
    }

    /// The unit of a number of the DXF variable `$INSUNITS`; `None` for 0 (no unit) and units that no part has.
    pub fn of_dxf(number: i64) -> Option<LengthUnit> {
        match number {
            1 => Some(LengthUnit::Inch),
            2 => Some(LengthUnit::Foot),
            4 => Some(LengthUnit::Millimetre),
            5 => Some(LengthUnit::Centimetre),
            6 => Some(LengthUnit::Metre),
            9 => Some(LengthUnit::Thou),
            13 => Some(LengthUnit::Micrometre),
            14 => Some(LengthUnit::Decimetre),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_in_files_are_the_symbols() {
        for unit in LengthUnit::ALL {
            assert_eq!(serde_json::to_value(unit).unwrap(), unit.symbol());
        }
        assert!((12.0 * LengthUnit::Point.mm() - LengthUnit::Pica.mm()).abs() < 1e-15);
    }
}
