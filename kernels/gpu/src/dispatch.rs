//! Workgroups of a dispatch.

/// Workgroups in one row of a dispatch, which every Vulkan device accepts (`maxComputeWorkGroupCount` is at least 65535).
pub const ROW_GROUPS: u32 = 65_535;

/// Workgroups in x, y and z for `invocations` of a kernel whose workgroups are `width` wide, or `None` if their numbers would
/// not fit 32 bits.
///
/// The kernels count rows of [`ROW_GROUPS`] workgroups: invocation `(x, y)` is number `y * ROW_GROUPS * width + x`, and the last
/// row is a whole one. Invocations beyond the number in the push constants do nothing.
#[must_use]
pub fn groups(invocations: u32, width: u32) -> Option<[u32; 3]> {
    let groups = invocations.div_ceil(width);
    if groups <= ROW_GROUPS {
        return Some([groups, 1, 1]);
    }
    let rows = groups.div_ceil(ROW_GROUPS);
    let numbered = u64::from(rows) * u64::from(ROW_GROUPS) * u64::from(width);
    (numbered <= 1 << 32).then_some([ROW_GROUPS, rows, 1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_begin_where_one_is_full() {
        assert_eq!(groups(0, 64), Some([0, 1, 1]));
        assert_eq!(groups(1, 64), Some([1, 1, 1]));
        assert_eq!(groups(64, 64), Some([1, 1, 1]));
        assert_eq!(groups(65, 64), Some([2, 1, 1]));
        assert_eq!(groups(65_535 * 64, 64), Some([65_535, 1, 1]));
        assert_eq!(groups(65_535 * 64 + 1, 64), Some([65_535, 2, 1]));
        assert_eq!(groups(1024 * 65_535 * 64, 64), Some([65_535, 1024, 1]));
    }

    #[test]
    fn numbers_that_would_wrap_are_refused() {
        assert_eq!(groups(1024 * 65_535 * 64 + 1, 64), None);
        assert_eq!(groups(u32::MAX, 64), None);
    }
}
