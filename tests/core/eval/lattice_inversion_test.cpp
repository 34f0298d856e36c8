// Real volumes under a Bézier lattice, voxelised, against an inversion that shares no code with it: Newton's method on
// the Bernstein polynomial itself.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>
#include <optional>
#include <random>

#include "core/eval/voxelise.h"
#include "core/io/io_client.h"
#include "tests/support/fixtures.h"
#include "tests/support/scenes.h"

namespace voledit {
namespace {

/// Cubic Bernstein polynomials and their derivatives, written out.
void bernstein(double t, double (&value)[4], double (&slope)[4]) {
    const double s = 1 - t;
    const double b[4] = {s * s * s, 3 * t * s * s, 3 * t * t * s, t * t * t};
    const double d[4] = {-3 * s * s, 3 * s * s - 6 * t * s, 6 * t * s - 3 * t * t, 3 * t * t};
    std::copy(b, b + 4, value);
    std::copy(d, d + 4, slope);
}

Vec3 bezierVolume(const std::vector<Vec3>& control, const Vec3& u, Mat3& slopes) {
    double b[3][4], d[3][4];
    for (int a = 0; a < 3; ++a) bernstein(u[a], b[a], d[a]);
    Vec3 p(0);
    slopes = Mat3(0);
    for (std::size_t n = 0; n < 64; ++n) {
        const std::size_t i = n % 4, j = n / 4 % 4, k = n / 16;
        p += b[0][i] * b[1][j] * b[2][k] * control[n];
        slopes[0] += d[0][i] * b[1][j] * b[2][k] * control[n];
        slopes[1] += b[0][i] * d[1][j] * b[2][k] * control[n];
        slopes[2] += b[0][i] * b[1][j] * d[2][k] * control[n];
    }
    return p;
}

/// u within the frame with P(u) = p, from `start`; nullopt if Newton ends elsewhere.
std::optional<Vec3> newton(const std::vector<Vec3>& control, const Vec3& p, Vec3 u, double tolerance) {
    Mat3 slopes;
    for (int step = 0; step < 40; ++step) {
        const Vec3 miss = p - bezierVolume(control, u, slopes);
        if (glm::length(miss) < tolerance) {
            // The outermost cells' faces are facets of the true surface: points between the two are not compared.
            if (glm::any(glm::lessThan(u, Vec3(0.01))) || glm::any(glm::greaterThan(u, Vec3(0.99))))
                return std::nullopt;
            return u;
        }
        Vec3 move = glm::inverse(slopes) * miss;
        move *= std::min(1.0, 0.2 / glm::length(move));
        u += move;
        if (glm::length(u - 0.5) > 3) return std::nullopt;
    }
    return std::nullopt;
}

/// Four control points moved by a fifth of the box.
Lattice pulledLattice(const Volume& volume) {
    const Frame frame = volume.grid().worldFrame();
    Lattice lattice{LatticeBasis::Bezier, {4, 4, 4}, frame, restControlPoints(LatticeBasis::Bezier, Index3(4), frame)};
    lattice.control[lattice.indexOf({3, 3, 3})] += 0.2 * frame.edge[0];
    lattice.control[lattice.indexOf({0, 3, 1})] -= 0.2 * frame.edge[1];
    lattice.control[lattice.indexOf({1, 1, 2})] += 0.2 * frame.edge[2];
    lattice.control[lattice.indexOf({2, 0, 0})] -= 0.2 * frame.edge[0];
    return lattice;
}

struct Inverted {
    std::vector<Index3> voxels;  // of the grid that is voxelised
    std::vector<Vec3> p, q;
};

/// Random voxels whose place lies within the deformed block, with their true pre-images.
Inverted invertByNewton(const Volume& volume, const Lattice& lattice, std::size_t count) {
    Inverted result;
    std::mt19937 random(1);
    const Mat4 u = normalisedFromWorld(lattice.frame);
    const double size = glm::length(lattice.frame.edge[0]);
    while (result.p.size() < count) {
        const Index3 voxel(random() % unsigned(volume.grid().size.x), random() % unsigned(volume.grid().size.y),
                           random() % unsigned(volume.grid().size.z));
        const Vec3 p = transformPoint(volume.grid().worldFromIndex, Vec3(voxel));
        const auto found = newton(lattice.control, p, transformPoint(u, p), 1e-12 * size);
        if (!found) continue;
        result.voxels.push_back(voxel);
        result.p.push_back(p);
        result.q.push_back(transformPoint(worldFromNormalised(lattice.frame), *found));
    }
    return result;
}

struct Errors {
    double voxels = 0, largest = 0, value = 0;  // mean and largest |Δq| in voxels, mean |Δvalue|
};

Errors errorsOf(const std::shared_ptr<const Volume>& volume, const Lattice& lattice, int cells, const Inverted& truth) {
    const auto map = std::make_shared<LatticeMap>(lattice, Index3(cells), Outside::Hide);
    EXPECT_FALSE(map->cells()->mayOverlap());
    const auto term = makeTransferTerm(map, makeVolumeTerm(volume, 0, greyRamp(0, 1)), Combine::Union, "");
    const auto out =
        voxelise(test::sceneOf(term, {}, 1), {volume->grid(), VoxeliseWhat::Scalar, VoxelType::Double, kNaN});
    std::vector<Vec3> q(truth.p.size());
    std::vector<double> expected(q.size());
    map->map(truth.p, q);
    volume->sample(truth.q, expected);
    Errors errors;
    for (std::size_t n = 0; n < q.size(); ++n) {
        const double miss = glm::length(transformVector(volume->indexFromWorld(), q[n] - truth.q[n]));
        errors.voxels += miss / double(q.size());
        errors.largest = std::max(errors.largest, miss);
        errors.value += std::abs(out->at(truth.voxels[n]) - expected[n]) / double(q.size());
    }
    return errors;
}

void expectFourfoldFall(const std::filesystem::path& file) {
    IoClient io;
    const auto volume = io.readVolume(file).volume;
    const Lattice lattice = pulledLattice(*volume);
    const Inverted truth = invertByNewton(*volume, lattice, 20000);
    Errors before;
    for (const int cells : {8, 16, 32}) {
        const Errors now = errorsOf(volume, lattice, cells, truth);
        std::printf("%s, %2d cells: mean |q error| %.5f voxels (largest %.4f), mean |value error| %.4f\n",
                    file.filename().c_str(), cells, now.voxels, now.largest, now.value);
        EXPECT_FALSE(std::isnan(now.value)) << "a voxel was lost";
        if (cells > 8) {
            EXPECT_GT(before.voxels / now.voxels, 3.5);
            EXPECT_GT(before.value / now.value, 3.0);
        }
        before = now;
    }
}

TEST(LatticeInversion, AgreesWithNewtonOnTheHead) {
    VOLEDIT_SHARED_OR_SKIP(file, "data/volumes/ct_head.mhd");
    expectFourfoldFall(file);
}

TEST(LatticeInversion, AgreesWithNewtonOnTheHeart) {
    VOLEDIT_SHARED_OR_SKIP(file, "data/volumes/chest_cta_heart.nii.gz");
    expectFourfoldFall(file);
}

TEST(LatticeInversion, AgreesWithNewtonOnTheEngine) {
    VOLEDIT_SHARED_OR_SKIP(file, "data/volumes/engine.nii.gz");
    expectFourfoldFall(file);
}

}  // namespace
}  // namespace voledit
