//! Vectors and 3×3 matrices of [`Real`]s, as much of them as a rope needs.

use glam::{DMat3, DVec3};

use crate::simd::real::Real;

/// A vector.
#[derive(Clone, Copy)]
pub(crate) struct Vec3<R> {
    pub x: R,
    pub y: R,
    pub z: R,
}

impl From<DVec3> for Vec3<f64> {
    fn from(v: DVec3) -> Self {
        Self { x: v.x, y: v.y, z: v.z }
    }
}

impl From<Vec3<f64>> for DVec3 {
    fn from(v: Vec3<f64>) -> Self {
        Self::new(v.x, v.y, v.z)
    }
}

/// A symmetric matrix.
#[derive(Clone, Copy)]
pub(crate) struct Sym3<R> {
    pub xx: R,
    pub xy: R,
    pub xz: R,
    pub yy: R,
    pub yz: R,
    pub zz: R,
}

impl From<Sym3<f64>> for DMat3 {
    fn from(m: Sym3<f64>) -> Self {
        Self::from_cols(
            DVec3::new(m.xx, m.xy, m.xz),
            DVec3::new(m.xy, m.yy, m.yz),
            DVec3::new(m.xz, m.yz, m.zz),
        )
    }
}

/// A matrix by its columns.
#[derive(Clone, Copy)]
pub(crate) struct Mat3<R> {
    pub x: Vec3<R>,
    pub y: Vec3<R>,
    pub z: Vec3<R>,
}

#[allow(clippy::should_implement_trait, reason = "named methods keep the generic bounds short")]
impl<R: Real> Vec3<R> {
    #[inline(always)]
    pub fn add(self, o: Self) -> Self {
        Self { x: self.x + o.x, y: self.y + o.y, z: self.z + o.z }
    }
    #[inline(always)]
    pub fn sub(self, o: Self) -> Self {
        Self { x: self.x - o.x, y: self.y - o.y, z: self.z - o.z }
    }
    #[inline(always)]
    pub fn scale(self, s: R) -> Self {
        Self { x: self.x * s, y: self.y * s, z: self.z * s }
    }
    #[inline(always)]
    pub fn dot(self, o: Self) -> R {
        (self.x * o.x).plus(self.y, o.y).plus(self.z, o.z)
    }
    #[inline(always)]
    pub fn cross(self, o: Self) -> Self {
        Self {
            x: (self.y * o.z).less(self.z, o.y),
            y: (self.z * o.x).less(self.x, o.z),
            z: (self.x * o.y).less(self.y, o.x),
        }
    }
    /// `self + v s`.
    #[inline(always)]
    pub fn plus(self, v: Self, s: R) -> Self {
        Self { x: self.x.plus(v.x, s), y: self.y.plus(v.y, s), z: self.z.plus(v.z, s) }
    }
    /// `self - v s`.
    #[inline(always)]
    pub fn less(self, v: Self, s: R) -> Self {
        Self { x: self.x.less(v.x, s), y: self.y.less(v.y, s), z: self.z.less(v.z, s) }
    }
    /// `yes` where `of` is above zero, else `no`.
    #[inline(always)]
    pub fn choose(of: R, yes: Self, no: Self) -> Self {
        Self {
            x: of.positive(yes.x, no.x),
            y: of.positive(yes.y, no.y),
            z: of.positive(yes.z, no.z),
        }
    }
}

#[allow(clippy::should_implement_trait, reason = "named methods keep the generic bounds short")]
impl<R: Real> Sym3<R> {
    /// `s · 1`.
    #[inline(always)]
    pub fn diagonal(s: R) -> Self {
        let zero = s.splat(0.0);
        Self { xx: s, xy: zero, xz: zero, yy: s, yz: zero, zz: s }
    }
    /// `self + s v vᵀ`.
    #[inline(always)]
    pub fn plus_outer(self, v: Vec3<R>, s: R) -> Self {
        let w = v.scale(s);
        Self {
            xx: self.xx.plus(w.x, v.x),
            xy: self.xy.plus(w.x, v.y),
            xz: self.xz.plus(w.x, v.z),
            yy: self.yy.plus(w.y, v.y),
            yz: self.yz.plus(w.y, v.z),
            zz: self.zz.plus(w.z, v.z),
        }
    }
    /// `s · 1 + q v vᵀ`.
    #[inline(always)]
    pub fn round(s: R, v: Vec3<R>, q: R) -> Self {
        let w = v.scale(q);
        Self {
            xx: s.plus(w.x, v.x),
            xy: w.x * v.y,
            xz: w.x * v.z,
            yy: s.plus(w.y, v.y),
            yz: w.y * v.z,
            zz: s.plus(w.z, v.z),
        }
    }
    #[inline(always)]
    pub fn add(self, o: Self) -> Self {
        Self {
            xx: self.xx + o.xx,
            xy: self.xy + o.xy,
            xz: self.xz + o.xz,
            yy: self.yy + o.yy,
            yz: self.yz + o.yz,
            zz: self.zz + o.zz,
        }
    }
    #[inline(always)]
    pub fn sub(self, o: Self) -> Self {
        Self {
            xx: self.xx - o.xx,
            xy: self.xy - o.xy,
            xz: self.xz - o.xz,
            yy: self.yy - o.yy,
            yz: self.yz - o.yz,
            zz: self.zz - o.zz,
        }
    }
    #[inline(always)]
    pub fn apply(self, v: Vec3<R>) -> Vec3<R> {
        Vec3 {
            x: (self.xx * v.x).plus(self.xy, v.y).plus(self.xz, v.z),
            y: (self.xy * v.x).plus(self.yy, v.y).plus(self.yz, v.z),
            z: (self.xz * v.x).plus(self.yz, v.y).plus(self.zz, v.z),
        }
    }
    /// The product with a matrix.
    #[inline(always)]
    pub fn times(self, m: Mat3<R>) -> Mat3<R> {
        Mat3 { x: self.apply(m.x), y: self.apply(m.y), z: self.apply(m.z) }
    }
    /// The product with a symmetric matrix.
    #[inline(always)]
    pub fn times_sym(self, m: Self) -> Mat3<R> {
        self.times(m.matrix())
    }
    #[inline(always)]
    pub fn matrix(self) -> Mat3<R> {
        Mat3 {
            x: Vec3 { x: self.xx, y: self.xy, z: self.xz },
            y: Vec3 { x: self.xy, y: self.yy, z: self.yz },
            z: Vec3 { x: self.xz, y: self.yz, z: self.zz },
        }
    }
    /// The inverse, by cofactors.
    #[inline(always)]
    pub fn inverse(self) -> Self {
        let xx = (self.yy * self.zz).less(self.yz, self.yz);
        let xy = (self.xz * self.yz).less(self.xy, self.zz);
        let xz = (self.xy * self.yz).less(self.xz, self.yy);
        let over = self.xx.splat(1.0) / (self.xx * xx).plus(self.xy, xy).plus(self.xz, xz);
        Self {
            xx: xx * over,
            xy: xy * over,
            xz: xz * over,
            yy: (self.xx * self.zz).less(self.xz, self.xz) * over,
            yz: (self.xy * self.xz).less(self.xx, self.yz) * over,
            zz: (self.xx * self.yy).less(self.xy, self.xy) * over,
        }
    }
    /// `yes` where `of` is above zero, else `no`.
    #[inline(always)]
    pub fn choose(of: R, yes: Self, no: Self) -> Self {
        Self {
            xx: of.positive(yes.xx, no.xx),
            xy: of.positive(yes.xy, no.xy),
            xz: of.positive(yes.xz, no.xz),
            yy: of.positive(yes.yy, no.yy),
            yz: of.positive(yes.yz, no.yz),
            zz: of.positive(yes.zz, no.zz),
        }
    }
}

#[allow(clippy::should_implement_trait, reason = "named methods keep the generic bounds short")]
impl<R: Real> Mat3<R> {
    #[inline(always)]
    pub fn add(self, o: Self) -> Self {
        Self { x: self.x.add(o.x), y: self.y.add(o.y), z: self.z.add(o.z) }
    }
    #[inline(always)]
    pub fn sub(self, o: Self) -> Self {
        Self { x: self.x.sub(o.x), y: self.y.sub(o.y), z: self.z.sub(o.z) }
    }
    #[inline(always)]
    pub fn apply(self, v: Vec3<R>) -> Vec3<R> {
        self.x.scale(v.x).plus(self.y, v.y).plus(self.z, v.z)
    }
    #[inline(always)]
    pub fn times(self, m: Self) -> Self {
        Self { x: self.apply(m.x), y: self.apply(m.y), z: self.apply(m.z) }
    }
    #[inline(always)]
    pub fn transposed(self) -> Self {
        let (x, y, z) = (self.x, self.y, self.z);
        Self {
            x: Vec3 { x: x.x, y: y.x, z: z.x },
            y: Vec3 { x: x.y, y: y.y, z: z.y },
            z: Vec3 { x: x.z, y: y.z, z: z.z },
        }
    }
    /// The inverse, by cofactors.
    #[inline(always)]
    pub fn inverse(self) -> Self {
        let (one, two, three) = (self.y.cross(self.z), self.z.cross(self.x), self.x.cross(self.y));
        let over = self.x.x.splat(1.0) / self.x.dot(one);
        Self { x: one.scale(over), y: two.scale(over), z: three.scale(over) }.transposed()
    }
    /// `Mᵀ v`.
    #[inline(always)]
    pub fn apply_transposed(self, v: Vec3<R>) -> Vec3<R> {
        Vec3 { x: self.x.dot(v), y: self.y.dot(v), z: self.z.dot(v) }
    }
    /// `S - Mᵀ N`, where the product is symmetric.
    #[inline(always)]
    pub fn taken_from(self, n: Self, s: Sym3<R>) -> Sym3<R> {
        let entry = |start: R, one: Vec3<R>, other: Vec3<R>| {
            start.less(one.x, other.x).less(one.y, other.y).less(one.z, other.z)
        };
        Sym3 {
            xx: entry(s.xx, self.x, n.x),
            xy: entry(s.xy, self.x, n.y),
            xz: entry(s.xz, self.x, n.z),
            yy: entry(s.yy, self.y, n.y),
            yz: entry(s.yz, self.y, n.z),
            zz: entry(s.zz, self.z, n.z),
        }
    }
    /// `yes` where `of` is above zero, else `no`.
    #[inline(always)]
    pub fn choose(of: R, yes: Self, no: Self) -> Self {
        Self {
            x: Vec3::choose(of, yes.x, no.x),
            y: Vec3::choose(of, yes.y, no.y),
            z: Vec3::choose(of, yes.z, no.z),
        }
    }
}
