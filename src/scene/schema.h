// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tyndall::scene {

/// The scene format as a JSON Schema (draft-07) for editors, made from fields.h. docs/scene.schema.json is this text.
/// Which keys go with which type is told in descriptions only; the reader checks it.
std::string jsonSchema();

} // namespace tyndall::scene
