#include "app/editor/tools/node_overlay.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "app/editor/theme.h"
#include "core/scene/nodes.h"

namespace voledit {

namespace {

void line(Overlay& overlay, const Vec3& from, const Vec3& to, const Vec4f& color, double scale) {
    overlay.lines.push_back({from, to, color, float(1.2 * scale)});
}

/// The twelve edges; the three at the corner that formulas call 0 in the colours of their axes.
void appendFrame(const Frame& frame, double scale, Overlay& overlay) {
    for (int a = 0; a < 3; ++a)
        for (int corner = 0; corner < 4; ++corner) {
            const int b = (a + 1) % 3, c = (a + 2) % 3;
            const Vec3 from = frame.corner + double(corner & 1) * frame.edge[std::size_t(b)] +
                              double(corner >> 1) * frame.edge[std::size_t(c)];
            const Vec4f color = corner == 0 ? theme::kAxis[std::size_t(a)] : withAlpha(theme::kAccent, 0.55f);
            line(overlay, from, from + frame.edge[std::size_t(a)], color, corner == 0 ? 1.5 * scale : scale);
        }
}

/// A circle of `radius` about `center` in each of the planes of the axes.
void appendSphere(const Vec3& center, double radius, double scale, Overlay& overlay) {
    constexpr int kPieces = 48;
    for (int a = 0; a < 3; ++a) {
        const auto at = [&](int n) {
            const double phi = 2 * std::numbers::pi * n / kPieces;
            Vec3 p = center;
            p[(a + 1) % 3] += radius * std::cos(phi);
            p[(a + 2) % 3] += radius * std::sin(phi);
            return p;
        };
        for (int n = 0; n < kPieces; ++n)
            line(overlay, at(n), at(n + 1), withAlpha(theme::kAxis[std::size_t(a)], 0.6f), scale);
    }
}

double lengthOf(const LibraryTransfer& use, const char* name) {
    const auto found = use.arguments.find(name);
    const auto* numbers =
        found == use.arguments.end() ? nullptr : std::get_if<Tracked<std::vector<double>>>(&found->second);
    return numbers && !(*numbers)->empty() ? (**numbers)[0] : 0;
}

void appendArguments(const LibraryTransfer& use, double time, double scale, Overlay& overlay) {
    const double radius = lengthOf(use, "radius");
    for (const auto& [name, argument] : use.arguments) {
        if (const auto* about = std::get_if<LibraryTransfer::Line>(&argument)) {
            const Vec3 point = about->point.at(time), along = about->direction.at(time);
            if (glm::length(along) == 0) continue;
            const Vec3 half = glm::normalize(along) * (radius > 0 ? 1.5 * radius : glm::length(along));
            line(overlay, point - half, point + half, theme::kAccent, 1.5 * scale);
        }
        const auto* numbers = std::get_if<Tracked<std::vector<double>>>(&argument);
        if (name != "center" || !numbers) continue;
        const std::vector<double> center = numbers->at(time);
        if (center.size() == 3) appendSphere({center[0], center[1], center[2]}, radius, scale, overlay);
    }
}

}  // namespace

void appendNode(const Scene& scene, const std::string& path, double time, double scale, Overlay& overlay) {
    const std::string target = path.empty() ? "" : followedUse(scene, path);
    const Transfer* transfer = target.empty() ? nullptr : findTransferAt(scene, target);
    if (!transfer || std::holds_alternative<FfdTransfer>(transfer->kind)) return;
    if (transfer->frame) appendFrame(transfer->frame->at(time), scale, overlay);
    if (const auto* use = std::get_if<LibraryTransfer>(&transfer->kind)) appendArguments(*use, time, scale, overlay);
}

}  // namespace voledit
