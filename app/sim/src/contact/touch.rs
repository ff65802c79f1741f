//! A point of rope that touches a face of skin.

use glam::DVec3;

use super::barrier::BarrierForce;

/// A contact point in touch with one face of skin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Touch {
    pub pair: usize,
    pub barycentric: [f64; 3],
    pub place: DVec3,
    pub normal: DVec3,
    pub distance: f64,
    pub barrier: BarrierForce,
}
