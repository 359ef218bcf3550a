//! Shards of a batch on several threads. A batch is cut into shards of a fixed size. Their results are summed
//! in order, so the sums do not depend on the number of threads.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::metrics::Metrics;
use super::optim::Gradients;
use super::sample::{Shard, stream};
use super::stages::{Stage, Tools};
use super::trainee::Trainee;
use super::{Records, TrainError};

/// Records in a shard on the CPU.
pub(super) const SHARD: usize = 32;

/// Data shared by all shards.
pub(super) struct Workers<'a> {
    pub(super) records: &'a Records,
    pub(super) tools: Tools,
    pub(super) stage: Stage,
    pub(super) seed: u64,
    /// Records in a shard.
    pub(super) shard: usize,
    pub(super) threads: usize,
}

impl Workers<'_> {
    /// The mean gradient of a batch, and its metrics.
    pub(super) fn train(
        &self,
        trained: &impl Trainee,
        indices: &[usize],
        step: u64,
    ) -> Result<(Gradients, Metrics), TrainError> {
        let results =
            self.each_shard(indices, |number, shard| self.shard_gradient(trained, shard, step, number))?;
        let mut metrics = Metrics::default();
        let mut sums: Gradients = vec![None; trained.vars().len()];
        for (gradients, measured) in results {
            metrics.merge(&measured);
            for (sum, gradient) in sums.iter_mut().zip(gradients) {
                match (sum, gradient) {
                    (Some(sum), Some(gradient)) => sum.iter_mut().zip(gradient).for_each(|(s, g)| *s += g),
                    (sum, Some(gradient)) => *sum = Some(gradient),
                    (_, None) => {}
                }
            }
        }
        let share = 1.0 / indices.len().max(1) as f32;
        sums.iter_mut().flatten().flatten().for_each(|g| *g *= share);
        Ok((sums, metrics))
    }

    fn shard_gradient(
        &self,
        trained: &impl Trainee,
        indices: &[usize],
        step: u64,
        number: usize,
    ) -> Result<(Gradients, Metrics), TrainError> {
        let mut rng = stream(self.seed, step, 1 + number as u64);
        let shard = Shard::new(self.records, indices, &self.tools.route)?;
        let (loss, metrics) = trained.loss(&self.tools, &shard, self.stage, &mut rng)?;
        let mut store = loss.backward()?;
        let gradients = trained.vars().values().map(|var| match store.remove(var.as_tensor()) {
            Some(gradient) => Ok(Some(gradient.flatten_all()?.to_vec1::<f32>()?)),
            None => Ok(None),
        });
        Ok((gradients.collect::<Result<_, TrainError>>()?, metrics))
    }

    /// Metrics on held-out records; the draws are the same every time.
    pub(super) fn validate(&self, trained: &impl Trainee, indices: &[usize]) -> Result<Metrics, TrainError> {
        let results = self.each_shard(indices, |number, indices| {
            let shard = Shard::new(self.records, indices, &self.tools.route)?;
            let mut rng = stream(self.seed, u64::MAX >> 16, number as u64);
            trained.validate(&self.tools, &shard, self.stage, &mut rng)
        })?;
        let mut metrics = Metrics::default();
        results.iter().for_each(|measured| metrics.merge(measured));
        Ok(metrics)
    }

    /// Runs all shards; each thread takes the next one. Returns the results in the shards' order.
    fn each_shard<T: Send>(
        &self,
        indices: &[usize],
        work: impl Fn(usize, &[usize]) -> Result<T, TrainError> + Sync,
    ) -> Result<Vec<T>, TrainError> {
        let shards: Vec<&[usize]> = indices.chunks(self.shard.max(1)).collect();
        let next = AtomicUsize::new(0);
        let results: Mutex<Vec<Option<Result<T, TrainError>>>> =
            Mutex::new(std::iter::repeat_with(|| None).take(shards.len()).collect());
        let run = || {
            loop {
                let number = next.fetch_add(1, Ordering::Relaxed);
                let Some(shard) = shards.get(number) else { break };
                let result = work(number, shard);
                if let Ok(mut results) = results.lock() {
                    results[number] = Some(result);
                }
            }
        };
        std::thread::scope(|scope| {
            for number in 1..self.threads.min(shards.len()) {
                let thread = std::thread::Builder::new().name(format!("train-{number}"));
                // If the system refuses another thread, the existing ones do the work.
                if thread.spawn_scoped(scope, run).is_err() {
                    break;
                }
            }
            run();
        });
        let results = results.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
        let stopped = || TrainError::Invalid("a training thread stopped".into());
        results.into_iter().map(|result| result.unwrap_or_else(|| Err(stopped()))).collect()
    }
}
