//! What can go wrong between a scene and its picture, in the user's words.

/// Why a picture could not be drawn.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// The machine offers no GPU, not even a software one.
    #[error(
        "no GPU was found, not even a software one ({why}); install a Vulkan driver, for example Debian's and Ubuntu's \
         package `mesa-vulkan-drivers` (it has drivers for many cards and a software GPU), then try again"
    )]
    NoAdapter {
        /// What was looked for.
        why: String,
    },
    /// A GPU is there and would not open.
    #[error("the GPU `{adapter}` could not be opened: {why}; close programs that use it, or update its driver")]
    Device {
        /// Its name.
        adapter: String,
        /// The driver's words.
        why: String,
    },
    /// The driver gave up during the work.
    #[error(
        "the GPU `{adapter}` stopped while {doing}: {why}; try a smaller --size or fewer --samples, or update its driver"
    )]
    Lost {
        /// Its name.
        adapter: String,
        /// What was being done.
        doing: String,
        /// The driver's words.
        why: String,
    },
    /// Not enough memory on the GPU.
    #[error("the GPU `{adapter}` ran out of memory while {doing}; use smaller images or meshes, or a smaller --size")]
    OutOfMemory {
        /// Its name.
        adapter: String,
        /// What was being done.
        doing: String,
    },
    /// wgpu refused a command: a mistake of this program.
    #[error(
        "the GPU `{adapter}` refused a command while {doing}: {why}; this is a mistake of Halfvector, please report it"
    )]
    Refused {
        /// Its name.
        adapter: String,
        /// What was being done.
        doing: String,
        /// wgpu's words.
        why: String,
    },
    /// A target with these properties cannot be drawn to on this device.
    #[error(
        "the GPU `{adapter}` cannot draw to floating-point pictures; try another driver, such as `mesa-vulkan-drivers`"
    )]
    NoFloatTarget {
        /// Its name.
        adapter: String,
    },
    /// An image is larger than the device's textures may be.
    #[error(
        "the image {file} has {width} x {height} pixels, and textures of the GPU `{adapter}` may have {limit} on a side; \
         scale the image down"
    )]
    ImageTooLarge {
        /// Which.
        file: String,
        /// Pixels.
        width: u32,
        /// Pixels.
        height: u32,
        /// The device's limit.
        limit: u32,
        /// The device.
        adapter: String,
    },
    /// The tree over an environment does not fit into the device's buffers.
    #[error(
        "an environment of {width} x {height} pixels needs a buffer of {bytes} bytes, and the GPU `{adapter}` allows \
         {limit}; bake it on the CPU, or scale the file down"
    )]
    EnvironmentTooLarge {
        /// Pixels.
        width: usize,
        /// Pixels.
        height: usize,
        /// Bytes wanted.
        bytes: u64,
        /// Bytes allowed.
        limit: u64,
        /// The device.
        adapter: String,
    },
    /// An image that a material refers to was not loaded into the scene.
    #[error("material `{material}`: the image {file} was not loaded; load the scene's images before it is drawn")]
    MissingImage {
        /// Its name.
        material: String,
        /// As the document has it.
        file: String,
    },
    /// A mesh does not fit into the device's buffers.
    #[error(
        "mesh {mesh} needs a buffer of {bytes} bytes, and the GPU `{adapter}` allows {limit}; split it or reduce it"
    )]
    MeshTooLarge {
        /// Index in the scene.
        mesh: usize,
        /// Bytes wanted.
        bytes: u64,
        /// Bytes allowed.
        limit: u64,
        /// The device.
        adapter: String,
    },
    /// The scene's objects and meshes do not fit together.
    #[error(transparent)]
    Passes(#[from] halfvector_scene::PassesError),
    /// A shader reads a vertex attribute that meshes do not have: a mistake of this program.
    #[error(
        "a shader reads the attribute `{name}`, which meshes do not have; this is a mistake of Halfvector, please report it"
    )]
    Attribute {
        /// Its name.
        name: String,
    },
    /// A function of the library cannot be called as it was asked for.
    #[error("the function `{name}` cannot be called: {why}")]
    Function {
        /// Its name.
        name: String,
        /// Why not.
        why: String,
    },
    /// A material could not be turned into a shader.
    #[error("material `{material}`: {why}")]
    Shader {
        /// Its name.
        material: String,
        /// The code generator's words, with node and reason.
        why: String,
    },
    /// A material reads more images than the device can bind.
    #[error(
        "material `{material}` reads {count} textures, and the GPU `{adapter}` allows {limit} in one shader; pack several \
         grey images into the channels of one"
    )]
    TooManyTextures {
        /// Its name.
        material: String,
        /// How many it reads.
        count: usize,
        /// How many are allowed.
        limit: u32,
        /// The device.
        adapter: String,
    },
    /// A uniform block is larger than the device can bind.
    #[error(
        "material `{material}` needs {bytes} bytes for `{block}`, and the GPU `{adapter}` allows {limit}; use fewer \
         punctual lights, or a material with fewer nodes"
    )]
    UniformsTooLarge {
        /// Its name.
        material: String,
        /// Name of the struct.
        block: String,
        /// Bytes wanted.
        bytes: u32,
        /// Bytes allowed.
        limit: u64,
        /// The device.
        adapter: String,
    },
    /// The material reads an environment and the caller gave none.
    #[error("the scene has an environment and no baked one was given; bake it first")]
    NoEnvironment,
    /// The picture asked for is empty or larger than an address space.
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

impl RenderError {
    /// Whether it is the device that failed, not what it was given: another picture may fail as well, and what was made on
    /// it is not to be used again.
    pub fn is_of_device(&self) -> bool {
        matches!(
            self,
            RenderError::NoAdapter { .. }
                | RenderError::Device { .. }
                | RenderError::Lost { .. }
                | RenderError::OutOfMemory { .. }
                | RenderError::Refused { .. }
                | RenderError::NoFloatTarget { .. }
        )
    }
}
