//! AlpaSim's `TrafficService` over gRPC. Its scenes are those of the server, its road users come with each
//! session, and the server drives all that the caller does not.

mod connections;
// Fields of messages have the names of the service.
#[allow(missing_docs, reason = "the names say it")]
mod messages;
mod motion;
mod service;
mod session;

use crate::app::App;
use service::TrafficCarrier;
use std::net::SocketAddr;
use tokio::net::TcpListener;
use tonic::transport::Server;

/// Connections that may be open at a time. The service has no tokens, so every process of the machine may open some;
/// they must leave descriptors to the rest of the server.
const MOST_CONNECTIONS: usize = 32;

/// A bound address for calls.
pub struct GrpcListener(TcpListener);

impl GrpcListener {
    /// Binds an address.
    ///
    /// # Errors
    /// When it is in use, or not permitted.
    pub async fn open(address: SocketAddr) -> std::io::Result<Self> {
        TcpListener::bind(address).await.map(Self)
    }

    /// The address, with the port that the system chose for 0.
    ///
    /// # Errors
    /// Those of the system.
    pub fn address(&self) -> std::io::Result<SocketAddr> {
        self.0.local_addr()
    }

    /// Serves calls for as long as the server runs.
    pub async fn serve(self, app: &App) {
        let carrier = TrafficCarrier::new(app);
        let service = tower::service_fn(move |request| {
            let carrier = carrier.clone();
            async move { Ok::<_, std::convert::Infallible>(carrier.answer(request).await) }
        });
        let server = Server::builder().max_concurrent_streams(64).concurrency_limit_per_connection(16);
        let connections = connections::accepted(self.0, MOST_CONNECTIONS);
        let ended = { server }.serve_with_incoming(service, connections).await;
        if let Err(error) = ended {
            tracing::error!(%error, "the traffic service ended");
        }
    }
}
