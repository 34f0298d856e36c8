#pragma once
// Packets as pixels of a picture.

#include <algorithm>

#include "core/base/picture.h"
#include "core/rays/packet_caster.h"

namespace voledit {

/// Calls body(x, y, lane) for the pixels from `first` up to but without `end`, of a packet of `shape` that begins at
/// `corner`.
template <class Body>
void forPixels(Index2 corner, Index2 first, Index2 end, Index2 shape, const Body& body) {
    for (int y = std::max(first.y, corner.y); y < std::min(end.y, corner.y + shape.y); ++y)
        for (int x = std::max(first.x, corner.x); x < std::min(end.x, corner.x + shape.x); ++x)
            body(x, y, std::size_t(x - corner.x + shape.x * (y - corner.y)));
}

/// The pixel that `lane` of a cast packet means.
inline Vec4f pixelOf(const RayPacket& packet, std::size_t lane, const Vec3f& background) {
    const float through = packet.transmittance[lane];
    Vec4f pixel(0, 0, 0, 1 - through);
    for (int c = 0; c < 3; ++c) pixel[c] = packet.color[std::size_t(c)][lane] + through * background[c];
    return pixel;
}

}  // namespace voledit
