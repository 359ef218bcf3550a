//! Fifty users of one server for a given time, each with a token: some drag, more edit and save, as many
//! read, some run scripts. Every reply must follow the document, no save may be lost, and memory must not
//! grow.

use super::Tell;
use super::clients::{ClientTask, Common, Report};
use crate::http::Request;
use crate::program::Server;
use crate::random::Random;
use crate::scenes::street;
use anyhow::{Context, ensure};
use serde_json::{Value, json};
use std::time::Duration;

/// Time between two requests of a drag by hand.
const HAND: Duration = Duration::from_millis(16);

/// A user with its token, who works until the trial is over.
struct LiveUser {
    name: &'static str,
    token: String,
    random: Random,
}

type Work = fn(&mut LiveUser, &Common) -> anyhow::Result<()>;

/// What users do, and how many.
const ROLES: [(&str, usize, Work); 4] =
    [("drag", 5, drag), ("edit", 20, edit), ("read", 20, read), ("script", 5, script)];

/// Runs all users for a given time.
///
/// # Errors
/// If a reply is not one that its user may get, a save is lost, or the server ends.
pub fn live(time: Duration, seed: u64, tell: Tell<'_>) -> anyhow::Result<Report> {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("tokens");
    let mut users: Vec<(LiveUser, Work)> = Vec::new();
    for (name, count, work) in ROLES {
        for _ in 0..count {
            let (token, random) =
                (format!("{:032x}", users.len()), Random::of_part(seed, users.len() as u64));
            users.push((LiveUser { name, token, random }, work));
        }
    }
    let line = |(i, (user, _)): (usize, &(LiveUser, Work))| format!("user-{i} edit {}\n", user.token);
    std::fs::write(&path, users.iter().enumerate().map(line).collect::<String>())?;
    std::fs::set_permissions(&path, std::os::unix::fs::PermissionsExt::from_mode(0o600))?;
    let probes = std::net::TcpListener::bind("127.0.0.1:0")?.local_addr()?.to_string();
    let tokens = path.to_str().context("a path in UTF-8")?;
    let server = Server::start(&["--owners", "--token-file", tokens, "--ops-address", &probes])?;
    let ready = Request::new("GET", "/readyz");
    while ready.send(probes.parse()?)?.status != 200 {
        std::thread::sleep(Duration::from_millis(50));
    }
    let common = Common::of(server.address);
    let task = |(mut user, work): (LiveUser, Work)| -> ClientTask<'_> {
        Box::new(move |common: &Common| {
            std::thread::sleep(Duration::from_millis(user.random.below(2_000)));
            while !common.is_over() {
                work(&mut user, common).with_context(|| format!("a user who is to {}", user.name))?;
            }
            Ok(())
        })
    };
    common.work(&server, time, tell, users.into_iter().map(task).collect())
}

impl LiveUser {
    fn as_user(&self, request: Request) -> Request {
        request.header("authorization", &format!("Bearer {}", self.token))
    }

    /// Sends a request; returns the body of the reply if it succeeded.
    fn ask(&self, common: &Common, what: &'static str, request: Request) -> anyhow::Result<Option<Value>> {
        Ok(common.ask(what, &self.as_user(request), &[])?.map(|reply| reply.json()))
    }

    /// Waits for up to this many seconds, as a user who reads.
    fn think(&mut self, common: &Common, seconds: u64) {
        let mut left = self.random.below(1_000 * seconds);
        while left > 0 && !common.is_over() {
            let now = left.min(100);
            std::thread::sleep(Duration::from_millis(now));
            left -= now;
        }
    }
}

/// Moves a goal for two to six seconds, and views the result.
fn drag(user: &mut LiveUser, common: &Common) -> anyhow::Result<()> {
    let steps = 120 + user.random.below(250);
    for step in 0..steps {
        if common.is_over() {
            return Ok(());
        }
        let goal = json!({"x_m": 8.0 + 0.02 * step as f64, "y_m": 0.4, "speed_mps": 6.0});
        let body = json!({"scene_id": "demo-crossing", "agents": ["5"], "score": false, "futures": "compact",
            "conditions": {"5": {"goal": goal}}});
        user.ask(common, "drag", Request::new("POST", "/v1/generate").json(&body))?;
        std::thread::sleep(HAND);
    }
    user.think(common, 6);
    Ok(())
}

/// Makes a scene, changes and saves it a few times, generates in it, and deletes it.
fn edit(user: &mut LiveUser, common: &Common) -> anyhow::Result<()> {
    let mut scene = street(4 + user.random.below(8) as usize, 60);
    let Some(made) = user.ask(common, "create", Request::new("POST", "/v1/scenes").json(&scene))? else {
        return Ok(());
    };
    let (id, mut etag) = (word(&made, "id")?, word(&made, "etag")?);
    let path = format!("/v1/scenes/{id}");
    for version in 0..2 + user.random.below(5) {
        user.think(common, 8);
        scene["name"] = json!(format!("version {version}"));
        let put = Request::new("PUT", &path).header("if-match", &etag).json(&scene);
        let Some(saved) = user.ask(common, "save", put)? else { continue };
        etag = word(&saved, "etag")?;
        let read = user.ask(common, "open", Request::new("GET", &path))?;
        let name = read.as_ref().and_then(|scene| scene["name"].as_str());
        ensure!(read.is_none() || name == scene["name"].as_str(), "a save is lost: {name:?}");
        let body = json!({"scene_id": id, "agents": ["0"]});
        user.ask(common, "generate", Request::new("POST", "/v1/generate").json(&body))?;
    }
    // A busy server may refuse: a few scenes remain.
    user.ask(common, "delete", Request::new("DELETE", &path).header("if-match", &etag))?;
    Ok(())
}

fn word(reply: &Value, name: &str) -> anyhow::Result<String> {
    Ok(reply[name].as_str().with_context(|| format!("no {name}: {reply}"))?.to_owned())
}

/// Reads the list, and a scene in one of several forms.
fn read(user: &mut LiveUser, common: &Common) -> anyhow::Result<()> {
    user.ask(common, "list", Request::new("GET", "/v1/scenes?limit=50"))?;
    user.think(common, 4);
    let path = match user.random.below(4) {
        0 => "/v1/scenes/demo-roundabout",
        1 => "/v1/scenes/demo-crossing/preview",
        2 => "/v1/scenes/demo-arterial/export?format=csv",
        _ => "/v1/scenes/demo-motorway?map=ref",
    };
    let look = user.as_user(Request::new("GET", path));
    common.ask("look", &look, &[])?;
    user.think(common, 6);
    Ok(())
}

/// Steps a run without pause, and generates all road users in several samples.
fn script(user: &mut LiveUser, common: &Common) -> anyhow::Result<()> {
    let begin = json!({"scene": street(6, 20), "egos": ["0"], "seed": user.random.below(1_000)});
    let Some(run) = user.ask(common, "begin", Request::new("POST", "/v1/runs").json(&begin))? else {
        return Ok(());
    };
    let path = format!("/v1/runs/{}", word(&run, "run")?);
    let mut number = 1;
    while number <= 100 && !common.is_over() {
        let x_m = run["present"]["states"]["0"]["x_m"].as_f64().unwrap_or_default() + number as f64;
        let y_m = &run["present"]["states"]["0"]["y_m"];
        let ego =
            json!({"id": "0", "x_m": x_m, "y_m": y_m, "heading_rad": 0.0, "vx_mps": 10.0, "vy_mps": 0.0});
        let step = json!({"number": number, "egos": [ego]});
        let stepped = user.ask(common, "step", Request::new("POST", &format!("{path}/step")).json(&step))?;
        number += u64::from(stepped.is_some());
    }
    common.ask("end", &user.as_user(Request::new("DELETE", &path)), &[])?;
    let all = json!({"scene_id": "demo-crossing", "agents": "all", "samples": 4, "score": false});
    user.ask(common, "many", Request::new("POST", "/v1/generate").json(&all))?;
    user.think(common, 2);
    Ok(())
}
