# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: the node trees of media, surfaces and environments. README.md maps the conventions."""
import math

import bpy


class Shader:
    """A node tree with nothing in it but its output."""

    def __init__(self, owner, output):
        owner.use_nodes = True
        self.owner, self.tree = owner, owner.node_tree
        self.tree.nodes.clear()
        self.end = self.tree.nodes.new(output)

    @classmethod
    def of_material(cls, name):
        return cls(bpy.data.materials.new(name), "ShaderNodeOutputMaterial")

    @classmethod
    def of_world(cls, world):
        return cls(world, "ShaderNodeOutputWorld")

    def node(self, kind, properties=(), **inputs):
        """A node with properties and inputs, which are values or sockets; underscores stand for blanks."""
        made = self.tree.nodes.new("ShaderNode" + kind)
        for key, value in dict(properties).items():
            setattr(made, key, value)
        for key, value in inputs.items():
            self.put(made.inputs[key.replace("_", " ")], value)
        return made

    def put(self, socket, value):
        if isinstance(value, bpy.types.NodeSocket):
            self.tree.links.new(value, socket)
        else:
            socket.default_value = value

    def math(self, operation, a, b):
        made = self.node("Math", {"operation": operation})
        self.put(made.inputs[0], a)
        self.put(made.inputs[1], b)
        return made.outputs[0]

    def sum(self, shaders):
        """Of closures; None of none."""
        total = shaders[0] if shaders else None
        for shader in shaders[1:]:
            made = self.tree.nodes.new("ShaderNodeAddShader")
            self.put(made.inputs[0], total)
            self.put(made.inputs[1], shader)
            total = made.outputs[0]
        return total

    def output(self, name, shader):
        if shader is not None:
            self.put(self.end.inputs[name], shader)


def colour(values):
    return [*values, 1.0]


def medium_shader(shader, medium):
    """Scattering is colour times density of one closure, absorption 1 less colour, times density, of another."""
    sigma_t, albedo = medium["sigma_t"], medium["albedo"]
    most = max(sigma_t)
    if most == 0:
        return None
    density = most
    if medium["shape"]["type"] == "grid":
        attribute = shader.node("Attribute", {"attribute_name": "density"})
        density = shader.math("MULTIPLY", attribute.outputs["Fac"], most)
    scattered = [w * s / most for w, s in zip(albedo, sigma_t)]
    g = medium["phase"].get("g", 0.0)
    closures = [shader.node("VolumeScatter", Color=colour(scattered), Density=density, Anisotropy=g).outputs[0]]
    kept = [1 - (1 - w) * s / most for w, s in zip(albedo, sigma_t)]
    if kept != [1, 1, 1]:
        closures.append(shader.node("VolumeAbsorption", Color=colour(kept), Density=density).outputs[0])
    return shader.sum(closures)


def surface_shader(shader, material):
    kind, roughness = material["type"], material.get("roughness", 0.0)
    own = colour(material["colour"])
    if kind == "diffuse":
        closures = [shader.node("BsdfDiffuse", Color=own, Roughness=0.0)]
    elif kind == "dielectric":
        distribution = {"distribution": "GGX" if roughness else "SHARP"}
        closures = [shader.node("BsdfGlass", distribution, Color=own, Roughness=roughness, IOR=material["ior"])]
    else:  # a metal of Schlick's reflectance
        metal = {"Base_Color": own, "Metallic": 1.0, "Roughness": roughness}
        closures = [shader.node("BsdfPrincipled", {"distribution": "GGX"}, **metal)]
    closures = [node.outputs[0] for node in closures]
    if any(material["emission"]):
        closures.append(emission(shader, material))
    return shader.sum(closures)


def emission(shader, material):
    """Radiance, on the front alone unless it is told otherwise."""
    strength = 1.0
    if not material["two_sided"]:
        back = shader.tree.nodes.new("ShaderNodeNewGeometry").outputs["Backfacing"]
        strength = shader.math("SUBTRACT", 1.0, back)
    most = max(material["emission"])
    strength = shader.math("MULTIPLY", strength, most)
    own = colour([value / most for value in material["emission"]])
    return shader.node("Emission", Color=own, Strength=strength).outputs[0]


def world_shader(shader, lights, scene):
    """The sum of the environments; what the camera must not see is black to its rays."""
    closures = []
    for light in lights:
        if light["type"] == "sun":
            continue
        strength = 1.0
        if not light["visible"]:
            camera = shader.tree.nodes.new("ShaderNodeLightPath").outputs["Is Camera Ray"]
            strength = shader.math("SUBTRACT", 1.0, camera)
        own = colour(light["radiance"]) if light["type"] == "constant" else environment(shader, light, scene)
        closures.append(shader.node("Background", Color=own, Strength=strength).outputs[0])
    return shader.sum(closures)


def environment(shader, light, scene):
    """Blender's map has +x in the middle, -y right of it, and +z on top; ours -z, +x and +y."""
    image = bpy.data.images.load(scene.file(light["file"]))
    image.colorspace_settings.name = "Linear"
    way = shader.node("SeparateXYZ", Vector=shader.tree.nodes.new("ShaderNodeTexCoord").outputs["Generated"])
    x, y, z = (way.outputs[axis] for axis in "XYZ")
    minus_x, minus_z = (shader.math("MULTIPLY", axis, -1.0) for axis in (x, z))
    turned = shader.node("CombineXYZ", X=minus_z, Y=minus_x, Z=y).outputs[0]
    rotation = [0.0, 0.0, -math.radians(light["rotation"])]
    mapped = shader.node("Mapping", {"vector_type": "POINT"}, Vector=turned, Rotation=rotation).outputs[0]
    texture = shader.node("TexEnvironment", {"image": image, "interpolation": "Linear"}, Vector=mapped)
    return texture.outputs["Color"]
