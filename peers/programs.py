# SPDX-License-Identifier: Apache-2.0
"""Runs Tyndall and vdb_render on one and the same set-up, and counts the CPU seconds of whole processes."""
import dataclasses
import json
import math
import os
import pathlib
import resource
import shlex
import shutil
import signal
import subprocess
import tempfile
import threading
import time

from pictures import Failure

LIMIT_S = 3600  # a process that runs longer is stopped


@dataclasses.dataclass(frozen=True)
class Setup:
    """What both programs render. World units are those of the .vdb; vectors are tuples of 3."""

    volume: str
    voxel: float  # world units
    density_scale: float  # extinction per unit of density and world unit
    albedo: float
    position: tuple
    target: tuple
    fov: float  # degrees, of a square picture
    to_light: tuple  # of any length
    size: int  # pixels, both ways


def run(command, environment=None, cpu_limit=None):
    """Runs a program to its end. Returns (CPU seconds of it and its children, wall seconds), or None at `cpu_limit`."""
    # The limit counts whole seconds and strikes after the second is over.
    limits = (lambda: resource.setrlimit(resource.RLIMIT_CPU, (int(cpu_limit) + 1,) * 2)) if cpu_limit else None
    start = time.monotonic()
    with tempfile.TemporaryFile() as said:
        child = subprocess.Popen(command, stdout=said, stderr=said, env=environment, preexec_fn=limits)
        watch = threading.Timer(LIMIT_S, child.kill)
        watch.start()
        _, status, usage = os.wait4(child.pid, 0)
        watch.cancel()
        child.returncode = os.waitstatus_to_exitcode(status)
        if child.returncode in (-signal.SIGXCPU, -signal.SIGKILL) and cpu_limit:
            return None
        if child.returncode != 0:
            said.seek(0)
            text = said.read().decode(errors="replace").strip()
            raise Failure(f"{shlex.join(command)}\nended with {child.returncode}: {text}")
    return usage.ru_utime + usage.ru_stime, time.monotonic() - start


def text_of(vector):
    return ",".join(f"{component:.9g}" for component in vector)


def vdb_render_command(program, setup, marching, picture):
    """`marching` is (supersampling factor, primary step and shadow step in voxels, cutoff)."""
    factor, step, shadow_step, cutoff = marching
    per_voxel = setup.density_scale * setup.voxel  # its extinction is per voxel and unit of density
    aperture = 100 * math.tan(math.radians(setup.fov) / 2)  # of a focal length of 50
    options = {
        "res": f"{setup.size * factor}x{setup.size * factor}",
        "translate": text_of(setup.position),
        "lookat": text_of(setup.target),
        "focal": "50",
        "aperture": f"{aperture:.9g}",
        "scatter": text_of([setup.albedo * per_voxel] * 3),
        "absorb": text_of([(1 - setup.albedo) * per_voxel] * 3),
        "light": text_of(setup.to_light) + ",1,1,1",
        "gain": "0",  # anything else weakens extinction along shadow rays
        "step": f"{step:.9g}",
        "shadowstep": f"{shadow_step:.9g}",
        "cutoff": f"{cutoff:.9g}",
        "compression": "none",
        "cpus": "1",  # threads cost CPU time
    }
    return [program, setup.volume, picture] + [word for key, value in options.items() for word in ("-" + key, value)]


def scene_text(setup, medium):
    """Tyndall's scene file of the same thing. Irradiance 4 pi makes up for vdb_render's missing phase function."""
    scene = {
        "camera": {"position": setup.position, "target": setup.target, "vertical_fov": setup.fov},
        "film": {"size": [setup.size] * 2, "transparent": True},
        "media": [{"albedo": setup.albedo, "phase": {"type": "isotropic"}, **medium}],
        "lights": [
            {
                "type": "sun",
                "direction": [-component for component in setup.to_light],
                "irradiance": 4 * math.pi,
                "angular_diameter": 0,
                "visible": False,
            }
        ],
    }
    return json.dumps(scene, indent=1)


class Tyndall:
    """Runs tyndall in a folder of its own, with a kernel cache of its own that outlives the process."""

    def __init__(self, program, folder):
        self.program, self.folder = str(pathlib.Path(program).resolve()), folder
        self.environment = {**os.environ, "XDG_CACHE_HOME": str(folder / "cache")}

    def forget_kernels(self):
        """The next run compiles its kernels as on a new machine."""
        shutil.rmtree(self.environment["XDG_CACHE_HOME"], ignore_errors=True)

    def render(self, scene, arguments):
        """Returns ((CPU s, wall s), picture, statistics)."""
        file, picture, stats = (self.folder / name for name in ("scene.json", "tyndall.exr", "tyndall.json"))
        file.write_text(scene)
        words = [self.program, "render", str(file), "-o", str(picture), "--stats", str(stats), "--quiet", *arguments]
        seconds = run(words, self.environment)
        return seconds, picture, json.loads(stats.read_text())

    def info(self, volume):
        """The only or first renderable grid of a volume, and what a bare render would take."""
        words = [self.program, "info", "--json", volume]
        answer = subprocess.run(words, env=self.environment, capture_output=True, text=True, timeout=LIMIT_S)
        if answer.returncode != 0:
            raise Failure(f"{shlex.join(words)}\nended with {answer.returncode}: {answer.stderr.strip()}")
        return json.loads(answer.stdout)
