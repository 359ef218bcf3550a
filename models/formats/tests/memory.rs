//! A document cannot make the reader use much more memory than it has bytes, or much time.
//! One test in a process of its own, since the system counts per process.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "a test stops at the first surprise"
)]

use std::time::{Duration, Instant};

/// Peak resident memory of this process, where the system reports it.
fn peak_memory_mb() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(line.trim().strip_suffix(" kB")?.parse::<u64>().ok()? / 1024)
}

#[test]
fn repetition_is_bounded_in_memory_and_time() {
    const SIZE: usize = 16 << 20;
    let head = r#"{"format":"dragtraffic.scene","version":1,"time":{"steps":9},"#;
    let bodies = [
        ("agents", r#""map":{},"agents":["#, r#"{"id":"a","type":"other"}"#, "]}"),
        ("signals", r#""map":{},"signals":["#, r#"{"lane":"","states":[[0,"go"]]}"#, "]}"),
        ("lanes", r#""map":{"lanes":["#, r#"{"id":"","points_m":[]}"#, "]}}"),
        ("stop signs", r#""map":{"stop_signs":["#, r#"{"id":"","position_m":[0,0]}"#, "]}}"),
        ("points", r#""map":{"lanes":[{"id":"a","points_m":["#, "[0,0]", "]}]}}"),
        ("links", r#""map":{"lanes":[{"id":"a","points_m":[],"successors":["#, r#""""#, "]}]}}"),
        ("tags", r#""map":{},"meta":{"tags":["#, r#""""#, "]}}"),
        (
            "columns",
            r#""map":{},"agents":[{"id":"a","type":"other","track":{"first_step":0,"x_m":["#,
            "0",
            r#"],"y_m":[],"heading_rad":[],"vx_mps":[],"vy_mps":[]}}]}"#,
        ),
        (
            "ranges",
            r#""map":{},"agents":[{"id":"a","type":"other","track":{"first_step":0,"valid":["#,
            "[0,1]",
            r#"],"x_m":[],"y_m":[],"heading_rad":[],"vx_mps":[],"vy_mps":[]}}]}"#,
        ),
        ("values of another tool", r#""map":{},"x_a":["#, "[]", "]}"),
        ("samples", r#""map":{},"generated":{"input_sha256":"","samples":["#, r#"{"agents":{}}"#, "]}}"),
        ("unknown members", r#""map":{},"agents":[{"id":"a","type":"other","what":["#, "0", "]}]}"),
        ("white space", r#""map":{"lanes":["#, "        ", "]}}"),
    ];
    for (name, open, item, close) in bodies {
        let mut text = format!("{head}{open}{item}");
        let separator = if item.trim().is_empty() { "" } else { "," };
        while text.len() < SIZE {
            text.push_str(separator);
            text.push_str(item);
        }
        text.push_str(close);
        let start = Instant::now();
        let result = formats::native::read(text.as_bytes());
        let took = start.elapsed();
        let word = result.as_ref().map_or_else(ToString::to_string, |_| "read".into());
        println!("{name:24} {took:8.0?}  peak {:?} MB  {word}", peak_memory_mb().unwrap_or(0));
        assert!(result.is_err() || name == "white space", "{name} is read");
        assert!(took < Duration::from_secs(4), "{name} took {took:?}");
        if let Some(peak) = peak_memory_mb() {
            assert!(peak < 16 * 9 + 64, "{name}: {peak} MB");
        }
    }
}
