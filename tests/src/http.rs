//! A plain HTTP/1.1 client that can also send what a correct client never would.

use crate::contract::{Promise, promise};
use anyhow::{Context, bail};
use serde_json::Value;
use std::io::{BufRead, BufReader, Write};
use std::net::{Ipv4Addr, SocketAddr, TcpStream};
use std::time::Duration;

/// A connection from the address 127.0.0.N of this machine, so that it counts as its own party. Linux accepts
/// all of these addresses.
///
/// # Errors
/// When the connection fails.
pub fn connect_from(last: u8, server: SocketAddr) -> anyhow::Result<TcpStream> {
    let socket = socket2::Socket::new(socket2::Domain::IPV4, socket2::Type::STREAM, None)?;
    socket.bind(&SocketAddr::from((Ipv4Addr::new(127, 0, 0, last), 0)).into())?;
    socket.connect(&server.into())?;
    Ok(socket.into())
}

/// A request, sent on its own connection.
#[derive(Clone, Debug)]
pub struct Request {
    method: String,
    path: String,
    headers: Vec<(String, String)>,
    body: Vec<u8>,
    host: bool,
    keep: bool,
    length: Option<String>,
}

impl Request {
    /// A request without a body.
    pub fn new(method: &str, path: &str) -> Self {
        Self {
            method: method.into(),
            path: path.into(),
            headers: Vec::new(),
            body: Vec::new(),
            host: true,
            keep: false,
            length: None,
        }
    }

    /// Adds a header; a Host given here replaces the default one.
    #[must_use]
    pub fn header(mut self, name: &str, value: &str) -> Self {
        if name.eq_ignore_ascii_case("host") {
            self.host = false;
        }
        self.headers.push((name.into(), value.into()));
        self
    }

    /// Leaves the Host out.
    #[must_use]
    pub fn without_host(mut self) -> Self {
        self.host = false;
        self
    }

    /// Leaves the connection open for further requests.
    #[must_use]
    pub fn keep(mut self) -> Self {
        self.keep = true;
        self
    }

    /// Sends another Content-Length than that of the body.
    #[must_use]
    pub fn length(mut self, length: &str) -> Self {
        self.length = Some(length.into());
        self
    }

    /// Sets the body.
    #[must_use]
    pub fn body(mut self, body: impl Into<Vec<u8>>) -> Self {
        self.body = body.into();
        self
    }

    /// Sets a JSON body.
    #[must_use]
    pub fn json(self, body: &Value) -> Self {
        self.header("content-type", "application/json").body(body.to_string())
    }

    /// The bytes of the request as they are sent.
    pub fn bytes(&self, address: SocketAddr) -> Vec<u8> {
        let mut head = format!("{} {} HTTP/1.1\r\n", self.method, self.path);
        if self.host {
            head.push_str(&format!("host: {address}\r\n"));
        }
        for (name, value) in &self.headers {
            head.push_str(&format!("{name}: {value}\r\n"));
        }
        let length = self.length.clone().unwrap_or_else(|| self.body.len().to_string());
        let sized = !self.body.is_empty() || self.length.is_some() || self.method != "GET";
        if sized && !self.headers.iter().any(|h| h.0.eq_ignore_ascii_case("transfer-encoding")) {
            head.push_str(&format!("content-length: {length}\r\n"));
        }
        head.push_str(if self.keep { "\r\n" } else { "connection: close\r\n\r\n" });
        [head.as_bytes(), &self.body].concat()
    }

    /// Sends the request and returns the open connection.
    ///
    /// # Errors
    /// When the connection fails.
    pub fn open(&self, address: SocketAddr) -> anyhow::Result<TcpStream> {
        let mut stream = TcpStream::connect(address)?;
        stream.set_read_timeout(Some(Duration::from_secs(120)))?;
        stream.set_write_timeout(Some(Duration::from_secs(30)))?;
        // A server that refuses early closes its end while we still write: the reply counts.
        let _ = stream.write_all(&self.bytes(address));
        Ok(stream)
    }

    /// Sends the request and reads the reply, which must follow the API's document.
    ///
    /// # Errors
    /// When no reply can be read.
    pub fn send(&self, address: SocketAddr) -> anyhow::Result<Reply> {
        let stream = self.open(address)?;
        let reply = Reply::read(&mut BufReader::new(stream), self.method == "HEAD")?;
        if let Some(promise) = promise(&self.method, &self.path) {
            promise.check(&reply);
        }
        Ok(reply)
    }

    /// Sends the request and returns the head of the reply and a reader of its body's lines.
    ///
    /// # Errors
    /// When no head can be read.
    pub fn stream(&self, address: SocketAddr) -> anyhow::Result<(Reply, Lines)> {
        let mut reader = BufReader::new(self.open(address)?);
        let head = Reply::head(&mut reader)?;
        let is_events = head.header("content-type") == "application/x-ndjson";
        let promise = promise(&self.method, &self.path).filter(|_| is_events);
        Ok((head, Lines { reader, rest: Vec::new(), ended: false, promise }))
    }
}

/// A reply.
#[derive(Clone, Debug, Default)]
pub struct Reply {
    /// Status code.
    pub status: u16,
    /// Names in lower case.
    pub headers: Vec<(String, String)>,
    /// Body without its transfer coding.
    pub body: Vec<u8>,
}

impl Reply {
    /// First value of a header; empty if the header is missing.
    pub fn header(&self, name: &str) -> &str {
        self.headers.iter().find(|h| h.0 == name).map_or("", |h| h.1.as_str())
    }

    /// The body as text.
    pub fn text(&self) -> String {
        String::from_utf8_lossy(&self.body).into_owned()
    }

    /// The body as JSON, decompressed if necessary; null if it is not JSON.
    pub fn json(&self) -> Value {
        let read = if self.header("content-encoding") == "gzip" {
            serde_json::from_reader(flate2::read::GzDecoder::new(self.body.as_slice()))
        } else {
            serde_json::from_slice(&self.body)
        };
        read.unwrap_or(Value::Null)
    }

    /// The `code` of a problem; empty for other replies.
    pub fn code(&self) -> String {
        let is_problem = self.header("content-type") == "application/problem+json";
        let code = self.json()["code"].as_str().map(str::to_owned);
        code.filter(|_| is_problem).unwrap_or_default()
    }

    fn head(reader: &mut impl BufRead) -> anyhow::Result<Self> {
        let mut line = String::new();
        reader.read_line(&mut line)?;
        let status = line.split(' ').nth(1).and_then(|s| s.parse().ok());
        let status = status.with_context(|| format!("no status line: {line:?}"))?;
        let mut reply = Self { status, ..Self::default() };
        loop {
            let mut line = String::new();
            reader.read_line(&mut line)?;
            let line = line.trim_end();
            if line.is_empty() {
                return Ok(reply);
            }
            let (name, value) = line.split_once(':').with_context(|| format!("no header: {line:?}"))?;
            reply.headers.push((name.to_ascii_lowercase(), value.trim().to_owned()));
        }
    }

    /// Reads a reply from a connection; `no_body` for a reply to HEAD.
    ///
    /// # Errors
    /// When there is no complete reply.
    pub fn read(reader: &mut impl BufRead, no_body: bool) -> anyhow::Result<Self> {
        let mut reply = Self::head(reader)?;
        if no_body || reply.status == 204 || reply.status == 304 {
            return Ok(reply);
        }
        if reply.header("transfer-encoding") == "chunked" {
            while let Some(chunk) = chunk(reader)? {
                reply.body.extend(chunk);
            }
        } else if let Ok(length) = reply.header("content-length").parse::<usize>() {
            reply.body = vec![0; length];
            reader.read_exact(&mut reply.body)?;
        } else {
            reader.read_to_end(&mut reply.body)?;
        }
        Ok(reply)
    }
}

fn chunk(reader: &mut impl BufRead) -> anyhow::Result<Option<Vec<u8>>> {
    let mut line = String::new();
    if reader.read_line(&mut line)? == 0 {
        bail!("the body broke off");
    }
    let size = usize::from_str_radix(line.trim(), 16).with_context(|| format!("no chunk size: {line:?}"))?;
    let mut data = vec![0; size + 2];
    reader.read_exact(&mut data)?;
    data.truncate(size);
    Ok((size > 0).then_some(data))
}

/// Lines of a streamed body as they arrive.
pub struct Lines {
    reader: BufReader<TcpStream>,
    rest: Vec<u8>,
    ended: bool,
    /// Contract of each line.
    promise: Option<Promise>,
}

impl Iterator for Lines {
    type Item = String;

    fn next(&mut self) -> Option<String> {
        loop {
            if let Some(at) = self.rest.iter().position(|b| *b == b'\n') {
                let line: Vec<u8> = self.rest.drain(..=at).collect();
                let line = String::from_utf8_lossy(&line).trim_end().to_owned();
                if let Some(promise) = &self.promise {
                    promise.check_event(&line);
                }
                return Some(line);
            }
            if self.ended {
                return None;
            }
            match chunk(&mut self.reader) {
                Ok(Some(data)) => self.rest.extend(data),
                _ => self.ended = true,
            }
        }
    }
}
