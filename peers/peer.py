# SPDX-License-Identifier: Apache-2.0
"""What the peers of `tyndall bench` share: their command line, and the scene that `tyndall export` wrote."""
import argparse
import json
import math
import pathlib
import sys

VERSION = 1  # of the format
FAILED, UNSAYABLE = 1, 3  # exit codes


class Unavailable(Exception):
    """What has to be installed, for the user."""


class Unsayable(Exception):
    """Why the peer cannot render a scene: the name of the feature."""


class Scene:
    """scene.json of a folder; README.md has the format."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder).resolve()
        values = json.loads((self.folder / "scene.json").read_text())
        if values.get("format") != "tyndall-peer-scene" or values["version"] != VERSION:
            raise Unsayable(f"{folder}/scene.json is not of version {VERSION} of tyndall-peer-scene")
        self.camera, self.size, self.depth = values["camera"], values["size"], values["depth"]
        self.media, self.lights = values["media"], values["lights"]
        self.materials, self.objects = values["materials"], values["objects"]

    def file(self, name):
        return str(self.folder / name)

    def shines(self, thing):
        """Whether an object has an emissive material."""
        return any(self.materials[thing["material"]].get("emission", ()))


def apply(matrix, point):
    """A matrix, row by row, times a point."""
    return [sum(matrix[4 * row + i] * point[i] for i in range(3)) + matrix[4 * row + 3] for row in range(3)]


def determinant(matrix):
    (a, b, c, _), (d, e, f, _), (g, h, i, _) = (matrix[row : row + 4] for row in (0, 4, 8))
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)


def similarity(matrix):
    """The factor by which a matrix scales every length, or None where it is not one factor."""
    axes = [[matrix[row + column] for row in (0, 4, 8)] for column in range(3)]
    lengths = [math.hypot(*axis) for axis in axes]
    across = max(abs(sum(p * q for p, q in zip(axes[a], axes[b]))) for a, b in ((0, 1), (0, 2), (1, 2)))
    scale = lengths[0]
    close = max(abs(length - scale) for length in lengths) < 1e-6 * scale and across < 1e-6 * scale**2
    return scale if close else None


def grid_bounds(shape):
    """Corners, in index space, of what a grid's field reaches: it falls to 0 within one voxel of the active box."""
    first, size = shape["index_min"], shape["size"]
    return [a - 1 for a in first], [a + n for a, n in zip(first, size)]


def corners(low, high):
    return [[(low, high)[bit >> axis & 1][axis] for axis in range(3)] for bit in range(8)]


def medium_bounds(shape):
    """(lowest, highest) corner of a medium in the world; infinite where it has no bounds of its own."""
    matrix = shape.get("world_from_medium")
    if shape["type"] == "grid":
        matrix, (low, high) = shape["world_from_index"], grid_bounds(shape)
    elif shape["type"] == "box":
        low, high = shape["min"], shape["max"]
    elif shape["type"] == "sphere":
        low, high = ([c + sign * shape["radius"] for c in shape["centre"]] for sign in (-1, 1))
    else:
        return [-math.inf] * 3, [math.inf] * 3
    points = [apply(matrix, corner) for corner in corners(low, high)]
    return [min(axis) for axis in zip(*points)], [max(axis) for axis in zip(*points)]


def overlap(a, b):
    """Whether two (lowest, highest) corners have space in common."""
    return all(low < high for low, high in (*zip(a[0], b[1]), *zip(b[0], a[1])))


def parsed(description, add_options):
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    commands.add_parser("probe", help="name and version as JSON; exit code 1 and what to install without it")
    render = commands.add_parser("render", help="one picture; exit code 3 and the reason for a scene it cannot do")
    render.add_argument("folder", help="what `tyndall export` wrote")
    render.add_argument("-o", "--output", required=True, metavar="OUT.exr")
    add_options(render)
    return parser.parse_args()


def add_sampling(parser):
    """Options of peers that draw random numbers."""
    parser.add_argument("--spp", type=int, default=64, metavar="N", help="samples per pixel (%(default)s)")
    parser.add_argument("--seed", type=int, default=0, metavar="S", help="of the random numbers (%(default)s)")
    parser.add_argument("--threads", type=int, default=1, metavar="T", help="at most (%(default)s)")


def main(name, description, add_options, probe, render):
    """Runs `probe` or `render FOLDER -o OUT.exr ...`.

    @param probe returns a dict. @param render takes (Scene, options).
    """
    options = parsed(description, add_options)
    try:
        if options.command == "probe":
            print(json.dumps(probe()))
        else:
            render(Scene(options.folder), options)
    except Unsayable as reason:
        print(f"not exportable: {reason}", file=sys.stderr)
        sys.exit(UNSAYABLE)
    except (Unavailable, OSError, RuntimeError) as failure:
        print(f"{name}: {failure}", file=sys.stderr)
        sys.exit(FAILED)
