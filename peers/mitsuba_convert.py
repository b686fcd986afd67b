# SPDX-License-Identifier: Apache-2.0
"""From the scene that `tyndall export` wrote to Mitsuba's dictionaries. README.md says how conventions map."""
import math

import numpy

import peer
from mitsuba_place import matrix, object_bounds, ply, recentre
from peer import Unsayable
from pictures import read_exr

DELTA_SUN = 0.01  # degrees: below it Tyndall's suns are directions, too
FAR = 1e4  # distance of a sun's disc, in radii of the scene: its directions differ by a ten-thousandth over the scene
OPAQUE = 40  # optical depths after which nothing is left of an unbounded medium
GROWN = 1e-4  # share by which a medium's bounds are moved out, where surfaces might lie in the same plane
SMOOTHEST = 0.1  # roughness of Mitsuba's "principled" that still is a lobe


class Converter:
    """Makes one dictionary. `mi` is the module mitsuba, its variant chosen."""

    def __init__(self, mi, scene):
        self.mi, self.source, self.plugins = mi, scene, {}
        self.camera_medium = None
        self.boxes = []  # (world bounds, name) of what holds a medium
        self.bounds = []  # of everything with a place, one array each

    def scene(self):
        """The whole scene. Raises Unsayable with the feature that Mitsuba lacks."""
        self.own_from_world = recentre(self.mi, self.source)
        media = self.source.media
        self.names = [f"medium{i}" for i in range(len(media))]
        for name, medium in zip(self.names, media):
            self.plugins[name] = self.medium(medium)
        for i, thing in enumerate(self.source.objects):
            self.plugins[f"object{i}"] = self.object(thing)
        for name, medium in zip(self.names, media):
            self.add_container(name, medium)
        self.refuse_overlaps()
        for i, light in enumerate(self.source.lights):
            self.plugins[f"light{i}"] = self.light(light)
        # The sensor names a medium, which has to stand before it.
        return {"type": "scene", "integrator": self.integrator(), **self.plugins, "sensor": self.sensor()}

    def add(self, name, plugin):
        self.plugins[name] = plugin

    # Values

    def matrix(self, rows):
        return matrix(self.mi, rows)

    def colour(self, value):
        """Mitsuba refuses reflectances above 1 (of eta, say) otherwise."""
        return {"type": "srgb", "color": [float(v) for v in value], "unbounded": True}

    def power(self, value):
        return {"type": "rgb", "value": [float(v) for v in value]}

    def saw(self, points):
        self.bounds.append(numpy.array(points, float))

    # Media

    def medium(self, medium):
        shape, sigma_t = medium["shape"], medium["sigma_t"]
        common = {"albedo": self.colour(medium["albedo"]), "phase": self.phase(medium["phase"])}
        if shape["type"] != "grid":
            return {"type": "homogeneous", "sigma_t": self.colour(sigma_t), **common}
        return {"type": "heterogeneous", "sigma_t": self.grid(shape, sigma_t), "scale": 1.0, **common}

    def grid(self, shape, sigma_t):
        """Voxel centres lie at half voxels of its unit cube; around them it gets the zeros that our field falls to."""
        nx, ny, nz = shape["size"]
        values = numpy.fromfile(self.source.file(shape["values"]), "<f4").reshape(nz, ny, nx)
        padded = numpy.pad(values, 1)[..., None] * numpy.array(sigma_t if chromatic(sigma_t) else sigma_t[:1], "f4")
        index_from_unit = numpy.diag([nx + 2, ny + 2, nz + 2, 1.0])
        index_from_unit[:3, 3] = numpy.array(shape["index_min"]) - 1.5
        to_world = numpy.array(shape["world_from_index"]).reshape(4, 4) @ index_from_unit
        grid = self.mi.VolumeGrid(numpy.ascontiguousarray(padded))
        return {"type": "gridvolume", "grid": grid, "to_world": self.matrix(to_world), "filter_type": "trilinear",
                "wrap_mode": "clamp", "raw": True}

    def phase(self, phase):
        kind = phase["type"]
        if kind in ("isotropic", "rayleigh"):
            return {"type": kind}
        if kind == "henyey-greenstein":
            return {"type": "hg", "g": phase["g"]}
        if kind == "two-lobe":
            lobes = [{"type": "hg", "g": phase[g]} for g in ("g1", "g2")]
            return {"type": "blendphase", "a": lobes[0], "b": lobes[1], "weight": 1 - phase["weight"]}
        raise Unsayable(f"the phase function {kind}")

    def add_container(self, name, medium):
        """A shape without a surface that holds the medium; inside objects there is one already."""
        shape, kind = medium["shape"], medium["shape"]["type"]
        if kind == "objects":
            return
        if kind == "unbounded":
            return self.add_unbounded(name, medium)
        grown = GROWN if self.source.objects and kind != "grid" else 0
        if kind == "sphere":
            matrix, scale = shape["world_from_medium"], peer.similarity(shape["world_from_medium"])
            if not scale:
                raise Unsayable("a sphere of a medium that is not one in the world")
            centre, radius = peer.apply(matrix, shape["centre"]), shape["radius"] * scale * (1 + grown)
            body = {"type": "sphere", "center": centre, "radius": radius}
            box = numpy.array([numpy.array(centre) - radius, numpy.array(centre) + radius])
            inside = math.dist(centre, self.source.camera["position"]) < radius
        else:
            body, box, inside = self.cube(shape, grown)
        self.hold(name, box, inside)
        self.add(name + "_shape", {**body, "bsdf": {"type": "null"}, "interior": {"type": "ref", "id": name}})

    def cube(self, shape, grown):
        """(plugin, world bounds, whether the camera is inside) of a box or of what a grid reaches."""
        grid = shape["type"] == "grid"
        low, high = peer.grid_bounds(shape) if grid else (shape["min"], shape["max"])
        matrix = shape["world_from_index" if grid else "world_from_medium"]
        world_from_own = numpy.array(matrix, float).reshape(4, 4)
        low, high = numpy.array(low, float), numpy.array(high, float)
        own_from_unit = numpy.diag([*((high - low) / 2 * (1 + grown)), 1.0])
        own_from_unit[:3, 3] = (low + high) / 2
        if numpy.linalg.det(world_from_own) < 0:  # mirrored, its inside would be outside
            own_from_unit[:, 0] *= -1
        world_from_unit = world_from_own @ own_from_unit
        corners = [peer.apply(world_from_unit.ravel(), corner) for corner in peer.corners([-1] * 3, [1] * 3)]
        place = numpy.linalg.inv(world_from_unit) @ numpy.array([*self.source.camera["position"], 1.0])
        box = numpy.array([numpy.min(corners, 0), numpy.max(corners, 0)])
        return {"type": "cube", "to_world": self.matrix(world_from_unit)}, box, bool((abs(place[:3]) < 1).all())

    def add_unbounded(self, name, medium):
        """A ball around everything with a place, out to where nothing comes back from."""
        if not min(medium["sigma_t"]):
            raise Unsayable("an unbounded medium that is clear in a channel")
        places = [light["position"] for light in self.source.lights if "position" in light]
        points = numpy.concatenate([*self.bounds, [self.source.camera["position"], *places]])
        centre = points.mean(0)
        reach = numpy.linalg.norm(points - centre, axis=1).max() + OPAQUE / min(medium["sigma_t"])
        self.hold(name, numpy.array([centre - reach, centre + reach]), True)
        body = {"type": "sphere", "center": centre.tolist(), "radius": float(reach), "bsdf": {"type": "null"}}
        self.add(name + "_shape", {**body, "interior": {"type": "ref", "id": name}})

    def hold(self, name, box, inside):
        self.boxes.append((box, name))
        self.saw(box)
        if inside:
            self.camera_medium = name

    def refuse_overlaps(self):
        for i, (a, _) in enumerate(self.boxes):
            if any(peer.overlap(a, b) for b, _ in self.boxes[:i]):
                raise Unsayable("media whose bounds overlap")

    # Surfaces

    def object(self, thing):
        material = self.source.materials[thing["material"]]
        if thing["type"] == "mesh":
            plugin = ply(self.mi, self.source, thing, self.own_from_world)
        else:
            plugin = {"type": "sphere", "center": thing["centre"], "radius": thing["radius"]}
        box = object_bounds(self.mi, self.source, thing, self.own_from_world)
        self.saw(box)
        if thing["medium"] is not None:
            position = numpy.array(self.source.camera["position"])
            if (box[0] < position).all() and (position < box[1]).all():
                raise Unsayable("a camera inside an object that a medium fills")
            self.boxes.append((box, None))
            plugin["interior"] = {"type": "ref", "id": self.names[thing["medium"]]}
        plugin["bsdf"] = self.bsdf(material)
        if self.source.shines(thing):
            if material["two_sided"]:
                raise Unsayable("surfaces that shine on both sides")
            plugin["emitter"] = {"type": "area", "radiance": self.power(material["emission"])}
        return plugin

    def bsdf(self, material):
        kind, roughness = material["type"], material.get("roughness", 0)
        rough = {"distribution": "ggx", "alpha": roughness**2} if roughness else {}
        if kind == "null":
            return {"type": "null"}
        if kind == "dielectric":
            glass = {"int_ior": material["ior"], "ext_ior": 1.0}  # unless told, the outside is air of 1.000277
            tint = {"specular_transmittance": self.colour(material["colour"])}
            return {"type": "roughdielectric" if rough else "dielectric", **glass, **tint, **rough}
        return {"type": "twosided", "bsdf": self.opaque(material, rough)}

    def opaque(self, material, rough):
        kind, roughness = material["type"], material.get("roughness", 0)
        if kind == "diffuse":
            return {"type": "diffuse", "reflectance": self.colour(material["colour"])}
        if kind == "conductor" and any(material["k"]):
            optics = {"eta": self.colour(material["eta"]), "k": self.colour(material["k"])}
            return {"type": "roughconductor" if rough else "conductor", **optics, **rough}
        if kind == "metal_rough" and material["metallic"] < 1:
            raise Unsayable("metal_rough that is not all metal")
        if roughness < SMOOTHEST:
            raise Unsayable("a smooth metal of Schlick's reflectance")
        metal = {"metallic": 1.0, "roughness": roughness, "specular": 0.5}
        return {"type": "principled", "base_color": self.colour(material["colour"]), **metal}

    # Lights

    def light(self, light):
        kind = light["type"]
        if kind == "point":
            return {"type": "point", "position": light["position"], "intensity": self.power(light["intensity"])}
        if kind == "spot":
            return self.spot(light)
        if kind == "sun":
            return self.sun(light)
        if sum(other["type"] in ("constant", "map") for other in self.source.lights) > 1:
            raise Unsayable("more than one environment")
        if kind == "constant":
            return {"type": "constant", "radiance": self.power(light["radiance"])}
        return self.map(light)

    def spot(self, light):
        if light["inner_angle"] != light["outer_angle"]:
            raise Unsayable("a spot whose edge is soft")
        position, direction = numpy.array(light["position"]), numpy.array(light["direction"])
        up = numpy.identity(3)[abs(direction).argmin()].tolist()
        to_world = self.mi.ScalarTransform4f.look_at(
            origin=position.tolist(), target=(position + direction).tolist(), up=up
        )
        angle = light["outer_angle"]
        shape = {"to_world": to_world, "cutoff_angle": angle, "beam_width": angle}
        return {"type": "spot", **shape, "intensity": self.power(light["intensity"])}

    def sun(self, light):
        """One with a size is a far disc that shines on its front alone."""
        if light["angular_diameter"] < DELTA_SUN:
            irradiance = self.power(light["irradiance"])
            return {"type": "directional", "direction": light["direction"], "irradiance": irradiance}
        points = numpy.concatenate([*self.bounds, [self.source.camera["position"]]])
        centre, direction = (points.min(0) + points.max(0)) / 2, numpy.array(light["direction"])
        distance = FAR * max(numpy.linalg.norm(points - centre, axis=1).max(), 1e-6)
        half = math.radians(light["angular_diameter"] / 2)
        up = numpy.identity(3)[abs(direction).argmin()].tolist()
        origin = (centre - distance * direction).tolist()
        to_world = self.mi.ScalarTransform4f.look_at(origin=origin, target=centre.tolist(), up=up)
        to_world = to_world @ self.mi.ScalarTransform4f.scale(distance * math.tan(half))
        radiance = [value / (math.pi * math.sin(half) ** 2) for value in light["irradiance"]]
        emitter = {"type": "area", "radiance": self.power(radiance)}
        black = {"type": "diffuse", "reflectance": 0.0}
        return {"type": "disk", "to_world": to_world, "emitter": emitter, "bsdf": black}

    def map(self, light):
        """Mitsuba's first and last row lie at the poles: twice as many, at ours and between them, are the same map.

        Along a row its texels lie as ours do, but the first ones at -z, half a turn from ours.
        """
        width, height = light["size"]
        channels = read_exr(self.source.file(light["file"]))
        rows = numpy.stack([numpy.array(channels[name]).reshape(height, width) for name in "RGB"], -1)
        rows = between(numpy.concatenate([rows[:1], rows, rows[-1:]]))[1:-1]
        bitmap = self.mi.Bitmap(numpy.ascontiguousarray(rows.astype("f4")))
        to_world = self.mi.ScalarTransform4f.rotate(axis=[0, 1, 0], angle=light["rotation"] + 180)
        return {"type": "envmap", "bitmap": bitmap, "to_world": to_world}

    # Camera and paths

    def sensor(self):
        camera, (width, height) = self.source.camera, self.source.size
        position = numpy.array(camera["position"])
        target = (position + numpy.array(camera["forward"])).tolist()
        to_world = self.mi.ScalarTransform4f.look_at(origin=position.tolist(), target=target, up=camera["up"])
        film = {"type": "hdrfilm", "width": width, "height": height, "rfilter": {"type": "box"}, "pixel_format": "rgb",
                "component_format": "float32"}
        sensor = {"film": film, "sampler": {"type": "independent"}, "near_clip": 1e-3, "far_clip": 1e9}
        if camera["type"] == "orthographic":
            half = camera["height"] * width / height / 2  # its picture is 2 wide
            sensor |= {"type": "orthographic", "to_world": to_world @ self.mi.ScalarTransform4f.scale([half, half, 1])}
        else:
            sensor |= {"type": "perspective", "fov": camera["vertical_fov"], "fov_axis": "y", "to_world": to_world}
        if camera.get("lens_radius"):
            lens = {"aperture_radius": camera["lens_radius"], "focus_distance": camera["focus_distance"]}
            sensor |= {"type": "thinlens", **lens}
        if self.camera_medium:
            sensor["medium"] = {"type": "ref", "id": self.camera_medium}
        return sensor

    def integrator(self):
        media = self.source.media
        kind = "volpath" if media else "path"
        if any(chromatic(medium["sigma_t"]) for medium in media):
            kind = "volpathmis"
        # It counts the edges of a path, the last one to a light included; events are one fewer.
        depth = self.source.depth + 1 if self.source.depth else -1
        return {"type": kind, "max_depth": depth, "hide_emitters": self.hidden()}

    def hidden(self):
        """Mitsuba hides all emitters from the camera or none."""
        seen = [light["visible"] for light in self.source.lights if "visible" in light and not delta(light)]
        seen += [True for thing in self.source.objects if self.source.shines(thing)]
        if any(seen) and not all(seen):
            raise Unsayable("some lights that the camera sees and some that it does not")
        return not any(seen)


def delta(light):
    return light["type"] == "sun" and light["angular_diameter"] < DELTA_SUN


def chromatic(sigma_t):
    return len(set(sigma_t)) > 1


def between(rows):
    """The rows with the means of neighbours between them: n -> 2 n - 1."""
    doubled = numpy.repeat(rows, 2, axis=0)[:-1]
    doubled[1::2] = (rows[1:] + rows[:-1]) / 2
    return doubled
