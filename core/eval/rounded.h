#pragma once
// Values to the number types of voxels.

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace voledit {

/// Nearest value of T, halves away from zero, clamped to what T holds; NaN is 0 in an integer.
template <class T>
T rounded(double value) {
    if constexpr (std::is_floating_point_v<T>) {
        return T(value);
    } else {
        if (value != value) return 0;
        return T(std::clamp(std::round(value), double(std::numeric_limits<T>::min()),
                            double(std::numeric_limits<T>::max())));
    }
}

}  // namespace voledit
