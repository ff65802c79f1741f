//! Faces of skin that a place on rope touches at once.
//!
//! Rope in a crease, where skin is concave, is pressed by both walls. Were it pressed by the nearer alone, the push would jump from
//! wall to wall where they are equally near, which is just where rope comes to rest: no balance is there to be found, and rope is
//! driven into the fold until it is crushed. Seen from a place at distances `d ≤ d'` along normals `n`, `n'` from two triangles,
//! the closest point of the second lies `d - d' n·n'` above the plane of the first: nothing where both are one flat or one convex face,
//! `d (1 - n·n')` at most, where skin is concave between them. The second pushes by a share that grows with that height and with the
//! angle of the normals, so that nothing jumps as rope slides into a crease or out of it.

use super::barrier::BarrierForce;
use super::touch::Touch;

/// Most faces touched at once.
const MOST_FACES: usize = 3;
/// Most other triangles looked at.
const MOST_LOOKED_AT: usize = 8;
/// Cosine of the angle of two normals above which they are of one face, and below which they are of two.
const ALIKE: (f64, f64) = (0.95, 0.7);
/// Height of a closest point over the plane of the other face up to which it does not count, and from which it counts wholly, as a share of
/// the greatest. The feet on two facets of one convex face are at nothing but for rounding.
const RISEN: (f64, f64) = (0.05, 0.3);

/// What a place on rope touches, in rising order of the pair, so that a face keeps its place in the row as another comes nearer.
pub(crate) type Faces = [Option<Touch>; MOST_FACES];

/// The faces touched: the nearest triangle's, and those of others that rise from it.
pub(crate) fn faces(nearest: Touch, others: impl Iterator<Item = Touch>) -> Faces {
    let mut risen = [None; MOST_LOOKED_AT];
    let mut count = 0;
    for other in others {
        if count < MOST_LOOKED_AT && share(&nearest, &other) > 0.0 {
            risen[count] = Some(other);
            count += 1;
        }
    }
    let mut faces = Faces::default();
    faces[0] = Some(nearest);
    let mut whole = faces;
    for face in 1..MOST_FACES {
        let beside = |other: &Touch| {
            whole.iter().flatten().map(|touch| share(touch, other)).product::<f64>()
        };
        let rising = risen[..count].iter().flatten().filter(|other| beside(other) > 0.0);
        let Some(next) =
            rising.min_by(|one, other| one.distance.total_cmp(&other.distance)).copied()
        else {
            break;
        };
        let part = beside(&next);
        let BarrierForce { energy, force, stiffness } = next.barrier;
        let barrier = BarrierForce {
            energy: energy * part,
            force: force * part,
            stiffness: stiffness * part,
        };
        (whole[face], faces[face]) = (Some(next), Some(Touch { barrier, ..next }));
    }
    if count > 0 {
        faces.sort_unstable_by_key(|touch| touch.map_or(usize::MAX, |touch| touch.pair));
    }
    faces
}

/// Share of its push that a face has beside a nearer one, 0 where both are one.
fn share(nearer: &Touch, other: &Touch) -> f64 {
    let alike = nearer.normal.dot(other.normal);
    if alike >= ALIKE.0 {
        return 0.0;
    }
    let risen = (nearer.distance - other.distance * alike)
        / (nearer.distance * (1.0 - alike)).max(f64::MIN_POSITIVE);
    ((ALIKE.0 - alike) / (ALIKE.0 - ALIKE.1)).min(1.0)
        * ((risen - RISEN.0) / (RISEN.1 - RISEN.0)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    const REACH_M: f64 = 0.005;

    /// A place's touch on the nearest point of a wall.
    fn touch(pair: usize, place: DVec3, foot: DVec3) -> Touch {
        let distance = place.distance(foot);
        let barrier = BarrierForce::new(distance, REACH_M, 1e4);
        Touch {
            pair,
            barycentric: [1.0, 0.0, 0.0],
            place,
            normal: (place - foot) / distance,
            distance,
            barrier,
        }
    }

    /// Force of the faces touched, between the walls z = 0 and x = 0 of a square corner.
    fn force_in_corner(place: DVec3) -> DVec3 {
        let (floor, wall) =
            (touch(7, place, place.with_z(0.0)), touch(3, place, place.with_x(0.0)));
        let (near, far) = if place.z < place.x { (floor, wall) } else { (wall, floor) };
        faces(near, std::iter::once(far))
            .iter()
            .flatten()
            .map(|touch| touch.normal * touch.barrier.force)
            .sum()
    }

    #[test]
    fn a_square_corner_pushes_from_both_walls_and_jumps_nowhere() {
        let place = |angle: f64| DVec3::new(libm::cos(angle), 0.0, libm::sin(angle)) * 0.003;
        let even = force_in_corner(place(core::f64::consts::FRAC_PI_4));
        let alone = BarrierForce::new(0.003 * core::f64::consts::FRAC_1_SQRT_2, REACH_M, 1e4).force;
        assert!((even - DVec3::new(alone, 0.0, alone)).length() < 1e-9 * alone, "{even}");
        let mut before = force_in_corner(place(0.635));
        for step in 1..=1000 {
            let now = force_in_corner(place(0.635 + 3e-4 * f64::from(step)));
            assert!(
                now.distance(before) < 0.01 * alone,
                "jumps by {} of {alone} N",
                now.distance(before)
            );
            before = now;
        }
    }

    /// Above one of two facets of a convex edge, level or turned by 15 or 60 degrees, the other has its foot on the edge between them.
    #[test]
    fn convex_skin_is_one_face() {
        for share in [0.01, 0.1, 0.5, 0.9] {
            let place = DVec3::new(0.004 * share, 0.0, 0.003);
            let faces = faces(
                touch(7, place, place.with_z(0.0)),
                std::iter::once(touch(3, place, DVec3::ZERO)),
            );
            assert!(
                faces[0].is_some_and(|touch| touch.pair == 7)
                    && faces[1..].iter().all(Option::is_none),
                "{share}"
            );
        }
    }
}
