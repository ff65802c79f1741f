"""Checks a whale's glTF file with readers that share no code with Endline; see README.md beside this file."""

import json
import shutil
import subprocess
import sys

import numpy as np
from pygltflib import GLTF2, BufferFormat

COMPONENTS = {5121: np.uint8, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
COLUMNS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
REGIONS = {
    "rostrum", "baleen", "lips", "head", "body", "peduncle",
    *(f"{side}_{part}" for side in ("left", "right") for part in (
        "flipper", "flipper_leading", "flipper_trailing", "flipper_tip", "fluke", "fluke_leading", "fluke_trailing")),
}
FAULTS = []


def check(holds, what):
    print("ok   " if holds else "FAULT", what)
    if not holds:
        FAULTS.append(what)


def numbers(file, index):
    accessor = file.accessors[index]
    view = file.bufferViews[accessor.bufferView]
    kind, columns = COMPONENTS[accessor.componentType], COLUMNS[accessor.type]
    start = (view.byteOffset or 0) + (accessor.byteOffset or 0)
    count = accessor.count * columns
    assert start + count * np.dtype(kind).itemsize <= (view.byteOffset or 0) + view.byteLength, f"accessor {index} reaches past its view"
    return np.frombuffer(file.binary, kind, count, start).reshape(accessor.count, columns)


def rotation(x, y, z, w):
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), 0],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), 0],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), 0],
        [0, 0, 0, 1]])


def about(axis, angle):
    return rotation(*(np.array(axis) * np.sin(angle / 2)), np.cos(angle / 2))


def worlds(file, posture):
    """Transform of each node, with bones turned by a posture {(angle, joint or side): radians}."""
    def walk(node, parent, out):
        own = file.nodes[node]
        local = np.eye(4)
        local[:3, 3] = own.translation or [0, 0, 0]
        local = local @ rotation(*(own.rotation or [0, 0, 0, 1]))
        turned = np.eye(4)
        for turn in (own.extras or {}).get("turns", []):
            turned = about(turn["axis"], turn["share"] * posture.get((turn["angle"], turn["of"]), 0.0)) @ turned
        out[node] = parent @ local @ turned
        for child in own.children or []:
            walk(child, out[node], out)
    out = {}
    for root in file.scenes[file.scene].nodes:
        walk(root, np.eye(4), out)
    return out


def skinned(file, places, joints, weights, posture):
    skin = file.skins[0]
    inverse = numbers(file, skin.inverseBindMatrices).astype(float).reshape(-1, 4, 4).transpose(0, 2, 1)
    world = worlds(file, posture)
    moves = np.array([world[joint] for joint in skin.joints]) @ inverse
    homogeneous = np.hstack([places, np.ones((len(places), 1))])
    return np.einsum("vs,vsij,vj->vi", weights, moves[joints], homogeneous)[:, :3]


def bone_checks(file):
    skin = file.skins[0]
    names = [file.nodes[joint].name for joint in skin.joints]
    check(len(file.skins) == 1 and len(names) == len(set(names)) >= 25, f"one skin with {len(names)} bones, each with its own name")
    check(names[0] == "control", "the first bone is the control bone")
    inverse = numbers(file, skin.inverseBindMatrices).astype(float).reshape(-1, 4, 4).transpose(0, 2, 1)
    rest = worlds(file, {})
    off = max(np.abs(rest[joint] @ undo - np.eye(4)).max() for joint, undo in zip(skin.joints, inverse))
    check(off < 1e-5, f"inverse bind matrices undo the rest transforms within {off:.1e}")
    ranged = [turn for joint in skin.joints for turn in (file.nodes[joint].extras or {}).get("turns", [])]
    check(ranged and all(turn["least_deg"] <= 0 <= turn["most_deg"] for turn in ranged), f"{len(ranged)} channels with their ranges")


def mesh_checks(file):
    primitives = file.meshes[0].primitives
    first = primitives[0].attributes
    places = numbers(file, first.POSITION).astype(float)
    joints, weights = numbers(file, first.JOINTS_0), numbers(file, first.WEIGHTS_0).astype(float)
    bounds = file.accessors[first.POSITION]
    check(np.allclose(places.min(0), bounds.min) and np.allclose(places.max(0), bounds.max), "bounds of the places are as written")
    normals = numbers(file, first.NORMAL).astype(float)
    check(np.abs(np.linalg.norm(normals, axis=1) - 1).max() < 1e-5, "normals have length 1")
    check(weights.min() >= 0 and np.abs(weights.sum(1) - 1).max() < 1e-6, "weights sum to 1 over at most four bones")
    check(joints.max() < len(file.skins[0].joints) and not joints[weights == 0].any(), "joints are in the skin, unused ones 0")
    regions = [file.materials[primitive.material].name for primitive in primitives]
    check(len(set(regions)) == len(regions) and set(regions) <= REGIONS, f"{len(regions)} materials, each named by its region")
    triangles = np.vstack([numbers(file, primitive.indices).reshape(-1, 3) for primitive in primitives])
    edges = {}
    for a, b, c in triangles:
        for edge in ((a, b), (b, c), (c, a)):
            edges[edge] = edges.get(edge, 0) + 1
    check(all(count == 1 and (b, a) in edges for (a, b), count in edges.items()), f"{len(triangles)} triangles close the skin")
    corners = places[triangles]
    volume = np.einsum("ti,ti->t", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6
    check(volume > 0, f"the skin faces outward, {volume:.2f} m3 inside")
    root = next(node.extras for node in file.nodes if node.extras and "endline" in node.extras)
    long = places[:, 0].max() - places[:, 0].min()
    check(0.95 < long / root["length_m"] < 1.15, f"{long:.2f} m from snout to fluke tips, {root['length_m']} m to the notch")
    return places, joints, weights


def pose_checks(file, places, joints, weights):
    rest = skinned(file, places, joints, weights, {})
    check(np.abs(rest - places).max() < 1e-4, "the rest pose is the mesh as it stands")
    chin, tail = places[:, 0].argmax(), places[:, 0].argmin()
    bent = skinned(file, places, joints, weights, {("spine_pitch", joint): 0.08 for joint in range(8)})
    check(bent[tail, 1] < rest[tail, 1] - 0.3 and bent[chin, 1] < rest[chin, 1], "a pitched spine takes head and tail down")
    swung = skinned(file, places, joints, weights, {("spine_yaw", joint): 0.08 for joint in range(8)})
    check(swung[tail, 2] > rest[tail, 2] + 0.3, "a yawed spine takes the tail to starboard")
    head = places[:, 0] > 0.7 * places[:, 0].max()
    drop = places[head, 1].min() - skinned(file, places, joints, weights, {("jaw", None): 0.4})[head, 1].min()
    check(drop > 0.012 * np.ptp(places[:, 0]), f"the jaw drops, by {drop:.2f} m")


KHRONOS = """
const fs = require('fs'), path = process.argv[1];
require('gltf-validator').validateBytes(new Uint8Array(fs.readFileSync(path))).then(r => console.log(JSON.stringify(r.issues)));
"""


def khronos(path):
    if not shutil.which("node"):
        return print("--    no node: the Khronos validator was not asked")
    output = subprocess.run(["node", "-e", KHRONOS, path], capture_output=True, text=True)
    if output.returncode:
        return print("--    no gltf-validator for node: the Khronos validator was not asked")
    issues = json.loads(output.stdout)
    found = [f"{one['code']} at {one['pointer']}: {one['message']}" for one in issues["messages"] if one["severity"] < 2][:5]
    check(not issues["numErrors"] and not issues["numWarnings"], f"the Khronos validator finds no error and no warning {found or ''}")


def main():
    file = GLTF2().load(sys.argv[1])
    file.convert_buffers(BufferFormat.BINARYBLOB)
    file.binary = file.binary_blob()
    bone_checks(file)
    pose_checks(file, *mesh_checks(file))
    khronos(sys.argv[1])
    sys.exit(1 if FAULTS else 0)


main()
