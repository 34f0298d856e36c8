#pragma once
// From a file's byte order to the machine's.

#include <span>

#include "app/io/stored_volume.h"

namespace voledit {

/// Turns stored values, as they came from the file, into numbers; in parallel.
void toMachineOrder(const StoredVolume& stored, std::span<std::byte> bytes);

}  // namespace voledit
