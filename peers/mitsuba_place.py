# SPDX-License-Identifier: Apache-2.0
"""Moves the scene that `tyndall export` wrote to where Mitsuba's arithmetic serves it best."""
import math

import numpy

import peer

REACH = 100  # of the scene from its centre, in Mitsuba's units


def matrix(mi, rows):
    return mi.ScalarTransform4f(numpy.array(rows, float).reshape(4, 4).tolist())


def ply(mi, scene, thing, own_from_world):
    """The plugin of a mesh."""
    shape = {"filename": scene.file(thing["file"]), "face_normals": not thing["normals"]}
    return {"type": "ply", **shape, "to_world": matrix(mi, own_from_world)}


def object_bounds(mi, scene, thing, own_from_world):
    """[lowest corner, highest corner], where it stands now."""
    if thing["type"] == "sphere":
        return numpy.array(thing["centre"]) + numpy.array([[-1.0], [1.0]]) * thing["radius"]
    bounds = mi.load_dict(ply(mi, scene, thing, own_from_world)).bbox()
    return numpy.array([bounds.min, bounds.max], float)


def recentre(mi, scene):
    """Moves the scene to the origin and scales it. Returns the matrix, which meshes have yet to get.

    Mitsuba moves rays off boundaries by 9e-5 (1 + |p|) and forgives light samples for 9e-4 of their distance: where |p|
    is large beside that distance, lamps behind a boundary of a medium are in their own shadow.
    """
    corners = [light["position"] for light in scene.lights if "position" in light]
    for medium in scene.media:
        corners += [corner for corner in peer.medium_bounds(medium["shape"]) if math.isfinite(corner[0])]
    for thing in scene.objects:
        corners += object_bounds(mi, scene, thing, numpy.identity(4)).tolist()
    corners = numpy.array(corners or [scene.camera["position"]])
    low, high = corners.min(0), corners.max(0)
    radius = numpy.linalg.norm(high - low) / 2
    scale = REACH / radius if radius else 1.0
    own_from_world = numpy.diag([scale, scale, scale, 1.0])
    own_from_world[:3, 3] = -scale * (low + high) / 2
    for holder, key in points(scene):
        holder[key] = peer.apply(own_from_world.ravel(), holder[key])
    for holder, key, power in measures(scene):
        holder[key] = (numpy.array(holder[key], float) * scale**power).tolist()
    for shape in (medium["shape"] for medium in scene.media):
        for key in {"world_from_medium", "world_from_index"} & set(shape):
            shape[key] = (own_from_world @ numpy.array(shape[key]).reshape(4, 4)).ravel().tolist()
    return own_from_world


def points(scene):
    """Values that are points in the world, as (dictionary, key)."""
    spheres = [(thing, "centre") for thing in scene.objects if thing["type"] == "sphere"]
    lights = [(light, "position") for light in scene.lights if "position" in light]
    return [(scene.camera, "position"), *spheres, *lights]


def measures(scene):
    """Values that have a length in their unit, as (dictionary, key, power of the length)."""
    camera = [(scene.camera, key, 1) for key in ("lens_radius", "focus_distance", "height") if key in scene.camera]
    spheres = [(thing, "radius", 1) for thing in scene.objects if thing["type"] == "sphere"]
    media = [(medium, "sigma_t", -1) for medium in scene.media]
    lights = [(light, "intensity", 2) for light in scene.lights if "intensity" in light]
    return [*camera, *spheres, *media, *lights]
