//! Training records from a folder of scenes: `prepare IN OUT TYPE PER_SCENE DRAWS MOST`.
#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout)]

#[global_allocator]
static GLOBAL: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() {
    let a: Vec<String> = std::env::args().collect();
    let agent_type = match a[3].as_str() {
        "vehicle" => scene::AgentType::Vehicle,
        "pedestrian" => scene::AgentType::Pedestrian,
        _ => scene::AgentType::Cyclist,
    };
    let options = lab::prepare::Options {
        inputs: vec![a[1].clone().into()],
        out: a[2].clone().into(),
        agent_type,
        seed: 1,
        per_scene: a[4].parse().unwrap(),
        draws: a[5].parse().unwrap(),
        most_records: a[6].parse().unwrap(),
    };
    let started = std::time::Instant::now();
    let report =
        lab::prepare::run(&options, |r| println!("{r:?} {:.0} s", started.elapsed().as_secs_f64())).unwrap();
    println!("{}", serde_json::to_string(&report).unwrap());
}
