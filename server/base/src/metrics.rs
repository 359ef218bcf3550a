//! Counters in Prometheus' text form. Labels are templates and fixed words, never ids or paths.

use axum::http::{Method, StatusCode};
use metrics::{counter, describe_counter, describe_gauge, describe_histogram, gauge, histogram};
use metrics_exporter_prometheus::{Matcher, PrometheusBuilder, PrometheusHandle};

const SECONDS: &[f64] = &[0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 60.0];

/// What each counter counts (`# HELP`).
const COUNTERS: &[(&str, &str)] = &[
    ("dragtraffic_agents_total", "Road users for which futures were generated, by expert."),
    ("dragtraffic_events_dropped_total", "Events of streams that a slow reader did not get."),
    ("dragtraffic_exports_total", "Exports by format and outcome."),
    ("dragtraffic_generates_total", "Generations by outcome."),
    ("dragtraffic_http_requests_total", "Answered requests by route, method and status."),
    ("dragtraffic_imports_total", "Imports by format and outcome."),
    ("dragtraffic_steps_total", "Refinement steps by expert."),
    ("dragtraffic_work_total", "Ended work by kind and outcome."),
];

/// What each gauge shows.
const GAUGES: &[(&str, &str)] = &[
    ("dragtraffic_build_info", "Always 1; its label is the version."),
    ("dragtraffic_memory_budget_bytes", "Memory that the server may use for its work (--memory)."),
    (
        "dragtraffic_memory_taken_bytes",
        "Memory of the budget that requests and what is kept for them have taken.",
    ),
    ("dragtraffic_queue_length", "Jobs that wait, by lane."),
    ("dragtraffic_running", "Jobs under way, by lane."),
    ("dragtraffic_store_bytes", "Size of the store."),
    ("dragtraffic_store_scenes", "Scenes in the store."),
    ("dragtraffic_weights_info", "Always 1; its labels are expert and SHA-256 of its weights."),
    ("process_cpu_seconds_total", "User and system time of the process, seconds."),
    ("process_max_fds", "Most file descriptors that the process may have open."),
    ("process_open_fds", "Open file descriptors."),
    ("process_resident_memory_bytes", "Resident memory of the process."),
    ("process_start_time_seconds", "Start of the process, seconds since 1970."),
    ("process_threads", "Threads of the process."),
];

/// What each histogram measures.
const HISTOGRAMS: &[(&str, &str)] = &[
    ("dragtraffic_generate_seconds", "Time of the phases of a generation: queue, encode, initial, step."),
    ("dragtraffic_http_request_seconds", "Time from a request's head to the head of its reply, by route."),
    ("dragtraffic_work_seconds", "Time of work by kind: in the queue, and with a worker."),
];

/// Installs the recorder of this process.
///
/// # Errors
/// When one is already installed.
pub fn install() -> Result<PrometheusHandle, String> {
    let handle = PrometheusBuilder::new()
        .set_buckets_for_metric(Matcher::Suffix("_seconds".into()), SECONDS)
        .and_then(PrometheusBuilder::install_recorder)
        .map_err(|error| error.to_string())?;
    COUNTERS.iter().for_each(|(name, help)| describe_counter!(*name, *help));
    GAUGES.iter().for_each(|(name, help)| describe_gauge!(*name, *help));
    HISTOGRAMS.iter().for_each(|(name, help)| describe_histogram!(*name, *help));
    Ok(handle)
}

/// Counts a finished request; without a method if it could not be read.
pub fn request(route: &str, method: Option<&Method>, status: StatusCode, seconds: f64) {
    const KNOWN: [Method; 6] =
        [Method::GET, Method::HEAD, Method::POST, Method::PUT, Method::PATCH, Method::DELETE];
    let known = method.filter(|method| KNOWN.contains(method));
    let method = known.map_or("OTHER", Method::as_str).to_owned();
    let labels = [("route", route.to_owned()), ("method", method), ("status", status.as_str().to_owned())];
    counter!("dragtraffic_http_requests_total", &labels).increment(1);
    histogram!("dragtraffic_http_request_seconds", "route" => route.to_owned()).record(seconds);
}

/// Counts work of a kind that ended as `final`, `error`, `superseded` or `cancelled`.
pub fn ended(kind: &'static str, outcome: &'static str) {
    counter!("dragtraffic_work_total", "kind" => kind, "outcome" => outcome).increment(1);
    if kind == "generate" {
        counter!("dragtraffic_generates_total", "outcome" => outcome).increment(1);
    }
}

/// Time of work of a kind: `queue` before a worker took it, `work` after.
pub fn work(kind: &'static str, phase: &'static str, seconds: f64) {
    histogram!("dragtraffic_work_seconds", "kind" => kind, "phase" => phase).record(seconds);
}

/// Time of one phase of a generation: `queue`, `encode`, `initial` or `step`.
pub fn phase(phase: &'static str, seconds: f64) {
    histogram!("dragtraffic_generate_seconds", "phase" => phase).record(seconds);
}

/// Counts a denoising step of an expert.
pub fn step(expert: &'static str) {
    counter!("dragtraffic_steps_total", "expert" => expert).increment(1);
}

/// Counts road users that an expert generated.
pub fn agents(expert: &'static str, count: u64) {
    counter!("dragtraffic_agents_total", "expert" => expert).increment(count);
}

/// Numbers of waiting and running jobs of a lane.
pub fn load(lane: &'static str, queued: usize, running: usize) {
    gauge!("dragtraffic_queue_length", "lane" => lane).set(queued as f64);
    gauge!("dragtraffic_running", "lane" => lane).set(running as f64);
}

/// Counts an event that a slow reader did not get.
pub fn dropped_event() {
    counter!("dragtraffic_events_dropped_total").increment(1);
}

/// Counts an import or export; `format` is a name of the formats table.
pub fn transfer(exports: bool, format: &str, outcome: &'static str) {
    let name = if exports { "dragtraffic_exports_total" } else { "dragtraffic_imports_total" };
    counter!(name, "format" => format.to_owned(), "outcome" => outcome).increment(1);
}

/// Size of the store.
pub fn store(scenes: u64, bytes: u64) {
    gauge!("dragtraffic_store_scenes").set(scenes as f64);
    gauge!("dragtraffic_store_bytes").set(bytes as f64);
}

/// Taken bytes of the budget, and its size.
pub fn memory(taken: u64, most: u64) {
    gauge!("dragtraffic_memory_taken_bytes").set(taken as f64);
    gauge!("dragtraffic_memory_budget_bytes").set(most as f64);
}

/// Facts about this build and its weights.
pub fn identity(weights: impl Iterator<Item = (String, String)>) {
    gauge!("dragtraffic_build_info", "version" => env!("CARGO_PKG_VERSION")).set(1.0);
    for (expert, sha256) in weights {
        gauge!("dragtraffic_weights_info", "expert" => expert, "sha256" => sha256).set(1.0);
    }
    for outcome in ["final", "error", "superseded", "cancelled"] {
        counter!("dragtraffic_generates_total", "outcome" => outcome).increment(0);
    }
    for expert in ["vehicle", "pedestrian", "cyclist"] {
        counter!("dragtraffic_steps_total", "expert" => expert).increment(0);
    }
    for lane in ["quick", "patient", "background", "document"] {
        load(lane, 0, 0);
    }
}
