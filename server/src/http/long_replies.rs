//! Budget of long replies: they take memory until they are sent, and slow readers of many would exhaust it.

use api::{Code, Problem};
use axum::body::{Body, Bytes};
use axum::extract::{Request, State};
use axum::http::StatusCode;
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use base::memory::{Memory, MemoryShare};
use base::problem::Refusal;
use hyper::body::{Body as HttpBody, Frame, SizeHint};
use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll};

/// Length from which a reply is long, bytes.
const LONG: u64 = 512 << 10;
/// Bytes passed on at a time; bytes that the connection holds are no longer counted.
const PIECE: usize = 64 << 10;

/// Takes memory for each long reply, or refuses it. Replies to completed writes are always sent.
pub async fn hold(State(memory): State<Arc<Memory>>, request: Request, next: Next) -> Response {
    let response = next.run(request).await;
    let length = response.body().size_hint().exact().unwrap_or(0);
    if length < LONG || response.status() == StatusCode::CREATED {
        return response;
    }
    match usize::try_from(length).ok().and_then(|length| memory.take(length)) {
        Some(share) => response.map(|body| Body::new(HeldBody { body, rest: Bytes::new(), _share: share })),
        None => {
            let problem = Problem::new(Code::Busy, "Replies to other requests fill the memory.");
            Refusal::from(problem.retry_after(1)).into_response()
        }
    }
}

struct HeldBody {
    body: Body,
    /// Rest of the piece of the body that is being passed on.
    rest: Bytes,
    _share: MemoryShare,
}

impl HttpBody for HeldBody {
    type Data = Bytes;
    type Error = axum::Error;

    fn poll_frame(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, axum::Error>>> {
        if self.rest.is_empty() {
            match Pin::new(&mut self.body).poll_frame(context) {
                Poll::Ready(Some(Ok(frame))) => match frame.into_data() {
                    Ok(data) => self.rest = data,
                    Err(frame) => return Poll::Ready(Some(Ok(frame))),
                },
                other => return other,
            }
        }
        let most = self.rest.len().min(PIECE);
        Poll::Ready(Some(Ok(Frame::data(self.rest.split_to(most)))))
    }

    fn is_end_stream(&self) -> bool {
        self.rest.is_empty() && self.body.is_end_stream()
    }

    fn size_hint(&self) -> SizeHint {
        let rest = self.rest.len() as u64;
        self.body.size_hint().exact().map_or_else(SizeHint::default, |more| SizeHint::with_exact(rest + more))
    }
}

#[cfg(test)]
mod tests {
    use super::{HeldBody, PIECE};
    use axum::body::{Body, Bytes};
    use base::memory::Memory;
    use http_body_util::BodyExt;
    use hyper::body::Body as HttpBody;

    #[tokio::test]
    async fn a_reply_goes_in_pieces_and_gives_its_memory_back_at_the_end() {
        let memory = Memory::new(1 << 30);
        let bytes: Bytes = (0..=255_u8).cycle().take(3 * PIECE + 7).collect();
        let share = memory.take(bytes.len()).unwrap();
        let mut body = HeldBody { body: Body::from(bytes.clone()), rest: Bytes::new(), _share: share };
        assert_eq!(body.size_hint().exact(), Some(bytes.len() as u64));
        let mut sizes = Vec::new();
        let mut seen = Vec::new();
        while let Some(frame) = body.frame().await {
            let data = frame.unwrap().into_data().unwrap();
            sizes.push(data.len());
            seen.extend_from_slice(&data);
            assert_eq!(body.size_hint().exact(), Some((bytes.len() - seen.len()) as u64));
        }
        assert_eq!((sizes, seen.len()), (vec![PIECE, PIECE, PIECE, 7], bytes.len()));
        assert!(seen == bytes && memory.taken() == bytes.len() as u64);
        drop(body);
        assert_eq!(memory.taken(), 0);
    }
}
