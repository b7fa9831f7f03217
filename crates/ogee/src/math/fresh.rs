//! Large results: into memory that was used before, or into fresh memory that is touched only once.

use bytemuck::Zeroable;

/// Makes room for `count` values that are about to be written, all of them. What is there already stays what it was, fresh memory
/// is zero as the system hands it out.
pub(crate) fn resize<T: Zeroable + Clone>(values: &mut Vec<T>, count: usize) {
    if values.capacity() < count {
        *values = bytemuck::zeroed_vec(count);
    } else {
        values.resize(count, T::zeroed());
    }
}
