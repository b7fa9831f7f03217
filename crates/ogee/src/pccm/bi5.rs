//! placeholder
use super::PccmError;
/// x
pub fn to_quintic_patches() -> Result<(), PccmError> {
    Ok(())
}
