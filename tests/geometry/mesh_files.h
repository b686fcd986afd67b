// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/model.h"

#include <filesystem>
#include <string>
#include <vector>

/// Small mesh files, made by hand.
namespace tyndall::test {

/// Writes `bytes` to `path` and returns it.
std::filesystem::path write(const std::filesystem::path& path, const std::string& bytes);

/// A picture in the format BMP: 24 bits, rows from the top down, `pixels` as 0xRRGGBB.
std::string bmp(int width, int height, const std::vector<unsigned>& pixels);

/// A square's buffer for glTF: corners (0,0,0) (1,0,0) (1,1,0) (0,1,0); normals +z; uvs; indices 0 1 2 0 2 3 (16 bits).
std::string squareBuffer();

/// glTF's JSON for that buffer in the file square.bin. Accessors: 0 positions, 1 normals, 2 uvs, 3 indices.
/// @param rest members of the root object, each after a comma: meshes, nodes and so on
std::string squareGltf(const std::string& rest);

/// The mesh and the node that squareGltf lacks, with the attributes of accessors 0 to 3.
/// @param primitive more members of the primitive, each after a comma
std::string squareMesh(const std::string& primitive = "");

/// The same as one binary file.
std::string glb(const std::string& json, const std::string& buffer);

/// Writes square.bin and `name` with squareGltf(rest), and loads it.
geometry::Model loadSquare(const std::filesystem::path& folder, const std::string& rest);

/// The message of the Error that loading raises, "" if it raises none.
std::string refusal(const std::filesystem::path& path);

/// Area of all triangles of mesh 0, and its warnings in one text.
double area(const geometry::Model& model);
std::string warnings(const geometry::Model& model);

} // namespace tyndall::test
