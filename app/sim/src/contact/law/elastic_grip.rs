//! Friction of an elastic grip that slips at its limit.
//!
//! With `z*` the grip stretched by this step's move across the normal, `k` its stiffness and `N` the normal force:
//! `f = -k z*` while `k|z*| <= μN`, else `f = -μN z*/|z*|`; the grip stores `f/k`. It holds without creep.
//!
//! A slipping grip has no stiffness along its slip. Where light rope should hold, a solution with slip one way therefore moves it far the
//! other way, and iterations alternate between the two. If the friction at a trial opposes that of the solution that led there, the next
//! solution takes the grip as one that holds, `f = -k z*` at any force; a grip that must slip exceeds its limit in that solution.
//! The test of convergence always evaluates the law itself. Reference for such active sets of stick and slip: Alart and Curnier 1991
//! (doi:10.1016/0045-7825(91)90022-X).
//! Reference: Cundall and Strack 1979 (doi:10.1680/geot.1979.29.1.47).

use glam::{DMat3, DVec3};

use crate::matrix::{outer, plane_across};

/// A normal force is steady if those of the trial and of the last solution differ by less than this factor.
const STEADY_RATIO: f64 = 2.0;

/// A normal force and its derivative.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Push {
    /// Force [N].
    pub force: f64,
    /// Its growth with depth [N/m].
    pub rate: f64,
}

/// Friction of an elastic grip.
pub(crate) struct Grip {
    /// Force on the moving part [N].
    pub force: DVec3,
    /// `-d force / d place` [N/m].
    pub block: DMat3,
    /// Stretch of the grip that is stored for the next step [m].
    pub kept: DVec3,
    /// Whether it slips.
    pub slips: bool,
}

impl Grip {
    /// No friction at all.
    pub fn none() -> Self {
        Self { force: DVec3::ZERO, block: DMat3::ZERO, kept: DVec3::ZERO, slips: false }
    }

    /// Grip of stiffness `stiffness` stretched to `stretch` across `normal`, under the normal force `push`.
    pub fn new(stretch: DVec3, normal: DVec3, stiffness: f64, friction: f64, push: Push) -> Self {
        Self::in_plane(&plane_across(normal), stretch, normal, [stiffness, friction], push)
    }

    /// As [`Grip::new`], where the projection on the plane across the normal is known ([`plane_across`]).
    #[inline(always)]
    pub fn in_plane(
        plane: &DMat3,
        stretch: DVec3,
        normal: DVec3,
        [stiffness, friction]: [f64; 2],
        push: Push,
    ) -> Self {
        // Of ropes whose centre lines coincide the normal is undefined and shorter; such a trial is refused as overcompressed.
        let is_unit = normal.length_squared() < 1.0 + 1e-9;
        debug_assert!(is_unit || !normal.is_finite(), "a unit normal: {normal}");
        debug_assert!(stiffness > 0.0 && friction >= 0.0, "{stiffness} N/m, friction {friction}");
        let plane = *plane;
        let stretch = plane * stretch;
        let (length, limit) = (stretch.length(), friction * push.force);
        if stiffness * length <= limit || length <= 0.0 {
            return Self {
                force: stretch * -stiffness,
                block: plane * stiffness,
                kept: stretch,
                slips: false,
            };
        }
        let direction = stretch / length;
        let block = (plane - outer(direction, direction)) * (limit / length)
            - outer(direction, normal) * (friction * push.rate);
        Self {
            force: direction * -limit,
            block,
            kept: direction * (limit / stiffness),
            slips: true,
        }
    }

    /// Grip that holds at any force.
    pub fn held(stretch: DVec3, normal: DVec3, stiffness: f64) -> Self {
        let plane = plane_across(normal);
        let stretch = plane * stretch;
        Self { force: stretch * -stiffness, block: plane * stiffness, kept: stretch, slips: false }
    }

    /// Whether it slips at the trial and its friction opposes the friction of the last solution.
    ///
    /// `now_n` is the normal force at the trial, `solved` the force of the last solution on a contact with this normal. Never true where
    /// the two normal forces differ by more than [`STEADY_RATIO`], as they do when bodies collide or separate.
    pub fn is_reversed(&self, now_n: f64, solved: DVec3, normal: DVec3) -> bool {
        let solved_n = normal.dot(solved);
        let is_steady = solved_n < STEADY_RATIO * now_n && now_n < STEADY_RATIO * solved_n;
        self.slips && is_steady && self.force.dot(solved - normal * solved_n) < 0.0
    }

    /// The grip of statics, which has no corner where it begins to slip: `f = -k z / √(1 + (k|z|/μN)²)`.
    ///
    /// With a `trust` below one its block yields less along the slip than the force does; at zero it is the secant `k/√…`,
    /// with which passes never overshoot.
    pub fn smooth(stretch: DVec3, normal: DVec3, stiffness: f64, limit: f64, trust: f64) -> Self {
        let plane = plane_across(normal);
        let stretch = plane * stretch;
        if limit <= 0.0 {
            return Self { force: DVec3::ZERO, block: DMat3::ZERO, kept: DVec3::ZERO, slips: true };
        }
        let reach = stretch * (stiffness / limit);
        let less = 1.0 / libm::sqrt(1.0 + reach.length_squared());
        let block = (plane - outer(reach, reach) * (trust * less * less)) * (stiffness * less);
        let kept = stretch * less;
        Self { force: kept * -stiffness, block, kept, slips: reach.length_squared() > 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grip_holds_below_its_limit_and_slips_at_it() {
        let push = Push { force: 100.0, rate: 0.0 };
        let holds = Grip::new(DVec3::new(0.004, 0.0, 0.3), DVec3::Z, 1e4, 0.5, push);
        assert!(!holds.slips && (holds.force - DVec3::new(-40.0, 0.0, 0.0)).length() < 1e-12);
        let slips = Grip::new(DVec3::new(0.006, 0.0, 0.0), DVec3::Z, 1e4, 0.5, push);
        assert!(slips.slips && (slips.force - DVec3::new(-50.0, 0.0, 0.0)).length() < 1e-12);
        assert!((slips.kept.x - 0.005).abs() < 1e-15);
    }

    #[test]
    fn a_grip_that_slips_the_other_way_than_solved_is_reversed() {
        let push = Push { force: 100.0, rate: 0.0 };
        let slips = Grip::new(DVec3::new(0.006, 0.0, 0.0), DVec3::Z, 1e4, 0.5, push);
        let solved = |friction: f64| DVec3::new(friction, 0.0, 100.0);
        assert!(slips.is_reversed(100.0, solved(50.0), DVec3::Z));
        assert!(!slips.is_reversed(100.0, solved(-50.0), DVec3::Z), "the same way");
        assert!(!slips.is_reversed(100.0, DVec3::ZERO, DVec3::Z), "no solution yet");
        assert!(!slips.is_reversed(300.0, solved(50.0), DVec3::Z), "it collides");
        let holds = Grip::new(DVec3::new(0.004, 0.0, 0.0), DVec3::Z, 1e4, 0.5, push);
        assert!(!holds.is_reversed(100.0, solved(50.0), DVec3::Z), "it holds");
        let held = Grip::held(DVec3::new(0.006, 0.0, 0.3), DVec3::Z, 1e4);
        assert!((held.force - DVec3::new(-60.0, 0.0, 0.0)).length() < 1e-12);
    }
}
