#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares Tyndall with Mitsuba 3: the same scenes, several seeds each, tile by tile and in the mean.

    pip install numpy mitsuba
    python3 peers/mitsuba3.py --tyndall build/release/tyndall
    python3 peers/mitsuba3.py fog-room --tyndall build/release/tyndall --replicates 16

The exit code is 0 if all scenes agree, 1 if one does not, 2 if nothing could be compared. README.md beside this file
says how the two programs' conventions map. Needs Python 3.9 or newer.
"""
import argparse
import copy
import json
import os
import pathlib
import shlex
import shutil
import sys
import time

from pictures import Failure, read_exr


def missing(module):
    print(f"mitsuba3.py: this comparison needs the Python module {module}: `pip install numpy mitsuba`", file=sys.stderr)
    sys.exit(2)


try:
    import numpy
except ImportError:
    missing("numpy")
try:
    import mitsuba
except ImportError:
    missing("mitsuba")

import programs  # noqa: E402  (they need numpy)
import replicates  # noqa: E402
from mitsuba_scenes import SCENES, Builder  # noqa: E402

ROULETTE = 50  # Mitsuba's paths are not ended by chance before so many edges


def complete(pair, size, mi):
    """(scene text for Tyndall, loaded scene for Mitsuba): the pair with its camera, film and depth."""
    position, target, fov = pair.camera
    camera = {"position": position, "target": target, "vertical_fov": fov}
    film = {"size": [size, size]}
    ours = {"camera": camera, "film": film, "render": {"samples": pair.samples, "depth": pair.depth}, **pair.ours}
    sensor = {
        "type": "perspective",
        "fov": fov,
        "fov_axis": "y",
        "to_world": mi.ScalarTransform4f.look_at(origin=position, target=target, up=[0, 1, 0]),
        "sampler": {"type": "independent", "sample_count": pair.samples},
        "film": {
            "type": "hdrfilm",
            "width": size,
            "height": size,
            "rfilter": {"type": "box"},
            "pixel_format": "rgb",
            "component_format": "float32",
        },
    }
    # Mitsuba counts the edges of a path, the last one to a light included; events are one fewer.
    depth = pair.depth + 1 if pair.depth else -1
    integrator = {"type": pair.integrator, "max_depth": depth, "rr_depth": ROULETTE}
    theirs = {"type": "scene", "integrator": integrator, "sensor": sensor, **pair.theirs}
    return json.dumps(ours, indent=1), mi.load_dict(theirs)


def cpu_seconds():
    used = os.times()
    return used.user + used.system


def compare(name, options, tyndall, mi):
    """Renders a scene R times with both programs and prints what differs. Returns whether they agree."""
    pair = SCENES[name](Builder(mi), options.work)
    pair.samples = max(1, round(pair.samples * options.samples))
    text, scene = complete(pair, options.size, mi)
    (options.work / f"{name}.json").write_text(text)
    ours, theirs, cpu = [], [], ([], [])
    tyndall.render(text, ["--spp", "1", *options.tyndall_args])  # compiles the kernels, which later runs find
    for seed in range(options.seed, options.seed + options.replicates):
        (seconds, _), picture, stats = tyndall.render(text, ["--seed", str(seed), *options.tyndall_args])
        image = read_exr(picture)
        ours.append(numpy.stack([numpy.array(image[c]).reshape(options.size, -1) for c in "RGB"], -1))
        cpu[0].append(seconds)
        before = cpu_seconds()
        theirs.append(numpy.array(mi.render(scene, seed=seed)))
        cpu[1].append(cpu_seconds() - before)
    ours, theirs = numpy.array(ours, float), numpy.array(theirs, float)
    numpy.savez_compressed(options.work / f"{name}.npz", ours=ours, theirs=theirs)
    print(
        f"{name}: {options.replicates} x {pair.samples} samples, {options.size}x{options.size}, "
        f"tyndall ({stats['estimator']['name']}) against {pair.integrator}\n"
        f"  CPU s of one    tyndall {numpy.median(cpu[0]):.2f} with its start, mitsuba {numpy.median(cpu[1]):.2f} without; "
        f"noise of a tile, tyndall / mitsuba {spread(ours, options) / spread(theirs, options):.2f}"
    )
    # Pixels of the march share directions to environments, and with them noise: tiles are not independent.
    good = replicates.judge(ours, theirs, options.tile, independent=stats["estimator"]["name"] != "march")
    sys.stdout.flush()
    return good


def spread(pictures, options):
    """Root of the mean variance of a tile."""
    return float(numpy.sqrt(replicates.tiles(pictures, options.tile).var(axis=0, ddof=1).mean()))


def parsed(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help=f"{', '.join(SCENES)} (all)")
    parser.add_argument("--tyndall", default="build/release/tyndall", help="the program (%(default)s)")
    parser.add_argument("--tyndall-args", default=[], type=shlex.split, metavar="ARGS", help="options for it")
    parser.add_argument("--variant", default="scalar_rgb", help="of Mitsuba (%(default)s)")
    parser.add_argument("--replicates", default=12, type=int, metavar="R", help="seeds of each (%(default)s)")
    parser.add_argument("--samples", default=1.0, type=float, metavar="F", help="factor of the samples per pixel")
    parser.add_argument("--seed", default=0, type=int, help="of the first replicate (%(default)s)")
    parser.add_argument("--size", default=64, type=int, help="pixels each way (%(default)s)")
    parser.add_argument("--tile", default=8, type=int, help="pixels each way (%(default)s)")
    parser.add_argument("--work", default="build/peers", type=pathlib.Path, help="folder for files (%(default)s)")
    options = parser.parse_args(arguments)
    if options.replicates < 4 or options.size % options.tile:
        parser.error("--replicates is 4 at least, and --tile divides --size")
    for name in options.scenes:
        if name not in SCENES:
            parser.error(f"no scene {name}; there are {', '.join(SCENES)}")
    return options


def main():
    options = parsed(sys.argv[1:])
    try:
        if not shutil.which(options.tyndall):
            raise Failure(f"{options.tyndall}: no such program; build it, or name it with --tyndall")
        if options.variant not in mitsuba.variants():
            raise Failure(f"Mitsuba {mitsuba.__version__} has no variant {options.variant}; --variant takes "
                          f"{', '.join(mitsuba.variants())}")
        mitsuba.set_variant(options.variant)
        options.work.mkdir(parents=True, exist_ok=True)
        options.work = options.work.resolve()
        tyndall = programs.Tyndall(options.tyndall, options.work)
        start = time.monotonic()
        agreed = {name: compare(name, options, tyndall, mitsuba) for name in options.scenes or SCENES}
    except (Failure, OSError, RuntimeError) as failure:
        print(f"mitsuba3.py: {failure}", file=sys.stderr)
        sys.exit(2)
    differ = [name for name, good in agreed.items() if not good]
    print(f"{len(agreed) - len(differ)} of {len(agreed)} scenes agree, {time.monotonic() - start:.0f} s")
    sys.exit(1 if differ else 0)


if __name__ == "__main__":
    main()
