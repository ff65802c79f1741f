//! Sparse matrix of 3×3 blocks and its direct solution: `A δ = r`.
//!
//! `A = L U` by blocks, without pivoting: mass and stiffness keep the diagonal blocks regular. The unknowns are eliminated in an
//! order of least degree, so that few blocks are added (the fill). Order, fill and the places that each elimination changes
//! are found once for a pattern; they depend on the pattern alone.
//! Reference: George and Liu 1981, Computer Solution of Large Sparse Positive Definite Systems, chapter 5.

use glam::{DMat3, DVec3};
use pulp::{Arch, Simd, WithSimd};

/// Bits of a word of a row's set of columns.
const WORD: usize = 64;

/// Pattern, order and values.
#[derive(Clone, Debug, Default)]
pub(crate) struct BlockSparse {
    arch: Arch,
    blocks: usize,
    /// Words of the set of columns of a row.
    words: usize,
    /// Columns of each row with the fill, as bits.
    columns: Vec<u64>,
    /// Place in `value` of the block at (row, column), row after row; any number where there is none.
    places: Vec<u32>,
    /// Unknowns in the order of elimination, with their diagonal blocks.
    order: Vec<Pivot>,
    /// Of each unknown in `order`: the later unknowns that its row couples to.
    later: Vec<Later>,
    /// Places that the elimination of each unknown changes: for each row of `later` all its columns.
    changed: Vec<u32>,
    /// Scratch of the order: unknowns that are left, as bits, and the number of them that each row couples to.
    left: Vec<u64>,
    degree: Vec<u32>,
    value: Vec<DMat3>,
}

/// Where the value of a block is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place(u32);

/// An unknown in the order of elimination.
#[derive(Clone, Copy, Debug)]
struct Pivot {
    block: u32,
    /// Place of its diagonal block.
    diagonal: u32,
    /// End of its entries in `later`; they begin where those of the unknown before end.
    end: u32,
}

/// A later unknown that the row of an eliminated one couples to.
#[derive(Clone, Copy, Debug)]
struct Later {
    block: u32,
    /// Place of the block in the row of the eliminated unknown.
    upper: u32,
    /// Place of the block in its column.
    lower: u32,
}

impl BlockSparse {
    /// Lays out the matrix for `blocks` unknowns coupled in these pairs; its values become zero.
    pub fn lay_out(&mut self, blocks: usize, pairs: impl Iterator<Item = (usize, usize)>) {
        (self.blocks, self.words) = (blocks, blocks.div_ceil(WORD));
        refill(&mut self.columns, blocks * self.words, 0);
        for block in 0..blocks {
            self.couple(block, block);
        }
        for (one, other) in pairs {
            debug_assert!(one < blocks && other < blocks, "({one}, {other}) of {blocks} unknowns");
            self.couple(one, other);
            self.couple(other, one);
        }
        self.find_order();
        self.number_places();
    }

    /// Number of unknowns.
    pub fn unknowns(&self) -> usize {
        self.blocks
    }

    /// Pairs of unknowns whose blocks the layout holds.
    pub fn pairs(&self) -> impl Iterator<Item = (usize, usize)> {
        (0..self.blocks).flat_map(move |row| {
            let words = &self.columns[row * self.words..(row + 1) * self.words];
            let columns = words.iter().enumerate().flat_map(|(word, bits)| bits_of(*bits, word));
            columns.map(move |column| (row, column as usize))
        })
    }

    fn couple(&mut self, row: usize, column: usize) {
        self.columns[row * self.words + column / WORD] |= 1 << (column % WORD);
    }

    /// Finds the order of elimination, greedily by least degree, and adds the fill to the pattern.
    fn find_order(&mut self) {
        let (blocks, words) = (self.blocks, self.words);
        refill(&mut self.left, words, 0);
        (0..blocks).for_each(|block| self.left[block / WORD] |= 1 << (block % WORD));
        self.degree.clear();
        let rows = self.columns.chunks_exact(words.max(1));
        self.degree.extend(rows.map(|row| row.iter().map(|word| word.count_ones()).sum::<u32>()));
        self.order.clear();
        self.later.clear();
        for _ in 0..blocks {
            let is_left = |block: &usize| self.left[block / WORD] >> (block % WORD) & 1 == 1;
            let next = (0..blocks).filter(is_left).min_by_key(|block| self.degree[*block]);
            let Some(next) = next else { break };
            self.left[next / WORD] &= !(1 << (next % WORD));
            let begin = self.later.len();
            for word in 0..words {
                let bits = self.columns[next * words + word] & self.left[word];
                let unnumbered = |block| Later { block, upper: 0, lower: 0 };
                self.later.extend(bits_of(bits, word).map(unnumbered));
            }
            for Later { block: row, .. } in &self.later[begin..] {
                let row = *row as usize;
                let mut degree = 0;
                for word in 0..words {
                    let added = self.columns[next * words + word] & self.left[word];
                    let columns = &mut self.columns[row * words + word];
                    *columns |= added;
                    degree += (*columns & self.left[word]).count_ones();
                }
                self.degree[row] = degree;
            }
            let end = self.later.len() as u32;
            self.order.push(Pivot { block: next as u32, diagonal: 0, end });
        }
    }

    /// Numbers the places of all blocks, and lists those that each elimination changes.
    fn number_places(&mut self) {
        let (blocks, words) = (self.blocks, self.words);
        self.places.resize(blocks * blocks, 0);
        let mut count = 0;
        for row in 0..blocks {
            for word in 0..words {
                for column in bits_of(self.columns[row * words + word], word) {
                    self.places[row * blocks + column as usize] = count;
                    count += 1;
                }
            }
        }
        refill(&mut self.value, count as usize, DMat3::ZERO);
        self.changed.clear();
        let mut begin = 0;
        for place in 0..self.order.len() {
            let Pivot { block, end, .. } = self.order[place];
            self.order[place].diagonal = self.place_of(block as usize, block as usize).0;
            for at in begin..end as usize {
                let other = self.later[at].block as usize;
                self.later[at].upper = self.place_of(block as usize, other).0;
                self.later[at].lower = self.place_of(other, block as usize).0;
                for column in begin..end as usize {
                    let column = self.later[column].block as usize;
                    self.changed.push(self.place_of(other, column).0);
                }
            }
            begin = end as usize;
        }
    }

    /// Whether the layout holds the block at (row, column).
    pub fn holds(&self, row: usize, column: usize) -> bool {
        self.columns[row * self.words + column / WORD] >> (column % WORD) & 1 == 1
    }

    /// Where the block at (row, column) is, which the layout must hold.
    pub fn place_of(&self, row: usize, column: usize) -> Place {
        debug_assert!(self.holds(row, column), "block ({row}, {column}) is not in the layout");
        Place(self.places[row * self.blocks + column])
    }

    /// The block at a place.
    pub fn at_place(&mut self, Place(place): Place) -> &mut DMat3 {
        &mut self.value[place as usize]
    }

    /// The block at (row, column), which the layout must hold.
    pub fn at(&mut self, row: usize, column: usize) -> &mut DMat3 {
        self.at_place(self.place_of(row, column))
    }

    /// The value of the block at (row, column), which the layout must hold.
    pub fn get(&self, row: usize, column: usize) -> DMat3 {
        let Place(place) = self.place_of(row, column);
        self.value[place as usize]
    }

    /// Empties the matrix.
    pub fn clear(&mut self) {
        self.value.fill(DMat3::ZERO);
    }

    /// Copies the values of a matrix of the same layout.
    pub fn copy_values(&mut self, from: &Self) {
        self.value.clone_from(&from.value);
    }

    /// Adds a smaller matrix; the layout must hold its blocks.
    pub fn add_all(&mut self, from: &Self) {
        for ((row, column), value) in from.pairs().zip(&from.value) {
            *self.at(row, column) += *value;
        }
    }

    /// Factors the matrix in place and solves for a force out of balance, which is replaced.
    pub fn solve(&mut self, force: &mut [DVec3], step: &mut [DVec3]) {
        self.arch.dispatch(Factor { matrix: self, force, step });
    }
}

/// The solution, compiled for the instructions that the processor has; its bits do not depend on them.
struct Factor<'a> {
    matrix: &'a mut BlockSparse,
    force: &'a mut [DVec3],
    step: &'a mut [DVec3],
}

impl WithSimd for Factor<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { matrix, force, step } = self;
        let (mut begin, mut changed) = (0, matrix.changed.iter());
        for Pivot { block, diagonal, end } in &matrix.order {
            let inverse = matrix.value[*diagonal as usize].inverse();
            matrix.value[*diagonal as usize] = inverse;
            let later = &matrix.later[begin..*end as usize];
            let eliminated = force[*block as usize];
            for row in later {
                let across = matrix.value[row.lower as usize] * inverse;
                for (column, place) in later.iter().zip(&mut changed) {
                    let taken = across * matrix.value[column.upper as usize];
                    matrix.value[*place as usize] -= taken;
                }
                force[row.block as usize] -= across * eliminated;
            }
            begin = *end as usize;
        }
        for place in (0..matrix.order.len()).rev() {
            let Pivot { block, diagonal, end } = matrix.order[place];
            let begin = place.checked_sub(1).map_or(0, |before| matrix.order[before].end as usize);
            let mut right = force[block as usize];
            for other in &matrix.later[begin..end as usize] {
                right -= matrix.value[other.upper as usize] * step[other.block as usize];
            }
            // The diagonal was replaced by its inverse.
            step[block as usize] = matrix.value[diagonal as usize] * right;
        }
    }
}

/// Numbers of the bits that are set in a word of a set.
fn bits_of(mut bits: u64, word: usize) -> impl Iterator<Item = u32> {
    std::iter::from_fn(move || {
        (bits != 0).then(|| {
            let bit = bits.trailing_zeros();
            bits &= bits - 1;
            (word * WORD) as u32 + bit
        })
    })
}

fn refill<T: Copy>(list: &mut Vec<T>, count: usize, value: T) {
    list.clear();
    list.resize(count, value);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::tests::random;

    /// Solves systems of random patterns, laid out one after the other in the same storage; checks the product with the matrix
    /// as it was.
    #[test]
    fn systems_of_any_pattern_are_solved() {
        let mut system = BlockSparse::default();
        for (blocks, couplings) in [(1, 0), (5, 5), (64, 100), (65, 40), (200, 500), (3, 3)] {
            let mut random = random(blocks as u64);
            let mut any = || ((random() + 0.5) * blocks as f64) as usize;
            let pairs: Vec<(usize, usize)> = (0..couplings).map(|_| (any(), any())).collect();
            system.lay_out(blocks, pairs.iter().copied());
            let mut entries = Vec::new();
            let mut block = |size: f64| {
                let mut column = || DVec3::new(random(), random(), random());
                DMat3::from_cols(column(), column(), column())
                    + DMat3::from_diagonal(DVec3::splat(size))
            };
            entries.extend((0..blocks).map(|row| (row, row, block(12.0))));
            for (one, other) in pairs {
                entries.extend([(one, other, block(0.0)), (other, one, block(0.0))]);
            }
            for (row, column, value) in &entries {
                *system.at(*row, *column) += *value;
            }
            let right: Vec<DVec3> =
                (0..blocks).map(|block| DVec3::new(1.0, block as f64, -2.0)).collect();
            let mut step = vec![DVec3::ZERO; blocks];
            system.solve(&mut right.clone(), &mut step);
            let mut product = vec![DVec3::ZERO; blocks];
            for (row, column, value) in &entries {
                product[*row] += *value * step[*column];
            }
            for (got, wanted) in product.iter().zip(&right) {
                assert!(got.distance(*wanted) < 1e-9, "{blocks} unknowns: {got} for {wanted}");
            }
        }
    }

    /// A chain has no fill: its ends, of least degree, go first.
    #[test]
    fn a_chain_has_no_fill() {
        let mut system = BlockSparse::default();
        system.lay_out(100, (0..99).map(|block| (block, block + 1)));
        assert_eq!(system.value.len(), 100 + 2 * 99);
    }
}
