//! Dense systems by elimination with partial pivoting.
//!
//! `A = P L U` in panels of [`PANEL`] columns: a panel is factored with the rows that it needs, then all of it is taken from the rest at once, so that
//! a row passes the processor once for each panel and not once for each column. The order of operations does not depend on the
//! processor, nor does any bit of the solution.
//! Reference: Golub and Van Loan 2013, Matrix Computations, sections 3.2 and 3.4.

use pulp::{Arch, Simd, WithSimd};

/// Columns of a panel.
const PANEL: usize = 8;

/// Solves a system in row-major order in place; the solution replaces the right-hand side.
pub(crate) fn solve_in_place(arch: Arch, matrix: &mut [f64], right: &mut [f64]) {
    let rows = right.len();
    for first in (0..rows).step_by(PANEL) {
        let panel = first..rows.min(first + PANEL);
        for column in panel.clone() {
            let pivot = pivot_row(matrix, rows, column);
            swap_rows(matrix, rows, column, pivot);
            right.swap(column, pivot);
            eliminate(matrix, rows, column, panel.end);
        }
        for row in first + 1..panel.end {
            take_from(matrix, rows, row, first, panel.end);
        }
        if panel.end < rows {
            arch.dispatch(TakePanel { matrix: &mut *matrix, rows, first });
        }
    }
    substitute(matrix, right);
}

/// The row with the greatest entry of a column, of those from the diagonal on.
fn pivot_row(matrix: &[f64], rows: usize, column: usize) -> usize {
    let size = |row: usize| matrix[row * rows + column].abs();
    (column + 1..rows).fold(column, |best, row| if size(row) > size(best) { row } else { best })
}

fn swap_rows(matrix: &mut [f64], rows: usize, one: usize, other: usize) {
    if one != other {
        let (above, below) = matrix.split_at_mut(other * rows);
        above[one * rows..(one + 1) * rows].swap_with_slice(&mut below[..rows]);
    }
}

/// Eliminates a column from the rows below, within the panel that ends at `end`; the factors replace the column.
fn eliminate(matrix: &mut [f64], rows: usize, column: usize, end: usize) {
    let (above, below) = matrix.split_at_mut((column + 1) * rows);
    let lead = &above[column * rows..];
    for row in below.chunks_exact_mut(rows) {
        let factor = row[column] / lead[column];
        row[column] = factor;
        let others = row[column + 1..end].iter_mut().zip(&lead[column + 1..end]);
        others.for_each(|(value, lead)| *value -= factor * lead);
    }
}

/// Subtracts the rows of a panel above from one of its own rows, right of the panel.
fn take_from(matrix: &mut [f64], rows: usize, row: usize, first: usize, end: usize) {
    let (above, below) = matrix.split_at_mut(row * rows);
    let (factors, values) = below[..rows].split_at_mut(end);
    for lead in first..row {
        let (factor, lead) = (factors[lead], &above[lead * rows + end..(lead + 1) * rows]);
        values.iter_mut().zip(lead).for_each(|(value, lead)| *value -= factor * lead);
    }
}

/// Subtracts the rows of a whole panel from all rows below it, right of the panel.
struct TakePanel<'a> {
    matrix: &'a mut [f64],
    rows: usize,
    first: usize,
}

impl WithSimd for TakePanel<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { matrix, rows, first } = self;
        let end = first + PANEL;
        let (above, below) = matrix.split_at_mut(end * rows);
        let lead: [&[f64]; PANEL] =
            core::array::from_fn(|row| &above[(first + row) * rows + end..][..rows - end]);
        for row in below.chunks_exact_mut(rows) {
            let (factors, values) = row.split_at_mut(end);
            let factors: [f64; PANEL] = core::array::from_fn(|column| factors[first + column]);
            for (place, value) in values.iter_mut().enumerate() {
                let mut left = *value;
                for (factor, lead) in factors.iter().zip(&lead) {
                    left -= factor * lead[place];
                }
                *value = left;
            }
        }
    }
}

/// Solves for a right-hand side whose rows have been swapped as the matrix's were.
fn substitute(matrix: &[f64], right: &mut [f64]) {
    let rows = right.len();
    let of = |row: usize| &matrix[row * rows..(row + 1) * rows];
    for row in 0..rows {
        let known: f64 =
            of(row)[..row].iter().zip(&*right).map(|(factor, value)| factor * value).sum();
        right[row] -= known;
    }
    for row in (0..rows).rev() {
        let known: f64 = of(row)[row + 1..]
            .iter()
            .zip(&right[row + 1..])
            .map(|(factor, value)| factor * value)
            .sum();
        right[row] = (right[row] - known) / of(row)[row];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_system_that_needs_pivots_is_solved() {
        let matrix = [0.0, 2.0, -1.0, 1e-9, 1.0, 3.0, 4.0, -2.0, 0.5];
        check(&matrix, &[1.5, -2.0, 0.25], 1e-12);
    }

    /// Sizes about that of a panel and of several, entries of unlike size, not symmetric; whatever the processor.
    #[test]
    fn systems_of_any_size_are_solved() {
        for rows in [1, 2, 7, 8, 9, 16, 31, 120] {
            let mut seed = rows as u64;
            let mut random = || {
                seed = seed
                    .wrapping_mul(6_364_136_223_846_793_005)
                    .wrapping_add(1_442_695_040_888_963_407);
                (seed >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
            };
            let wanted: Vec<f64> = (0..rows).map(|_| random()).collect();
            let matrix: Vec<f64> = (0..rows * rows)
                .map(|place| random() * if place % 7 == 0 { 1e3 } else { 1.0 })
                .collect();
            check(&matrix, &wanted, 1e-8);
        }
    }

    fn check(matrix: &[f64], wanted: &[f64], most: f64) {
        let right: Vec<f64> = matrix
            .chunks_exact(wanted.len())
            .map(|row| row.iter().zip(wanted).map(|(a, x)| a * x).sum())
            .collect();
        let solved = |arch: Arch| {
            let mut solution = right.clone();
            solve_in_place(arch, &mut matrix.to_vec(), &mut solution);
            solution
        };
        let solution = solved(Arch::new());
        assert!(
            solution.iter().zip(wanted).all(|(got, wanted)| (got - wanted).abs() < most),
            "{} rows: {solution:?} against {wanted:?}",
            wanted.len()
        );
        let plain = solved(Arch::Scalar);
        assert_eq!(solution, plain, "the same bits in lanes of any width");
    }
}
