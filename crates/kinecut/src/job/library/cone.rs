//! Conical cutters as other systems give them: tip, largest diameter, angle, and the height of the edges.

use super::LibraryTool;
use super::fields::rounded;

/// Share by which a stated height may be off from that of the cone, by rounding.
const ROUNDED: f64 = 1e-3;

/// The names of the fields of a conical cutter in its file.
pub(super) struct ConeKeys {
    /// Diameter of the tip.
    pub(super) tip: &'static str,
    /// Largest diameter.
    pub(super) largest: &'static str,
    /// Angle.
    pub(super) angle: &'static str,
    /// Height of the edges.
    pub(super) height: &'static str,
}

/// A conical cutter by the diameter of its tip [mm], half its angle (degrees), and the largest diameter and the height of its edges as
/// they are in the table. The cone ends at the largest diameter; a file that states a lower end contradicts itself.
pub(super) fn cone(tool: &mut LibraryTool, tip: Option<f64>, half: Option<f64>, keys: &ConeKeys) {
    tool.table.half_angle = half;
    if !tool.has("diameter") {
        // The diameter of a table is that of the tip: with angle and height it is the whole cone.
        tool.missing.retain(|missing| missing.key != "diameter");
        match tip {
            Some(tip) => tool.table.diameter = tip,
            None => tool.lacks("diameter", format!("that of the tip: no {}", keys.tip)),
        }
        if half.is_none() {
            tool.lacks("half_angle", format!("no {}", keys.angle));
        }
        return;
    }
    let largest = tool.table.diameter;
    match height(tool, tip.unwrap_or(0.0), half, keys) {
        Ok(high) => {
            let said = tool.table.flute_length;
            if tool.has("flute_length") && said > high * (1.0 + ROUNDED) {
                let said = rounded(said);
                tool.dropped.push(format!("{} ({said} mm: the cone ends at the diameter)", keys.height));
            }
            tool.missing.retain(|missing| missing.key != "flute_length");
            tool.table.flute_length = high;
            if tip.is_none() {
                tool.assumed.push(format!("a sharp tip, as there is no {}", keys.tip));
            }
        }
        Err((key, why)) => {
            if key == "half_angle" {
                tool.table.half_angle = None;
            }
            tool.lacks(key, why);
            let largest = rounded(largest);
            tool.dropped.push(format!("{} ({largest} mm, the largest diameter)", keys.largest));
            if tip.is_none() {
                tool.lacks("diameter", format!("that of the tip: no {}", keys.tip));
            }
        }
    }
    tool.table.diameter = tip.unwrap_or(0.0);
}

/// The height of a cone from its tip to its largest diameter [mm]; or the key that is lacking then, and the reason.
fn height(
    tool: &LibraryTool,
    tip: f64,
    half: Option<f64>,
    keys: &ConeKeys,
) -> Result<f64, (&'static str, String)> {
    let Some(half) = half else { return Err(("half_angle", format!("no {}", keys.angle))) };
    let (largest, said) = (tool.table.diameter, tool.table.flute_length);
    let high = (largest - tip) / 2.0 / half.to_radians().tan();
    if high.is_nan() || high <= 0.0 {
        return Err(("flute_length", "the tip is not narrower than the tool".to_owned()));
    }
    if tool.has("flute_length") && said < high * (1.0 - ROUNDED) {
        let [said, high, half, tip, largest] = [said, high, half, tip, largest].map(rounded);
        let why = format!(
            "{} is {said} mm, but half an angle of {half} degrees needs {high} mm from {tip} mm to {largest} mm",
            keys.height
        );
        return Err(("half_angle", why));
    }
    Ok(high)
}
