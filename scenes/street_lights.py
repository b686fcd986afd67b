#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes street-lights.json beside itself: a town at night, one lamp on each post. The same file every time."""
import json
import pathlib
import random

BLOCKS = 10  # along each side of the town
PITCH = 30.0  # from street to street, metres
ROAD = 11.0  # width of a street
LAMPS_A_BLOCK = 2  # along a street, on each side of it
HEIGHT = 7.0  # of a lamp


def place(x, z, scale=None):
    """Steps of an instance: a scale, then a place on the ground."""
    steps = [] if scale is None else [{"scale": [round(s, 2) for s in scale]}]
    return steps + [{"translate": [round(x, 2), 0, round(z, 2)]}]


def lamp_places():
    """Along the streets that run away from the camera (x is constant), and along those across (z is constant)."""
    away, across = [], []
    half = BLOCKS * PITCH / 2
    for street in range(BLOCKS + 1):
        middle = street * PITCH - half
        for step in range(BLOCKS * LAMPS_A_BLOCK):
            along = (step + 0.5) * PITCH / LAMPS_A_BLOCK - half
            side = (ROAD / 2 - 1) * (1 if (street + step) % 2 else -1)
            away.append((middle + side, along))
            across.append((along, middle + side))
    return away, across


def house_places(rng):
    half = BLOCKS * PITCH / 2
    house = (PITCH - ROAD) / 2 - 1
    result = []
    for i in range(BLOCKS):
        for j in range(BLOCKS):
            for dx in (-1, 1):
                for dz in (-1, 1):
                    x = (i + 0.5) * PITCH - half + dx * house / 2
                    z = (j + 0.5) * PITCH - half + dz * house / 2
                    result.append(place(x, z, (house - 1, rng.uniform(5, 17), house - 1)))
    return result


def ground(half):
    return {"name": "ground", "type": "quad", "origin": [-half, 0, half], "edge_u": [2 * half, 0, 0],
            "edge_v": [0, 0, -2 * half], "material": "asphalt"}


def lamps(name, places):
    return {"name": name, "type": "sphere", "centre": [0, HEIGHT, 0], "radius": 0.3,
            "instances": [place(x, z) for x, z in places], "material": name}


def scene():
    away, across = lamp_places()
    half = BLOCKS * PITCH
    return {
        "$schema": "../docs/scene.schema.json",
        "name": "street-lights",
        "camera": {"position": [3, 13, 172], "target": [-4, 6.5, 60], "vertical_fov": 36},
        "film": {"size": [400, 300], "exposure": 1, "view": "filmic"},
        "render": {"samples": 128},
        "media": [{
            "name": "mist", "type": "homogeneous", "extinction": 0.009, "albedo": 0.95,
            "phase": {"type": "henyey-greenstein", "g": 0.6},
            "shape": {"type": "box", "min": [-half, 0, -half], "max": [half, 28, half]},
        }],
        "lights": [{"name": "night", "type": "constant", "radiance": [0.004, 0.007, 0.016]}],
        "materials": [
            {"name": "asphalt", "type": "diffuse", "colour": 0.14},
            {"name": "wall", "type": "diffuse", "colour": [0.36, 0.33, 0.3]},
            {"name": "sodium", "type": "diffuse", "colour": 0.5, "emission": [62, 31, 7]},
            {"name": "mercury", "type": "diffuse", "colour": 0.5, "emission": [22, 33, 38]},
        ],
        "objects": [
            ground(half),
            {"name": "house", "type": "box", "min": [-0.5, 0, -0.5], "max": [0.5, 1, 0.5],
             "instances": house_places(random.Random(1)), "material": "wall"},
            {"name": "post", "type": "box", "min": [-0.08, 0, -0.08], "max": [0.08, HEIGHT, 0.08],
             "instances": [place(x, z) for x, z in away + across], "material": "wall"},
            lamps("sodium", away),
            lamps("mercury", across),
        ],
    }


def text(value, indent=0):
    """JSON with one short element a line."""
    line = json.dumps(value)
    if not isinstance(value, (dict, list)) or len(line) + indent <= 118:
        return line
    pad = " " * (indent + 2)
    if isinstance(value, list):
        items = [text(item, indent + 2) for item in value]
        return "[\n" + ",\n".join(pad + item for item in items) + "\n" + " " * indent + "]"
    items = [json.dumps(key) + ": " + text(item, indent + 2) for key, item in value.items()]
    return "{\n" + ",\n".join(pad + item for item in items) + "\n" + " " * indent + "}"


if __name__ == "__main__":
    target = pathlib.Path(__file__).with_name("street-lights.json")
    head = "// A town at night in mist: hundreds of lamps, of which each point asks the few that matter. Written by\n"
    target.write_text(head + "// street_lights.py, which lists the places of lamps, posts and houses.\n" + text(scene()) + "\n")
