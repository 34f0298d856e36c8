#include "core/stf/lattice_basis.h"

#include <algorithm>
#include <cassert>

namespace voledit {

namespace {

/// Bernstein polynomials of `degree` at u, by de Casteljau's triangle of their recurrence: only convex combinations, so
/// stable at any degree.
std::vector<double> bernstein(int degree, double u) {
    std::vector<double> b(std::size_t(degree) + 1, 0.0);
    b[0] = 1;
    for (std::size_t d = 1; d < b.size(); ++d) {
        for (std::size_t i = d; i > 0; --i) b[i] = (1 - u) * b[i] + u * b[i - 1];
        b[0] *= 1 - u;
    }
    return b;
}

BasisValues bezierValues(int points, double u) {
    const int degree = points - 1;
    BasisValues result{0, bernstein(degree, u), std::vector<double>(std::size_t(points))};
    const std::vector<double> lower = bernstein(degree - 1, u);
    for (std::size_t i = 0; i < std::size_t(points); ++i)
        result.derivative[i] = degree * ((i > 0 ? lower[i - 1] : 0) - (i + 1 < std::size_t(points) ? lower[i] : 0));
    return result;
}

/// Knot `n` of a clamped uniform cubic spline with `spans` spans, in units of a span.
double knot(int n, int spans) {
    return std::clamp(n - 3, 0, spans);
}

/// The `order` B-splines that are not 0 on span `span`, at x within it [Cox, de Boor].
std::array<double, 4> splines(int order, int span, int spans, double x) {
    std::array<double, 4> b{1, 0, 0, 0};
    const int k = span + 3;  // the knots about x are k and k + 1
    for (int d = 1; d < order; ++d) {
        double carried = 0;
        for (int i = 0; i < d; ++i) {
            const double right = knot(k + 1 + i, spans), left = knot(k + 1 + i - d, spans);
            const double share = b[std::size_t(i)] / (right - left);
            b[std::size_t(i)] = carried + (right - x) * share;
            carried = (x - left) * share;
        }
        b[std::size_t(d)] = carried;
    }
    return b;
}

BasisValues splineValues(int points, double u) {
    const int spans = points - 3;
    const double x = u * spans;
    const int span = std::clamp(int(x), 0, spans - 1);
    const auto cubic = splines(4, span, spans, x), quadratic = splines(3, span, spans, x);
    BasisValues result{std::size_t(span), {cubic.begin(), cubic.end()}, std::vector<double>(4)};
    // B'ᵢ = 3 (Nᵢ / (tᵢ₊₃ − tᵢ) − Nᵢ₊₁ / (tᵢ₊₄ − tᵢ₊₁)), N the quadratic splines, of which three are not 0.
    const auto slope = [&](int i) {
        if (i < 1 || i > 3) return 0.0;
        return 3 * quadratic[std::size_t(i - 1)] / (knot(span + i + 3, spans) - knot(span + i, spans));
    };
    for (int i = 0; i < 4; ++i) result.derivative[std::size_t(i)] = (slope(i) - slope(i + 1)) * spans;
    return result;
}

}  // namespace

BasisValues basisValues(LatticeBasis basis, int points, double u) {
    assert(points >= (basis == LatticeBasis::Bezier ? 2 : 4) && u >= 0 && u <= 1);
    return basis == LatticeBasis::Bezier ? bezierValues(points, u) : splineValues(points, u);
}

std::vector<double> restParameters(LatticeBasis basis, int points) {
    std::vector<double> result;
    const int spans = points - 3;
    for (int i = 0; i < points; ++i)
        result.push_back(basis == LatticeBasis::Bezier
                             ? double(i) / (points - 1)
                             : (knot(i + 1, spans) + knot(i + 2, spans) + knot(i + 3, spans)) / (3.0 * spans));
    return result;
}

}  // namespace voledit
