#include "core/stf/lattice_basis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace voledit {
namespace {

constexpr LatticeBasis kBezier = LatticeBasis::Bezier, kSpline = LatticeBasis::BSpline;

/// All `points` values (or derivatives), zeros included.
std::vector<double> spread(const BasisValues& basis, const std::vector<double>& few, int points) {
    std::vector<double> all(std::size_t(points), 0.0);
    for (std::size_t i = 0; i < few.size(); ++i) all.at(basis.first + i) = few[i];
    return all;
}

void forCases(const std::function<void(LatticeBasis, int, double)>& body) {
    for (int points = 2; points <= 31; ++points)
        for (int n = 0; n <= 40; ++n) {
            body(kBezier, points, n / 40.0);
            if (points >= 4) body(kSpline, points, n / 40.0);
        }
}

TEST(LatticeBasis, SumsToOneAndNeverBelowZero) {
    forCases([](LatticeBasis basis, int points, double u) {
        const auto b = basisValues(basis, points, u);
        double sum = 0, slopes = 0;
        for (const double v : b.value) {
            EXPECT_GE(v, 0);
            sum += v;
        }
        for (const double d : b.derivative) slopes += d;
        EXPECT_NEAR(sum, 1, 1e-14);
        EXPECT_NEAR(slopes, 0, 1e-12);
    });
}

TEST(LatticeBasis, ReproducesItsParameterAtRest) {
    forCases([](LatticeBasis basis, int points, double u) {
        const auto b = basisValues(basis, points, u);
        const auto rest = restParameters(basis, points);
        ASSERT_EQ(rest.size(), std::size_t(points));
        EXPECT_EQ(rest.front(), 0);
        EXPECT_EQ(rest.back(), 1);
        double at = 0, slope = 0;
        for (std::size_t i = 0; i < b.value.size(); ++i) {
            at += b.value[i] * rest[b.first + i];
            slope += b.derivative[i] * rest[b.first + i];
        }
        EXPECT_NEAR(at, u, 1e-14);
        EXPECT_NEAR(slope, 1, 1e-12);
    });
}

TEST(LatticeBasis, BernsteinPolynomialsAreTheirFormula) {
    for (const int degree : {1, 2, 3, 5, 12, 30})
        for (int n = 0; n <= 20; ++n) {
            const double u = n / 20.0;
            const auto b = basisValues(kBezier, degree + 1, u);
            for (int i = 0; i <= degree; ++i) {
                const double binomial = std::round(
                    std::exp(std::lgamma(degree + 1.0) - std::lgamma(i + 1.0) - std::lgamma(degree - i + 1.0)));
                const double expected = binomial * std::pow(u, i) * std::pow(1 - u, degree - i);
                EXPECT_NEAR(b.value[std::size_t(i)], expected, 1e-12);
            }
        }
}

TEST(LatticeBasis, SplinesAreTheRecursionsOverTheirKnots) {
    for (const int points : {4, 5, 6, 7, 9, 20}) {
        std::vector<double> knots(std::size_t(points) + 4);
        for (int i = 0; i < points + 4; ++i)
            knots[std::size_t(i)] = std::min(std::max(i - 3, 0), points - 3) / double(points - 3);
        const std::function<double(std::size_t, int, double)> spline = [&](std::size_t i, int degree, double u) {
            if (degree == 0) return knots[i] <= u && u < knots[i + 1] ? 1.0 : 0.0;
            const auto d = std::size_t(degree);
            double sum = 0;
            if (knots[i + d] > knots[i]) sum += (u - knots[i]) / (knots[i + d] - knots[i]) * spline(i, degree - 1, u);
            if (knots[i + d + 1] > knots[i + 1])
                sum += (knots[i + d + 1] - u) / (knots[i + d + 1] - knots[i + 1]) * spline(i + 1, degree - 1, u);
            return sum;
        };
        for (int n = 0; n < 37; ++n) {
            const double u = n / 37.0;
            const auto b = basisValues(kSpline, points, u);
            const auto all = spread(b, b.value, points);
            for (std::size_t i = 0; i < all.size(); ++i) EXPECT_NEAR(all[i], spline(i, 3, u), 1e-14);
        }
    }
}

TEST(LatticeBasis, FourSplinePointsAreACubicBezierCurve) {
    for (int n = 0; n <= 20; ++n) {
        const auto spline = basisValues(kSpline, 4, n / 20.0), bezier = basisValues(kBezier, 4, n / 20.0);
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_NEAR(spline.value[i], bezier.value[i], 1e-15);
            EXPECT_NEAR(spline.derivative[i], bezier.derivative[i], 1e-14);
        }
    }
}

TEST(LatticeBasis, DerivativesAreTheSlopes) {
    constexpr double h = 1e-6;
    for (const auto& [basis, points] :
         {std::pair{kBezier, 2}, {kBezier, 4}, {kBezier, 13}, {kSpline, 4}, {kSpline, 5}, {kSpline, 11}})
        for (int n = 0; n < 29; ++n) {
            const double u = 0.01 + 0.98 * n / 29.0;
            const auto at = basisValues(basis, points, u), ahead = basisValues(basis, points, u + h),
                       behind = basisValues(basis, points, u - h);
            const auto slope = spread(at, at.derivative, points), high = spread(ahead, ahead.value, points),
                       low = spread(behind, behind.value, points);
            for (std::size_t i = 0; i < slope.size(); ++i) EXPECT_NEAR(slope[i], (high[i] - low[i]) / (2 * h), 1e-5);
        }
}

}  // namespace
}  // namespace voledit
