#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares Tyndall with OpenVDB's vdb_render: CPU seconds of the whole process to a given error, one sun, one cloud.

    python3 peers/vdb_render.py calibrate --tyndall build/release/tyndall
    python3 peers/vdb_render.py compare cloud.vdb --tyndall build/release/tyndall

    python3 peers/vdb_render.py probe
    python3 peers/vdb_render.py render FOLDER -o out.exr --setting 2,0.5,0.125,0.001

`probe` and `render`, of what `tyndall export` wrote, are for `tyndall bench`. `calibrate` holds both programs against
quadrature on a cube of constant density; `compare` prints the table. README.md beside this file says how the two
programs' conventions map. Needs Python 3.9 or newer and nothing else.
"""
import argparse
import dataclasses
import hashlib
import itertools
import json
import math
import pathlib
import shlex
import shutil
import statistics
import sys

import box
import peer
import vdb_render_scene
from pictures import Failure, box_filtered, grey, registration, relative_error
from programs import Setup, Tyndall, run, scene_text, vdb_render_command
from vdb_render_scene import setting_from

COVERED = 0.01  # a pixel counts where 1 - transmittance is above this, docs/conventions.md
REFERENCE_SEED = 77777  # no measured run has it
# What vdb_render is tried with: rays per pixel each way, steps in voxels, cutoff of density and transmittance.
SWEEP = list(itertools.product((1, 2), (2, 1.5, 1, 0.75), (1, 0.75, 0.5, 0.25, 0.125), (0.05, 0.02, 0.005, 0.002)))


def calibrate(options, tyndall):
    """Prints how far both programs are from quadrature. Returns whether they agree within what their steps explain."""
    cube = options.work / "cube.vdb"
    cube.write_bytes(box.vdb_file())
    setup = Setup(str(cube), box.VOXEL, 1.0, 0.8, (4.5, 3.5, 6.5), (1, 1, 1), 32, (0.5, 0.8, 0.3), 64)
    centres, chords = box.picture(setup, (0.5,))
    means, _ = box.picture(setup, (0.5 - 12**-0.5, 0.5 + 12**-0.5))
    size = setup.size
    # Away from the silhouette, where a quadrature over the pixel is good enough.
    pixels = [
        i
        for i in range(size + 1, size * (size - 1) - 1)
        if min(chords[j] for j in (i - size - 1, i - size + 1, i + size - 1, i + size + 1)) > 0.3 * box.EDGE
    ]

    def judged(name, picture, exact, expected, tolerance):
        shift_x, shift_y, _ = registration(picture, exact, size, pixels)
        error, mean = relative_error(picture, exact, pixels)
        good = abs(mean - expected) < tolerance and max(abs(shift_x), abs(shift_y)) < 0.02
        shifts = f"shift {shift_x:+.3f} {shift_y:+.3f} px"
        verdict = "agrees" if good else "DIFFERS"
        print(f"{name:24} mean {mean:+.5f} (expected {expected:+.5f}), rRMSE {error:.5f}, {shifts}: {verdict}")
        return good

    good = []
    for step in (32, 16, 8):
        picture = str(options.work / "cube.exr")
        run(vdb_render_command(options.vdb_render, setup, (1, step, step, 0), picture))
        # Its shadow rays begin one step away from the point: half a step of extinction is missing in the mean.
        missing = math.expm1(setup.density_scale * box.VOXEL * step / 2)
        good.append(judged(f"vdb_render, step {step}/4096", grey(picture)[0], centres, missing, 0.1 * missing + 1e-4))
    shape = {"type": "box", "min": [0, 0, 0], "max": [box.EDGE] * 3}
    scene = scene_text(setup, {"type": "homogeneous", "extinction": setup.density_scale, "shape": shape})
    _, picture, _ = tyndall.render(scene, ["--spp", "1024"])
    good.append(judged("tyndall, 1024 samples", grey(picture)[0], means, 0, 0.001))
    return all(good)


@dataclasses.dataclass
class Contender:
    """One program with one setting that should reach `target`; `render` takes the number of the round."""

    name: str
    setting: str
    target: float
    render: object  # round -> (CPU s, wall s, rRMSE, relative difference of means); None: too long to measure
    estimate: tuple = ()  # (CPU s, rRMSE), where nothing is measured
    results: list = dataclasses.field(default_factory=list)


class Judge:
    """The reference picture of a set-up, kept in the work folder, and the errors of others against it."""

    def __init__(self, options, tyndall, setup):
        file = str(pathlib.Path(setup.volume).resolve())
        medium = {"type": "grid", "file": file, "density_scale": setup.density_scale}
        self.setup, self.tyndall, self.options = setup, tyndall, options
        self.scene = scene_text(setup, medium)
        exact = scene_text(setup, {**medium, "storage": "float"})
        words = ["--error", str(options.reference_error), "--seed", str(REFERENCE_SEED)]
        words += shlex.split(options.reference_args)
        key = hashlib.sha256((exact + " ".join(words)).encode()).hexdigest()[:16]
        kept, note = options.work / f"reference-{key}.exr", options.work / f"reference-{key}.json"
        if not note.exists():
            _, picture, stats = tyndall.render(exact, words)
            picture.replace(kept)
            note.write_text(json.dumps({"error": stats["error"]["relative"]}))
        self.own_error = json.loads(note.read_text())["error"]
        self.reference, opacity = grey(kept)
        self.covered = [i for i, value in enumerate(opacity) if value > COVERED]

    def errors(self, picture, factor=1):
        """(rRMSE with the reference's own error taken out, relative difference of the means)."""
        error, mean = relative_error(box_filtered(picture, self.setup.size, self.setup.size, factor), self.reference, self.covered)
        return math.sqrt(max(0.0, error**2 - self.own_error**2)), mean

    def march(self, marching, cpu_limit=None):
        """One run of vdb_render: (CPU s, wall s, rRMSE, mean), or None if it takes longer than the limit."""
        picture = str(self.options.work / "vdb_render.exr")
        seconds = run(vdb_render_command(self.options.vdb_render, self.setup, marching, picture), None, cpu_limit)
        # Averaging its pixels is not counted: in its favour.
        return seconds and (*seconds, *self.errors(grey(picture)[0], marching[0]))

    def sample(self, arguments, samples, seed):
        """One run of tyndall, likewise."""
        words = ["--spp", str(samples), "--seed", str(seed), *shlex.split(arguments)]
        seconds, picture, _ = self.tyndall.render(self.scene, words)
        return *seconds, *self.errors(grey(picture)[0])


def marching_contenders(judge, targets):
    """vdb_render's cheapest setting for each target. Cheap ones go first, and nothing may take longer than the best."""

    def guess(marching):
        return marching[0] ** 2 / marching[1] * (0.5 + 1 / marching[2]) * -math.log(max(marching[3], 1e-6))

    best, limit = {}, None
    for marching in sorted(judge.options.marching or SWEEP, key=guess):
        result = judge.march(marching, limit)
        if result is None:
            continue
        tell(f"  vdb_render {marching}: {result[0]:.2f} CPU s, rRMSE {result[2]:.2%}, mean {result[3]:+.2%}")
        for target in targets:
            if result[2] <= target and (target not in best or result[0] < best[target][0]):
                best[target] = (result[0], marching)
        limit = best[min(targets)][0] if min(targets) in best else None
    for target in targets:
        if target not in best:
            yield Contender("vdb_render", "no setting tried reaches it", target, None)
            continue
        factor, step, shadow_step, cutoff = chosen = best[target][1]
        setting = f"{factor * factor} ray/px, step {step:g}, shadow {shadow_step:g}, cutoff {cutoff:g}"
        yield Contender("vdb_render", setting, target, lambda _, chosen=chosen: judge.march(chosen))


def sampling_contenders(judge, arguments, targets):
    """Tyndall with the samples that each target takes, found by doubling."""
    name = f"tyndall {arguments}".strip()
    judge.tyndall.forget_kernels()
    cold = judge.sample(arguments, 1, 0)  # every later run finds its kernels compiled
    tell(f"  {name}, 1 spp, nothing cached: {cold[0]:.2f} CPU s")
    points, samples = [], 1
    while samples <= judge.options.max_spp and (not points or points[-1][2] > min(targets)):
        cpu, _, error, mean = judge.sample(arguments, samples, samples)
        tell(f"  {name}, {samples} spp: {cpu:.2f} CPU s, rRMSE {error:.2%}, mean {mean:+.2%}")
        points.append((samples, cpu, error))
        samples *= 2
    first, last = points[0], points[-1]
    for target in targets:
        above = [point for point in points if point[2] > target]
        if not above or above[-1] != last:
            needed = 1
            if above:  # between two measured points, a straight line of logarithms
                below = points[len(above)]
                share = math.log(above[-1][2] / target) / math.log(above[-1][2] / below[2])
                needed = math.ceil(1.02 * above[-1][0] * (below[0] / above[-1][0]) ** share)
            render = lambda turn, needed=needed: judge.sample(arguments, needed, 1000 + turn)  # noqa: E731
            yield Contender(name, f"{needed} spp", target, render)
            continue
        needed = math.ceil(last[0] * (last[2] / target) ** 2)
        if last[1] < 1.5 * first[1]:  # start-up hides what a sample costs
            yield Contender(name, f"~{needed} spp, time unknown: raise --max-spp", target, None)
            continue
        slope = (last[1] - first[1]) / (last[0] - first[0])
        setting = f"~{needed} spp, extrapolated from {last[0]} as 1/n"
        yield Contender(name, setting, target, None, (last[1] + (needed - last[0]) * slope, target))


def tell(line):
    print(line, file=sys.stderr, flush=True)


def print_row(size, contender):
    if contender.results:
        cpu, wall, error, mean = (statistics.median(column) for column in zip(*contender.results))
        times = [result[0] for result in contender.results]
        numbers = f"{cpu:9.2f} ({min(times):.2f} to {max(times):.2f})  wall {wall:.2f}  {error:.2%}  {mean:+.2%}"
    elif contender.estimate:
        numbers = f"~{contender.estimate[0]:8.1f}"
    else:
        numbers = "        -"
    print(f"{size:5} {contender.target:6.1%}  {contender.name:28} {contender.setting:48} {numbers}")


def compare(options, tyndall):
    """The table. Every size has a sweep, then rounds in which every contender runs once."""
    for size in options.sizes:
        setup = setup_for(options, tyndall, size)
        judge = Judge(options, tyndall, setup)
        tell(f"{size}x{size}: {len(judge.covered)} covered pixels, the reference's own rRMSE {judge.own_error:.2%}")
        contenders = list(marching_contenders(judge, options.targets))
        for arguments in options.tyndall_args or [""]:
            contenders += sampling_contenders(judge, arguments, options.targets)
        for turn in range(options.repeats):
            for contender in contenders:
                if contender.render:
                    contender.results.append(contender.render(turn))
        print(f" size target  {'program':28} {'setting':48} CPU s: median (range), wall s, rRMSE, mean")
        for contender in sorted(contenders, key=lambda contender: -contender.target):
            print_row(size, contender)
    return True


def setup_for(options, tyndall, size):
    """The whole volume in view from the side and a little above, at the optical depth of a bare render."""
    found = tyndall.info(options.volume)
    grids = [grid for grid in found["grids"] if grid["can_be_rendered"]]
    if not grids:
        raise Failure(f"{options.volume}: nothing to render; take a volume with a float density grid")
    low, high = grids[0]["world_bounds"]
    target = tuple((a + b) / 2 for a, b in zip(low, high))
    distance = 2.5 * math.dist(low, high) / 2
    position = tuple(t + distance * d for t, d in zip(target, box.unit((0.62, 0.23, 0.75))))
    scale = options.density_scale or found["bare_render"]["density_scale"]
    voxel = grids[0]["voxel_size"][0]
    return Setup(options.volume, voxel, scale, options.albedo, position, target, 40, (0.5, 0.8, 0.3), size)


def parsed(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("calibrate", "compare"))
    parser.add_argument("volume", nargs="?", help="OpenVDB file whose first float grid is a density (compare)")
    parser.add_argument("--tyndall", default="build/release/tyndall", help="the program (%(default)s)")
    parser.add_argument("--vdb-render", default="vdb_render", help="the program (%(default)s)")
    parser.add_argument("--tyndall-args", action="append", metavar="ARGS", help="options of one contender; repeatable")
    parser.add_argument("--reference-args", default="--estimator tracking", metavar="ARGS", help="(%(default)s)")
    parser.add_argument("--reference-error", type=float, default=0.003, help="its estimated rRMSE (%(default)s)")
    parser.add_argument("--density-scale", type=float, help="extinction per unit of density (median optical depth 5)")
    parser.add_argument("--albedo", type=float, default=0.9, help="(%(default)s)")
    parser.add_argument("--sizes", default=[256, 512], type=int, nargs="+", help="pixels each way (%(default)s)")
    parser.add_argument("--targets", default=[0.05, 0.01], type=float, nargs="+", help="rRMSE (%(default)s)")
    parser.add_argument("--repeats", type=int, default=5, help="rounds of all contenders (%(default)s)")
    parser.add_argument("--max-spp", type=int, default=256, help="beyond it tyndall is extrapolated (%(default)s)")
    parser.add_argument("--marching", action="append", type=setting_from, metavar="K,P,S,C",
                        help="vdb_render: K x K rays per pixel, -step P -shadowstep S -cutoff C; repeatable (a sweep)")
    parser.add_argument("--work", default="build/peers", type=pathlib.Path, help="folder for files (%(default)s)")
    return parser.parse_args(arguments)


def main():
    if sys.argv[1:2] in (["probe"], ["render"]):
        own = vdb_render_scene
        return peer.main("vdb_render.py", __doc__, own.add_options, own.probe, own.render)
    options = parsed(sys.argv[1:])
    try:
        for program, option in ((options.tyndall, "--tyndall"), (options.vdb_render, "--vdb-render")):
            if not shutil.which(program):
                raise Failure(f"{program}: no such program; build or install it, or name it with {option}")
        if options.what == "compare" and not options.volume:
            raise Failure("compare needs a volume: name an OpenVDB file")
        options.work.mkdir(parents=True, exist_ok=True)
        options.work = options.work.resolve()
        tyndall = Tyndall(options.tyndall, options.work)
        good = {"calibrate": calibrate, "compare": compare}[options.what](options, tyndall)
    except (Failure, OSError) as failure:
        sys.exit(f"vdb_render.py: {failure}")
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
