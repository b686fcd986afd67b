#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes lamps.json beside itself: small lamps of many strengths over a floor. The same file every time."""
import json
import pathlib
import random

SIDE = 16  # lamps along each side of the field
PITCH = 1.0  # from lamp to lamp, metres
RADIUS = 0.03
COLOURS = {"warm": [240, 130, 50], "white": [150, 150, 150], "cold": [50, 110, 240]}


def lamp_places(rng):
    """A colour's name to its lamps' places: one lamp anywhere in each cell of a grid."""
    places = {name: [] for name in COLOURS}
    for i in range(SIDE):
        for j in range(SIDE):
            x = (i + rng.random() - SIDE / 2) * PITCH
            z = (j + rng.random() - SIDE / 2) * PITCH
            height = rng.uniform(0.15, 1.2)
            places[rng.choice(list(COLOURS))].append([round(x, 2), round(height, 2), round(z, 2)])
    return places


def lamps(name, places):
    instances = ",\n".join(f'        [{{ "translate": {json.dumps(place)} }}]' for place in places)
    return (f'    {{\n      "name": "{name}",\n      "type": "sphere",\n      "radius": {RADIUS},\n'
            f'      "material": "{name}",\n      "instances": [\n{instances},\n      ],\n    }},\n')


def material(name, emission):
    return f'    {{ "name": "{name}", "type": "diffuse", "colour": 0.5, "emission": {json.dumps(emission)} }},\n'


def scene():
    half = SIDE * PITCH / 2
    return f"""// Many small lamps in mist, none of them hidden: each point needs the few that are near. lamps.py writes it.
{{
  "$schema": "../../docs/scene.schema.json",
  "name": "lamps",
  "camera": {{ "position": [0, 3.2, {half + 2.5}], "target": [0, 0.2, 1.5], "vertical_fov": 50 }},
  "film": {{ "size": [128, 128], "exposure": 0, "view": "filmic" }},
  "render": {{ "samples": 64 }},
  "media": [
    {{
      "name": "mist",
      "type": "homogeneous",
      "extinction": 0.05,
      "albedo": 0.95,
      "phase": {{ "type": "henyey-greenstein", "g": 0.5 }},
      "shape": {{ "type": "box", "min": [{-half}, 0, {-half}], "max": [{half}, 2, {half}] }},
    }},
  ],
  "materials": [
    {{ "name": "floor", "type": "diffuse", "colour": 0.5 }},
{"".join(material(name, emission) for name, emission in COLOURS.items())}  ],
  "objects": [
    {{ "name": "floor", "type": "quad", "origin": [{-half}, 0, {half}], "edge_u": [{2 * half}, 0, 0], "edge_v": [0, 0, {-2 * half}], "material": "floor" }},
{"".join(lamps(name, places) for name, places in lamp_places(random.Random(1)).items())}  ],
}}
"""


if __name__ == "__main__":
    pathlib.Path(__file__).with_name("lamps.json").write_text(scene())
