// The library's formula files against definitions.md §3.2, each written here once more, by other means.

#include "core/stf/transfer_definition.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/stf/composite_maps.h"
#include "tests/core/stf/analytic_maps.h"
#include "tests/core/stf/library_maps.h"

namespace voledit {
namespace {

Box3 grown(const Box3& box, double share) {
    return {box.min - share * box.size(), box.max + share * box.size()};
}

Vec3 at(const TransferPtr& map, const Vec3& p) {
    return mappedBy(*map, {p})[0];
}

/// `oracle` and the map agree at random points about the frame, also in where they are undefined.
void expectEqualMaps(const TransferPtr& map, const std::function<Vec3(const Vec3&)>& oracle, double tolerance = 1e-11) {
    const auto points = randomPoints(grown(testBox(), 0.4), 20000);
    const auto q = mappedBy(*map, points);
    int defined = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3 expected = oracle(points[i]);
        ASSERT_EQ(isDefined(q[i]), isDefined(expected)) << points[i].x << " " << points[i].y << " " << points[i].z;
        if (!isDefined(expected)) continue;
        ++defined;
        ASSERT_LT(glm::length(q[i] - expected), tolerance) << points[i].x << " " << points[i].y << " " << points[i].z;
    }
    EXPECT_GT(defined, 1000);
}

/// A map of normalised coordinates as one of world coordinates.
std::function<Vec3(const Vec3&)> inFrame(std::function<Vec3(Vec3)> f) {
    return [f = std::move(f)](const Vec3& p) {
        const Box3 box = testBox();
        const Vec3 u = f((p - box.min) / box.size());
        return isDefined(u) ? box.min + u * box.size() : kUndefined;
    };
}

double cut(double a, double at, double half) {
    return a < at - half ? a + half : a > at + half ? a - half : kNaN;
}

TEST(TransferLibrary, HoldsWhatTheContractNames) {
    std::vector<std::string> names;
    for (const auto& definition : transferLibrary()) names.push_back(definition->name());
    EXPECT_EQ(names, (std::vector<std::string>{"affine", "bend", "deflect", "dissect", "insideOut", "open",
                                               "rotationalSweep", "split", "squeeze", "taper", "twist"}));
    EXPECT_EQ(libraryTransfer("nothing"), nullptr);
    for (const auto& definition : transferLibrary()) {
        EXPECT_FALSE(definition->title().empty() || definition->description().empty() || definition->source().empty());
        EXPECT_EQ(definition->usesOutside(),
                  definition->name() == "insideOut" || definition->name() == "rotationalSweep");
        for (const TransferParameter& parameter : definition->parameters()) EXPECT_FALSE(parameter.description.empty());
    }
}

TEST(TransferLibrary, MissingMembersMeanWhatTheContractSays) {
    const auto initial = [](const char* transfer, const char* parameter) {
        return libraryTransfer(transfer)->find(parameter)->initial;
    };
    const auto number = [](double v) { return std::optional<TransferArgument>(Numbers{v}); };
    for (const char* name : {"split", "open", "squeeze", "twist"}) EXPECT_EQ(initial(name, "at"), number(0.5));
    EXPECT_EQ(initial("dissect", "gap"), number(0.3));
    EXPECT_EQ(initial("open", "width"), number(0.2));
    EXPECT_EQ(initial("open", "profile"), number(1));
    EXPECT_EQ(initial("squeeze", "sigma"), number(0.25));
    EXPECT_EQ(initial("bend", "range"), TransferArgument(Numbers{0, 1}));
    EXPECT_EQ(initial("deflect", "scale"), number(1));
    for (const char* name : {"deflect", "affine"})
        for (const char* member : {"translate", "rotate"})
            EXPECT_EQ(initial(name, member), TransferArgument(Numbers{0, 0, 0}));
    EXPECT_EQ(initial("affine", "scale"), TransferArgument(Numbers{1, 1, 1}));
    for (const auto& [name, member] : {std::pair("split", "axis"),  {"split", "gap"},
                                       {"dissect", "axes"},         {"open", "axis"},
                                       {"open", "hinge"},           {"insideOut", "line"},
                                       {"insideOut", "radius"},     {"squeeze", "axis"},
                                       {"squeeze", "strength"},     {"twist", "axis"},
                                       {"twist", "angle"},          {"taper", "axis"},
                                       {"taper", "scale"},          {"bend", "axis"},
                                       {"bend", "toward"},          {"bend", "angle"},
                                       {"rotationalSweep", "line"}, {"rotationalSweep", "start"},
                                       {"rotationalSweep", "from"}, {"rotationalSweep", "to"},
                                       {"deflect", "center"},       {"deflect", "radius"}})
        EXPECT_FALSE(initial(name, member)) << name << " " << member;
}

TEST(TransferLibrary, SplitMovesTheHalvesApart) {
    for (int axis = 0; axis < 3; ++axis)
        expectEqualMaps(
            library("split", {{"axis", Axes{axis}}, {"at", Numbers{0.4}}, {"gap", Numbers{0.3}}}),
            inFrame([axis](Vec3 u) { return u[axis] = cut(u[axis], 0.4, 0.15), isDefined(u) ? u : kUndefined; }));
}

TEST(TransferLibrary, CutsBelongToTheGapAndNoWiderThanWritten) {
    // In a unit frame coordinates go through untouched, so that the comparisons are those of the definition.
    const Box3 unit{Vec3(0), Vec3(1)};
    const auto split = library("split", {{"axis", Axes{0}}, {"gap", Numbers{0.5}}}, 1, Outside::Hide, unit);
    EXPECT_FALSE(isDefined(at(split, {0.25, 0, 0})));
    EXPECT_FALSE(isDefined(at(split, {0.75, 0, 0})));
    EXPECT_EQ(at(split, {std::nextafter(0.25, 0), 0, 0}).x, std::nextafter(0.25, 0) + 0.25);
    EXPECT_EQ(at(split, {std::nextafter(0.75, 1), 0, 0}).x, std::nextafter(0.75, 1) - 0.25);
    const auto dissect = library("dissect", {{"axes", Axes{0}}, {"gap", Numbers{0.5}}}, 1, Outside::Hide, unit);
    EXPECT_EQ(at(dissect, {0.25, 0, 0}).x, 0.5);
    EXPECT_EQ(at(dissect, {0.75, 0, 0}).x, 0.5);
    EXPECT_FALSE(isDefined(at(dissect, {std::nextafter(0.25, 1), 0, 0})));
    EXPECT_FALSE(isDefined(at(dissect, {std::nextafter(0.75, 0), 0, 0})));
    const auto open =
        library("open", {{"axis", Axes{0}}, {"hinge", Axes{1}}, {"width", Numbers{0.25}}}, 1, Outside::Hide, unit);
    EXPECT_FALSE(isDefined(at(open, {0.25, 0, 0})));
    EXPECT_FALSE(isDefined(at(open, {0.75, -3, 0})));
    EXPECT_FALSE(isDefined(at(open, {0.5, 1, 0})));
    EXPECT_EQ(at(open, {std::nextafter(0.25, 0), 0, 0}).x, std::nextafter(0.25, 0) + 0.25);
    EXPECT_EQ(at(open, {0.4, 2, 0}), Vec3(0.4, 2, 0));
}

TEST(TransferLibrary, DissectSqueezesEachPartIntoItsShare) {
    const auto part = [](double a) {
        const double b = 0.3;
        return 2 * a <= 1 - b ? a / (1 - b) : 2 * a >= 1 + b ? 1 - (1 - a) / (1 - b) : kNaN;
    };
    expectEqualMaps(library("dissect", {{"axes", Axes{0, 1, 2}}}),
                    inFrame([&](Vec3 u) { return Vec3(part(u.x), part(u.y), part(u.z)); }));
    expectEqualMaps(library("dissect", {{"axes", Axes{2}}}),
                    inFrame([&](Vec3 u) { return Vec3(u.x, u.y, part(u.z)); }));
}

TEST(TransferLibrary, OpenNarrowsTowardsItsHingeByTheProfile) {
    for (const double profile : {1.0, 2.5})
        expectEqualMaps(library("open", {{"axis", Axes{2}}, {"hinge", Axes{0}}, {"profile", Numbers{profile}}}),
                        inFrame([profile](Vec3 u) {
                            const double s = 0.2 * std::pow(1 - std::min(std::max(u.x, 0.0), 1.0), profile);
                            return Vec3(u.x, u.y, cut(u.z, 0.5, s));
                        }));
    // Ψ₄ as the paper has it, where its hinge coordinate is within [0, 1]: a > 0.7 − 0.2 h → a − 0.2 + 0.2 h.
    const auto map = library("open", {{"axis", Axes{0}}, {"hinge", Axes{1}}}, 1, Outside::Hide, {Vec3(0), Vec3(1)});
    for (const Vec3& u : randomPoints({Vec3(0), Vec3(1)}, 1000)) {
        const Vec3 q = at(map, u);
        if (u.x > 0.7 - 0.2 * u.y + 1e-12)
            EXPECT_NEAR(q.x, u.x - 0.2 + 0.2 * u.y, 1e-15);
        else if (u.x < 0.3 + 0.2 * u.y - 1e-12)
            EXPECT_NEAR(q.x, u.x + 0.2 - 0.2 * u.y, 1e-15);
        else
            EXPECT_FALSE(isDefined(q));
    }
}

TEST(TransferLibrary, InsideOutSwapsAxisAndSurface) {
    const LineValue line{{10, 5, 60}, {3, -2, 10}};
    const double radius = 25;
    const Vec3 d = glm::normalize(line.direction);
    const auto oracle = [&](const Vec3& p) {
        const Vec3 foot = line.point + glm::dot(p - line.point, d) * d;
        const double r = glm::length(p - foot);
        return r <= radius ? foot + (p - foot) / r * (radius - r) : kUndefined;
    };
    const auto map = library("insideOut", {{"line", line}, {"radius", Numbers{radius}}});
    expectEqualMaps(map, oracle);
    const auto kept = library("insideOut", {{"line", line}, {"radius", Numbers{radius}}}, 1, Outside::Keep);
    expectEqualMaps(kept, [&](const Vec3& p) { return isDefined(oracle(p)) ? oracle(p) : p; });
    EXPECT_EQ(at(kept, {500, 600, 700}), Vec3(500, 600, 700));
    // Its own inverse, also for what lies on the axis, which goes to the surface and comes back.
    const SequenceMap twice({map, map});
    for (const Vec3& p : randomPoints(testBox(), 5000)) {
        if (!isDefined(oracle(p))) continue;
        EXPECT_LT(glm::length(mappedBy(twice, {p})[0] - p), 1e-10);
        std::vector<Mat3> j(1);
        map->jacobian(std::vector<Vec3>{p}, j);
        const double r = glm::length(p - (line.point + glm::dot(p - line.point, d) * d));
        EXPECT_NEAR(glm::determinant(j[0]), -(radius - r) / r, 1e-9 * (1 + radius / r));
    }
    for (const Vec3& direction : {Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, -5, 0)}) {
        const auto straight =
            library("insideOut", {{"line", LineValue{Vec3(0), direction}}, {"radius", Numbers{radius}}});
        const Vec3 p = 2.0 * direction, q = at(straight, p);
        EXPECT_NEAR(glm::length(q - p), radius, 1e-12);
        EXPECT_NEAR(glm::dot(q - p, direction), 0, 1e-12);
        EXPECT_LT(glm::length(at(straight, q) - p), 1e-12);
    }
}

TEST(TransferLibrary, SqueezeAndTaperDivideAcrossTheAxis) {
    for (int axis = 0; axis < 3; ++axis) {
        const auto across = [axis](Vec3 u, double factor) {
            for (int c = 0; c < 3; ++c)
                if (c != axis) u[c] = 0.5 + (u[c] - 0.5) / factor;
            return u;
        };
        expectEqualMaps(
            library("squeeze",
                    {{"axis", Axes{axis}}, {"strength", Numbers{0.7}}, {"at", Numbers{0.3}}, {"sigma", Numbers{0.2}}}),
            inFrame([&](Vec3 u) { return across(u, 1 - 0.7 * std::exp(-std::pow((u[axis] - 0.3) / 0.2, 2))); }));
        expectEqualMaps(library("taper", {{"axis", Axes{axis}}, {"scale", Numbers{2, 0.5}}}), inFrame([&](Vec3 u) {
                            return across(u, 2 + (0.5 - 2) * std::min(std::max(u[axis], 0.0), 1.0));
                        }));
    }
}

TEST(TransferLibrary, TwistTurnsRightHandedInLengths) {
    const Box3 box = testBox();
    for (int axis = 0; axis < 3; ++axis) {
        const double angle = 130;
        const auto map = library("twist", {{"axis", Axes{axis}}, {"angle", Numbers{angle}}, {"at", Numbers{0.25}}});
        expectEqualMaps(map, [&](const Vec3& p) {
            const double a = (p[axis] - box.min[axis]) / box.size()[axis];
            Vec3 turn(0);
            turn[axis] = -angle * kPi / 180 * (a - 0.25);
            return box.center() + transformPoint(placementMatrix(Vec3(0), turn, Vec3(1)), p - box.center());
        });
        const auto back = library("twist", {{"axis", Axes{axis}}, {"angle", Numbers{-angle}}, {"at", Numbers{0.25}}});
        const SequenceMap both({map, back});
        for (const Vec3& p : randomPoints(grown(box, 0.3), 1000))
            EXPECT_LT(glm::length(mappedBy(both, {p})[0] - p), 1e-11);
    }
}

TEST(TransferLibrary, TwistFollowsTheEdgesOfAnyFrame) {
    // A turned frame, and one whose edges are left-handed: angles stay right-handed about the axis in the world.
    const Mat3 turn(placementMatrix(Vec3(0), {0.4, -0.9, 1.3}, Vec3(1)));
    const Vec3 corner(3, 4, 5);
    for (const bool swapped : {false, true}) {
        Frame frame{corner, {turn[0] * 8.0, turn[1] * 6.0, turn[2] * 12.0}};
        if (swapped) std::swap(frame.edge[0], frame.edge[1]);
        const auto map =
            libraryTransfer("twist")->make({{{"axis", Axes{2}}, {"angle", Numbers{100}}}, frame, {}, 1, 0});
        const Vec3 centre = corner + 0.5 * (frame.edge[0] + frame.edge[1] + frame.edge[2]);
        for (const Vec3& p : randomPoints({Vec3(-10), Vec3(20)}, 500)) {
            const double along = glm::dot(p - corner, turn[2]) / 12;
            const double angle = -100 * kPi / 180 * (along - 0.5);
            const Vec3 v = p - centre, k = turn[2];
            const Vec3 expected = centre + v * std::cos(angle) + glm::cross(k, v) * std::sin(angle) +
                                  k * glm::dot(k, v) * (1 - std::cos(angle));
            EXPECT_LT(glm::length(at(map, p) - expected), 1e-12);
        }
    }
}

/// Barr's bend forward: s along the axis from the range's middle, eta towards h from the frame's centre, lengths.
Vec2 bent(double s, double eta, double angle, double length) {
    const double rho = length / angle;
    const double on = std::min(std::max(s, -length / 2), length / 2), phi = on / rho, rest = s - on;
    return {(rho - eta) * std::sin(phi) + rest * std::cos(phi),
            rho - (rho - eta) * std::cos(phi) + rest * std::sin(phi)};
}

struct BendCase {
    int axis, toward;
    double angle;  // degrees
    Vec2 range;
};
const std::vector<BendCase> kBends{{2, 0, 90, {0, 1}},      {2, 1, -90, {0, 1}},       {0, 1, 200, {0.25, 0.75}},
                                   {0, 2, -30, {0.1, 0.4}}, {1, 0, 350, {0, 1}},       {1, 2, 1e-5, {0, 1}},
                                   {2, 0, 1e-9, {0.2, 1}},  {1, 0, -1e-12, {0.2, 0.8}}};

TEST(TransferLibrary, BendUndoesBarrsBend) {
    const Box3 box = testBox();
    for (const BendCase& b : kBends) {
        const auto map = library("bend", {{"axis", Axes{b.axis}},
                                          {"toward", Axes{b.toward}},
                                          {"angle", Numbers{b.angle}},
                                          {"range", Numbers{b.range.x, b.range.y}}});
        const double length = (b.range.y - b.range.x) * box.size()[b.axis];
        const double middle = box.min[b.axis] + 0.5 * (b.range.x + b.range.y) * box.size()[b.axis];
        const double angle = std::abs(b.angle) * kPi / 180, side = b.angle < 0 ? -1 : 1;
        int tried = 0;
        for (const Vec3& q : randomPoints(box, 4000)) {
            const double s = q[b.axis] - middle, eta = side * (q[b.toward] - box.center()[b.toward]);
            // Behind the arc's centre space is folded; near it the inverse is ill-conditioned.
            if (eta > 0.9 * length / angle) continue;
            // The oracle loses digits where rho is large: there it is a straight line but for s² θ / 2ℓ.
            Vec2 moved = bent(s, eta, angle, length);
            if (angle < 1e-6) moved = {s - eta * s * angle / length, eta + s * s * angle / length / 2};
            const bool onArc = std::abs(s) <= length / 2;
            if (angle < 1e-6 && !onArc) continue;
            Vec3 p = q;
            p[b.axis] = middle + moved.x;
            p[b.toward] = box.center()[b.toward] + side * moved.y;
            // A long straight part may run into the rest of a strongly bent box: there p has another source.
            const Vec3 found = at(map, p);
            if (angle > kPi && !onArc && glm::length(found - q) > 1) continue;
            ASSERT_LT(glm::length(found - q), 1e-9) << b.axis << b.toward << " " << b.angle << " " << s << " " << eta;
            ++tried;
        }
        EXPECT_GT(tried, 500) << b.angle;
    }
}

TEST(TransferLibrary, BendTurnsTheAxisTowardsTheOther) {
    const Box3 box = testBox();
    const auto map = library("bend", {{"axis", Axes{2}}, {"toward", Axes{0}}, {"angle", Numbers{90}}});
    const double rho = 120 / (kPi / 2), quarter = kPi / 4;
    const Vec3 end = box.center() + Vec3(rho - rho * std::cos(quarter), 0, rho * std::sin(quarter));
    const Vec3 q = at(map, end);
    EXPECT_LT(glm::length(q - Vec3(box.center().x, box.center().y, box.max.z)), 1e-11);
    // Straight on from the end it goes on.
    const Vec3 tangent(std::sin(quarter), 0, std::cos(quarter));
    EXPECT_LT(glm::length(at(map, end + 17.0 * tangent) - (q + Vec3(0, 0, 17))), 1e-11);
}

TEST(TransferLibrary, NothingComesToTheCentreOfABend) {
    int tried = 0;
    for (int angle = 60; angle <= 300; ++angle) {
        const auto map = library("bend", {{"axis", Axes{0}}, {"toward", Axes{1}}, {"angle", Numbers{double(angle)}}}, 1,
                                 Outside::Hide, {Vec3(0), Vec3(1)});
        const double rho = 1 / (angle * (kPi / 180));
        if ((0.5 + rho) - 0.5 != rho) continue;  // rounding: this centre is no point
        ++tried;
        EXPECT_FALSE(isDefined(at(map, {0.5, 0.5 + rho, 0}))) << angle;
        EXPECT_TRUE(isDefined(at(map, {0.5, 0.5 + rho * (1 - 1e-15), 0}))) << angle;
    }
    EXPECT_GT(tried, 20);
}

TEST(TransferLibrary, ABendByNothingIsTheIdentityAndOneByLittleIsNear) {
    const auto points = randomPoints(grown(testBox(), 0.5), 2000);
    for (const double angle : {0.0, 1e-300, 1e-12, 1e-9, 1e-6, 1e-3}) {
        const auto map = library("bend", {{"axis", Axes{1}}, {"toward", Axes{2}}, {"angle", Numbers{angle}}});
        const auto q = mappedBy(*map, points);
        std::vector<Mat3> j(points.size());
        map->jacobian(points, j);
        for (std::size_t i = 0; i < points.size(); ++i) {
            // |Δ| is at most θ times the distance from the frame's centre.
            ASSERT_LT(glm::length(q[i] - points[i]), 1e-12 + 2 * angle * 200 * kPi / 180) << angle;
            for (int c = 0; c < 3; ++c) ASSERT_LT(glm::length(j[i][c] - Mat3(1)[c]), 1e-12 + 0.2 * angle);
        }
    }
}

TEST(TransferLibrary, RotationalSweepShowsTheHalfPlaneAllAround) {
    const LineValue line{{10, 5, 60}, {0.3, -0.2, 1}};
    const Vec3 d = glm::normalize(line.direction), given(1, 0.2, 0.4);
    const Vec3 s = glm::normalize(given - glm::dot(given, d) * d), n = glm::cross(d, s);
    const auto oracle = [&](double from, double to) {
        return [=](const Vec3& p) {
            const Vec3 v = p - line.point;
            double angle = std::atan2(glm::dot(v, n), glm::dot(v, s)) * 180 / kPi;
            while (angle < from) angle += 360;
            while (angle >= from + 360) angle -= 360;
            if (angle > to) return kUndefined;
            return line.point + glm::dot(v, d) * d + std::hypot(glm::dot(v, n), glm::dot(v, s)) * s;
        };
    };
    for (const auto& [from, to] :
         {std::pair(0.0, 270.0), {-90.0, 270.0}, {0.0, 360.0}, {170.0, 190.0}, {-400.0, -300.0}, {30.0, 800.0}})
        expectEqualMaps(
            library("rotationalSweep",
                    {{"line", line}, {"start", Numbers{1, 0.2, 0.4}}, {"from", Numbers{from}}, {"to", Numbers{to}}}),
            oracle(from, to));
    // Both ends belong to it, and the half-plane itself stays.
    const LineValue z{{0, 0, 0}, {0, 0, 1}};
    const auto map = library("rotationalSweep",
                             {{"line", z}, {"start", Numbers{1, 0, 0}}, {"from", Numbers{-45}}, {"to", Numbers{135}}});
    EXPECT_EQ(at(map, {3, 0, 7}), Vec3(3, 0, 7));
    EXPECT_LT(glm::length(at(map, {1, -1, 2}) - Vec3(std::sqrt(2.0), 0, 2)), 1e-14);
    EXPECT_LT(glm::length(at(map, {-1, 1, 2}) - Vec3(std::sqrt(2.0), 0, 2)), 1e-14);
    EXPECT_FALSE(isDefined(at(map, {-1, -1, 2})));
    const auto kept = library("rotationalSweep",
                              {{"line", z}, {"start", Numbers{1, 0, 0}}, {"from", Numbers{-45}}, {"to", Numbers{135}}},
                              1, Outside::Keep);
    EXPECT_EQ(at(kept, {-1, -1, 2}), Vec3(-1, -1, 2));
}

TEST(TransferLibrary, DeflectTakesOffTranslationThenTurnThenScale) {
    const Vec3 centre(20, 10, 70), d(12, -8, 5), turn(40, -25, 70);
    const double radius = 45, scale = 1.6;
    const auto map = library("deflect", {{"center", Numbers{20, 10, 70}},
                                         {"radius", Numbers{radius}},
                                         {"translate", Numbers{12, -8, 5}},
                                         {"rotate", Numbers{40, -25, 70}},
                                         {"scale", Numbers{scale}}});
    const auto weight = [&](const Vec3& p) {
        const double r = glm::length(p - centre) / radius;
        return r < 1 ? std::pow(1 - r * r, 2) : 0.0;
    };
    expectEqualMaps(map, [&](const Vec3& p) {
        const double w = weight(p);
        const Mat4 turned = placementMatrix(Vec3(0), w * turn * (kPi / 180), Vec3(1));
        return centre + transformPoint(glm::inverse(turned), p - w * d - centre) / (1 + w * (scale - 1));
    });
    for (const Vec3& p : randomPoints(grown(testBox(), 0.5), 2000)) {
        if (weight(p) == 0) {
            EXPECT_EQ(at(map, p), p);
        }
    }
}

TEST(TransferLibrary, DeflectWarnsOfFolds) {
    const auto warningOf = [](Numbers translate, double scale) {
        std::string warning;
        libraryTransfer("deflect")->make({{{"center", Numbers{0, 0, 0}},
                                           {"radius", Numbers{10}},
                                           {"translate", std::move(translate)},
                                           {"scale", Numbers{scale}}},
                                          {},
                                          {},
                                          1,
                                          0},
                                         &warning);
        return warning;
    };
    EXPECT_EQ(warningOf({6.4, 0, 0}, 1), "");
    EXPECT_NE(warningOf({6.6, 0, 0}, 1).find("fold"), std::string::npos);
    EXPECT_EQ(warningOf({0, 0, 0}, 0.26), "");
    EXPECT_NE(warningOf({0, 0, 0}, 0.24).find("fold"), std::string::npos);
    // As said: at these limits the map along a ray through the centre stops rising.
    const auto rises = [](Numbers translate, double scale) {
        const auto map = library("deflect", {{"center", Numbers{0, 0, 0}},
                                             {"radius", Numbers{10}},
                                             {"translate", std::move(translate)},
                                             {"scale", Numbers{scale}}});
        double last = -11;
        for (double x = -10; x <= 10; x += 0.001) {
            const double q = at(map, {x, 0, 0}).x;
            if (q < last) return false;
            last = q;
        }
        return true;
    };
    EXPECT_TRUE(rises({6.49, 0, 0}, 1));
    EXPECT_FALSE(rises({6.6, 0, 0}, 1));
    EXPECT_TRUE(rises({0, 0, 0}, 0.251));
    EXPECT_FALSE(rises({0, 0, 0}, 0.249));
}

TEST(TransferLibrary, AffineIsTheAffineMap) {
    const Vec3 t(5, -6, 7), r(20, 50, -140), s(1.5, 0.7, -2);
    const AffineMap oracle(placementMatrix(t, r * (kPi / 180), s));
    const auto map = library(
        "affine",
        {{"translate", Numbers{5, -6, 7}}, {"rotate", Numbers{20, 50, -140}}, {"scale", Numbers{1.5, 0.7, -2}}});
    expectEqualMaps(map, [&](const Vec3& p) { return mappedBy(oracle, {p})[0]; });
    const Box3 image = map->imageOf(testBox()), expected = oracle.imageOf(testBox());
    EXPECT_LT(glm::length(image.min - expected.min) + glm::length(image.max - expected.max), 1e-11);
    const auto uniform = library("affine", {{"scale", Numbers{2}}});
    EXPECT_EQ(at(uniform, {2, 4, -6}), Vec3(1, 2, -3));
}

TEST(TransferLibrary, JacobiansAreTheDerivatives) {
    for (const LibraryCase& c : libraryCases()) {
        const auto map = library(c.name, c.arguments);
        std::vector<Vec3> inside;
        for (const Vec3& p : randomPoints(grown(testBox(), 0.2), 2000)) {
            // Differences across cuts and kinks are none: a point counts where one-sided differences agree.
            const double h = 1e-5;
            bool smooth = true;
            for (int axis = 0; axis < 3; ++axis) {
                Vec3 step(0);
                step[axis] = h;
                const auto q = mappedBy(*map, {p - step, p, p + step});
                smooth = smooth && glm::length((q[2] - q[1]) - (q[1] - q[0])) < 1e-9;
            }
            if (smooth) inside.push_back(p);
        }
        EXPECT_GT(inside.size(), 150u) << c.name;
        EXPECT_LT(jacobianError(*map, inside), 1e-5) << c.name;
    }
}

TEST(TransferLibrary, ImagesHoldAllThatComesFromTheBox) {
    const Box3 frame = testBox();
    std::vector<Box3> rests{frame,
                            {frame.min + 0.2 * frame.size(), frame.max - Vec3(30, 5, 50)},
                            grown(frame, 0.25),
                            {frame.min - 5.0, frame.center()}};
    for (const LibraryCase& c : libraryCases())
        for (const Outside outside : {Outside::Hide, Outside::Keep}) {
            const auto map = library(c.name, c.arguments, 1, outside);
            for (const Box3& rest : rests)
                EXPECT_EQ(strayImages(*map, rest, randomPoints(grown(frame, 1.5), 30000)), 0) << c.name;
        }
}

TEST(TransferLibrary, ImagesAreAsTheDefinitionsSay) {
    const Box3 box = testBox();
    const Vec3 size = box.size();
    const auto expectImage = [&](const TransferPtr& map, const Box3& expected) {
        const Box3 image = map->imageOf(box);
        EXPECT_LT(glm::length(image.min - expected.min), 1e-10)
            << image.min.x << " " << image.min.y << " " << image.min.z;
        EXPECT_LT(glm::length(image.max - expected.max), 1e-10)
            << image.max.x << " " << image.max.y << " " << image.max.z;
    };
    const Vec3 x(size.x, 0, 0);
    expectImage(library("split", {{"axis", Axes{0}}, {"gap", Numbers{0.3}}}), {box.min - 0.15 * x, box.max + 0.15 * x});
    expectImage(library("open", {{"axis", Axes{0}}, {"hinge", Axes{2}}}), {box.min - 0.2 * x, box.max + 0.2 * x});
    expectImage(library("dissect", {{"axes", Axes{0, 2}}}), box);
    const double r = 0.5 * std::hypot(size.x, size.y);
    expectImage(
        library("twist", {{"axis", Axes{2}}, {"angle", Numbers{33}}}),
        {{box.center().x - r, box.center().y - r, box.min.z}, {box.center().x + r, box.center().y + r, box.max.z}});
    const Vec3 wide = 0.5 * size * Vec3(1.7, 1.7, 1);
    expectImage(library("taper", {{"axis", Axes{2}}, {"scale", Numbers{0.4, 1.7}}}),
                {box.center() - wide, box.center() + wide});
    const Vec3 bulged = 0.5 * size * Vec3(1.8, 1, 1.8);
    expectImage(library("squeeze", {{"axis", Axes{1}}, {"strength", Numbers{-0.8}}}),
                {box.center() - bulged, box.center() + bulged});
    const LineValue z{{10, 10, 99}, {0, 0, -7}};
    expectImage(library("insideOut", {{"line", z}, {"radius", Numbers{50}}}), {{-40, -40, 10}, {60, 60, 130}});
    expectImage(library("rotationalSweep",
                        {{"line", z}, {"start", Numbers{0, 1, 0}}, {"from", Numbers{0}}, {"to", Numbers{90}}}),
                {{-20, -20, 10}, {40, 40, 130}});
    const Arguments ball{{"center", Numbers{40, 10, 70}}, {"radius", Numbers{30}}, {"translate", Numbers{15, 0, -3}}};
    expectImage(library("deflect", ball), {box.min, box.max + Vec3(15, 0, 0)});
}

TEST(TransferLibrary, TheImageOfABendIsTheBoxOfTheBentBox) {
    const Box3 box = testBox();
    for (const BendCase& b : kBends) {
        if (std::abs(b.angle) < 1e-3) continue;
        const auto map = library("bend", {{"axis", Axes{b.axis}},
                                          {"toward", Axes{b.toward}},
                                          {"angle", Numbers{b.angle}},
                                          {"range", Numbers{b.range.x, b.range.y}}});
        const double length = (b.range.y - b.range.x) * box.size()[b.axis];
        const double middle = box.min[b.axis] + 0.5 * (b.range.x + b.range.y) * box.size()[b.axis];
        const double angle = std::abs(b.angle) * kPi / 180, side = b.angle < 0 ? -1 : 1;
        Box3 hull;
        const int n = 1000;
        for (int i = 0; i <= n; ++i)
            for (const Vec3& end : {box.min, box.max}) {
                const double s = box.min[b.axis] + box.size()[b.axis] * i / n - middle;
                double eta = side * (end[b.toward] - box.center()[b.toward]);
                if (std::abs(s) <= length / 2 + 1e-9) eta = std::min(eta, length / angle);
                const Vec2 moved = bent(s, eta, angle, length);
                Vec3 p = end;
                p[b.axis] = middle + moved.x;
                p[b.toward] = box.center()[b.toward] + side * moved.y;
                hull = join(hull, p);
            }
        const Box3 image = map->imageOf(box);
        EXPECT_LT(glm::length(image.min - hull.min), 0.3) << b.angle;
        EXPECT_LT(glm::length(image.max - hull.max), 0.3) << b.angle;
    }
}

TEST(TransferLibrary, SourceBoxesHoldAllSources) {
    for (const LibraryCase& c : libraryCases())
        for (const Outside outside : {Outside::Hide, Outside::Keep}) {
            const auto map = library(c.name, c.arguments, 1, outside);
            unsigned seed = 0;
            for (const Vec3& p : randomPoints(grown(testBox(), 0.2), 60)) {
                const Vec3 half = Vec3(1 + seed % 7, 1 + seed % 5, 1 + seed % 11);
                EXPECT_EQ(straySources(*map, {p - half, p + half}, ++seed), 0) << c.name;
            }
        }
}

TEST(TransferLibrary, NothingComesFromAGap) {
    const auto split = library("split", {{"axis", Axes{0}}, {"gap", Numbers{0.5}}});
    const auto never = [](const Box3&) { return ADD_FAILURE() << "a box in the gap has a source", false; };
    EXPECT_FALSE(split->anySourceBox({{0, 0, 50}, {20, 20, 60}}, never));
    const auto out = library("insideOut", {{"line", LineValue{{0, 0, 0}, {0, 0, 1}}}, {"radius", Numbers{10}}});
    EXPECT_FALSE(out->anySourceBox({{20, 20, 0}, {30, 30, 10}}, never));
}

TEST(TransferLibrary, AmountMultipliesStrengths) {
    const auto expectSame = [](const TransferPtr& a, const TransferPtr& b) {
        expectEqualMaps(a, [&](const Vec3& p) { return at(b, p); });
    };
    const Arguments z{{"axis", Axes{2}}};
    const auto with = [](Arguments a, const Arguments& more) { return a.insert(more.begin(), more.end()), a; };
    expectSame(library("twist", with(z, {{"angle", Numbers{100}}}), 0.25),
               library("twist", with(z, {{"angle", Numbers{25}}})));
    expectSame(library("split", with(z, {{"gap", Numbers{0.4}}}), 0.5),
               library("split", with(z, {{"gap", Numbers{0.2}}})));
    expectSame(library("dissect", {{"axes", Axes{1}}}, 0.5),
               library("dissect", {{"axes", Axes{1}}, {"gap", Numbers{0.15}}}));
    expectSame(library("open", with(z, {{"hinge", Axes{0}}}), 0.5),
               library("open", with(z, {{"hinge", Axes{0}}, {"width", Numbers{0.1}}})));
    expectSame(library("squeeze", with(z, {{"strength", Numbers{0.8}}}), 0.5),
               library("squeeze", with(z, {{"strength", Numbers{0.4}}})));
    expectSame(library("bend", with(z, {{"toward", Axes{0}}, {"angle", Numbers{90}}}), 0.5),
               library("bend", with(z, {{"toward", Axes{0}}, {"angle", Numbers{45}}})));
    const Arguments ball{{"center", Numbers{20, 10, 70}}, {"radius", Numbers{45}}};
    expectSame(
        library("deflect",
                with(ball, {{"translate", Numbers{8, 4, 0}}, {"rotate", Numbers{40, 0, 20}}, {"scale", Numbers{2}}}),
                0.5),
        library(
            "deflect",
            with(ball, {{"translate", Numbers{4, 2, 0}}, {"rotate", Numbers{20, 0, 10}}, {"scale", Numbers{1.5}}})));
    // Where nothing is marked, the displacement is scaled.
    for (const LibraryCase& c : libraryCases()) {
        const auto& parameters = libraryTransfer(c.name)->parameters();
        if (std::any_of(parameters.begin(), parameters.end(), [](const auto& p) { return p.strength; })) continue;
        const auto whole = library(c.name, c.arguments);
        expectEqualMaps(library(c.name, c.arguments, 0.3), [&](const Vec3& p) {
            const Vec3 q = at(whole, p);
            return isDefined(q) ? p + 0.3 * (q - p) : q;
        });
    }
}

}  // namespace
}  // namespace voledit
