//! `GpuError`: why there is no picture.

use ogee_render::RenderError;

/// Why a graphics processor made no picture.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GpuError {
    /// Nothing to render on.
    #[error("no graphics adapter: looked for {wanted}; found {found}")]
    NoAdapter {
        /// What was looked for.
        wanted: String,
        /// Names of what there is.
        found: String,
    },
    /// An adapter that will not be opened.
    #[error("the graphics adapter refused: {message}")]
    Refused {
        /// Why.
        message: String,
    },
    /// More than the device takes.
    #[error(
        "{what} of {count} {unit} exceed what the graphics device takes, {most}; render on the processor"
    )]
    TooLarge {
        /// What is too large.
        what: &'static str,
        /// How large it is.
        count: u64,
        /// In what.
        unit: &'static str,
        /// How large it may be.
        most: u64,
    },
    /// The device is gone: pulled out, reset by the system, or out of memory.
    #[error("the graphics device was lost: {message}")]
    Lost {
        /// What the system says.
        message: String,
    },
    /// It did not answer.
    #[error("the graphics device did not answer within {seconds} s")]
    Timeout {
        /// How long was waited.
        seconds: f64,
    },
    /// Something that it was asked for did not work.
    #[error("the graphics device failed: {message}")]
    Failed {
        /// What it says.
        message: String,
    },
    /// A scene that shows nothing.
    #[error(transparent)]
    Scene(#[from] RenderError),
}

impl GpuError {
    /// A stable name in snake case.
    pub fn code(&self) -> &'static str {
        match self {
            GpuError::NoAdapter { .. } => "no_adapter",
            GpuError::Refused { .. } => "adapter_refused",
            GpuError::TooLarge { .. } => "too_large_for_device",
            GpuError::Lost { .. } => "device_lost",
            GpuError::Timeout { .. } => "device_timeout",
            GpuError::Failed { .. } => "device_failed",
            GpuError::Scene(error) => error.code(),
        }
    }
}
