#pragma once
// Pictures and stacks of them, by OpenImageIO. Opened as a module.

#include <filesystem>
#include <span>
#include <vector>

#include "app/io/input_file.h"
#include "app/io/volume_sink.h"
#include "core/base/picture.h"

namespace voledit {

/// The slices of a volume, in order: pages of one file, or the first page of each of several.
struct SliceStack {
    std::string name;    // what the user named, for messages
    std::string format;  // "tiff", "png"
    std::vector<Source> files;
    std::vector<int> pages;  // of the one file; empty where there are several
    Vec3 spacing{1};
};

/// Reads a stack: i along rows, j down, k through the slices; all must have one size, type and number of channels.
/// Throws Error that names the slice.
extern "C" void voleditReadSlices(const SliceStack& stack, VolumeSink& sink);

/// Reads the first page as RGBA, values as stored, integers as 0…1; grey is spread over RGB, missing alpha is 1. Throws
/// Error.
extern "C" void voleditReadPicture(const Source& source, Picture& picture);

/// Writes OpenEXR: float RGBA in linear light; of a `transparent` picture, whose colours are multiplied by alpha, light
/// that is multiplied by alpha. Throws Error.
extern "C" void voleditWriteExr(const Picture& picture, const Source& target, bool transparent);

}  // namespace voledit
