#include "core/stf/mapped_cells.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <mutex>
#include <string>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/stf/cell_locator.h"
#include "core/stf/cell_overlap.h"
#include "core/stf/overlapping_cells.h"
#include "core/stf/source_solid.h"

namespace voledit {

// A path along the hexahedron's edges from 0 to 7 for each order of the axes; the two orders' orientations alternate,
// so that the middle vertices are swapped in every second one.
const std::array<std::array<int, 4>, 6> kHexahedronTetrahedra{
    {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};

namespace {

constexpr std::size_t kSorted = 1 << 17;             // points ordered together: some for each grid cell of 16³ cells
constexpr std::size_t kMaxTetrahedra = 300'000'000;  // point location counts in 32 bits

bool finite(const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

template <std::size_t N>
void validateIndices(const std::vector<std::array<std::uint32_t, N>>& cells, std::size_t vertices,
                     const std::string& remedy) {
    for (std::size_t c = 0; c < cells.size(); ++c)
        for (const std::uint32_t v : cells[c])
            if (v >= vertices)
                throw Error("mapped cells",
                            "cell " + std::to_string(c) + " names vertex " + std::to_string(v) + " of " +
                                std::to_string(vertices),
                            remedy);
}

void validate(const MappedCells::Data& data) {
    const std::string remedy = "give each cell indices of vertices and each deformed point a finite source point";
    if (data.deformed.size() != data.source.size())
        throw Error("mapped cells",
                    std::to_string(data.deformed.size()) + " deformed positions but " +
                        std::to_string(data.source.size()) + " source coordinates",
                    remedy);
    if (!data.jacobian.empty() && data.jacobian.size() != data.deformed.size())
        throw Error("mapped cells", "there must be one Jacobian for each vertex or none", remedy);
    for (const auto* positions : {&data.deformed, &data.source})
        for (std::size_t v = 0; v < positions->size(); ++v)
            if (!finite((*positions)[v]))
                throw Error("mapped cells", "position " + std::to_string(v) + " is not finite", remedy);
    if (!data.hexahedra.empty() && !data.tetrahedra.empty())
        throw Error("mapped cells", "there are hexahedra and tetrahedra", "split the hexahedra into tetrahedra");
    validateIndices(data.hexahedra, data.deformed.size(), remedy);
    validateIndices(data.tetrahedra, data.deformed.size(), remedy);
    if (6 * data.hexahedra.size() + data.tetrahedra.size() > kMaxTetrahedra)
        throw Error("mapped cells",
                    std::to_string(data.hexahedra.size() + data.tetrahedra.size()) + " cells are too many",
                    "use at most " + std::to_string(kMaxTetrahedra) + " tetrahedra, six for each hexahedron");
}

/// Edges of a tetrahedron from its first vertex, as columns.
Mat3 edges(const std::vector<Vec3>& positions, const std::array<std::uint32_t, 4>& t) {
    const Vec3& origin = positions[t[0]];
    return Mat3(positions[t[1]] - origin, positions[t[2]] - origin, positions[t[3]] - origin);
}

/// Inverse of `m` times its determinant, as rows' cross products; needs no division.
Mat3 adjugate(const Mat3& m) {
    return glm::transpose(Mat3(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])));
}

/// dp/dq's determinant, 0 for a tetrahedron that is thinner than `thickness`.
double determinantOf(const Mat3& deformed, const Mat3& source, double thickness) {
    const double volume = glm::determinant(deformed);
    const Mat3 faces = glm::transpose(adjugate(deformed));
    const double largestFace = std::max({glm::length(faces[0]), glm::length(faces[1]), glm::length(faces[2]),
                                         glm::length(faces[0] + faces[1] + faces[2])});
    if (std::abs(volume) <= thickness * largestFace) return 0;
    const double rest = glm::determinant(source);
    return rest == 0 ? std::copysign(kInfinity, volume) : volume / rest;
}

/// dq/dp at the vertices: the mean of the tetrahedra around each, weighted by deformed volume.
std::vector<Mat3> averagedJacobians(const MappedCells::Data& data,
                                    const std::vector<std::array<std::uint32_t, 4>>& tetrahedra,
                                    const std::vector<double>& determinants) {
    std::vector<Mat3> sum(data.deformed.size(), Mat3(0));
    std::vector<double> weight(data.deformed.size(), 0);
    for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
        if (determinants[t] == 0) continue;
        const Mat3 deformed = edges(data.deformed, tetrahedra[t]);
        const double volume = glm::determinant(deformed);
        // Weighted by |volume|, the inverse needs no division by it.
        const Mat3 weighted = edges(data.source, tetrahedra[t]) * adjugate(deformed) * std::copysign(1.0, volume);
        for (const std::uint32_t v : tetrahedra[t]) {
            sum[v] += weighted;
            weight[v] += std::abs(volume);
        }
    }
    for (std::size_t v = 0; v < sum.size(); ++v) sum[v] = weight[v] > 0 ? sum[v] / weight[v] : Mat3(1);
    return sum;
}

}  // namespace

struct MappedCells::Lazy {
    std::once_flag locatorOnce, overlapOnce, overlappingOnce, facesOnce;
    std::unique_ptr<const CellLocator> locator;
    bool overlap = false;
    std::vector<char> overlapping;
    std::vector<Vec4> sourceFaces;
};

MappedCells::MappedCells(Data data) : data_(std::move(data)), lazy_(std::make_unique<Lazy>()) {
    validate(data_);
    tetrahedra_ = std::move(data_.tetrahedra);
    data_.tetrahedra.clear();
    splitHexahedra();
    for (std::size_t c = 0; c < cellCount(); ++c)
        for (const std::uint32_t v : cellVertices(c)) bounds_ = join(bounds_, data_.deformed[v]);
    setThickness();
    determinants_.resize(tetrahedra_.size());
    parallelFor(tetrahedra_.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t)
            determinants_[t] =
                determinantOf(edges(data_.deformed, tetrahedra_[t]), edges(data_.source, tetrahedra_[t]), thickness_);
    });
    if (data_.jacobian.empty()) data_.jacobian = averagedJacobians(data_, tetrahedra_, determinants_);
}

void MappedCells::setThickness() {
    double largest = 0;
    if (!bounds_.empty())
        for (int a = 0; a < 3; ++a)
            largest = std::max({largest, std::abs(bounds_.min[a]), std::abs(bounds_.max[a]), bounds_.size()[a]});
    thickness_ = 32 * std::numeric_limits<double>::epsilon() * largest;
}

void MappedCells::splitHexahedra() {
    if (data_.hexahedra.empty()) return;
    tetrahedra_.resize(data_.hexahedra.size() * 6);
    parallelFor(data_.hexahedra.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t h = begin; h < end; ++h)
            for (std::size_t n = 0; n < 6; ++n)
                for (std::size_t v = 0; v < 4; ++v)
                    tetrahedra_[6 * h + n][v] = data_.hexahedra[h][std::size_t(kHexahedronTetrahedra[n][v])];
    });
}

MappedCells::~MappedCells() = default;

const CellLocator& MappedCells::locator() const {
    std::call_once(lazy_->locatorOnce, [this] { lazy_->locator = std::make_unique<const CellLocator>(*this); });
    return *lazy_->locator;
}

bool MappedCells::mayOverlap() const {
    std::call_once(lazy_->overlapOnce, [this] { lazy_->overlap = cellsMayOverlap(*this); });
    return lazy_->overlap;
}

std::span<const char> MappedCells::overlapping() const {
    std::call_once(lazy_->overlappingOnce, [this] {
        lazy_->overlapping = mayOverlap() ? overlappingCells(*this) : std::vector<char>(cellCount(), 0);
    });
    return lazy_->overlapping;
}

std::span<const Vec4> MappedCells::sourceFaces() const {
    std::call_once(lazy_->facesOnce, [this] { lazy_->sourceFaces = findSourceFaces(*this); });
    return lazy_->sourceFaces;
}

bool MappedCells::locateAlone(const Vec3& p, std::uint32_t& hint, CellLocation& found) const {
    assert(hint < tetrahedra_.size());
    return !overlapping()[hint / tetrahedraPerCell()] && locator().wellInside(p, hint, found);
}

bool MappedCells::locate(const Vec3& p, CellLocation& found) const {
    return locator().first(p, found);
}

bool MappedCells::locateNear(const Vec3& p, std::uint32_t& hint, CellLocation& found) const {
    assert(hint < tetrahedra_.size());
    if (!mayOverlap() && locator().wellInside(p, hint, found)) return true;
    if (!locator().first(p, found)) return false;
    hint = found.tetrahedron;
    return true;
}

void MappedCells::locateAll(const Vec3& p, std::vector<CellLocation>& found) const {
    const std::size_t before = found.size();
    locator().all(p, found);
    if (found.size() < before + 2) return;
    // How far apart the sources of one point may come out, in two tetrahedra that both touch it.
    const auto slack = [&](const CellLocation& at) {
        const auto& t = tetrahedra_[at.tetrahedron];
        const Mat3 deformed = edges(data_.deformed, t);
        const Mat3 stretch = edges(data_.source, t) * adjugate(deformed) / glm::determinant(deformed);
        const double largest = glm::length(stretch[0]) + glm::length(stretch[1]) + glm::length(stretch[2]);
        return 4 * thickness_ * largest + 32 * std::numeric_limits<double>::epsilon() * glm::length(sourceAt(at));
    };
    std::size_t kept = before + 1;
    for (std::size_t n = before + 1; n < found.size(); ++n) {
        const bool again =
            std::any_of(found.begin() + std::ptrdiff_t(before), found.begin() + std::ptrdiff_t(kept),
                        [&](const CellLocation& other) {
                            return glm::length(sourceAt(found[n]) - sourceAt(other)) <= slack(found[n]) + slack(other);
                        });
        if (!again) found[kept++] = found[n];
    }
    found.resize(kept);
}

Vec3 MappedCells::sourceAt(const CellLocation& at) const {
    const auto& t = tetrahedra_[at.tetrahedron];
    const Vec3& origin = data_.source[t[0]];
    return origin + at.barycentric[1] * (data_.source[t[1]] - origin) +
           at.barycentric[2] * (data_.source[t[2]] - origin) + at.barycentric[3] * (data_.source[t[3]] - origin);
}

Mat3 MappedCells::jacobianAt(const CellLocation& at) const {
    const auto& t = tetrahedra_[at.tetrahedron];
    Mat3 result(0);
    for (std::size_t v = 0; v < 4; ++v) result += at.barycentric[v] * data_.jacobian[t[v]];
    return result;
}

bool MappedCells::anyTetrahedron(const Box3& box, const std::function<bool(std::uint32_t)>& found) const {
    // A point that a tetrahedron accepts from just outside is taken for one within.
    const double slack = 8 * thickness_;
    return locator().anyMeeting({box.min - slack, box.max + slack}, found);
}

bool MappedCells::anySourceBox(const Box3& box, const std::function<bool(const Box3&)>& found) const {
    const Vec3 centre = box.center(), half = 0.5 * (box.max - box.min) + 8 * thickness_;
    return anyTetrahedron(box, [&](std::uint32_t n) {
        const auto& t = tetrahedra_[n];
        const Mat3 stretch = edges(data_.source, t) * locator().weightsFromEdge(n);
        const Vec3 middle = data_.source[t[0]] + stretch * (centre - data_.deformed[t[0]]);
        Vec3 reach(0);
        for (int c = 0; c < 3; ++c) reach += glm::abs(stretch[c]) * half[c];
        Box3 whole;
        for (const std::uint32_t v : t) whole = join(whole, data_.source[v]);
        // Neither bound alone is tight: the box may reach beyond the tetrahedron, and it beyond the box.
        const double rounding = 1e-12 * (glm::length(middle) + glm::length(reach));
        const Box3 common = intersect({middle - reach - rounding, middle + reach + rounding}, whole);
        return !common.empty() && found(common);
    });
}

void MappedCells::map(std::span<const Vec3> p, std::span<Vec3> q) const {
    assert(p.size() == q.size());
    if (tetrahedra_.empty()) return std::fill(q.begin(), q.end(), kUndefined);
    const CellLocator& by = locator();
    const auto first = p.first(std::min(p.size(), kSorted));
    if (by.sortingPays(first) && (mayOverlap() || !by.followClosely(first)))
        return parallelFor(p.size(), kSorted, [&](std::size_t begin, std::size_t end) {
            by.firstOfMany(p.subspan(begin, end - begin), *this, q.subspan(begin, end - begin));
        });
    parallelFor(p.size(), 4096, [&](std::size_t begin, std::size_t end) {
        CellLocation at{};
        std::uint32_t hint = 0;
        for (std::size_t i = begin; i < end; ++i) q[i] = locateNear(p[i], hint, at) ? sourceAt(at) : kUndefined;
    });
}

MappedCells::Data gridCells(const Frame& frame, Index3 count) {
    assert(count.x > 0 && count.y > 0 && count.z > 0);
    MappedCells::Data data;
    const Index3 vertices = count + 1;
    data.source.reserve(std::size_t(vertices.x) * std::size_t(vertices.y) * std::size_t(vertices.z));
    data.hexahedra.reserve(std::size_t(count.x) * std::size_t(count.y) * std::size_t(count.z));
    for (int k = 0; k <= count.z; ++k)
        for (int j = 0; j <= count.y; ++j)
            for (int i = 0; i <= count.x; ++i)
                data.source.push_back(frame.corner + double(i) / count.x * frame.edge[0] +
                                      double(j) / count.y * frame.edge[1] + double(k) / count.z * frame.edge[2]);
    data.deformed = data.source;
    const auto vertex = [&](int i, int j, int k) {
        return std::uint32_t(i) +
               std::uint32_t(vertices.x) * (std::uint32_t(j) + std::uint32_t(vertices.y) * std::uint32_t(k));
    };
    for (int k = 0; k < count.z; ++k)
        for (int j = 0; j < count.y; ++j)
            for (int i = 0; i < count.x; ++i)
                data.hexahedra.push_back({vertex(i, j, k), vertex(i + 1, j, k), vertex(i, j + 1, k),
                                          vertex(i + 1, j + 1, k), vertex(i, j, k + 1), vertex(i + 1, j, k + 1),
                                          vertex(i, j + 1, k + 1), vertex(i + 1, j + 1, k + 1)});
    return data;
}

}  // namespace voledit
