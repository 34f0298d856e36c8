#pragma once
// Generated programs evaluated at points, and core's answers beside them.

#include "core/objects/term.h"
#include "render/term_program.h"

namespace voledit::test {

/// What the program of `term` gives at `p`, by the two functions it has.
struct Probed {
    std::vector<ObjectSample> plain;  // colour and opacity
    std::vector<ObjectSample> lit;    // opacity and gradient
};
Probed probed(const TermPtr& term, const std::vector<Vec3>& p);

/// `count` points, uniform in `box`, the same every time.
std::vector<Vec3> pointsIn(const Box3& box, int count, unsigned seed = 7);

struct ParityLimits {
    double opacity = 1e-4, color = 1e-4;
    double gradient = 1e-3;   // of the largest gradient
    double outliers = 0.002;  // share of the points that may lie across a jump from where single precision sees them
    double visible = 0.1;     // share of the points at which there must be something
    std::optional<Box3> box = std::nullopt;  // of the points; else the term's bounds and a twentieth around them
};

/// Holds the program of `term` against core::sample at `count` random points .
void expectParity(const TermPtr& term, const ParityLimits& limits = {}, int count = 4000);

}  // namespace voledit::test
