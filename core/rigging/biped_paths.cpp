#include <algorithm>
#include <cmath>

#include "core/rigging/biped_joints.h"

namespace voledit {

namespace {

/// Ends of the tree that are a body's extremities; −1 where there is none.
struct Extremities {
    int head = -1;
    std::array<int, 2> foot{-1, -1}, hand{-1, -1};
};

int highestEnd(const BodyShape& body, const std::vector<int>& ends, double middle) {
    // Hands may be raised above the head: what counts is near the middle.
    int head = -1;
    double best = -kInfinity;
    for (const int e : ends) {
        const Vec3& at = body.tree.nodes[std::size_t(e)].at;
        if (const double score = at.y - 1.5 * std::abs(at.x - middle); score > best)
            std::tie(best, head) = std::pair(score, e);
    }
    return head;
}

/// The foremost of the ends near the ground on one side.
int toeEnd(const BodyShape& body, const std::vector<int>& ends, double middle, double side) {
    const double ground = body.box.min.y + 0.08 * body.box.size().y;
    int foot = -1;
    for (const int e : ends) {
        const Vec3& at = body.tree.nodes[std::size_t(e)].at;
        if (at.y > ground || side * (at.x - middle) <= 0) continue;
        if (foot < 0 || at.z > body.tree.nodes[std::size_t(foot)].at.z) foot = e;
    }
    return foot;
}

/// The end on one side whose way to the trunk is longest, and which leaves it above the legs.
int handEnd(const BodyShape& body, const HungTree& hung, const std::vector<int>& ends, double middle, double side,
            double lowest) {
    int hand = -1;
    double longest = 0.15 * body.box.size().y;  // anything shorter is an ear, a chin, a hem
    const auto isTrunk = [&](int node) {
        return std::abs(body.tree.nodes[std::size_t(node)].at.x - middle) <= body.tree.nodes[std::size_t(node)].radius;
    };
    for (const int e : ends) {
        if (side * (body.tree.nodes[std::size_t(e)].at.x - middle) <= 0) continue;
        const auto way = hung.toRoot(e);
        const auto arrival = std::find_if(way.begin(), way.end(), isTrunk);
        if (arrival == way.end() || body.tree.nodes[std::size_t(*arrival)].at.y < lowest) continue;
        if (const double length = hung.depth(e) - hung.depth(*arrival); length > longest)
            std::tie(longest, hand) = std::pair(length, e);
    }
    return hand;
}

}  // namespace

BipedPaths bipedPaths(const BodyShape& body) {
    BipedPaths paths;
    if (body.tree.nodes.size() < 2) return paths;
    const double middle = body.mean.x;
    const double height = body.box.size().y;
    const auto allEnds = HungTree(body.tree, 0).ends();
    Extremities ends;
    ends.head = highestEnd(body, allEnds, middle);
    if (ends.head < 0) return paths;
    const HungTree hung(body.tree, ends.head);
    for (std::size_t s = 0; s < 2; ++s) ends.foot[s] = toeEnd(body, hung.ends(), middle, s == 0 ? 1 : -1);
    const double smoothing = 0.012 * height;
    double legsMeet = body.box.min.y + 0.5 * height;
    if (ends.foot[0] >= 0 && ends.foot[1] >= 0) {
        const int pelvis = hung.meeting(ends.foot[0], ends.foot[1]);
        legsMeet = body.tree.nodes[std::size_t(pelvis)].at.y;
        for (std::size_t s = 0; s < 2; ++s)
            paths.leg[s] = MedialPath(body.tree, hung.between(ends.foot[s], pelvis), smoothing);
    }
    for (std::size_t s = 0; s < 2; ++s) {
        ends.hand[s] = handEnd(body, hung, hung.ends(), middle, s == 0 ? 1 : -1, legsMeet + 0.05 * height);
        if (ends.hand[s] < 0) continue;
        auto way = hung.toRoot(ends.hand[s]);
        const auto arrival = std::find_if(way.begin(), way.end(), [&](int node) {
            const auto& n = body.tree.nodes[std::size_t(node)];
            return std::abs(n.at.x - middle) <= n.radius;
        });
        way.erase(arrival, way.end());
        paths.arm[s] = MedialPath(body.tree, way, smoothing);
    }
    return paths;
}

}  // namespace voledit
