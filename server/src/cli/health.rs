//! `dragtraffic health`: probes a running server, for supervisors of machines and images without an HTTP
//! client.

use super::listen::{ServerEndpoint, UNIX};
use super::serve::ServeArgs;
use super::{Common, Exit, Failure, output};
use clap::Args;
use serde_json::Value;
use std::io::{Read, Write};
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr, TcpStream, ToSocketAddrs};
use std::path::PathBuf;
use std::time::Duration;

/// Limit of the bytes of a reply.
const MOST: u64 = 64 << 10;
/// Default port of a URL.
const PORT: u16 = 80;

/// Flags of `health`.
#[derive(Args, Clone, Debug)]
pub struct HealthArgs {
    /// Server: http://HOST:PORT with its base path, or unix:PATH. Default: where serve answers probes, else where it
    /// listens, by its variables and the file of DRAGTRAFFIC_CONFIG.
    #[arg(value_name = "URL")]
    server: Option<String>,
    /// Check whether the process answers (/healthz), instead of whether it accepts work (/readyz).
    #[arg(long)]
    alive: bool,
    /// Longest time to connect, and to wait for the reply, seconds.
    #[arg(long, value_name = "S", default_value_t = 5, value_parser = clap::value_parser!(u64).range(1..=600))]
    timeout: u64,
}

/// Address of the probed server.
#[derive(Debug, PartialEq, Eq)]
enum Asked {
    /// Host with its port, and the base path.
    Http(String, String),
    /// A unix socket.
    File(PathBuf),
}

/// Probes the server and prints the reply.
///
/// # Errors
/// Exit 1 when it does not answer, or refuses; exit 2 for an invalid address.
pub fn run(args: HealthArgs, common: &Common) -> Result<(), Failure> {
    let asked = match &args.server {
        Some(text) => Asked::of(text).map_err(Failure::usage)?,
        None => Asked::by_options(&ServeArgs::of_environment()?)?,
    };
    let path = if args.alive { "/healthz" } else { "/readyz" };
    let refused = |reason: String| Failure::new(Exit::Failure, format!("{}: {reason}", asked.shown(path)));
    let reply = asked.get(path, Duration::from_secs(args.timeout)).map_err(|e| refused(e.to_string()))?;
    let word = word(&reply).map_err(refused)?;
    if common.quiet { Ok(()) } else { output::print(format!("{word}\n").as_bytes()) }
}

impl Asked {
    fn of(text: &str) -> Result<Self, String> {
        let wrong = || format!("\"{text}\" found; http://HOST:PORT or {UNIX}PATH is expected");
        if let Some(path) = text.strip_prefix(UNIX).filter(|path| !path.is_empty()) {
            return Ok(Self::File(path.into()));
        }
        let rest = text.strip_prefix("http://").ok_or_else(wrong)?;
        let (host, base) = rest.split_once('/').unwrap_or((rest, ""));
        let plain = |text: &str| text.chars().all(|c| c.is_ascii_graphic() && !"?#@".contains(c));
        if host.is_empty() || !plain(rest) {
            return Err(wrong());
        }
        let has_port = host.rsplit_once(':').is_some_and(|(_, port)| port.parse::<u16>().is_ok());
        let host = if has_port { host.to_owned() } else { format!("{host}:{PORT}") };
        let base = base.trim_end_matches('/');
        Ok(Self::Http(host, if base.is_empty() { String::new() } else { format!("/{base}") }))
    }

    /// The address at which a server with these options answers probes.
    fn by_options(options: &ServeArgs) -> Result<Self, Failure> {
        if let Some(text) = &options.ops_address {
            let address = text.parse::<SocketAddr>();
            let address = address.map_err(|_| Failure::usage(format!("--ops-address {text}")))?;
            return Ok(Self::Http(reached(address).to_string(), String::new()));
        }
        Ok(match ServerEndpoint::of(options)? {
            ServerEndpoint::File(path, _) => Self::File(path),
            ServerEndpoint::Address(address) => Self::Http(reached(address).to_string(), String::new()),
        })
    }

    fn shown(&self, path: &str) -> String {
        match self {
            Self::Http(host, base) => format!("http://{host}{base}{path}"),
            Self::File(file) => format!("{UNIX}{} {path}", file.display()),
        }
    }

    /// The complete reply as text.
    fn get(&self, path: &str, patience: Duration) -> std::io::Result<String> {
        let (host, base) = match self {
            Self::Http(host, base) => (host.as_str(), base.as_str()),
            Self::File(_) => ("localhost", ""),
        };
        let head = format!("GET {base}{path} HTTP/1.1\r\nhost: {host}\r\nconnection: close\r\n\r\n");
        match self {
            Self::Http(host, _) => {
                let mut last = std::io::Error::other("the host has no address");
                for address in host.to_socket_addrs()? {
                    match TcpStream::connect_timeout(&address, patience) {
                        Ok(stream) => {
                            stream.set_read_timeout(Some(patience))?;
                            stream.set_write_timeout(Some(patience))?;
                            return exchange(stream, &head);
                        }
                        Err(error) => last = error,
                    }
                }
                Err(last)
            }
            #[cfg(unix)]
            Self::File(file) => {
                let stream = std::os::unix::net::UnixStream::connect(file)?;
                stream.set_read_timeout(Some(patience))?;
                stream.set_write_timeout(Some(patience))?;
                exchange(stream, &head)
            }
            #[cfg(not(unix))]
            Self::File(_) => Err(std::io::Error::other("this system has no unix sockets")),
        }
    }
}

/// The address by which this machine reaches a server that listens on all addresses.
fn reached(address: SocketAddr) -> SocketAddr {
    let ip = match address.ip() {
        IpAddr::V4(ip) if ip.is_unspecified() => Ipv4Addr::LOCALHOST.into(),
        IpAddr::V6(ip) if ip.is_unspecified() => Ipv6Addr::LOCALHOST.into(),
        ip => ip,
    };
    SocketAddr::new(ip, address.port())
}

fn exchange(mut stream: impl Read + Write, head: &str) -> std::io::Result<String> {
    stream.write_all(head.as_bytes())?;
    let mut reply = Vec::new();
    stream.take(MOST).read_to_end(&mut reply)?;
    Ok(String::from_utf8_lossy(&reply).into_owned())
}

/// The status word of a healthy server.
///
/// # Errors
/// The status word of any other server.
fn word(reply: &str) -> Result<String, String> {
    let (head, body) = reply.split_once("\r\n\r\n").ok_or("the reply breaks off")?;
    let status = head.split(' ').nth(1).unwrap_or_default();
    // Replies to probes are short documents, so the outermost braces enclose the whole object.
    let object = body.find('{').zip(body.rfind('}')).and_then(|(from, to)| body.get(from..=to));
    let document: Value = object.and_then(|text| serde_json::from_str(text).ok()).unwrap_or_default();
    match (status, document.get("status").and_then(Value::as_str)) {
        ("200", Some(word)) => Ok(word.to_owned()),
        ("200", None) => Err("another program answers there".into()),
        ("401", _) => {
            Err("401: /readyz needs a token there; ask the address of --ops-address, or with --alive".into())
        }
        _ => Err(format!(
            "{status}: {}",
            document.get("detail").and_then(Value::as_str).unwrap_or("no reason")
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::{Asked, reached, word};

    #[test]
    fn a_server_is_named_by_url_or_socket() {
        let http = |host: &str, base: &str| Ok(Asked::Http(host.into(), base.into()));
        assert_eq!(Asked::of("http://127.0.0.1:9090"), http("127.0.0.1:9090", ""));
        assert_eq!(Asked::of("http://scenes.example/tools/drag/"), http("scenes.example:80", "/tools/drag"));
        assert_eq!(Asked::of("http://[::1]:9090/"), http("[::1]:9090", ""));
        assert_eq!(Asked::of("unix:/run/drag.sock"), Ok(Asked::File("/run/drag.sock".into())));
        for text in ["https://a", "unix:", "http://", "127.0.0.1:80", "http://a\r\nb", "http://a/?b"] {
            assert!(Asked::of(text).is_err(), "{text:?}");
        }
        let at = |text: &str| reached(text.parse().unwrap()).to_string();
        assert_eq!(
            (at("0.0.0.0:1"), at("[::]:2"), at("10.0.0.1:3")),
            ("127.0.0.1:1".into(), "[::1]:2".into(), "10.0.0.1:3".into())
        );
    }

    #[test]
    fn only_a_reply_of_success_with_a_word_is_well() {
        assert_eq!(word("HTTP/1.1 200 OK\r\na: b\r\n\r\n{\"status\":\"ready\"}"), Ok("ready".into()));
        let chunked = "HTTP/1.1 503 x\r\n\r\n1f\r\n{\"detail\":\"Not ready: store.\"}\r\n0\r\n\r\n";
        assert_eq!(word(chunked), Err("503: Not ready: store.".into()));
        for reply in ["", "HTTP/1.1 200 OK\r\n", "HTTP/1.1 200 OK\r\n\r\nhello", "HTTP/1.1 401 no\r\n\r\n{}"]
        {
            assert!(word(reply).is_err(), "{reply}");
        }
    }
}
