//! What a function says when it fails. No panic crosses to C.

use std::any::Any;
use std::cell::RefCell;
use std::ffi::{CString, c_char};
use std::panic::{AssertUnwindSafe, catch_unwind};

use lightbvh::bvh::EditReason;

/// What a function did: `lightbvh_status`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    Ok = 0,
    BadPointer = 1,
    BadTag = 2,
    BadPoint = 3,
    NoLight = 4,
    Panicked = 5,
    NoRebuild = 6,
    WrongModel = 7,
    UnknownMesh = 8,
    UnknownInstance = 9,
    NotALight = 10,
    EmptyMesh = 11,
    BadLight = 12,
    BadTransform = 13,
    BadRadiance = 14,
    BadRange = 15,
    InUse = 16,
    TooMany = 17,
    BadWords = 18,
    Inexact = 19,
    Refused = 20,
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

    /// The same of element `index` of an array of `what`s.
    pub(crate) fn at(self, what: &str, index: usize) -> Self {
        let message = format!("{what} {index}: {}", self.message);
        Self { message, ..self }
    }
}

impl From<EditReason> for Fault {
    fn from(reason: EditReason) -> Self {
        let status = match &reason {
            EditReason::UnknownMesh(_) => Status::UnknownMesh,
            EditReason::UnknownInstance(_) => Status::UnknownInstance,
            EditReason::NoLight(_) => Status::NotALight,
            EditReason::EmptyMesh => Status::EmptyMesh,
            EditReason::Light { .. } | EditReason::Alone(_) => Status::BadLight,
            EditReason::Transform(_) => Status::BadTransform,
            EditReason::Radiance { .. } => Status::BadRadiance,
            EditReason::Count { .. } | EditReason::Range { .. } => Status::BadRange,
            EditReason::InUse { .. } => Status::InUse,
            EditReason::TooMany => Status::TooMany,
            _ => Status::Refused,
        };
        let message = NAMES
            .iter()
            .fold(reason.to_string(), |text, [rust, c]| text.replace(rust, c));
        Self::new(status, message)
    }
}

/// Functions that messages of Rust name, and those of C.
const NAMES: [[&str; 2]; 4] = [
    ["`mesh_id`", "`lightbvh_mesh_at`"],
    ["`instance_id`", "`lightbvh_instance_at`"],
    ["`Edit::SetLights`", "`lightbvh_set_lights`"],
    ["`take_removed_lights`", "`lightbvh_forget_removed_lights`"],
];

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
