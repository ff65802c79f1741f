use std::collections::BTreeMap;

use endline_sdk::{Posture, Region};
use endline_sim::whale::{Angle, Measures, pose, skin_all};
use glam::{DQuat, DVec3};

use super::*;

fn whale() -> Skin {
    build_skin(&WhaleForm::right_whale(13.7))
}

/// Every edge belongs to exactly two triangles that run along it in opposite directions.
#[test]
fn the_skin_is_closed() {
    let skin = whale();
    let mut edges = BTreeMap::new();
    for [a, b, c] in &skin.triangles {
        for edge in [(a, b), (b, c), (c, a)] {
            assert!(edges.insert(edge, ()).is_none(), "edge {edge:?} runs twice the same way");
        }
    }
    for &(from, to) in edges.keys() {
        assert!(edges.contains_key(&(to, from)), "edge {from} to {to} has one triangle");
    }
    assert!((13_000..15_000).contains(&skin.triangles.len()), "{} triangles", skin.triangles.len());
    // A single sphere without handles: vertices - edges + faces is 2 per closed piece.
    assert_eq!(skin.vertices.len() + skin.triangles.len() - edges.len() / 2, 2);
    assert_eq!(pieces(&skin), 1);
    assert_eq!(skin.regions.len(), skin.triangles.len());
}

/// Number of connected pieces.
fn pieces(skin: &Skin) -> usize {
    let mut heads: Vec<usize> = (0..skin.vertices.len()).collect();
    fn head(heads: &[usize], mut vertex: usize) -> usize {
        while heads[vertex] != vertex {
            vertex = heads[vertex];
        }
        vertex
    }
    for triangle in &skin.triangles {
        let [a, b, c] = triangle.map(|corner| head(&heads, corner as usize));
        let least = a.min(b).min(c);
        (heads[a], heads[b], heads[c]) = (least, least, least);
    }
    (0..heads.len()).filter(|&vertex| heads[vertex] == vertex).count()
}

#[test]
fn weights_are_shares_of_known_bones() {
    let skin = whale();
    assert_eq!(skin.weights.len(), skin.vertices.len());
    for weights in &skin.weights {
        assert!((weights.iter().map(|(_, weight)| weight).sum::<f64>() - 1.0).abs() < 1e-12);
        assert!(
            weights.iter().all(|&(bone, weight)| (0.0..=1.0).contains(&weight)
                && usize::from(bone) < skin.bones.len())
        );
    }
    for (index, bone) in skin.bones.iter().enumerate() {
        assert!(
            bone.parent.is_none_or(|parent| parent < index),
            "{} is before its parent",
            bone.name
        );
        assert!(bone.turns.iter().all(|(_, axis)| (axis.length() - 1.0).abs() < 1e-12));
    }
    assert!(skin.bones.len() >= 25 && skin.bones[0].parent.is_none());
}

#[test]
fn every_region_has_skin() {
    let skin = whale();
    for region in Region::ALL {
        assert!(skin.regions.contains(&region), "{region:?} has no triangle");
    }
}

#[test]
fn left_and_right_mirror_one_another() {
    let skin = whale();
    let key = |place: DVec3| (place * 1e6).round().as_i64vec3().to_array();
    let places: BTreeMap<_, usize> =
        skin.vertices.iter().enumerate().map(|(index, &place)| (key(place), index)).collect();
    for place in &skin.vertices {
        assert!(
            places.contains_key(&key(*place * DVec3::new(1.0, -1.0, 1.0))),
            "no mirror image of {place}"
        );
    }
}

/// A mirrored posture gives the mirrored whale.
#[test]
fn sides_move_as_mirror_images() {
    let skin = whale();
    let left = Posture {
        flipper_raise: [0.5, 0.0],
        flipper_sweep: [0.4, 0.0],
        flipper_twist: [0.3, 0.0],
        flipper_flex: [0.2, 0.0],
        fluke_flex: [0.2, 0.0],
        ..Posture::default()
    };
    let right = Posture {
        flipper_raise: [0.0, 0.5],
        flipper_sweep: [0.0, 0.4],
        flipper_twist: [0.0, 0.3],
        flipper_flex: [0.0, 0.2],
        fluke_flex: [0.0, 0.2],
        ..Posture::default()
    };
    let key = |place: DVec3| (place * 1e6).round().as_i64vec3().to_array();
    let mirrored: BTreeMap<_, ()> = posed(&skin, &right)
        .iter()
        .map(|place| (key(*place * DVec3::new(1.0, -1.0, 1.0)), ()))
        .collect();
    let missing =
        posed(&skin, &left).iter().filter(|place| !mirrored.contains_key(&key(**place))).count();
    assert_eq!(missing, 0);
}

fn posed(skin: &Skin, posture: &Posture) -> Vec<DVec3> {
    let (mut bones, mut places) = (Vec::new(), Vec::new());
    pose(skin, DVec3::ZERO, DQuat::IDENTITY, posture, &mut bones);
    skin_all(skin, &bones, &mut places);
    places
}

/// The skin moves in the directions that the posture documents.
#[test]
fn angles_have_the_documented_signs() {
    let skin = whale();
    let rest = posed(&skin, &Posture::default());
    let most = |value: fn(DVec3) -> f64| {
        (0..rest.len()).max_by(|&a, &b| value(rest[a]).total_cmp(&value(rest[b]))).unwrap()
    };
    let (snout, left_fluke) = (most(|p| p.x), most(|p| p.y - p.x));
    let flipper = (0..rest.len())
        .filter(|&v| rest[v].x > 0.0)
        .max_by(|&a, &b| rest[a].y.total_cmp(&rest[b].y))
        .unwrap();
    let tail = most(|p| -p.x - p.y.abs());
    let moved = |posture: &Posture, vertex: usize| posed(&skin, posture)[vertex] - rest[vertex];
    let all = |angle: f64| [angle; endline_sdk::SPINE_JOINTS];
    let bent = Posture { spine_pitch: all(0.1), ..Posture::default() };
    assert!(
        moved(&bent, tail).z < -0.5 && moved(&bent, snout).z < -0.2,
        "pitch bends the tail, and the head against it, down"
    );
    let swung = Posture { spine_yaw: all(0.1), ..Posture::default() };
    assert!(
        moved(&swung, tail).y < -0.5 && moved(&swung, snout).y < -0.2,
        "yaw swings the tail, and the head against it, to starboard"
    );
    assert!(moved(&Posture { fluke_pitch: 0.3, ..Posture::default() }, left_fluke).z < -0.1);
    assert!(moved(&Posture { fluke_flex: [0.3, 0.0], ..Posture::default() }, left_fluke).z > 0.1);
    assert!(moved(&Posture { flipper_raise: [0.3, 0.0], ..Posture::default() }, flipper).z > 0.3);
    assert!(moved(&Posture { flipper_flex: [0.3, 0.0], ..Posture::default() }, flipper).z > 0.1);
    let rolled = moved(&Posture { spine_roll: all(0.02), ..Posture::default() }, left_fluke);
    assert!(rolled.z > 0.1 && rolled.x.abs() < 0.05, "roll lifts the left fluke: {rolled}");
    assert!(moved(&Posture { flipper_sweep: [0.3, 0.0], ..Posture::default() }, flipper).x < -0.3);
    let open = posed(&skin, &Posture { jaw: 0.3, ..Posture::default() });
    let lowest = |places: &[DVec3]| {
        places.iter().filter(|p| p.x > 5.0).map(|p| p.z).fold(f64::INFINITY, f64::min)
    };
    assert!(lowest(&open) < lowest(&rest) - 0.3, "the jaw drops");
}

/// With a full posture and the mouth closed, adjacent vertices remain adjacent.
/// (An opening mouth stretches the strip between rostrum and lip, which represents the baleen.)
#[test]
fn skinning_is_continuous() {
    let skin = whale();
    let posture = Posture {
        spine_pitch: [0.12; endline_sdk::SPINE_JOINTS],
        spine_yaw: [-0.1; endline_sdk::SPINE_JOINTS],
        fluke_pitch: 0.5,
        fluke_flex: [0.3, -0.2],
        flipper_sweep: [0.8, -0.15],
        flipper_raise: [0.4, -0.6],
        flipper_twist: [0.5, -0.5],
        ..Posture::default()
    };
    let (rest, places) = (posed(&skin, &Posture::default()), posed(&skin, &posture));
    for triangle in &skin.triangles {
        for edge in 0..3 {
            let [a, b] = [triangle[edge] as usize, triangle[(edge + 1) % 3] as usize];
            let (before, after) = (rest[a].distance(rest[b]), places[a].distance(places[b]));
            assert!(
                after < 2.0 * before + 0.35,
                "an edge of {before} m is drawn out to {after} m near {}",
                rest[a]
            );
        }
    }
    // A millionth of a turn moves nothing by more than a millionth of the body.
    let mut nudged = posture;
    nudged.spine_yaw[4] += 1e-6;
    nudged.flipper_raise[0] += 1e-6;
    for (before, after) in places.iter().zip(posed(&skin, &nudged)) {
        assert!(before.distance(after) < 1.5e-5);
    }
}

/// Volume, centre of mass and inertia of the whole skin against parry's of the same triangles.
#[test]
fn mass_properties_agree_with_parry() {
    use parry3d::math::Vector;
    use parry3d::shape::{Shape, TriMesh};
    let skin = whale();
    let found = Measures::of(&skin, 1025.0);
    let own = found.volume_m3;
    let mesh = TriMesh::new(
        skin.vertices.iter().map(|v| Vector::new(v.x, v.y, v.z)).collect(),
        skin.triangles.clone(),
    )
    .unwrap();
    let properties = mesh.mass_properties(1025.0);
    assert!(
        (found.mass_kg / properties.mass() - 1.0).abs() < 1e-9,
        "{own} against {}",
        properties.mass()
    );
    let centre = properties.local_com;
    assert!(
        found.centre_m.distance(DVec3::new(centre.x, centre.y, centre.z)) < 1e-6,
        "{} against {centre:?}",
        found.centre_m
    );
    let inertia = properties.reconstruct_inertia_matrix();
    let largest = found.inertia_kg_m2.y_axis.y;
    for column in 0..3 {
        for row in 0..3 {
            let (own, parry) = (found.inertia_kg_m2.col(column)[row], inertia.col(column)[row]);
            assert!(
                (own - parry).abs() < 1e-6 * largest,
                "{own} against {parry} in row {row}, column {column}"
            );
        }
    }
    assert!(own > 30.0 && own < 45.0, "a 13.7 m right whale of 36 t: {own} m³");
}

/// Every angle of a posture moves a bone.
#[test]
fn every_angle_has_a_bone() {
    let skin = whale();
    let has = |angle: Angle| {
        skin.bones
            .iter()
            .flat_map(|bone| &bone.turns)
            .filter(|(channel, _)| channel.angle == angle)
            .map(|(channel, _)| channel.share)
            .sum::<f64>()
    };
    let mut angles = vec![Angle::FlukePitch, Angle::Jaw];
    angles.extend(
        (0..endline_sdk::SPINE_JOINTS).flat_map(|joint| Angle::SPINE.map(|axis| axis(joint))),
    );
    angles.extend((0..2).flat_map(|side| {
        [
            Angle::FlukeFlex,
            Angle::FlipperSweep,
            Angle::FlipperRaise,
            Angle::FlipperTwist,
            Angle::FlipperFlex,
        ]
        .map(|angle| angle(side))
    }));
    for angle in angles {
        assert!((has(angle) - 1.0).abs() < 1e-12, "{angle:?} is shared out as {}", has(angle));
    }
}

/// Files may contain any share from 0 to 1: unusual whales, but finite numbers.
#[test]
fn odd_forms_stay_finite() {
    let changes: [fn(&mut WhaleForm, f64); 16] = [
        |form, value| form.head.share = value,
        |form, value| form.head.mouth = value,
        |form, value| form.head.rostrum_width = value,
        |form, value| form.head.lip_arch = value,
        |form, value| form.flippers.span = value,
        |form, value| form.flippers.root_chord = value,
        |form, value| form.flippers.max_chord_at = value,
        |form, value| form.flippers.tip_chord = value,
        |form, value| form.flippers.thickness = value,
        |form, value| form.flippers.edge_radius_m = value,
        |form, value| form.flippers.insertion = value,
        |form, value| form.flukes.span = value,
        |form, value| form.flukes.root_chord = value,
        |form, value| form.flukes.thickness = value,
        |form, value| form.flukes.edge_radius_m = value,
        |form, value| form.spine_joints = std::array::from_fn(|joint| value + joint as f64 * 1e-9),
    ];
    for (index, change) in changes.iter().enumerate() {
        for value in [0.0, 1e-300, 1.0] {
            let mut form = WhaleForm::right_whale(13.7);
            change(&mut form, value);
            let skin = build_skin(&form);
            assert!(
                skin.vertices.iter().all(|place| place.is_finite()),
                "change {index} to {value}"
            );
            let sum =
                |weights: &bones::Weights| weights.iter().map(|(_, weight)| weight).sum::<f64>();
            assert!(
                skin.weights.iter().all(|weights| (sum(weights) - 1.0).abs() < 1e-9),
                "weights of change {index} to {value}"
            );
        }
    }
}

/// Caches more forms than there is room for, and requests the first one again at the end.
#[test]
fn a_cached_skin_equals_a_new_one() {
    let whale = WhaleForm::right_whale(12.0);
    let wide = |n: usize| WhaleForm { breadth_scale: 1.0 + 0.01 * n as f64, ..whale.clone() };
    for n in (0..SKINS + 2).chain([0, SKINS + 1]) {
        let (cached, built) = (skin_of(&wide(n)), build_skin(&wide(n)));
        assert!(*cached == built, "form {n}");
        let volume = Measures::of(&built, 1.0).volume_m3;
        assert_eq!(volume_of(&wide(n)).to_bits(), volume.to_bits());
    }
    assert!(Arc::ptr_eq(&skin_of(&wide(0)), &skin_of(&wide(0))));
}
