//! Readers and requests with damaged input, the same in each run: `cargo xtask fuzz` continues from here.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout, reason = "a failed test panics")]

use dragtraffic_tests::mutation::Corpus;
use dragtraffic_tests::program::{program, root};
use dragtraffic_tests::requests::{self, Caller};
use std::collections::BTreeMap;

const SEED: u64 = 20_261_123;
/// Inputs of each reader.
const READ: u64 = 3_000;
/// Bodies of each kind of request.
const SENT: u64 = 250;

#[test]
fn readers_keep_their_promises_for_damaged_files() {
    for (name, check) in formats::checks::TARGETS {
        let corpus = Corpus::read(&root().join("fuzz/corpus").join(name)).unwrap();
        assert!(corpus.files().iter().any(|file| check(file)), "{name} reads nothing of its corpus");
        let mut read = 0;
        for n in 0..READ {
            let input = corpus.input(SEED, n);
            let outcome = std::panic::catch_unwind(|| check(&input));
            read += u64::from(outcome.unwrap_or_else(|_| panic!("{name}: input {n} of seed {SEED}")));
        }
        println!("{name}: {read} of {READ} damaged files were read");
    }
}

#[test]
fn damaged_bodies_are_answered_as_the_document_says() {
    let server = requests::server(program()).unwrap();
    for target in requests::TARGETS {
        let mut caller = Caller::new(target, &server).unwrap();
        for (n, file) in caller.corpus().files().to_vec().iter().enumerate() {
            let status = caller.call(file).unwrap();
            assert!(status < 300, "{}, file {n}: {status}", target.name);
        }
        let mut statuses: BTreeMap<u16, u64> = BTreeMap::new();
        for n in 0..SENT {
            let input = caller.corpus().input(SEED, n);
            let status = caller.call(&input);
            let status =
                status.unwrap_or_else(|why| panic!("{}: input {n} of seed {SEED}: {why:#}", target.name));
            *statuses.entry(status).or_default() += 1;
        }
        println!("{}: {statuses:?}", target.name);
    }
}
