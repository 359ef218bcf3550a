//! HTTP itself, whatever is asked: connections, who may ask, bodies, headers, the way replies look.

pub mod accept;
pub mod body;
pub mod coding;
pub mod embed;
pub mod extract;
pub mod guard;
pub mod line;
pub mod net;
pub mod observe;
mod owner;
pub mod packed;
pub mod upload;
mod wire;
