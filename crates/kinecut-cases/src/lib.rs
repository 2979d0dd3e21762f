//! Property tests take few cases in the suite and many in the weekly form: the environment variable `KINECUT_WEEKLY` is set.

use proptest::prelude::ProptestConfig;

/// Whether this is the weekly form.
pub fn weekly() -> bool {
    std::env::var_os("KINECUT_WEEKLY").is_some()
}

/// The first count in the suite, the second one in the weekly form.
pub fn cases(suite: u32, in_weekly: u32) -> u32 {
    if weekly() { in_weekly } else { suite }
}

/// A property with so many cases in the suite, and ten times as many in the weekly form.
pub fn property(suite: u32) -> ProptestConfig {
    let usual = ProptestConfig { failure_persistence: None, ..ProptestConfig::default() };
    let (cases, rejects) = (cases(suite, 10 * suite), usual.max_global_rejects);
    ProptestConfig { cases, max_global_rejects: rejects.max(10 * cases), ..usual }
}
