#include "core/skeleton/limb_checks.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/error.h"

namespace voledit {
namespace {

std::string nameOf(const std::vector<Limb>& limbs, std::size_t l) {
    return limbs[l].name.empty() ? "limb " + std::to_string(l) : "limb '" + limbs[l].name + "'";
}

bool finite(const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
bool finite(const Vec2& v) {
    return std::isfinite(v.x) && std::isfinite(v.y);
}
bool finite(const Mat3& m) {
    return finite(m[0]) && finite(m[1]) && finite(m[2]);
}

void requireOptions(std::size_t limbs, const RegionOptions& options) {
    const Index3 cells = options.cells;
    if (cells.x < 1 || cells.y < 1 || cells.z < 1)
        throw Error("regions of limbs", "a limb has no cells", "give at least one cell along each axis");
    // In doubles, which do not overflow; every joint may have a bevel of four layers.
    const double all = double(limbs) * double(cells.x) * double(cells.y) * (double(cells.z) + 4);
    if (all > double(kMostRegionCells))
        throw Error("regions of limbs",
                    std::to_string(limbs) + " limbs of " + std::to_string(cells.x) + " × " + std::to_string(cells.y) +
                        " × " + std::to_string(cells.z) + " cells are too many",
                    "use at most " + std::to_string(kMostRegionCells) + " cells in all, bevels included");
    if (!(options.miterLimit >= 1))
        throw Error("regions of limbs", "the miter limit is less than 1", "give a number of at least 1");
}

void requireLimb(const Limb& limb, const std::string& where, std::size_t joints) {
    const auto exists = [&](int joint) { return joint >= 0 && std::size_t(joint) < joints; };
    if (!exists(limb.from) || !exists(limb.to))
        throw Error(where, "a joint of it does not exist", "let it run from a joint of the skeleton to one below");
    if (!finite(limb.size) || !(limb.size.x > 0) || !(limb.size.y > 0))
        throw Error(where, "its size is not positive", "give width and height, both above 0");
    if (!finite(limb.offset) || !finite(limb.pad) || !std::isfinite(limb.roll))
        throw Error(where, "its offset, pad or roll is not finite", "give finite numbers");
}

/// The bone between two joints must have a length, to more than rounding.
void requireLength(const Limb& limb, const std::string& where, const std::vector<PosedJoint>& joints, bool posed) {
    const PosedJoint &from = joints[std::size_t(limb.from)], &to = joints[std::size_t(limb.to)];
    const std::string pose = posed ? "in the pose" : "at rest";
    if (!finite(from.position) || !finite(to.position) || !finite(from.linear))
        throw Error(where, "a joint of it is nowhere " + pose + " (a number that is not finite)",
                    "look at the pose, the motion and the fit");
    const double length = glm::length(to.position - from.position);
    const double rounding = 1e-14 * (glm::length(from.position) + glm::length(to.position));
    if (!std::isfinite(length) || !(length > rounding))
        throw Error(where, "it has no length " + pose, "let it run between joints that lie apart");
    if (!posed && !(length + limb.pad.x + limb.pad.y > 0))
        throw Error(where, "its pads leave nothing of it", "give pads that are larger");
    if (!(glm::determinant(from.linear) != 0))
        throw Error(where, "a joint of it flattens space " + pose, "give a fit with scales other than 0");
}

}  // namespace

void requireValid(const std::vector<Limb>& limbs, const std::vector<PosedJoint>& rest,
                  const std::vector<PosedJoint>& posed, const RegionOptions& options) {
    if (rest.size() != posed.size())
        throw Error("regions of limbs",
                    std::to_string(rest.size()) + " joints at rest but " + std::to_string(posed.size()) + " posed",
                    "pose the same skeleton");
    requireOptions(limbs.size(), options);
    for (std::size_t l = 0; l < limbs.size(); ++l) {
        const std::string where = nameOf(limbs, l);
        requireLimb(limbs[l], where, rest.size());
        requireLength(limbs[l], where, rest, false);
        requireLength(limbs[l], where, posed, true);
    }
}

void requireNoCircle(const std::vector<Limb>& limbs, const LimbLinks& links) {
    if (links.order.size() == limbs.size()) return;
    std::vector<bool> reached(limbs.size(), false);
    for (const int l : links.order) reached[std::size_t(l)] = true;
    for (std::size_t l = 0; l < limbs.size(); ++l)
        if (!reached[l])
            throw Error(nameOf(limbs, l), "limbs continue it in a circle",
                        "let each limb run from a joint to one below it");
}

}  // namespace voledit
