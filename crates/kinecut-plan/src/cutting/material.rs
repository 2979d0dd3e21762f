//! Materials of parts.

use super::CuttingForce;
use super::materials::MATERIALS;
use super::start::StartRow;

/// A material with its constants, as far as they are known.
#[derive(Debug, PartialEq)]
pub struct Material {
    /// The name by which it is shown.
    pub name: &'static str,
    /// Other names of it: numbers and names of EN, of AISI, older ones.
    pub aliases: &'static [&'static str],
    /// Its group.
    pub group: MaterialGroup,
    /// Its cutting force.
    pub force: Option<CuttingForce>,
    /// Whether the constants of its force follow from a table of measured forces; if not they are those of handbooks.
    pub force_is_checked: bool,
    pub(super) start: Option<StartRow>,
}

/// Groups of materials.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MaterialGroup {
    /// Steel, and cast steel.
    Steel,
    /// Stainless steel.
    Stainless,
    /// Cast iron.
    Iron,
    /// Aluminium, brass.
    NonFerrous,
    /// Titanium.
    Titanium,
    /// Plastics: no force is known.
    Plastic,
}

/// Letters and digits of a name alone.
fn plain(name: &str) -> String {
    name.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

impl Material {
    /// The material of a name; case, spaces, hyphens and points do not count, nor does "EN" or "AISI" before it.
    ///
    /// ```
    /// # use kinecut_plan as kinecut;
    /// use kinecut::cutting::Material;
    /// assert_eq!(Material::of("aisi 1045").unwrap().name, "C45");
    /// assert_eq!(Material::of("EN-GJL-250").unwrap().name, "GJL-250");
    /// assert!(Material::of("C46").is_none());
    /// ```
    pub fn of(name: &str) -> Option<&'static Material> {
        let whole = plain(name);
        let short = ["en", "aisi"].iter().find_map(|prefix| whole.strip_prefix(prefix));
        let is_it = |material: &&Material| {
            material.names().any(|own| {
                let own = plain(own);
                own == whole || short == Some(own.as_str())
            })
        };
        MATERIALS.iter().find(is_it)
    }

    /// All materials.
    pub fn all() -> &'static [Material] {
        MATERIALS
    }

    /// Its name, then the others.
    pub fn names(&self) -> impl Iterator<Item = &'static str> {
        std::iter::once(self.name).chain(self.aliases.iter().copied())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_name_has_two_materials() {
        let mut seen = std::collections::BTreeMap::new();
        for material in Material::all() {
            for name in material.names() {
                let other = seen.insert(plain(name), material.name);
                assert!(other.is_none(), "{name}: {other:?} and {}", material.name);
                assert_eq!(Material::of(name).map(|m| m.name), Some(material.name));
            }
        }
    }

    #[test]
    fn materials_with_start_values_are_those_of_the_table() {
        let all: Vec<&str> = Material::all().iter().filter(|m| m.start.is_some()).map(|m| m.name).collect();
        let table =
            ["C45", "42CrMo4", "1.4301", "GJL-250", "Al wrought", "CuZn39Pb3", "POM", "PA", "Ti6Al4V"];
        assert_eq!(all.len(), table.len());
        assert!(table.iter().all(|name| all.contains(name)), "{all:?}");
    }
}
