#pragma once
// The numbers of an array in a legacy VTK file.

#include <vector>

#include "app/io/scan_vtk.h"

namespace voledit {

/// All numbers of `array`, in their order. Throws Error where a word is no number.
std::vector<double> readReals(const VtkFile& file, const VtkArray& array, VolumeSink& sink);
std::vector<float> readFloats(const VtkFile& file, const VtkArray& array, VolumeSink& sink);
/// Throws Error too where one is no whole number from 0 to 2³² − 2.
std::vector<std::uint32_t> readIndices(const VtkFile& file, const VtkArray& array, VolumeSink& sink);

}  // namespace voledit
