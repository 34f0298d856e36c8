#include "core/scene/node_edits.h"

#include <gmock/gmock.h>

#include "core/base/error.h"
#include "core/scene/edits.h"
#include "core/scene/scene_json.h"
#include "core/scene/scene_walk.h"
#include "tests/core/scene/random_scenes.h"

namespace voledit {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// A scene with `root`, objects a, b, c, STF t and SD object d.
Scene read(const std::string& root, const std::string& more = "") {
    const std::string ball = R"({"type": "solid", "shape": {"sphere": {"center": [0, 0, 0], "radius": 1}},
                                 "color": [1, 1, 1], "opacity": 1})";
    return sceneFromJson(R"({"voledit": 1, "objects": {"a": )" + ball + R"(, "b": )" + ball + R"(, "c": )" + ball +
                             R"(}, "transfers": {"t": {"type": "affine"}}, "displacements": {"d": {"type": "of",
                             "transfer": {"type": "affine"}}}, "root": )" +
                             root + more + "}",
                         "/s.voledit");
}

Transfer twist() {
    Transfer transfer;
    transfer.kind = LibraryTransfer{"twist", false, {{"axis", LibraryTransfer::Axes{{2}, false}}}};
    return transfer;
}

// ---- Adding -------------------------------------------------------------------------------------------------------

TEST(AddTransfer, WrapsAnyObjectAndAppendsToATransfer) {
    Scene scene = read(R"({"type": "union", "of": [{"use": "a"}, {"use": "b"}]})");
    const Frame frame = frameOf({Vec3(0), Vec3(1)});
    EXPECT_EQ(addTransfer(scene, "/root/of/1", twist(), "twist", frame), "twist");
    EXPECT_EQ(addTransfer(scene, "/root/of/1", twist(), "twist", std::nullopt), "twist 2");
    EXPECT_EQ(addTransfer(scene, "/root/of/1", twist(), "d", std::nullopt), "d 2") << "a displacement is called so";
    EXPECT_EQ(scene.transfers.at("twist")->frame, frame);
    EXPECT_FALSE(scene.transfers.at("twist 2")->frame);
    Scene expected = read(R"({"type": "union", "of": [{"use": "a"}, {"type": "transfer", "of": {"use": "b"},
        "by": [{"use": "t"}, {"use": "t"}, {"use": "t"}]}]})");
    const auto& list = std::get<TransferObject>(findObjectAt(scene, "/root/of/1")->kind);
    ASSERT_EQ(list.by.size(), 3u);
    EXPECT_EQ(std::get<TransferUse>(list.by[1]->kind).name, "twist 2");
    EXPECT_EQ(list.of, std::get<TransferObject>(findObjectAt(expected, "/root/of/1")->kind).of);
    EXPECT_THROW(addTransfer(scene, "/root/of/7", twist(), "x", std::nullopt), Error);
    EXPECT_FALSE(scene.transfers.contains("x"));
}

TEST(WrapObject, PutsAnObjectIntoAnother) {
    Scene scene = read(R"({"use": "a"})");
    wrapObject(scene, "/root", Object{PlaceObject{}});
    EXPECT_EQ(scene, read(R"({"type": "place", "of": {"use": "a"}})"));
    CvgObject both;
    both.of = {Object{}, Object{ObjectUse{"b"}}};
    wrapObject(scene, "/root/of", Object{both});
    EXPECT_EQ(scene, read(R"({"type": "place", "of": {"type": "union", "of": [{"use": "a"}, {"use": "b"}]}})"));
    EXPECT_THAT([&] { wrapObject(scene, "/root", Object{SolidObject{}}); },
                ThrowsMessage<Error>(HasSubstr("takes no operand")));
}

// ---- Removing -----------------------------------------------------------------------------------------------------

struct Removal {
    const char* root;
    const char* path;
    const char* left;
};

TEST(RemoveNode, HealsWhatHeldIt) {
    const Removal removals[] = {
        // What wraps becomes what it wraps.
        {R"({"type": "place", "of": {"use": "a"}})", "/root", R"({"use": "a"})"},
        {R"({"type": "transfer", "by": {"use": "t"}, "of": {"use": "a"}})", "/root", R"({"use": "a"})"},
        {R"({"type": "recolor", "opacity": [[0, 1]], "of": {"use": "a"}})", "/root", R"({"use": "a"})"},
        {R"({"type": "displace", "by": {"use": "d"}, "of": {"use": "a"}})", "/root", R"({"use": "a"})"},
        // Operators.
        {R"({"type": "union", "of": [{"use": "a"}, {"use": "b"}, {"use": "c"}]})", "/root/of/1",
         R"({"type": "union", "of": [{"use": "a"}, {"use": "c"}]})"},
        {R"({"type": "union", "of": [{"use": "a"}, {"use": "b"}]})", "/root/of/0", R"({"use": "b"})"},
        {R"({"type": "blend", "weight": 0.5, "of": [{"use": "a"}, {"use": "b"}]})", "/root/of/1", R"({"use": "a"})"},
        {R"({"type": "blend", "weight": 0.5, "of": [{"use": "a"}, {"use": "b"}]})", "/root/weight",
         R"({"type": "blend", "weight": 0, "of": [{"use": "a"}, {"use": "b"}]})"},
        {R"({"type": "cap", "of": [{"use": "a"}, {"type": "place", "of": {"use": "b"}}]})", "/root/of/1/of",
         R"({"use": "a"})"},
        // STFs.
        {R"({"type": "transfer", "by": [{"use": "t"}, {"type": "ffd"}], "of": {"use": "a"}})", "/root/by/0",
         R"({"type": "transfer", "by": {"type": "ffd"}, "of": {"use": "a"}})"},
        {R"({"type": "transfer", "by": [{"use": "t"}], "of": {"use": "a"}})", "/root/by/0", R"({"use": "a"})"},
        {R"({"type": "transfer", "by": {"type": "sequence", "of": [{"type": "sequence", "of": [{"use": "t"}]}]},
             "of": {"use": "a"}})",
         "/root/by/0/of/0/of/0", R"({"use": "a"})"},
        {R"({"type": "transfer", "by": {"type": "transferred", "by": {"use": "t"}, "of": {"type": "ffd"}},
             "of": {"use": "a"}})",
         "/root/by/0/by", R"({"type": "transfer", "by": {"type": "ffd"}, "of": {"use": "a"}})"},
        {R"({"type": "transfer", "by": {"type": "transferred", "by": {"use": "t"}, "of": {"type": "ffd"}},
             "of": {"use": "a"}})",
         "/root/by/0/of", R"({"use": "a"})"},
        // SD objects.
        {R"({"type": "displace", "by": {"type": "of", "transfer": {"use": "t"}}, "of": {"use": "a"}})",
         "/root/by/transfer", R"({"use": "a"})"},
        {R"({"type": "displace", "by": {"type": "sum", "of": [{"use": "d"}, {"type": "of", "transfer": {"use": "t"}}]},
             "of": {"use": "a"}})",
         "/root/by/of/1", R"({"type": "displace", "by": {"use": "d"}, "of": {"use": "a"}})"},
        {R"({"type": "displace", "by": {"type": "scale", "by": 2, "of": {"use": "d"}}, "of": {"use": "a"}})",
         "/root/by", R"({"type": "displace", "by": {"use": "d"}, "of": {"use": "a"}})"},
        {R"({"type": "displace", "by": {"type": "blend", "weight": 1, "of": [{"use": "d"}, {"type": "of",
             "transfer": {"use": "t"}}]}, "of": {"use": "a"}})",
         "/root/by/of/1", R"({"type": "displace", "by": {"use": "d"}, "of": {"use": "a"}})"},
        // Fields.
        {R"({"type": "fields", "opacity": {"map": [[0, 1]], "of": {"expression": "x"}}, "color": [1, 1, 1]})",
         "/root/opacity", R"({"type": "fields", "opacity": {"expression": "x"}, "color": [1, 1, 1]})"},
        {R"({"type": "fields", "opacity": {"expression": "x"}, "color": [1, {"expression": "y"}, 1], "heat": 3})",
         "/root/color/1", R"({"type": "fields", "opacity": {"expression": "x"}, "color": [1, 0, 1], "heat": 3})"},
        {R"({"type": "fields", "opacity": 1, "color": [1, 1, 1], "heat": 3})", "/root/heat",
         R"({"type": "fields", "opacity": 1, "color": [1, 1, 1]})"},
        {R"({"type": "fields", "opacity": {"attribute": "heat", "of": {"use": "a"}}, "color": [1, 1, 1]})",
         "/root/opacity/of", R"({"type": "fields", "opacity": 0, "color": [1, 1, 1]})"},
        {R"({"type": "fields", "opacity": {"component": "x", "of": {"use": "t"}}, "color": [1, 1, 1]})",
         "/root/opacity/of", R"({"type": "fields", "opacity": 0, "color": [1, 1, 1]})"},
    };
    for (const auto& [root, path, left] : removals) {
        Scene scene = read(root);
        removeNode(scene, path);
        EXPECT_EQ(scene, read(left)) << path << " of " << root << "\n" << sceneToJson(scene);
    }
}

TEST(RemoveNode, OfAnEntryTakesItsUsesAndTheirAliases) {
    Scene scene = read(R"({"type": "union", "of": [{"use": "a"}, {"type": "transfer",
        "by": [{"use": "t"}, {"type": "ffd"}, {"use": "t"}], "of": {"use": "b"}}]})");
    Transfer alias;
    alias.kind = TransferUse{"t"};
    scene.transfers["alias"] = alias;
    addTransfer(scene, "/root/of/0", twist(), "twist", std::nullopt);
    editObjectAt(scene, "/root/of/0",
                 [&](Object& object) { std::get<TransferObject>(object.kind).by.front() = alias; });
    removeNode(scene, "/transfers/t");
    EXPECT_FALSE(scene.transfers.contains("t"));
    EXPECT_FALSE(scene.transfers.contains("alias"));
    EXPECT_EQ(scene.root, read(R"({"type": "union", "of": [{"use": "a"}, {"type": "transfer",
        "by": [{"type": "ffd"}], "of": {"use": "b"}}]})")
                              .root);
    removeNode(scene, "/objects/a");
    EXPECT_EQ(scene.root, read(R"({"type": "transfer", "by": {"type": "ffd"}, "of": {"use": "b"}})").root);
    EXPECT_FALSE(scene.objects.contains("a"));
}

TEST(RemoveNode, RefusesToLeaveNothingAndThenChangesNothing) {
    const Scene before = read(R"({"type": "place", "of": {"use": "a"}})");
    for (const char* path : {"/root/of", "/objects/a", "/root/by", ""}) {
        Scene scene = before;
        EXPECT_THROW(removeNode(scene, path), Error) << path;
        EXPECT_EQ(scene, before) << path;
    }
}

TEST(RemoveNode, LeavesScenesThatCanBeSavedAndReadWhateverGoes) {
    test::RandomScenes scenes(21, false);
    int removed = 0, refused = 0;
    for (int trial = 0; trial < 20; ++trial) {
        const Scene scene = scenes.next();
        std::vector<NodePath> places;
        forEachNode(scene, [&](const NodePath& path, const NodePointer&) { places.push_back(path); });
        for (const NodePath& place : places) {
            Scene left = scene;
            try {
                removeNode(left, place);
            } catch (const Error&) {
                ++refused;
                continue;
            }
            ++removed;
            ASSERT_EQ(sceneFromJson(sceneToJson(left), "/s.voledit"), left) << place << "\n" << sceneToJson(scene);
        }
    }
    EXPECT_GT(removed, 10 * refused);
}

// ---- Lists and names ----------------------------------------------------------------------------------------------

TEST(MoveTransferInList, MovesWithinTheList) {
    Scene scene = read(R"({"type": "transfer", "of": {"use": "a"}, "by": [{"type": "affine", "name": "0"},
        {"type": "affine", "name": "1"}, {"type": "sequence", "of": [{"type": "affine", "name": "2"},
        {"type": "affine", "name": "3"}]}]})");
    EXPECT_EQ(moveTransferInList(scene, "/root/by/0", 1), "/root/by/1");
    EXPECT_EQ(findTransferAt(scene, "/root/by/0")->name, "1");
    EXPECT_EQ(findTransferAt(scene, "/root/by/1")->name, "0");
    EXPECT_EQ(moveTransferInList(scene, "/root/by/2", -5), "/root/by/0");
    EXPECT_EQ(findTransferAt(scene, "/root/by/2")->name, "0");
    EXPECT_EQ(moveTransferInList(scene, "/root/by/0/of/0", 9), "/root/by/0/of/1");
    EXPECT_EQ(findTransferAt(scene, "/root/by/0/of/0")->name, "3");
    EXPECT_THROW(moveTransferInList(scene, "/transfers/t", 0), Error);
    EXPECT_THROW(moveTransferInList(scene, "/root", 0), Error);
}

TEST(Rename, AllUsesFollow) {
    const std::string root = R"({"type": "displace", "by": {"use": "d"}, "of": {"type": "fields", "opacity":
        {"component": "x", "of": {"use": "t"}}, "heat": {"component": "y", "of": {"use": "d"}},
        "color": [{"attribute": "opacity", "of": {"use": "a"}}, 0, 0]}})";
    Scene scene = read(root);
    renameTransfer(scene, "t", "turn");
    renameDisplacement(scene, "d", "delta");
    renameObject(scene, "a", "ball / ~");
    EXPECT_TRUE(scene.transfers.contains("turn") && scene.displacements.contains("delta"));
    EXPECT_FALSE(scene.transfers.contains("t") || scene.displacements.contains("d") || scene.objects.contains("a"));
    EXPECT_EQ(sceneFromJson(sceneToJson(scene), "/s.voledit"), scene) << "every use leads somewhere";
    renameTransfer(scene, "turn", "t");
    renameDisplacement(scene, "delta", "d");
    renameObject(scene, "ball / ~", "a");
    EXPECT_EQ(scene, read(root));
}

TEST(Rename, RefusesNamesThatAreTakenOrEmpty) {
    Scene scene = read(R"({"use": "a"})");
    EXPECT_THROW(renameObject(scene, "a", "b"), Error);
    EXPECT_THROW(renameObject(scene, "a", ""), Error);
    EXPECT_THROW(renameObject(scene, "x", "y"), Error);
    EXPECT_THROW(renameTransfer(scene, "t", "d"), Error) << "a component's use could not tell them apart";
    EXPECT_NO_THROW(renameObject(scene, "a", "a"));
    EXPECT_EQ(scene, read(R"({"use": "a"})"));
}

// ---- Arguments ----------------------------------------------------------------------------------------------------

TEST(SetArgument, DropsTracksUnlessATimeIsGiven) {
    using Numbers = Tracked<std::vector<double>>;
    Scene scene = read(R"({"type": "transfer", "of": {"use": "a"}, "by": {"type": "twist", "axis": "z",
        "angle": {"keys": [[0, 10], [2, 30]]}}})");
    const auto angle = [&] {
        return std::get<Numbers>(
            std::get<LibraryTransfer>(findTransferAt(scene, "/root/by/0")->kind).arguments.at("angle"));
    };
    setArgument(scene, "/root/by/0", "angle", Numbers({50}), 1.0);
    EXPECT_EQ(angle().at(1), std::vector<double>{50});
    EXPECT_EQ(angle().at(2), std::vector<double>{30});
    setArgument(scene, "/root/by/0", "angle", Numbers({70}));
    EXPECT_EQ(angle(), std::vector<double>{70});
    setArgument(scene, "/root/by/0", "at", Numbers({0.25}), 1.0);
    setArgument(scene, "/root/by/0", "axis", LibraryTransfer::Axes{{0}, false});
    EXPECT_EQ(scene, read(R"({"type": "transfer", "of": {"use": "a"}, "by": {"type": "twist", "axis": "x",
        "angle": 70, "at": 0.25}})"));
    EXPECT_THAT([&] { setArgument(scene, "/transfers/t", "angle", Numbers({1})); },
                ThrowsMessage<Error>(HasSubstr("no arguments")));
}

TEST(SceneArgument, AndDefinitionArgumentAreInverse) {
    for (const auto& definition : transferLibrary())
        for (const auto& parameter : definition->parameters()) {
            const auto argument = sceneArgument(parameter, parameter.suggested);
            EXPECT_EQ(definitionArgument(argument), parameter.suggested) << definition->name() << parameter.name;
            if (const auto* axes = std::get_if<LibraryTransfer::Axes>(&argument)) {
                EXPECT_EQ(axes->list, parameter.kind == TransferParameter::Kind::Axes);
            }
        }
}

}  // namespace
}  // namespace voledit
