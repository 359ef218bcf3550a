//! The plan of a server, checked before anything starts.

use super::listen::ServerEndpoint;
use super::serve::{ServeArgs, db_path};
use super::{Exit, Failure};
use crate::http::proxies::TrustedProxies;
use crate::http::tokens::TokenList;
use base::base_path;
use base::limits::Limits;
use std::net::SocketAddr;
use std::path::PathBuf;
use std::sync::Arc;

/// A checked command line of `serve`.
pub struct ServePlan {
    /// Limits.
    pub limits: Limits,
    /// Tokens, if callers need one.
    pub tokens: Option<Arc<TokenList>>,
    /// Trusted proxies.
    pub proxies: TrustedProxies,
    /// Endpoint.
    pub endpoint: ServerEndpoint,
    /// Address for probes without token.
    pub ops: Option<SocketAddr>,
    /// File of the store.
    pub db: PathBuf,
}

impl ServePlan {
    /// The plan of a command line.
    ///
    /// # Errors
    /// All faults, one line each, with the exit code of the first.
    pub fn of(args: &ServeArgs) -> Result<Self, Failure> {
        let mut faults = Vec::new();
        let limits = kept(limits(args), &mut faults);
        let tokens = kept(args.token_file.as_deref().map(tokens).transpose(), &mut faults);
        let proxies = TrustedProxies::of(&args.trust_proxy);
        let proxies =
            kept(proxies.map_err(|reason| Failure::usage(format!("--trust-proxy: {reason}"))), &mut faults);
        let endpoint = kept(ServerEndpoint::of(args), &mut faults);
        let ops = kept(args.ops_address.as_deref().map(ops).transpose(), &mut faults);
        let base = base_path::set(&args.base_path);
        kept(base.map_err(|reason| Failure::usage(format!("--base-path: {reason}"))), &mut faults);
        if let Some(folder) = args.data.as_ref().filter(|folder| !folder.is_dir()) {
            faults.push(Failure::usage(format!("--data {}: no such folder", folder.display())));
        }
        if args.owners && args.token_file.is_none() && args.trust_proxy.is_empty() {
            let reason = "--owners: users are told by --token-file or --trust-proxy; neither is given";
            faults.push(Failure::usage(reason.to_owned()));
        }
        let db = args.db.clone().unwrap_or_else(db_path);
        if args.db.is_some()
            && db.parent().is_some_and(|folder| !folder.as_os_str().is_empty() && !folder.is_dir())
        {
            faults.push(Failure::usage(format!("--db {}: its folder does not exist", db.display())));
        }
        match (limits, tokens, proxies, endpoint, ops) {
            (Some(limits), Some(tokens), Some(proxies), Some(endpoint), Some(ops)) if faults.is_empty() => {
                Ok(Self { limits, tokens, proxies, endpoint, ops, db })
            }
            _ => {
                let exit = faults.first().map_or(Exit::Usage, |fault| fault.exit);
                let lines: Vec<&str> = faults.iter().map(|fault| fault.message.as_str()).collect();
                Err(Failure::new(exit, lines.join("\n")))
            }
        }
    }

    /// The plan as text, one fact per line.
    pub fn lines(&self, args: &ServeArgs) -> String {
        let access = match (&self.tokens, &args.token_file) {
            (Some(tokens), Some(file)) => format!("{} from {}", tokens.summary(), file.display()),
            _ => "none: every process of this user and root".to_owned(),
        };
        let store = if self.db.exists() { "exists" } else { "will be created" };
        let mut lines = vec![
            ("listens on", self.endpoint.shown()),
            ("tokens", access),
            ("store", format!("{} ({store})", self.db.display())),
        ];
        lines.extend(args.data.as_ref().map(|data| ("data", data.display().to_string())));
        lines.extend(self.ops.map(|ops| ("probes on", format!("http://{ops}/"))));
        lines.extend(args.grpc.map(|port| ("gRPC on", format!("127.0.0.1:{port}"))));
        if !args.trust_proxy.is_empty() {
            lines.push(("trusts", args.trust_proxy.join(", ")));
        }
        lines.iter().map(|(name, value)| format!("{name:<11} {value}\n")).collect()
    }
}

fn kept<T>(value: Result<T, Failure>, faults: &mut Vec<Failure>) -> Option<T> {
    value.map_err(|fault| faults.push(fault)).ok()
}

fn limits(args: &ServeArgs) -> Result<Limits, Failure> {
    let mut limits = Limits::default();
    for assignment in &args.limit {
        limits.set(assignment).map_err(Failure::usage)?;
    }
    if let Some(text) = &args.memory {
        let wrong = |reason: String| Failure::usage(format!("--memory {text}: {reason}"));
        let bytes = bytes_of(text).ok_or_else(|| wrong("a size such as 512m or 2g is expected".into()))?;
        limits.set(&format!("memory_bytes={bytes}")).map_err(wrong)?;
    }
    if let Some(threads) = args.threads {
        limits.running = threads;
    }
    Ok(limits)
}

/// Parses a size in bytes: a whole number, with k, m or g for powers of 1024.
fn bytes_of(text: &str) -> Option<u64> {
    let units = [('k', 10), ('m', 20), ('g', 30)];
    let text = text.to_ascii_lowercase();
    let unit = units.iter().find_map(|(letter, power)| Some((text.strip_suffix(*letter)?, *power)));
    let (number, power) = unit.unwrap_or((&text, 0));
    number.parse::<u64>().ok()?.checked_mul(1 << power)
}

fn tokens(path: &std::path::Path) -> Result<Arc<TokenList>, Failure> {
    let wrong = |reason| Failure::usage(format!("--token-file {}: {reason}", path.display()));
    TokenList::open(path).map(Arc::new).map_err(wrong)
}

fn ops(text: &str) -> Result<SocketAddr, Failure> {
    text.parse().map_err(|_| Failure::usage(format!("--ops-address {text}: IP:PORT is expected")))
}
