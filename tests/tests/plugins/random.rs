//! Random numbers of tests: splitmix64, the same on every machine.

pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u64 {
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

    pub fn vector(&mut self, size: f64) -> [f64; 3] {
        std::array::from_fn(|_| self.between(-size, size))
    }

    /// A unit vector.
    pub fn direction(&mut self) -> [f64; 3] {
        loop {
            let v = self.vector(1.0);
            let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
            if length > 0.1 {
                return v.map(|c| c / length);
            }
        }
    }

    /// A unit vector across a unit normal.
    pub fn tangent(&mut self, normal: [f64; 3]) -> [f64; 3] {
        loop {
            let v = self.direction();
            let up = v.iter().zip(normal).map(|(v, n)| v * n).sum::<f64>();
            let v: [f64; 3] = std::array::from_fn(|i| v[i] - up * normal[i]);
            let length = v.iter().map(|c| c * c).sum::<f64>().sqrt();
            if length > 0.1 {
                return v.map(|c| c / length);
            }
        }
    }
}
