//! Whatever the parameters, the map holds together.

#![allow(clippy::unwrap_used, clippy::panic, clippy::indexing_slicing, reason = "a failed test panics")]

#[test]
fn every_template_passes_its_own_checks() {
    let mut failures = Vec::new();
    for template in layouts::TEMPLATES {
        let (scene, built) = layouts::scene(&template.layout(), template.title()).unwrap();
        if let Ok(dir) = std::env::var("DUMP") {
            let map =
                serde_json::to_string(&serde_json::json!({"map": &*scene.map, "signals": scene.signals}))
                    .unwrap();
            std::fs::write(format!("{dir}/{}.json", template.name()), map).unwrap();
        }
        failures.extend(
            built.checks.into_iter().filter(|check| !check.passed).map(|check| (template.name(), check)),
        );
        if let Err(problems) = scene.checked() {
            failures.push((
                template.name(),
                layouts::Check {
                    kind: layouts::CheckKind::Widths,
                    passed: false,
                    text: format!("{problems:?}"),
                    at_m: None,
                    lanes: vec![],
                },
            ));
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
}
