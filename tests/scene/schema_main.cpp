// SPDX-License-Identifier: Apache-2.0
// Prints docs/scene.schema.json.
#include "scene/schema.h"

#include <cstdio>

int main() { return std::fputs(tyndall::scene::jsonSchema().c_str(), stdout) < 0 ? 1 : 0; }
