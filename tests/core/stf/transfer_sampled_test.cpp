// Each procedural transfer sampled to volumes and applied again as three fields: the sampled map approaches the formula
// as trilinear interpolation must, with the square of the cell's size, and is exact where the formula is linear.

#include <gtest/gtest.h>

#include "core/fields/simple_fields.h"
#include "core/stf/field_maps.h"
#include "tests/core/stf/analytic_maps.h"
#include "tests/core/stf/library_maps.h"

namespace voledit {
namespace {

/// About the unit frame, wide enough for what the transfers move out of it.
const Box3 kUnit{Vec3(0), Vec3(1)}, kDomain{Vec3(-0.25), Vec3(1.25)};

/// Ψ at the samples of an n³ grid over kDomain, in the float numbers that files have.
TransferPtr sampledAt(const SpatialTransferFunction& map, int n) {
    VolumeGrid grid;
    grid.size = Index3(n);
    const double step = kDomain.size().x / (n - 1);
    for (int c = 0; c < 3; ++c) grid.worldFromIndex[c][c] = step;
    grid.worldFromIndex[3] = Vec4(kDomain.min, 1);
    std::vector<Vec3> points;
    points.reserve(grid.sampleCount());
    for (int k = 0; k < n; ++k)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) points.push_back(kDomain.min + step * Vec3(i, j, k));
    map.map(points, points);
    std::array<FieldPtr, 3> fields;
    for (int c = 0; c < 3; ++c) {
        std::vector<float> values;
        values.reserve(points.size());
        for (const Vec3& q : points) values.push_back(float(q[c]));
        fields[std::size_t(c)] = std::make_shared<VolumeField>(Volume::fromValues(grid, std::move(values)), 0);
    }
    return std::make_shared<FieldsMap>(fields, false, Outside::Hide);
}

struct SampledCase {
    std::string name;
    Arguments arguments;
    /// Distance of a point to the nearest cut, kink or axis of the map, or less.
    std::function<double(const Vec3&)> smoothWithin;
};

/// Mean |Δq| between the sampled and the true map, more than two coarse cells from what is not smooth.
double meanError(const SampledCase& c, int n) {
    const auto map = library(c.name, c.arguments, 1, Outside::Hide, kUnit);
    const double coarse = kDomain.size().x / 63;
    const auto all = randomPoints({kDomain.min + 0.01, kDomain.max - 0.01}, 20000), sources = mappedBy(*map, all);
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (c.smoothWithin(all[i]) > 2 * coarse && isDefined(sources[i])) points.push_back(all[i]);
    EXPECT_GT(points.size(), 3000u) << c.name;
    const auto exact = mappedBy(*map, points), sampled = mappedBy(*sampledAt(*map, n), points);
    double sum = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_TRUE(isDefined(sampled[i])) << c.name;
        sum += glm::length(sampled[i] - exact[i]);
    }
    return sum / double(points.size());
}

/// Distance to the faces of the unit box across one axis.
double toFaces(double a) {
    return std::min(std::abs(a), std::abs(a - 1));
}

TEST(SampledTransfers, ApproachCurvedMapsWithTheSquareOfTheCell) {
    const LineValue line{{0.5, 0.5, 0.5}, {0, 0, 1}};
    const auto radius = [](const Vec3& p) { return std::hypot(p.x - 0.5, p.y - 0.5); };
    const auto anywhere = [](const Vec3&) { return 1.0; };
    const std::vector<SampledCase> cases{
        {"squeeze", {{"axis", Axes{2}}, {"strength", Numbers{0.6}}}, anywhere},
        {"twist", {{"axis", Axes{2}}, {"angle", Numbers{120}}}, anywhere},
        {"taper", {{"axis", Axes{2}}, {"scale", Numbers{0.5, 1.5}}}, [](const Vec3& p) { return toFaces(p.z); }},
        {"bend",
         {{"axis", Axes{2}}, {"toward", Axes{0}}, {"angle", Numbers{90}}},
         [](const Vec3& p) {
             // The planes at the arc's ends, and the half-line behind its centre.
             const double rho = 2 / kPi, x = p.z - 0.5, y = rho - (p.x - 0.5), s = std::sqrt(0.5);
             return std::min(std::abs(std::abs(x) * s - y * s), y > 0 ? std::hypot(x, y) : std::abs(x));
         }},
        {"deflect",
         {{"center", Numbers{0.5, 0.5, 0.5}},
          {"radius", Numbers{0.5}},
          {"translate", Numbers{0.2, 0.1, 0}},
          {"rotate", Numbers{0, 0, 60}},
          {"scale", Numbers{1.3}}},
         [](const Vec3& p) { return std::abs(glm::length(p - 0.5) - 0.5); }},
        {"open",
         {{"axis", Axes{0}}, {"hinge", Axes{1}}, {"profile", Numbers{2}}},  // tear
         [](const Vec3& p) {
             const double h = std::min(std::max(p.y, 0.0), 1.0), s = 0.2 * (1 - h) * (1 - h);
             return std::min(toFaces(p.y), (std::abs(p.x - 0.5) - s) / std::sqrt(1 + 0.4 * 0.4));
         }},
        {"insideOut",
         {{"line", line}, {"radius", Numbers{0.6}}},
         [=](const Vec3& p) { return std::min(radius(p), 0.6 - radius(p)); }},
        {"rotationalSweep",
         {{"line", line}, {"start", Numbers{1, 0, 0}}, {"from", Numbers{0}}, {"to", Numbers{270}}},
         [=](const Vec3& p) {
             const double toStart = p.x > 0.5 ? std::abs(p.y - 0.5) : 1, toEnd = p.y < 0.5 ? std::abs(p.x - 0.5) : 1;
             return std::min({radius(p), toStart, toEnd});
         }},
    };
    for (const SampledCase& c : cases) {
        const double coarse = meanError(c, 64), fine = meanError(c, 128);
        EXPECT_GE(coarse / fine, 3.5) << c.name << ": " << coarse << " and " << fine;
        RecordProperty(c.name, std::to_string(coarse / fine));
    }
}

TEST(SampledTransfers, AreExactWhereTheMapIsLinear) {
    const std::vector<SampledCase> cases{
        {"split", {{"axis", Axes{0}}, {"gap", Numbers{0.3}}}, [](const Vec3& p) { return std::abs(p.x - 0.5) - 0.15; }},
        {"dissect",
         {{"axes", Axes{0, 1, 2}}},
         [](const Vec3& p) {
             const Vec3 d = glm::abs(p - 0.5) - 0.15;
             return std::min({d.x, d.y, d.z});
         }},
        {"open",
         {{"axis", Axes{0}}, {"hinge", Axes{1}}},
         [](const Vec3& p) {
             const double s = 0.2 * (1 - std::min(std::max(p.y, 0.0), 1.0));
             return std::min(toFaces(p.y), (std::abs(p.x - 0.5) - s) / std::sqrt(1 + 0.2 * 0.2));
         }},
        {"affine",
         {{"translate", Numbers{0.1, -0.2, 0.3}}, {"rotate", Numbers{20, 30, -70}}, {"scale", Numbers{1.2, 0.8, 1.5}}},
         [](const Vec3&) { return 1.0; }},
    };
    for (const SampledCase& c : cases)
        for (const int n : {64, 128}) EXPECT_LE(meanError(c, n), 1e-5) << c.name;
}

}  // namespace
}  // namespace voledit
