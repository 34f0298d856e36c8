#include "core/skeleton/limb_regions.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <optional>

#include "core/base/error.h"
#include "core/skeleton/limb_checks.h"
#include "core/skeleton/limb_hubs.h"
#include "core/skeleton/limb_interior.h"
#include "core/skeleton/limb_jacobians.h"

namespace voledit {
namespace {

/// The bevels' layers for the widest wedge, of a bone bent straight back: no layer opens more than 45°.
int bevelLayers(double miterLimit) {
    const double widest = kPi - largestMitre(miterLimit);
    return std::max(1, int(std::ceil(widest / (kPi / 4) - 1e-9)));
}

/// Corners of the plane that ends a limb which is not connected there.
Quad plainFace(const PlacedLimb& limb, const Vec3& at) {
    Quad face;
    for (std::size_t m = 0; m < 4; ++m) face[m] = at + limb.section[m];
    return face;
}

/// Where limbs meet, at rest and posed; at the first limb's end.
struct Connection {
    JointFaces rest, posed;
    bool shared() const { return rest.wedge == 0 && posed.wedge == 0; }
};

class RegionBuilder {
public:
    RegionBuilder(const std::vector<Limb>& limbs, const std::vector<PosedJoint>& rest,
                  const std::vector<PosedJoint>& posed, const RegionOptions& options)
        : limbs_(limbs), rest_(rest), posed_(posed), options_(options), grid_{options.cells} {}

    LimbRegions build() {
        links_ = linkedLimbs(limbs_, rest_, options_.disjoint);
        requireNoCircle(limbs_, links_);
        placeLimbs();
        shapeLimbs();
        fillPositions();
        if (options_.smooth) smooth();
        if (options_.preserveVolume) preserveVolume();
        if (options_.smooth) repeated_ = blendHubs(hubLimbs(), grid_, sources_, deformed_);
        numberVertices();
        writeVertices();
        for (std::size_t l = 0; l < limbs_.size(); ++l) writeHexahedra(l);
        regions_.firstCell.push_back(regions_.cells.hexahedra.size());
        regions_.repeated.resize(regions_.cells.hexahedra.size(), 0);
        for (std::size_t l = 0; l < repeated_.size(); ++l)
            std::copy(repeated_[l].begin(), repeated_[l].end(),
                      regions_.repeated.begin() + std::ptrdiff_t(regions_.firstCell[l]));
        regions_.cells.jacobian = limbJacobians(regions_.cells.deformed, regions_.cells.source, grid_, layers_);
        for (std::size_t l = 0; l < limbs_.size(); ++l)
            if (hasBevel(l)) writeBevelJacobians(l);
        return std::move(regions_);
    }

    std::vector<HubRole> roles() {
        links_ = linkedLimbs(limbs_, rest_, options_.disjoint);
        requireNoCircle(limbs_, links_);
        placeLimbs();
        shapeLimbs();
        std::vector<HubRole> roles(limbs_.size(), HubRole::None);
        const auto raise = [&](int l, HubRole role) {
            if (l >= 0) roles[std::size_t(l)] = std::max(roles[std::size_t(l)], role);
        };
        for (const HubRoot& root : hubRoots(hubLimbs())) {
            raise(root.limb, HubRole::Rooted);
            raise(root.in, HubRole::Holds);
            raise(links_.next[std::size_t(root.limb)], HubRole::Next);
            raise(links_.next[std::size_t(root.in)], HubRole::Beside);
            raise(links_.previous[std::size_t(root.in)], HubRole::Beside);
        }
        return roles;
    }

private:
    HubLimbs hubLimbs() const { return {limbs_, links_, rest_, motions_, options_.disjoint}; }
    std::size_t next(std::size_t l) const { return std::size_t(links_.next[l]); }
    bool hasBevel(std::size_t l) const { return connections_[l] && connections_[l]->posed.wedge > 0; }

    /// Where a limb's bone ends: a disjoint joint that moves away leaves it its length.
    PosedJoint posedEnd(const Limb& limb) const;
    void placeLimbs();
    void shapeLimbs();
    void fillPositions();
    void smooth();
    void preserveVolume();
    void numberVertices();
    void writeVertices();
    void writeHexahedra(std::size_t l);
    void writeBevel(std::size_t l);
    void writeBevelJacobians(std::size_t l);
    /// The first vertex of layer s of limb l's bevel: its end's for 0, the next limb's start's for the last.
    std::uint32_t bevelLayer(std::size_t l, int s) const;

    const std::vector<Limb>& limbs_;
    const std::vector<PosedJoint>& rest_;
    const std::vector<PosedJoint>& posed_;
    const RegionOptions& options_;
    const LimbGrid grid_;

    LimbLinks links_;
    std::vector<PlacedLimb> placedRest_, placedPosed_;
    std::vector<std::optional<Connection>> connections_;  // at each limb's end
    std::vector<LimbMotion> motions_;
    std::vector<std::vector<Vec3>> sources_, deformed_;  // of each limb's whole grid, shared faces twice
    std::vector<EndCorrection> starts_, ends_;
    LimbLayers layers_;                        // first vertex of each limb's layers
    std::vector<std::uint32_t> bevels_;        // first vertex of the layers within each limb's bevel
    std::vector<std::vector<char>> repeated_;  // of each limb's cells; empty where nothing is blended
    LimbRegions regions_;
};

PosedJoint RegionBuilder::posedEnd(const Limb& limb) const {
    const std::size_t from = std::size_t(limb.from), to = std::size_t(limb.to);
    PosedJoint end = posed_[to];
    if (!options_.disjoint.empty() && options_.disjoint[to])
        end.position = posed_[from].position + posed_[from].linear * (rest_[to].position - rest_[from].position);
    return end;
}

void RegionBuilder::placeLimbs() {
    placedRest_.resize(limbs_.size());
    placedPosed_.resize(limbs_.size());
    connections_.resize(limbs_.size());
    std::vector<int> turns(limbs_.size(), 0);
    for (const int index : links_.order) {
        const std::size_t l = std::size_t(index);
        const Limb& limb = limbs_[l];
        const PosedJoint &from = rest_[std::size_t(limb.from)], &to = rest_[std::size_t(limb.to)];
        const Mat3 frame = boneFrame(glm::normalize(to.position - from.position), limb.roll);
        const int previous = links_.previous[l];
        if (previous >= 0) {
            const PlacedLimb unturned = placedLimb(limb, frame, 0, from, to);
            turns[l] = matchingTurns(placedRest_[std::size_t(previous)], unturned, options_.miterLimit);
        }
        placedRest_[l] = placedLimb(limb, frame, turns[l], from, to);
        placedPosed_[l] = placedLimb(limb, frame, turns[l], posed_[std::size_t(limb.from)], posedEnd(limb));
        if (previous >= 0) {
            const std::size_t p = std::size_t(previous);
            connections_[p] = Connection{jointFaces(placedRest_[p], placedRest_[l], options_.miterLimit),
                                         jointFaces(placedPosed_[p], placedPosed_[l], options_.miterLimit)};
        }
    }
}

void RegionBuilder::shapeLimbs() {
    motions_.resize(limbs_.size());
    for (std::size_t l = 0; l < limbs_.size(); ++l) {
        const auto shape = [&](const PlacedLimb& placed, JointFaces Connection::*pose) {
            LimbShape result;
            result.boneStart = placed.start;
            result.boneEnd = placed.end;
            if (links_.previous[l] >= 0) {
                result.start = ((*connections_[std::size_t(links_.previous[l])]).*pose).start;
            } else {
                result.boneStart -= limbs_[l].pad.x * placed.along;
                result.start = plainFace(placed, result.boneStart);
            }
            if (links_.next[l] >= 0) {
                result.end = ((*connections_[l]).*pose).end;
            } else {
                result.boneEnd += limbs_[l].pad.y * placed.along;
                result.end = plainFace(placed, result.boneEnd);
            }
            return result;
        };
        motions_[l].rest = shape(placedRest_[l], &Connection::rest);
        motions_[l].posed = shape(placedPosed_[l], &Connection::posed);
        motions_[l].bone[0] = placedRest_[l].bone[0];
        motions_[l].bone[1] = placedRest_[l].bone[1];
    }
}

void RegionBuilder::fillPositions() {
    starts_.resize(limbs_.size());
    ends_.resize(limbs_.size());
    sources_.assign(limbs_.size(), std::vector<Vec3>(grid_.size()));
    deformed_ = sources_;
    for (std::size_t l = 0; l < limbs_.size(); ++l) {
        fillTrilinear(motions_[l].rest, grid_, sources_[l]);
        fillTrilinear(motions_[l].posed, grid_, deformed_[l]);
    }
}

void RegionBuilder::smooth() {
    for (std::size_t l = 0; l < limbs_.size(); ++l)
        if (connections_[l]) {
            JointCorrections corrections =
                jointCorrections(motions_[l], motions_[next(l)], connections_[l]->rest, connections_[l]->posed, grid_);
            ends_[l] = std::move(corrections.end);
            starts_[next(l)] = std::move(corrections.start);
        }
    for (std::size_t l = 0; l < limbs_.size(); ++l) {
        addCorrection(grid_, starts_[l], false, deformed_[l]);
        addCorrection(grid_, ends_[l], true, deformed_[l]);
    }
}

void RegionBuilder::preserveVolume() {
    std::vector<std::vector<double>> scales(limbs_.size());
    for (std::size_t l = 0; l < limbs_.size(); ++l)
        scales[l] = layerScales(motions_[l], grid_, starts_[l], ends_[l], sources_[l], deformed_[l]);
    // Without smoothing the bone's derivative jumps at a face: both sides come to the mean of what they need.
    const auto bring = [&](std::vector<double>& of, bool atEnd, double to) {
        const double ratio = to / (atEnd ? of.back() : of.front());
        for (int k = 0; k <= grid_.cells.z; ++k) {
            const double w = double(k) / grid_.cells.z;
            const double near = std::max(0.0, 1 - 2 * (atEnd ? 1 - w : w));
            of[std::size_t(k)] *= 1 + (ratio - 1) * near * near;
        }
    };
    for (std::size_t l = 0; l < limbs_.size(); ++l)
        if (connections_[l]) {
            const double mean = std::sqrt(scales[l].back() * scales[next(l)].front());
            bring(scales[l], true, mean);
            bring(scales[next(l)], false, mean);
        }
    for (std::size_t l = 0; l < limbs_.size(); ++l)
        scaleLayers(motions_[l], grid_, starts_[l], ends_[l], scales[l], deformed_[l]);
}

void RegionBuilder::numberVertices() {
    const std::size_t layer = grid_.layerSize(), layerCount = std::size_t(grid_.cells.z) + 1;
    const std::size_t within = std::size_t(bevelLayers(options_.miterLimit)) - 1;
    layers_.resize(limbs_.size());
    bevels_.resize(limbs_.size());
    std::size_t vertices = 0;
    for (std::size_t l = 0; l < limbs_.size(); ++l) {
        const int previous = links_.previous[l];
        layers_[l].assign(layerCount, 0);
        for (std::size_t k = previous >= 0 && connections_[std::size_t(previous)]->shared() ? 1 : 0; k < layerCount;
             ++k) {
            layers_[l][k] = std::uint32_t(vertices);
            vertices += layer;
        }
        bevels_[l] = std::uint32_t(vertices);
        if (hasBevel(l)) vertices += within * layer;
    }
    for (std::size_t l = 0; l < limbs_.size(); ++l)
        if (connections_[l] && connections_[l]->shared()) layers_[next(l)].front() = layers_[l].back();
    regions_.cells.deformed.resize(vertices);
    regions_.cells.source.resize(vertices);
}

void RegionBuilder::writeVertices() {
    const std::size_t layer = grid_.layerSize();
    // Both limbs write the same numbers where they share a face, but for the rounding of its scale: the first limb's
    // hold.
    for (auto l = links_.order.rbegin(); l != links_.order.rend(); ++l) {
        const std::size_t limb = std::size_t(*l);
        for (std::size_t k = 0; k < layers_[limb].size(); ++k) {
            const auto first = std::ptrdiff_t(k * layer), target = std::ptrdiff_t(layers_[limb][k]);
            std::copy_n(sources_[limb].begin() + first, layer, regions_.cells.source.begin() + target);
            std::copy_n(deformed_[limb].begin() + first, layer, regions_.cells.deformed.begin() + target);
        }
    }
}

void RegionBuilder::writeHexahedra(std::size_t l) {
    regions_.firstCell.push_back(regions_.cells.hexahedra.size());
    const std::uint32_t row = std::uint32_t(grid_.cells.x) + 1;
    for (std::size_t k = 0; k < std::size_t(grid_.cells.z); ++k)
        for (std::uint32_t j = 0; j < std::uint32_t(grid_.cells.y); ++j)
            for (std::uint32_t i = 0; i < std::uint32_t(grid_.cells.x); ++i) {
                const std::uint32_t low = layers_[l][k] + i + row * j, high = layers_[l][k + 1] + i + row * j;
                regions_.cells.hexahedra.push_back(
                    {low, low + 1, low + row, low + row + 1, high, high + 1, high + row, high + row + 1});
            }
    if (hasBevel(l)) writeBevel(l);
}

std::uint32_t RegionBuilder::bevelLayer(std::size_t l, int s) const {
    if (s == 0) return layers_[l].back();
    if (s == bevelLayers(options_.miterLimit)) return layers_[next(l)].front();
    return bevels_[l] + std::uint32_t(std::size_t(s - 1) * grid_.layerSize());
}

void RegionBuilder::writeBevel(std::size_t l) {
    const Connection& connection = *connections_[l];
    const int count = bevelLayers(options_.miterLimit);
    MappedCells::Data& cells = regions_.cells;
    const auto turned = [](const JointFaces& faces, double part, const Vec3& point) {
        if (faces.wedge == 0) return point;
        return faces.joint + glm::angleAxis(part * faces.wedge, faces.axis) * (point - faces.joint);
    };
    const std::uint32_t layer = std::uint32_t(grid_.layerSize()), end = layers_[l].back();
    for (int s = 1; s < count; ++s)
        for (std::uint32_t n = 0; n < layer; ++n) {
            const std::uint32_t vertex = bevelLayer(l, s) + n;
            cells.source[vertex] = turned(connection.rest, double(s) / count, cells.source[end + n]);
            cells.deformed[vertex] = turned(connection.posed, double(s) / count, cells.deformed[end + n]);
        }
    const std::uint32_t row = std::uint32_t(grid_.cells.x) + 1;
    for (int s = 0; s < count; ++s)
        for (std::uint32_t j = 0; j < std::uint32_t(grid_.cells.y); ++j)
            for (std::uint32_t i = 0; i < std::uint32_t(grid_.cells.x); ++i) {
                const std::uint32_t corner = i + row * j;
                const auto opens = [&](std::uint32_t n) { return connection.posed.outside(cells.deformed[end + n]); };
                // On the inside of the bend the limbs overlap. A cell across the axis is kept whole, so that the
                // wedge is closed up to its edge.
                if (!opens(corner) && !opens(corner + 1) && !opens(corner + row) && !opens(corner + row + 1)) continue;
                const std::uint32_t low = bevelLayer(l, s) + corner, high = bevelLayer(l, s + 1) + corner;
                cells.hexahedra.push_back(
                    {low, low + 1, low + row, low + row + 1, high, high + 1, high + row, high + row + 1});
            }
}

void RegionBuilder::writeBevelJacobians(std::size_t l) {
    const JointFaces &rest = connections_[l]->rest, &posed = connections_[l]->posed;
    const int count = bevelLayers(options_.miterLimit);
    std::vector<Mat3>& jacobian = regions_.cells.jacobian;
    const auto about = [](const JointFaces& faces, double part) {
        return faces.wedge > 0 ? glm::angleAxis(part * faces.wedge, faces.axis) : Quat(1, 0, 0, 0);
    };
    // A face's Jacobian, turned on by parts of both wedges; written about the identity, which stays so to the bit.
    const auto turned = [&](const Mat3& of, double part) {
        const Quat restTurn = about(rest, part), back = glm::conjugate(about(posed, part));
        return glm::mat3_cast(restTurn) * (of - Mat3(1)) * glm::mat3_cast(back) + glm::mat3_cast(restTurn * back);
    };
    const std::uint32_t first = bevelLayer(l, 0), last = bevelLayer(l, count);
    for (int s = 1; s < count; ++s) {
        const double part = double(s) / count;
        for (std::uint32_t n = 0; n < grid_.layerSize(); ++n) {
            const Mat3 fromEnd = turned(jacobian[first + n], part), fromStart = turned(jacobian[last + n], part - 1);
            jacobian[bevelLayer(l, s) + n] = fromEnd + part * (fromStart - fromEnd);
        }
    }
}

}  // namespace

LimbRegions limbRegions(const std::vector<Limb>& limbs, const std::vector<PosedJoint>& rest,
                        const std::vector<PosedJoint>& posed, const RegionOptions& options) {
    requireValid(limbs, rest, posed, options);
    return RegionBuilder(limbs, rest, posed, options).build();
}

std::vector<HubRole> hubRoles(const std::vector<Limb>& limbs, const std::vector<PosedJoint>& rest,
                              const std::vector<bool>& disjoint) {
    RegionOptions options;
    options.disjoint = disjoint;
    requireValid(limbs, rest, rest, options);
    return RegionBuilder(limbs, rest, rest, options).roles();
}

MappedCells::Data joinedCells(const LimbRegions& regions) {
    MappedCells::Data cells = regions.cells;
    cells.hexahedra.clear();
    for (std::size_t c = 0; c < regions.cells.hexahedra.size(); ++c)
        if (!regions.repeated[c]) cells.hexahedra.push_back(regions.cells.hexahedra[c]);
    return cells;
}

MappedCells::Data cellsOf(const LimbRegions& regions, const std::vector<int>& limbs) {
    constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
    const MappedCells::Data& all = regions.cells;
    MappedCells::Data cells;
    std::vector<std::uint32_t> renumbered(all.deformed.size(), kUnused);
    for (const int limb : limbs)
        for (std::size_t c = regions.firstCell[std::size_t(limb)]; c < regions.firstCell[std::size_t(limb) + 1]; ++c) {
            std::array<std::uint32_t, 8> cell = all.hexahedra[c];
            for (std::uint32_t& vertex : cell) {
                std::uint32_t& number = renumbered[vertex];
                if (number == kUnused) {
                    number = std::uint32_t(cells.deformed.size());
                    cells.deformed.push_back(all.deformed[vertex]);
                    cells.source.push_back(all.source[vertex]);
                    cells.jacobian.push_back(all.jacobian[vertex]);
                }
                vertex = number;
            }
            cells.hexahedra.push_back(cell);
        }
    return cells;
}

std::vector<std::vector<Vec3>> outlineOf(const LimbRegions& regions, int limb, const RegionOptions& options) {
    const Index3 count = options.cells;
    const auto vertex = [&](Index3 at) {
        const Index3 cell = glm::min(at, count - 1), corner = at - cell;
        const std::size_t index =
            std::size_t(cell.x) +
            std::size_t(count.x) * (std::size_t(cell.y) + std::size_t(count.y) * std::size_t(cell.z));
        const auto& vertices = regions.cells.hexahedra[regions.firstCell[std::size_t(limb)] + index];
        return regions.cells.deformed[vertices[std::size_t(corner.x + 2 * corner.y + 4 * corner.z)]];
    };
    std::vector<std::vector<Vec3>> edges;
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 4; ++side) {
            Index3 at(0);
            at[(axis + 1) % 3] = (side & 1) * count[(axis + 1) % 3];
            at[(axis + 2) % 3] = (side >> 1) * count[(axis + 2) % 3];
            std::vector<Vec3> edge;
            for (at[axis] = 0; at[axis] <= count[axis]; ++at[axis]) edge.push_back(vertex(at));
            edges.push_back(std::move(edge));
        }
    return edges;
}

}  // namespace voledit
