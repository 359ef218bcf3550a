//! Owner of a connection. Every local user can connect to this machine's own addresses.
//!
//! Linux reports the owner of a socket by its two addresses (sock_diag(7)). The socket whose local address is
//! our peer's is the peer's end of the connection.

use std::net::SocketAddr;

/// Whether the peer is known to be another user of this machine than this process and root. False if the
/// owner is unknown (another system, another namespace).
pub fn is_strangers(peer: SocketAddr, own: SocketAddr) -> bool {
    // At its own end, a mapped address is an IPv4 address.
    let plain = |address: SocketAddr| SocketAddr::new(address.ip().to_canonical(), address.port());
    let known = || Some((own_user()?, owner_of(plain(peer), plain(own))?));
    peer.ip().to_canonical().is_loopback() && known().is_some_and(|(us, them)| them != us && them != 0)
}

#[cfg(target_os = "linux")]
fn own_user() -> Option<u32> {
    Some(rustix::process::geteuid().as_raw())
}

/// Owner of the socket at `local` that is connected to `remote`.
#[cfg(target_os = "linux")]
fn owner_of(local: SocketAddr, remote: SocketAddr) -> Option<u32> {
    use rustix::net::{AddressFamily, RecvFlags, SendFlags, SocketFlags, SocketType, netlink};
    let (family, flags) = (AddressFamily::NETLINK, SocketFlags::CLOEXEC);
    let socket = rustix::net::socket_with(family, SocketType::DGRAM, flags, Some(netlink::SOCK_DIAG)).ok()?;
    rustix::net::send(&socket, &question(local, remote), SendFlags::empty()).ok()?;
    let mut answer = [0; 1024];
    let (length, _) = rustix::net::recv(&socket, &mut answer, RecvFlags::DONTWAIT).ok()?;
    owner_in(answer.get(..length)?)
}

#[cfg(not(target_os = "linux"))]
fn own_user() -> Option<u32> {
    None
}

#[cfg(not(target_os = "linux"))]
fn owner_of(_: SocketAddr, _: SocketAddr) -> Option<u32> {
    None
}

/// SOCK_DIAG_BY_FAMILY: type of requests about sockets, and of their replies.
const BY_FAMILY: u16 = 20;

/// A netlink header (16 bytes) and an `inet_diag_req_v2` (56) about one TCP socket in any state.
fn question(local: SocketAddr, remote: SocketAddr) -> Vec<u8> {
    const REQUEST: u16 = 1;
    const ANY_STATE: u32 = u32::MAX;
    let family = if local.is_ipv4() { 2u8 } else { 10 };
    let address = |address: SocketAddr| match address.ip() {
        std::net::IpAddr::V4(ip) => [&ip.octets()[..], &[0; 12]].concat(),
        std::net::IpAddr::V6(ip) => ip.octets().to_vec(),
    };
    let body = [
        // Family, TCP, no other attributes, padding.
        &[family, 6, 0, 0][..],
        &ANY_STATE.to_ne_bytes(),
        &local.port().to_be_bytes(),
        &remote.port().to_be_bytes(),
        &address(local),
        &address(remote),
        // Any interface, and no cookie.
        &[0; 4],
        &[0xff; 8],
    ]
    .concat();
    let length = (16 + body.len()) as u32;
    // Length, type, flags, number and port.
    let head =
        [&length.to_ne_bytes()[..], &BY_FAMILY.to_ne_bytes(), &REQUEST.to_ne_bytes(), &[0; 8]].concat();
    [head, body].concat()
}

/// The user id in a reply: a netlink header and an `inet_diag_msg`. `None` for an error.
fn owner_in(answer: &[u8]) -> Option<u32> {
    let word = |at: usize| <[u8; 4]>::try_from(answer.get(at..at + 4)?).ok();
    let kind = u16::from_ne_bytes(answer.get(4..6)?.try_into().ok()?);
    // After the header: family, state, timer, retries (4), the socket (48), expiry and two queues (12).
    (kind == BY_FAMILY).then(|| word(16 + 64).map(u32::from_ne_bytes))?
}

#[cfg(test)]
mod tests {
    use super::{is_strangers, owner_in};
    use std::net::{TcpListener, TcpStream};

    #[cfg(target_os = "linux")]
    #[test]
    fn ones_own_connections_are_known_and_no_strangers() {
        for address in ["127.0.0.1:0", "[::1]:0"] {
            // IPv6 is not available everywhere.
            let Ok(listener) = TcpListener::bind(address) else { continue };
            let client = TcpStream::connect(listener.local_addr().unwrap()).unwrap();
            let (peer, own) = (client.local_addr().unwrap(), listener.local_addr().unwrap());
            assert_eq!(super::owner_of(peer, own), super::own_user(), "{address}");
            assert!(!is_strangers(peer, own));
            drop(client);
        }
        let nobody = "127.0.0.1:9".parse().unwrap();
        assert_eq!(super::owner_of(nobody, nobody), None);
    }

    #[test]
    fn errors_and_short_answers_tell_nothing() {
        let error = [&36u32.to_ne_bytes()[..], &2u16.to_ne_bytes(), &[0; 94]].concat();
        assert_eq!((owner_in(&error), owner_in(&[]), owner_in(&[20, 0, 0, 0, 20, 0])), (None, None, None));
    }
}
