//! Components of the waves, four at once: what they are, and where each stands along a walk.

/// Components walked at once.
pub(super) const LANES: usize = 4;

/// Decay below which a component counts as this small: keeps `E` a normal number at any depth.
const DEEPEST: f64 = -60.0;

/// Four numbers, one for each lane.
pub(super) type Four = [f64; LANES];

/// Figures of four components.
#[derive(Clone, Debug, Default)]
pub(super) struct Figures {
    /// Wave number.
    pub number: Four,
    /// Amplitude.
    pub amplitude: Four,
    /// Frequency.
    pub frequency: Four,
    /// Phase at the origin at time zero.
    pub phase: Four,
    /// `e^{-2kd}`.
    pub bottom: Four,
    /// `1/(1 - e^{-2kd})`, zero for a lane that is not used.
    pub whole: Four,
}

/// Four components at one place.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Stand {
    pub cosine: Four,
    pub sine: Four,
    pub falling: Four,
    pub rising: Four,
}

/// Sums over components at a place: surface, velocity and acceleration along and up.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sums(pub [Four; 5]);

impl Figures {
    /// The four components at a place and time, from their functions.
    pub fn stand(&self, along: f64, height: f64, time_s: f64) -> Stand {
        let mut stand = Stand::default();
        for lane in 0..LANES {
            let number = self.number[lane];
            let (sine, cosine) =
                libm::sincos(number * along - self.frequency[lane] * time_s + self.phase[lane]);
            let decay = (number * height).max(DEEPEST);
            stand.cosine[lane] = cosine;
            stand.sine[lane] = sine;
            stand.falling[lane] = libm::exp(decay);
            stand.rising[lane] = self.bottom[lane] * libm::exp(-decay);
        }
        stand
    }
}

impl Stand {
    /// Moves on along the waves and from one height to another, by no more than the series reach.
    #[inline]
    pub fn advance(&mut self, figures: &Figures, by: f64, from: f64, to: f64) {
        for lane in 0..LANES {
            let number = figures.number[lane];
            let (cosine, sine) = circle(number * by);
            let turned = self.cosine[lane] * cosine - self.sine[lane] * sine;
            self.sine[lane] = self.sine[lane] * cosine + self.cosine[lane] * sine;
            self.cosine[lane] = turned;
            let (even, odd) = hyperbola((number * to).max(DEEPEST) - (number * from).max(DEEPEST));
            self.falling[lane] *= even + odd;
            self.rising[lane] *= even - odd;
        }
    }
}

/// Cosine and sine of a small angle.
#[inline]
fn circle(angle: f64) -> (f64, f64) {
    let square = -angle * angle;
    let (even, odd) = series(square);
    (even, odd * angle)
}

/// Hyperbolic cosine and sine of a small number.
#[inline]
fn hyperbola(number: f64) -> (f64, f64) {
    let (even, odd) = series(number * number);
    (even, odd * number)
}

/// `Σ qⁱ/(2i)!` and `Σ qⁱ/(2i+1)!`, to 1e-13 for `|q| < 1/4`.
#[inline]
fn series(square: f64) -> (f64, f64) {
    let even = 1.0
        + square / 2.0
            * (1.0
                + square / 12.0
                    * (1.0 + square / 30.0 * (1.0 + square / 56.0 * (1.0 + square / 90.0))));
    let odd =
        1.0 + square / 6.0 * (1.0 + square / 20.0 * (1.0 + square / 42.0 * (1.0 + square / 72.0)));
    (even, odd)
}

impl Sums {
    #[inline]
    pub fn add(&mut self, figures: &Figures, stand: &Stand) {
        let [surface, along, up, along_rate, up_rate] = &mut self.0;
        for lane in 0..LANES {
            let (amplitude, frequency) = (figures.amplitude[lane], figures.frequency[lane]);
            let speed = amplitude * frequency * figures.whole[lane];
            let level = speed * (stand.falling[lane] + stand.rising[lane]);
            let upright = speed * (stand.falling[lane] - stand.rising[lane]);
            surface[lane] += amplitude * stand.cosine[lane];
            along[lane] += level * stand.cosine[lane];
            up[lane] += upright * stand.sine[lane];
            along_rate[lane] += level * frequency * stand.sine[lane];
            up_rate[lane] -= upright * frequency * stand.cosine[lane];
        }
    }
}
