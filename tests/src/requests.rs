//! Unexpected request bodies, sent to the real server: every reply must follow the document, and none may
//! report a defect.

use crate::contract::promise;
use crate::http::{Reply, Request};
use crate::mutation::Corpus;
use crate::program::{Server, root};
use anyhow::{Context, bail};
use std::io::{BufReader, Write};
use std::net::TcpStream;
use std::path::Path;
use std::time::Duration;

/// Longest wait for a reply; the server's own limit is much shorter.
const PATIENCE: Duration = Duration::from_secs(30);
/// Boundary of the forms in the corpus.
const FORM: &str = "multipart/form-data; boundary=part";
const JSON: &str = "application/json";

/// One kind of request: its corpus is the folder `fuzz/corpus/request-NAME`.
pub struct Target {
    /// Name.
    pub name: &'static str,
    method: &'static str,
    path: &'static str,
    media_type: &'static str,
    precondition: Option<(&'static str, &'static str)>,
}

const fn post(name: &'static str, path: &'static str, media_type: &'static str) -> Target {
    Target { name, method: "POST", path, media_type, precondition: None }
}

/// All kinds.
pub const TARGETS: &[Target] = &[
    post("request-generate", "/v1/generate", JSON),
    post("request-score", "/v1/score", JSON),
    post("request-place", "/v1/place", JSON),
    post("request-run", "/v1/runs", JSON),
    post("request-scene", "/v1/scenes", JSON),
    post("request-duplicate", "/v1/scenes/demo-crossing/duplicate", JSON),
    post("request-export", "/v1/export?format=womd", JSON),
    post("request-import", "/v1/import?dry_run=true", FORM),
    Target {
        precondition: Some(("if-match", "*")),
        method: "PUT",
        ..post("request-put", "/v1/scenes/kept", JSON)
    },
    Target {
        precondition: Some(("if-match", "*")),
        method: "PATCH",
        ..post("request-patch", "/v1/scenes/kept", "application/merge-patch+json")
    },
];

/// A server with limits that keep each call short.
///
/// # Errors
/// When it does not start.
pub fn server(program: &Path) -> anyhow::Result<Server> {
    let limits = ["reply_points=20000", "regenerated_agents=8", "generate_s=20", "stored_scenes=50"];
    let flags: Vec<&str> = limits.iter().flat_map(|limit| ["--limit", limit]).collect();
    let server = Server::of(program, &flags)?;
    server.wait_ready()?;
    let kept = Request::new("PUT", "/v1/scenes/kept").header("if-none-match", "*");
    let kept = server.send(&kept.json(&crate::scenes::street(2, 20)))?;
    anyhow::ensure!(kept.status == 201, "{}", kept.text());
    Ok(server)
}

/// Sends the inputs of one target, over one connection at a time.
pub struct Caller<'a> {
    target: &'a Target,
    server: &'a Server,
    corpus: Corpus,
    kept: Option<BufReader<TcpStream>>,
}

impl<'a> Caller<'a> {
    /// A caller of a server.
    ///
    /// # Errors
    /// When the target has no corpus.
    pub fn new(target: &'a Target, server: &'a Server) -> anyhow::Result<Self> {
        let corpus = Corpus::read(&root().join("fuzz/corpus").join(target.name))?;
        Ok(Self { target, server, corpus, kept: None })
    }

    /// The corpus.
    pub fn corpus(&self) -> &Corpus {
        &self.corpus
    }

    /// Sends a body and checks the reply.
    ///
    /// # Errors
    /// The fault of the reply, or that there is none.
    pub fn call(&mut self, body: &[u8]) -> anyhow::Result<u16> {
        let target = self.target;
        let mut request =
            Request::new(target.method, target.path).header("content-type", target.media_type).keep();
        if let Some((name, value)) = target.precondition {
            request = request.header(name, value);
        }
        let reply = self.send(&request.body(body))?;
        if reply.status >= 500 && reply.code() != "busy" && reply.code() != "store-full" {
            bail!("{}: {}", reply.status, reply.text());
        }
        if reply.status == 201 {
            // Deletes the new scene to keep the store small.
            let location = reply.header("location").to_owned();
            if !location.is_empty() {
                self.server.send(&Request::new("DELETE", &location).header("if-match", "*"))?;
            }
        }
        let promise = promise(target.method, target.path).context("the document does not have this")?;
        let checked = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| promise.check(&reply)));
        if checked.is_err() {
            bail!("not as the document says: {}", reply.text());
        }
        Ok(reply.status)
    }

    fn send(&mut self, request: &Request) -> anyhow::Result<Reply> {
        let mut stream = match self.kept.take() {
            Some(kept) => kept,
            None => {
                let stream = TcpStream::connect(self.server.address)?;
                stream.set_nodelay(true)?;
                stream.set_read_timeout(Some(PATIENCE))?;
                stream.set_write_timeout(Some(PATIENCE))?;
                BufReader::new(stream)
            }
        };
        // A server that refuses early closes its end while we still write: the reply counts.
        let _ = stream.get_mut().write_all(&request.bytes(self.server.address));
        let reply = Reply::read(&mut stream, false).context("no reply")?;
        if reply.header("connection") != "close" {
            self.kept = Some(stream);
        }
        Ok(reply)
    }
}
