#pragma once
// What the slices of a stack must share, whoever decodes them.

#include "app/io/modules/pictures.h"

namespace voledit {

struct SliceShape {
    int width = 0, height = 0, channels = 0;
    VoxelType type = VoxelType::UInt8;

    bool operator==(const SliceShape&) const = default;
};

/// Header of a volume of `depth` slices. Throws Error where the sizes are none.
VolumeHeader headerOf(const SliceStack& stack, const SliceShape& shape, std::size_t depth);

/// Throws the Error that names `slice` if its shape is not the first one's.
void checkAlike(const std::string& slice, const SliceShape& shape, const SliceShape& first);

}  // namespace voledit
