#include "core/rigging/limb_parts.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <queue>

#include "core/base/parallel.h"
#include "core/rigging/grid_steps.h"

namespace voledit {

namespace {

/// Spreads the limbs from their bones through the object, each as fast as its bone lies deep where it started: so thick
/// limbs take more than thin ones, and no limb takes what lies near it across a gap.
class Spread {
public:
    Spread(const OpaqueVoxels& voxels, const std::vector<float>& distance)
        : voxels_(voxels),
          distance_(distance),
          steps_(neighbourSteps(voxels)),
          least_(1.5 * std::max({voxels.spacing.x, voxels.spacing.y, voxels.spacing.z})),
          arrival_(distance.size(), kNever),
          speed_(distance.size(), 0),
          limb_(distance.size(), kNoLimb) {}

    void start(std::int16_t limb, const Vec3& from, const Vec3& to, bool atHub) {
        // Where several limbs begin, each begins a little way out, so that what lies behind the joint goes to the one
        // that bends towards it.
        const double begin = atHub ? 0.15 : 0;
        const int pieces = std::max(2, static_cast<int>(std::ceil(4 * glm::length(to - from) / least_)));
        bool inside = false;
        for (int i = 0; i <= pieces; ++i) inside |= startAt(limb, glm::mix(from, to, begin + (1 - begin) * i / pieces));
        if (!inside) startNearest(limb, 0.5 * (from + to));
    }

    std::vector<std::int16_t> run() {
        while (!open_.empty()) {
            const auto [time, i] = open_.top();
            open_.pop();
            if (time > arrival_[i]) continue;
            const Index3 c = cellOf(voxels_, i);
            for (const NeighbourStep& s : steps_) {
                if (!isInside(voxels_, c + s.by)) continue;
                const auto j = static_cast<std::uint32_t>(std::ptrdiff_t(i) + s.offset);
                if (voxels_.opaque[j]) arrive(j, limb_[i], time + static_cast<float>(s.length) / speed_[i], speed_[i]);
            }
        }
        return std::move(limb_);
    }

private:
    static constexpr float kNever = std::numeric_limits<float>::infinity();
    using Entry = std::pair<float, std::uint32_t>;

    bool startAt(std::int16_t limb, const Vec3& p) {
        const Index3 c = cellAt(voxels_, p);
        if (!isInside(voxels_, c) || !voxels_.opaque[voxels_.indexOf(c)]) return false;
        const double speed = std::max(least_, distanceAt(voxels_, distance_, p));
        arrive(static_cast<std::uint32_t>(voxels_.indexOf(c)), limb,
               static_cast<float>(glm::length(voxels_.centre(c) - p) / speed), static_cast<float>(speed));
        return true;
    }
    /// A bone that lies outside altogether still has a say, from the nearest opaque voxel.
    void startNearest(std::int16_t limb, const Vec3& p) {
        double nearest = kInfinity;
        std::uint32_t found = 0;
        for (std::uint32_t i = 0; i < voxels_.opaque.size(); ++i)
            if (voxels_.opaque[i])
                if (const double d = glm::length(voxels_.centre(cellOf(voxels_, i)) - p); d < nearest)
                    std::tie(nearest, found) = std::pair(d, i);
        if (nearest < kInfinity) arrive(found, limb, static_cast<float>(nearest / least_), static_cast<float>(least_));
    }
    void arrive(std::uint32_t cell, std::int16_t limb, float time, float speed) {
        if (time >= arrival_[cell]) return;
        arrival_[cell] = time;
        speed_[cell] = speed;
        limb_[cell] = limb;
        open_.emplace(time, cell);
    }

    const OpaqueVoxels& voxels_;
    const std::vector<float>& distance_;
    const std::vector<NeighbourStep> steps_;
    const double least_;
    std::vector<float> arrival_, speed_;
    std::vector<std::int16_t> limb_;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open_;
};

/// For each opaque voxel the index of the one where its climb ends.
std::vector<std::uint32_t> middles(const OpaqueVoxels& voxels, const std::vector<float>& distance) {
    // Off the middle the distance rises by nearly as much as one steps; on it, by less than half.
    constexpr double kSteep = 0.5;
    std::vector<std::uint32_t> next(distance.size());
    const auto steps = neighbourSteps(voxels);
    parallelFor(std::size_t(voxels.size.z), 1, [&](std::size_t begin, std::size_t end) {
        for (Index3 c(0, 0, int(begin)); c.z < int(end); ++c.z)
            for (c.y = 0; c.y < voxels.size.y; ++c.y)
                for (c.x = 0; c.x < voxels.size.x; ++c.x) {
                    const std::size_t i = voxels.indexOf(c);
                    next[i] = static_cast<std::uint32_t>(i);
                    if (!voxels.opaque[i]) continue;
                    double steepest = kSteep;
                    for (const NeighbourStep& s : steps) {
                        if (!isInside(voxels, c + s.by)) continue;
                        const std::size_t j = std::size_t(std::ptrdiff_t(i) + s.offset);
                        const double slope = (double(distance[j]) - distance[i]) / s.length;
                        if (slope > steepest) {
                            steepest = slope;
                            next[i] = static_cast<std::uint32_t>(j);
                        }
                    }
                }
    });
    std::vector<std::uint32_t> path;
    for (std::uint32_t i = 0; i < next.size(); ++i) {
        std::uint32_t at = i;
        path.clear();
        while (next[at] != at) {
            path.push_back(at);
            at = next[at];
        }
        for (const std::uint32_t p : path) next[p] = at;
    }
    return next;
}

/// Parts of the object that no bone reaches into: each voxel takes the limb whose bone is nearest.
void joinLoose(const OpaqueVoxels& voxels, const std::vector<Limb>& limbs, const std::vector<PosedJoint>& rest,
               std::vector<std::int16_t>& parts) {
    parallelFor(parts.size(), 1 << 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (!voxels.opaque[i] || parts[i] != kNoLimb) continue;
            const Vec3 p = voxels.centre(cellOf(voxels, i));
            double nearest = kInfinity;
            for (std::size_t l = 0; l < limbs.size(); ++l) {
                const Vec3 from = rest[std::size_t(limbs[l].from)].position;
                const Vec3 along = rest[std::size_t(limbs[l].to)].position - from;
                const double t = glm::dot(p - from, along) / std::max(glm::dot(along, along), 1e-300);
                if (const double d = glm::length(p - from - std::clamp(t, 0.0, 1.0) * along); d < nearest) {
                    nearest = d;
                    parts[i] = static_cast<std::int16_t>(l);
                }
            }
        }
    });
}

/// Limbs that begin at one joint. They all turn with it, so nothing tears between them, and what is whose is free to
/// choose: so that their boxes, which begin in planes across the bones, overlap little.
class Hub {
public:
    Hub(const OpaqueVoxels& voxels, const std::vector<Limb>& limbs, const std::vector<PosedJoint>& rest,
        std::vector<int> sisters)
        : voxels_(voxels),
          joint_(rest[std::size_t(limbs[std::size_t(sisters.front())].from)].position),
          sisters_(std::move(sisters)) {
        for (const int l : sisters_)
            frames_.push_back(
                boneFrame(glm::normalize(rest[std::size_t(limbs[std::size_t(l)].to)].position - joint_), 0));
    }

    void share(std::vector<std::int16_t>& parts) const {
        turnBack(parts);
        giveToBroadest(parts);
    }

private:
    Vec3 local(std::size_t s, std::size_t voxel) const {
        return glm::transpose(frames_[s]) * (voxels_.centre(cellOf(voxels_, voxel)) - joint_);
    }
    /// Which sister a part is of; −1 for none.
    int sisterOf(std::int16_t part) const {
        const auto found = std::find(sisters_.begin(), sisters_.end(), int(part));
        return found == sisters_.end() ? -1 : static_cast<int>(found - sisters_.begin());
    }

    /// None keeps what lies behind the joint as its bone points: the one that points there most takes it.
    void turnBack(std::vector<std::int16_t>& parts) const {
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const int own = sisterOf(parts[i]);
            if (own < 0 || local(std::size_t(own), i).z >= 0) continue;
            double most = 0;
            for (std::size_t s = 0; s < sisters_.size(); ++s)
                if (const double z = local(s, i).z; z > most) {
                    most = z;
                    parts[i] = static_cast<std::int16_t>(sisters_[s]);
                }
        }
    }

    /// One may take all of the others' that lies before the joint as its own bone points, if its box need hardly grow
    /// for that: the trunk takes the flanks above the hips.
    void giveToBroadest(std::vector<std::int16_t>& parts) const {
        constexpr double kHardly = 1.15;
        std::vector<Box3> own(sisters_.size()), all(sisters_.size());
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const int of = sisterOf(parts[i]);
            if (of < 0) continue;
            for (std::size_t s = 0; s < sisters_.size(); ++s) {
                const Vec3 p = local(s, i);
                if (p.z < 0) continue;
                all[s] = join(all[s], p);
                if (of == int(s)) own[s] = join(own[s], p);
            }
        }
        double least = kHardly;
        std::size_t taker = sisters_.size();
        for (std::size_t s = 0; s < sisters_.size(); ++s) {
            const Vec3 a = own[s].size(), b = all[s].size();
            if (const double growth = b.x * b.y / std::max(a.x * a.y, 1e-300); growth < least)
                std::tie(least, taker) = std::pair(growth, s);
        }
        if (taker == sisters_.size()) return;
        for (std::size_t i = 0; i < parts.size(); ++i)
            if (sisterOf(parts[i]) >= 0 && local(taker, i).z >= 0)
                parts[i] = static_cast<std::int16_t>(sisters_[taker]);
    }

    const OpaqueVoxels& voxels_;
    const Vec3 joint_;
    const std::vector<int> sisters_;
    std::vector<Mat3> frames_;
};

void shareHubs(const OpaqueVoxels& voxels, const std::vector<Limb>& limbs, const std::vector<PosedJoint>& rest,
               std::vector<std::int16_t>& parts) {
    std::map<int, std::vector<int>> beginning;
    for (int l = 0; l < static_cast<int>(limbs.size()); ++l) beginning[limbs[std::size_t(l)].from].push_back(l);
    for (const auto& [joint, sisters] : beginning)
        if (sisters.size() > 1) Hub(voxels, limbs, rest, sisters).share(parts);
}

}  // namespace

std::vector<std::int16_t> limbParts(const OpaqueVoxels& voxels, const std::vector<float>& distance,
                                    const std::vector<Limb>& limbs, const std::vector<PosedJoint>& rest) {
    Spread spread(voxels, distance);
    for (std::size_t l = 0; l < limbs.size(); ++l) {
        const auto sisters =
            std::count_if(limbs.begin(), limbs.end(), [&](const Limb& other) { return other.from == limbs[l].from; });
        spread.start(static_cast<std::int16_t>(l), rest[std::size_t(limbs[l].from)].position,
                     rest[std::size_t(limbs[l].to)].position, sisters > 1);
    }
    const auto reached = spread.run();
    const auto middle = middles(voxels, distance);
    std::vector<std::int16_t> parts(voxels.opaque.size(), kNoLimb);
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (voxels.opaque[i]) parts[i] = reached[middle[i]];
    joinLoose(voxels, limbs, rest, parts);
    shareHubs(voxels, limbs, rest, parts);
    return parts;
}

}  // namespace voledit
