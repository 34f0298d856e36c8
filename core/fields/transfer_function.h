#pragma once
// Conventional transfer functions: piecewise-linear tables from a value to colour and opacity.

#include <array>
#include <vector>

#include "core/base/interval.h"
#include "core/base/types.h"

namespace voledit {

/// Piecewise-linear function through (x, y) points, x not decreasing (two points of one x make a step: the first's y
/// holds up to x, the second's from x on). Holds beyond its ends. Empty: 0 everywhere.
struct PiecewiseLinear {
    std::vector<Vec2> points;

    bool operator==(const PiecewiseLinear&) const = default;
    double operator()(double x) const;
    /// Derivative at x; at a corner that of the piece after it, 0 beyond the ends.
    double slope(double x) const;
};

/// Bounds of the table over `x` (low ≤ high): exact, from its corners.
Interval rangeOf(const PiecewiseLinear& table, const Interval& x);

/// The same for colours.
struct ColorTable {
    struct Point {
        double value;
        Vec3 color;  // RGB in [0, 1], sRGB as people pick it
        bool operator==(const Point&) const = default;
    };
    std::vector<Point> points;

    bool operator==(const ColorTable&) const = default;
    Vec3 operator()(double x) const;
};

/// What a value looks like: both tables are in the data's own units (HU for CT). Opacity is that of one opacity
/// distance of the material (definitions.md §2).
struct TransferFunction {
    ColorTable color;
    PiecewiseLinear opacity;
    /// Factor on opacity over the gradient's magnitude, data units per world unit; empty: 1 everywhere.
    PiecewiseLinear gradientOpacity;

    bool operator==(const TransferFunction&) const = default;
};

/// The appearance of a volume without one: black to white and opacity 0 to 1 over min … max.
TransferFunction greyRamp(double min, double max);

/// Largest opacity that any value in [low, high] takes (gradient factor left out): exact, from the table's corners.
double largestOpacity(const PiecewiseLinear& opacity, double low, double high);

}  // namespace voledit
