#include "app/editor/tools/lattice_overlay.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "app/editor/theme.h"

namespace voledit {

namespace {

constexpr Vec4f kEdge{0.82f, 0.86f, 0.93f, 1};
constexpr std::array<float, 3> kEdgeAlpha{0.10f, 0.26f, 0.62f};  // within, on a face, on an edge of the box
constexpr std::array<float, 4> kPointAlpha{0.35f, 0.70f, 0.85f, 0.95f};

/// How many of point `at`'s indices are the first or the last of their axis.
int sidesOf(const Lattice& lattice, const Index3& at) {
    int sides = 0;
    for (int a = 0; a < 3; ++a) sides += at[a] == 0 || at[a] == lattice.points[a] - 1;
    return sides;
}

/// 1 for the nearest of the lattice, less for what lies behind.
class DepthCue {
public:
    DepthCue(const LatticeView& view, const Camera& camera) : eye_(camera.eye), forward_(basisOf(camera).forward) {
        for (std::size_t i = 0; i < view.lattice.control.size(); ++i) {
            const double depth = glm::dot(view.shown(i) - eye_, forward_);
            near_ = std::min(near_, depth);
            far_ = std::max(far_, depth);
        }
    }
    float operator()(const Vec3& p) const {
        const double depth = glm::dot(p - eye_, forward_);
        const double behind = far_ > near_ ? (depth - near_) / (far_ - near_) : 0;
        return float(1 - 0.6 * glm::clamp(behind, 0.0, 1.0));
    }

private:
    Vec3 eye_, forward_;
    double near_ = kInfinity, far_ = -kInfinity;
};

void appendRestBox(const LatticeView& view, double scale, Overlay& overlay) {
    const Frame& frame = view.lattice.frame;
    const Mat4 shown = view.shownFromLattice * worldFromNormalised(frame);
    const Box3 unit{Vec3(0), Vec3(1)};
    for (int corner = 0; corner < 8; ++corner)
        for (int a = 0; a < 3; ++a)
            if (!(corner & 1 << a))
                overlay.lines.push_back({transformPoint(shown, unit.corner(corner)),
                                         transformPoint(shown, unit.corner(corner | 1 << a)),
                                         withAlpha(theme::kAccent, 0.28f), float(scale)});
}

void appendEdges(const LatticeView& view, const DepthCue& cue, double scale, Overlay& overlay) {
    const Lattice& lattice = view.lattice;
    const float strength = view.enabled ? 1.0f : 0.4f;
    for (std::size_t i = 0; i < lattice.control.size(); ++i) {
        const Index3 at = gridIndexOf(lattice, i);
        for (int a = 0; a < 3; ++a) {
            if (at[a] + 1 >= lattice.points[a]) continue;
            Index3 next = at;
            ++next[a];
            Index3 across = at;
            across[a] = 1 < lattice.points[a] - 1 ? 1 : at[a];
            const int sides = std::min(2, sidesOf(lattice, across));
            const Vec3 from = view.shown(i), to = view.shown(lattice.indexOf(next));
            const float alpha = kEdgeAlpha[std::size_t(sides)] * strength * cue(0.5 * (from + to));
            overlay.lines.push_back({from, to, withAlpha(kEdge, alpha), float((sides == 2 ? 1.4 : 1.0) * scale)});
        }
    }
}

OverlayPoint pointOf(const LatticeView& view, const LatticeLook& look, std::size_t i, float cue) {
    const auto has = [i](const std::vector<std::size_t>& v) { return std::binary_search(v.begin(), v.end(), i); };
    const bool selected = has(look.selected), folded = has(look.folded), hovered = look.hovered == i;
    const auto sides = std::size_t(sidesOf(view.lattice, gridIndexOf(view.lattice, i)));
    const float alpha = selected || hovered || folded ? 1.0f : kPointAlpha[sides] * cue;
    const Vec4f fill = selected ? theme::kAccent : folded ? theme::kWarning : kEdge;
    const Vec4f ring = folded && selected    ? theme::kWarning
                       : selected || hovered ? Vec4f(1)
                                             : Vec4f(0.05f, 0.06f, 0.08f, 1);
    const double radius = selected || hovered ? 5.5 : folded ? 5 : sides == 0 ? 3 : 3.8;
    return {view.shown(i), withAlpha(fill, alpha), float(radius * look.scale), withAlpha(ring, alpha)};
}

}  // namespace

void appendLattice(const LatticeView& view, const LatticeLook& look, Overlay& overlay) {
    const Lattice& lattice = view.lattice;
    if (lattice.control != restControlPoints(lattice.basis, lattice.points, lattice.frame))
        appendRestBox(view, look.scale, overlay);
    const DepthCue cue(view, look.camera);
    appendEdges(view, cue, look.scale, overlay);
    for (std::size_t i = 0; i < lattice.control.size(); ++i)
        overlay.points.push_back(pointOf(view, look, i, cue(view.shown(i))));
    // What is drawn last lies on top: far points first, then what is marked.
    std::stable_sort(overlay.points.end() - std::ptrdiff_t(lattice.control.size()), overlay.points.end(),
                     [&](const OverlayPoint& a, const OverlayPoint& b) {
                         if (a.radius != b.radius) return a.radius < b.radius;
                         return glm::distance(a.at, look.camera.eye) > glm::distance(b.at, look.camera.eye);
                     });
}

}  // namespace voledit
