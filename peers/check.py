#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Do the peers of `tyndall bench` render what Tyndall does? Several seeds of each, compared in the mean and by tiles.

    python3 peers/check.py --tyndall build/release/tyndall
    python3 peers/check.py peers/scenes/sun-box.json --peer mitsuba --replicates 8

Needs numpy and the Python in which Mitsuba is installed. README.md beside this file says what was seen.
"""
import argparse
import dataclasses
import json
import pathlib
import shlex
import subprocess
import sys

import numpy

import replicates
from peer import UNSAYABLE
from pictures import Failure, read_exr, registration
from programs import Tyndall, run

HERE = pathlib.Path(__file__).resolve().parent


@dataclasses.dataclass(frozen=True)
class Peer:
    """One script with one setting. Deterministic ones are run once, and have no seed."""

    script: str
    options: str
    random: bool = True


PEERS = {
    "mitsuba": Peer("mitsuba_render.py", "--spp {spp}"),
    "mitsuba-llvm": Peer("mitsuba_render.py", "--spp {spp} --variant llvm_ad_rgb"),
    "cycles": Peer("cycles.py", "--spp {spp}"),
    "cycles-fine": Peer("cycles.py", "--spp {spp} --steps fine"),
    "vdb_render": Peer("vdb_render.py", "--setting 2,0.5,0.125,0.001", random=False),
}


def picture_of(file, size):
    channels = read_exr(file)
    return numpy.stack([numpy.array(channels[name], float).reshape(size[1], size[0]) for name in "RGB"], -1)


def size_of(folder):
    return json.loads((folder / "scene.json").read_text())["size"]


def theirs_of(peer, folder, options):
    """(pictures, CPU seconds of one) of a peer, or None and the reason if it cannot do the scene."""
    pictures, seconds = [], []
    for seed in range(options.seed, options.seed + (options.replicates if peer.random else 1)):
        out = options.work / "peer.exr"
        words = [options.python, str(HERE / peer.script), "render", str(folder), "-o", str(out)]
        words += shlex.split(peer.options.format(spp=options.spp)) + (["--seed", str(seed)] if peer.random else [])
        try:
            seconds.append(run(words)[0])
        except Failure as failure:
            if f"ended with {UNSAYABLE}:" in str(failure):
                return None, str(failure).split("not exportable: ")[-1]
            raise
        pictures.append(picture_of(out, size_of(folder)))
    return numpy.array(pictures), float(numpy.median(seconds))


def shift(theirs, ours):
    """Where the peer's picture lies, in pixels to the right and down."""
    a, b = (pictures.mean(axis=(0, 3)) for pictures in (theirs, ours))
    height, width = a.shape
    inside = [y * width + x for y in range(1, height - 1) for x in range(1, width - 1)]
    return registration(a.ravel().tolist(), b.ravel().tolist(), width, inside)[:2]


def line(theirs, ours, tile):
    """What differs, in one line: in the mean, by place, by tiles; a peer without noise is held against our own."""
    means = [pictures.mean(axis=(1, 2, 3)) for pictures in (theirs, ours)]
    error = numpy.sqrt(sum(mean.var(ddof=1) / len(mean) for mean in means if len(mean) > 1))
    relative = means[0].mean() / means[1].mean() - 1
    dx, dy = shift(theirs, ours)
    text = f"mean {relative:+8.3%} +- {error / means[1].mean():.3%}  shift {dx:+.3f} {dy:+.3f} px"
    squares = ((theirs.mean(0) - ours.mean(0)) ** 2).sum() / (ours.mean(0) ** 2).sum()
    text += f"  rRMSE of the means {numpy.sqrt(squares):.2%}"
    if len(theirs) < 2:
        return text
    pairs = zip(replicates.tiles(theirs, tile).T, replicates.tiles(ours, tile).T)
    found = [replicates.welch(a, b)[2] for a, b in pairs]
    noisy = numpy.array([p for p in found if p is not None])
    if not len(noisy):
        return text
    smallest = replicates.sidak(float(noisy.min()), len(noisy))
    return text + f"  tiles: smallest p {smallest:.2g}, uniform {replicates.uniformity(noisy):.2g}"


def check(scene, options, tyndall):
    folder = options.work / scene.stem
    size = ["--size", options.size] if options.size else []
    words = [tyndall.program, "export", str(scene), str(folder), *size]
    answer = subprocess.run(words, capture_output=True, text=True)
    if answer.returncode != 0:
        print(f"{scene.stem}: not exportable: {answer.stderr.strip()}")
        return
    ours, seconds = [], []
    for seed in range(options.seed, options.seed + options.replicates):
        out = options.work / "tyndall.exr"
        words = [tyndall.program, "render", str(scene), "-o", str(out), "--quiet", "--spp", str(options.spp)]
        seconds.append(run([*words, *size, *options.tyndall_args, "--seed", str(seed)], tyndall.environment)[0])
        ours.append(picture_of(out, size_of(folder)))
    ours = numpy.array(ours)
    print(f"{scene.stem}: {options.replicates} x {options.spp} samples; tyndall {numpy.median(seconds):.2f} CPU s")
    for name in options.peer or PEERS:
        theirs, cpu = theirs_of(PEERS[name], folder, options)
        if theirs is None:
            print(f"  {name:13} not exportable: {cpu}")
            continue
        print(f"  {name:13} {cpu:6.2f} CPU s  {line(theirs, ours, options.tile)}", flush=True)
        numpy.savez_compressed(options.work / f"{scene.stem}-{name}.npz", ours=ours, theirs=theirs)


def parsed():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", type=pathlib.Path, help="scene files (those of peers/scenes)")
    parser.add_argument("--tyndall", default="build/release/tyndall", help="the program (%(default)s)")
    parser.add_argument("--tyndall-args", default=[], type=shlex.split, metavar="ARGS", help="options for it")
    parser.add_argument("--size", metavar="WxH", help="of the pictures, whole tiles (the scene's)")
    parser.add_argument("--python", default=sys.executable, help="the Python that runs the peers (this one)")
    parser.add_argument("--peer", action="append", choices=PEERS, help="repeatable (all)")
    parser.add_argument("--replicates", default=8, type=int, metavar="R", help="seeds of each (%(default)s)")
    parser.add_argument("--spp", default=64, type=int, help="samples per pixel and replicate (%(default)s)")
    parser.add_argument("--seed", default=0, type=int, help="of the first replicate (%(default)s)")
    parser.add_argument("--tile", default=8, type=int, help="pixels each way (%(default)s)")
    parser.add_argument("--work", default="build/peers/check", type=pathlib.Path, help="folder (%(default)s)")
    return parser.parse_args()


def main():
    options = parsed()
    options.work.mkdir(parents=True, exist_ok=True)
    options.work = options.work.resolve()
    try:
        tyndall = Tyndall(options.tyndall, options.work)
        for scene in options.scenes or sorted((HERE / "scenes").glob("*.json")):
            check(scene, options, tyndall)
    except (Failure, OSError) as failure:
        sys.exit(f"check.py: {failure}")


if __name__ == "__main__":
    main()
