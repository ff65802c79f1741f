//! Pointers of the program as references.

use crate::abi::table::AbiText;

/// A struct of the program's; fields that an older minor version lacks are zero, functions null.
///
/// # Safety
/// `given` leads to a struct of as many bytes as its first field says, and `T` is made of numbers, pointers and
/// functions that may be null.
pub(super) unsafe fn known_part<T: Copy>(given: *const T) -> T {
    let mut known = std::mem::MaybeUninit::<T>::zeroed();
    // SAFETY: guaranteed by the caller; all zeros is a value of such a struct.
    unsafe {
        let bytes = (given.cast::<u32>().read() as usize).min(size_of::<T>());
        std::ptr::copy_nonoverlapping(given.cast::<u8>(), known.as_mut_ptr().cast(), bytes);
        known.assume_init()
    }
}

/// # Safety
/// The text lives as long as the caller uses it.
pub(super) unsafe fn text<'a>(raw: AbiText) -> std::borrow::Cow<'a, str> {
    // SAFETY: guaranteed by the caller.
    String::from_utf8_lossy(unsafe { array(raw.text.cast(), raw.length) })
}

/// # Safety
/// `count` values lie at `first`, or it is null; they live as long as the caller uses them.
pub(super) unsafe fn array<'a, T>(first: *const T, count: usize) -> &'a [T] {
    // SAFETY: guaranteed by the caller.
    if first.is_null() { &[] } else { unsafe { std::slice::from_raw_parts(first, count) } }
}

/// # Safety
/// As [`array`], and nothing else uses them during the call.
pub(super) unsafe fn array_mut<'a, T>(first: *mut T, count: usize) -> &'a mut [T] {
    // SAFETY: guaranteed by the caller.
    if first.is_null() { &mut [] } else { unsafe { std::slice::from_raw_parts_mut(first, count) } }
}

/// Size of a struct of the table [bytes].
pub(super) const fn size<T>() -> u32 {
    size_of::<T>() as u32
}

#[cfg(test)]
mod tests {
    use std::ffi::c_void;

    use super::*;
    use crate::abi::table::{AbiRigHost, STATUS_OK};

    unsafe extern "C" fn lay(_: *mut c_void, _: AbiText, _: *const [f64; 3], _: usize) -> i32 {
        STATUS_OK
    }

    #[test]
    fn what_a_program_of_an_older_minor_version_lacks_is_none() {
        let whole = AbiRigHost {
            struct_size: size::<AbiRigHost>(),
            host: std::ptr::null_mut(),
            add_body: None,
            add_joint: None,
            add_line: None,
            add_link: None,
            lay_line: Some(lay),
        };
        let older =
            AbiRigHost { struct_size: std::mem::offset_of!(AbiRigHost, lay_line) as u32, ..whole };
        // SAFETY: both are whole structs; the second says that it is shorter.
        let (whole, older) = unsafe { (known_part(&whole), known_part(&older)) };
        assert!(whole.lay_line.is_some() && older.lay_line.is_none());
    }
}
