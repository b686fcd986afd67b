# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: makes its scene of what `tyndall export` wrote, and renders it. README.md maps the conventions.

cycles.py starts it, and has refused what cannot be said.
"""
import array
import json
import math
import pathlib
import sys

import bpy
import mathutils

sys.path.append(str(pathlib.Path(__file__).resolve().parent))
import peer  # noqa: E402
from cycles_shaders import Shader, medium_shader, surface_shader, world_shader  # noqa: E402

GROWN = 1e-4  # share by which a medium's bounds are moved out, where surfaces might lie in the same plane
SUBDIVISIONS = 7  # of a sphere: 81,920 triangles, within 1e-4 of it
UNLIMITED = 1024  # bounces, Blender's limit


def add(name, data, material=None):
    made = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(made)
    if material:
        data.materials.append(material)
    return made


def place(made, position, z_axis, y_axis):
    """An object with these axes, of unit length and at right angles."""
    z, y = mathutils.Vector(z_axis), mathutils.Vector(y_axis)
    axes = mathutils.Matrix((y.cross(z), y, z)).transposed().to_4x4()
    axes.translation = mathutils.Vector(position)
    made.matrix_world = axes


def across(direction):
    """A unit vector at right angles to it."""
    return mathutils.Vector(direction).orthogonal().normalized()


# Camera and settings


def add_camera(scene):
    camera, data = scene.camera, bpy.data.cameras.new("camera")
    data.sensor_fit, data.sensor_height = "VERTICAL", 24.0
    data.clip_start, data.clip_end = 1e-4, 1e7
    if camera["type"] == "orthographic":
        data.type, data.ortho_scale = "ORTHO", camera["height"]
    else:
        data.lens = data.sensor_height / 2 / math.tan(math.radians(camera["vertical_fov"]) / 2)
    if camera.get("lens_radius"):
        data.dof.use_dof, data.dof.focus_distance = True, camera["focus_distance"]
        data.dof.aperture_fstop = data.lens * 1e-3 / (2 * camera["lens_radius"])
    made = add("camera", data)
    place(made, camera["position"], [-value for value in camera["forward"]], camera["up"])
    bpy.context.scene.camera = made


def settle(scene, options):
    """Everything that would change the expectation or hide the noise is off."""
    render, cycles = bpy.context.scene.render, bpy.context.scene.cycles
    render.engine, cycles.device = "CYCLES", "CPU"
    render.resolution_x, render.resolution_y = scene.size
    render.resolution_percentage = 100
    render.use_compositing = render.use_sequencer = render.use_motion_blur = render.film_transparent = False
    render.filepath, render.use_file_extension = options["output"], False
    image = render.image_settings
    image.file_format, image.color_mode, image.color_depth, image.exr_codec = "OPEN_EXR", "RGB", "32", "ZIP"
    cycles.samples, cycles.seed = options["spp"], options["seed"]
    cycles.use_adaptive_sampling = cycles.use_denoising = cycles.use_guiding = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.light_sampling_threshold = cycles.blur_glossy = 0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 1.0
    cycles.volume_step_rate, cycles.volume_max_steps = options["step_rate"], options["most_steps"]
    # An event more than bounces: light that reaches the first one has not bounced.
    bounces = scene.depth - 1 if scene.depth else UNLIMITED
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = bounces
    cycles.transmission_bounces = cycles.volume_bounces = bounces
    cycles.transparent_max_bounces = UNLIMITED


# Shapes


def mesh_of(name, points, polygons, normals=None):
    data = bpy.data.meshes.new(name)
    data.from_pydata(points, [], polygons)
    if normals:
        data.polygons.foreach_set("use_smooth", [True] * len(data.polygons))
        data.use_auto_smooth, data.auto_smooth_angle = True, math.pi
        data.normals_split_custom_set_from_vertices(normals)
    return data


def mesh_of_ply(file, has_normals):
    """Binary, as peer_scene writes them: x, y, z and maybe a normal as floats, then triangles."""
    content = pathlib.Path(file).read_bytes()
    head, _, body = content.partition(b"end_header\n")
    count, faces = (int(line.split()[2]) for line in head.splitlines() if line.startswith(b"element"))
    stride = 6 if has_normals else 3
    values = array.array("f", body[: 4 * stride * count])
    rows = [values[i : i + stride] for i in range(0, len(values), stride)]
    start = 4 * stride * count
    corners = (array.array("i", body[at + 1 : at + 13]) for at in range(start, start + 13 * faces, 13))
    normals = [tuple(row[3:]) for row in rows] if has_normals else None
    return mesh_of(pathlib.Path(file).stem, [tuple(row[:3]) for row in rows], [tuple(c) for c in corners], normals)


def sphere(name, centre, radius):
    """Its own normals make up for most of what the triangles lack."""
    import bmesh

    made, data = bmesh.new(), bpy.data.meshes.new(name)
    bmesh.ops.create_icosphere(made, subdivisions=SUBDIVISIONS, radius=radius)
    bmesh.ops.translate(made, verts=made.verts, vec=centre)
    made.to_mesh(data)
    made.free()
    data.polygons.foreach_set("use_smooth", [True] * len(data.polygons))
    return data


def box(name, shape):
    """Seen from outside its faces turn left, mirrored too."""
    grown = [GROWN * (b - a) / 2 for a, b in zip(shape["min"], shape["max"])]
    low = [a - g for a, g in zip(shape["min"], grown)]
    high = [b + g for b, g in zip(shape["max"], grown)]
    matrix = shape["world_from_medium"]
    points = [peer.apply(matrix, corner) for corner in peer.corners(low, high)]
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return mesh_of(name, points, [face[::-1] for face in faces] if peer.determinant(matrix) < 0 else faces)


# Media, objects, lights


def add_medium(name, medium, scene):
    shape = medium["shape"]
    kind = shape["type"]
    if kind in ("objects", "unbounded"):  # in the materials of objects; in the world
        return
    material = Shader.of_material(name)
    material.output("Volume", medium_shader(material, medium))
    if kind == "grid":
        data = bpy.data.volumes.new(name)
        data.filepath = scene.file(shape["vdb"])
        data.grids.load()
        data.render.precision, data.render.clipping = "FULL", 0.0
    elif kind == "box":
        data = box(name, shape)
    else:
        scale = abs(peer.determinant(shape["world_from_medium"])) ** (1 / 3)
        centre = peer.apply(shape["world_from_medium"], shape["centre"])
        data = sphere(name, centre, shape["radius"] * scale * (1 + GROWN))
    made = add(name, data, material.owner)
    if kind == "grid":
        # Blender 3.4 draws a grid half a voxel off along each axis: check.py's sun-cloud, without this line.
        matrix = shape["world_from_index"]
        made.location = [-sum(matrix[4 * row : 4 * row + 3]) / 2 for row in range(3)]


def add_object(name, thing, scene):
    source = scene.materials[thing["material"]]
    material = Shader.of_material(name)
    if source["type"] != "null":
        material.output("Surface", surface_shader(material, source))
    if thing["medium"] is not None:
        material.output("Volume", medium_shader(material, scene.media[thing["medium"]]))
    if thing["type"] == "sphere":
        data = sphere(name, thing["centre"], thing["radius"])
    else:
        data = mesh_of_ply(scene.file(thing["file"]), thing["normals"])
    add(name, data, material.owner)


def add_light(name, light):
    """A lamp; environments are in the world."""
    kinds = {"point": ("POINT", "intensity"), "spot": ("SPOT", "intensity"), "sun": ("SUN", "irradiance")}
    if light["type"] not in kinds:
        return
    kind, key = kinds[light["type"]]
    data = bpy.data.lights.new(name, kind)
    strength = max(light[key]) or 1.0
    data.color = [value / strength for value in light[key]]
    data.energy = strength if kind == "SUN" else 4 * math.pi * strength  # watts in all directions
    data.cycles.max_bounces = UNLIMITED
    if kind == "SUN":
        data.angle = math.radians(light["angular_diameter"])
    else:
        data.shadow_soft_size = 0.0
    if kind == "SPOT":
        data.spot_size, data.spot_blend = math.radians(2 * light["outer_angle"]), 0.0
    direction = light.get("direction", [0.0, 0.0, -1.0])
    place(add(name, data), light.get("position", [0.0, 0.0, 0.0]), [-d for d in direction], across(direction))


def add_world(scene):
    """Environments, and the media that have no bounds."""
    world = bpy.data.worlds.new("world")
    bpy.context.scene.world = world
    shader = Shader.of_world(world)
    shader.output("Surface", world_shader(shader, [light for light in scene.lights if "visible" in light], scene))
    unbounded = [medium for medium in scene.media if medium["shape"]["type"] == "unbounded"]
    if unbounded:
        world.cycles.volume_sampling = "MULTIPLE_IMPORTANCE"
        shader.output("Volume", shader.sum([medium_shader(shader, medium) for medium in unbounded]))


def main(options):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = peer.Scene(options["folder"])
    settle(scene, options)
    add_camera(scene)
    add_world(scene)
    for i, medium in enumerate(scene.media):
        add_medium(f"medium{i}", medium, scene)
    for i, thing in enumerate(scene.objects):
        add_object(f"object{i}", thing, scene)
    for i, light in enumerate(scene.lights):
        add_light(f"light{i}", light)
    bpy.ops.render.render(write_still=True)


main(json.loads(sys.argv[sys.argv.index("--") + 1]))
