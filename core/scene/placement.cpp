#include <glm/trigonometric.hpp>

#include "core/scene/scene.h"
#include "core/stf/affine.h"

namespace voledit {

Mat4 worldFromRest(const Placement& placement) {
    if (placement.matrix) return *placement.matrix;
    return placementMatrix(placement.translate, glm::radians(placement.rotate), placement.scale);
}

}  // namespace voledit
