#pragma once
// From a file's bytes to a volume's bytes: copied, inflated, or read from text.

#include <span>

#include "app/io/stored_volume.h"

namespace voledit {

/// One part of a stored volume to be decoded.
struct PartTask {
    const StoredVolume& stored;
    const DataPart& part;
    std::uint64_t values;  // that the whole part must hold
    VolumeSink& sink;      // for warnings and progress, which runs from `from` to `to`
    double from = 0, to = 1;
};

/// Throws Error where the part's file cannot hold its values: it is too short, or could not expand so far. Warns of a
/// raw file that is longer.
void checkLength(const PartTask& task);

/// Fills `out` with the part's first decoded bytes, in the file's byte order (text: the machine's). Where `out` is all
/// that the part holds, the data's end is checked too. Throws Error where the data is damaged or ends early.
void decode(const PartTask& task, std::span<std::byte> out);

}  // namespace voledit
