//! The pool with system threads: answers, refusals, turns, and the ends of calls.

#![allow(clippy::unwrap_used, reason = "a failed test panics")]

use api::{Code, Problem};
use base::limits::Limits;
use base::party::Party;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Duration;
use tokio::sync::oneshot;
use work::{Caller, Ending, Handle, JobKind, JobRequest, Pool, PoolLane, Stop, Ticket, Work};

/// An end that signals when it comes.
struct Told(Mutex<Option<oneshot::Sender<()>>>);

impl Told {
    fn tell(&self) -> bool {
        self.0.lock().unwrap().take().is_some_and(|sender| sender.send(()).is_ok())
    }
}

impl Ending for Told {
    fn stop(&self, _: Stop) -> bool {
        self.tell()
    }

    fn is_over(&self) -> bool {
        self.0.lock().unwrap().is_none()
    }
}

fn small(kind: JobKind) -> JobRequest {
    JobRequest { kind, cost: Duration::from_millis(1), caller: Caller::default() }
}

fn pool(limits: Limits) -> Arc<Pool> {
    Pool::start(&Arc::new(limits)).unwrap()
}

#[tokio::test]
async fn a_call_gives_its_answer_its_problem_or_its_panic() {
    let pool = pool(Limits::default());
    assert_eq!(pool.run(small(JobKind::Score), |_| Ok(7)).await.unwrap(), 7);
    let refused = pool.run::<()>(small(JobKind::Score), |_| Err(Problem::new(Code::NotFound, "no"))).await;
    assert_eq!(refused.unwrap_err().code, Code::NotFound);
    #[allow(clippy::panic, reason = "the worker must survive it")]
    let broken = pool.run::<()>(small(JobKind::Score), |_| panic!("on purpose")).await;
    assert_eq!(broken.unwrap_err().code, Code::Internal);
    assert_eq!(pool.run(small(JobKind::Score), |_| Ok(8)).await.unwrap(), 8, "the worker goes on");
    pool.stop();
}

#[tokio::test]
async fn documents_are_read_while_all_workers_are_busy() {
    let pool = pool(Limits { running: 1, queue: 1, ..Limits::default() });
    let release = Arc::new(AtomicBool::new(false));
    let hold = |release: &Arc<AtomicBool>| {
        let (pool, release) = (Arc::clone(&pool), Arc::clone(release));
        let work = move |_: &experts::Cancel| {
            while !release.load(Ordering::Relaxed) {
                std::thread::sleep(Duration::from_millis(2));
            }
            Ok(())
        };
        tokio::spawn(async move { pool.run(small(JobKind::Place), work).await })
    };
    let running = hold(&release);
    tokio::time::sleep(Duration::from_millis(100)).await;
    let waiting = hold(&release);
    tokio::time::sleep(Duration::from_millis(100)).await;
    let refused = pool.run(small(JobKind::Place), |_| Ok(())).await.unwrap_err();
    assert_eq!(refused.code, Code::Busy);
    assert!(refused.members.retry_after_s.is_some());
    assert_eq!(pool.document(1 << 20, || Ok(3)).await.unwrap(), 3);
    release.store(true, Ordering::Relaxed);
    assert!(running.await.unwrap().is_ok() && waiting.await.unwrap().is_ok());
    pool.stop();
}

#[tokio::test]
async fn leaving_the_wait_cancels_and_a_limit_ends_it() {
    let pool = pool(Limits { running: 1, generate_s: 0, ..Limits::default() });
    let seen = Arc::new(AtomicBool::new(false));
    let told = Arc::clone(&seen);
    let work = move |cancel: &experts::Cancel| {
        while !cancel.is_cancelled() {
            std::thread::sleep(Duration::from_millis(2));
        }
        told.store(true, Ordering::Relaxed);
        Ok(())
    };
    let late = pool.run(small(JobKind::Export), work).await.unwrap_err();
    assert_eq!((late.code, late.members.limit), (Code::GenerateTimeout, Some(0)));
    tokio::time::sleep(Duration::from_millis(100)).await;
    assert!(seen.load(Ordering::Relaxed), "the work was told to stop");
    pool.stop();
}

#[tokio::test]
async fn a_lane_whose_threads_hang_at_ended_calls_does_not_answer() {
    for (lane, asked) in [
        (PoolLane::Patient, JobRequest { cost: Duration::from_secs(1), ..small(JobKind::Export) }),
        (
            PoolLane::Background,
            JobRequest { caller: Caller { background: true, ..Caller::default() }, ..small(JobKind::Export) },
        ),
    ] {
        let pool = pool(Limits { running: 1, ..Limits::default() });
        let release = Arc::new(AtomicBool::new(false));
        let held = Arc::clone(&release);
        let hang = move |_: &experts::Cancel| {
            while !held.load(Ordering::Relaxed) {
                std::thread::sleep(Duration::from_millis(2));
            }
            Ok(())
        };
        assert_eq!(asked.lane(), lane);
        let left = tokio::time::timeout(Duration::from_millis(200), pool.run(asked, hang)).await;
        assert!(left.is_err(), "the caller leaves while it is worked on");
        assert!(pool.answers(lane).await, "the work may look at its end a moment later");
        tokio::time::sleep(Duration::from_millis(2_500)).await;
        assert!(!pool.answers(lane).await && pool.answers(PoolLane::Quick).await, "{lane:?}");
        release.store(true, Ordering::Relaxed);
        tokio::time::sleep(Duration::from_millis(100)).await;
        assert!(pool.answers(lane).await, "{lane:?}");
        pool.stop();
    }
}

/// Submits work of this many milliseconds for a connection, and records its name when it is done.
fn noted(
    pool: &Arc<Pool>,
    done: &Arc<Mutex<Vec<&'static str>>>,
    (name, connection, ms): (&'static str, u64, u64),
) -> tokio::task::JoinHandle<()> {
    let (pool, done) = (Arc::clone(pool), Arc::clone(done));
    let caller = Caller { connection: Some(connection), ..Caller::default() };
    let asked = JobRequest { kind: JobKind::Place, cost: Duration::from_millis(ms), caller };
    let work = move |_: &experts::Cancel| {
        std::thread::sleep(Duration::from_millis(40));
        done.lock().unwrap().push(name);
        Ok(())
    };
    tokio::spawn(async move { pool.run(asked, work).await.unwrap() })
}

/// Submits a generation of several steps of this many milliseconds. Between two steps it lets others go
/// first; at its end it records its name and signals the receiver.
fn yielding<T: Send + 'static>(
    pool: &Arc<Pool>,
    done: &Arc<Mutex<Vec<T>>>,
    (name, cost, caller): (T, Duration, Caller),
    (steps, step_ms): (usize, u64),
) -> (Handle, oneshot::Receiver<()>) {
    let asked = JobRequest { kind: JobKind::Generate, cost, caller };
    let (own, noting) = (Arc::clone(pool), Arc::clone(done));
    let (sender, receiver) = oneshot::channel();
    let answer = Arc::new(Told(Mutex::new(Some(sender))));
    let make = |ticket: &Arc<Ticket>| {
        let (ticket, given) = (Arc::clone(ticket), Arc::clone(&answer));
        let work: Work = Box::new(move || {
            for _ in 0..steps {
                std::thread::sleep(Duration::from_millis(step_ms));
                own.let_others_go(&ticket);
            }
            noting.lock().unwrap().push(name);
            given.tell();
        });
        (answer, work)
    };
    (pool.submit(asked, make).unwrap().1, receiver)
}

#[tokio::test]
async fn callers_take_turns() {
    let pool = pool(Limits { running: 1, ..Limits::default() });
    let done = Arc::default();
    let mut calls = Vec::new();
    for call in [("a1", 1, 1), ("a2", 1, 1), ("a3", 1, 1), ("b1", 2, 1), ("b2", 2, 1)] {
        calls.push(noted(&pool, &done, call));
        tokio::time::sleep(Duration::from_millis(5)).await;
    }
    for call in calls {
        call.await.unwrap();
    }
    assert_eq!(*done.lock().unwrap(), ["a1", "b1", "a2", "b2", "a3"]);
    pool.stop();
}

#[tokio::test]
async fn what_nobody_waits_for_holds_up_nobody() {
    let pool = pool(Limits { running: 1, ..Limits::default() });
    let call = |background, cost_ms, ms| {
        let caller = Caller { background, ..Caller::default() };
        let asked = JobRequest { kind: JobKind::Generate, cost: Duration::from_millis(cost_ms), caller };
        let work = move |_: &experts::Cancel| {
            std::thread::sleep(Duration::from_millis(ms));
            // Niceness of this thread, on Linux.
            Ok(rustix::process::getpriority_process(None).unwrap())
        };
        let pool = Arc::clone(&pool);
        tokio::spawn(async move { pool.run(asked, work).await.unwrap() })
    };
    let behind = call(true, 1, 300);
    tokio::time::sleep(Duration::from_millis(5)).await;
    let first = call(false, 1, 1).await.unwrap();
    assert!(!behind.is_finished());
    let behind = behind.await.unwrap();
    assert!(!cfg!(target_os = "linux") || behind == (first + 10).min(19), "{first} and {behind}");
    // A long call does not delay it either, because a caller may be waiting for it by the time it runs.
    let long = call(false, 4_000, 300);
    tokio::time::sleep(Duration::from_millis(5)).await;
    call(true, 1, 1).await.unwrap();
    assert!(!long.is_finished());
    pool.stop();
}

#[tokio::test]
async fn a_long_call_lets_smaller_ones_of_others_go_first() {
    let pool = pool(Limits { running: 1, ..Limits::default() });
    let done: Arc<Mutex<Vec<&'static str>>> = Arc::default();
    let caller = Caller { connection: Some(1), ..Caller::default() };
    let (hold, receiver) = yielding(&pool, &done, ("long", Duration::from_secs(4), caller), (4, 40));
    let waits = [("small", 2, 500), ("own", 1, 500), ("as long", 3, 3_000)];
    let mut calls = Vec::new();
    for call in waits {
        calls.push(noted(&pool, &done, call));
        tokio::time::sleep(Duration::from_millis(5)).await;
    }
    receiver.await.unwrap();
    for call in calls {
        call.await.unwrap();
    }
    assert_eq!(*done.lock().unwrap(), ["small", "long", "as long", "own"]);
    drop(hold);
    pool.stop();
}

#[tokio::test]
async fn a_long_call_shares_its_thread_with_those_of_another_party() {
    let pool = pool(Limits { running: 1, ..Limits::default() });
    let done: Arc<Mutex<Vec<u8>>> = Arc::default();
    // Calls of 200 ms in ten steps each.
    let call = |last: u8| {
        let party = Party::of(std::net::IpAddr::from([10, 0, 0, last]));
        let caller = Caller { party, connection: Some(last.into()), ..Caller::default() };
        // The first party's call takes ten times what was expected.
        let steps = if last == 1 { 100 } else { 10 };
        yielding(&pool, &done, (last, Duration::from_millis(200), caller), (steps, 20))
    };
    let calls = [1, 1, 2, 2, 2].map(call);
    let mut holds = Vec::new();
    for (hold, receiver) in calls {
        receiver.await.unwrap();
        holds.push(hold);
    }
    assert_eq!(*done.lock().unwrap(), [2, 2, 2, 1, 1], "the other party's calls do not wait for the end");
    drop(holds);
    pool.stop();
}

#[tokio::test]
async fn documents_wait_in_the_share_of_their_caller() {
    let pool = pool(Limits { running: 1, queue: 2, ..Limits::default() });
    let release = Arc::new(AtomicBool::new(false));
    let read = |last: u8| {
        let party = Party::of(std::net::IpAddr::from([10, 0, 0, last]));
        let (pool, release) = (Arc::clone(&pool), Arc::clone(&release));
        let read = move || {
            while !release.load(Ordering::Relaxed) {
                std::thread::sleep(Duration::from_millis(2));
            }
            Ok(())
        };
        let caller = Caller { party, ..Caller::default() };
        tokio::spawn(async move { work::on_behalf_of(caller, pool.document(1 << 20, read)).await.is_ok() })
    };
    let mut greedy = Vec::new();
    for _ in 0..16 {
        greedy.push(read(1));
    }
    tokio::time::sleep(Duration::from_millis(100)).await;
    let other = read(2);
    tokio::time::sleep(Duration::from_millis(30)).await;
    release.store(true, Ordering::Relaxed);
    assert!(other.await.unwrap(), "there is a place for another party");
    let mut read = 0;
    for call in greedy {
        read += usize::from(call.await.unwrap());
    }
    assert!(read < 16, "the queue was full");
    pool.stop();
}

#[tokio::test]
async fn a_full_queue_refuses_the_newest_of_the_greediest() {
    let pool = pool(Limits { running: 1, queue: 4, ..Limits::default() });
    let release = Arc::new(AtomicBool::new(false));
    let call = |last: u8, connection: u64, line: Option<u64>| {
        let party = Party::of(std::net::IpAddr::from([10, 0, 0, last]));
        let caller = Caller { connection: Some(connection), party, line, ..Caller::default() };
        let asked = JobRequest { kind: JobKind::Place, cost: Duration::from_millis(1), caller };
        let (pool, release) = (Arc::clone(&pool), Arc::clone(&release));
        let work = move |_: &experts::Cancel| {
            while !release.load(Ordering::Relaxed) {
                std::thread::sleep(Duration::from_millis(2));
            }
            Ok(())
        };
        tokio::spawn(async move { pool.run(asked, work).await.map_err(|problem| problem.code) })
    };
    let pause = || tokio::time::sleep(Duration::from_millis(30));
    let mut greedy = Vec::new();
    for connection in 1..=6 {
        greedy.push(call(1, connection, None));
        pause().await;
    }
    // One runs, four wait, the last is refused.
    assert_eq!(greedy.pop().unwrap().await.unwrap(), Err(Code::Busy));
    let other = call(2, 7, None);
    pause().await;
    assert_eq!(greedy.pop().unwrap().await.unwrap(), Err(Code::Busy), "its newest gives way");
    let line = call(1, 8, Some(8));
    pause().await;
    assert_eq!(greedy.pop().unwrap().await.unwrap(), Err(Code::Busy), "plain requests count together");
    // Two parties have two each, and a third one would not be greedier, so it still finds a place.
    let third = call(3, 9, None);
    pause().await;
    release.store(true, Ordering::Relaxed);
    for kept in [other, line, third] {
        assert_eq!(kept.await.unwrap(), Ok(()));
    }
    let mut ends = Vec::new();
    for call in greedy {
        ends.push(call.await.unwrap());
    }
    assert_eq!(ends, [Ok(()), Ok(()), Err(Code::Busy)]);
    pool.stop();
}

#[tokio::test]
async fn long_documents_leave_the_workers_to_calls() {
    let limits = Limits { running: 1, ..Limits::default() };
    let readers = limits.readers();
    let pool = pool(limits);
    let release = Arc::new(AtomicBool::new(false));
    let long: Vec<_> = (0..=readers)
        .map(|_| {
            let (pool, release) = (Arc::clone(&pool), Arc::clone(&release));
            let read = move || {
                while !release.load(Ordering::Relaxed) {
                    std::thread::sleep(Duration::from_millis(1));
                }
                Ok(())
            };
            tokio::spawn(async move { pool.document(64 << 20, read).await })
        })
        .collect();
    tokio::time::sleep(Duration::from_millis(100)).await;
    let call = pool.run(small(JobKind::Score), |_| Ok(1));
    assert_eq!(tokio::time::timeout(Duration::from_secs(20), call).await.unwrap().unwrap(), 1);
    assert_eq!(pool.document(64 << 10, || Ok(2)).await.unwrap(), 2, "short ones are read meanwhile");
    release.store(true, Ordering::Relaxed);
    for document in long {
        assert!(document.await.unwrap().is_ok());
    }
    pool.stop();
}

#[tokio::test]
async fn parties_with_equal_names_of_jobs_and_clients_leave_each_other_alone() {
    let pool = pool(Limits { running: 2, ..Limits::default() });
    let party = |name: &str| Party::named(name);
    let release = Arc::new(AtomicBool::new(false));
    let call = |name: &str, revision: u64| {
        let (pool, release) = (Arc::clone(&pool), Arc::clone(&release));
        let client = Some(("hand".to_owned(), revision));
        let caller =
            Caller { job: Some("job".into()), client, party: Party::named(name), ..Caller::default() };
        let asked = JobRequest { caller, ..small(JobKind::Generate) };
        let work = move |cancel: &experts::Cancel| {
            while !release.load(Ordering::Relaxed) && !cancel.is_cancelled() {
                std::thread::sleep(Duration::from_millis(1));
            }
            Ok(())
        };
        tokio::spawn(async move { pool.run(asked, work).await.map_err(|problem| problem.code) })
    };
    let (ann, bob) = (call("ann", 9), call("bob", 1));
    tokio::time::sleep(Duration::from_millis(100)).await;
    // Neither the higher revision of another party nor its DELETE ends a call.
    pool.cancel(party("eve"), "job");
    pool.cancel(party("ann"), "job");
    assert_eq!(ann.await.unwrap(), Err(Code::Cancelled));
    release.store(true, Ordering::Relaxed);
    assert_eq!(bob.await.unwrap(), Ok(()));
    // Both have left their threads.
    tokio::time::sleep(Duration::from_millis(100)).await;
    // A party's own older revision is refused.
    assert_eq!(call("ann", 9).await.unwrap(), Err(Code::StaleRevision));
    assert_eq!(call("bob", 2).await.unwrap(), Ok(()));
    pool.stop();
}
