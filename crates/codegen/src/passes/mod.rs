//! The passes, each in its file. Their order stands in `pipeline`.

pub(crate) mod drop_unused;
pub(crate) mod eval;
pub(crate) mod fold;
pub(crate) mod identity;
pub(crate) mod idle;
pub(crate) mod lower;
pub(crate) mod mixed;
pub(crate) mod plan;
pub(crate) mod reduce;
pub(crate) mod share;
pub(crate) mod specialise;
pub(crate) mod types;
