#include "core/fields/outline_distance.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/base/parallel.h"

namespace voledit {

namespace {

constexpr int kTile = 8;  // samples along each side of the squares that share their candidates

double cross(const Vec2& a, const Vec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// How often a letter's outline winds about p, counter-clockwise.
int windingAbout(const GlyphOutline& letter, const Vec2& p) {
    if (p.x < letter.min.x || p.y < letter.min.y || p.x > letter.max.x || p.y > letter.max.y) return 0;
    int winding = 0;
    for (const OutlineSegment& s : letter.segments) {
        const bool up = s.from.y <= p.y && p.y < s.to.y, down = s.to.y <= p.y && p.y < s.from.y;
        if (!up && !down) continue;
        const double side = cross(s.to - s.from, p - s.from);
        if (up && side > 0) ++winding;
        if (down && side < 0) --winding;
    }
    return winding;
}

bool isInside(const std::vector<GlyphOutline>& letters, const Vec2& p) {
    int winding = 0;
    for (const GlyphOutline& letter : letters) winding += windingAbout(letter, p);
    return winding != 0;
}

/// Where along `s`, in (0, 1), other outlines cross it.
std::vector<double> crossings(const std::vector<GlyphOutline>& letters, const OutlineSegment& s) {
    std::vector<double> found;
    const Vec2 low = glm::min(s.from, s.to), high = glm::max(s.from, s.to), along = s.to - s.from;
    const auto meets = [&](const Vec2& min, const Vec2& max) {
        return min.x <= high.x && min.y <= high.y && max.x >= low.x && max.y >= low.y;
    };
    for (const GlyphOutline& letter : letters) {
        if (!meets(letter.min, letter.max)) continue;
        for (const OutlineSegment& other : letter.segments) {
            if (!meets(glm::min(other.from, other.to), glm::max(other.from, other.to))) continue;
            const Vec2 across = other.to - other.from, between = other.from - s.from;
            const double area = cross(along, across);
            if (area == 0) {
                // Parallel: if they overlap, the other's ends cut.
                for (const Vec2& end : {other.from, other.to})
                    found.push_back(glm::dot(end - s.from, along) / glm::dot(along, along));
                continue;
            }
            const double t = cross(between, across) / area, u = cross(between, along) / area;
            if (u >= 0 && u <= 1) found.push_back(t);
        }
    }
    std::erase_if(found, [](double t) { return !(t > 1e-9 && t < 1 - 1e-9); });
    std::sort(found.begin(), found.end());
    return found;
}

double squaredDistance(const OutlineSegment& s, const Vec2& p) {
    const Vec2 along = s.to - s.from, to = p - s.from;
    const double t = std::clamp(glm::dot(to, along) / glm::dot(along, along), 0.0, 1.0);
    const Vec2 d = to - t * along;
    return glm::dot(d, d);
}

/// Consecutive pieces with their box, so that most are passed over at once.
struct Run {
    std::vector<OutlineSegment> segments;
    Vec2 min{kInfinity}, max{-kInfinity};

    double distance(const Vec2& p) const { return glm::length(glm::max(glm::max(min - p, p - max), Vec2(0))); }
};

std::vector<Run> runsOf(const std::vector<OutlineSegment>& boundary) {
    constexpr std::size_t kLength = 16;
    std::vector<Run> runs;
    for (std::size_t n = 0; n < boundary.size(); ++n) {
        if (n % kLength == 0) runs.emplace_back();
        Run& run = runs.back();
        run.segments.push_back(boundary[n]);
        run.min = glm::min(run.min, glm::min(boundary[n].from, boundary[n].to));
        run.max = glm::max(run.max, glm::max(boundary[n].from, boundary[n].to));
    }
    return runs;
}

/// The pieces that are nearest to some point within `reach` of `center`, and perhaps others.
void candidatesAbout(const std::vector<Run>& runs, const Vec2& center, double reach,
                     std::vector<OutlineSegment>& found) {
    double nearest = kInfinity;
    for (const Run& run : runs) {
        if (run.distance(center) >= nearest) continue;
        for (const OutlineSegment& s : run.segments) nearest = std::min(nearest, std::sqrt(squaredDistance(s, center)));
    }
    const double limit = (nearest + 2 * reach) * (1 + 1e-9);
    found.clear();
    for (const Run& run : runs) {
        if (run.distance(center) > limit) continue;
        for (const OutlineSegment& s : run.segments)
            if (squaredDistance(s, center) <= limit * limit) found.push_back(s);
    }
}

/// The plane's grid: `size` samples from `origin` on.
struct PlaneGrid {
    Vec2 origin;
    double spacing;
    Index2 size;
    Vec2 at(int i, int k) const { return origin + spacing * Vec2(i, k); }
};

void fillTiles(const PlaneGrid& grid, const std::vector<Run>& runs, int firstRow, std::vector<float>& values) {
    std::vector<OutlineSegment> near;
    const int lastRow = std::min(firstRow + kTile, grid.size.y);
    for (int first = 0; first < grid.size.x; first += kTile) {
        const int last = std::min(first + kTile, grid.size.x);
        const Vec2 low = grid.at(first, firstRow), high = grid.at(last - 1, lastRow - 1);
        candidatesAbout(runs, 0.5 * (low + high), 0.5 * glm::distance(low, high), near);
        for (int k = firstRow; k < lastRow; ++k)
            for (int i = first; i < last; ++i) {
                double squared = kInfinity;
                for (const OutlineSegment& s : near) squared = std::min(squared, squaredDistance(s, grid.at(i, k)));
                values[std::size_t(k) * std::size_t(grid.size.x) + std::size_t(i)] = float(std::sqrt(squared));
            }
    }
}

/// Turns the distances of row k negative inside, from left to right.
void signRow(const PlaneGrid& grid, const std::vector<GlyphOutline>& letters, int k, std::vector<float>& values) {
    struct Crossing {
        double x;
        int winding;
    };
    std::vector<Crossing> crossed;
    const double y = grid.at(0, k).y;
    for (const GlyphOutline& letter : letters) {
        if (y < letter.min.y || y > letter.max.y) continue;
        for (const OutlineSegment& s : letter.segments) {
            const bool up = s.from.y <= y && y < s.to.y, down = s.to.y <= y && y < s.from.y;
            if (up || down)
                crossed.push_back({s.from.x + (y - s.from.y) / (s.to.y - s.from.y) * (s.to.x - s.from.x), up ? 1 : -1});
        }
    }
    std::sort(crossed.begin(), crossed.end(), [](const Crossing& a, const Crossing& b) { return a.x < b.x; });
    int winding = 0;
    std::size_t next = 0;
    for (int i = 0; i < grid.size.x; ++i) {
        const double x = grid.at(i, k).x;
        while (next < crossed.size() && crossed[next].x < x) winding += crossed[next++].winding;
        float& value = values[std::size_t(k) * std::size_t(grid.size.x) + std::size_t(i)];
        if (winding != 0) value = -value;
    }
}

}  // namespace

std::vector<OutlineSegment> boundaryOf(const std::vector<GlyphOutline>& letters) {
    std::vector<OutlineSegment> boundary;
    for (const GlyphOutline& letter : letters)
        for (const OutlineSegment& s : letter.segments) {
            std::vector<double> cuts = crossings(letters, s);
            cuts.insert(cuts.begin(), 0);
            cuts.push_back(1);
            const Vec2 along = s.to - s.from;
            // Far enough to the side to leave the line, too near to reach another.
            const Vec2 aside = 1e-6 * Vec2(-along.y, along.x);
            for (std::size_t n = 0; n + 1 < cuts.size(); ++n) {
                if (cuts[n] == cuts[n + 1]) continue;
                const Vec2 middle = s.from + 0.5 * (cuts[n] + cuts[n + 1]) * along;
                if (isInside(letters, middle + aside) == isInside(letters, middle - aside)) continue;
                boundary.push_back({s.from + cuts[n] * along, s.from + cuts[n + 1] * along});
            }
        }
    return boundary;
}

std::shared_ptr<const Volume> tabulatedDistance(const std::vector<GlyphOutline>& letters, double spacing,
                                                double margin) {
    Vec2 min(kInfinity), max(-kInfinity);
    for (const GlyphOutline& letter : letters) {
        min = glm::min(min, letter.min);
        max = glm::max(max, letter.max);
    }
    const PlaneGrid plane{min - margin, spacing, Index2(glm::ceil((max - min + 2 * margin) / spacing)) + 1};
    const std::vector<Run> runs = runsOf(boundaryOf(letters));
    std::vector<float> values(std::size_t(plane.size.x) * std::size_t(plane.size.y));
    parallelFor(std::size_t((plane.size.y + kTile - 1) / kTile), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t tile = begin; tile < end; ++tile) {
            const int first = int(tile) * kTile;
            fillTiles(plane, runs, first, values);
            for (int k = first; k < std::min(first + kTile, plane.size.y); ++k) signRow(plane, letters, k, values);
        }
    });
    VolumeGrid grid{{plane.size.x, 1, plane.size.y}, 1, Mat4(1.0)};
    for (int a = 0; a < 3; ++a) grid.worldFromIndex[a][a] = spacing;
    grid.worldFromIndex[3] = Vec4(plane.origin.x, 0, plane.origin.y, 1);
    return Volume::fromValues(grid, std::move(values));
}

}  // namespace voledit
