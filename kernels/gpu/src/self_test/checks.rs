//! What each word of the self-test means.

/// The meaning of one answer of the [self-test](super).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Check {
    /// Short name, for tables and JSON.
    pub name: &'static str,
    /// The defect that a differing word shows, as it can be printed after "the device".
    pub defect: &'static str,
    /// Whether a difference forbids calling the device exact.
    pub counts: bool,
}

const fn counted(name: &'static str, defect: &'static str) -> Check {
    Check {
        name,
        defect,
        counts: true,
    }
}

const fn freedom(name: &'static str, defect: &'static str) -> Check {
    Check {
        name,
        defect,
        counts: false,
    }
}

const CONTRACTS: &str = "fuses a product and a sum into one rounding (contraction)";
const RE_ASSOCIATES: &str = "rearranges sums or products as if they were not rounded (re-association)";
const ROUNDS: &str = "does not round to nearest, ties to even";

/// The answers to three operands in the order in which the kernel writes them.
pub const CHECKS: [Check; 38] = [
    counted("multiply_add", CONTRACTS),
    counted("multiply_subtract", CONTRACTS),
    counted("negated_multiply_add", CONTRACTS),
    counted("difference_of_products", CONTRACTS),
    counted("sum_of_squares", CONTRACTS),
    counted("horner", CONTRACTS),
    counted("sum_minus_first", RE_ASSOCIATES),
    counted("sum_minus_second", RE_ASSOCIATES),
    counted("two_sum_error", RE_ASSOCIATES),
    counted("sum_from_the_left", RE_ASSOCIATES),
    counted("sum_from_the_right", RE_ASSOCIATES),
    counted("product_from_the_left", RE_ASSOCIATES),
    counted("product_from_the_right", RE_ASSOCIATES),
    counted("distributed_product", RE_ASSOCIATES),
    counted("collected_constants", RE_ASSOCIATES),
    counted("sum", ROUNDS),
    counted("difference", ROUNDS),
    counted("product", ROUNDS),
    counted("negation", "changes more than the sign when negating"),
    counted("comparison", "orders numbers wrongly"),
    counted("selection", "selects the wrong number after a comparison"),
    counted("integer_to_float", "converts integers up to 2^24 inexactly"),
    counted(
        "signed_integer_to_float",
        "converts negative integers down to -2^23 inexactly",
    ),
    counted(
        "float_to_unsigned",
        "does not truncate floats below 2^24 to integers",
    ),
    counted(
        "float_to_signed",
        "does not truncate negative floats above -2^24 to integers",
    ),
    counted("integer_operations", "computes 32-bit integers wrongly"),
    counted("division", "runs the exact division to a different quotient"),
    counted("square_root", "runs the exact square root to a different root"),
    counted("reciprocal", "runs the Newton reciprocal to different bits"),
    counted(
        "reciprocal_square_root",
        "runs the Newton reciprocal square root to different bits",
    ),
    freedom("denormal_operand", "takes denormal operands for zero"),
    freedom("denormal_result", "writes denormal results as zero"),
    freedom("denormal_comparison", "compares denormals as zero"),
    freedom("zero_product_sign", "loses the sign of a zero product"),
    freedom("literal_zero_product", "computes x * 0 without looking at x"),
    freedom("zero_sum_sign", "keeps -0 in -0 + 0"),
    freedom(
        "wide_signed_to_float",
        "rounds integers above 2^24 differently on the way to a float",
    ),
    freedom(
        "wide_positive_to_float",
        "rounds positive integers above 2^24 differently on the way to a float",
    ),
];
