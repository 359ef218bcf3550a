//! `dragtraffic mcp` withstands anything that a client may send: paths that leave the folder, unknown names,
//! lines that are no messages, and too many open scenes. Standard output contains messages only.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a failed test panics")]

use dragtraffic_tests::program::{program, root};
use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

/// Time for an answer.
const PATIENCE: Duration = Duration::from_secs(60);

/// A server, and the messages that it has sent.
struct Client {
    child: Child,
    input: ChildStdin,
    messages: Receiver<String>,
    calls: u64,
}

impl Client {
    /// Starts a server and initializes it.
    fn start(flags: &[&str]) -> Self {
        let mut command = Command::new(program());
        command.arg("mcp").args(flags).env("DRAGTRAFFIC_LOG", "error");
        let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
        let (input, output) = (child.stdin.take().unwrap(), child.stdout.take().unwrap());
        let (sender, messages) = channel();
        std::thread::spawn(move || {
            for line in BufReader::new(output).lines().map_while(Result::ok) {
                if sender.send(line).is_err() {
                    return;
                }
            }
        });
        let mut client = Self { child, input, messages, calls: 0 };
        let who = json!({"name": "test", "version": "1"});
        let hello = json!({"protocolVersion": "2025-06-18", "capabilities": {}, "clientInfo": who});
        let greeted = client.ask("initialize", &hello);
        assert_eq!(greeted["result"]["serverInfo"]["name"], "dragtraffic", "{greeted}");
        client.say(r#"{"jsonrpc":"2.0","method":"notifications/initialized"}"#);
        client
    }

    fn say(&mut self, line: &str) {
        writeln!(self.input, "{line}").unwrap();
        self.input.flush().unwrap();
    }

    /// The next message; every line of standard output is one.
    fn hear(&self) -> Value {
        let line = self.messages.recv_timeout(PATIENCE).unwrap();
        let message: Value = serde_json::from_str(&line).unwrap_or_else(|_| panic!("no message: {line}"));
        assert_eq!(message["jsonrpc"], "2.0", "{line}");
        message
    }

    /// Sends a request and waits for its answer.
    fn ask(&mut self, method: &str, params: &Value) -> Value {
        self.calls += 1;
        let id = self.calls;
        self.say(&json!({"jsonrpc": "2.0", "id": id, "method": method, "params": params}).to_string());
        loop {
            let message = self.hear();
            if message["id"] == id {
                return message;
            }
        }
    }

    /// Calls a tool; returns its result.
    fn call(&mut self, tool: &str, arguments: &Value) -> Value {
        let answer = self.ask("tools/call", &json!({"name": tool, "arguments": arguments}));
        assert!(answer["error"].is_null(), "{tool}: {answer}");
        answer["result"].clone()
    }

    /// The code of a tool's refusal.
    fn refused(&mut self, tool: &str, arguments: &Value) -> String {
        let result = self.call(tool, arguments);
        assert_eq!(result["isError"], true, "{tool} {arguments}: {result}");
        let code = result["structuredContent"]["code"].as_str().unwrap().to_owned();
        let words = result["content"][0]["text"].as_str().unwrap();
        assert!(words.starts_with(&format!("{code}: ")) && words.len() > code.len() + 10, "{words}");
        code
    }

    fn opened(&mut self, example: &str) -> Value {
        self.call("open_scene", &json!({"example": example, "picture": false}))
    }

    /// Closes standard input: exit code.
    fn end(self) -> Option<i32> {
        let Self { mut child, input, .. } = self;
        drop(input);
        child.wait().unwrap().code()
    }
}

#[test]
fn lines_that_are_no_messages_leave_the_server_at_work() {
    let mut client = Client::start(&[]);
    let deep = "[".repeat(100_000);
    let broken = ["", "{", "no JSON", "null", "[]", "{\"jsonrpc\":\"2.0\"}", "\u{0}\u{1}", deep.as_str()];
    for line in broken {
        client.say(line);
    }
    client.say(r#"{"jsonrpc":"2.0","id":900,"method":"tools/call","params":{"name":7}}"#);
    client.say(r#"{"jsonrpc":"2.0","id":901,"method":"no/such","params":{}}"#);
    client.say(r#"{"jsonrpc":"2.0","id":902,"method":"tools/call","params":{"name":"rm"}}"#);
    let mut told = Vec::new();
    // Calls are answered in any order.
    while ![900, 901, 902].iter().all(|id| told.contains(&json!(id))) {
        let message = client.hear();
        assert!(message["error"]["code"].is_i64(), "{message}");
        told.push(message["id"].clone());
    }
    // A line of 40 MB is skipped, and nothing of it is kept.
    client.say(&format!("{{\"jsonrpc\":\"2.0\",\"id\":1,\"method\":\"{}\"}}", "x".repeat(40 << 20)));
    assert_ne!(client.opened("demo-crossing")["isError"], true);
    for arguments in
        [json!({}), json!({"scene": 1}), json!({"scene": "none"}), json!({"scen": "demo-crossing"})]
    {
        client.refused("describe_scene", &arguments);
    }
    assert_eq!(client.end(), Some(0));
}

#[test]
fn a_client_reaches_its_folders_and_nothing_else() {
    let (outside, inside) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let example = root().join("assets/scenes/demo-crossing.json");
    let copy = |to: &Path| assert!(std::fs::copy(&example, to).unwrap() > 0);
    copy(&outside.path().join("secret.json"));
    copy(&inside.path().join("mine.json"));
    #[cfg(unix)]
    for (to, name) in [("secret.json", "link.json"), (".", "way-out")] {
        std::os::unix::fs::symlink(outside.path().join(to), inside.path().join(name)).unwrap();
    }
    let shown = |path: &Path| path.display().to_string();
    let mut client = Client::start(&["--folder", &shown(inside.path())]);
    let listed = client.call("list_scenes", &json!({}))["content"][0]["text"].to_string();
    assert!(
        listed.contains("mine.json") && !listed.contains("secret") && !listed.contains("link"),
        "{listed}"
    );
    for file in ["mine.json", "./mine.json", &shown(&inside.path().join("mine.json"))] {
        let result = client.call("open_scene", &json!({"file": file, "name": "mine", "picture": false}));
        assert_ne!(result["isError"], true, "{result}");
    }
    let beside = format!("../{}/secret.json", outside.path().file_name().unwrap().display());
    let elsewhere = [
        shown(&outside.path().join("secret.json")),
        shown(&inside.path().join(&beside)),
        beside,
        "link.json".into(),
        "way-out/secret.json".into(),
        "/etc/passwd".into(),
        "/proc/self/environ".into(),
        "\u{0}".into(),
        "x".repeat(100_000),
    ];
    for file in &elsewhere {
        assert_eq!(client.refused("open_scene", &json!({"file": file})), "not-found", "{file:.100}");
        let writing = json!({"scene": "mine", "format": "csv", "file": file, "overwrite": true});
        assert_eq!(client.refused("export_scene", &writing), "not-found", "{file:.100}");
    }
    assert_eq!(std::fs::read(outside.path().join("secret.json")).unwrap(), std::fs::read(&example).unwrap());
    assert_eq!(std::fs::read_dir(outside.path()).unwrap().count(), 1);
    let own = json!({"scene": "mine", "format": "csv", "file": "mine.json"});
    assert_eq!(client.refused("export_scene", &own), "exists");
    assert_eq!(std::fs::read(inside.path().join("mine.json")).unwrap(), std::fs::read(&example).unwrap());
    assert_eq!(client.end(), Some(0));

    // Without a folder, only the examples are available.
    let mut client = Client::start(&[]);
    let file = shown(&inside.path().join("mine.json"));
    assert_eq!(client.refused("open_scene", &json!({"file": file})), "not-found");
    assert_eq!(client.end(), Some(0));
}

#[test]
fn scenes_memory_and_time_are_bounded() {
    let bounds = ["--scenes", "2", "--limit", "cached_scene_bytes=4000000,generate_s=2"];
    let mut client = Client::start(&bounds);
    client.opened("demo-crossing");
    client.opened("demo-crossing");
    assert_eq!(client.refused("open_scene", &json!({"example": "demo-crossing"})), "store-full");
    client.call("close_scene", &json!({"scene": "demo-crossing-2"}));
    assert_eq!(client.refused("close_scene", &json!({"scene": "demo-crossing-2"})), "not-found");
    // Futures that do not fit are not kept, and the scene stays as it was.
    let before = client.call("describe_scene", &json!({"scene": "demo-crossing"}));
    let large = json!({"scene": "demo-crossing", "samples": 8, "horizon_s": 9, "picture": false});
    let code = client.refused("generate_futures", &large);
    assert!(["store-full", "generate-timeout"].contains(&code.as_str()), "{code}");
    assert_eq!(client.call("describe_scene", &json!({"scene": "demo-crossing"})), before);
    // A search ends with its results so far before its time is over.
    let search =
        json!({"scene": "demo-crossing", "where": "collisions > 1000", "seeds": 200, "picture": false});
    let result = client.call("search_futures", &search);
    let words = result["content"][0]["text"].as_str().unwrap();
    assert!(words.starts_with("0 of ") && !words.starts_with("0 of 200"), "{words}");
    assert_eq!(client.end(), Some(0));
}
