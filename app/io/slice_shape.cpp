#include "app/io/slice_shape.h"

#include "app/io/checks.h"
#include "core/base/error.h"

namespace voledit {

VolumeHeader headerOf(const SliceStack& stack, const SliceShape& shape, std::size_t depth) {
    checkSizes(stack.name, {std::uint64_t(shape.width), std::uint64_t(shape.height), depth},
               std::uint64_t(shape.channels));
    VolumeHeader header;
    header.grid.size = Index3(shape.width, shape.height, int(depth));
    header.grid.channels = shape.channels;
    for (int a = 0; a < 3; ++a) header.grid.worldFromIndex[a][a] = stack.spacing[a];
    header.type = shape.type;
    header.format = stack.format;
    header.storedType = nameOf(shape.type);
    return header;
}

void checkAlike(const std::string& slice, const SliceShape& shape, const SliceShape& first) {
    if (shape == first) return;
    const auto text = [](const SliceShape& s) {
        return std::to_string(s.width) + "x" + std::to_string(s.height) + " with " + std::to_string(s.channels) +
               " channels of " + std::string(nameOf(s.type));
    };
    throw Error(slice, "is " + text(shape) + ", but the first slice is " + text(first),
                "all slices of a stack must be alike: take the others out of the folder");
}

}  // namespace voledit
