//! Small scenes for tests, as JSON.

use serde_json::{Value, json};

/// Two lanes side by side along x, 200 m long, with `agents` cars driving at 10 m/s and a log of
/// `steps` steps.
pub fn street(agents: usize, steps: usize) -> Value {
    let points = |y: f64| -> Vec<[f64; 2]> { (-20..=40).map(|i| [f64::from(i) * 5.0, y]).collect() };
    let lane =
        |id: &str, y: f64| json!({"id": id, "type": "surface_street", "points_m": points(y), "width_m": 3.5});
    let cars: Vec<Value> = (0..agents).map(|i| car(i, steps)).collect();
    json!({
        "format": "dragtraffic.scene", "version": 1, "name": "street",
        "meta": {"source": "drawn", "licence": "cc0"},
        "time": {"step_s": 0.1, "steps": steps, "now_step": 0},
        "map": {"lanes": [lane("1", 0.0), lane("2", 3.5)]},
        "agents": cars,
    })
}

/// The `i`-th car: alternating lanes, 15 m apart, 10 m/s.
pub fn car(i: usize, steps: usize) -> Value {
    let (x, y) = ((i / 2) as f64 * 15.0 - 60.0, (i % 2) as f64 * 3.5);
    let xs: Vec<f64> = (0..steps).map(|k| x + k as f64).collect();
    let same = |v: f64| vec![v; steps];
    json!({
        "id": i.to_string(), "type": "vehicle", "subtype": "car", "length_m": 4.7, "width_m": 2.0,
        "track": {"first_step": 0, "x_m": xs, "y_m": same(y), "heading_rad": same(0.0),
            "vx_mps": same(10.0), "vy_mps": same(0.0)},
    })
}

/// Body of a generation of car 0 in a street of `agents`.
pub fn generate(agents: usize) -> Value {
    json!({"scene": street(agents, 91), "agents": ["0"], "seed": 7,
        "conditions": {"0": {"goal": {"x_m": 20.0, "y_m": 0.0, "speed_mps": 10.0}}}})
}
