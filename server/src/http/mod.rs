//! HTTP itself, whatever is asked.

pub mod body;
pub mod embed;
pub mod guard;
pub mod net;
pub mod observe;
