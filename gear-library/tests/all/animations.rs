//! Acts as glTF animations: the angles that are read equal those of the keys for any local axes of the bones; problems of files.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

use std::f64::consts::FRAC_PI_2;
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use endline_gear::{ActItem, Library, Sources};
use endline_sdk::Posture;
use endline_sim::whale::acts::{Clip, Moves};
use endline_sim::whale::pose::angle_of;
use endline_sim::whale::{Angle, Bone, Skin};
use glam::DQuat;
use serde_json::{Value, json};

const ACT: &str = "format = 1\nkind = \"act\"\nname = \"Wave\"\nsource = \"test\"\nconfidence = \"estimate\"\nfade = \"1 s\"\nanimation = \"wave.gltf\"\n";

fn sources() -> Sources {
    Sources::from_folder(Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap()
}

fn skin() -> Skin {
    Library::read(&sources())
        .0
        .whales
        .into_iter()
        .find(|whale| whale.entry.id == "right-whale")
        .unwrap()
        .skin_at(13.7)
}

/// Postures of a made-up act: bends about every axis at once, flippers, flukes, jaw and lips.
fn keys() -> Vec<(f64, Posture)> {
    let at = |time_s: f64| {
        let swing = libm::sin(1.3 * time_s);
        let mut posture = Posture {
            fluke_pitch: 0.4 * swing,
            flipper_sweep: [0.3 * swing, -0.2],
            jaw: 0.2 * time_s,
            ..Posture::default()
        };
        posture.flipper_raise = [-0.5 * swing, 0.3];
        posture.flipper_twist = [0.2, -0.4 * swing];
        posture.lips = [0.1 * time_s, 0.3];
        for joint in 0..8 {
            posture.spine_pitch[joint] = 0.05 * swing * joint as f64;
            posture.spine_yaw[joint] = 0.1 - 0.04 * time_s;
            posture.spine_roll[joint] = 0.03 * swing;
        }
        (time_s, posture)
    };
    [0.0, 0.5, 1.25, 2.0].map(at).to_vec()
}

/// The rotation of a bone, as in `pose`.
fn turn(bone: &Bone, posture: &Posture) -> DQuat {
    bone.turns.iter().fold(DQuat::IDENTITY, |before, (channel, axis)| {
        DQuat::from_axis_angle(*axis, channel.share * angle_of(posture, channel.angle)) * before
    })
}

/// A file of bones with the local rotation `lie`, and keys of those postures.
fn file(bones: &[Bone], lie: DQuat, keys: &[(f64, Posture)]) -> Value {
    let (mut data, mut views, mut accessors) = (Vec::new(), Vec::new(), Vec::new());
    let mut store = |numbers: Vec<f64>, kind: &str, count: usize| {
        let start = data.len();
        #[expect(clippy::cast_possible_truncation, reason = "glTF keeps single precision")]
        data.extend(numbers.iter().flat_map(|number| (*number as f32).to_le_bytes()));
        views.push(json!({ "buffer": 0, "byteOffset": start, "byteLength": data.len() - start }));
        accessors.push(json!({ "bufferView": views.len() - 1, "componentType": 5126, "count": count, "type": kind }));
        accessors.len() - 1
    };
    let input = store(keys.iter().map(|key| key.0).collect(), "SCALAR", keys.len());
    let (mut channels, mut samplers) = (Vec::new(), Vec::new());
    for (index, bone) in bones.iter().enumerate().skip(1) {
        let turns = keys
            .iter()
            .flat_map(|(_, posture)| (lie.conjugate() * turn(bone, posture) * lie).to_array())
            .collect();
        let output = store(turns, "VEC4", keys.len());
        samplers.push(json!({ "input": input, "output": output }));
        channels.push(json!({ "sampler": samplers.len() - 1, "target": { "node": index, "path": "rotation" } }));
    }
    let mut nodes: Vec<Value> = bones.iter().map(|bone| json!({ "name": bone.name })).collect();
    nodes[0]["rotation"] = json!(lie.to_array());
    for (parent, node) in nodes.iter_mut().enumerate() {
        let children: Vec<usize> =
            (0..bones.len()).filter(|child| bones[*child].parent == Some(parent)).collect();
        if !children.is_empty() {
            node["children"] = json!(children);
        }
    }
    nodes.push(json!({ "name": "whale", "children": [0], "rotation": DQuat::from_rotation_x(-FRAC_PI_2).to_array() }));
    let uri = format!("data:application/octet-stream;base64,{}", STANDARD.encode(&data));
    json!({
        "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [bones.len()] }], "nodes": nodes,
        "buffers": [{ "byteLength": data.len(), "uri": uri }], "bufferViews": views, "accessors": accessors,
        "animations": [{ "name": "Wave", "channels": channels, "samplers": samplers }],
    })
}

/// The act `wave` of a library with this file, or its problems.
fn read(act: &str, file: &Value) -> Result<ActItem, String> {
    let mut sources = sources();
    sources.set("acts/wave.toml", act);
    sources.set_mesh("acts/wave.gltf", file.to_string().into_bytes());
    let (library, problems) = Library::read(&sources);
    let reported: Vec<String> = problems.iter().map(ToString::to_string).collect();
    library.acts.into_iter().find(|act| act.entry.id == "wave").ok_or(reported.join("\n"))
}

fn clip(act: &ActItem) -> &Clip {
    &act.clips[0]
}

#[test]
fn bones_keyed_in_a_file_move_the_angles_they_were_keyed_to() {
    let (bones, keys) = (skin().bones, keys());
    for lie in [DQuat::IDENTITY, DQuat::from_scaled_axis(glam::DVec3::new(0.4, -1.1, 2.0))] {
        let act =
            read(ACT, &file(&bones, lie, &keys)).unwrap_or_else(|reported| panic!("{reported}"));
        assert!((clip(&act).length_s - 2.0).abs() < 1e-12);
        for (time_s, asked) in &keys {
            let shown = clip(&act).posture(*time_s, false, &Posture::default());
            for angle in Angle::all() {
                let off = (angle_of(&shown, angle) - angle_of(asked, angle)).abs();
                assert!(off < 1e-5, "{angle:?} at {time_s} s is {off} rad off");
            }
        }
        assert!(
            act.angles
                .iter()
                .any(|(angle, figure)| *angle == Angle::Jaw && (figure.value - 0.4).abs() < 1e-5)
        );
        assert!(act.files().any(|file| file == "acts/wave.gltf"), "a recording carries it");
        assert!(
            clip(&act).tracks.iter().all(
                |track| matches!(track.moves, Moves::Angle(angle) if angle != Angle::FlukeFlex(0))
            ),
            "what lies still is left out"
        );
    }
}

#[test]
fn problems_of_an_animation_have_a_place_and_a_correction() {
    let (bones, keys) = (skin().bones, keys());
    let good = file(&bones, DQuat::IDENTITY, &keys);
    let reported =
        |act: &str, file: &Value| read(act, file).err().unwrap_or_else(|| panic!("it is taken"));
    for (from, to, parts) in [
        (
            "wave.gltf",
            "wav.gltf",
            ["there is no file `acts/wav.gltf`", "did you mean `acts/wave.gltf`?"],
        ),
        ("wave.gltf", "wave.fbx", ["`wave.fbx` is not the name of a glTF file", ".glb or .gltf"]),
        ("fade", "clip = \"Wav\"\nfade", ["has no animation `Wav`", "did you mean `Wave`?"]),
        (
            "fade",
            "after = \"repeat\"\nfade",
            ["has different values at the start and the end", "the pose of the first"],
        ),
        (
            "animation",
            "key = [{ at = \"0 s\", jaw = \"1 deg\" }]\nanimation",
            ["both `animation` and [[key]]", "remove one of them"],
        ),
    ] {
        let message = reported(&ACT.replacen(from, to, 1), &good);
        assert!(
            parts.iter().all(|part| message.contains(part)) && message.contains("acts/wave.toml:"),
            "{to}: {message}"
        );
    }
    let jaw = bones.iter().position(|bone| bone.name == "jaw").unwrap();
    let mut twisted = good.clone();
    let spine = bones.iter().position(|bone| bone.name == "spine_3").unwrap();
    for channel in twisted["animations"][0]["channels"].as_array_mut().unwrap() {
        if channel["target"]["node"] == json!(spine) {
            channel["target"]["node"] = json!(jaw);
        }
    }
    let message = reported(ACT, &twisted);
    assert!(
        message.contains("rotates `jaw`")
            && message.contains("axis that the bone does not have")
            && message.contains("lock"),
        "{message}"
    );
    let mut strange = good.clone();
    strange["nodes"]
        .as_array_mut()
        .unwrap()
        .iter_mut()
        .for_each(|node| node["name"] = json!("bone"));
    assert!(reported(ACT, &strange).contains("rotates no bone of the whale"));
    let mut two = good.clone();
    let again = two["animations"][0].clone();
    two["animations"].as_array_mut().unwrap().push(again);
    assert!(
        reported(ACT, &two).contains("has 2 animations")
            && reported(ACT, &json!({ "asset": { "version": "2.0" } }))
                .contains("has no animation")
    );
}
