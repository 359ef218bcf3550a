//! Scratch: judge the generator on scenes. `try_generate WHAT WEIGHTS|- DIR [MOST]`
#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout)]
use experts::*;
use lab::eval;
use std::path::Path;
#[global_allocator]
static GLOBAL: mimalloc::MiMalloc = mimalloc::MiMalloc;
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let g = if a[2] == "-" {
        Generator::built_in().unwrap()
    } else {
        Generator::from_dir(Path::new(&a[2])).unwrap()
    };
    let most: usize = a.get(4).map_or(1000, |m| m.parse().unwrap());
    let files = lab::prepare::scene_files(&[a[3].clone().into()]).unwrap();
    let scenes: Vec<_> =
        files.iter().take(most).flat_map(|f| lab::prepare::read_scenes(f).unwrap_or_default()).collect();
    let t = std::time::Instant::now();
    match a[1].as_str() {
        "reach" => println!("{}", serde_json::to_string_pretty(&eval::reach(&g, &scenes).unwrap()).unwrap()),
        "errors" => {
            let t = eval::errors(&g, &scenes, &eval::Subset::ALL).unwrap();
            for (ty, rows) in t {
                for (s, r) in rows {
                    println!(
                        "{ty:?} {}: n {} min {:.2} first {:.2} likeliest {:.2}",
                        s.name(),
                        r.cases,
                        r.min_ade_m,
                        r.first_ade_m,
                        r.best_is_likeliest
                    );
                }
            }
        }
        "latency" => {
            for threads in [1, 2] {
                let g = Generator::built_in().unwrap().with_threads(threads);
                g.warm_up();
                for r in eval::latency::latency(&g, threads, &scenes, 3).unwrap() {
                    println!("{} {} first {:?} settled {:?}", r.what, r.threads, r.first_event, r.settled);
                }
            }
        }
        _ => {
            for (i, scene) in scenes.iter().enumerate() {
                for (k, case) in eval::cases(scene).into_iter().enumerate().filter(|(k, _)| k % 3 == 0) {
                    for subset in [eval::Subset::None, eval::Subset::Pos] {
                        let mut s = scene.clone();
                        s.agents[case.agent].conditions.goal = case.goal(scene, subset);
                        let id = s.agents[case.agent].id.clone();
                        let mut r = Request::new(std::sync::Arc::new(s.clone()));
                        r.agents = Some([id].into());
                        let ans = eval::answer(&g, r).unwrap();
                        let c = s.agents[case.agent].state_at(0).unwrap().position();
                        std::fs::write(
                            format!("/work/tmp/pics/{i:02}_{k:02}_{}.svg", subset.name()),
                            eval::picture::futures_svg(&s, &ans.samples[0].agents, c),
                        )
                        .unwrap();
                    }
                }
            }
        }
    }
    eprintln!("{:?}", t.elapsed());
}
