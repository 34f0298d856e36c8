#include "core/rigging/body_frame.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace voledit {

namespace {

template <class Visit>
void eachOpaque(const OpaqueVoxels& voxels, const Index3& low, const Index3& high, const Visit& visit) {
    for (Index3 c = low; c.z <= high.z; ++c.z)
        for (c.y = low.y; c.y <= high.y; ++c.y)
            for (c.x = low.x; c.x <= high.x; ++c.x)
                if (voxels.opaque[voxels.indexOf(c)]) visit(c);
}

struct Extent {
    Index3 low{0}, high{-1};
    Vec3 mean{0};  // in cells
};

Extent extentOf(const OpaqueVoxels& voxels) {
    Extent e{voxels.size, Index3(-1), Vec3(0)};
    std::size_t count = 0;
    eachOpaque(voxels, Index3(0), voxels.size - 1, [&](const Index3& c) {
        e.low = glm::min(e.low, c);
        e.high = glm::max(e.high, c);
        e.mean += Vec3(c);
        ++count;
    });
    e.mean /= double(std::max<std::size_t>(count, 1));
    return e;
}

/// The cells between the fractions a and b of the extent, counted from the bottom where `up` points.
std::pair<Index3, Index3> slab(const Extent& e, int axis, double up, double a, double b) {
    Index3 low = e.low, high = e.high;
    const double n = e.high[axis] - e.low[axis] + 1;
    if (up < 0) std::tie(a, b) = std::pair(1 - b, 1 - a);
    low[axis] = e.low[axis] + static_cast<int>(std::floor(a * n));
    high[axis] = std::max(low[axis], e.low[axis] + static_cast<int>(std::ceil(b * n)) - 1);
    return {low, high};
}

/// How much the end of the body against `up` looks like legs: 1 where it falls into as many parts as there are legs,
/// in pairs on both sides of the middle; 0 where it is one part.
double legsAt(const OpaqueVoxels& voxels, const Extent& e, int left, int axis, double up, bool fourLegs) {
    double best = 0;
    const double middle = voxels.origin[left] + voxels.spacing[left] * e.mean[left];
    for (const double at : {0.03, 0.08, 0.15, 0.22, 0.3}) {
        const auto [low, high] = slab(e, axis, up, at, at + 0.02);
        std::size_t all = 0;
        eachOpaque(voxels, low, high, [&](const Index3&) { ++all; });
        const auto parts = partsOf(voxels, low, high, std::max<std::size_t>(1, all / 20));
        const double size = voxels.spacing[left] * (e.high[left] - e.low[left] + 1);
        int pairs = 0;
        for (std::size_t i = 0; i + 1 < parts.size(); ++i)
            for (std::size_t j = i + 1; j < parts.size(); ++j) {
                Vec3 d = parts[i].mean - parts[j].mean;
                const double across = std::abs(d[left]);
                d[left] = 0;
                const double centred = std::abs(0.5 * (parts[i].mean[left] + parts[j].mean[left]) - middle);
                if (across > 0.04 * size && glm::length(d) < 0.5 * across + 0.1 * size && centred < 0.1 * size) ++pairs;
            }
        const std::size_t legs = fourLegs ? 4 : 2;
        if (pairs >= int(legs) / 2 && parts.size() >= legs) best += parts.size() == legs ? 1 : 0.5;
    }
    return best / 5;
}

/// +1 or −1: where along `axis` the highest part is, a quadruped's head.
double headSign(const OpaqueVoxels& voxels, const Extent& e, int upAxis, double up, int axis) {
    const auto [low, high] = slab(e, upAxis, up, 0.85, 1);
    double sum = 0, count = 0;
    eachOpaque(voxels, low, high, [&](const Index3& c) { sum += c[axis], ++count; });
    return count > 0 && sum / count < 0.5 * (e.low[axis] + e.high[axis]) ? -1 : 1;
}

/// +1 or −1: where along `axis` the feet reach farther from the ankles.
double frontSign(const OpaqueVoxels& voxels, const Extent& e, int upAxis, double up, int axis) {
    const auto mean = [&](double a, double b) {
        const auto [low, high] = slab(e, upAxis, up, a, b);
        double sum = 0;
        std::size_t count = 0;
        eachOpaque(voxels, low, high, [&](const Index3& c) {
            sum += c[axis];
            ++count;
        });
        return count ? sum / double(count) : 0;
    };
    return mean(0, 0.03) - mean(0.06, 0.12) >= -1e-6 ? 1 : -1;
}

}  // namespace

double mirrorSymmetry(const OpaqueVoxels& voxels, int axis) {
    const Extent e = extentOf(voxels);
    const int sum = static_cast<int>(std::lround(2 * e.mean[axis]));
    double best = 0;
    for (const int about : {sum - 1, sum, sum + 1}) {
        std::size_t count = 0, mirrored = 0;
        eachOpaque(voxels, Index3(0), voxels.size - 1, [&](Index3 c) {
            ++count;
            c[axis] = about - c[axis];
            if (c[axis] >= 0 && c[axis] < voxels.size[axis] && voxels.opaque[voxels.indexOf(c)]) ++mirrored;
        });
        if (count) best = std::max(best, double(mirrored) / double(count));
    }
    return best;
}

std::vector<Part> partsOf(const OpaqueVoxels& voxels, const Index3& low, const Index3& high, std::size_t least) {
    const Index3 n = high - low + 1;
    const auto local = [&](const Index3& c) {
        const Index3 d = c - low;
        return std::size_t(d.x) + std::size_t(n.x) * (std::size_t(d.y) + std::size_t(n.y) * std::size_t(d.z));
    };
    std::vector<bool> seen(std::size_t(n.x) * std::size_t(n.y) * std::size_t(n.z));
    std::vector<Part> parts;
    std::vector<Index3> open;
    eachOpaque(voxels, low, high, [&](const Index3& start) {
        if (seen[local(start)]) return;
        seen[local(start)] = true;
        open.assign(1, start);
        Part part;
        while (!open.empty()) {
            const Index3 c = open.back();
            open.pop_back();
            ++part.cells;
            part.mean += voxels.centre(c);
            eachOpaque(voxels, glm::max(c - 1, low), glm::min(c + 1, high), [&](const Index3& next) {
                if (seen[local(next)]) return;
                seen[local(next)] = true;
                open.push_back(next);
            });
        }
        if (part.cells < least) return;
        part.mean /= double(part.cells);
        parts.push_back(part);
    });
    std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.cells > b.cells; });
    return parts;
}

BodyFrame bodyFrame(const OpaqueVoxels& voxels, bool fourLegs) {
    const Extent e = extentOf(voxels);
    const Vec3 size = Vec3(e.high - e.low + 1) * voxels.spacing;
    int left = 0;
    double best = -1;
    for (int a = 0; a < 3; ++a)
        if (const double s = mirrorSymmetry(voxels, a); s > best + 1e-3) std::tie(left, best) = std::pair(a, s);
    int up = -1;
    double sign = 1, most = -1;
    for (const int a : {(left + 1) % 3, (left + 2) % 3})
        for (const double s : {1.0, -1.0}) {
            // Where the legs do not tell, the longer axis of a biped does, and the positive end.
            const double other = size[3 - left - a];
            const double shape = 0.2 * (fourLegs ? other : size[a]) / (size[a] + other) + (s > 0 ? 0.01 : 0);
            const double score = legsAt(voxels, e, left, a, s, fourLegs) + shape;
            if (score > most) std::tie(up, sign, most) = std::tuple(a, s, score);
        }
    const int front = 3 - left - up;
    BodyFrame frame;
    frame.axes = Mat3(0.0);
    frame.axes[1][up] = sign;
    frame.axes[2][front] = fourLegs ? headSign(voxels, e, up, sign, front) : frontSign(voxels, e, up, sign, front);
    frame.axes[0] = glm::cross(frame.axes[1], frame.axes[2]);
    return frame;
}

OpaqueVoxels turned(const OpaqueVoxels& voxels, const BodyFrame& frame) {
    OpaqueVoxels out;
    Index3 step(0), start(0);  // the source cell of out's cell 0 along each of the source's axes, and the way on
    Index3 axis(0);            // source axis of each of out's axes
    for (int i = 0; i < 3; ++i) {
        int a = 0;
        while (frame.axes[i][a] == 0) ++a;
        axis[i] = a;
        step[i] = frame.axes[i][a] > 0 ? 1 : -1;
        start[a] = step[i] > 0 ? 0 : voxels.size[a] - 1;
        out.size[i] = voxels.size[a];
        out.spacing[i] = voxels.spacing[a];
    }
    out.origin = glm::transpose(frame.axes) * voxels.centre(start);
    out.opaque.resize(voxels.opaque.size());
    for (Index3 c(0); c.z < out.size.z; ++c.z)
        for (c.y = 0; c.y < out.size.y; ++c.y)
            for (c.x = 0; c.x < out.size.x; ++c.x) {
                Index3 from = start;
                for (int i = 0; i < 3; ++i) from[axis[i]] += step[i] * c[i];
                out.opaque[out.indexOf(c)] = voxels.opaque[voxels.indexOf(from)];
            }
    return out;
}

}  // namespace voledit
