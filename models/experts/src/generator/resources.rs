//! The resources that all calls of a generator share: experts, threads, clock and tuned numbers.

use super::workers::WorkerPool;
use crate::clock::Clock;
use crate::net::Expert;
use crate::request::GenerateError;
use crate::tuning::Tuning;
use scene::AgentType;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The resources of a call.
pub(super) struct Resources {
    pub(super) experts: Arc<BTreeMap<AgentType, Expert>>,
    pub(super) workers: WorkerPool,
    pub(super) clock: Clock,
    pub(super) tuning: Tuning,
}

impl Resources {
    /// The gate: the expert of an agent type.
    pub(super) fn expert(&self, agent_type: AgentType) -> Result<&Expert, GenerateError> {
        self.experts
            .get(&agent_type)
            .ok_or_else(|| GenerateError::Expert(format!("no expert for {agent_type:?}")))
    }
}
