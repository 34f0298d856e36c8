#include "app/editor/timeline/dope_rows.h"

#include <gmock/gmock.h>

#include "core/scene/scene_json.h"

namespace voledit {
namespace {

using testing::ElementsAre;

Scene keyedScene() {
    return sceneFromJson(R"({ "voledit": 1,
        "transfers": {
          "bend": { "type": "twist", "axis": "z",
                    "angle": { "keys": [[0, 10], [1, 30], [2, 50, "step"]], "interpolation": "smooth" },
                    "amount": { "keys": [[1, 0.5], [1.5, 1]] } },
          "pull": { "type": "ffd", "move": [{ "point": [3, 0, 0], "by": { "keys": [[0, [0,0,0]], [1, [0,0,1]]] } }] } },
        "root": { "type": "place", "translate": { "keys": [[0, [0,0,0]], [2, [1,0,0]]] },
          "of": { "type": "transfer", "by": [{ "use": "bend" }, { "use": "pull" }],
                  "of": { "type": "solid", "shape": { "sphere": { "center": [0,0,0], "radius": 1 } },
                          "color": [1,1,1], "opacity": 1 } } } })",
                         "test.voledit");
}

std::vector<double> timesOf(const DopeRow& row) {
    std::vector<double> times;
    for (const DopeMark& mark : row.marks) times.push_back(mark.time);
    return times;
}

const DopeRow* rowOf(const std::vector<DopeRow>& rows, DopeRow::Kind kind, const std::string& id) {
    for (const DopeRow& row : rows)
        if (row.kind == kind && row.id == id) return &row;
    return nullptr;
}

TEST(DopeRows, ValuesStandBelowTheirNodesAndASummaryAboveAll) {
    const auto rows = dopeRows(keyedScene(), {}, {});
    EXPECT_EQ(rows.front().kind, DopeRow::Kind::Summary);
    EXPECT_THAT(timesOf(rows.front()), ElementsAre(0, 1, 1.5, 2));
    const DopeRow* node = rowOf(rows, DopeRow::Kind::Node, "/transfers/bend");
    ASSERT_TRUE(node);
    EXPECT_EQ(node->label, "bend");
    EXPECT_THAT(timesOf(*node), ElementsAre(0, 1, 1.5, 2));
    EXPECT_EQ(node->marks[1].keys.size(), 2u);
    EXPECT_TRUE(node->marks[1].mixed);  // one smooth, one linear
    const DopeRow* angle = rowOf(rows, DopeRow::Kind::Value, "/transfers/bend/angle");
    ASSERT_TRUE(angle);
    EXPECT_GT(angle, node);
    EXPECT_THAT(timesOf(*angle), ElementsAre(0, 1, 2));
    EXPECT_EQ(angle->marks[0].interpolation, Track::Interpolation::Smooth);
    EXPECT_EQ(angle->marks[2].interpolation, Track::Interpolation::Step);
    EXPECT_TRUE(rowOf(rows, DopeRow::Kind::Value, "/root/translate"));
}

TEST(DopeRows, ClosedNodesKeepTheirMarks) {
    const auto rows = dopeRows(keyedScene(), {}, {"/transfers/bend"});
    EXPECT_FALSE(rowOf(rows, DopeRow::Kind::Value, "/transfers/bend/angle"));
    const DopeRow* node = rowOf(rows, DopeRow::Kind::Node, "/transfers/bend");
    ASSERT_TRUE(node);
    EXPECT_FALSE(node->open);
    EXPECT_THAT(timesOf(*node), ElementsAre(0, 1, 1.5, 2));
    EXPECT_TRUE(rowOf(rows, DopeRow::Kind::Node, "/transfers/pull")->open);
}

TEST(DopeRows, MotionsCoverTheirLength) {
    Scene scene = keyedScene();
    scene.assets["walk"] = {AssetKind::Motion, "walk.bvh"};
    LoadedAssets assets;
    Motion motion;
    motion.frameTime = 0.1;
    motion.frames = 31;
    assets.motions["walk"] = std::make_shared<const Motion>(motion);
    const auto rows = dopeRows(scene, assets, {});
    EXPECT_EQ(rows.back().kind, DopeRow::Kind::Motion);
    EXPECT_EQ(rows.back().label, "walk");
    EXPECT_NEAR(rows.back().to, 3, 1e-12);
}

TEST(DopeRows, WithoutKeysThereIsTheSummaryAlone) {
    EXPECT_EQ(dopeRows(Scene{}, {}, {}).size(), 1u);
    EXPECT_TRUE(dopeRows(Scene{}, {}, {}).front().marks.empty());
}

TEST(TrackNamed, TakesPathsLabelsAndTheirEnds) {
    const Scene scene = keyedScene();
    const auto is = [&](const std::string& name) { return trackNamed(scene, name).value_or("none"); };
    EXPECT_EQ(is("/transfers/bend/angle"), "/transfers/bend/angle");
    EXPECT_EQ(is("bend · angle"), "/transfers/bend/angle");
    EXPECT_EQ(is("angle"), "/transfers/bend/angle");
    EXPECT_EQ(is("bend/angle"), "/transfers/bend/angle");
    EXPECT_EQ(is("bend.amount"), "/transfers/bend/amount");
    EXPECT_EQ(is("Translate"), "/root/translate");
    EXPECT_EQ(is("at"), "none");  // has no keys
    EXPECT_EQ(is("gle"), "none");
    EXPECT_EQ(is(""), "none");
}

TEST(KeyTimes, AreThoseOfSomeOrOfAll) {
    EXPECT_THAT(keyTimes(keyedScene(), {}), ElementsAre(0, 1, 1.5, 2));
    EXPECT_THAT(keyTimes(keyedScene(), {"/transfers/bend/amount"}), ElementsAre(1, 1.5));
}

}  // namespace
}  // namespace voledit
