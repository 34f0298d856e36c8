#include "core/rigging/tree_paths.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace voledit {

MedialPath::MedialPath(const CurveSkeleton& tree, const std::vector<int>& nodes, double smoothing) {
    if (nodes.size() < 2) return;
    std::vector<double> lengths{0};
    for (std::size_t i = 1; i < nodes.size(); ++i)
        lengths.push_back(lengths.back() +
                          glm::length(tree.nodes[std::size_t(nodes[i])].at - tree.nodes[std::size_t(nodes[i - 1])].at));
    // A step shorter than that of the cells, so that bends stay where they are.
    const auto pieces = std::max<std::size_t>(2, 2 * nodes.size());
    std::vector<Vec3> raw;
    std::size_t k = 0;
    for (std::size_t i = 0; i <= pieces; ++i) {
        const double s = lengths.back() * double(i) / double(pieces);
        while (k + 2 < lengths.size() && lengths[k + 1] < s) ++k;
        const double t = std::clamp((s - lengths[k]) / (lengths[k + 1] - lengths[k]), 0.0, 1.0);
        raw.push_back(glm::mix(tree.nodes[std::size_t(nodes[k])].at, tree.nodes[std::size_t(nodes[k + 1])].at, t));
    }
    const auto window = static_cast<std::size_t>(std::lround(smoothing / lengths.back() * double(pieces)));
    std::vector<Vec3> smooth;
    for (std::size_t i = 0; i < raw.size(); ++i) {
        const std::size_t w = std::min({window, i, raw.size() - 1 - i});
        Vec3 sum(0);
        for (std::size_t j = i - w; j <= i + w; ++j) sum += raw[j];
        smooth.push_back(sum / double(2 * w + 1));
    }
    // Even steps again, by the smoothed line's own length.
    double total = 0;
    std::vector<double> along{0};
    for (std::size_t i = 1; i < smooth.size(); ++i) along.push_back(total += glm::length(smooth[i] - smooth[i - 1]));
    step_ = total / double(pieces);
    k = 0;
    for (std::size_t i = 0; i <= pieces; ++i) {
        const double s = step_ * double(i);
        while (k + 2 < along.size() && along[k + 1] < s) ++k;
        const double piece = along[k + 1] - along[k];
        points_.push_back(
            glm::mix(smooth[k], smooth[k + 1], piece > 0 ? std::clamp((s - along[k]) / piece, 0.0, 1.0) : 0.0));
    }
}

Vec3 MedialPath::at(double s) const {
    const double x = std::clamp(s / step_, 0.0, double(points_.size() - 1));
    const auto i = std::min(points_.size() - 2, static_cast<std::size_t>(x));
    return glm::mix(points_[i], points_[i + 1], x - double(i));
}

Vec3 MedialPath::direction(double s, double over) const {
    const double a = std::max(0.0, s - over), b = std::min(length(), s + over);
    const Vec3 d = at(b) - at(a);
    const double l = glm::length(d);
    return l > 0 ? d / l : Vec3(0, 1, 0);
}

std::pair<double, double> MedialPath::bulge(double a, double b) const {
    const Vec3 from = at(a), chord = at(b) - from;
    const double l2 = std::max(glm::dot(chord, chord), 1e-300);
    double where = 0.5 * (a + b), most = 0;
    for (double s = a; s <= b; s += step_) {
        const Vec3 d = at(s) - from;
        const double off = glm::length(d - glm::dot(d, chord) / l2 * chord);
        if (off > most) std::tie(where, most) = std::pair(s, off);
    }
    return {where, most};
}

double MedialPath::nearest(const Vec3& p) const {
    double best = kInfinity;
    std::size_t found = 0;
    for (std::size_t i = 0; i < points_.size(); ++i)
        if (const double d = glm::length(points_[i] - p); d < best) std::tie(best, found) = std::pair(d, i);
    return step_ * double(found);
}

HungTree::HungTree(const CurveSkeleton& tree, int root)
    : tree_(tree), root_(root), parent_(tree.nodes.size(), -1), depth_(tree.nodes.size(), 0) {
    std::vector<int> open{root};
    while (!open.empty()) {
        const int i = open.back();
        open.pop_back();
        for (const int j : tree.nodes[std::size_t(i)].neighbours) {
            if (j == parent_[std::size_t(i)]) continue;
            parent_[std::size_t(j)] = i;
            depth_[std::size_t(j)] =
                depth_[std::size_t(i)] + glm::length(tree.nodes[std::size_t(j)].at - tree.nodes[std::size_t(i)].at);
            open.push_back(j);
        }
    }
}

std::vector<int> HungTree::toRoot(int node) const {
    std::vector<int> nodes;
    for (int i = node; i >= 0; i = parent_[std::size_t(i)]) nodes.push_back(i);
    return nodes;
}

std::vector<int> HungTree::ends() const {
    std::vector<int> ends;
    for (int i = 0; i < static_cast<int>(tree_.nodes.size()); ++i)
        if (i != root_ && tree_.nodes[std::size_t(i)].neighbours.size() == 1) ends.push_back(i);
    return ends;
}

int HungTree::meeting(int a, int b) const {
    const auto up = toRoot(a), other = toRoot(b);
    int met = root_;
    for (auto i = up.rbegin(), j = other.rbegin(); i != up.rend() && j != other.rend() && *i == *j; ++i, ++j) met = *i;
    return met;
}

std::vector<int> HungTree::between(int a, int b) const {
    const int met = meeting(a, b);
    std::vector<int> nodes;
    for (int i = a; i != met; i = parent_[std::size_t(i)]) nodes.push_back(i);
    nodes.push_back(met);
    std::vector<int> down;
    for (int i = b; i != met; i = parent_[std::size_t(i)]) down.push_back(i);
    nodes.insert(nodes.end(), down.rbegin(), down.rend());
    return nodes;
}

}  // namespace voledit
