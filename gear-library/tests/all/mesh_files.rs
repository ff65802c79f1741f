//! Whales as glTF files: writing, reading, and all problems of files.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use endline_gear::whale::gltf::{About, Form, read, write};
use endline_gear::whale::scaled;
use endline_gear::{Library, Sources, WhaleItem};
use endline_sdk::Region;
use endline_sim::whale::{JointRanges, Skin, pose, skin_all};
use glam::{DMat4, DQuat, DVec3};
use serde_json::{Value, json};

const FILE: &str = "whales/right-whale.toml";

fn sources() -> Sources {
    Sources::from_folder(Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap()
}

fn whale() -> WhaleItem {
    Library::read(&sources())
        .0
        .whales
        .into_iter()
        .find(|whale| whale.entry.id == "right-whale")
        .unwrap()
}

fn skin() -> Skin {
    whale().skin_at(13.7)
}

fn written(skin: &Skin, form: Form) -> Vec<u8> {
    write(
        skin,
        &About {
            id: "right-whale",
            name: "Right whale",
            length_m: 13.7,
            joints: &whale().joints.ranges,
        },
        form,
    )
}

/// The text of a file as JSON, to be changed.
fn text(skin: &Skin) -> Value {
    serde_json::from_slice(&written(skin, Form::Text)).unwrap()
}

fn posed(skin: &Skin, ranges: &JointRanges, seed: u64) -> Vec<DVec3> {
    let (mut bones, mut places) = (Vec::new(), Vec::new());
    let orientation = DQuat::from_rotation_z(0.3) * DQuat::from_rotation_x(-0.2);
    pose(skin, DVec3::new(3.0, -4.0, -9.0), orientation, &ranges.random(seed), &mut bones);
    skin_all(skin, &bones, &mut places);
    places
}

/// The greatest distance between vertices of two skins of the same order over random postures [m].
fn apart(one: &Skin, other: &Skin) -> f64 {
    assert_eq!(one.vertices.len(), other.vertices.len());
    let ranges = whale().joints.ranges;
    let off = |seed| {
        posed(one, &ranges, seed)
            .iter()
            .zip(posed(other, &ranges, seed))
            .map(|(a, b)| a.distance(b))
            .fold(0.0, f64::max)
    };
    (0..20).map(off).fold(0.0, f64::max)
}

#[test]
fn a_round_trip_gives_the_same_pose() {
    let skin = skin();
    for form in [Form::Binary, Form::Text] {
        let back = read(&written(&skin, form), &skin).unwrap();
        let off = apart(&skin, &back);
        println!("{form:?}: vertices return within {off:.2e} m");
        // Single precision: 13.7 m times 2^-24, a few times over along the chain of bones.
        assert!(off < 1e-5, "{form:?}: {off} m");
        assert_eq!(back.marks, skin.marks);
        let names = |skin: &Skin| {
            skin.bones
                .iter()
                .map(|bone| (bone.name.clone(), bone.parent, bone.turns.clone()))
                .collect::<Vec<_>>()
        };
        assert_eq!(names(&back), names(&skin));
        assert_eq!(by_region(&back), by_region(&skin));
    }
}

/// Triangles of each region.
fn by_region(skin: &Skin) -> Vec<Vec<[u32; 3]>> {
    let of = |region| {
        skin.triangles
            .iter()
            .zip(&skin.regions)
            .filter(|(_, own)| **own == region)
            .map(|(own, _)| *own)
            .collect()
    };
    Region::ALL.into_iter().map(of).collect()
}

#[test]
fn the_same_skin_gives_the_same_bytes() {
    let skin = skin();
    assert_eq!(written(&skin, Form::Binary), written(&skin, Form::Binary));
    assert!(
        Form::of_file("whale.GLB") == Some(Form::Binary) && Form::of_file("whale.obj").is_none()
    );
}

/// As saved by Blender: each material has its own vertices, so that seams are split; names have numbers of copies; bones are
/// aligned with their length; an additional bone without vertices.
#[test]
fn a_file_as_blender_saves_it_gives_the_same_pose() {
    let skin = skin();
    let mut split = Skin { bones: skin.bones.clone(), ..Skin::default() };
    for region in Region::ALL {
        let mut own = vec![None; skin.vertices.len()];
        for (triangle, _) in
            skin.triangles.iter().zip(&skin.regions).filter(|(_, own)| **own == region)
        {
            let corners = triangle.map(|corner| {
                *own[corner as usize].get_or_insert_with(|| {
                    split.vertices.push(skin.vertices[corner as usize]);
                    split.weights.push(skin.weights[corner as usize]);
                    split.marks.push(skin.marks[corner as usize]);
                    u32::try_from(split.vertices.len() - 1).unwrap()
                })
            });
            split.triangles.push(corners);
            split.regions.push(region);
        }
    }
    assert!(split.vertices.len() > skin.vertices.len() + 500, "seams were to be split");
    let mut file = text(&split);
    turn_bones(&mut file, DQuat::from_scaled_axis(DVec3::new(0.4, -1.1, 2.0)));
    for material in file["materials"].as_array_mut().unwrap() {
        material["name"] = json!(format!("{}.001", material["name"].as_str().unwrap()));
    }
    let back = read(file.to_string().as_bytes(), &skin).unwrap();
    assert!(
        back.vertices.len() <= skin.vertices.len()
            && back.vertices.len() + 10 > skin.vertices.len(),
        "{} vertices",
        back.vertices.len()
    );
    assert_eq!(back.triangles.len(), skin.triangles.len());
    // The order differs, so each vertex is found by its rest place.
    let order: Vec<usize> = skin.vertices.iter().map(|place| nearest(&back, *place)).collect();
    let mut same = back.clone();
    (same.vertices, same.weights) =
        order.iter().map(|&index| (back.vertices[index], back.weights[index])).unzip();
    let off = apart(&skin, &same);
    assert!(off < 2e-5, "{off} m");
}

fn nearest(skin: &Skin, place: DVec3) -> usize {
    let near = |a: &usize, b: &usize| {
        skin.vertices[*a]
            .distance_squared(place)
            .total_cmp(&skin.vertices[*b].distance_squared(place))
    };
    (0..skin.vertices.len()).min_by(near).unwrap()
}

/// Rotates the axes of all bones in a file away from the whale's, and adds a bone without vertices.
fn turn_bones(file: &mut Value, turn: DQuat) {
    let uri = file["buffers"][0]["uri"].as_str().unwrap();
    let mut bytes = STANDARD.decode(uri.split_once(',').unwrap().1).unwrap();
    let matrices = file["skins"][0]["inverseBindMatrices"].as_u64().unwrap() as usize;
    let view = file["accessors"][matrices]["bufferView"].as_u64().unwrap() as usize;
    let start = file["bufferViews"][view]["byteOffset"].as_u64().unwrap() as usize;
    let joints: Vec<usize> = file["skins"][0]["joints"]
        .as_array()
        .unwrap()
        .iter()
        .map(|joint| joint.as_u64().unwrap() as usize)
        .collect();
    for (place, joint) in joints.iter().enumerate() {
        let node = &mut file["nodes"][*joint];
        if place == 0 {
            let lies: [f64; 4] = serde_json::from_value(node["rotation"].clone()).unwrap();
            node["rotation"] = json!((DQuat::from_array(lies) * turn).to_array());
        } else {
            let moved: [f64; 3] = serde_json::from_value(node["translation"].clone()).unwrap();
            node["translation"] = json!((turn.inverse() * DVec3::from_array(moved)).to_array());
        }
        let own = &mut bytes[start + 64 * place..start + 64 * (place + 1)];
        let old: [f64; 16] = std::array::from_fn(|number| {
            f64::from(f32::from_le_bytes(own[4 * number..4 * number + 4].try_into().unwrap()))
        });
        let new = DMat4::from_quat(turn.inverse()) * DMat4::from_cols_array(&old);
        let new: Vec<u8> =
            new.to_cols_array().iter().flat_map(|number| (*number as f32).to_le_bytes()).collect();
        own.copy_from_slice(&new);
    }
    file["buffers"][0]["uri"] =
        json!(format!("data:application/octet-stream;base64,{}", STANDARD.encode(&bytes)));
    file["nodes"].as_array_mut().unwrap().push(json!({ "name": "neutral_bone" }));
}

/// The problems of a file, each as message and help.
fn faults(bytes: &[u8], like: &Skin) -> String {
    let faults = read(bytes, like).err().unwrap_or_default();
    faults.iter().map(|fault| format!("{} | {}\n", fault.message, fault.help)).collect()
}

#[track_caller]
fn assert_problems(bytes: &[u8], wanted: &[&str]) {
    let faults = faults(bytes, &skin());
    assert!(wanted.iter().all(|part| faults.contains(part)), "wanted {wanted:?}, got {faults}");
}

/// A changed text of a file.
fn changed(change: impl Fn(&mut Value)) -> Vec<u8> {
    let mut file = text(&skin());
    change(&mut file);
    file.to_string().into_bytes()
}

#[test]
fn bones_and_regions_are_asked_for_by_name() {
    let renamed = |list: &'static str, from: &'static str, to: &'static str| {
        changed(move |file| {
            let named =
                file[list].as_array_mut().unwrap().iter_mut().find(|own| own["name"] == from);
            named.unwrap()["name"] = json!(to);
        })
    };
    assert_problems(
        &renamed("nodes", "jaw", "jaww"),
        &["has no bone `jaw`", "did you mean `jaww`"],
    );
    assert_problems(
        &renamed("materials", "lips", "lipps"),
        &["has a material `lipps`, which is not a region", "did you mean `lips`", "left_fluke_tr"],
    );
    let nameless = changed(|file| {
        file["meshes"][0]["primitives"][0].as_object_mut().unwrap().remove("material");
    });
    assert_problems(&nameless, &["without a material", "rostrum"]);
    let stranger = changed(|file| {
        let fluke = file["nodes"]
            .as_array()
            .unwrap()
            .iter()
            .position(|node| node["name"] == "left_fluke_tip")
            .unwrap();
        file["nodes"].as_array_mut().unwrap().push(json!({ "name": "left_fluke_tip" }));
        file["nodes"][fluke]["name"] = json!("tassel");
        let last = file["nodes"].as_array().unwrap().len() - 1;
        file["skins"][0]["joints"].as_array_mut().unwrap().push(json!(last));
        file["skins"][0].as_object_mut().unwrap().remove("inverseBindMatrices");
    });
    assert_problems(&stranger, &["vertices on the bone `tassel`"]);
}

#[test]
fn the_mesh_must_be_whole_and_of_the_whales_size() {
    let skin = skin();
    let file = |skin: &Skin| written(skin, Form::Binary);
    let mut open = skin.clone();
    open.triangles.pop();
    open.regions.pop();
    assert_problems(&file(&open), &["is not closed: 3 edges", "in the region `", "Fill Holes"]);
    assert_problems(&file(&scaled(&skin, 0.01)), &["is 0.1", "expected", "metres"]);
    let mut moved = skin.clone();
    moved.vertices.iter_mut().for_each(|place| place.y += 4.0);
    assert_problems(&file(&moved), &["is 4.00 m away from the whale's place"]);
    // Rolled on its side, its length is unchanged and its middle moves little.
    let mut rolled = skin.clone();
    rolled.vertices.iter_mut().for_each(|place| *place = DVec3::new(place.x, -place.z, place.y));
    assert_problems(&file(&rolled), &["is rotated: the region `", "is 4.26 m away", "the back up"]);
    let mut rolled = skin.clone();
    rolled.bones.iter_mut().for_each(|bone| bone.origin.y = -bone.origin.y);
    assert_problems(&file(&rolled), &["is rotated: the bone `", "is 4.46 m away", "the back up"]);
    let mut inward = skin.clone();
    inward.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
    assert_problems(&file(&inward), &["faces inward", "Recalculate Outside"]);
}

#[test]
fn weights_must_be_there_and_be_four_at_most() {
    let more = changed(|file| {
        for primitive in file["meshes"][0]["primitives"].as_array_mut().unwrap() {
            let own = primitive["attributes"].as_object_mut().unwrap();
            own.insert("JOINTS_1".into(), own["JOINTS_0"].clone());
            own.insert("WEIGHTS_1".into(), own["WEIGHTS_0"].clone());
        }
    });
    assert_problems(&more, &["vertices on more than four bones", "Limit Total"]);
    let none = changed(|file| {
        for primitive in file["meshes"][0]["primitives"].as_array_mut().unwrap() {
            primitive["attributes"].as_object_mut().unwrap().remove("WEIGHTS_0");
        }
    });
    assert_problems(&none, &["vertices without weights", "Skinning"]);
    let off = changed(|file| {
        for primitive in file["meshes"][0]["primitives"].as_array_mut().unwrap() {
            let own = primitive["attributes"].as_object_mut().unwrap();
            own.insert("WEIGHTS_0".into(), own["COLOR_0"].clone());
        }
    });
    assert_problems(&off, &["rows of 3 instead of 4 numbers"]);
    let unskinned = changed(|file| {
        file["nodes"][0].as_object_mut().unwrap().remove("skin");
    });
    assert_problems(
        &unskinned,
        &["has a mesh without a skin, `skin`", "parent the mesh to the armature"],
    );
    let elsewhere = changed(|file| file["buffers"][0]["uri"] = json!("whale.bin"));
    assert_problems(&elsewhere, &["has its data in another file, `whale.bin`", ".glb"]);
}

#[test]
fn problems_of_an_invalid_file_are_summarised() {
    let compressed = changed(|file| {
        file["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]);
        for accessor in file["accessors"].as_array_mut().unwrap() {
            accessor.as_object_mut().unwrap().remove("bufferView");
        }
    });
    assert_problems(
        &compressed,
        &["is compressed by KHR_draco_mesh_compression", "without Compression"],
    );
    let astray = changed(|file| {
        for node in file["nodes"].as_array_mut().unwrap() {
            node["children"] = json!([1_000]);
        }
    });
    let faults = faults(&astray, &skin());
    assert!(faults.contains("is not valid glTF 2.0") && faults.contains("and 26 more"), "{faults}");
    assert!(faults.len() < 500, "{faults}");
}

#[test]
fn a_file_alone_is_checked_with_its_mesh() {
    let folder = std::env::temp_dir().join(format!("endline-gear-mesh-{}", std::process::id()));
    let file = folder.join(FILE);
    std::fs::create_dir_all(folder.join("whales")).unwrap();
    let text = sources().get(FILE).unwrap().replacen("name =", "mesh = \"my.glb\"\nname =", 1);
    std::fs::write(&file, &text).unwrap();
    let reported = |bytes: Option<&[u8]>| {
        if let Some(bytes) = bytes {
            std::fs::write(folder.join("whales/my.glb"), bytes).unwrap();
        }
        let found = Library::check_file_with(FILE, &text, &Sources::beside(&file).0);
        found.iter().map(ToString::to_string).collect::<String>()
    };
    assert!(reported(None).contains("there is no file `whales/my.glb`"));
    assert_eq!(reported(Some(&written(&skin(), Form::Binary))), "");
    assert!(
        reported(Some(&written(&scaled(&skin(), 0.01), Form::Binary)))
            .contains("long from snout to fluke tips, expected")
    );
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn one_mesh_at_thousands_of_nodes_is_refused_before_it_is_read() {
    let many = changed(|file| {
        let nodes = file["nodes"].as_array_mut().unwrap();
        let mesh = nodes.iter().find(|node| node.get("mesh").is_some()).unwrap().clone();
        nodes.extend(std::iter::repeat_n(mesh, 3_000));
    });
    assert_problems(&many, &["more than 2000000 corners", "each mesh at one node"]);
}

/// Any bytes give a skin or a problem.
#[test]
fn damaged_files_are_faults() {
    let like = skin();
    let good = written(&like, Form::Binary);
    for end in (0..good.len()).step_by(good.len() / 15).chain(0..40) {
        assert!(read(&good[..end], &like).is_err(), "cut at {end}");
    }
    let text = u32::from_le_bytes(good[12..16].try_into().unwrap()) as usize;
    let mut dice = 1_u64;
    let mut roll = |below: usize| {
        dice = dice.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (dice >> 33) as usize % below
    };
    for _ in 0..60 {
        let mut bad = good.clone();
        for _ in 0..3 {
            let digits: Vec<usize> = (0..8).map(|_| 20 + roll(text)).collect();
            // Digits and names of the text: lengths, offsets and indices.
            let at =
                digits.into_iter().find(|at| bad[*at].is_ascii_digit()).unwrap_or(20 + roll(text));
            bad[at] = b'0' + (roll(10) as u8);
        }
        let _ = read(&bad, &like);
    }
}

/// A whale's file names its mesh, which replaces the one built from measures, at any length.
#[test]
fn a_whales_file_may_name_a_mesh() {
    let mut sources = sources();
    let own = sources.get(FILE).unwrap().to_owned();
    let reported = |sources: &Sources| {
        Library::read(sources)
            .1
            .into_iter()
            .filter(|problem| problem.file == FILE)
            .collect::<Vec<_>>()
    };
    sources.set(FILE, own.replacen("\nlength =", "\nmesh = \"mine.glb\"\nlength =", 1));
    sources.set_mesh("whales/mien.glb", Vec::new());
    let missing = reported(&sources);
    assert!(missing.iter().any(|one| one.line > 5
        && one.message == "there is no file `whales/mine.glb`"
        && one.help.contains("mien.glb")));
    sources.set_mesh("whales/mine.glb", b"nothing of the kind".to_vec());
    assert!(
        reported(&sources)
            .iter()
            .any(|one| one.line > 5 && one.message.contains("`whales/mine.glb` is not valid glTF"))
    );

    let mut mine = skin();
    mine.vertices.iter_mut().for_each(|place| place.z *= 1.05);
    sources.set_mesh("whales/mine.glb", written(&mine, Form::Binary));
    assert!(reported(&sources).is_empty(), "{:?}", reported(&sources));
    let whale = Library::read(&sources)
        .0
        .whales
        .into_iter()
        .find(|whale| whale.entry.id == "right-whale")
        .unwrap();
    assert!(apart(&whale.skin_at(13.7), &mine) < 1e-5);
    let small = whale.skin_at(6.85);
    assert!(
        small
            .vertices
            .iter()
            .zip(&mine.vertices)
            .all(|(half, whole)| half.distance(*whole / 2.0) < 1e-5)
    );

    sources.set(FILE, own.replacen("\nlength =", "\nmesh = \"../mine.obj\"\nlength =", 1));
    assert!(reported(&sources).iter().any(|one| {
        one.message.contains("not the name of a glTF file") && one.help.contains(".glb")
    }));
}
