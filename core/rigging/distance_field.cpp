// Exact Euclidean distance transform, one axis after another [Felzenszwalb, Huttenlocher 2012: Distance transforms of
// sampled functions].

#include <cmath>

#include "core/base/parallel.h"
#include "core/rigging/curve_skeleton.h"

namespace voledit {

namespace {

/// Squared distances along a line of cells `step` apart, from those found so far: out[i] = min over j of
/// (step·(i−j))² + in[j], j from −1 to n: beyond the ends nothing is opaque, so in is 0 there. The lower envelope of
/// parabolas, in linear time.
class LineTransform {
public:
    explicit LineTransform(int longest) : in_(std::size_t(longest) + 2), foot_(in_.size()), from_(in_.size() + 1) {}

    template <class Value>
    void run(Value* line, std::ptrdiff_t stride, int n, double step) {
        in_[0] = in_[std::size_t(n) + 1] = 0;
        for (int i = 0; i < n; ++i) in_[std::size_t(i) + 1] = line[i * stride];
        const double s2 = step * step;
        const int count = n + 2;
        int k = 0;
        foot_[0] = 0;
        from_[0] = -kInfinity;
        for (int q = 1; q < count; ++q) {
            if (!std::isfinite(in_[std::size_t(q)])) continue;
            double s = crossing(foot_[std::size_t(k)], q, s2);
            while (s <= from_[std::size_t(k)]) {
                --k;
                s = crossing(foot_[std::size_t(k)], q, s2);
            }
            ++k;
            foot_[std::size_t(k)] = q;
            from_[std::size_t(k)] = s;
        }
        from_[std::size_t(k) + 1] = kInfinity;
        for (int i = 1, p = 0; i <= n; ++i) {
            while (from_[std::size_t(p) + 1] < i) ++p;
            const int f = foot_[std::size_t(p)];
            line[(i - 1) * stride] = static_cast<Value>(s2 * (i - f) * (i - f) + in_[std::size_t(f)]);
        }
    }

private:
    /// Where the parabolas with feet a < b cross.
    double crossing(int a, int b, double s2) const {
        return (in_[std::size_t(b)] - in_[std::size_t(a)]) / (2 * s2 * (b - a)) + 0.5 * (a + b);
    }

    std::vector<double> in_;
    std::vector<int> foot_;
    std::vector<double> from_;
};

}  // namespace

std::vector<float> distanceField(const OpaqueVoxels& voxels) {
    const auto n = voxels.size;
    std::vector<float> squared(voxels.opaque.size());
    for (std::size_t i = 0; i < squared.size(); ++i)
        squared[i] = voxels.opaque[i] ? std::numeric_limits<float>::infinity() : 0;
    const std::ptrdiff_t strides[3] = {1, n.x, std::ptrdiff_t(n.x) * n.y};
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        parallelFor(std::size_t(n[u]) * std::size_t(n[v]), 256, [&](std::size_t begin, std::size_t end) {
            LineTransform line(n[axis]);
            for (std::size_t l = begin; l < end; ++l) {
                const auto at = std::ptrdiff_t(l % std::size_t(n[u])) * strides[u] +
                                std::ptrdiff_t(l / std::size_t(n[u])) * strides[v];
                line.run(squared.data() + at, strides[axis], n[axis], voxels.spacing[axis]);
            }
        });
    }
    for (float& d : squared) d = std::sqrt(d);
    return squared;
}

}  // namespace voledit
