//! Trusted proxies, whose `X-Forwarded-For` and `X-Forwarded-User` are used.

use super::extract::Connection;
use axum::http::{HeaderMap, HeaderName};
use base::party::Party;
use std::net::IpAddr;
use std::sync::Arc;

const FORWARDED_FOR: HeaderName = HeaderName::from_static("x-forwarded-for");
const FORWARDED_USER: HeaderName = HeaderName::from_static("x-forwarded-user");
/// Longest kept user name, characters.
const USER_CHARS: usize = 64;

/// The user that a trusted proxy authenticated; extension of its requests.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ForwardedUser(pub Arc<str>);

/// Addresses of trusted proxies.
#[derive(Clone, Debug, Default)]
pub struct TrustedProxies {
    networks: Vec<(IpAddr, u8)>,
    local: bool,
}

impl TrustedProxies {
    /// From addresses, networks such as 10.0.0.0/8, and `unix` for clients of a unix socket.
    ///
    /// # Errors
    /// A sentence about the first invalid text.
    pub fn of(texts: &[String]) -> Result<Self, String> {
        let mut proxies = Self::default();
        for text in texts {
            if text == "unix" {
                proxies.local = true;
                continue;
            }
            let (ip, prefix) = text.split_once('/').map_or((text.as_str(), None), |(ip, n)| (ip, Some(n)));
            let ip = ip.parse::<IpAddr>().map(|ip| ip.to_canonical()).ok();
            let most = ip.map_or(0, |ip| if ip.is_ipv4() { 32 } else { 128 });
            let prefix = prefix.map_or(Some(most), |n| n.parse().ok()).filter(|n| *n <= most);
            let network = ip.zip(prefix).ok_or_else(|| {
                format!("\"{text}\" found; an IP address, a network such as 10.0.0.0/8, or unix is expected")
            })?;
            proxies.networks.push(network);
        }
        Ok(proxies)
    }

    /// Whether connections from this address come from a trusted proxy.
    pub fn trusts(&self, peer: Option<IpAddr>) -> bool {
        peer.map_or(self.local, |peer| self.has(peer.to_canonical()))
    }

    fn has(&self, peer: IpAddr) -> bool {
        let bits = |ip: IpAddr| match ip {
            IpAddr::V4(ip) => (u128::from(ip.to_bits()) << 96, 32),
            IpAddr::V6(ip) => (ip.to_bits(), 128),
        };
        let (peer, width) = bits(peer);
        self.networks.iter().any(|(ip, prefix)| {
            let (network, own) = bits(*ip);
            own == width && (*prefix == 0 || (peer ^ network) >> (128 - u32::from(*prefix)) == 0)
        })
    }

    /// The connection as a trusted proxy's request describes it: its party is the client. The last address
    /// that is not a trusted proxy counts, because a client can write the earlier ones.
    pub fn seen(&self, connection: Connection, headers: &HeaderMap) -> (Connection, Option<ForwardedUser>) {
        let lines = headers.get_all(FORWARDED_FOR).iter().filter_map(|value| value.to_str().ok());
        let given: Vec<IpAddr> = lines.flat_map(|line| line.split(',')).map_while(address).collect();
        let client = given.iter().rev().find(|ip| !self.has(**ip)).or(given.first());
        let party = client.map_or(connection.party, |ip| Party::of(*ip));
        let user = headers.get(FORWARDED_USER).and_then(|value| value.to_str().ok()).map(str::trim);
        let user = user.filter(|user| !user.is_empty()).map(|user| user.chars().take(USER_CHARS).collect());
        (Connection { party, ..connection }, user.map(|user: String| ForwardedUser(user.into())))
    }
}

/// Parses an entry of the header, with or without a port.
fn address(text: &str) -> Option<IpAddr> {
    let text = text.trim();
    let bare = || text.trim_start_matches('[').trim_end_matches(']').parse().ok();
    let with_port = || text.parse::<std::net::SocketAddr>().ok().map(|address| address.ip());
    bare().or_else(with_port).map(|ip: IpAddr| ip.to_canonical())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn proxies(texts: &[&str]) -> TrustedProxies {
        TrustedProxies::of(&texts.iter().map(|text| (*text).to_owned()).collect::<Vec<_>>()).unwrap()
    }

    #[test]
    fn addresses_and_networks_are_trusted() {
        let some = proxies(&["127.0.0.1", "10.1.0.0/16", "fd00::/8"]);
        let trusts = |ip: &str| some.trusts(Some(ip.parse().unwrap()));
        assert!(
            trusts("127.0.0.1") && trusts("::ffff:127.0.0.1") && trusts("10.1.255.9") && trusts("fd12::1")
        );
        assert!(!trusts("127.0.0.2") && !trusts("10.2.0.1") && !trusts("fe80::1") && !some.trusts(None));
        assert!(proxies(&["unix"]).trusts(None) && proxies(&["0.0.0.0/0"]).trusts(Some([9, 9, 9, 9].into())));
        for text in ["", "proxy", "10.0.0.0/33", "10.0.0.0/x", "127.0.0.1:80"] {
            assert!(TrustedProxies::of(&[text.to_owned()]).is_err(), "{text}");
        }
    }

    #[test]
    fn the_last_address_that_is_no_proxys_is_the_client() {
        let some = proxies(&["127.0.0.1", "10.0.0.0/8"]);
        let connection =
            Connection { number: 1, party: Party::Own, is_line: false, strangers: false, trusted: true };
        let seen = |lines: &[&str]| {
            let mut headers = HeaderMap::new();
            for line in lines {
                headers.append(FORWARDED_FOR, line.parse().unwrap());
            }
            headers.insert(FORWARDED_USER, " anna ".parse().unwrap());
            let (connection, user) = some.seen(connection, &headers);
            assert_eq!(user, Some(ForwardedUser("anna".into())));
            connection.party
        };
        let party = |ip: &str| Party::of(ip.parse().unwrap());
        assert_eq!(seen(&["192.0.2.7"]), party("192.0.2.7"));
        // The client wrote the first address itself.
        assert_eq!(seen(&["203.0.113.9, 192.0.2.7", "10.0.0.5"]), party("192.0.2.7"));
        assert_eq!(seen(&["10.0.0.5"]), party("10.0.0.5"));
        assert_eq!(seen(&["[2001:db8::1]:443"]), party("2001:db8::1"));
        assert_eq!((seen(&[]), seen(&["unknown"])), (Party::Own, Party::Own));
    }
}
