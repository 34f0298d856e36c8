#pragma once
// Paths along a curve skeleton.

#include "core/rigging/curve_skeleton.h"

namespace voledit {

/// A line of points at even steps, with the object's depth at each.
class MedialPath {
public:
    MedialPath() = default;
    /// Smooths the zigzag of cells over about `smoothing` (world units) to both sides; the ends stay.
    MedialPath(const CurveSkeleton& tree, const std::vector<int>& nodes, double smoothing);

    bool empty() const { return points_.size() < 2; }
    double length() const { return empty() ? 0 : step_ * double(points_.size() - 1); }
    /// The point at length s from the start, held at the ends; needs a path that is not empty.
    Vec3 at(double s) const;
    /// Unit direction of travel there, over `over` to both sides.
    Vec3 direction(double s, double over) const;
    /// Length s at which the path is farthest from the chord between its points at a and b, and how far.
    std::pair<double, double> bulge(double a, double b) const;
    /// Length s of the point nearest to p.
    double nearest(const Vec3& p) const;

private:
    std::vector<Vec3> points_;
    double step_ = 1;
};

/// The tree hung up at one node.
class HungTree {
public:
    HungTree(const CurveSkeleton& tree, int root);

    /// Nodes from `node` up to the root.
    std::vector<int> toRoot(int node) const;
    /// Nodes with one neighbour, but for the root.
    std::vector<int> ends() const;
    /// Length from the root.
    double depth(int node) const { return depth_[std::size_t(node)]; }
    /// The node in which the ways of a and b to the root meet.
    int meeting(int a, int b) const;
    /// Nodes from a to b, both included.
    std::vector<int> between(int a, int b) const;

private:
    const CurveSkeleton& tree_;
    int root_;
    std::vector<int> parent_;
    std::vector<double> depth_;
};

}  // namespace voledit
