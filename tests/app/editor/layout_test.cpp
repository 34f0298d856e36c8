#include "app/editor/layout.h"

#include <gtest/gtest.h>

namespace voledit {
namespace {

TEST(Layout, PartsTileTheWindow) {
    for (const float scale : {1.0f, 1.5f, 2.0f})
        for (const Index2 window : {Index2(1280, 800), Index2(2560, 1600), Index2(700, 500)}) {
            const Layout layout = layoutOf(window, scale);
            EXPECT_EQ(layout.view.size.x + layout.panels.size.x, window.x);
            EXPECT_EQ(layout.menu.size.y + layout.view.size.y + layout.status.size.y, window.y);
            EXPECT_EQ(layout.panels.origin, Index2(layout.view.size.x, layout.menu.size.y));
            EXPECT_GT(layout.view.size.x, window.x / 2);
        }
}

TEST(Layout, ATinyWindowStillHasAViewport) {
    const Layout layout = layoutOf({20, 20}, 2);
    EXPECT_GE(layout.view.size.x, 1);
    EXPECT_GE(layout.view.size.y, 1);
}

TEST(Layout, TheTimelineTakesItsHeightButLeavesTheViewItsPart) {
    const Layout with = layoutOf({1280, 800}, 2, 100);
    EXPECT_EQ(with.time.size.y, 200);
    EXPECT_EQ(with.time.origin.y, with.view.origin.y + with.view.size.y);
    EXPECT_EQ(with.time.size.x, with.view.size.x);
    EXPECT_EQ(with.menu.size.y + with.view.size.y + with.time.size.y + with.status.size.y, 800);
    const Layout greedy = layoutOf({1280, 800}, 1, 5000);
    EXPECT_GE(greedy.view.size.y, 2 * (800 - greedy.menu.size.y - greedy.status.size.y) / 5);
    EXPECT_EQ(layoutOf({1280, 800}, 1, 0).view, layoutOf({1280, 800}, 1).view);
}

}  // namespace
}  // namespace voledit
