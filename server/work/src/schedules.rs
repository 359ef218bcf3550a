//! Tests of the pool under a model checker: small scenarios of callers and workers, run in thousands of
//! thread interleavings. A schedule that violates an invariant, or deadlocks, is printed and can be repeated
//! (`shuttle::replay`).
//!
//! `SCHEDULES` is the number of interleavings per scenario, for each of two ways to draw them.

use super::job::{Caller, Ending, JobRequest, Stop, Ticket, Work};
use super::kind::{JobKind, PoolLane};
use super::sync::{Condvar, Mutex, thread};
use super::{Handle, Pool, lock};
use api::Code;
use base::limits::Limits;
use base::party::Party;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

/// Limit of preemptions in the second way of drawing.
const DEPTH: usize = 3;

/// Runs many interleavings of one scenario.
fn explore(drama: fn()) {
    let count = std::env::var("SCHEDULES").ok().and_then(|text| text.parse().ok()).unwrap_or(1_000);
    shuttle::check_random(drama, count);
    shuttle::check_pct(drama, count, DEPTH);
}

/// Outcome of a call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum How {
    Done,
    Superseded,
    Refused(Code),
}

/// End of a call, and how often it was run.
#[derive(Default)]
struct End {
    how: Mutex<Option<How>>,
    ended: Condvar,
    runs: AtomicUsize,
}

impl End {
    /// False if it has already ended.
    fn end(&self, how: How) -> bool {
        let mut slot = lock(&self.how);
        let first = slot.is_none();
        slot.get_or_insert(how);
        self.ended.notify_all();
        first
    }

    fn wait(&self) -> How {
        let mut slot = lock(&self.how);
        loop {
            if let Some(how) = *slot {
                return how;
            }
            slot = self.ended.wait(slot).unwrap();
        }
    }

    fn runs(&self) -> usize {
        self.runs.load(Ordering::Relaxed)
    }
}

impl Ending for End {
    fn stop(&self, stop: Stop) -> bool {
        self.end(match stop {
            Stop::Superseded(_) => How::Superseded,
            Stop::Problem(problem) => How::Refused(problem.code),
        })
    }

    fn is_over(&self) -> bool {
        lock(&self.how).is_some()
    }
}

/// A door that opens once.
#[derive(Default)]
struct Door(Mutex<bool>, Condvar);

impl Door {
    fn open(&self) {
        *lock(&self.0) = true;
        self.1.notify_all();
    }

    fn pass(&self) {
        let mut open = lock(&self.0);
        while !*open {
            open = self.1.wait(open).unwrap();
        }
    }
}

/// A pool with one or two workers of each kind, and room for this many calls.
fn pool(running: u64, queue: u64) -> Arc<Pool> {
    Pool::start(&Arc::new(Limits { running, queue, ..Limits::default() })).unwrap()
}

fn asked(kind: JobKind, cost_ms: u64, id: &str, connection: u64) -> JobRequest {
    let caller = Caller { job: Some(id.to_owned()), connection: Some(connection), ..Caller::default() };
    JobRequest { kind, cost: Duration::from_millis(cost_ms), caller }
}

fn quick(id: &str, connection: u64) -> JobRequest {
    asked(JobKind::Score, 1, id, connection)
}

fn revision(number: u64) -> JobRequest {
    let caller = Caller { client: Some(("hand".into(), number)), ..quick(&format!("r{number}"), 1).caller };
    JobRequest { caller, ..quick("", 1) }
}

type Call = (Arc<End>, Handle);

/// Submits work of a few steps that checks for cancellation between them.
fn ask(pool: &Arc<Pool>, asked: JobRequest, step: impl Fn(&Ticket) + Send + 'static) -> Result<Call, Code> {
    let call = pool.submit(asked, |ticket| {
        let end = Arc::new(End::default());
        let (own, ticket) = (Arc::clone(&end), Arc::clone(ticket));
        let work: Work = Box::new(move || {
            own.runs.fetch_add(1, Ordering::Relaxed);
            for _ in 0..2 {
                step(&ticket);
                if ticket.cancel.is_cancelled() {
                    return;
                }
            }
            own.end(How::Done);
        });
        (end, work)
    });
    holds(pool);
    call.map_err(|problem| problem.code)
}

fn steps(_: &Ticket) {
    thread::yield_now();
}

/// Invariants that hold whenever no thread holds the state.
fn holds(pool: &Pool) {
    let mut state = lock(&pool.state);
    if state.closing {
        return;
    }
    let waiting: usize = PoolLane::ALL.into_iter().map(|lane| state.lane(lane).queue.len()).sum();
    assert_eq!(state.jobs.len(), waiting + state.running(), "each call waits or is worked on");
    for lane in PoolLane::ALL {
        assert!(state.lane(lane).queue.len() as u64 <= pool.limits.queue, "{lane:?} is over its bound");
    }
}

/// Waits until every call has ended; then nothing is left, and the threads exit.
fn close(pool: &Arc<Pool>) {
    loop {
        let mut state = lock(&pool.state);
        let waiting: usize = PoolLane::ALL.into_iter().map(|lane| state.lane(lane).queue.len()).sum();
        if state.running() == 0 {
            assert_eq!((waiting, state.jobs.len()), (0, 0), "nothing is left behind");
            break;
        }
        drop(state);
        thread::yield_now();
    }
    pool.stop();
}

/// Three callers submit two jobs each, for one worker and two places.
fn a_crowd(generate_s: u64) {
    let limits = Limits { running: 1, queue: 2, generate_s, ..Limits::default() };
    let pool = Pool::start(&Arc::new(limits)).unwrap();
    let callers: Vec<_> = (0..3)
        .map(|connection| {
            let pool = Arc::clone(&pool);
            thread::spawn(move || {
                for k in 0..2 {
                    match ask(&pool, quick(&format!("{connection}-{k}"), connection), steps) {
                        Ok((end, _hold)) => match end.wait() {
                            How::Done => assert_eq!(end.runs(), 1),
                            other => assert_eq!(other, How::Refused(Code::GenerateTimeout)),
                        },
                        Err(code) => assert_eq!(code, Code::Busy),
                    }
                }
            })
        })
        .collect();
    callers.into_iter().for_each(|caller| caller.join().unwrap());
    close(&pool);
}

#[test]
fn no_call_is_lost_or_worked_on_twice() {
    explore(|| a_crowd(60));
}

#[test]
fn a_time_limit_ends_calls_at_any_moment() {
    explore(|| a_crowd(0));
}

#[test]
fn a_newer_revision_overtakes_the_older_ones() {
    explore(|| {
        let pool = pool(1, 2);
        let senders: Vec<_> = [[1, 3], [2, 4]]
            .map(|numbers| {
                let pool = Arc::clone(&pool);
                thread::spawn(move || {
                    let mut held: Vec<(u64, Call)> = Vec::new();
                    for number in numbers {
                        match ask(&pool, revision(number), steps) {
                            Ok(call) => {
                                for (older, (end, _)) in &held {
                                    assert!(end.is_over(), "{older} goes on beside {number}");
                                }
                                held.push((number, call));
                            }
                            Err(code) => assert_eq!(code, Code::StaleRevision),
                        }
                    }
                    held
                })
            })
            .into_iter()
            .collect();
        let held: Vec<_> = senders.into_iter().flat_map(|sender| sender.join().unwrap()).collect();
        let highest = held.iter().map(|(number, _)| *number).max().unwrap();
        assert_eq!(highest, 4, "the newest is never refused");
        for (number, (end, _)) in &held {
            let how = end.wait();
            assert!(end.runs() <= 1);
            if *number == highest {
                assert_eq!((how, end.runs()), (How::Done, 1), "the newest is answered");
            } else {
                assert!(matches!(how, How::Done | How::Superseded), "{number}: {how:?}");
            }
        }
        close(&pool);
    });
}

#[test]
fn a_call_that_is_given_up_leaves_its_place() {
    explore(|| {
        let (pool, door) = (pool(1, 1), Arc::new(Door::default()));
        let (inside, opened) = (Arc::new(Door::default()), Arc::clone(&door));
        let entered = Arc::clone(&inside);
        let first = ask(&pool, quick("first", 1), move |_| {
            entered.open();
            opened.pass();
        });
        let first = first.unwrap();
        inside.pass();
        let second = ask(&pool, quick("second", 2), steps).unwrap();
        assert_eq!(ask(&pool, quick("third", 3), steps).err(), Some(Code::Busy));
        let (gone, hold) = second;
        let (own, by_id) = (Arc::clone(&pool), thread::spawn(move || drop(hold)));
        // Its id and its reader cancel it at the same time.
        own.cancel(Party::Own, "second");
        by_id.join().unwrap();
        assert_eq!((gone.wait(), gone.runs()), (How::Refused(Code::Cancelled), 0));
        let third = ask(&pool, quick("third", 3), steps).unwrap();
        door.open();
        assert_eq!((first.0.wait(), third.0.wait()), (How::Done, How::Done));
        assert_eq!(gone.runs(), 0, "what was given up is not worked on");
        close(&pool);
    });
}

#[test]
fn giving_up_meets_working_at_any_moment() {
    explore(|| {
        let pool = pool(1, 4);
        let calls: Vec<Call> =
            (0..3).map(|k| ask(&pool, quick(&format!("{k}"), k), steps).unwrap()).collect();
        let ends: Vec<_> = calls.iter().map(|(end, _)| Arc::clone(end)).collect();
        let leaver = thread::spawn(move || drop(calls));
        let canceller = Arc::clone(&pool);
        let canceller = thread::spawn(move || canceller.cancel(Party::Own, "1"));
        for end in &ends {
            let how = end.wait();
            assert!(matches!(how, How::Done | How::Refused(Code::Cancelled)), "{how:?}");
            assert!(end.runs() <= 1);
        }
        leaver.join().unwrap();
        canceller.join().unwrap();
        close(&pool);
    });
}

/// Calls that wait for each other: they end only if all of them run at the same time.
fn side_by_side(pool: &Arc<Pool>, calls: &[(JobKind, u64)]) {
    let doors: Vec<Arc<Door>> = calls.iter().map(|_| Arc::default()).collect();
    let mut held = Vec::new();
    for (own, (kind, cost_ms)) in calls.iter().enumerate() {
        let doors = doors.clone();
        let meet = move |_: &Ticket| {
            doors[own].open();
            doors.iter().for_each(|door| door.pass());
        };
        held.push(ask(pool, asked(*kind, *cost_ms, &format!("{own}"), own as u64), meet).unwrap());
    }
    held.iter().for_each(|(end, _)| assert_eq!((end.wait(), end.runs()), (How::Done, 1)));
}

#[test]
fn all_threads_work_while_there_is_work_for_them() {
    explore(|| {
        let pool = pool(2, 8);
        side_by_side(
            &pool,
            &[(JobKind::Score, 1), (JobKind::Score, 1), (JobKind::Generate, 900), (JobKind::Document, 1)],
        );
        close(&pool);
    });
}

#[test]
fn a_worker_reads_what_the_readers_cannot() {
    explore(|| {
        let pool = pool(1, 8);
        let readers = pool.limits.readers();
        side_by_side(&pool, &vec![(JobKind::Document, 1); readers + 1]);
        close(&pool);
    });
}

#[test]
fn a_long_call_lets_smaller_ones_go_and_comes_back() {
    explore(|| {
        let pool = pool(1, 8);
        let own = Arc::clone(&pool);
        let let_go = move |ticket: &Ticket| own.let_others_go(ticket);
        let (long, _hold) = ask(&pool, asked(JobKind::Generate, 4_000, "long", 1), let_go).unwrap();
        let callers: Vec<_> = (2..4)
            .map(|connection| {
                let pool = Arc::clone(&pool);
                thread::spawn(move || {
                    let small = asked(JobKind::Generate, 500, &format!("small-{connection}"), connection);
                    let (end, hold) = ask(&pool, small, steps).unwrap();
                    if connection == 2 {
                        drop(hold);
                        assert!(matches!(end.wait(), How::Done | How::Refused(Code::Cancelled)));
                        return;
                    }
                    assert_eq!((end.wait(), end.runs()), (How::Done, 1));
                })
            })
            .collect();
        assert_eq!((long.wait(), long.runs()), (How::Done, 1));
        callers.into_iter().for_each(|caller| caller.join().unwrap());
        close(&pool);
    });
}

#[test]
fn a_stop_ends_everybody_once() {
    explore(|| {
        let pool = pool(1, 2);
        let callers: Vec<_> = (0..3)
            .map(|connection| {
                let pool = Arc::clone(&pool);
                thread::spawn(move || match ask(&pool, quick(&format!("{connection}"), connection), steps) {
                    Ok((end, _hold)) => {
                        let how = end.wait();
                        assert!(matches!(how, How::Done | How::Refused(Code::ShuttingDown)), "{how:?}");
                        assert!(end.runs() <= 1);
                    }
                    Err(code) => assert!(matches!(code, Code::Busy | Code::ShuttingDown), "{code:?}"),
                })
            })
            .collect();
        pool.close();
        pool.stop();
        callers.into_iter().for_each(|caller| caller.join().unwrap());
        assert_eq!(ask(&pool, quick("late", 9), steps).err(), Some(Code::ShuttingDown));
    });
}
