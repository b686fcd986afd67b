# SPDX-License-Identifier: Apache-2.0
"""Renders what `tyndall export` wrote with OpenVDB's vdb_render. README.md has what it computes and its conventions."""
import math
import pathlib
import re
import shutil
import subprocess
import tempfile

import peer
from peer import Unsayable
from pictures import box_filtered, read_exr, write_exr

PROGRAM = "vdb_render"
SMALLEST_SUN = 0.01  # degrees: below it Tyndall's suns are directions, too


def probe():
    if not shutil.which(PROGRAM):
        raise peer.Unavailable(f"no {PROGRAM}: `apt-get install libopenvdb-tools`")
    said = subprocess.run([PROGRAM, "-version"], capture_output=True, text=True)
    version = re.search(r"library version: ([0-9.]+)", said.stdout + said.stderr)
    return {"name": "vdb_render (OpenVDB)", "version": version[1] if version else "unknown", "variants": []}


def medium_of(scene):
    """The only medium, its voxel size and the only light. Raises Unsayable with what else is there."""
    if scene.objects:
        raise Unsayable("surfaces")
    if len(scene.media) != 1 or scene.media[0]["shape"]["type"] != "grid":
        raise Unsayable("media other than one grid")
    if len(scene.lights) != 1 or scene.lights[0]["type"] != "sun":
        raise Unsayable("lights other than one sun")
    (medium,), (light,) = scene.media, scene.lights
    if light["angular_diameter"] >= SMALLEST_SUN:
        raise Unsayable("a sun with a disc")
    if scene.depth != 1:
        raise Unsayable("more than one event")
    if medium["phase"]["type"] != "isotropic":
        raise Unsayable("a phase function that is not isotropic")
    voxel = peer.similarity(medium["shape"]["world_from_index"])
    if not voxel:
        raise Unsayable("voxels that are not cubes")
    return medium, voxel, light


def camera_options(scene, factor):
    camera, (width, height) = scene.camera, scene.size
    if camera.get("lens_radius"):
        raise Unsayable("a lens")
    target = [a + b for a, b in zip(camera["position"], camera["forward"])]
    options = {"res": f"{width * factor}x{height * factor}", "translate": listed(camera["position"])}
    options |= {"lookat": listed(target), "up": listed(camera["up"])}
    if camera["type"] == "orthographic":
        return options | {"camera": "ortho", "frame": number(camera["height"] * width / height)}
    aperture = 100 * math.tan(math.radians(camera["vertical_fov"]) / 2) * width / height  # of a focal length of 50
    return options | {"focal": "50", "aperture": number(aperture)}


def command(scene, setting, threads, picture):
    """`setting` is (rays per pixel each way, primary step and shadow step in voxels, cutoff)."""
    factor, step, shadow_step, cutoff = setting
    medium, voxel, light = medium_of(scene)
    per_voxel = [sigma_t * voxel for sigma_t in medium["sigma_t"]]  # its extinction is per voxel and unit of density
    scatter = [albedo * extinction for albedo, extinction in zip(medium["albedo"], per_voxel)]
    absorb = [extinction - scattered for extinction, scattered in zip(per_voxel, scatter)]
    # Towards the light, and its colour: a 4 pi-th, as there is no phase function.
    sun = [-d for d in light["direction"]] + [value / (4 * math.pi) for value in light["irradiance"]]
    options = camera_options(scene, factor) | {
        "scatter": listed(scatter),
        "absorb": listed(absorb),
        "light": listed(sun),
        "gain": "0",  # anything else weakens extinction along shadow rays
        "step": number(step),
        "shadowstep": number(shadow_step),
        "cutoff": number(cutoff),
        "compression": "none",
        "cpus": str(threads),
    }
    words = [word for key, value in options.items() for word in ("-" + key, value)]
    return [PROGRAM, scene.file(medium["shape"]["vdb"]), picture, *words]


def number(value):
    return f"{value:.9g}"


def listed(values):
    return ",".join(map(number, values))


def run(words):
    answer = subprocess.run(words, capture_output=True, text=True)
    if answer.returncode != 0:
        raise RuntimeError(f"{PROGRAM} ended with {answer.returncode}: {answer.stderr.strip()}")


def render(scene, options):
    factor = options.setting[0]
    if factor == 1:
        return run(command(scene, options.setting, options.threads, options.output))
    with tempfile.TemporaryDirectory() as folder:
        picture = str(pathlib.Path(folder) / "picture.exr")
        run(command(scene, options.setting, options.threads, picture))
        channels = read_exr(picture)
    width, height = scene.size
    means = {name: box_filtered(channels[name], width, height, factor) for name in "RGB"}
    write_exr(options.output, width, height, means)


def setting_from(text):
    factor, *rest = text.split(",")
    step, shadow_step, cutoff = map(float, rest)
    return int(factor), step, shadow_step, cutoff


def add_options(parser):
    parser.add_argument("--setting", type=setting_from, default=(1, 1, 1, 0.005), metavar="K,P,S,C",
                        help="K x K rays per pixel, -step P -shadowstep S -cutoff C (1,1,1,0.005)")
    parser.add_argument("--seed", type=int, default=0, help="taken and not used: nothing is random")
    parser.add_argument("--threads", type=int, default=1, metavar="T", help="they cost CPU time (%(default)s)")
