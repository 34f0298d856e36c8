#include "app/editor/timeline/key_move.h"

#include <gmock/gmock.h>

#include "core/scene/scene_json.h"

namespace voledit {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr const char* kRadius = "/root/shape/sphere/radius";

struct KeyMoveTest : testing::Test {
    Document document{sceneFromJson(R"({ "voledit": 1, "timeline": { "fps": 10, "start": 0, "end": 20 },
        "root": { "type": "solid", "shape": { "sphere": { "center": [0,0,0],
                  "radius": { "keys": [[0, 1], [0.52, 2], [1, 3]] } } }, "color": [1,1,1], "opacity": 1 } })",
                                    "test.voledit")};

    std::vector<double> times() {
        std::vector<double> times;
        for (const KeyMark& mark : keysOf(document.scene(), kRadius)) times.push_back(mark.time);
        return times;
    }
};

TEST_F(KeyMoveTest, TheAnchorLandsOnWholeFramesAndTheOthersFollow) {
    KeyMove move({{kRadius, 0.52}, {kRadius, 1}}, 0.52, 5.2, false);
    const auto moved = move.follow(document, 8.4, false);
    EXPECT_NEAR(move.delta(), 0.28, 1e-9);
    ASSERT_EQ(moved.size(), 2u);
    EXPECT_NEAR(moved[1].time, 1.28, 1e-9);
    EXPECT_NEAR(times()[1], 0.8, 1e-9);
    move.follow(document, 8.44, true);  // free
    EXPECT_NEAR(move.delta(), 0.324, 1e-9);
    move.finish(document);
    EXPECT_THAT(document.undoNames(), ElementsAre("Move 2 keys"));
    document.undo();
    EXPECT_THAT(times(), ElementsAre(0, 0.52, 1));
}

TEST_F(KeyMoveTest, APointerThatStaysInItsFrameMovesNothing) {
    KeyMove move({{kRadius, 0.52}}, 0.52, 5.2, false);
    move.follow(document, 5.4, false);
    EXPECT_EQ(move.delta(), 0);
    move.finish(document);
    EXPECT_THAT(document.undoNames(), IsEmpty());
    EXPECT_FALSE(document.previewing());
}

TEST_F(KeyMoveTest, CopiesStandBesideTheOnesTheyWereMadeFrom) {
    KeyMove move({{kRadius, 0}}, 0, 0, true);
    move.follow(document, 7, false);
    move.finish(document);
    EXPECT_EQ(times().size(), 4u);
    EXPECT_NEAR(numbersAt(document.scene(), kRadius, 0.7)[0], 1, 1e-12);
    EXPECT_THAT(document.undoNames(), ElementsAre("Copy key"));
}

TEST_F(KeyMoveTest, CancelRestores) {
    KeyMove move({{kRadius, 1}}, 1, 10, false);
    move.follow(document, 3, false);
    EXPECT_NE(document.scene(), document.committed());
    const auto back = move.cancel(document);
    EXPECT_THAT(back, ElementsAre(KeyRef{kRadius, 1}));
    EXPECT_THAT(times(), ElementsAre(0, 0.52, 1));
    EXPECT_THAT(document.undoNames(), IsEmpty());
}

}  // namespace
}  // namespace voledit
