//! The protocol: lists the tools, and runs one call after the other, each within its time limit.

use super::tools::{self, TOOLS, ToolAnswer, Toolbox};
use api::problem::ProblemMembers;
use api::{Code, Problem};
use base::problem::logged;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use experts::Cancel;
use rmcp::ServerHandler;
use rmcp::model::{
    CallToolRequestParams, CallToolResponse, CallToolResult, ContentBlock, ErrorData, Implementation,
    ListToolsResult, PaginatedRequestParams, ServerCapabilities, ServerConfig,
};
use rmcp::service::{RequestContext, RoleServer};
use serde::Serialize;
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::Semaphore;

/// Description of this server for a client's model.
const INSTRUCTIONS: &str = "\
Traffic scenes: open an example or a file, look at it, place road users, give goals, ask for futures, score, search, export. \
Begin with list_scenes or open_scene. Positions are in metres (x east, y north), headings in radians from east, counter-clockwise, \
times in seconds of the scene. A goal is a place (x_m, y_m), or with frame agent an offset from the start (ahead_m, left_m).";

/// Answers the calls of one client.
#[derive(Clone)]
pub struct SceneServer {
    toolbox: Arc<Toolbox>,
    /// One call runs at a time, because each may use all cores.
    turn: Arc<Semaphore>,
    /// Time limit of a call, including its wait.
    patience: Duration,
}

impl SceneServer {
    /// A server with these tools.
    pub fn new(toolbox: Toolbox, patience: Duration) -> Self {
        Self { toolbox: Arc::new(toolbox), turn: Arc::new(Semaphore::new(1)), patience }
    }

    async fn answer(
        &self,
        request: CallToolRequestParams,
        context: RequestContext<RoleServer>,
    ) -> Result<Result<ToolAnswer, Problem>, ErrorData> {
        let Some(tool) = tools::named(&request.name) else {
            let shown: String = request.name.chars().take(64).collect();
            return Err(ErrorData::invalid_params(format!("no tool is named \"{shown}\""), None));
        };
        let (toolbox, cancel) = (Arc::clone(&self.toolbox), Cancel::default());
        let turn = Arc::clone(&self.turn);
        let watched = cancel.clone();
        let work = async move {
            let turn = turn.acquire_owned().await;
            let arguments = request.arguments.unwrap_or_default();
            let work = move || {
                let outcome = (tool.run)(&toolbox, arguments, &watched);
                drop(turn);
                outcome
            };
            tokio::task::spawn_blocking(work).await.unwrap_or_else(|defect| Err(Problem::internal(defect)))
        };
        let outcome = tokio::select! {
            outcome = tokio::time::timeout(self.patience, work) => outcome,
            () = context.ct.cancelled() => {
                cancel.cancel();
                return Ok(Err(Problem::new(Code::Cancelled, "The client cancelled this call.")));
            }
        };
        Ok(outcome.unwrap_or_else(|_| {
            cancel.cancel();
            let most = self.patience.as_secs();
            let detail = format!("The call took longer than {most} s; ask for less.");
            Err(Problem::new(Code::GenerateTimeout, detail).limit(most))
        }))
    }
}

impl ServerHandler for SceneServer {
    fn get_info(&self) -> ServerConfig {
        let this = Implementation::new("dragtraffic", env!("CARGO_PKG_VERSION")).with_title("DragTraffic");
        ServerConfig::new(ServerCapabilities::builder().enable_tools().build())
            .with_server_info(this)
            .with_instructions(INSTRUCTIONS)
    }

    async fn list_tools(
        &self,
        _: Option<PaginatedRequestParams>,
        _: RequestContext<RoleServer>,
    ) -> Result<ListToolsResult, ErrorData> {
        Ok(ListToolsResult::with_all_items(TOOLS.iter().map(tools::SceneTool::listed).collect()))
    }

    async fn call_tool(
        &self,
        request: CallToolRequestParams,
        context: RequestContext<RoleServer>,
    ) -> Result<CallToolResponse, ErrorData> {
        let result = match self.answer(request, context).await? {
            Ok(answer) => given(answer),
            Err(problem) => refused(&logged(problem)),
        };
        Ok(result.into())
    }
}

fn given(answer: ToolAnswer) -> CallToolResult {
    let mut content = vec![ContentBlock::text(answer.text)];
    content.extend(answer.picture.map(|png| ContentBlock::image(STANDARD.encode(png), "image/png")));
    CallToolResult::success(content)
}

/// A problem with its members, as over HTTP.
#[derive(Serialize)]
struct ToolProblem<'a> {
    code: &'static str,
    title: &'static str,
    detail: &'a str,
    #[serde(flatten)]
    members: &'a ProblemMembers,
}

/// A problem as text for the model, and as data.
fn refused(problem: &Problem) -> CallToolResult {
    let Problem { code, detail, members, .. } = problem;
    let mut text = format!("{}: {detail}", code.name());
    for fault in members.errors.iter().flatten().skip(1) {
        text.push_str(&format!("\n{fault}"));
    }
    let data = ToolProblem { code: code.name(), title: code.title(), detail, members };
    let mut result = CallToolResult::error(vec![ContentBlock::text(text)]);
    result.structured_content = serde_json::to_value(data).ok();
    result
}
