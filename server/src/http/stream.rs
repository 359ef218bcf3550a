//! Connections over TCP or a unix socket.

use base::party::Party;
use std::io::{self, IoSlice};
use std::net::{Shutdown, SocketAddr};
use std::task::{Context, Poll};
use tokio::io::{Interest, ReadBuf, Ready};
use tokio::net::{TcpListener, TcpStream};
#[cfg(unix)]
use tokio::net::{UnixListener, UnixStream};

/// Source of connections.
pub enum Listener {
    /// A TCP address.
    Tcp(TcpListener),
    /// A unix socket.
    #[cfg(unix)]
    Unix(UnixListener),
}

impl Listener {
    /// The next connection.
    ///
    /// # Errors
    /// Those of the system.
    pub async fn accept(&self) -> io::Result<ByteStream> {
        match self {
            Self::Tcp(listener) => {
                let (stream, _) = listener.accept().await?;
                // Events are small and must be sent at once.
                let _ = stream.set_nodelay(true);
                Ok(ByteStream::Tcp(stream))
            }
            #[cfg(unix)]
            Self::Unix(listener) => listener.accept().await.map(|(stream, _)| ByteStream::Unix(stream)),
        }
    }
}

/// A connection.
pub enum ByteStream {
    /// Over TCP.
    Tcp(TcpStream),
    /// Over a unix socket.
    #[cfg(unix)]
    Unix(UnixStream),
}

/// The same call on either kind of stream.
macro_rules! either {
    ($stream:expr, $inner:ident => $call:expr) => {
        match $stream {
            ByteStream::Tcp($inner) => $call,
            #[cfg(unix)]
            ByteStream::Unix($inner) => $call,
        }
    };
}

#[allow(missing_docs, reason = "as tokio has them")]
impl ByteStream {
    /// Addresses of the peer and of this end; a unix socket has none.
    pub fn ends(&self) -> Option<(SocketAddr, SocketAddr)> {
        match self {
            Self::Tcp(stream) => stream.peer_addr().ok().zip(stream.local_addr().ok()),
            #[cfg(unix)]
            Self::Unix(_) => None,
        }
    }

    /// The party of the connection.
    pub fn party(&self) -> Party {
        match self {
            Self::Tcp(stream) => stream.peer_addr().map_or(Party::Own, |peer| Party::of(peer.ip())),
            #[cfg(unix)]
            Self::Unix(stream) => stream.peer_cred().map_or(Party::Own, |user| Party::Local(user.uid())),
        }
    }

    /// Shuts down one or both directions.
    pub fn shutdown(&self, how: Shutdown) {
        let _ = either!(self, stream => socket2::SockRef::from(stream).shutdown(how));
    }

    /// Whether unread bytes have arrived.
    pub fn has_unread(&self) -> bool {
        let mut byte = [std::mem::MaybeUninit::uninit()];
        either!(self, stream => socket2::SockRef::from(stream).peek(&mut byte).is_ok_and(|count| count > 0))
    }

    pub async fn ready(&self, interest: Interest) -> io::Result<Ready> {
        either!(self, stream => stream.ready(interest).await)
    }

    pub async fn readable(&self) -> io::Result<()> {
        either!(self, stream => stream.readable().await)
    }

    pub async fn writable(&self) -> io::Result<()> {
        either!(self, stream => stream.writable().await)
    }

    pub fn try_read(&self, buffer: &mut [u8]) -> io::Result<usize> {
        either!(self, stream => stream.try_read(buffer))
    }

    pub fn try_read_buf(&self, buffer: &mut ReadBuf<'_>) -> io::Result<usize> {
        either!(self, stream => stream.try_read_buf(buffer))
    }

    pub fn try_write(&self, bytes: &[u8]) -> io::Result<usize> {
        either!(self, stream => stream.try_write(bytes))
    }

    pub fn try_write_vectored(&self, slices: &[IoSlice<'_>]) -> io::Result<usize> {
        either!(self, stream => stream.try_write_vectored(slices))
    }

    pub fn poll_read_ready(&self, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        either!(self, stream => stream.poll_read_ready(context))
    }

    pub fn poll_write_ready(&self, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        either!(self, stream => stream.poll_write_ready(context))
    }
}
