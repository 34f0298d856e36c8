#pragma once
// The rotation that best lays one set of points onto another.

#include <vector>

#include "core/base/types.h"

namespace voledit {

struct BestRotation {
    Quat rotation{1, 0, 0, 0};
    /// How alike the sets are after it: Σ bᵢ·R aᵢ / (|a| |b|), 1 where they agree but for size, 0 where either is a
    /// point.
    double likeness = 0;
};

/// R for which Σ |bᵢ − R aᵢ|² is least, both sets taken about their means [Horn 1987, closed-form solution by unit
/// quaternions]. Where the points leave it open (all on a line), the turn nearest to none. Needs equal sizes.
BestRotation bestRotation(std::vector<Vec3> from, std::vector<Vec3> to);

}  // namespace voledit
