//! AlpaSim's `TrafficService` over gRPC. Its scenes are those of the server, its road users come with each
//! session, and the server drives all that the caller does not.

// Fields of messages have the names of the service.
#[allow(missing_docs, reason = "the names say it")]
mod messages;
mod motion;
mod service;
mod session;

use crate::app::App;
use service::TrafficCarrier;
use std::net::SocketAddr;
use tonic::transport::Server;
use tonic::transport::server::TcpIncoming;

/// A bound address for calls.
pub struct GrpcListener(TcpIncoming);

impl GrpcListener {
    /// Binds an address.
    ///
    /// # Errors
    /// When it is in use, or not permitted.
    pub fn open(address: SocketAddr) -> std::io::Result<Self> {
        TcpIncoming::bind(address).map(Self)
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
        let ended = { server }.serve_with_incoming(service, self.0).await;
        if let Err(error) = ended {
            tracing::error!(%error, "the traffic service ended");
        }
    }
}
