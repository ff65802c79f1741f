//! Pieces of a whale's skin about a place on an edge, and where they strike rope.

use endline_sdk::Region;
use endline_sim::DVec3;
use endline_sim::whale::{Bone, Skin};

/// Radius of the skin about the place on the edge that the piece includes [m].
const PIECE_M: f64 = 0.1;

/// Whether a region is the edge or tip of a flipper or fluke.
pub fn is_edge(region: Region) -> bool {
    ["leading", "trailing", "tip"].iter().any(|end| region.name().ends_with(end))
}

/// The triangles of a skin about a vertex, which becomes the origin; rigid, and closed where it was cut.
pub fn piece(whole: &Skin, about: u32) -> Skin {
    let middle = whole.vertices[about as usize];
    let near = |vertex: &u32| whole.vertices[*vertex as usize].distance(middle) < PIECE_M;
    let mut skin = Skin {
        bones: vec![Bone {
            name: "control".into(),
            parent: None,
            origin: DVec3::ZERO,
            turns: Vec::new(),
        }],
        ..Skin::default()
    };
    let mut renumbered = vec![None; whole.vertices.len()];
    for (corners, region) in
        whole.triangles.iter().zip(&whole.regions).filter(|(corners, _)| corners.iter().any(near))
    {
        let corners = corners.map(|vertex| {
            *renumbered[vertex as usize].get_or_insert_with(|| {
                skin.vertices.push(whole.vertices[vertex as usize] - middle);
                skin.weights.push([(0, 1.0), (0, 0.0), (0, 0.0), (0, 0.0)]);
                u32::try_from(skin.vertices.len() - 1).expect("few vertices")
            })
        });
        skin.triangles.push(corners);
        skin.regions.push(*region);
    }
    close(&mut skin);
    skin
}

/// Farthest vertex from the origin [m].
pub fn reach(skin: &Skin) -> f64 {
    skin.vertices.iter().map(|place| place.length()).fold(0.0, f64::max)
}

/// Closes every hole by a fan about the middle of its rim.
fn close(skin: &mut Skin) {
    let edges: Vec<[u32; 2]> =
        skin.triangles.iter().flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]).collect();
    let mut rims: Vec<[u32; 2]> =
        edges.iter().filter(|[a, b]| !edges.contains(&[*b, *a])).copied().collect();
    while let Some(first) = rims.pop() {
        let mut rim = vec![first];
        while let Some(next) = rims
            .iter()
            .position(|edge| rim.iter().any(|[a, b]| edge.contains(a) || edge.contains(b)))
        {
            rim.push(rims.swap_remove(next));
        }
        let middle =
            rim.iter().map(|[a, _]| skin.vertices[*a as usize]).sum::<DVec3>() / rim.len() as f64;
        let tip = u32::try_from(skin.vertices.len()).expect("few vertices");
        skin.vertices.push(middle);
        skin.weights.push([(0, 1.0), (0, 0.0), (0, 0.0), (0, 0.0)]);
        skin.triangles.extend(rim.iter().map(|[a, b]| [*b, *a, tip]));
        skin.regions.extend(rim.iter().map(|_| Region::Body));
    }
}

/// First strike of a moving piece on an infinite straight rope through the origin.
pub struct Strike {
    /// Path of the piece until then, negative if it has passed [m].
    pub way_m: f64,
    /// Smallest coordinate of any vertex along the rope at that time [m].
    pub least_along_m: f64,
    pub region: Region,
}

/// The first strike of a piece whose vertices `place` puts into the world, from afar; `ways` are the directions of the rope and of
/// the piece. Seen along the rope, it is the place of an edge of a triangle farthest ahead on the rope's line of sight.
pub fn strike(
    skin: &Skin,
    place: impl Fn(DVec3) -> DVec3,
    [along, forward]: [DVec3; 2],
) -> Option<Strike> {
    let ahead = forward - along * forward.dot(along);
    let aside = along.cross(ahead).normalize();
    let places: Vec<DVec3> = skin.vertices.iter().map(|vertex| place(*vertex)).collect();
    let mut first: Option<Strike> = None;
    for (corners, region) in skin.triangles.iter().zip(&skin.regions) {
        for (from, to) in [(0, 1), (1, 2), (2, 0)] {
            let [from, to] = [from, to].map(|corner| places[corners[corner] as usize]);
            let [low, high] = [from, to].map(|end| end.dot(aside));
            if low * high > 0.0 || low.total_cmp(&high).is_eq() {
                continue;
            }
            let met = from.lerp(to, low / (low - high));
            let way_m = -met.dot(ahead) / ahead.length_squared();
            if first.as_ref().is_none_or(|first| way_m < first.way_m) {
                first = Some(Strike { way_m, least_along_m: 0.0, region: *region });
            }
        }
    }
    let least_m = places.iter().map(|place| place.dot(along)).fold(f64::INFINITY, f64::min);
    first.map(|strike| Strike {
        least_along_m: least_m + strike.way_m * forward.dot(along),
        ..strike
    })
}
