//! Sorts lists whose first key is a small number: by buckets of that number, then within each bucket.

/// Scratch of sorts, kept so that a step allocates nothing.
#[derive(Clone, Debug)]
pub(crate) struct BucketSort<T> {
    /// Where each bucket begins.
    begins: Vec<usize>,
    sorted: Vec<T>,
}

impl<T> Default for BucketSort<T> {
    fn default() -> Self {
        Self { begins: Vec::new(), sorted: Vec::new() }
    }
}

impl<T: Copy> BucketSort<T> {
    /// Sorts a list by bucket, a small number, and within a bucket by `rank`.
    pub fn sort(
        &mut self,
        list: &mut Vec<T>,
        bucket: impl Fn(&T) -> usize,
        rank: impl Fn(&T) -> usize,
    ) {
        if list.is_empty() {
            return;
        }
        self.sort_by_bucket(list, bucket);
        // Each begin has become the end of its bucket.
        let mut begin = 0;
        for end in &self.begins {
            list[begin..*end].sort_unstable_by_key(&rank);
            begin = *end;
        }
    }

    /// As [`sort`](Self::sort), where ranks are small numbers too; buckets are below `buckets`, and ranks below `ranks`.
    pub fn sort_by_both(
        &mut self,
        list: &mut Vec<T>,
        (bucket, buckets): (impl Fn(&T) -> usize, usize),
        (rank, ranks): (impl Fn(&T) -> usize, usize),
    ) {
        let Some(first) = list.first() else { return };
        if ranks > MOST_RANKS * list.len() {
            return self.sort(list, bucket, rank);
        }
        if self.sorted.len() < list.len() {
            self.fill(list, *first);
        }
        self.begins.clear();
        self.begins.resize(buckets + ranks, 0);
        let (of_buckets, of_ranks) = self.begins.split_at_mut(buckets);
        for item in &*list {
            of_buckets[bucket(item)] += 1;
            of_ranks[rank(item)] += 1;
        }
        add_up(of_buckets);
        add_up(of_ranks);
        // By rank, and then by bucket, in which items keep their order.
        let sorted = &mut self.sorted[..list.len()];
        scatter(list, of_ranks, sorted, rank);
        scatter(sorted, of_buckets, list, bucket);
    }

    /// Gives the scratch the length of a list. Lists that are exchanged with it have the same capacity, so that none grows without need.
    fn fill(&mut self, list: &Vec<T>, item: T) {
        self.sorted.clear();
        self.sorted.reserve_exact(list.capacity());
        self.sorted.resize(list.len(), item);
    }

    /// Sorts a list by bucket alone; items of a bucket keep their order.
    pub fn sort_by_bucket(&mut self, list: &mut Vec<T>, bucket: impl Fn(&T) -> usize) {
        let Some(first) = list.first() else { return };
        let (low, high) = ends(list, &bucket);
        self.begins.clear();
        self.begins.resize(high - low + 1, 0);
        for item in &*list {
            self.begins[bucket(item) - low] += 1;
        }
        add_up(&mut self.begins);
        self.fill(list, *first);
        scatter(list, &mut self.begins, &mut self.sorted, |item| bucket(item) - low);
        std::mem::swap(list, &mut self.sorted);
    }
}

/// Ranks are counted as buckets are where there are at most this many for each item.
const MOST_RANKS: usize = 8;

/// Replaces each count by the sum of those before it.
fn add_up(counts: &mut [usize]) {
    let mut sum = 0;
    for count in counts {
        (*count, sum) = (sum, sum + *count);
    }
}

/// Copies items to where those of their number begin.
fn scatter<T: Copy>(from: &[T], begins: &mut [usize], to: &mut [T], number: impl Fn(&T) -> usize) {
    for item in from {
        let at = &mut begins[number(item)];
        to[*at] = *item;
        *at += 1;
    }
}

/// Least and greatest of the numbers of a list.
fn ends<T>(list: &[T], number: impl Fn(&T) -> usize) -> (usize, usize) {
    list.iter().map(number).fold((usize::MAX, 0), |(low, high), one| (low.min(one), high.max(one)))
}

#[cfg(test)]
mod tests {
    use super::BucketSort;

    #[test]
    fn lists_are_sorted_by_bucket_and_rank() {
        let mut sort = BucketSort::default();
        for count in [0, 1, 5, 300] {
            let mut list: Vec<[usize; 2]> =
                (0..count).map(|k| [k * 7919 % 11, k * 104_729 % 97]).collect();
            let mut wanted = list.clone();
            wanted.sort_unstable();
            let mut other = list.clone();
            sort.sort(&mut list, |item| item[0], |item| item[1]);
            assert_eq!(list, wanted);
            sort.sort_by_both(&mut other, (|item| item[0], 11), (|item| item[1], 97));
            assert_eq!(other, wanted);
        }
    }

    /// Lists of changing length, sorted in each way in turn: capacity was doubled each time.
    #[test]
    fn sorts_in_turn_keep_the_capacity() {
        let (mut sort, mut list) = (BucketSort::default(), Vec::new());
        for count in (1..2_000_usize).map(|k| 1 + k * 7919 % 150) {
            list.clear();
            list.extend((0..count).map(|k| [k % 11, k * 104_729 % 97]));
            match count % 3 {
                0 => sort.sort(&mut list, |item| item[0], |item| item[1]),
                1 => sort.sort_by_both(&mut list, (|item| item[0], 11), (|item| item[1], 97)),
                _ => sort.sort_by_bucket(&mut list, |item| item[0]),
            }
            assert!(list.capacity().max(sort.sorted.capacity()) <= 512, "after {count} items");
        }
    }
}
