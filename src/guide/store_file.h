// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "guide/store.h"

#include <cstddef>
#include <span>
#include <vector>

namespace tyndall::guide {

/// The content as bytes for a file. Only cells that are taken are in it: a store is mostly empty.
std::vector<std::byte> packStore(const StoreContent& content);

/// What packStore was given, bit for bit. @throws Error if the bytes are not from this version of it.
StoreContent unpackStore(std::span<const std::byte> bytes);

} // namespace tyndall::guide
