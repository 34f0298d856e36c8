#pragma once
// Whether a DICOM file holds all of its pixels, which GDCM does not tell.

#include <cstdint>

#include "app/io/input_file.h"

namespace voledit {

/// Throws Error where the file ends within its pixel data element (7FE0,0010), whose length field is `length`
/// (0xFFFFFFFF: packed pieces up to a delimiter). DICOM PS3.5, 7.1 and A.4.
void checkPixelData(const Source& source, std::uint32_t length);

}  // namespace voledit
