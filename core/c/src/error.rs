//! What a function says when it fails. No panic crosses to C.

use std::any::Any;
use std::cell::RefCell;
use std::ffi::{CString, c_char};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// What a function did: `lightbvh_status`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// All of it.
    Ok = 0,
    /// A pointer is null or not aligned, or a length is beyond all memory.
    BadPointer = 1,
    /// An edit is refused.
    Refused = 2,
    /// A point is outside the domain, or a number outside [0, 1).
    BadPoint = 3,
    /// There is no such light.
    NoLight = 4,
    /// A defect of the library.
    Panicked = 5,
    /// A background build failed.
    NoRebuild = 6,
}

/// Why a function fails.
#[derive(Debug)]
pub(crate) struct Fault {
    pub status: Status,
    pub message: String,
}

impl Fault {
    pub(crate) fn new(status: Status, message: impl ToString) -> Self {
        Self {
            status,
            message: message.to_string(),
        }
    }
}

thread_local! {
    static LAST: RefCell<CString> = RefCell::default();
}

/// Runs a function's body. What it fails with, or panics with, becomes its status and the thread's last error.
pub(crate) fn guard(body: impl FnOnce() -> Result<(), Fault>) -> Status {
    // A change marks what it changes as broken while it runs (`Held::run`).
    let fault = match catch_unwind(AssertUnwindSafe(body)) {
        Ok(Ok(())) => return Status::Ok,
        Ok(Err(fault)) => fault,
        Err(payload) => {
            let message = format!("defect in lightbvh, please report it: {}", said(&*payload));
            // Dropping what was thrown may panic again.
            std::mem::forget(payload);
            Fault::new(Status::Panicked, message)
        }
    };
    let message = CString::new(fault.message.replace('\0', " ")).unwrap_or_default();
    // A thread that is ending has nowhere to keep it.
    let _ = LAST.try_with(|last| *last.borrow_mut() = message);
    fault.status
}

fn said(payload: &(dyn Any + Send)) -> &str {
    let text = payload.downcast_ref::<&str>().copied();
    let owned = || payload.downcast_ref::<String>().map(String::as_str);
    text.or_else(owned).unwrap_or("no message")
}

/// What the last function that failed on this thread had to say.
#[unsafe(no_mangle)]
pub extern "C" fn lightbvh_last_error() -> *const c_char {
    LAST.try_with(|last| last.borrow().as_ptr())
        .unwrap_or(c"".as_ptr())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::ffi::CStr;

    fn last() -> String {
        // SAFETY: it is a string that stays until the next failure on this thread.
        let text = unsafe { CStr::from_ptr(lightbvh_last_error()) };
        text.to_str().unwrap().to_owned()
    }

    #[test]
    fn panics_end_here() {
        assert_eq!(last(), "");
        assert_eq!(guard(|| panic!("first")), Status::Panicked);
        assert!(last().ends_with("first"));
        assert_eq!(guard(|| std::panic::panic_any(7)), Status::Panicked);
        assert!(last().ends_with("no message"));
    }

    #[test]
    fn each_thread_has_its_own_error() {
        let refused = || Err(Fault::new(Status::Refused, "half\0half"));
        assert_eq!(guard(refused), Status::Refused);
        assert_eq!(last(), "half half");
        assert_eq!(std::thread::spawn(last).join().unwrap(), "");
        // Success leaves it.
        assert_eq!(guard(|| Ok(())), Status::Ok);
        assert_eq!(last(), "half half");
    }
}
