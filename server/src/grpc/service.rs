//! The calls of the service, and its open sessions: limited in number and dropped when idle, like runs.

use super::messages::{
    InterfaceVersion, Nothing, SceneNames, ServiceMetadata, ServiceVersion, SessionBegin, SessionEnd,
    TrafficAnswer, TrafficQuery,
};
use super::session::TrafficSession;
use crate::app::App;
use crate::http::idempotency::Sender;
use crate::scenes::length;
use api::{Code, Problem, english};
use base::memory::MemoryShare;
use prost::Message;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use tonic::body::Body;
use tonic::server::Grpc;
use tonic::{Request, Response, Status};
use tonic_prost::ProstCodec;
use work::{JobKind, JobRequest};

/// Name of the service.
const SERVICE: &str = "/traffic.TrafficService/";
/// Version of the interface that defines the messages.
const INTERFACE: InterfaceVersion = InterfaceVersion { major: 0, minor: 0, patch: 0 };
/// Approximate time of one road user's first plan, and of the steps of a query.
const FIRST_PLAN: Duration = Duration::from_millis(3);
const QUESTION: Duration = Duration::from_millis(10);
/// Memory of a session, as a multiple of its scene's bytes: its run has plans and a history.
const OF_SCENE: usize = 3;

struct OpenSession {
    session: Arc<tokio::sync::Mutex<TrafficSession>>,
    used: Instant,
    /// Released with the session.
    _memory: MemoryShare,
}

/// The service. Cheap to clone.
#[derive(Clone)]
pub struct TrafficCarrier {
    app: App,
    sessions: Arc<Mutex<BTreeMap<String, OpenSession>>>,
}

impl TrafficCarrier {
    /// The service over the scenes and the engine of a server.
    pub fn new(app: &App) -> Self {
        Self { app: app.clone(), sessions: Arc::default() }
    }

    /// Answers a call.
    pub async fn answer(&self, request: axum::http::Request<Body>) -> axum::http::Response<Body> {
        let call = request.uri().path().strip_prefix(SERVICE).map(str::to_owned);
        match call.as_deref() {
            Some("start_session") => self.unary(request, Self::start).await,
            Some("close_session") => self.unary(request, Self::close).await,
            Some("simulate") => self.unary(request, Self::simulate).await,
            Some("get_metadata") => self.unary(request, Self::metadata).await,
            Some("get_available_scenes") => self.unary(request, Self::scenes).await,
            _ => Status::unimplemented("this server has traffic.TrafficService and no other service")
                .into_http(),
        }
    }

    async fn unary<Asked, Reply, Work>(
        &self,
        request: axum::http::Request<Body>,
        call: fn(Self, Asked) -> Work,
    ) -> axum::http::Response<Body>
    where
        Asked: Message + Default + 'static,
        Reply: Message + 'static,
        Work: Future<Output = Result<Reply, Problem>> + Send,
    {
        let most = usize::try_from(self.app.limits.json_encoded_bytes).unwrap_or(usize::MAX);
        let codec = ProstCodec::<Reply, Asked>::default();
        let service = tower::service_fn(|request: Request<Asked>| {
            let work = call(self.clone(), request.into_inner());
            async move { work.await.map(Response::new).map_err(|problem| status(&problem)) }
        });
        Grpc::new(codec).max_decoding_message_size(most).unary(service, request).await
    }

    async fn start(self, request: SessionBegin) -> Result<Nothing, Problem> {
        let base = self.app.catalog_of(&Sender::default()).whole(&request.scene_id).await?;
        let work = move |_: &_| Ok((TrafficSession::begin(&request, &base)?, request.session_uuid));
        let (session, uuid) = self.app.pool.run(asked(QUESTION), work).await?;
        let bytes = OF_SCENE * length::of_scene(session.scene());
        let full = || Problem::of(Code::TooManyRuns, english::too_many_runs());
        let memory = self.app.runs.room(bytes).ok_or_else(full)?;
        let mut sessions = self.open();
        if sessions.len() as u64 >= self.app.limits.runs && !sessions.contains_key(&uuid) {
            return Err(full());
        }
        let session = Arc::new(tokio::sync::Mutex::new(session));
        sessions.insert(uuid, OpenSession { session, used: Instant::now(), _memory: memory });
        Ok(Nothing {})
    }

    async fn simulate(self, request: TrafficQuery) -> Result<TrafficAnswer, Problem> {
        let mut session = {
            let mut sessions = self.open();
            let open = sessions.get_mut(&request.session_uuid).ok_or_else(unknown)?;
            open.used = Instant::now();
            Arc::clone(&open.session)
        }
        .lock_owned()
        .await;
        let scene = Arc::clone(session.scene());
        let cost = FIRST_PLAN * scene.agents.len() as u32 + self.app.map_preparation(&scene.map).await?;
        let generator = Arc::clone(&self.app.operations.generator);
        let work = move |cancel: &_| {
            let updates = &request.object_trajectory_updates;
            session.simulate(request.time_query_us, updates, &generator, cancel)
        };
        let object_trajectory_updates = self.app.pool.run(asked(cost), work).await?;
        Ok(TrafficAnswer { object_trajectory_updates })
    }

    async fn close(self, request: SessionEnd) -> Result<Nothing, Problem> {
        self.open().remove(&request.session_uuid).map(|_| Nothing {}).ok_or_else(unknown)
    }

    async fn metadata(self, _: Nothing) -> Result<ServiceMetadata, Problem> {
        let version_id = Some(ServiceVersion {
            version_id: format!("dragtraffic-{}", env!("CARGO_PKG_VERSION")),
            git_hash: String::new(),
            grpc_api_version: Some(INTERFACE),
        });
        Ok(ServiceMetadata { version_id, minimum_history_length_us: 0 })
    }

    async fn scenes(self, _: Nothing) -> Result<SceneNames, Problem> {
        let scene_ids = self.app.catalog.library.items().into_iter().map(|item| item.id).collect();
        Ok(SceneNames { scene_ids })
    }

    /// The sessions, without idle ones.
    fn open(&self) -> MutexGuard<'_, BTreeMap<String, OpenSession>> {
        let mut sessions = self.sessions.lock().unwrap_or_else(PoisonError::into_inner);
        let idle = Duration::from_secs(self.app.runs.idle_s());
        // A session in use is held by its call.
        sessions.retain(|_, open| open.used.elapsed() < idle || Arc::strong_count(&open.session) > 1);
        sessions
    }
}

fn asked(cost: Duration) -> JobRequest {
    JobRequest { kind: JobKind::Run, cost, caller: Default::default() }
}

fn unknown() -> Problem {
    Problem::new(
        Code::NotFound,
        "No session has this id. A server forgets sessions that are not used for a while.",
    )
}

/// Converts a problem to a gRPC status, with its code before the sentence.
fn status(problem: &Problem) -> Status {
    let words = format!("{}: {}", problem.code.name(), problem.detail);
    match problem.code {
        Code::NotFound => Status::not_found(words),
        Code::Cancelled => Status::cancelled(words),
        Code::GenerateTimeout => Status::deadline_exceeded(words),
        Code::TooManyRuns | Code::Busy => Status::resource_exhausted(words),
        Code::ShuttingDown | Code::StoreUnavailable => Status::unavailable(words),
        Code::Internal => {
            tracing::error!(cause = problem.cause.as_deref(), "defect");
            Status::internal(words)
        }
        Code::StepOrder => Status::failed_precondition(words),
        _ => Status::invalid_argument(words),
    }
}
