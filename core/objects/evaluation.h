#pragma once
// How terms are evaluated, node by node: what term.cpp, leaf_terms.cpp and composite_terms.cpp share.

#include "core/objects/term.h"

namespace voledit {

constexpr std::size_t kBlock = 1024;  // points evaluated together: what a level keeps stays in the cache

/// What a caller wants of each sample besides opacity.
struct Asked {
    bool gradient = false;
    /// `depth`, and the gradient of solids also where opacity is 0: operators that lay surfaces bare need them.
    bool depth = false;
    /// Colour also where opacity is 0.
    bool colorEverywhere = false;
    /// The attribute that `value` is to be, other than those every object has; null: none, `value` may be anything.
    const std::string* attribute = nullptr;

    bool scalar() const { return attribute && *attribute == "scalar"; }
};

/// Samples of at most kBlock points; `sample` is overwritten.
void evaluate(const Term& term, std::span<const Vec3> p, std::span<ObjectSample> sample, const Asked& asked);

void evaluateVolume(const VolumeTerm& node, std::span<const Vec3> p, std::span<ObjectSample> sample,
                    const Asked& asked);
void evaluateMesh(const MeshTerm& node, std::span<const Vec3> p, std::span<ObjectSample> sample, const Asked& asked);
void evaluateSolid(const SolidTerm& node, std::span<const Vec3> p, std::span<ObjectSample> sample, const Asked& asked);
void evaluateFields(const FieldsTerm& node, std::span<const Vec3> p, std::span<ObjectSample> sample,
                    const Asked& asked);
void evaluateCvg(const CvgTerm& node, std::span<const Vec3> p, std::span<ObjectSample> sample, const Asked& asked);
void evaluateRecolor(const RecolorTerm& node, std::span<const Vec3> p, std::span<ObjectSample> sample,
                     const Asked& asked);
void evaluateTransfer(const TransferTerm& node, std::span<const Vec3> p, std::span<ObjectSample> sample,
                      const Asked& asked);

/// The attribute `name` of a sample, if it is one that every object has: "opacity", "r", "g" or "b".
std::optional<double> ownAttribute(const std::string& name, const ObjectSample& s);

/// The points p[n] for n of `which`, in their order.
std::vector<Vec3> gathered(std::span<const Vec3> p, std::span<const std::uint32_t> which);

}  // namespace voledit
