#include "core/rays/chain_parts.h"

#include <cmath>
#include <glm/common.hpp>

#include "core/objects/term_bounds.h"

namespace voledit {

namespace {

// Of the maps' interpolation, voxels: found at the middles of edges, between which it may be a little larger.
constexpr double kTolerance = 0.1, kRoughTolerance = 0.5;

constexpr std::size_t cornerNode(int c) {
    return nodeAt(2 * (c & 1), 2 * (c >> 1 & 1), 2 * (c >> 2));
}
bool isCorner(std::size_t node) {
    return node % 3 != 1 && node / 3 % 3 != 1 && node / 9 != 1;
}

Found joined(const std::vector<Found>& portions) {
    Found all;
    std::size_t affine = 0, ragged = 0;
    for (const Found& portion : portions) {
        affine += portion.affine.size();
        ragged += portion.ragged.size();
    }
    all.affine.reserve(affine);
    all.ragged.reserve(ragged);
    all.nodes.reserve(ragged);
    for (const Found& portion : portions) all.append(portion);
    return all;
}

/// How far the maps are from what lies between the corners along the tetrahedra's edges: at their middles.
double errorOf(const Nodes& x) {
    double error = 0;
    for (int k = 0; k < 3; ++k)
        for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 3; ++i) {
                if (i != 1 && j != 1 && k != 1) continue;
                const auto end = [&](int to) { return x[nodeAt(i == 1 ? to : i, j == 1 ? to : j, k == 1 ? to : k)]; };
                error = std::max(error, largestOf(x[nodeAt(i, j, k)] - 0.5 * (end(0) + end(2))));
            }
    return error;
}

/// The largest step between neighbours of which both are defined.
double largestStep(const Nodes& x) {
    double step = 0;
    const auto compare = [&](const Vec3& one, const Vec3& other) {
        const double length = largestOf(other - one);
        if (std::isfinite(length)) step = std::max(step, length);
    };
    for (int k = 0; k < 3; ++k)
        for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 3; ++i) {
                const Vec3& at = x[nodeAt(i, j, k)];
                if (i < 2) compare(at, x[nodeAt(i + 1, j, k)]);
                if (j < 2) compare(at, x[nodeAt(i, j + 1, k)]);
                if (k < 2) compare(at, x[nodeAt(i, j, k + 1)]);
            }
    return step;
}

}  // namespace

bool finite(const Vec3& v) {
    return std::isfinite(v.x + v.y + v.z);
}

double largestOf(const Vec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

ChainParts::ChainParts(const CellWay& way, const VolumeLook& look, const Base& base, bool rough)
    : way_(way),
      base_(base),
      tolerance_(rough ? kRoughTolerance : kTolerance),
      smallest_(rough ? kUnits / 2 : 2),
      skip_(look.skip()),
      domain_(look.volumeTerm().volume->grid().indexDomain()) {}

Found ChainParts::find() const {
    std::vector<Vec3> x(base_.q.size());
    parallelFor(x.size(), 512, [&](std::size_t begin, std::size_t end) {
        way_.toIndex(base_.q.subspan(begin, end - begin), std::span(x).subspan(begin, end - begin));
    });
    Found found = joined(inPortions<Found>(base_.cells.size(), 32, [&](std::size_t begin, std::size_t end, Found& to) {
        Asked asked;
        for (std::size_t n = begin; n < end; ++n) {
            Nodes at;
            for (int c = 0; c < 8; ++c) at[cornerNode(c)] = x[base_.cells[n][std::size_t(c)]];
            ask({std::uint32_t(n), Index3(0), kUnits, {}, 0}, at, asked);
        }
        decide(asked, to);
    }));
    std::vector<Part> affine = std::move(found.affine);
    for (int size = kUnits / 2; size >= smallest_ && !found.ragged.empty(); size /= 2) {
        const Found halved = std::exchange(found, {});
        found = joined(inPortions<Found>(halved.ragged.size(), 8, [&](std::size_t begin, std::size_t end, Found& to) {
            Asked asked;
            for (std::size_t n = begin; n < end; ++n) askHalves(halved.ragged[n], halved.nodes[n], asked);
            decide(asked, to);
        }));
        affine.insert(affine.end(), found.affine.begin(), found.affine.end());
    }
    found.affine = std::move(affine);
    return found;
}

/// Asks for a part's middles, unless its corners tell that it cannot be near anything visible.
void ChainParts::ask(const Part& part, const Nodes& corners, Asked& asked) const {
    Box3 hull;
    bool whole = true;
    for (int c = 0; c < 8; ++c) {
        whole &= finite(corners[cornerNode(c)]);
        hull = join(hull, corners[cornerNode(c)]);
    }
    if (whole && !visible(hull, 0.5 * largestOf(hull.max - hull.min))) return;
    asked.parts.push_back(part);
    asked.nodes.push_back(corners);
    for (std::size_t m = 0; m < 27; ++m)
        if (!isCorner(m))
            asked.places.push_back(
                within(base_.q, base_.cells[part.cell], part.first + part.size / 2 * Index3(m % 3, m / 3 % 3, m / 9)));
}

void ChainParts::askHalves(const Part& part, const Nodes& x, Asked& asked) const {
    for (int half = 0; half < 8; ++half) {
        Nodes corners;
        for (int c = 0; c < 8; ++c) {
            const Index3 node = cornerOf(half) + cornerOf(c);
            corners[cornerNode(c)] = x[nodeAt(node.x, node.y, node.z)];
        }
        const int size = part.size / 2;
        ask({part.cell, part.first + size * cornerOf(half), size, {}, 0}, corners, asked);
    }
}

void ChainParts::decide(Asked& asked, Found& to) const {
    way_.toIndex(asked.places, asked.places);
    std::size_t next = 0;
    for (std::size_t n = 0; n < asked.parts.size(); ++n) {
        Nodes& x = asked.nodes[n];
        for (std::size_t m = 0; m < x.size(); ++m)
            if (!isCorner(m)) x[m] = asked.places[next++];
        Part& part = asked.parts[n];
        const Kind kind = kindOf(x, part);
        if (kind == Kind::Empty) continue;
        for (int c = 0; c < 8; ++c) part.x[std::size_t(c)] = x[cornerNode(c)];
        (kind == Kind::Affine ? to.affine : to.ragged).push_back(part);
        if (kind == Kind::Ragged) to.nodes.push_back(x);
    }
}

ChainParts::Kind ChainParts::kindOf(const Nodes& x, Part& part) const {
    Box3 hull;
    int defined = 0;
    for (const Vec3& at : x)
        if (finite(at)) {
            hull = join(hull, at);
            ++defined;
        }
    if (defined == 0) return part.size == kUnits && mayHide(part) ? Kind::Ragged : Kind::Empty;
    const bool whole = defined == int(x.size());
    part.error = whole ? errorOf(x) : 0;
    if (!visible(hull, 0.01 + (whole ? 2 * part.error : 2 * largestStep(x)))) return Kind::Empty;
    return whole && part.error <= tolerance_ ? Kind::Affine : Kind::Ragged;
}

/// Whether something smaller than the distance of a whole cell's places may hide between them.
bool ChainParts::mayHide(const Part& part) const {
    Box3 box;
    for (const std::uint32_t v : base_.cells[part.cell]) box = join(box, base_.p[v]);
    return mayBeVisible(*way_.term, box);
}

}  // namespace voledit
