//! Random numbers of a trial: splitmix64, the same on every machine.

pub(super) struct Random(pub u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// From `least` to `most`.
    pub fn between(&mut self, least: f64, most: f64) -> f64 {
        least + (most - least) * (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A whole number from `least` to `most`, both counted.
    pub fn whole(&mut self, least: u32, most: u32) -> f64 {
        self.between(f64::from(least), f64::from(most) + 1.0).floor().min(f64::from(most))
    }

    /// An index below `count`.
    pub fn below(&mut self, count: usize) -> usize {
        (self.next() % count.max(1) as u64) as usize
    }

    /// Between two powers of ten, evenly by order of magnitude.
    pub fn order(&mut self, least: f64, most: f64) -> f64 {
        libm::exp10(self.between(least, most))
    }

    pub fn vector(&mut self, size: f64) -> [f64; 3] {
        std::array::from_fn(|_| self.between(-size, size))
    }

    /// A unit vector.
    pub fn direction(&mut self) -> [f64; 3] {
        loop {
            if let Some(unit) = unit(self.vector(1.0)) {
                return unit;
            }
        }
    }

    /// A unit vector across a unit normal.
    pub fn tangent(&mut self, normal: [f64; 3]) -> [f64; 3] {
        loop {
            if let Some(unit) = unit(across(normal, self.direction())) {
                return unit;
            }
        }
    }
}

pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The part of a vector across a unit normal.
pub(super) fn across(normal: [f64; 3], vector: [f64; 3]) -> [f64; 3] {
    let along = dot(normal, vector);
    std::array::from_fn(|i| vector[i] - along * normal[i])
}

fn unit(vector: [f64; 3]) -> Option<[f64; 3]> {
    let length = dot(vector, vector).sqrt();
    (length > 0.1).then(|| vector.map(|part| part / length))
}
