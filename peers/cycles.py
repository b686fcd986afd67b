#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Renders what `tyndall export` wrote with Blender's Cycles, on the CPU.

    python3 peers/cycles.py probe
    python3 peers/cycles.py render FOLDER -o out.exr --spp 64 --seed 1 --steps fine

README.md beside this file says how the two programs' conventions map. Needs the program blender.
"""
import json
import math
import os
import pathlib
import re
import shutil
import subprocess

import peer
from peer import Unsayable

PROGRAM = "blender"
INSIDE = pathlib.Path(__file__).resolve().parent / "cycles_scene.py"
# Ray marching: steps per voxel's width, and steps at most along one ray (Blender's default, and its limit).
STEPS = {"default": (1.0, 1024), "fine": (0.25, 65536)}


def probe():
    if not shutil.which(PROGRAM):
        raise peer.Unavailable(f"no {PROGRAM}: `apt-get install --no-install-recommends blender`")
    said = subprocess.run([PROGRAM, "--version"], capture_output=True, text=True)
    version = re.search(r"Blender ([0-9.]+)", said.stdout)
    return {"name": "Blender Cycles", "version": version[1] if version else "unknown", "variants": list(STEPS)}


def refuse(scene):
    """Raises Unsayable with the first feature that Cycles lacks."""
    for medium in scene.media:
        if medium["phase"]["type"] not in ("isotropic", "henyey-greenstein"):
            raise Unsayable(f"the phase function {medium['phase']['type']}")
    bounds = [(medium["phase"], peer.medium_bounds(medium["shape"])) for medium in scene.media]
    for i, (phase, a) in enumerate(bounds):
        # Blender 3.4 adds the phase functions of one place up without their weights.
        if any(phase != other and peer.overlap(a, b) for other, b in bounds[:i]):
            raise Unsayable("media of different phase functions whose bounds overlap")
    for material in scene.materials:
        refuse_material(material)
    for light in scene.lights:
        if light["type"] == "spot" and light["inner_angle"] != light["outer_angle"]:
            raise Unsayable("a spot whose edge is soft")
        if light["type"] == "sun" and light["angular_diameter"] and light["visible"] and in_view(light, scene):
            raise Unsayable("a sun's disc in the picture")


def refuse_material(material):
    if material["type"] == "conductor" and any(material["k"]):
        raise Unsayable("metal by its index of refraction")
    if material["type"] == "metal_rough" and material["metallic"] < 1:
        raise Unsayable("metal_rough that is not all metal")
    if material["type"] == "dielectric" and material["colour"] != [1, 1, 1]:
        raise Unsayable("glass with a tint")


def in_view(sun, scene):
    """Whether the camera might see the disc: Cycles never shows one."""
    camera, (width, height) = scene.camera, scene.size
    cosine = -sum(a * b for a, b in zip(sun["direction"], camera["forward"]))
    half = math.radians(camera.get("vertical_fov", 0) / 2)
    corner = math.atan(math.tan(half) * math.hypot(1, width / height))
    return cosine > math.cos(min(math.pi, corner + math.radians(sun["angular_diameter"] / 2)))


def render(scene, options):
    refuse(scene)
    rate, most = STEPS[options.steps]
    inside = {"folder": str(scene.folder), "output": os.path.abspath(options.output), "spp": options.spp}
    inside |= {"seed": options.seed, "step_rate": rate, "most_steps": most}
    words = [PROGRAM, "-b", "--factory-startup", "-noaudio", "-t", str(options.threads), "--python-exit-code", "1"]
    words += ["-P", str(INSIDE), "--", json.dumps(inside)]
    answer = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
    if answer.returncode != 0 or not os.path.exists(options.output):
        raise RuntimeError(f"{PROGRAM} ended with {answer.returncode}: {answer.stdout[-2000:]}")


def add_options(parser):
    peer.add_sampling(parser)
    parser.add_argument("--steps", default="default", choices=STEPS, help="of ray marching through grids (%(default)s)")


if __name__ == "__main__":
    peer.main("cycles.py", __doc__, add_options, probe, render)
