//! Room for large arrays. Memory that a program writes for the first time is cleared by the system, a page at a time; where
//! pages are large that is several times faster. Systems hand them out to those who ask.

use bytemuck::{Zeroable, zeroed_vec};

/// Size in bytes from which asking is worth it: two large pages of the common processors.
const LARGE: usize = 4 << 20;

/// An empty vector with room for `capacity` values, in large pages where it is large and the system has them.
pub(crate) fn vector<T>(capacity: usize) -> Vec<T> {
    let mut out = Vec::new();
    reserve_exact(&mut out, capacity);
    out
}

/// Room for so many values more, as [`Vec::reserve`] makes it, in large pages where it is large.
pub(crate) fn reserve<T>(vector: &mut Vec<T>, additional: usize) {
    if vector.capacity() - vector.len() < additional {
        vector.reserve(additional);
        advise(vector);
    }
}

/// The same, with none to spare.
pub(crate) fn reserve_exact<T>(vector: &mut Vec<T>, additional: usize) {
    if vector.capacity() - vector.len() < additional {
        vector.reserve_exact(additional);
        advise(vector);
    }
}

/// Makes room for `count` values that are about to be written, all of them. What is there already stays what it was, fresh memory
/// is zero as the system hands it out.
pub(crate) fn resize<T: Zeroable + Clone>(values: &mut Vec<T>, count: usize) {
    if values.capacity() < count {
        // What there is goes back before the new memory is asked for.
        *values = Vec::new();
        *values = zeroed_vec(count);
        advise(values);
    } else {
        values.resize(count, T::zeroed());
    }
}

/// Asks for large pages under all the room of a vector. Nothing depends on the answer.
#[cfg(target_os = "linux")]
fn advise<T>(vector: &Vec<T>) {
    const PAGE: usize = 4096;
    let bytes = vector.capacity().saturating_mul(size_of::<T>());
    if bytes < LARGE {
        return;
    }
    // From the page that the room begins in: allocators put a few bytes of their own before it, and without them the first
    // large page would not be whole.
    let before = vector.as_ptr().addr() % PAGE;
    let start = vector.as_ptr().cast::<u8>().wrapping_sub(before).cast_mut();
    // Sound: all these pages hold bytes of one live allocation, so they are there; the advice is about the size of pages that
    // are yet to be handed out, and changes no content, whoever's it is.
    #[expect(unsafe_code, reason = "the system takes an address")]
    unsafe {
        libc::madvise(start.cast(), bytes + before, libc::MADV_HUGEPAGE);
    }
}

#[cfg(not(target_os = "linux"))]
fn advise<T>(_: &Vec<T>) {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn room_is_made_and_values_stay() {
        for count in [0, 1, LARGE / 8 - 1, LARGE / 8, 3 * LARGE / 8 + 5] {
            let mut numbers = vector::<u64>(count);
            assert!(numbers.is_empty() && numbers.capacity() >= count);
            let room = numbers.as_ptr();
            numbers.extend(0..count as u64);
            assert_eq!(numbers.as_ptr(), room);
            reserve(&mut numbers, LARGE);
            assert!(numbers.capacity() >= count + LARGE);
            assert!(numbers.iter().copied().eq(0..count as u64));
        }
    }

    #[test]
    fn old_memory_is_used_again() {
        let mut numbers = vec![7_u64; 10];
        let room = numbers.as_ptr();
        resize(&mut numbers, 5);
        assert_eq!((numbers.as_ptr(), &numbers[..]), (room, &[7; 5][..]));
        resize(&mut numbers, LARGE);
        assert!(numbers.len() == LARGE && numbers.iter().all(|&number| number == 0));
    }

    #[test]
    fn nothing_is_as_large_as_one_likes() {
        assert_eq!(vector::<()>(usize::MAX).capacity(), usize::MAX);
        let mut nothing = vec![(); 7];
        reserve(&mut nothing, LARGE);
        assert_eq!(nothing.len(), 7);
    }
}
