//! Parties, by which the server divides its resources: names if callers have them, else addresses. A
//! connection is not a party, because a client can open any number.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::net::IpAddr;

/// The party of a request.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Party {
    /// The program itself.
    #[default]
    Own,
    /// A machine, or the network of one.
    Peer(IpAddr),
    /// A user of this machine on the unix socket, by user id.
    Local(u32),
    /// A named user: of a token, or authenticated by a trusted proxy. Hash of the name.
    Named(u64),
}

impl Party {
    /// The party of a name, from any address.
    pub fn named(name: &str) -> Self {
        let mut hasher = DefaultHasher::new();
        name.hash(&mut hasher);
        Self::Named(hasher.finish())
    }

    /// The party of a peer's address. A machine has 2^64 IPv6 addresses (RFC 6177), which count as one.
    pub fn of(peer: IpAddr) -> Self {
        match peer.to_canonical() {
            IpAddr::V6(ip) => {
                let [a, b, c, d, ..] = ip.segments();
                Self::Peer(IpAddr::from([a, b, c, d, 0, 0, 0, 0]))
            }
            v4 => Self::Peer(v4),
        }
    }
}

impl std::fmt::Display for Party {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Own => Ok(()),
            Self::Peer(address) => address.fmt(f),
            Self::Local(user) => write!(f, "user {user}"),
            Self::Named(hash) => write!(f, "named {hash:016x}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Party;

    #[test]
    fn a_machine_is_one_party_whatever_it_connects_by() {
        let party = |text: &str| Party::of(text.parse().unwrap());
        assert_eq!(party("127.0.0.1"), party("::ffff:127.0.0.1"));
        assert_ne!(party("127.0.0.1"), party("127.0.0.2"));
        assert_eq!(party("2001:db8:1:2::3"), party("2001:db8:1:2:ffff::4"));
        assert_ne!(party("2001:db8:1:2::3"), party("2001:db8:1:3::3"));
    }
}
