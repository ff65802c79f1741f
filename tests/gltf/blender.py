"""A whale from Endline to Blender and back; see README.md beside this file.

blender --background --python tests/gltf/blender.py -- endline gear-library FOLDER
python tests/gltf/blender.py -- endline gear-library FOLDER      # with the package bpy
"""

import json
import shutil
import struct
import subprocess
import sys
from math import radians
from pathlib import Path

import bpy
import numpy as np
from mathutils import Matrix, Vector

if not hasattr(np, "bool"):
    np.bool = bool  # Blender 3.4 of Debian asks numpy for a name that it has no longer

#: What is done in Blender and how it is exported; whether Endline should take it; how far vertices may move [m].
TRIPS = [
    ("nothing", [], {}, 1e-5),
    ("transforms applied", ["apply"], {}, 1e-5),
    ("a bump of 10 cm on the back", ["apply", "bump"], {}, 0.1),
    ("subdivided once", ["subdivide"], {}, 1e-5),
    ("seams merged by distance", ["merge"], {}, 1e-5),
    ("jaw posed, exported at rest", ["pose"], {}, 1e-5),
    ("modifiers applied", [], {"export_apply": True}, 1e-5),
    ("deforming bones only", [], {"export_def_bones": True}, 1e-5),
    ("+Y up off", [], {"export_yup": False}, "is rotated"),
    ("without skinning", [], {"export_skins": False}, "without a skin"),
    ("turned to its side", ["roll"], {}, "is rotated"),
    ("scaled by two", ["scale"], {}, "m long from snout"),
]
FAULTS = []


def check(holds, what):
    print("ok   " if holds else "FAULT", what)
    if not holds:
        FAULTS.append(what)


def imported(file):
    """The armature and the mesh of a whale in an empty file."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=str(file))
    armature = next(one for one in bpy.data.objects if one.type == "ARMATURE")
    mesh = next(one for one in bpy.data.objects if one.type == "MESH" and one.parent == armature)
    bpy.context.view_layer.update()
    return armature, mesh


def chosen(one):
    bpy.ops.object.select_all(action="DESELECT")
    one.select_set(True)
    bpy.context.view_layer.objects.active = one


def in_edit_mode(mesh, work):
    chosen(mesh)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    work()
    bpy.ops.object.mode_set(mode="OBJECT")


def edited(armature, mesh, edits):
    if "apply" in edits:
        for one in (armature, mesh):
            chosen(one)
            bpy.ops.object.transform_apply(location=True, rotation=True, scale=True)
    if "bump" in edits:
        for vertex in mesh.data.vertices:
            if vertex.co.z > 0:
                vertex.co.z += 0.1 * np.exp(-((vertex.co.x - 0.5) ** 2) / 0.5)
    if "subdivide" in edits:
        in_edit_mode(mesh, lambda: bpy.ops.mesh.subdivide(number_cuts=1))
    if "merge" in edits:
        in_edit_mode(mesh, lambda: bpy.ops.mesh.remove_doubles(threshold=1e-5))
    if "pose" in edits:
        armature.pose.bones["jaw"].rotation_quaternion = (0.985, 0.174, 0, 0)
    if "roll" in edits:
        armature.rotation_mode = "XYZ"
        armature.rotation_euler = (radians(90), 0, 0)
    if "scale" in edits:
        armature.scale = (2, 2, 2)


def lies_right(file):
    """As Blender has it without any act of the user: x to the snout, y to port, z to the back, no bone posed."""
    armature, mesh = imported(file)
    places = {bone.name: armature.matrix_world @ bone.head_local for bone in armature.data.bones}
    port, back = places["left_flipper_tip"], places["spine_1"]
    check(places["skull"].x > 0 > places["flukes"].x and port.y > 1 > 0 > port.z and back.z > 0, "bones lie as the whale lies")
    points = np.array([mesh.matrix_world @ vertex.co for vertex in mesh.data.vertices])
    check(np.ptp(points, axis=0).argmin() == 2, "the mesh lies as the whale lies")
    off = max(np.abs(np.array(bone.matrix_basis) - np.eye(4)).max() for bone in armature.pose.bones)
    check(off < 1e-4, f"no bone is posed (within {off:.0e})")


def act(file, out):
    """Keys angles of the whale about the axes that the file's extras name, and exports them as an animation."""
    armature, _ = imported(file)
    wanted = {("jaw", None): 20, ("spine_pitch", 6): 10, ("flipper_raise", 0): -30, ("fluke_pitch", None): 15}
    bpy.context.scene.render.fps = 24
    for frame, share in ((1, 0), (25, 1), (49, 0)):
        for bone in armature.pose.bones:
            turned = Matrix.Identity(3)
            for turn in bone["turns"]:
                angle = radians(share * turn["share"] * wanted.get((turn["angle"], turn["of"]), 0))
                turned = Matrix.Rotation(angle, 3, Vector(turn["axis"])) @ turned
            rest = bone.bone.matrix_local.to_3x3()
            bone.rotation_quaternion = (rest.inverted() @ turned @ rest).to_quaternion()
            bone.keyframe_insert("rotation_quaternion", frame=frame)
    bpy.ops.export_scene.gltf(filepath=str(out))


def vertices(file):
    """Vertices of a whale that Endline wrote: all its primitives share them."""
    data = Path(file).read_bytes()
    length = struct.unpack("<I", data[12:16])[0]
    document, binary = json.loads(data[20 : 20 + length]), data[28 + length :]
    accessor = document["accessors"][document["meshes"][0]["primitives"][0]["attributes"]["POSITION"]]
    view = document["bufferViews"][accessor["bufferView"]]
    start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    return np.frombuffer(binary, "f4", accessor["count"] * 3, start).reshape(-1, 3).astype(float)


def apart(one, other):
    """The greatest distance of a vertex of one from the nearest of the other [m]."""
    return max(np.sqrt(((other - vertex) ** 2).sum(1).min()) for vertex in one)


def with_mesh(library, folder, name):
    """A copy of a library whose right whale has the mesh of that name."""
    for part in library.iterdir():
        if part.is_dir() and part.name not in ("src", "tests", "benches", "examples"):
            shutil.copytree(part, folder / part.name)
    file = folder / "whales/right-whale.toml"
    file.write_text(file.read_text().replace("\nname =", f'\nmesh = "{name}"\nname =', 1))
    return file


def main():
    endline, library, out = sys.argv[sys.argv.index("--") + 1 :]
    library, out = Path(library), Path(out)
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)

    def called(*arguments):
        done = subprocess.run([endline, *map(str, arguments)], capture_output=True, text=True)
        return done.returncode, done.stdout + done.stderr

    print("Blender", bpy.app.version_string)
    whale, back = out / "whale.glb", out / "back.glb"
    called("whale", "build", "right-whale", "--library", library, "--out", whale)
    before = vertices(whale)
    lies_right(whale)
    item = with_mesh(library, out / "library", "mine.glb")
    for name, edits, settings, expected in TRIPS:
        edited(*imported(whale), edits)
        bpy.ops.export_scene.gltf(filepath=str(item.with_name("mine.glb")), **settings)
        code, output = called("check", item)
        if isinstance(expected, str):
            check(code == 1 and expected in output, f"{name}: refused, {output.splitlines()[0].split('error: ')[-1]}")
            continue
        code, output = called("whale", "build", "right-whale", "--library", out / "library", "--out", back)
        far = apart(before, vertices(back)) if code == 0 else np.inf
        check(far <= expected, f"{name}: taken, vertices within {far:.1e} m" if code == 0 else f"{name}: {output}")
    acts = out / "library/acts"
    act(whale, acts / "mine.glb")
    (acts / "mine.toml").write_text(
        'format = 1\nkind = "act"\nname = "Mine"\nsource = "keyed in Blender"\nconfidence = "estimate"\n'
        'fade = "0.5 s"\nanimation = "mine.glb"\n'
    )
    code, output = called("check", acts / "mine.toml")
    check(code == 0, f"an act keyed in Blender: {output.strip()}")
    sys.exit(1 if FAULTS else 0)


main()
