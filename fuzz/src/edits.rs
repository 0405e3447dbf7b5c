use crate::Forms;
pub fn edits(_: &[u8], _: Forms) {}
