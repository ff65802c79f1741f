//! The linear system of one Newton iteration.

pub(crate) mod block_tridiagonal;
pub(crate) mod condensed;
pub(crate) mod dense;
pub(crate) mod interface;
pub(crate) mod lanes;
pub(crate) mod woodbury;
