#include "core/rays/ragged_pieces.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace voledit {

namespace {

constexpr float kLongest = 4, kShortest = 0.26F;    // stretches looked at, steps
constexpr double kTolerance = 0.1, kBeyond = 1e-3;  // voxels

bool finite(const Vec3& v) {
    return std::isfinite(v.x + v.y + v.z);
}

double largestOf(const Vec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

}  // namespace

void RaggedPieces::clear() {
    rays_.clear();
    open_.clear();
    pieces_.clear();
    maps_.clear();
    middles_.clear();
    outer_.clear();
}

void RaggedPieces::add(const CellLook& look, const Piece& stretch, std::uint32_t cell, const std::array<float, 3>& base,
                       const std::array<float, 3>& along) {
    const auto number = std::uint32_t(rays_.size());
    Ray ray{{}, {}, Vec3(base[0], base[1], base[2]), Vec3(along[0], along[1], along[2]), cell};
    const auto& map = look.cells().cells[cell].index;
    for (std::size_t a = 0; a < 3; ++a) {
        const auto turned = [&](const Vec3& v) {
            return double(map[0][a]) * v.x + double(map[1][a]) * v.y + double(map[2][a]) * v.z;
        };
        ray.start[int(a)] = turned(ray.base) + double(map[3][a]);
        ray.step[int(a)] = turned(ray.along);
    }
    rays_.push_back(ray);
    const int parts = std::max(1, int(std::ceil((stretch.end - stretch.begin) / kLongest)));
    for (int n = 0; n < parts; ++n) {
        const auto cut = [&](int at) {
            return at == parts ? stretch.end : stretch.begin + (stretch.end - stretch.begin) * float(at) / float(parts);
        };
        open_.push_back({{stretch.pixel, cut(n), cut(n + 1)}, number, kUndefined, kUndefined, kUndefined});
    }
}

Vec3 RaggedPieces::placeOn(const Stretch& stretch, double part) const {
    const Ray& ray = rays_[stretch.ray];
    const double u = double(stretch.piece.begin) + part * (double(stretch.piece.end) - double(stretch.piece.begin));
    return ray.start + u * ray.step;
}

Mat3 RaggedPieces::outerAt(const CellLook& look, const Stretch& stretch, double part) const {
    const Ray& ray = rays_[stretch.ray];
    const double u = double(stretch.piece.begin) + part * (double(stretch.piece.end) - double(stretch.piece.begin));
    const Vec3 p = ray.base + u * ray.along;
    const auto& plane = look.cells().cells[ray.cell].plane;
    Mat3 sum(0);
    double weights = 0;
    for (std::size_t v = 0; v < 4; ++v) {
        const double weight = std::max(0.0, double(plane[0][v]) * p.x + double(plane[1][v]) * p.y +
                                                double(plane[2][v]) * p.z + double(plane[3][v]));
        sum += weight * look.cells().outer[look.cells().corners[ray.cell][v]];
        weights += weight;
    }
    return weights > 0 ? sum / weights : Mat3(1);
}

void RaggedPieces::mapEnds(const CellLook& look) {
    points_.resize(2 * open_.size());
    for (std::size_t n = 0; n < open_.size(); ++n) {
        points_[2 * n] = placeOn(open_[n], 0);
        points_[2 * n + 1] = placeOn(open_[n], 1);
    }
    look.way.toIndex(points_, points_);
    for (std::size_t n = 0; n < open_.size(); ++n) {
        open_[n].first = points_[2 * n];
        open_[n].last = points_[2 * n + 1];
    }
}

void RaggedPieces::mapMiddles(const CellLook& look) {
    points_.resize(open_.size());
    for (std::size_t n = 0; n < open_.size(); ++n) points_[n] = placeOn(open_[n], 0.5);
    look.way.toIndex(points_, points_);
    for (std::size_t n = 0; n < open_.size(); ++n) open_[n].middle = points_[n];
}

/// Keeps or drops what is open, or halves it.
void RaggedPieces::halve(const CellLook& look) {
    next_.clear();
    for (const Stretch& s : open_) {
        const bool first = finite(s.first), middle = finite(s.middle), last = finite(s.last);
        if (!first && !middle && !last) continue;
        if (first && middle && last && largestOf(s.middle - 0.5 * (s.first + s.last)) <= kTolerance) {
            keep(look, s);
            continue;
        }
        const Piece& p = s.piece;
        if (!maySee(look, s)) continue;
        const float half = 0.5F * (p.begin + p.end);
        if (p.end - p.begin < kShortest) {
            keepHalves(look, s, half);
            continue;
        }
        next_.push_back({{p.pixel, p.begin, half}, s.ray, s.first, kUndefined, s.middle});
        next_.push_back({{p.pixel, half, p.end}, s.ray, s.middle, kUndefined, s.last});
    }
    std::swap(open_, next_);
}

/// Of a stretch too short to be halved again, the halves that hold no cut.
void RaggedPieces::keepHalves(const CellLook& look, const Stretch& s, float half) {
    const bool middle = finite(s.middle), whole = middle && finite(s.first) && finite(s.last);
    const double before = largestOf(s.middle - s.first), after = largestOf(s.last - s.middle);
    // Where all is defined the larger half holds a jump, unless they are much alike: then the maps only bend.
    if (middle && finite(s.first) && (!whole || before <= 2 * after))
        keep(look, {{s.piece.pixel, s.piece.begin, half}, s.ray, s.first, s.middle, s.middle});
    if (middle && finite(s.last) && (!whole || after <= 2 * before))
        keep(look, {{s.piece.pixel, half, s.piece.end}, s.ray, s.middle, s.middle, s.last});
}

/// False where what lies about a stretch shows nothing.
bool RaggedPieces::maySee(const CellLook& look, const Stretch& s) {
    Box3 hull;
    for (const Vec3& x : {s.first, s.middle, s.last})
        if (finite(x)) hull = join(hull, x);
    // Within a continuous part the end of it lies no further from a place that is known than that from the next.
    double reach = 8 * double(s.piece.end - s.piece.begin);
    for (const Vec3& x : {s.first, s.last})
        if (finite(x) && finite(s.middle)) reach = std::max(reach, largestOf(x - s.middle));
    const Box3 domain = look.look->volumeTerm().volume->grid().indexDomain();
    return look.look->skip().mayBeVisible(intersect({hull.min - reach, hull.max + reach}, domain));
}

void RaggedPieces::keep(const CellLook& look, const Stretch& s) {
    // Only what lies within the volume's domain, and may be seen.
    const Vec3 step = s.last - s.first;
    const Box3 domain = look.look->volumeTerm().volume->grid().indexDomain();
    if (!look.look->skip().mayBeVisible(
            intersect({glm::min(s.first, s.last) - kTolerance, glm::max(s.first, s.last) + kTolerance}, domain)))
        return;
    double from = 0, to = 1;
    for (int a = 0; a < 3; ++a) {
        const double low = domain.min[a] - kBeyond - s.first[a], high = domain.max[a] + kBeyond - s.first[a];
        if (step[a] == 0) {
            if (low > 0 || high < 0) return;
            continue;
        }
        from = std::max(from, std::min(low / step[a], high / step[a]));
        to = std::min(to, std::max(low / step[a], high / step[a]));
    }
    if (!(from < to)) return;
    const double length = double(s.piece.end) - double(s.piece.begin);
    Piece piece = s.piece;
    piece.begin = static_cast<float>(s.piece.begin + from * length);
    if (to < 1) piece.end = static_cast<float>(s.piece.begin + to * length);
    OwnPiece map{};
    for (int a = 0; a < 3; ++a) {
        const double perStep = step[a] / length;
        map.step[std::size_t(a)] = static_cast<float>(perStep);
        map.start[std::size_t(a)] = static_cast<float>(s.first[a] - s.piece.begin * perStep);
    }
    pieces_.push_back(piece);
    maps_.push_back(map);
    middles_.push_back(placeOn(s, 0.5 * (from + to)));
    if (look.turned && !look.cells().outer.empty()) outer_.push_back(outerAt(look, s, 0.5 * (from + to)));
}

void RaggedPieces::turn(const CellLook& look) {
    turns_.resize(middles_.size());
    look.way.turns(middles_, outer_, turns_);
    for (std::size_t n = 0; n < maps_.size(); ++n) maps_[n].turn = turns_[n];
}

void RaggedPieces::find(const CellLook& look) {
    mapEnds(look);
    while (!open_.empty()) {
        mapMiddles(look);
        halve(look);
    }
    if (look.turned && !pieces_.empty()) turn(look);
}

}  // namespace voledit
