//! `dragtraffic mcp`: the operations as tools for a language model, by the Model Context Protocol over
//! standard input and output. Standard output carries only the protocol.

mod ask;
mod describe;
mod desk;
mod folders;
mod give;
mod handler;
mod judge;
mod open;
mod schema;
mod search;
mod tools;

use super::values::whole;
use super::{Common, Exit, Failure};
use api::Operations;
use base::limits::Limits;
use base::memory::Memory;
use clap::Args;
use desk::SceneDesk;
use folders::AllowedFolders;
use handler::SceneServer;
use rmcp::ServiceExt;
use rmcp::service::ServerInitializeError;
use rmcp::transport::async_rw::AsyncRwTransport;
use std::path::PathBuf;
use std::time::Duration;
use tools::Toolbox;

/// Flags of `mcp`.
#[derive(Args, Clone, Debug)]
pub struct McpArgs {
    /// Folder whose files the client may open and that it may export into; may be given several times. Default: none,
    /// only the example scenes.
    #[arg(long, value_name = "DIR")]
    folder: Vec<PathBuf>,
    /// Scenes that may be open at the same time.
    #[arg(long, value_name = "N", default_value_t = 16, value_parser = whole(1, 256))]
    scenes: u64,
    /// Change a limit of the server, such as --limit generate_s=20: generate_s, work_s, cached_scene_bytes,
    /// regenerated_agents, reply_points, json_encoded_bytes.
    #[arg(long, value_name = "NAME=N", value_delimiter = ',')]
    limit: Vec<String>,
}

/// Serves a client until it closes standard input.
///
/// # Errors
/// Exit 1, 2 or 7.
pub fn run(args: McpArgs, common: &Common) -> Result<(), Failure> {
    let mut limits = Limits::default();
    for assignment in &args.limit {
        limits.set(assignment).map_err(Failure::usage)?;
    }
    let folders = AllowedFolders::open(&args.folder).map_err(Failure::usage)?;
    let operations = Operations { limits: limits.of_a_call(), ..common.operations()? };
    let desk = SceneDesk::new(args.scenes as usize, Memory::new(limits.cached_scene_bytes));
    let patience = Duration::from_secs(limits.generate_s);
    let server = SceneServer::new(Toolbox { operations, desk, folders, patience }, patience);
    let runtime = tokio::runtime::Builder::new_multi_thread().worker_threads(2).enable_all().build()?;
    let result = runtime.block_on(answer(server, limits.json_encoded_bytes));
    // A thread that waits for standard input does not end by itself.
    runtime.shutdown_timeout(Duration::from_secs(1));
    result
}

async fn answer(server: SceneServer, line_bytes: u64) -> Result<(), Failure> {
    let failed = |error: String| Failure::new(Exit::Failure, error);
    let most = usize::try_from(line_bytes).unwrap_or(usize::MAX);
    let transport = AsyncRwTransport::new(tokio::io::stdin(), tokio::io::stdout()).with_max_line_length(most);
    let running = match server.serve(transport).await {
        Ok(running) => running,
        // The client left before its first message.
        Err(ServerInitializeError::ConnectionClosed(_)) => return Ok(()),
        Err(error) => return Err(failed(format!("the client does not speak the protocol: {error}"))),
    };
    running.waiting().await.map(|_| ()).map_err(|error| failed(error.to_string()))
}
