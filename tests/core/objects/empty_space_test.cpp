#include "core/objects/empty_space.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "tests/support/terms.h"

namespace voledit {
namespace {

using namespace test;

/// Two small balls and a thin sheet in otherwise empty space.
TermPtr sparse() {
    const auto field = [](const Vec3& p) {
        return std::max({0.15 - glm::length(p - Vec3(0.6, 0.5, -0.4)), 0.2 - glm::length(p + Vec3(0.5)),
                         0.03 - std::abs(p.z - 0.8)});
    };
    TransferFunction f = constantLook(0, Vec3(1));
    f.opacity.points = {{0, 0}, {0, 0.5}};
    return makeVolumeTerm(sampledVolume(41, field), 0, f);
}

TermPtr placed(const TermPtr& term, const Vec3& at = {5, 6, 7}) {
    return makeTransferTerm(std::make_shared<AffineMap>(placementMatrix(at, {0.4, 0.3, -1}, {1, 2, 0.5})), term,
                            Combine::Union, "", TransferRole::Place);
}

std::vector<std::pair<const char*, TermPtr>> terms() {
    const auto bent = [](double amount, Outside outside, const TermPtr& of) {
        return makeTransferTerm(bentLattice(amount, 6, outside), of, Combine::Union, "");
    };
    return {{"volume", sparse()},
            {"placed", placed(sparse())},
            {"bent", bent(0.25, Outside::Hide, sparse())},
            {"folded", bent(-2, Outside::Hide, sparse())},
            {"kept", bent(0.25, Outside::Keep, placed(sparse(), {0.5, 0.2, -0.3}))},
            {"bent twice", bent(0.2, Outside::Hide, bent(0.2, Outside::Hide, sparse()))},
            {"bent, placed", placed(bent(0.25, Outside::Hide, sparse()))}};
}

TEST(EmptySpace, NothingThatCanBeSeenIsLeftOut) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    for (const auto& [name, term] : terms()) {
        const EmptySpace& space = emptySpaceOf(*term);
        int visible = 0, skipped = 0;
        for (int n = 0; n < 4000; ++n) {
            const auto within = [&] {
                return term->bounds.min + Vec3(unit(random), unit(random), unit(random)) * term->bounds.size();
            };
            const Vec3 p = within();
            const double length = glm::length(within() - p);
            const Vec3 direction = n % 5 ? glm::normalize(within() - p) : Vec3(n % 2 ? 1 : -1, 0, 0);
            const double empty = std::min(space.emptyAhead(p, direction), length);
            std::vector<Vec3> along;
            for (int i = 0; i < 20; ++i) along.push_back(p + (i + 0.5) / 20 * empty * direction);
            along.push_back(p);
            std::vector<ObjectSample> samples(along.size());
            sample(*term, along, samples, false);
            skipped += empty > 0;
            for (std::size_t i = 0; i < samples.size(); ++i) {
                EXPECT_TRUE(empty == 0 || samples[i].opacity == 0 || !term->bounds.contains(along[i])) << name;
                visible += samples[i].opacity > 0;
            }
        }
        EXPECT_GT(skipped, 1500) << name;
        EXPECT_GT(visible, 100) << name;
    }
}

TEST(EmptySpace, ABoxThatMayNotBeVisibleHoldsNothing) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> unit(0, 1);
    for (const auto& [name, term] : terms()) {
        int invisible = 0;
        for (int n = 0; n < 1500; ++n) {
            const Vec3 low = term->bounds.min + Vec3(unit(random), unit(random), unit(random)) * term->bounds.size();
            const Box3 box{low, low + 0.2 * unit(random) * term->bounds.size()};
            if (mayBeVisible(*term, box)) continue;
            ++invisible;
            std::vector<Vec3> p;
            for (int i = 0; i < 30; ++i)
                p.push_back(i < 8 ? box.corner(i)
                                  : box.min + Vec3(unit(random), unit(random), unit(random)) * box.size());
            std::vector<ObjectSample> samples(p.size());
            sample(*term, p, samples, false);
            for (const ObjectSample& s : samples) EXPECT_EQ(s.opacity, 0) << name;
        }
        EXPECT_GT(invisible, 200) << name;
    }
}

TEST(EmptySpace, AVisibleVoxelIsFoundFromItsLastNeighbour) {
    // One bright voxel: the value interpolated beside it is above 0 up to the next sample on every side.
    std::vector<std::uint8_t> values(13 * 13 * 13, 0);
    const Index3 at(8, 4, 12);
    values[std::size_t(at.x + 13 * (at.y + 13 * at.z))] = 255;
    TransferFunction f = constantLook(0, Vec3(1));
    f.opacity.points = {{0, 0}, {255, 1}};
    const VolumeTerm node{Volume::fromValues({Index3(13), 1, Mat4(1.0)}, values), 0, f};
    const VisibleBricks bricks(node);
    const auto seen = [&](const Vec3& x) { return bricks.mayBeVisible({x - 0.01, x + 0.01}); };
    EXPECT_TRUE(seen({7.1, 4, 12}));
    EXPECT_TRUE(seen({8.9, 4.9, 11.1}));
    EXPECT_TRUE(seen({8, 4, 12.002}));
    EXPECT_FALSE(seen({3.9, 4, 12}));
    EXPECT_FALSE(seen({8, 8.1, 12}));
    EXPECT_FALSE(seen({8, 4, 7.9}));
    EXPECT_FALSE(seen({8, 4, 12.1})) << "outside";
}

TEST(VisibleBricks, ReachAsFarAsTheInterpolationDoes) {
    constexpr int n = 17;
    for (int at = 4; at <= 12; ++at) {  // one bright sample, on and beside the bricks' borders
        std::vector<float> values(n * n * n, 0);
        values[std::size_t(at + n * (8 + n * 8))] = 1;
        const auto volume = Volume::fromValues({Index3(n), 1, Mat4(1.0)}, values);
        TransferFunction f = constantLook(0, Vec3(1));
        f.opacity.points = {{0, 0}, {1, 1}};
        for (const Interpolation by : {Interpolation::Linear, Interpolation::Nearest, Interpolation::Cubic}) {
            const TermPtr term = makeVolumeTerm(volume, 0, f, by);
            int visible = 0;
            for (double x = at - 2.4; x < at + 2.4; x += 0.1) {
                const Vec3 p(x, 8, 8);
                if (sampled(term, {p})[0].opacity == 0) continue;
                ++visible;
                EXPECT_TRUE(mayBeVisible(*term, {p, p})) << x - at;
            }
            EXPECT_GT(visible, by == Interpolation::Cubic ? 35 : 8);
        }
    }
}

}  // namespace
}  // namespace voledit
