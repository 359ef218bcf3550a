//! The endpoint of a server: an address, or a unix socket.

use super::serve::ServeArgs;
use super::{Exit, Failure};
use crate::http::stream::Listener;
use base::base_path;
use std::net::{IpAddr, SocketAddr};
use std::path::{Path, PathBuf};
use tokio::net::TcpListener;

/// Prefix of the path of a unix socket.
pub const UNIX: &str = "unix:";

/// Endpoint of a server.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ServerEndpoint {
    /// An address.
    Address(SocketAddr),
    /// Path of a unix socket, with its mode.
    File(PathBuf, u32),
}

impl ServerEndpoint {
    /// The endpoint of the command line.
    ///
    /// # Errors
    /// Exit 2 for an invalid address, or for a server without tokens on an address that other machines can
    /// reach.
    pub fn of(args: &ServeArgs) -> Result<Self, Failure> {
        if let Some(text) = &args.listen {
            let path = text.strip_prefix(UNIX).filter(|path| !path.is_empty());
            let path =
                path.ok_or_else(|| Failure::usage(format!("--listen {text}: unix:PATH is expected")))?;
            let mode = u32::from_str_radix(&args.socket_mode, 8).ok().filter(|mode| *mode <= 0o777);
            let wrong = || {
                Failure::usage(format!("--socket-mode {}: a mode such as 660 is expected", args.socket_mode))
            };
            return Ok(Self::File(path.into(), mode.ok_or_else(wrong)?));
        }
        let wrong = |reason: &str| Failure::usage(format!("--bind {}: {reason}", args.bind));
        let host = args.bind.trim_start_matches('[').trim_end_matches(']');
        let host = if host == "localhost" { "127.0.0.1" } else { host };
        let ip = host.parse::<IpAddr>().map_err(|_| wrong("an IP address is expected"))?;
        if !ip.is_loopback() && args.token_file.is_none() {
            return Err(wrong("other machines could reach this server; give --token-file as well"));
        }
        Ok(Self::Address(SocketAddr::new(ip, args.port)))
    }

    /// The endpoint, for messages.
    pub fn shown(&self) -> String {
        match self {
            Self::Address(address) => format!("http://{address}{}", base_path::published("/")),
            Self::File(path, mode) => format!("{UNIX}{} (mode {mode:o})", path.display()),
        }
    }

    /// The listener, and its address.
    ///
    /// # Errors
    /// Exit 6 for an address in use, exit 1 for other errors of the system.
    pub async fn listen(&self) -> Result<(Listener, Option<SocketAddr>), Failure> {
        match self {
            Self::Address(address) => {
                let listener = TcpListener::bind(address).await.map_err(|error| match error.kind() {
                    std::io::ErrorKind::AddrInUse => {
                        let message =
                            format!("{address} is in use; another one with --port, or 0 for a free one");
                        Failure::new(Exit::AddressInUse, message)
                    }
                    _ => Failure::new(Exit::Failure, format!("{address}: {error}")),
                })?;
                let address = listener.local_addr()?;
                Ok((Listener::Tcp(listener), Some(address)))
            }
            Self::File(path, mode) => Ok((socket(path, *mode)?, None)),
        }
    }
}

/// A unix socket; it replaces the socket of a server that has ended.
#[cfg(unix)]
fn socket(path: &Path, mode: u32) -> Result<Listener, Failure> {
    use std::os::unix::fs::{FileTypeExt, PermissionsExt};
    let wrong = |reason: String| Failure::new(Exit::Failure, format!("{}: {reason}", path.display()));
    if let Ok(metadata) = std::fs::symlink_metadata(path) {
        if !metadata.file_type().is_socket() {
            return Err(wrong("a file that is no socket is there".into()));
        }
        if std::os::unix::net::UnixStream::connect(path).is_ok() {
            let message = format!("{}: another server listens there", path.display());
            return Err(Failure::new(Exit::AddressInUse, message));
        }
        std::fs::remove_file(path).map_err(|error| wrong(error.to_string()))?;
    }
    let listener = tokio::net::UnixListener::bind(path).map_err(|error| wrong(error.to_string()))?;
    std::fs::set_permissions(path, std::fs::Permissions::from_mode(mode))
        .map_err(|error| wrong(error.to_string()))?;
    Ok(Listener::Unix(listener))
}

#[cfg(not(unix))]
fn socket(path: &Path, _: u32) -> Result<Listener, Failure> {
    Err(Failure::usage(format!("--listen {UNIX}{}: this system has no unix sockets", path.display())))
}
