//! Faces of skin that a place on rope touches at the same time.
//!
//! Rope in a crease, where skin is concave, is pressed by both walls. If only the nearer pressed, the force would jump from
//! wall to wall where they are equally near, which is where rope rests: there would be no balance, and rope would be
//! driven into the fold until it is overcompressed. From a place at distances `d ≤ d'` along normals `n`, `n'` from two triangles,
//! the closest point of the second is `d - d' n·n'` above the plane of the first: zero if both belong to one flat or convex face,
//! at most `d (1 - n·n')` if skin is concave between them. That height, scaled to `s` from 0 to 1, measures how far the second is a wall
//! of its own. Of the force that each would have alone, it has the share
//!
//! ```text
//! w_i = s_i / (1 + sum over j of max(0, n_i·n_j) min(s_i, s_j))        s = 1 for the nearest
//! ```
//!
//! so that nothing jumps as rope slides into a crease or out of it. Two walls at a right angle each press in full. Two facets of
//! a shallow fold together have the force of one: over the few micrometres in which `s` grows there, the force only turns.
//! The linear system contains the gradients of the shares of two faces. Without them, the force turns to and fro between two walls
//! from iteration to iteration.
//! A face is pressed by its share of the rope's length: normal force, friction and the energy stored by friction are in proportion to it.

use glam::DVec3;

use crate::contact::rope_on_skin::touch::Touch;

/// Most faces touched at once.
const MOST_FACES: usize = 3;
/// Largest number of other triangles.
const MOST_LOOKED_AT: usize = 8;
/// Cosine of the angle of two normals above which they are of one face (0.6°), and below which they are of two (1.1°).
/// Where a larger angle counted as one face, rope pressed into a fold with 12 kN met a push that turned by 0.2 rad from pass to pass.
const ALIKE: (f64, f64) = (0.99995, 0.9998);
/// Height of a closest point over the plane of the other face up to which it does not count, and from which it counts wholly, as a share of
/// the greatest: over as long a way as there is, for Newton's method does not see it coming.
/// The feet on two facets of one convex face are at nothing but for rounding.
const RISEN: (f64, f64) = (0.05, 1.0);

/// Keeps of the triangles touched from `first` on the faces touched, in rising order of the pair, so that a face keeps its place in the row as
/// another comes nearer: the nearest triangle, of the place given, and those that rise from it.
pub(crate) fn keep_faces(touches: &mut Vec<Touch>, first: usize, nearest: usize) {
    if touches.len() == first + 1 {
        return;
    }
    touches.swap(first, nearest);
    let nearest = touches[first];
    let mut risen = first + 1;
    for place in first + 1..touches.len() {
        if risen - first <= MOST_LOOKED_AT && own(&nearest, &touches[place]) > 0.0 {
            touches.swap(risen, place);
            risen += 1;
        }
    }
    touches.truncate(risen);
    let risen = &mut touches[first..];
    let mut faces = 1;
    while faces < MOST_FACES.min(risen.len()) {
        let (taken, left) = risen.split_at(faces);
        let beside = |other: &Touch| taken.iter().map(|touch| own(touch, other)).product::<f64>();
        let parts = left.iter().map(beside).enumerate().filter(|(_, part)| *part > 0.0);
        let Some((next, part)) = parts
            .min_by(|(one, _), (other, _)| left[*one].distance.total_cmp(&left[*other].distance))
        else {
            break;
        };
        risen.swap(faces, faces + next);
        risen[faces].share = part;
        faces += 1;
    }
    touches.truncate(first + faces);
    if faces > 1 {
        let gradient =
            if faces == 2 { own_gradient(&nearest, &touches[first + 1]) } else { DVec3::ZERO };
        share_out(&mut touches[first..], gradient);
        touches[first..].sort_unstable_by_key(|touch| touch.pair);
    }
}

/// Replaces how much each face is a wall of its own by its share of the push. Two faces also get the gradients of their shares;
/// `gradient` is that of how much the second is a wall of its own.
fn share_out(faces: &mut [Touch], gradient: DVec3) {
    if let [nearest, other] = faces {
        let alike = nearest.normal.dot(other.normal).max(0.0);
        let beside = 1.0 + alike * other.share;
        let slope = gradient / (beside * beside);
        (nearest.share_gradient, other.share_gradient) = (slope * -alike, slope);
    }
    let mut walls = [(DVec3::ZERO, 0.0); MOST_FACES];
    for (wall, face) in walls.iter_mut().zip(&*faces) {
        *wall = (face.normal, face.share);
    }
    for (place, face) in faces.iter_mut().enumerate() {
        let others = walls.iter().enumerate().filter(|(other, _)| *other != place);
        let beside: f64 = others
            .map(|(_, (normal, own))| face.normal.dot(*normal).max(0.0) * own.min(face.share))
            .sum();
        face.share /= 1.0 + beside;
    }
}

/// A face beside a nearer one.
struct Beside {
    /// Cosine of the angle of their normals.
    alike: f64,
    /// How far they are two by their normals, from 0 to 1.
    apart: f64,
    /// Greatest height of its closest point above the plane of the nearer one [m].
    room_m: f64,
    /// That height, as a share of the greatest.
    risen: f64,
}

impl Beside {
    /// `None` where the two are one face by their normals.
    fn of(nearer: &Touch, other: &Touch) -> Option<Self> {
        let alike = nearer.normal.dot(other.normal);
        if alike >= ALIKE.0 {
            return None;
        }
        let room_m = (nearer.distance * (1.0 - alike)).max(f64::MIN_POSITIVE);
        Some(Self {
            alike,
            apart: ((ALIKE.0 - alike) / (ALIKE.0 - ALIKE.1)).min(1.0),
            room_m,
            risen: (nearer.distance - other.distance * alike) / room_m,
        })
    }
}

/// How much a face is a wall of its own beside a nearer one, 0 where both are one.
fn own(nearer: &Touch, other: &Touch) -> f64 {
    Beside::of(nearer, other).map_or(0.0, |Beside { apart, risen, .. }| {
        apart * ((risen - RISEN.0) / (RISEN.1 - RISEN.0)).clamp(0.0, 1.0)
    })
}

/// Gradient of [`own`] [1/m].
fn own_gradient(nearer: &Touch, other: &Touch) -> DVec3 {
    let beside = Beside::of(nearer, other).filter(|beside| beside.risen > RISEN.0);
    beside.map_or(DVec3::ZERO, |Beside { alike, apart, room_m, risen }| {
        let by_place =
            (nearer.away - other.away * alike) / room_m - nearer.away * (risen / nearer.distance);
        by_place * (apart / (RISEN.1 - RISEN.0))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::law::barrier::BarrierForce;

    /// Contact distance [m] and stiffness [N/m].
    const LAW: (f64, f64) = (0.005, 1e4);

    /// A place's touch on the nearest point of a wall.
    fn touch(pair: usize, place: DVec3, foot: DVec3) -> Touch {
        let distance = place.distance(foot);
        Touch::new((pair, [1.0, 0.0, 0.0]), place, ((place - foot) / distance, distance))
    }

    /// Push of faces together.
    fn force_of(mut faces: Vec<Touch>) -> DVec3 {
        faces.iter_mut().for_each(|touch| touch.take_law(LAW));
        faces.iter().map(|touch| touch.normal * touch.barrier.force).sum()
    }

    /// Force of the faces touched, between the walls z = 0 and x = 0 of a square corner.
    fn force_in_corner(place: DVec3) -> DVec3 {
        let (floor, wall) =
            (touch(7, place, place.with_z(0.0)), touch(3, place, place.with_x(0.0)));
        let (near, far) = if place.z < place.x { (floor, wall) } else { (wall, floor) };
        let mut faces = vec![far, near];
        keep_faces(&mut faces, 0, 1);
        force_of(faces)
    }

    #[test]
    fn a_square_corner_pushes_from_both_walls_and_jumps_nowhere() {
        let place = |angle: f64| DVec3::new(libm::cos(angle), 0.0, libm::sin(angle)) * 0.003;
        let even = force_in_corner(place(core::f64::consts::FRAC_PI_4));
        let alone = BarrierForce::new(0.003 * core::f64::consts::FRAC_1_SQRT_2, LAW.0, LAW.1).force;
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

    /// Faces touched, over two walls that meet at the y axis and rise from each other by an angle.
    fn faces_over_crease(place: DVec3, angle: f64) -> Vec<Touch> {
        let rising = DVec3::new(libm::cos(angle), 0.0, libm::sin(angle));
        let level = touch(7, place, DVec3::X * place.x.min(0.0));
        let raised = touch(3, place, rising * rising.dot(place).max(0.0));
        let nearest = usize::from(raised.distance < level.distance);
        let mut faces = vec![level, raised];
        keep_faces(&mut faces, 0, nearest);
        faces
    }

    /// Force of these faces.
    fn force_over_crease(place: DVec3, angle: f64) -> DVec3 {
        force_of(faces_over_crease(place, angle))
    }

    /// Rope rests where two walls are equally near: if the force turned there at once, there would be no balance.
    #[test]
    fn the_push_turns_gradually_in_a_shallow_crease() {
        for degrees in [3.0_f64, 8.0, 17.0, 40.0] {
            let place = |x_m: f64| DVec3::new(x_m, 0.0, 0.003);
            let mut before = force_over_crease(place(-0.001), degrees.to_radians());
            for step in 1..=20_000 {
                let now =
                    force_over_crease(place(-0.001 + 1e-7 * f64::from(step)), degrees.to_radians());
                let jump = now.distance(before) / before.length();
                assert!(jump < 0.02, "{degrees} degrees: jumps by {jump} at step {step}");
                before = now;
            }
        }
    }

    /// Together the two facets have the force of the nearer alone: the law is no stiffer in a shallow fold than on flat skin.
    #[test]
    fn a_shallow_crease_pushes_as_one_wall() {
        for degrees in [2.0_f64, 5.0] {
            let angle = degrees.to_radians();
            for step in -200..=200 {
                let place = DVec3::new(1e-6 * f64::from(step), 0.0, 0.003);
                let raised = libm::cos(angle) * place.z - libm::sin(angle) * place.x;
                let alone = BarrierForce::new(raised.min(place.z), LAW.0, LAW.1).force;
                let together = force_over_crease(place, angle).length();
                assert!(
                    (together / alone - 1.0).abs() < 0.005,
                    "{degrees}, {step}: {together}, {alone}"
                );
            }
        }
    }

    #[test]
    fn gradients_of_two_shares_are_their_differences() {
        for (degrees, x_m) in [(40.0_f64, -1e-4), (40.0, -5e-4), (17.0, -1e-4), (60.0, -2e-3)] {
            let faces = |place| faces_over_crease(place, degrees.to_radians());
            let (place, step_m) = (DVec3::new(x_m, 0.0, 0.003), 1e-8);
            let here = faces(place);
            assert_eq!(here.len(), 2, "{degrees} degrees, {x_m} m");
            for (face, axis) in [(0, DVec3::X), (0, DVec3::Z), (1, DVec3::X), (1, DVec3::Z)] {
                let share = |sign: f64| faces(place + axis * sign * step_m)[face].share;
                let slope = (share(1.0) - share(-1.0)) / (2.0 * step_m);
                let gradient = here[face].share_gradient.dot(axis);
                assert!(
                    (slope - gradient).abs() < 1e-3 * slope.abs().max(1.0),
                    "{slope} {gradient}"
                );
            }
        }
    }

    /// Above one of two facets of a convex edge, level or turned by 15 or 60 degrees, the other has its foot on the edge between them.
    #[test]
    fn convex_skin_is_one_face() {
        for share in [0.01, 0.1, 0.5, 0.9] {
            let place = DVec3::new(0.004 * share, 0.0, 0.003);
            let flat = touch(7, place, place.with_z(0.0));
            let mut faces = vec![flat, touch(3, place, DVec3::ZERO)];
            keep_faces(&mut faces, 0, 0);
            assert!(faces.len() == 1 && faces[0].pair == 7, "{share}");
        }
    }
}
