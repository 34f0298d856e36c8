// Limbs that overlap about a hub move as one where they do.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "core/skeleton/limb_regions.h"
#include "random_skeletons.h"

namespace voledit {
namespace {

/// A trunk of two limbs with an arm of two on either side, rooted in the upper one.
struct Torso {
    std::vector<PosedJoint> rest;
    std::vector<Limb> limbs;
};

Torso torso() {
    Torso made;
    for (const Vec3& at : {Vec3(0, 0, 0), Vec3(0, 0, 3), Vec3(0, 0, 6), Vec3(0.3, 0, 5), Vec3(2, 0, 5), Vec3(4.5, 0, 5),
                           Vec3(-0.3, 0, 5), Vec3(-2, 0, 5), Vec3(-4.5, 0, 5)})
        made.rest.push_back({Mat3(1), at});
    const auto add = [&](const char* name, int from, int to, const Vec2& size) {
        made.limbs.push_back({name, from, to, size, Vec2(0), 0, Vec2(0)});
    };
    add("belly", 0, 1, {3, 2});
    add("chest", 1, 2, {3, 2});
    add("shoulder +", 3, 4, {1.8, 1.8});
    add("arm +", 4, 5, {1.4, 1.4});
    add("shoulder -", 6, 7, {1.8, 1.8});
    add("arm -", 7, 8, {1.4, 1.4});
    return made;
}

/// Joints from `first` on, up to `end`, turned about the first.
void turn(std::vector<PosedJoint>& joints, std::size_t first, std::size_t end, const Quat& by) {
    const Vec3 centre = joints[first].position;
    for (std::size_t j = first; j < end; ++j)
        joints[j] = {glm::mat3_cast(by) * joints[j].linear, centre + by * (joints[j].position - centre)};
}

std::vector<PosedJoint> raised(const Torso& torso, double shoulder, double arm) {
    auto posed = torso.rest;
    turn(posed, 3, 6, glm::angleAxis(-shoulder, Vec3(0, 1, 0)));
    turn(posed, 4, 6, glm::angleAxis(-arm, glm::normalize(Vec3(0.2, 1, 0))));
    return posed;
}

/// How far apart two limbs carry one point of the rest body that both hold, root mean square. (The largest would not
/// do: along an edge in which the boxes' faces cross, the union has a corner, about which the map jumps.)
double disagreement(const LimbRegions& regions) {
    MappedCells::Data forward = regions.cells;
    std::swap(forward.deformed, forward.source);
    const MappedCells cells(std::move(forward));
    Random random(3);
    double sum = 0;
    int count = 0;
    std::vector<CellLocation> found;
    for (int n = 0; n < 40'000; ++n) {
        const Vec3 s(randomNumber(random, 0, 1), randomNumber(random, 0, 1), randomNumber(random, 0, 1));
        found.clear();
        cells.locateAll(cells.bounds().min + s * cells.bounds().size(), found);
        if (found.size() < 2) continue;
        const Vec3 apart = cells.sourceAt(found[0]) - cells.sourceAt(found[1]);
        sum += glm::dot(apart, apart);
        ++count;
    }
    return std::sqrt(sum / count);
}

RegionOptions options(int cells, bool smooth = true) {
    RegionOptions made;
    made.cells = Index3(cells);
    made.smooth = smooth;
    return made;
}

TEST(LimbHubs, OverlappingLimbsComeToAgreeAsCellsGetSmaller) {
    const Torso body = torso();
    const auto posed = raised(body, 0.25, 0.3);
    const double bare = disagreement(limbRegions(body.limbs, body.rest, posed, options(8, false)));
    const double coarse = disagreement(limbRegions(body.limbs, body.rest, posed, options(8)));
    const double fine = disagreement(limbRegions(body.limbs, body.rest, posed, options(16)));
    EXPECT_GT(bare, 0.1);  // the chest stays, the shoulder turns
    EXPECT_LT(coarse, bare / 5);
    // Only cells along the union's corners stay apart, a part of all that falls with their size: the mean's root.
    EXPECT_LT(fine, coarse / 1.3);
}

TEST(LimbHubs, OnlyOverlapsAboutBranchesChange) {
    const Torso body = torso();
    const auto posed = raised(body, 0.25, 0.3);
    const LimbRegions bare = limbRegions(body.limbs, body.rest, posed, options(6, false));
    RegionOptions disjoint = options(6);
    disjoint.disjoint.assign(body.rest.size(), true);
    const LimbRegions rigid = limbRegions(body.limbs, body.rest, posed, disjoint);
    const LimbRegions blended = limbRegions(body.limbs, body.rest, posed, options(6));
    // The belly, below all arms, and the other arm are as they were at rest; nothing in disjoint mode is blended.
    for (std::size_t l : {std::size_t(0), std::size_t(5)})
        for (std::size_t c = blended.firstCell[l]; c < blended.firstCell[l + 1]; ++c)
            for (const std::uint32_t v : blended.cells.hexahedra[c])
                EXPECT_LT(glm::length(blended.cells.deformed[v] - blended.cells.source[v]), l == 0 ? 1e-12 : 0.05);
    for (std::size_t c = rigid.firstCell[2]; c < rigid.firstCell[3]; ++c)
        for (const std::uint32_t v : rigid.cells.hexahedra[c]) {
            const Vec3& q = rigid.cells.source[v];
            const Vec3 expected = posed[3].position + posed[3].linear * (q - body.rest[3].position);
            EXPECT_LT(glm::length(rigid.cells.deformed[v] - expected), 1e-12);
        }
    EXPECT_NE(bare.cells.deformed, blended.cells.deformed);
}

}  // namespace
}  // namespace voledit
