// The algebra's identities (definitions.md §3), on a CT head and on a procedural object, by voxelising to double.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/eval/voxelise.h"
#include "core/io/io_client.h"
#include "core/scene/scene_json.h"
#include "tests/support/fixtures.h"

namespace voledit {
namespace {

/// What is transferred: a JSON object, the box that it stands in, and the files that it needs.
struct Subject {
    std::string name, object;
    Box3 box;
    LoadedAssets assets;
    double range;  // of its values: differences are stated as parts of it
};

/// Round about and translucent outside, denser within, its colour different everywhere.
Subject proceduralObject() {
    const std::string json = R"json({"type": "fields", "bounds": {"min": [-1, -1, -1], "max": [1, 1, 1]},
        "opacity": {"expression": "exp(-3*(x^2 + y^2 + z^2)) * (0.8 + 0.2*sin(7*x)*cos(5*y + 3*z))"},
        "color": [{"expression": "0.5 + 0.4*x"}, {"expression": "0.5 - 0.4*y*z"}, {"expression": "0.5 + 0.4*sin(4*z)"}],
        "density": {"expression": "x + 2*y"}})json";
    return {"procedural", json, {Vec3(-1), Vec3(1)}, {}, 1};
}

std::optional<Subject> head() {
    const auto path = test::shared("data/volumes/ct_head.mhd");
    if (!path) return std::nullopt;
    static IoClient io;
    const auto volume = io.readVolume(*path).volume;
    const std::string json = R"({"type": "volume", "asset": "head", "appearance":
        {"opacity": [[-1000, 0], [3000, 1]], "color": [[-1000, 0, 0.2, 0.4], [3000, 1, 0.5, 0]]}})";
    const double range = volume->statistics().max - volume->statistics().min;
    return Subject{"head", json, boundsOf(volume->grid().worldFrame()), LoadedVolumes{{"head", volume}}, range};
}

/// A frame about the middle of the subject, off its planes of symmetry: `"frame": …`.
std::string frameIn(const Subject& subject) {
    const Vec3 size = subject.box.size(), low = subject.box.min + 0.11 * size, high = subject.box.max - 0.07 * size;
    const auto list = [](const Vec3& v) {
        return "[" + std::to_string(v.x) + ", " + std::to_string(v.y) + ", " + std::to_string(v.z) + "]";
    };
    return R"("frame": {"min": )" + list(low) + R"(, "max": )" + list(high) + "}";
}

/// `root` may name the subject by { "use": "o" }.
CompiledScene sceneOf(const Subject& subject, const std::string& root) {
    const std::string assets =
        subject.assets.volumes.empty() ? "" : R"("assets": {"head": {"kind": "volume", "path": "ct_head.mhd"}},)";
    const std::string text =
        R"({"voledit": 1, )" + assets + R"("objects": {"o": )" + subject.object + R"(}, "root": )" + root + "}";
    return compile(sceneFromJson(text, "/identities.voledit"), subject.assets, 0, nullptr);
}

std::string transfer(const std::string& by, const std::string& of) {
    return R"({"type": "transfer", "by": )" + by + R"(, "of": )" + of + "}";
}
std::string displace(const std::string& by, const std::string& of) {
    return R"({"type": "displace", "by": )" + by + R"(, "of": )" + of + "}";
}
const std::string kObject = R"({"use": "o"})";

std::shared_ptr<const Volume> voxels(const Subject& subject, const std::string& root, VoxeliseWhat what) {
    const Vec3 margin = 0.13 * subject.box.size();
    const VolumeGrid grid = cellCentredGrid({subject.box.min - margin, subject.box.max + margin}, {41, 43, 37}, 1);
    return voxelise(sceneOf(subject, root), {grid, what, VoxelType::Double, kNaN});
}

/// Largest difference of the values of two terms: colour and opacity; of a volume also its scalar, as a part of its
/// range. Infinite where one of them has a value and the other has none.
double difference(const Subject& subject, const std::string& one, const std::string& other, const char* identity) {
    double largest = 0;
    std::size_t seen = 0;
    const auto compare = [&](VoxeliseWhat what, double unit) {
        const auto a = voxels(subject, one, what), b = voxels(subject, other, what);
        const auto* x = reinterpret_cast<const double*>(a->voxels().data());
        const auto* y = reinterpret_cast<const double*>(b->voxels().data());
        for (std::size_t n = 0; n < a->grid().valueCount(); ++n) {
            if (x[n] != x[n] && y[n] != y[n]) continue;
            seen += x[n] != 0;
            largest = std::max(largest, x[n] == x[n] && y[n] == y[n] ? std::abs(x[n] - y[n]) / unit : kInfinity);
        }
    };
    compare(VoxeliseWhat::Rgba, 1);
    if (!subject.assets.volumes.empty() && one.find("union") == std::string::npos)
        compare(VoxeliseWhat::Scalar, subject.range);
    EXPECT_GT(seen, 10000u) << "most of the grid must show something";
    std::printf("%-45s %-10s largest difference %.3g\n", identity, subject.name.c_str(), largest);
    return largest;
}

class Identities : public testing::TestWithParam<bool> {
protected:
    void SetUp() override {
        if (GetParam()) {
            const auto real = head();
            if (!real) GTEST_SKIP() << "shared test data ct_head.mhd is not there";
            subject_ = *real;
        } else {
            subject_ = proceduralObject();
        }
        frame_ = frameIn(subject_);
        const double side = subject_.box.size().x;
        const Vec3 centre = subject_.box.center() + 0.03 * subject_.box.size();
        line_ = R"({"point": [)" + std::to_string(centre.x) + ", " + std::to_string(centre.y) + ", " +
                std::to_string(centre.z) + R"(], "direction": [0.2, -0.1, 1]})";
        radius_ = std::to_string(0.83 * side);
    }

    std::string twist(double degrees) const {
        return R"({"type": "twist", "axis": "z", "angle": )" + std::to_string(degrees) + ", " + frame_ + "}";
    }
    std::string squeeze() const {
        return R"({"type": "squeeze", "axis": "x", "at": 0.4, "strength": 0.45, "sigma": 0.3, )" + frame_ + "}";
    }
    std::string open() const {
        return R"({"type": "open", "axis": "x", "hinge": "z", "at": 0.52, "width": 0.17, )" + frame_ + "}";
    }
    std::string pull() const {
        const double by = 0.2 * subject_.box.size().x;
        return R"({"type": "ffd", "move": [{"point": [3, 3, 3], "by": [)" + std::to_string(by) + ", " +
               std::to_string(-by) + ", " + std::to_string(by / 2) + R"(]}, {"point": [1, 2, 1], "by": [)" +
               std::to_string(by) + R"(, 0, 0]}], )" + frame_ + "}";
    }
    std::string insideOut() const {
        return R"({"type": "insideOut", "line": )" + line_ + R"(, "radius": )" + radius_ + "}";
    }
    std::vector<std::string> transfers() const { return {twist(70), squeeze(), open(), pull()}; }

    Subject subject_;
    std::string frame_, line_, radius_;
};

INSTANTIATE_TEST_SUITE_P(On, Identities, testing::Values(false, true),
                         [](const auto& instance) { return instance.param ? "Head" : "Procedural"; });

TEST_P(Identities, TheIdentityChangesNothing) {
    const std::string world = R"({"type": "expression", "space": "world", "x": "x", "y": "y", "z": "z"})";
    EXPECT_EQ(difference(subject_, transfer(world, kObject), kObject, "world x, y, z"), 0);
    for (std::string stf : transfers()) {
        stf.insert(1, R"("amount": 0, )");
        EXPECT_EQ(difference(subject_, transfer(stf, kObject), kObject, "amount 0"), 0) << stf;
    }
    std::string off = twist(70);
    off.insert(1, R"("enabled": false, )");
    EXPECT_EQ(difference(subject_, transfer(off, kObject), kObject, "not enabled"), 0);
}

TEST_P(Identities, ATransferredTransferIsOneAfterTheOther) {
    const auto all = transfers();
    for (std::size_t n = 0; n < all.size(); ++n) {
        const std::string &first = all[n], &second = all[(n + 1) % all.size()];
        const std::string together = R"({"type": "transferred", "by": )" + second + R"(, "of": )" + first + "}";
        const std::string apart = transfer(second, transfer(first, kObject));
        EXPECT_EQ(difference(subject_, transfer(together, kObject), apart, "[->]([->](s2,s1),o) = [->](s2,[->](s1,o))"),
                  0);
        EXPECT_EQ(difference(subject_, transfer("[" + first + ", " + second + "]", kObject), apart, "a list"), 0);
        const std::string sequence = R"({"type": "sequence", "of": [)" + first + ", " + second + "]}";
        EXPECT_EQ(difference(subject_, transfer(sequence, kObject), apart, "a sequence"), 0);
    }
}

TEST_P(Identities, ATransferDistributesOverUnion) {
    const Vec3 size = subject_.box.size(), centre = subject_.box.center();
    const std::string ball = R"({"type": "solid", "shape": {"sphere": {"center": [)" +
                             std::to_string(centre.x + 0.2 * size.x) + ", " + std::to_string(centre.y) + ", " +
                             std::to_string(centre.z) + R"(], "radius": )" + std::to_string(0.3 * size.x) +
                             R"(}}, "color": [1, 0.2, 0.1], "opacity": 0.35})";
    for (const std::string& stf : transfers()) {
        const std::string whole = transfer(stf, R"({"type": "union", "of": [)" + kObject + ", " + ball + "]}");
        const std::string parts =
            R"({"type": "union", "of": [)" + transfer(stf, kObject) + ", " + transfer(stf, ball) + "]}";
        EXPECT_EQ(difference(subject_, whole, parts, "[->](s,union) = union of [->](s,o)"), 0) << stf;
    }
}

TEST_P(Identities, DisplacingByTheDifferenceIsTransferring) {
    for (const std::string& stf : transfers()) {
        const std::string delta = R"({"type": "of", "transfer": )" + stf + "}";
        EXPECT_EQ(difference(subject_, displace(delta, kObject), transfer(stf, kObject), "displace(S - id) = transfer"),
                  0)
            << stf;
    }
}

TEST_P(Identities, InsideOutTwiceIsTheOriginal) {
    const std::string inside =
        R"({"type": "insideOut", "line": )" + line_ + R"(, "radius": )" + radius_ + R"(, "outside": "keep"})";
    EXPECT_LT(difference(subject_, transfer("[" + inside + ", " + inside + "]", kObject), kObject, "inside out, twice"),
              1e-11);
    // A linear volume is bent at its voxels' borders, but once there is nothing left of the turn.
    EXPECT_GT(difference(subject_, transfer(inside, kObject), kObject, "(inside out, once)"), 0.01);
}

TEST_P(Identities, ATwistAndItsReverseAreTheOriginal) {
    EXPECT_LT(difference(subject_, transfer("[" + twist(70) + ", " + twist(-70) + "]", kObject), kObject,
                         "twist and its reverse"),
              1e-11);
}

TEST_P(Identities, ADisplacementScaledByZeroIsNoneAndByOneIsAll) {
    for (const std::string& stf : transfers()) {
        const auto scaled = [&](const std::string& by) {
            return displace(R"({"type": "scale", "by": )" + by + R"(, "of": {"type": "of", "transfer": )" + stf + "}}",
                            kObject);
        };
        EXPECT_EQ(difference(subject_, scaled("0"), kObject, "scale 0"), 0) << stf;
        EXPECT_EQ(difference(subject_, scaled("1"), transfer(stf, kObject), "scale 1"), 0) << stf;
        EXPECT_EQ(difference(subject_, scaled(R"({"expression": "x - x"})"), kObject, "scale by a field of 0"), 0);
        EXPECT_EQ(difference(subject_, scaled(R"({"expression": "1 + 0*y"})"), transfer(stf, kObject),
                             "scale by a field of 1"),
                  0);
    }
}

TEST_P(Identities, TwoHalvesOfADisplacementMakeTheWhole) {
    for (const std::string& stf : transfers()) {
        const std::string half = R"({"type": "scale", "by": 0.5, "of": {"type": "of", "transfer": )" + stf + "}}";
        const std::string sum = R"({"type": "sum", "of": [)" + half + ", " + half + "]}";
        EXPECT_LT(difference(subject_, displace(sum, kObject), transfer(stf, kObject), "two half gains"), 1e-11) << stf;
    }
}

TEST_P(Identities, SamplesOfAnAmountAreThoseOfTheScaledDisplacement) {
    // A lattice and an expression mark no strength: their displacement is scaled.
    const std::string wave =
        R"json({"type": "expression", "x": "x + 0.05*sin(9*y)", "y": "y", "z": "z + 0.1*x*y", )json" + frame_ + "}";
    for (const std::string& stf : {wave, pull()}) {
        std::string amount = stf;
        amount.insert(1, R"("amount": 0.35, )");
        const std::string scaled =
            R"({"type": "scale", "by": {"expression": "0.35"}, "of": {"type": "of", "transfer": )" + stf + "}}";
        EXPECT_LT(difference(subject_, transfer(amount, kObject), displace(scaled, kObject), "amount = scaled"), 1e-11)
            << stf;
    }
}

}  // namespace
}  // namespace voledit
