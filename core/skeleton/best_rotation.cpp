#include "core/skeleton/best_rotation.h"

#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace voledit {

namespace {

/// About the mean, scaled to norm 1; false where all points are one.
bool normalise(std::vector<Vec3>& points) {
    Vec3 mean(0);
    for (const Vec3& p : points) mean += p / double(points.size());
    double squares = 0;
    for (Vec3& p : points) squares += glm::dot(p -= mean, p);
    if (!(squares > 0)) return false;
    for (Vec3& p : points) p /= std::sqrt(squares);
    return true;
}

/// Unit eigenvector (w, x, y, z) of the largest eigenvalue of a symmetric matrix, by Jacobi rotations.
Vec4 principal(Mat4 m) {
    Mat4 vectors(1.0);
    constexpr int sweeps = 30;
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        for (int p = 0; p < 3; ++p) {
            for (int q = p + 1; q < 4; ++q) {
                if (m[p][q] == 0) continue;
                const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
                const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
                const double c = 1 / std::sqrt(t * t + 1), s = t * c;
                Mat4 turn(1.0);
                turn[p][p] = turn[q][q] = c;
                turn[q][p] = s;
                turn[p][q] = -s;
                m = glm::transpose(turn) * m * turn;
                vectors = vectors * turn;
            }
        }
    }
    int best = 0;
    for (int i = 1; i < 4; ++i)
        if (m[i][i] > m[best][best]) best = i;
    return vectors[best];
}

}  // namespace

BestRotation bestRotation(std::vector<Vec3> from, std::vector<Vec3> to) {
    assert(from.size() == to.size());
    if (from.empty() || !normalise(from) || !normalise(to)) return {};
    Mat3 s(0.0);  // s[b][a] = Σ from_a to_b
    for (std::size_t i = 0; i < from.size(); ++i) s += glm::outerProduct(from[i], to[i]);
    // The identity's own matrix, hardly felt: it decides where the points do not.
    constexpr double preference = 1e-9;
    s += Mat3(preference);
    const auto S = [&](int a, int b) { return s[b][a]; };
    Mat4 n(0.0);
    n[0] = {S(0, 0) + S(1, 1) + S(2, 2), S(1, 2) - S(2, 1), S(2, 0) - S(0, 2), S(0, 1) - S(1, 0)};
    n[1] = {n[0][1], S(0, 0) - S(1, 1) - S(2, 2), S(0, 1) + S(1, 0), S(2, 0) + S(0, 2)};
    n[2] = {n[0][2], n[1][2], -S(0, 0) + S(1, 1) - S(2, 2), S(1, 2) + S(2, 1)};
    n[3] = {n[0][3], n[1][3], n[2][3], -S(0, 0) - S(1, 1) + S(2, 2)};
    const Vec4 v = principal(n);
    BestRotation best;
    best.rotation = glm::normalize(Quat(v[0], v[1], v[2], v[3]));
    for (std::size_t i = 0; i < from.size(); ++i) best.likeness += glm::dot(to[i], best.rotation * from[i]);
    return best;
}

}  // namespace voledit
