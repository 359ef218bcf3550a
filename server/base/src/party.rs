//! Parties: what shares of the server's room are measured by: names where callers have them, else addresses. A
//! connection is none, since a client opens as many as it likes.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::net::IpAddr;

/// Who a request comes from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Party {
    /// The program itself.
    #[default]
    Own,
    /// A machine, or the network of one.
    Peer(IpAddr),
    /// A user of this machine, by its number, on the unix socket.
    Local(u32),
    /// Somebody with a name of the server's: of a token, or one that a trusted proxy has signed in. Its hash.
    Named(u64),
}

impl Party {
    /// Of a name, from wherever its owner connects.
    pub fn named(name: &str) -> Self {
        let mut hasher = DefaultHasher::new();
        name.hash(&mut hasher);
        Self::Named(hasher.finish())
    }

    /// Of a peer's address. A machine has 2^64 addresses of IPv6 (RFC 6177), which count as one.
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
