//! Follows the steps of a run that another client makes.

use super::LastStep;
use crate::http::accept::ReplyFormat;
use crate::http::net::Carrier;
use api::Problem;
use api::runs::{RunEvent, RunReply};
use axum::body::Bytes;
use axum::response::Response;
use base::places::TakenPlace;
use futures_util::stream::unfold;
use serde_json::value::RawValue;
use std::time::Duration;
use tokio::sync::watch;

/// A follower of a run. It does not hold the run: when the run is dropped, the follower ends.
pub struct Follower {
    /// Its first message.
    begun: Option<Bytes>,
    steps: watch::Receiver<LastStep>,
    form: ReplyFormat,
    heartbeat: Duration,
    carrier: Option<Carrier>,
    done: bool,
    _place: TakenPlace,
}

impl Follower {
    /// A follower of a run in its present state, and of its steps from now on.
    ///
    /// # Errors
    /// When the run cannot be written as JSON.
    pub fn new(
        run: RunReply,
        steps: watch::Receiver<LastStep>,
        (form, heartbeat): (ReplyFormat, Duration),
        (carrier, place): (Option<Carrier>, TakenPlace),
    ) -> Result<Self, Problem> {
        let number = run.present.number;
        let event = RunEvent::<StepText<'_>>::Run { run: Box::new(run) };
        let begun = Some(written(form, "run", number, &event)?);
        Ok(Self { begun, steps, form, heartbeat, carrier, done: false, _place: place })
    }

    /// The stream of events.
    pub fn reply(self) -> Response {
        let form = self.form;
        form.streamed(unfold(self, |mut of| async move { of.next().await.map(|bytes| (bytes, of)) }))
    }

    async fn next(&mut self) -> Option<Bytes> {
        if let Some(begun) = self.begun.take() {
            return Some(begun);
        }
        if self.done {
            return None;
        }
        let changed = tokio::select! {
            changed = tokio::time::timeout(self.heartbeat, self.steps.changed()) => changed,
            () = closing(&mut self.carrier) => return None,
        };
        match changed {
            Err(_) => Some(self.form.sign_of_life()),
            Ok(Err(_)) => {
                self.done = true;
                let number = self.steps.borrow().as_ref().map_or(0, |(number, _)| *number);
                written(self.form, "end", number, &RunEvent::<StepText<'_>>::End).ok()
            }
            Ok(Ok(())) => {
                let (number, reply) = self.steps.borrow_and_update().clone()?;
                let step = serde_json::from_slice(&reply).ok()?;
                written(self.form, "step", number, &RunEvent::<StepText<'_>>::Step { step }).ok()
            }
        }
    }
}

/// The reply to a step, as it was sent.
type StepText<'a> = &'a RawValue;

/// Resolves when the server shuts down; never without a carrier.
async fn closing(carrier: &mut Option<Carrier>) {
    match carrier {
        Some(carrier) => carrier.closes().await,
        None => std::future::pending().await,
    }
}

fn written(
    form: ReplyFormat,
    name: &str,
    number: u64,
    event: &RunEvent<StepText<'_>>,
) -> Result<Bytes, Problem> {
    let mut bytes = Vec::new();
    form.write(name, number, &serde_json::to_vec(event).map_err(Problem::internal)?, &mut bytes);
    Ok(bytes.into())
}
