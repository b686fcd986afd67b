# SPDX-License-Identifier: Apache-2.0
"""Scenes in two languages: Tyndall's JSON and Mitsuba's dictionaries. README.md says how conventions map."""
import dataclasses

import numpy

import vdb_grid

GOLD = ([0.143, 0.375, 1.442], [3.983, 2.386, 1.603])


@dataclasses.dataclass
class Pair:
    """One scene as both programs read it; the camera and the film are added by `complete`."""

    ours: dict
    theirs: dict
    camera: tuple  # position, target, vertical field of view in degrees
    samples: int  # per pixel and replicate, both programs
    integrator: str = "volpath"
    depth: int = 0  # scattering events at most, 0 = unlimited


class Builder:
    """Adds each thing to both scenes. `mi` is the module mitsuba, its variant chosen."""

    def __init__(self, mi):
        self.mi, self.materials, self.objects, self.media, self.lights = mi, [], [], [], []
        self.bsdfs, self.theirs = {}, {}

    def add(self, plugin):
        self.theirs[f"thing{len(self.theirs)}"] = plugin

    def matrix(self, columns):
        """Mitsuba's transform with these images of the unit vectors and of the origin."""
        rows = numpy.identity(4)
        rows[:3, :] = numpy.array(columns, float).T
        return self.mi.ScalarTransform4f(rows.tolist())

    def rgb(self, value):
        """A colour; one number stays grey. `unbounded`: Mitsuba refuses reflectances above 1 otherwise."""
        if isinstance(value, (int, float)):
            return float(value)
        return {"type": "srgb", "color": [float(v) for v in value], "unbounded": True}

    def power(self, value):
        return {"type": "rgb", "value": [float(v) for v in value]}

    def material(self, name, bsdf, **keys):
        """`bsdf` None: no surface at all."""
        self.materials.append({"name": name, **keys})
        self.bsdfs[name] = bsdf

    def diffuse(self, name, colour):
        bsdf = {"type": "diffuse", "reflectance": self.rgb(colour)}
        self.material(name, {"type": "twosided", "bsdf": bsdf}, type="diffuse", colour=colour)

    def lamp(self, name, radiance):
        """Black but for what it emits, on its front alone."""
        self.material(name, {"type": "diffuse", "reflectance": 0.0}, type="diffuse", colour=0, emission=radiance)
        self.bsdfs[name, "emitter"] = {"type": "area", "radiance": self.power(radiance)}

    def shape(self, material, ours, theirs):
        self.objects.append({**ours, "material": material})
        theirs = {**theirs, "bsdf": self.bsdfs[material]}
        if (material, "emitter") in self.bsdfs:
            theirs["emitter"] = self.bsdfs[material, "emitter"]
        self.add(theirs)

    def quad(self, material, origin, edge_u, edge_v):
        """Mitsuba's rectangle is [-1, 1]^2 in x and y, facing +z."""
        o, u, v = (numpy.array(vector, float) for vector in (origin, edge_u, edge_v))
        to_world = self.matrix([u / 2, v / 2, numpy.cross(u, v) / 4, o + u / 2 + v / 2])
        ours = {"type": "quad", "origin": origin, "edge_u": edge_u, "edge_v": edge_v}
        self.shape(material, ours, {"type": "rectangle", "to_world": to_world})

    def cube(self, low, high):
        """Mitsuba's cube is [-1, 1]^3."""
        low, high = numpy.array(low, float), numpy.array(high, float)
        columns = [*numpy.diag((high - low) / 2), (low + high) / 2]
        return {"type": "cube", "to_world": self.matrix(columns)}

    def box(self, material, low, high):
        self.shape(material, {"type": "box", "min": low, "max": high}, self.cube(low, high))

    def sphere(self, material, centre, radius, medium=None):
        """@param medium (ours, theirs) of what fills it."""
        ours = {"type": "sphere", "centre": centre, "radius": radius}
        theirs = {"type": "sphere", "center": centre, "radius": radius}
        if medium:
            self.media.append({**medium[0], "name": "inside", "shape": {"type": "objects"}})
            ours["medium"], theirs["interior"] = "inside", medium[1]
        self.shape(material, ours, theirs)

    def fog(self, sigma_t, albedo, g, colour=1):
        """A homogeneous medium, (ours, theirs)."""
        ours = {"type": "homogeneous", "extinction": sigma_t, "extinction_colour": colour, "albedo": albedo}
        ours["phase"] = {"type": "henyey-greenstein", "g": g}
        theirs = {"type": "homogeneous", "scale": float(sigma_t), "sigma_t": self.rgb(colour)}
        theirs |= {"albedo": self.rgb(albedo), "phase": {"type": "hg", "g": g}}
        return ours, theirs

    def fog_in(self, low, high, fog):
        """Fills a box with it; the box itself is not seen."""
        self.media.append({**fog[0], "shape": {"type": "box", "min": low, "max": high}})
        self.add({**self.cube(low, high), "bsdf": {"type": "null"}, "interior": fog[1]})

    def light(self, ours, theirs):
        self.lights.append(ours)
        self.add(theirs)

    def pair(self, camera, samples, **keys):
        ours = {"materials": self.materials, "objects": self.objects, "media": self.media, "lights": self.lights}
        return Pair(ours, self.theirs, camera, samples, **keys)


def room(build):
    """A box without its front, 2 x 2 x 2, standing on y = 0, with a block in it and a lamp below its ceiling."""
    build.diffuse("white", 0.73)
    build.diffuse("red", [0.65, 0.05, 0.05])
    build.diffuse("green", [0.12, 0.45, 0.15])
    build.lamp("lamp", [15, 12, 8])
    build.quad("white", [-1, 0, 1], [2, 0, 0], [0, 0, -2])
    build.quad("white", [-1, 2, -1], [2, 0, 0], [0, 0, 2])
    build.quad("white", [-1, 0, -1], [2, 0, 0], [0, 2, 0])
    build.quad("red", [-1, 0, 1], [0, 0, -2], [0, 2, 0])
    build.quad("green", [1, 0, -1], [0, 0, 2], [0, 2, 0])
    build.box("white", [-0.6, 0.02, -0.5], [-0.1, 0.9, 0.1])
    build.quad("lamp", [-0.35, 1.9, -0.35], [0.7, 0, 0], [0, 0, 0.7])
    return ([0, 1, 3.9], [0, 1, 0], 40)


def fog_room(build, _):
    camera = room(build)
    build.fog_in([-0.99, 0.01, -0.99], [0.99, 1.99, 0.99], build.fog(0.8, 0.9, 0.3))
    return build.pair(camera, 96)


def dark_room(build, _):
    """The room alone, three events at most: how both count depth."""
    return build.pair(room(build), 128, integrator="path", depth=3)


def noise(shape):
    """Random waves in [0, 1], smooth over a few voxels, with zeros between."""
    random = numpy.random.default_rng(7)
    points = numpy.stack(numpy.meshgrid(*(numpy.arange(n) for n in shape), indexing="ij"), -1)
    waves = sum(numpy.cos(points @ random.normal(0, 0.35, 3) + random.uniform(0, 6.3)) for _ in range(12))
    return numpy.clip(waves / 4, 0, 1).astype(numpy.float32)


def grid_cloud(build, work, depth=0):
    """Sun and constant sky on a grid. Around it Mitsuba gets one voxel of zeros, to which our field falls."""
    values, first, voxel, scale = noise((24, 20, 28)), (5, 0, 3), 0.1, 9.0
    file = work / "cloud.vdb"
    file.write_bytes(vdb_grid.vdb_file(values, first, voxel))
    phase = {"type": "henyey-greenstein", "g": 0.5}
    medium = {"type": "grid", "file": str(file), "density_scale": scale, "albedo": 0.95, "storage": "float"}
    build.media.append({**medium, "phase": phase})
    # Its voxel centres are at half voxels of the box: index k - 1.5 at the edge has index k - 1 half a voxel inside.
    low = [voxel * (a - 1.5) for a in first]
    high = [voxel * (a + n + 0.5) for a, n in zip(first, values.shape)]
    zyx = numpy.ascontiguousarray(numpy.pad(values, 1).transpose(2, 1, 0)[..., None])
    columns = [*numpy.diag(numpy.array(high) - low), low]  # of its unit cube
    grid = {"type": "gridvolume", "grid": build.mi.VolumeGrid(zyx), "to_world": build.matrix(columns)}
    grid |= {"filter_type": "trilinear", "wrap_mode": "clamp", "raw": True}
    interior = {"type": "heterogeneous", "sigma_t": grid, "scale": scale, "albedo": 0.95}
    interior["phase"] = {"type": "hg", "g": 0.5}
    build.add({**build.cube(low, high), "bsdf": {"type": "null"}, "interior": interior})
    direction, sun = [-0.5, -0.8, -0.4], [2.5, 2.2, 1.8]
    build.light(
        {"type": "sun", "direction": direction, "irradiance": sun, "angular_diameter": 0},
        {"type": "directional", "direction": direction, "irradiance": build.power(sun)},
    )
    sky = [0.2, 0.3, 0.5]
    build.light({"type": "constant", "radiance": sky}, {"type": "constant", "radiance": build.power(sky)})
    return build.pair(([5.2, 3.4, 6.6], [1.7, 0.95, 1.7], 32), 96, depth=depth)


def grid_once(build, work):
    """The same with one event at most: what the march and tracking render, too."""
    return grid_cloud(build, work, depth=1)


def metal_and_glass(build, _, roughness=0.3):
    """Gold, rough and smooth glass on a matt floor under a lamp. alpha = roughness^2."""
    alpha, (eta, k) = roughness**2, GOLD
    rough = {"distribution": "ggx", "alpha": alpha, "sample_visible": True}
    build.diffuse("floor", [0.5, 0.45, 0.4])
    build.lamp("lamp", [4, 3.5, 3])
    gold = {"type": "roughconductor", "eta": build.rgb(eta), "k": build.rgb(k), **rough}
    build.material("gold", gold, type="conductor", eta=eta, k=k, roughness=roughness)
    index = {"int_ior": 1.5, "ext_ior": 1.0}  # unless told, the outside is air of 1.000277
    build.material("frosted", {"type": "roughdielectric", **index, **rough}, type="dielectric", roughness=roughness)
    build.material("glass", {"type": "dielectric", **index}, type="dielectric")
    build.quad("floor", [-4, 0, 3], [8, 0, 0], [0, 0, -6])
    build.sphere("gold", [-1.4, 0.6, 0], 0.6)
    build.sphere("frosted", [0, 0.6, 0], 0.6)
    build.sphere("glass", [1.4, 0.6, 0], 0.6)
    build.quad("lamp", [-2, 3, -1.5], [4, 0, 0], [0, 0, 3])
    sky = [0.2, 0.25, 0.3]
    build.light({"type": "constant", "radiance": sky}, {"type": "constant", "radiance": build.power(sky)})
    return build.pair(([0, 1.8, 5.2], [0, 0.6, 0], 38), 512, integrator="path")


def tea(build, _):
    """A ball of water with a chromatic medium inside, a matt ball behind it."""
    build.diffuse("floor", 0.6)
    build.lamp("lamp", [5, 5, 5])
    build.material("water", {"type": "dielectric", "int_ior": 1.33, "ext_ior": 1.0}, type="dielectric", ior=1.33)
    build.quad("floor", [-3, 0, 3], [6, 0, 0], [0, 0, -6])
    build.sphere("water", [0, 0.8, 0], 0.8, build.fog(3, [0.95, 0.9, 0.8], 0.6, [0.4, 0.7, 1]))
    build.sphere("floor", [-1.2, 0.5, -1], 0.5)
    build.quad("lamp", [-1.5, 2.8, -1.5], [3, 0, 0], [0, 0, 3])
    sky = [0.3, 0.35, 0.4]
    build.light({"type": "constant", "radiance": sky}, {"type": "constant", "radiance": build.power(sky)})
    return build.pair(([0, 1.4, 4.2], [0, 0.75, 0], 36), 128, integrator="volpathmis")


def spot_in_haze(build, _):
    """A spot with a sharp edge (between its two angles the programs fall off differently) onto absorbing red haze.

    It hangs above the haze: 1 / r^2 from within would give pictures whose variance has no bound.
    """
    build.diffuse("floor", [0.6, 0.5, 0.4])
    build.quad("floor", [-3, 0, 3], [6, 0, 0], [0, 0, -6])
    build.fog_in([-2, 0.01, -2], [2, 2.5, 2], build.fog(0.7, [0.9, 0.8, 0.6], -0.2, [1, 0.8, 0.5]))
    position, target, angle, intensity = [-1.2, 3.3, 0.8], [0.3, 0, 0], 16.0, [60, 60, 60]
    direction = [b - a for a, b in zip(position, target)]
    ours = {"type": "spot", "position": position, "direction": direction, "intensity": intensity}
    ours |= {"outer_angle": angle, "inner_angle": angle}
    to_world = build.mi.ScalarTransform4f.look_at(origin=position, target=target, up=[0, 0, 1])
    theirs = {"type": "spot", "to_world": to_world, "cutoff_angle": angle, "beam_width": angle}
    build.light(ours, {**theirs, "intensity": build.power(intensity)})
    return build.pair(([0, 1.6, 5.5], [0, 0.9, 0], 40), 192, integrator="volpathmis")


SCENES = {
    "dark-room": dark_room,
    "fog-room": fog_room,
    "grid-once": grid_once,
    "grid-cloud": grid_cloud,
    "metal-and-glass": metal_and_glass,
    "tea": tea,
    "spot-in-haze": spot_in_haze,
}
