//! `dragtraffic serve`: the editor and the HTTP API.

use super::listen::ServerEndpoint;
use super::plan::ServePlan;
use super::{Common, Exit, Failure, config, output};
use crate::app::{App, AppParts};
use crate::grpc::GrpcListener;
use crate::http::audit::AuditLog;
use crate::http::body::Room;
use crate::http::guard::Guard;
use crate::http::net;
use crate::http::observe::RequestGate;
use crate::http::proxies::TrustedProxies;
use crate::http::stream::Listener;
use crate::routes::router;
use crate::runs::RunStore;
use crate::scenes::store::{Store, StoreError};
use crate::scenes::{Catalog, Library};
use api::Operations;
use base::limits::Limits;
use base::memory::Memory;
use base::rates::PartyRates;
use base::{base_path, descriptors, metrics};
use clap::{Args, FromArgMatches};
use std::net::SocketAddr;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use tokio::net::TcpListener;
use tokio::signal::unix::{SignalKind, signal};
use work::{Pool, PoolLane};

/// Flags of `serve`.
#[derive(Args, Clone, Debug)]
pub struct ServeArgs {
    /// IP address to listen on. An address that other machines reach needs --token-file.
    #[arg(long, env = "DRAGTRAFFIC_BIND", default_value = "127.0.0.1")]
    pub(super) bind: String,
    /// Port to listen on; 0 takes a free port.
    #[arg(long, env = "DRAGTRAFFIC_PORT", default_value_t = 8080)]
    pub(super) port: u16,
    /// Listen on a unix socket instead: unix:PATH. A stale socket is replaced.
    #[arg(long, env = "DRAGTRAFFIC_LISTEN", value_name = "unix:PATH")]
    pub(super) listen: Option<String>,
    /// Mode of the unix socket, octal.
    #[arg(long, env = "DRAGTRAFFIC_SOCKET_MODE", value_name = "MODE", default_value = "600")]
    pub(super) socket_mode: String,
    /// Path below which a proxy publishes this server, such as /tools/drag.
    #[arg(long, env = "DRAGTRAFFIC_BASE_PATH", value_name = "PATH", default_value = "")]
    pub(super) base_path: String,
    /// Address or network of a proxy, or unix: its X-Forwarded-For and X-Forwarded-User name the client.
    #[arg(long, env = "DRAGTRAFFIC_TRUST_PROXY", value_name = "ADDRESS", value_delimiter = ',')]
    pub(super) trust_proxy: Vec<String>,
    /// Database file of the saved scenes, created if missing. Default: dragtraffic/scenes.sqlite in the
    /// user's data folder.
    #[arg(long, env = "DRAGTRAFFIC_DB", value_name = "FILE")]
    pub(super) db: Option<PathBuf>,
    /// Folder of recorded scenes to list, read-only.
    #[arg(long, env = "DRAGTRAFFIC_DATA", value_name = "DIR")]
    pub(super) data: Option<PathBuf>,
    /// Additional Host header to accept, with its port, such as scenes.example:8080.
    #[arg(long, env = "DRAGTRAFFIC_ALLOW_HOST", value_name = "HOST", value_delimiter = ',')]
    allow_host: Vec<String>,
    /// Origin of another web page that may call the API.
    #[arg(long, env = "DRAGTRAFFIC_ALLOW_ORIGIN", value_name = "ORIGIN", value_delimiter = ',')]
    allow_origin: Vec<String>,
    /// File with a token of at least 32 characters that callers must send, or with lines NAME RIGHT TOKEN (read, edit,
    /// admin). Its mode is at most 0600, or 0640 for a file of root. A changed file is read again.
    #[arg(long, env = "DRAGTRAFFIC_TOKEN_FILE", value_name = "FILE")]
    pub(super) token_file: Option<PathBuf>,
    /// Scenes belong to the user who made them, a token's name or X-Forwarded-User: others see what is shared.
    #[arg(long, env = "DRAGTRAFFIC_OWNERS")]
    pub(super) owners: bool,
    /// Generations computed in parallel. Default: half the cores.
    #[arg(long, env = "DRAGTRAFFIC_THREADS", value_name = "N")]
    pub(super) threads: Option<u64>,
    /// Change a limit of /v1/info, such as --limit queue=4.
    #[arg(long, env = "DRAGTRAFFIC_LIMIT", value_name = "NAME=N", value_delimiter = ',')]
    pub(super) limit: Vec<String>,
    /// Memory of the server, such as 512m or 2g (limit memory_bytes): requests that do not fit are refused.
    #[arg(long, env = "DRAGTRAFFIC_MEMORY", value_name = "SIZE")]
    pub(super) memory: Option<String>,
    /// Refuse imports whose licence allows non-commercial use only.
    #[arg(long, env = "DRAGTRAFFIC_REFUSE_NC")]
    refuse_nc: bool,
    /// Address such as 127.0.0.1:9090 that answers /healthz, /readyz and /metrics without token.
    #[arg(long, env = "DRAGTRAFFIC_OPS_ADDRESS", value_name = "IP:PORT")]
    pub(super) ops_address: Option<String>,
    /// Port on 127.0.0.1 for AlpaSim's TrafficService over gRPC; 0 takes a free port. It has no tokens: every process on
    /// this machine may call it.
    #[arg(long, env = "DRAGTRAFFIC_GRPC", value_name = "PORT")]
    pub(super) grpc: Option<u16>,
    /// File for the audit log, one JSON object per line: changes of scenes, refusals of tokens and rights. - is
    /// standard output.
    #[arg(long, env = "DRAGTRAFFIC_AUDIT", value_name = "FILE")]
    audit: Option<String>,
    /// Size at which an audit file is rotated, bytes; five older ones are kept.
    #[arg(long, env = "DRAGTRAFFIC_AUDIT_BYTES", value_name = "N", default_value_t = 100_000_000)]
    audit_bytes: u64,
    /// TOML file with options by name, such as port = 9000; the command line and the environment override it.
    #[arg(long, env = "DRAGTRAFFIC_CONFIG", value_name = "FILE")]
    config: Option<PathBuf>,
    /// Print what the server would do, or every fault of the options, and exit.
    #[arg(long)]
    check: bool,
    /// Open the editor in the browser.
    #[arg(long, env = "DRAGTRAFFIC_OPEN")]
    open: bool,
}

impl ServeArgs {
    /// The options that environment variables and the configuration file set.
    ///
    /// # Errors
    /// Exit 2.
    pub(super) fn of_environment() -> Result<Self, Failure> {
        let refused = |error: clap::Error| Failure::usage(error.to_string());
        let command = Self::augment_args(clap::Command::new("serve"));
        let mut matches = command.clone().try_get_matches_from(["serve"]).map_err(refused)?;
        if let Some(command) = config::with_file(command, &matches).map_err(Failure::usage)? {
            matches = command.try_get_matches_from(["serve"]).map_err(refused)?;
        }
        Self::from_arg_matches(&matches).map_err(refused)
    }
}

/// Serves until stopped.
///
/// # Errors
/// Exit 1, 2, 6 or 7.
pub fn run(args: ServeArgs, common: &Common) -> Result<(), Failure> {
    let runtime = tokio::runtime::Builder::new_multi_thread()
        .worker_threads(2)
        .thread_name("network")
        .enable_all()
        .build()?;
    let result = runtime.block_on(serve(args, common));
    runtime.shutdown_timeout(Duration::from_secs(1));
    result
}

async fn serve(args: ServeArgs, common: &Common) -> Result<(), Failure> {
    let plan = ServePlan::of(&args)?;
    if args.check {
        common.engine()?;
        return output::print(plan.lines(&args).as_bytes());
    }
    let stopped = stop_signal()?;
    let ServePlan { mut limits, tokens, proxies, endpoint, ops, db } = plan;
    let wanted = limits.connections;
    limits.connections = descriptors::connections(wanted);
    if limits.connections < wanted {
        let most = limits.connections;
        tracing::warn!(
            wanted,
            most,
            "fewer connections than the limit: the process may not have more descriptors"
        );
    }
    let limits = Arc::new(limits);
    let (listener, address) = endpoint.listen().await?;
    let guard = Guard::new(address, &args.allow_host, &args.allow_origin, tokens)
        .map_err(|reason| Failure::new(Exit::Usage, reason))?;
    if args.db.is_none() {
        default_db()?;
    }
    let store = Store::open(&db, &limits)
        .map_err(|error| Failure::new(Exit::Failure, format!("{}: {error:#}", db.display())))?;
    let operations = Operations { limits: limits.of_a_call(), ..common.operations()? };
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let handle = metrics::install().map_err(|reason| Failure::new(Exit::Failure, reason))?;
    metrics::identity(
        operations.generator.weights().iter().map(|(name, w)| (name.clone(), w.sha256.clone())),
    );
    let pool = Pool::start(&limits)?;
    let memory = Memory::new(limits.budget_bytes());
    let of_library = (&memory, limits.cached_scene_bytes);
    let library = Library::start(args.data.as_deref(), Arc::clone(&pool), of_library)?;
    let audit = args.audit.as_deref().map(|target| AuditLog::open(target, args.audit_bytes));
    let audit =
        audit.transpose().map_err(|error| Failure::new(Exit::Failure, format!("--audit: {error}")))?;
    let app = App::new(AppParts {
        gate: RequestGate {
            guard: Arc::new(guard),
            limits: Arc::clone(&limits),
            rates: Arc::new(PartyRates::new(&limits)),
            audit: audit.map(Arc::new),
            sample: Arc::default(),
        },
        catalog: Catalog::new(store, library, Arc::clone(&pool), &limits, &memory),
        owners: args.owners,
        room: Arc::new(Room::new(&limits, &memory)),
        pool,
        patient: operations.beside(cores - 1),
        operations,
        runs: RunStore::new(&limits, &memory),
        warm: AtomicBool::new(false),
        metrics: handle,
        refuse_nc: args.refuse_nc,
        limits: Arc::clone(&limits),
    });
    start_background(&app)?;
    if let Some(address) = ops {
        answer_probes(address, &app).await?;
    }
    let url = match &endpoint {
        ServerEndpoint::File(path, _) => format!("unix:{}", path.display()),
        ServerEndpoint::Address(asked) => {
            format!("http://{}{}", address.unwrap_or(*asked), base_path::published("/"))
        }
    };
    output::print(format!("DragTraffic is at {url}\n").as_bytes())?;
    tracing::info!(%url, db = %db.display(), "serving");
    if let Some(port) = args.grpc {
        answer_simulators(port, &app).await?;
    }
    if args.open {
        open_browser(&url);
    }
    let pool = Arc::clone(&app.pool);
    let stop = async {
        stopped.await;
        tracing::info!("stopping");
        pool.close();
    };
    net::serve(listener, router(&app), proxies, (&limits, &memory), stop, || pool.stop()).await;
    app.pool.stop();
    if let ServerEndpoint::File(path, _) = &endpoint {
        let _ = std::fs::remove_file(path);
    }
    tracing::info!("stopped");
    Ok(())
}

/// Warms the experts up, watches the token file, and cleans the store once an hour.
fn start_background(app: &App) -> std::io::Result<()> {
    let warmed = app.clone();
    let warm_up = move || {
        // The generator's own threads start here.
        work::give_way(PoolLane::Quick);
        warmed.operations.generator.warm_up();
        warmed.warm.store(true, Ordering::Relaxed);
        tracing::info!("experts are warm");
    };
    std::thread::Builder::new().name("warm-up".into()).spawn(warm_up)?;
    if let Some(tokens) = app.gate.guard.tokens.clone() {
        tokio::spawn(async move { tokens.follow().await });
    }
    let idle = app.clone();
    tokio::spawn(async move {
        let mut minute = tokio::time::interval(Duration::from_secs(60));
        loop {
            minute.tick().await;
            idle.runs.tidy();
        }
    });
    let tidied = app.clone();
    tokio::spawn(async move {
        let mut hour = tokio::time::interval(Duration::from_secs(3_600));
        loop {
            hour.tick().await;
            if let Err(error) = tidy(&tidied.catalog.store).await {
                tracing::warn!(%error, "store could not be tidied");
            }
        }
    });
    Ok(())
}

/// Deletes what is kept for a time only.
async fn tidy(store: &Store) -> Result<(), StoreError> {
    for id in store.drop_old_scenes().await? {
        tracing::info!(id, "deleted: not changed for `scene_keep_days`");
    }
    store.drop_unused_maps().await?;
    store.measure().await
}

/// `dragtraffic/scenes.sqlite` in the user's data folder, else in this folder.
pub(super) fn db_path() -> PathBuf {
    let variable = |name| std::env::var_os(name).filter(|v| !v.is_empty()).map(PathBuf::from);
    let data = variable("XDG_DATA_HOME").or_else(|| variable("HOME").map(|home| home.join(".local/share")));
    data.map_or_else(|| "dragtraffic.sqlite".into(), |data| data.join("dragtraffic/scenes.sqlite"))
}

/// The same; its folder is created.
pub(super) fn default_db() -> Result<PathBuf, Failure> {
    let path = db_path();
    let folder = path.parent().unwrap_or(&path);
    std::fs::create_dir_all(folder)
        .map_err(|error| Failure::new(Exit::Failure, format!("{}: {error}", folder.display())))?;
    Ok(path)
}

/// Whether the configuration file may contain this option.
pub(super) fn is_option(name: &str) -> bool {
    let command = Common::augment_args(ServeArgs::augment_args(clap::Command::new("serve")));
    let named = command.get_arguments().any(|arg| arg.get_long() == Some(name));
    named && !["config", "check"].contains(&name)
}

fn open_browser(url: &str) {
    let program = if cfg!(target_os = "macos") { "open" } else { "xdg-open" };
    if let Err(error) = std::process::Command::new(program).arg(url).spawn() {
        tracing::warn!(%error, "no browser could be opened; go to {url}");
    }
}

/// Maximum number of connections to `--ops-address`.
const PROBES: u64 = 16;

/// Answers `/healthz`, `/readyz` and `/metrics` on a separate address, without token.
async fn answer_probes(address: SocketAddr, app: &App) -> Result<(), Failure> {
    let refused = |error| Failure::new(Exit::Failure, format!("--ops-address {address}: {error}"));
    let listener = TcpListener::bind(address).await.map_err(refused)?;
    tracing::info!(address = %listener.local_addr()?, "answers probes");
    let (router, memory) = (crate::routes::probes(app), Arc::clone(&app.room.memory));
    let limits = Limits { connections: PROBES, ..Limits::clone(&app.limits) };
    let served = async move {
        let (listener, none) = (Listener::Tcp(listener), TrustedProxies::default());
        net::serve(listener, router, none, (&limits, &memory), std::future::pending(), || ()).await;
    };
    tokio::spawn(served);
    Ok(())
}

/// Answers calls of AlpaSim's `TrafficService` on a port of this machine.
async fn answer_simulators(port: u16, app: &App) -> Result<(), Failure> {
    let refused = |error| Failure::new(Exit::AddressInUse, format!("--grpc {port}: {error}"));
    let listener = GrpcListener::open(SocketAddr::from(([127, 0, 0, 1], port))).await.map_err(refused)?;
    output::print(format!("TrafficService is at {}\n", listener.address()?).as_bytes())?;
    let app = app.clone();
    tokio::spawn(async move { listener.serve(&app).await });
    Ok(())
}

/// A request to stop. Registered before this returns, so no later request is missed.
fn stop_signal() -> std::io::Result<impl Future<Output = ()>> {
    let (mut interrupt, mut terminate) = (signal(SignalKind::interrupt())?, signal(SignalKind::terminate())?);
    Ok(async move {
        tokio::select! {
            _ = interrupt.recv() => {}
            _ = terminate.recv() => {}
        }
    })
}
