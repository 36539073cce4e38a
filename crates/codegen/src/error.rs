//! Why a document gave no shader.

use halfvector_graph::check::Problem;
use halfvector_graph::document::NodeId;
use halfvector_graph::flatten::FlattenError;

/// Why a document gave no shader.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CodegenError {
    /// The document has errors.
    #[error("{}", .0.iter().map(Problem::to_string).collect::<Vec<_>>().join("\n"))]
    Problems(Vec<Problem>),
    /// The document's groups cannot be taken apart.
    #[error(transparent)]
    Groups(#[from] FlattenError),
    /// The document has no surface node, or several.
    #[error("the document has no one surface node; add one and wire the material into it")]
    NoSurface,
    /// A texture input without a picture.
    #[error("`{label}` ({node}): `{socket}` has no picture; choose one")]
    NoImage {
        /// The node.
        node: NodeId,
        /// Its label.
        label: String,
        /// The input.
        socket: String,
    },
    /// A node whose function takes implicit derivatives feeds the height.
    #[error("`{label}` ({node}) needs the derivatives of a fragment and cannot feed the surface's height")]
    NotInVertexStage {
        /// The node.
        node: NodeId,
        /// Its label.
        label: String,
    },
    /// The node library and the shader library do not fit each other.
    #[error("the shader library cannot serve this document: {0}")]
    Library(String),
}
