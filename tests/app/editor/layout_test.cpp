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

}  // namespace
}  // namespace voledit
