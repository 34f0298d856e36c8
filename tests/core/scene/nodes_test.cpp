#include "core/scene/nodes.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/scene/scene_json.h"
#include "core/scene/scene_walk.h"
#include "tests/core/scene/random_scenes.h"

namespace voledit {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

Transfer affineNamed(const std::string& name) {
    Transfer transfer;
    transfer.name = name;
    return transfer;
}

/// Whatever stands at `path`.
NodePointer pointerAt(const Scene& scene, const NodePath& path) {
    if (const auto* object = findObjectAt(scene, path)) return object;
    if (const auto* transfer = findTransferAt(scene, path)) return transfer;
    if (const auto* displacement = findDisplacementAt(scene, path)) return displacement;
    return findFieldAt(scene, path);
}

TEST(NodePaths, AreThoseOfTheSavedScene) {
    test::RandomScenes scenes(11);
    std::size_t nodes = 0;
    for (int trial = 0; trial < 40; ++trial) {
        const Scene scene = scenes.next();
        const auto saved = nlohmann::json::parse(sceneToJson(scene));
        forEachNode(scene, [&](const NodePath& path, const NodePointer& node) {
            ++nodes;
            EXPECT_TRUE(saved.contains(nlohmann::json::json_pointer(path))) << path;
            EXPECT_EQ(pointerAt(scene, path), node) << path;
        });
    }
    EXPECT_GT(nodes, 1000u);
}

TEST(NodePaths, OfWhatIsNotThereFindNothing) {
    test::RandomScenes scenes(12);
    const Scene scene = scenes.next();
    for (const char* path : {"", "/", "/camera", "/roo", "/root/", "root", "/objects", "/objects/none", "/root/of/7x",
                             "/transfers/t/by/00"}) {
        EXPECT_EQ(findObjectAt(scene, path), nullptr) << path;
        EXPECT_EQ(findTransferAt(scene, path), nullptr) << path;
        EXPECT_THROW(editObjectAt(const_cast<Scene&>(scene), path, [](Object&) {}), Error) << path;
    }
    EXPECT_EQ(findTransferAt(scene, "/root"), nullptr) << "an object is no transfer";
}

TEST(NodePaths, KnowTheirParent) {
    test::RandomScenes scenes(13);
    const Scene scene = scenes.next();
    forEachNode(scene, [&](const NodePath& path, const NodePointer&) {
        const NodePath parent = parentOf(scene, path);
        const bool top = path == kRootPath || std::count(path.begin(), path.end(), '/') == 2;
        if (parent.empty()) {
            EXPECT_TRUE(top) << path;
        } else {
            EXPECT_EQ(path.rfind(parent + "/", 0), 0u) << path;
            const auto steps = std::count(path.begin() + long(parent.size()), path.end(), '/');
            EXPECT_LE(steps, path.ends_with("/of") ? 4 : 2) << path << ": a limb's stands deeper";
        }
    });
    EXPECT_EQ(parentOf(scene, kRootPath), "");
    EXPECT_EQ(parentOf(scene, "/transfers/t"), "");
}

TEST(EditTransferAt, ChangesThatNodeAndSharesAllOthers) {
    test::RandomScenes scenes(14, false);
    int edited = 0;
    for (int trial = 0; trial < 20; ++trial) {
        const Scene scene = scenes.next();
        std::vector<NodePath> places;
        forEachNode(scene, [&](const NodePath& path, const NodePointer& node) {
            const auto* transfer = std::get_if<const Transfer*>(&node);
            if (transfer && !std::holds_alternative<TransferUse>((*transfer)->kind)) places.push_back(path);
        });
        for (const NodePath& place : places) {
            Scene changed = scene;
            editTransferAt(changed, place, [](Transfer& transfer) { transfer.name = "changed"; });
            ++edited;
            forEachNode(scene, [&](const NodePath& path, const NodePointer& before) {
                const bool onTheWay = place == path || place.rfind(path + "/", 0) == 0;
                EXPECT_EQ(pointerAt(changed, path) == before, !onTheWay) << place << " " << path;
            });
            EXPECT_EQ(findTransferAt(changed, place)->name, "changed");
            EXPECT_NE(findTransferAt(scene, place)->name, "changed");
        }
    }
    EXPECT_GT(edited, 50);
}

TEST(EditTransferAt, SaysWhatIsMissing) {
    Scene scene;
    EXPECT_THAT([&] { editTransferAt(scene, "/transfers/t", [](Transfer&) {}); },
                ThrowsMessage<Error>(HasSubstr("no transfer there")));
}

TEST(FollowedUse, GoesToTheEnd) {
    Scene scene;
    scene.transfers["a"] = affineNamed("a");
    Transfer use;
    use.kind = TransferUse{"a"};
    scene.transfers["b"] = use;
    use.kind = TransferUse{"b"};
    TransferObject list;
    list.by = {use, affineNamed("inline")};
    scene.objects["o"] = Object{list};
    scene.root = Object{ObjectUse{"o"}};
    EXPECT_EQ(followedUse(scene, kRootPath), "/objects/o");
    EXPECT_EQ(followedUse(scene, "/objects/o/by/0"), "/transfers/a");
    EXPECT_EQ(followedUse(scene, "/objects/o/by/1"), "/objects/o/by/1");
    EXPECT_EQ(followedUse(scene, "/objects/p"), "");
    use.kind = TransferUse{"c"};
    scene.transfers["c"] = use;
    EXPECT_EQ(followedUse(scene, "/transfers/c"), "") << "a circle";
}

}  // namespace
}  // namespace voledit
