//! `kinecut tools` as a shell sees it.

use serde_json::Value;

use crate::shell::{example, folder, kinecut, text};

#[test]
fn tools_are_shown_and_written_in_other_formats() {
    let folder = folder("tools");
    let shop = example("shop.toml");
    let shown = kinecut(&["tools", &shop], "");
    let table = text(&shown.stdout);
    assert_eq!(shown.status.code(), Some(0), "{}", text(&shown.stderr));
    for word in ["end mill 10", "reamer 8H7", "tap M12", "face-mill", "FMB 22", "C45", "kinecut tools"] {
        assert!(table.contains(word), "`{word}` is not in\n{table}");
    }
    let json: Value = serde_json::from_slice(&kinecut(&["tools", &shop, "--json"], "").stdout).unwrap();
    assert_eq!(
        (json["tools"].as_array().unwrap().len(), json["tools"][6]["diameter"].as_f64()),
        (40, Some(10.0))
    );
    // The largest diameter of a conical cutter.
    let chamfer = &json["tools"][11];
    assert_eq!(chamfer["type"].as_str(), Some("tapered"));
    assert!((chamfer["diameter"].as_f64().unwrap() - 12.0).abs() < 1e-9, "{chamfer}");
    // TOML on standard output alone; the same into a file.
    let toml = kinecut(&["tools", &shop, "--to", "toml"], "");
    assert_eq!((toml.status.code(), text(&toml.stderr).as_str()), (Some(0), ""));
    let file = folder.join("new/again.toml").display().to_string();
    let written = kinecut(&["tools", &shop, "--out", &file], "");
    assert_eq!(written.status.code(), Some(0), "{}", text(&written.stderr));
    assert_eq!(std::fs::read_to_string(&file).unwrap(), text(&toml.stdout));
    let again: Value = serde_json::from_slice(&kinecut(&["tools", &file, "--json"], "").stdout).unwrap();
    assert_eq!(again["tools"], json["tools"]);
    // A table of LinuxCNC holds little: the rest is named.
    let table = kinecut(&["tools", &shop, "--to", "tbl"], "");
    assert!(text(&table.stdout).contains("\nT7 P7 D10 ;end mill 10\n"), "{}", text(&table.stdout));
    // D is the largest diameter of a cone.
    assert!(text(&table.stdout).contains("\nT12 P12 D12 ;chamfer mill 90\n"), "{}", text(&table.stdout));
    let told = text(&table.stderr);
    assert!(
        told.contains("T7 `end mill 10`") && told.contains("flute_length") && told.contains("holder `ER32`"),
        "{told}"
    );
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn tools_that_a_job_could_not_use_are_told_and_wrong_files_exit_2() {
    let folder = folder("odd-tools");
    let table = folder.join("tool.tbl");
    std::fs::write(&table, "T1 P1 D0.25 Z3 ;end mill\n").unwrap();
    let table = table.display().to_string();
    let shown = kinecut(&["tools", &table, "--inches"], "");
    assert_eq!(shown.status.code(), Some(0));
    assert!(text(&shown.stdout).contains("6.35") && text(&shown.stdout).contains("flute_length"));
    assert!(text(&shown.stderr).contains("KC0706"), "{}", text(&shown.stderr));
    let denied = kinecut(&["tools", &table, "--deny", "warnings"], "");
    assert_eq!(denied.status.code(), Some(1));
    let toml = kinecut(&["tools", &table, "--to", "toml"], "");
    assert!(text(&toml.stdout).contains("# flute_length = ?"), "{}", text(&toml.stdout));
    assert!(text(&toml.stderr).contains("To be filled in"), "{}", text(&toml.stderr));
    assert!(text(&toml.stdout).contains("# assumed: the type, from the remark"), "{}", text(&toml.stdout));
    assert!(text(&toml.stderr).contains("Assumed"), "{}", text(&toml.stderr));
    // The bits of a library lie beside its folder.
    let (library, bits) = (folder.join("Library"), folder.join("Bit"));
    std::fs::create_dir_all(&library).unwrap();
    std::fs::create_dir_all(&bits).unwrap();
    std::fs::write(library.join("l.fctl"), r#"{"tools": [{"nr": 9, "path": "m.fctb"}]}"#).unwrap();
    let bit = r#"{"name": "mill", "shape": "endmill.fcstd", "parameter": {"Diameter": "6 mm", "CuttingEdgeHeight": "9 mm"}}"#;
    std::fs::write(bits.join("m.fctb"), bit).unwrap();
    let shown = kinecut(&["tools", &library.join("l.fctl").display().to_string(), "--json"], "");
    let json: Value = serde_json::from_slice(&shown.stdout).unwrap();
    assert_eq!(
        (json["tools"][0]["number"].as_u64(), json["tools"][0]["name"].as_str()),
        (Some(9), Some("mill"))
    );
    let broken = folder.join("broken.tools");
    std::fs::write(&broken, "{\n\"data\": [,]}").unwrap();
    let wrong = kinecut(&["tools", &broken.display().to_string()], "");
    let message = text(&wrong.stderr);
    assert_eq!(wrong.status.code(), Some(2));
    assert!(message.contains("KC0706") && message.contains("broken.tools:2:"), "{message}");
    // A file that was read is not replaced.
    let before = std::fs::read(&table).unwrap();
    let same = kinecut(&["tools", &table, "--to", "toml", "--out", &table], "");
    assert_eq!((same.status.code(), std::fs::read(&table).unwrap() == before), (Some(2), true));
    std::fs::remove_dir_all(folder).unwrap();
}
