//! What can go wrong between a scene and its picture, in the user's words.

/// Why a picture could not be drawn.
#[derive(Debug, thiserror::Error)]
pub enum RasterError {
    /// The scene's objects and meshes do not fit together.
    #[error(transparent)]
    Passes(#[from] halfvector_scene::PassesError),
    /// A material could not be turned into a shader.
    #[error("material `{material}`: {why}")]
    Shader {
        /// Its name.
        material: String,
        /// The code generator's words, with node and reason.
        why: String,
    },
    /// A material's shader uses something that only a GPU does.
    #[error("material `{material}`: {why}; draw it with --backend gpu")]
    Unsupported {
        /// Its name.
        material: String,
        /// What, and where.
        why: String,
    },
    /// A material's shader gave up while it ran.
    #[error("material `{material}`: {why}")]
    Run {
        /// Its name.
        material: String,
        /// The node where it is known, and the reason.
        why: String,
    },
    /// An image that a material refers to was not loaded into the scene.
    #[error("material `{material}`: the image {file} was not loaded; load the scene's images before it is drawn")]
    MissingImage {
        /// Its name.
        material: String,
        /// As the document has it.
        file: String,
    },
    /// The material reads an environment and the caller gave none.
    #[error("the scene has an environment and no baked one was given; bake it first")]
    NoEnvironment,
    /// The picture asked for is empty or too large.
    #[error(
        "a picture of {width} x {height} pixels with {side} x {side} samples each cannot be drawn; choose a smaller size"
    )]
    PictureSize {
        /// Pixels.
        width: u32,
        /// Pixels.
        height: u32,
        /// Samples along one side of a pixel.
        side: u32,
    },
}
