#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Renders what `tyndall export` wrote with Mitsuba 3.

    python3 peers/mitsuba_render.py probe
    python3 peers/mitsuba_render.py render FOLDER -o out.exr --spp 64 --seed 1 --variant scalar_rgb

README.md beside this file says how the two programs' conventions map. Needs `pip install numpy mitsuba`.
"""
import ctypes
import glob
import os
import sys

import peer
from pictures import write_exr

VARIANTS = ("scalar_rgb", "llvm_ad_rgb")
WAVEFRONT = 1 << 22  # samples that a vectorised variant holds at once
MIX = 1000003  # between the seeds of one picture's wavefronts


def load(variant):
    """The module mitsuba with this variant."""
    if variant.startswith("llvm"):
        name_llvm()
    try:
        import mitsuba
        import numpy  # noqa: F401
    except ImportError as missing:
        raise peer.Unavailable(f"no Python module {missing.name}: `pip install numpy mitsuba`") from missing
    if variant not in mitsuba.variants():
        raise peer.Unavailable(f"Mitsuba has no variant {variant}; it has {', '.join(mitsuba.variants())}")
    mitsuba.set_variant(variant)
    mitsuba.set_log_level(mitsuba.LogLevel.Error)
    return mitsuba


def name_llvm():
    """Mitsuba looks for libLLVM.so, which only LLVM's development packages bring: names the newest one there is."""
    found = sorted(glob.glob("/usr/lib/*/libLLVM-??.so*"))
    if found:
        os.environ.setdefault("DRJIT_LIBLLVM_PATH", found[-1])


def usable(variant):
    """Whether something can be computed with it; LLVM may be missing."""
    if variant.startswith("llvm"):
        name_llvm()
        try:
            ctypes.CDLL(os.environ.get("DRJIT_LIBLLVM_PATH", "libLLVM.so"))
        except OSError:
            return False
    return True


def probe():
    mitsuba = load("scalar_rgb")
    variants = [variant for variant in VARIANTS if variant in mitsuba.variants() and usable(variant)]
    return {"name": "Mitsuba 3", "version": mitsuba.__version__, "variants": variants}


def render(scene, options):
    mi = load(options.variant)
    import drjit
    import numpy
    from mitsuba_convert import Converter

    drjit.set_thread_count(options.threads)
    loaded = mi.load_dict(Converter(mi, scene).scene())
    width, height = scene.size
    most = options.spp if options.variant.startswith("scalar") else max(1, WAVEFRONT // (width * height))
    total, done, part = numpy.zeros((height, width, 3)), 0, 0
    while done < options.spp:
        spp = min(most, options.spp - done)
        seed = (options.seed * MIX + part) % (1 << 32)
        total += spp * numpy.array(mi.render(loaded, spp=spp, seed=seed), float)[..., :3]
        done, part = done + spp, part + 1
    picture = (total / options.spp).astype("<f4")
    write_exr(options.output, width, height, {name: picture[..., c].ravel() for c, name in enumerate("RGB")})


def add_options(parser):
    peer.add_sampling(parser)
    parser.add_argument("--variant", default="scalar_rgb", choices=VARIANTS, help="of Mitsuba (%(default)s)")


if __name__ == "__main__":
    status = 0
    try:
        peer.main("mitsuba_render.py", __doc__, add_options, probe, render)
    except SystemExit as end:
        status = end.code or 0
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status)  # without Dr.Jit's own end, which lists what Python still holds
