//! Whether two lists of numbers are the same to the bit.

/// Whether two lists are the same to the bit. It looks at every number without a branch, several at once: most lists that are compared are the
/// same, and `==` stops to ask after each.
pub(crate) fn same_bits(one: &[f64], other: &[f64]) -> bool {
    let differences = one.iter().zip(other).map(|(a, b)| a.to_bits() ^ b.to_bits());
    one.len() == other.len() && differences.fold(0, |all, one| all | one) == 0
}
