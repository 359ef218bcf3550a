//! Whose connection it is: on this machine's own addresses every user of it can connect.
//!
//! Linux lists the sockets of a network namespace with their owners in `/proc/net/tcp` and `tcp6`: the line
//! whose local address is our peer's is its end of the connection.

use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr};

/// True when the other end of a connection is known to belong to another user of this machine than this
/// process and root. Where that cannot be told (another system, another namespace) it is false.
pub fn is_strangers(peer: SocketAddr, own: SocketAddr) -> bool {
    let known = || Some((own_user()?, owner_of(peer, own)?));
    peer.ip().to_canonical().is_loopback() && known().is_some_and(|(us, them)| them != us && them != 0)
}

#[cfg(target_os = "linux")]
fn own_user() -> Option<u32> {
    use std::os::unix::fs::MetadataExt;
    Some(std::fs::metadata("/proc/self").ok()?.uid())
}

#[cfg(not(target_os = "linux"))]
fn own_user() -> Option<u32> {
    None
}

fn owner_of(peer: SocketAddr, own: SocketAddr) -> Option<u32> {
    let tables = ["/proc/net/tcp", "/proc/net/tcp6"];
    tables.iter().find_map(|table| owner_in(&std::fs::read_to_string(table).ok()?, peer, own))
}

/// Owner of the socket at `local` that is connected with `remote`, by a table of sockets.
fn owner_in(table: &str, local: SocketAddr, remote: SocketAddr) -> Option<u32> {
    let same = |text: &str, address: SocketAddr| {
        socket(text).is_some_and(|(ip, port)| ip == address.ip().to_canonical() && port == address.port())
    };
    table.lines().skip(1).find_map(|line| {
        let fields: Vec<&str> = line.split_ascii_whitespace().collect();
        let ours = same(fields.get(1)?, local) && same(fields.get(2)?, remote);
        ours.then(|| fields.get(7)?.parse().ok())?
    })
}

/// An address as the tables have it: words of the IP in the machine's byte order, then the port, hexadecimal.
fn socket(text: &str) -> Option<(IpAddr, u16)> {
    let (ip, port) = text.split_once(':')?;
    let port = u16::from_str_radix(port, 16).ok()?;
    let word = |at: usize| Some(u32::from_str_radix(ip.get(at..at + 8)?, 16).ok()?.to_ne_bytes());
    let ip = match ip.len() {
        8 => IpAddr::V4(Ipv4Addr::from(word(0)?)),
        32 => {
            let words = [word(0)?, word(8)?, word(16)?, word(24)?];
            let bytes: [u8; 16] = words.concat().try_into().ok()?;
            IpAddr::V6(Ipv6Addr::from(bytes)).to_canonical()
        }
        _ => return None,
    };
    Some((ip, port))
}

#[cfg(test)]
mod tests {
    use super::{is_strangers, owner_in};
    use std::net::{TcpListener, TcpStream};

    const TABLE: &str = "  sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt   uid  timeout inode
   0: 0100007F:1F90 00000000:0000 0A 00000000:00000000 00:00000000 00000000  1000        0 1 1
   1: 0100007F:D431 0100007F:1F90 01 00000000:00000000 00:00000000 00000000 65534        0 2 1
   2: 0000000000000000FFFF00000100007F:D432 0000000000000000FFFF00000100007F:1F90 01 0:0 00:0 0  1001        0 3 1
";

    #[cfg(target_endian = "little")]
    #[test]
    fn the_other_end_is_found_by_both_addresses() {
        let own = "127.0.0.1:8080".parse().unwrap();
        let owner = |peer: &str| owner_in(TABLE, peer.parse().unwrap(), own);
        assert_eq!(owner("127.0.0.1:54321"), Some(65534));
        assert_eq!(owner("127.0.0.1:54322"), Some(1001), "mapped into the newer protocol");
        assert_eq!(owner("127.0.0.1:54323"), None);
        assert_eq!(owner_in("nonsense\n1: 2 3\n", own, own), None);
    }

    #[test]
    fn ones_own_connections_are_no_strangers() {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let client = TcpStream::connect(listener.local_addr().unwrap()).unwrap();
        let (peer, own) = (client.local_addr().unwrap(), listener.local_addr().unwrap());
        assert!(!is_strangers(peer, own));
    }
}
