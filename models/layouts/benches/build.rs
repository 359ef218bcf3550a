//! Measures the time of each template.

use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;

fn templates(c: &mut Criterion) {
    for template in layouts::TEMPLATES {
        let layout = template.layout();
        c.bench_function(template.name(), |b| b.iter(|| layouts::build(black_box(&layout))));
    }
}

criterion_group!(benches, templates);
criterion_main!(benches);
