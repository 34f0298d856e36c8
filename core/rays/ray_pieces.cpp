#include "core/rays/ray_pieces.h"

#include <algorithm>

namespace voledit {

namespace {

// Gaps shorter than that, in steps, are closed: rounding leaves them, and packets take what is nearer for touching.
constexpr float kGap = 0.02F;

/// By insertion: lists come nearly sorted.
void sortByBegin(std::span<CellHit> hits) {
    for (std::size_t n = 1; n < hits.size(); ++n) {
        const CellHit hit = hits[n];
        std::size_t at = n;
        for (; at > 0 && hit.begin < hits[at - 1].begin; --at) hits[at] = hits[at - 1];
        hits[at] = hit;
    }
}

}  // namespace

std::span<CellHit> orderedPieces(std::span<CellHit> hits) {
    sortByBegin(hits);
    std::size_t kept = 0;
    for (const CellHit& next : hits) {
        CellHit hit = next;
        if (kept > 0) {
            CellHit& before = hits[kept - 1];
            hit.begin = std::max(hit.begin, before.end);
            if (!(hit.begin < hit.end)) continue;
            if (hit.begin < before.end + kGap) before.end = hit.begin;
        }
        hits[kept++] = hit;
    }
    return hits.first(kept);
}

}  // namespace voledit
