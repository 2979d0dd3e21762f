//! The macro that makes the tables, the checked operations and the plans of all kinds one type each, from one list.

/// For each kind: its documentation, its variant, its name in the job file, the types of table, checked operation and plan.
macro_rules! kinds {
    ($($(#[$doc:meta])* $kind:ident $name:literal ($table:ty, $checked:ty, $plan:ty),)*) => {
        use std::sync::Arc;

        use schemars::JsonSchema;
        use serde::{Deserialize, Serialize};

        use self::edge::FaceEdges;
        use self::face::FacingTable;
        use self::kind::{Checked as _, Plan as _, Table as _};
        use self::named::NamedOutline;
        use self::measured::{Loose, Proof, TakenOut};
        use self::wanted::{PlannedOutline, WantedPlane, WantedWall};
        use crate::base::{Finding, Result};
        use crate::cutting::MillingCut;
        use crate::page::Section;
        use crate::program::Setup;

        /// An operation.
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(tag = "type")]
        pub enum OperationTable {
            $($(#[$doc])* #[serde(rename = $name)] $kind(Box<$table>),)*
        }

        /// A checked operation.
        #[derive(Clone, Debug)]
                pub enum Operation {
            $($(#[$doc])* $kind(Arc<$checked>),)*
        }

        /// The plan of an operation.
        #[derive(Clone, Debug)]
                pub enum OperationPlan {
            $($(#[$doc])* $kind(Box<$plan>),)*
        }

        impl OperationTable {
            /// Names of all kinds in the job file, in their order.
            pub const NAMES: &'static [&'static str] = &[$($name),*];

            /// The table of a kind, made by `decode`; `None` for a name that is no kind.
            pub(crate) fn of_kind<D: Decode>(
                name: &str,
                decode: D,
            ) -> Option<Result<OperationTable>> {
                match name {
                    $($name => Some(decode.table::<$table>().map(|t| OperationTable::$kind(Box::new(t)))),)*
                    _ => None,
                }
            }

            /// Checks the table; `complete` gives the checked operation its tilted plane.
            ///
            /// # Errors
            /// One finding with the key of the first wrong value, counted from the table.
            pub(crate) fn check(
                &self,
                around: &Around<'_>,
                complete: impl Fn(&PlaneTable) -> Result<JobPlane>,
            ) -> Result<Operation> {
                match self {
                    $(OperationTable::$kind(table) => {
                        let mut checked = table.check(around)?;
                        if let Some(plane) = table.plane() {
                            checked.milling_mut().plane = Some(complete(plane).map_err(|e| e.under("plane"))?);
                        }
                        Ok(Operation::$kind(Arc::new(checked)))
                    })*
                }
            }

            /// The tool that it calls.
            pub(crate) fn called(&mut self) -> &mut CalledTool {
                match self { $(OperationTable::$kind(table) => table.called(),)* }
            }

            /// The keys of its speed and feed that may be left out where the tool has data for the material.
            pub(crate) fn data(&mut self) -> Option<CuttingKeys<'_>> {
                match self { $(OperationTable::$kind(table) => table.data(),)* }
            }

            /// The outline along which it works, under the name by which others may refer to it.
            pub(crate) fn named_outline(&self) -> Option<NamedOutline<'_>> {
                match self { $(OperationTable::$kind(table) => table.named_outline(),)* }
            }

            /// Itself, if it mills a face.
            pub(crate) fn face(&self) -> Option<&FacingTable> {
                match self { $(OperationTable::$kind(table) => table.face(),)* }
            }

            /// The file that it names, with the role that the file has in a verdict.
            pub(crate) fn file(&self) -> Option<(&'static str, &str)> {
                match self { $(OperationTable::$kind(table) => table.file(),)* }
            }
        }

        impl Operation {
            /// Tool, speed, coolant, tolerance.
            pub fn milling(&self) -> &Milling {
                match self { $(Operation::$kind(o) => o.milling(),)* }
            }

            /// A person's name for it: kind, size, place.
            pub fn name(&self) -> String {
                match self { $(Operation::$kind(o) => o.name(),)* }
            }

            /// Whether its tool cuts left-handed.
            pub(crate) fn is_left_hand(&self) -> bool {
                match self { $(Operation::$kind(o) => o.is_left_hand(),)* }
            }

            /// The nouns by which the measured shapes of all kinds are counted, empty ones among them.
            pub(crate) const NOUNS: &'static [&'static str] = &[$(<$checked as kind::Checked>::NOUN),*];

            /// The noun by which its measured shapes are counted.
            pub(crate) fn noun(&self) -> &'static str {
                match self { $(Operation::$kind(_) => <$checked as kind::Checked>::NOUN,)* }
            }

            /// The surface that it leaves, where that is compared with nothing.
            pub(crate) fn not_compared(&self) -> Option<&'static str> {
                match self { $(Operation::$kind(o) => o.not_compared(),)* }
            }

            /// Passes along the finished wall that take off what the tool's deflection left.
            pub(crate) fn spring_passes(&self) -> u32 {
                match self { $(Operation::$kind(o) => o.spring_passes(),)* }
            }

            /// The cut of a straight stretch of its finishing, on which the wall's place depends.
            pub(crate) fn finishing(&self) -> Option<MillingCut> {
                match self { $(Operation::$kind(o) => o.finishing(),)* }
            }

            /// The outline that has to lie in the stock.
            pub(crate) fn outline(&self) -> Option<PlannedOutline> {
                match self { $(Operation::$kind(o) => o.outline(),)* }
            }

            /// A warning if the raw stock is this high over its zero [mm] and it is the first operation of all.
            pub(crate) fn under_stock(&self, top: f64) -> Option<Finding> {
                match self { $(Operation::$kind(o) => o.under_stock(top),)* }
            }

            /// Plans it.
            ///
            /// # Errors
            /// One finding with a key counted from the table.
            pub(crate) fn plan(&self, setting: &Setting<'_>) -> Result<Attempt<OperationPlan>> {
                match self {
                    $(Operation::$kind(o) => Ok(match o.plan(setting)? {
                        Attempt::SetupPlan(plan, found) => {
                            Attempt::SetupPlan(OperationPlan::$kind(Box::new(plan)), found)
                        }
                        Attempt::LeftOut(reason) => Attempt::LeftOut(reason),
                    }),)*
                }
            }
        }

        impl OperationPlan {
            /// The wear register that it uses.
            pub(crate) fn wear(&self) -> Option<WearRegister> {
                match self { $(OperationPlan::$kind(p) => p.wear(),)* }
            }

            /// Turns the part on the table, where the plan wants that.
            pub(crate) fn turn_part(&self, setting: &Setting<'_>, setup: &mut Setup) {
                match self { $(OperationPlan::$kind(p) => p.turn_part(setting, setup),)* }
            }

            /// Writes its moves.
            ///
            /// # Errors
            /// One finding with a key counted from the table.
            pub(crate) fn write(&mut self, pen: &mut Pen<'_>) -> Result<()> {
                match self { $(OperationPlan::$kind(p) => p.write(pen),)* }
            }

            /// Whether the rotary axes are not at zero after it.
            pub(crate) fn leaves_axes_turned(&self) -> bool {
                match self { $(OperationPlan::$kind(p) => p.leaves_axes_turned(),)* }
            }

            /// Findings of the planner about the plan as a whole.
            pub(crate) fn remarks(&self) -> &[Finding] {
                match self { $(OperationPlan::$kind(p) => p.remarks(),)* }
            }

            /// Depth to which it may go below the stock by itself [mm].
            pub(crate) fn breakthrough(&self) -> f64 {
                match self { $(OperationPlan::$kind(p) => p.breakthrough(),)* }
            }

            /// Cores that a person takes out at the program stops, in order.
            pub(crate) fn taken_out(&self) -> &[TakenOut] {
                match self { $(OperationPlan::$kind(p) => p.taken_out(),)* }
            }

            /// Cores that fall out by themselves.
            pub(crate) fn falling(&self, posted: &PostedPlan<'_>) -> Vec<Loose> {
                match self { $(OperationPlan::$kind(p) => p.falling(posted),)* }
            }

            /// The walls that it wants.
            pub(crate) fn walls(&self) -> Vec<WantedWall> {
                match self { $(OperationPlan::$kind(p) => p.walls(),)* }
            }

            /// Whether it cuts along a line as it is given, and says nothing of the surfaces that it leaves.
            pub(crate) fn wants_nothing(&self) -> bool {
                match self { $(OperationPlan::$kind(p) => p.wants_nothing(),)* }
            }

            /// The round holes that it leaves.
            pub(crate) fn holes(&self) -> Vec<RoundHole> {
                match self { $(OperationPlan::$kind(p) => p.holes(),)* }
            }

            /// The face that it has milled.
            pub(crate) fn milled(&self) -> Option<FaceEdges> {
                match self { $(OperationPlan::$kind(p) => p.milled(),)* }
            }

            /// The plane that it leaves.
            pub(crate) fn made_plane(&self) -> Option<MadePlane> {
                match self { $(OperationPlan::$kind(p) => p.made_plane(),)* }
            }

            /// The recesses at the mouths of holes that it leaves.
            pub(crate) fn mouths(&self) -> Vec<MadeMouth> {
                match self { $(OperationPlan::$kind(p) => p.mouths(),)* }
            }

            /// The plane that it wants.
            pub(crate) fn plane(&self) -> Option<WantedPlane<'_>> {
                match self { $(OperationPlan::$kind(p) => p.plane(),)* }
            }

            /// The places at which it wants the stock measured, at most `most` points.
            pub(crate) fn probes(&self, posted: &PostedPlan<'_>, most: usize) -> Probes {
                match self { $(OperationPlan::$kind(p) => p.probes(posted, most),)* }
            }

            /// Compares the plan with its measurements.
            pub(crate) fn judge(&mut self, name: &str, posted: &PostedPlan<'_>, found: &Found<'_>) -> Judged {
                match self { $(OperationPlan::$kind(p) => p.judge(name, posted, found),)* }
            }

            /// The claims that the tallies of all plans make together, and what they leave unchecked, kind after kind.
            pub(crate) fn sum_up(all: &[(&OperationPlan, Tally)], step: f64) -> (Vec<Proof>, Vec<String>) {
                let (mut claims, mut unchecked) = (Vec::new(), Vec::new());
                $(
                    let of_kind = all.iter().filter(|(plan, _)| matches!(plan, OperationPlan::$kind(_)));
                    let tallies: Vec<Tally> = of_kind.map(|(_, tally)| *tally).collect();
                    let (claim, left) = <$plan as kind::Plan>::sum_up(&tallies, step);
                    claims.extend(claim);
                    unchecked.extend(left);
                )*
                (claims, unchecked)
            }

            /// The sections of the report, kind after kind.
            pub(crate) fn sections(all: &[(&OperationPlan, Shown<'_>)]) -> Vec<Section> {
                let mut sections = Vec::new();
                $(
                    let of_kind: Vec<(&$plan, &Shown<'_>)> = all
                        .iter()
                        .filter_map(|(plan, shown)| match plan {
                            OperationPlan::$kind(plan) => Some((&**plan, shown)),
                            _ => None,
                        })
                        .collect();
                    let added = <$plan as kind::Plan>::sections(&of_kind);
                    // A section that several kinds add in the same words comes once, after the last of them.
                    sections.retain(|s: &Section| !added.contains(s));
                    sections.extend(added);
                )*
                sections
            }
        }

        /// The part of a plan in `plan.json`.
        #[derive(Serialize)]
        #[serde(untagged)]
        pub(crate) enum OperationJson {
            $($(#[$doc])* $kind(Box<<$plan as kind::Plan>::Json>),)*
        }

        impl OperationJson {
            /// The lists of a setup's operations, one for each kind that has any, kind after kind.
            pub(crate) fn lists(
                all: &[(&OperationPlan, Shown<'_>)],
            ) -> Vec<(&'static str, Vec<OperationJson>)> {
                let mut lists = Vec::new();
                $(
                    let entries: Vec<OperationJson> = all
                        .iter()
                        .filter_map(|(plan, shown)| match plan {
                            OperationPlan::$kind(plan) => plan.json(shown).map(|json| OperationJson::$kind(Box::new(json))),
                            _ => None,
                        })
                        .collect();
                    if !entries.is_empty() {
                        lists.push((<$plan as kind::Plan>::LIST, entries));
                    }
                )*
                lists
            }
        }

        /// Makes the table of any kind.
        pub(crate) trait Decode {
            /// The table.
            ///
            /// # Errors
            /// Those of the text.
            fn table<T: serde::de::DeserializeOwned + JsonSchema>(self) -> Result<T>;
        }
    };
}
