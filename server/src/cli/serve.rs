//! `dragtraffic serve`: the editor and the HTTP API.

use super::{Common, Exit, Failure, output};
use crate::app::{App, AppParts};
use crate::base::limits::Limits;
use crate::base::{descriptors, metrics};
use crate::http::body::Room;
use crate::http::guard::Guard;
use crate::http::net;
use crate::http::observe::RequestGate;
use crate::routes::router;
use crate::scenes::store::Store;
use crate::scenes::{Catalog, Library};
use crate::work::{self, Pool, PoolLane};
use clap::Args;
use std::net::SocketAddr;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use tokio::net::TcpListener;

/// Flags of `serve`.
#[derive(Args, Clone, Debug)]
pub struct ServeArgs {
    /// IP address to listen on. An address that other machines reach needs --token-file.
    #[arg(long, env = "DRAGTRAFFIC_BIND", default_value = "127.0.0.1")]
    bind: String,
    /// Port to listen on; 0 takes a free port.
    #[arg(long, env = "DRAGTRAFFIC_PORT", default_value_t = 8080)]
    port: u16,
    /// Database file of the saved scenes, created if missing. Default: dragtraffic/scenes.sqlite in the
    /// user's data folder.
    #[arg(long, env = "DRAGTRAFFIC_DB", value_name = "FILE")]
    db: Option<PathBuf>,
    /// Folder of scenario files to list, read-only.
    #[arg(long, env = "DRAGTRAFFIC_DATA", value_name = "DIR")]
    data: Option<PathBuf>,
    /// Additional Host header to accept, with its port, such as scenes.example:8080.
    #[arg(long, value_name = "HOST")]
    allow_host: Vec<String>,
    /// Origin of another web page that may call the API.
    #[arg(long, value_name = "ORIGIN")]
    allow_origin: Vec<String>,
    /// File with a token of at least 32 characters that callers must send; its mode must be 0600.
    #[arg(long, value_name = "FILE")]
    token_file: Option<PathBuf>,
    /// Generations computed in parallel. Default: half the cores.
    #[arg(long, env = "DRAGTRAFFIC_THREADS", value_name = "N")]
    threads: Option<u64>,
    /// Change a limit of /v1/info, such as --limit queue=4.
    #[arg(long, value_name = "NAME=N")]
    limit: Vec<String>,
    /// Refuse imports whose licence allows non-commercial use only.
    #[arg(long)]
    refuse_nc: bool,
    /// Open the editor in the browser.
    #[arg(long)]
    open: bool,
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
    let mut limits = Limits::default();
    for assignment in &args.limit {
        limits.set(assignment).map_err(|reason| Failure::new(Exit::Usage, reason))?;
    }
    if let Some(threads) = args.threads {
        limits.running = threads;
    }
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
    if let Some(folder) = args.data.as_ref().filter(|folder| !folder.is_dir()) {
        return Err(Failure::new(Exit::Usage, format!("--data {}: no such folder", folder.display())));
    }
    let token = args.token_file.as_deref().map(read_token).transpose()?;
    let listener = listen(&args, token.is_some()).await?;
    let address = listener.local_addr()?;
    let guard = Guard::new(address, &args.allow_host, &args.allow_origin, token)
        .map_err(|reason| Failure::new(Exit::Usage, reason))?;
    let db = args.db.clone().map_or_else(default_db, Ok)?;
    let store = Store::open(&db, &limits)
        .map_err(|error| Failure::new(Exit::Failure, format!("{}: {error:#}", db.display())))?;
    let experts::Engine { generator, placer } = common.engine()?;
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let patient = Arc::new(generator.beside(cores - 1));
    let generator = Arc::new(generator);
    let handle = metrics::install().map_err(|reason| Failure::new(Exit::Failure, reason))?;
    metrics::identity(generator.weights().iter().map(|(name, w)| (name.clone(), w.sha256.clone())));
    let pool = Pool::start(&limits)?;
    let cached_bytes = limits.cached_scene_bytes as usize;
    let library = Library::start(args.data.as_deref(), Arc::clone(&pool), cached_bytes)?;
    let app = App::new(AppParts {
        gate: RequestGate { guard: Arc::new(guard), limits: Arc::clone(&limits) },
        catalog: Catalog::new(store, library, Arc::clone(&pool), &limits),
        room: Arc::new(Room::new(&limits)),
        pool,
        generator,
        patient,
        placer: Arc::new(placer),
        warm: AtomicBool::new(false),
        metrics: handle,
        refuse_nc: args.refuse_nc,
        limits: Arc::clone(&limits),
    });
    start_background(&app)?;
    let url = format!("http://{address}/");
    output::print(format!("DragTraffic is at {url}\n").as_bytes())?;
    tracing::info!(%url, db = %db.display(), "serving");
    if args.open {
        open_browser(&url);
    }
    let pool = Arc::clone(&app.pool);
    let stop = async {
        stop_signal().await;
        tracing::info!("stopping");
        pool.close();
    };
    net::serve(listener, router(&app), &limits, stop, || pool.stop()).await;
    app.pool.stop();
    tracing::info!("stopped");
    Ok(())
}

/// Warms the experts and tidies the store once an hour.
fn start_background(app: &App) -> std::io::Result<()> {
    let warmed = app.clone();
    let warm_up = move || {
        // The generator's own threads start here.
        work::give_way(PoolLane::Quick);
        warmed.generator.warm_up();
        warmed.warm.store(true, Ordering::Relaxed);
        tracing::info!("experts are warm");
    };
    std::thread::Builder::new().name("warm-up".into()).spawn(warm_up)?;
    let tidied = app.clone();
    tokio::spawn(async move {
        let mut hour = tokio::time::interval(Duration::from_secs(3_600));
        loop {
            hour.tick().await;
            let done = tidied.catalog.store.drop_unused_maps().await;
            let measured = tidied.catalog.store.measure().await;
            if let Err(error) = done.map(|_| ()).and(measured) {
                tracing::warn!(%error, "store could not be tidied");
            }
        }
    });
    Ok(())
}

async fn listen(args: &ServeArgs, has_token: bool) -> Result<TcpListener, Failure> {
    let wrong = |reason: String| Failure::new(Exit::Usage, format!("--bind {}: {reason}", args.bind));
    let host = args.bind.trim_start_matches('[').trim_end_matches(']');
    let host = if host == "localhost" { "127.0.0.1" } else { host };
    let ip = host.parse::<std::net::IpAddr>().map_err(|_| wrong("an IP address is expected".into()))?;
    if !ip.is_loopback() && !has_token {
        let reason = "other machines could reach this server; give --token-file as well";
        return Err(wrong(reason.into()));
    }
    let address = SocketAddr::new(ip, args.port);
    TcpListener::bind(address).await.map_err(|error| match error.kind() {
        std::io::ErrorKind::AddrInUse => {
            let message = format!("{address} is in use; another one with --port, or 0 for a free one");
            Failure::new(Exit::AddressInUse, message)
        }
        _ => Failure::new(Exit::Failure, format!("{address}: {error}")),
    })
}

fn read_token(path: &Path) -> Result<String, Failure> {
    let wrong =
        |reason: &str| Failure::new(Exit::Usage, format!("--token-file {}: {reason}", path.display()));
    let text = std::fs::read_to_string(path).map_err(|error| wrong(&error.to_string()))?;
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        let mode = std::fs::metadata(path)?.permissions().mode();
        if mode & 0o077 != 0 {
            return Err(wrong("others may read it; use chmod 600"));
        }
    }
    let token = text.trim();
    if token.len() < 32 || token.contains(char::is_whitespace) || !token.is_ascii() {
        return Err(wrong("one line of at least 32 characters is expected"));
    }
    Ok(token.to_owned())
}

/// `dragtraffic/scenes.sqlite` in the user's data folder, else in this folder.
pub(super) fn default_db() -> Result<PathBuf, Failure> {
    let variable = |name| std::env::var_os(name).filter(|v| !v.is_empty()).map(PathBuf::from);
    let data = variable("XDG_DATA_HOME").or_else(|| variable("HOME").map(|home| home.join(".local/share")));
    let Some(folder) = data.map(|data| data.join("dragtraffic")) else {
        return Ok(PathBuf::from("dragtraffic.sqlite"));
    };
    std::fs::create_dir_all(&folder)
        .map_err(|error| Failure::new(Exit::Failure, format!("{}: {error}", folder.display())))?;
    Ok(folder.join("scenes.sqlite"))
}

fn open_browser(url: &str) {
    let program = if cfg!(target_os = "macos") { "open" } else { "xdg-open" };
    if let Err(error) = std::process::Command::new(program).arg(url).spawn() {
        tracing::warn!(%error, "no browser could be opened; go to {url}");
    }
}

async fn stop_signal() {
    #[cfg(unix)]
    {
        use tokio::signal::unix::{SignalKind, signal};
        if let Ok(mut terminate) = signal(SignalKind::terminate()) {
            tokio::select! {
                _ = tokio::signal::ctrl_c() => {}
                _ = terminate.recv() => {}
            }
            return;
        }
    }
    let _ = tokio::signal::ctrl_c().await;
}
