#include "app/editor/request_words.h"

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace voledit {
namespace {

TEST(RequestWords, TheLastWordIsTakenWhereItFits) {
    std::string text = "a path of words 12";
    EXPECT_EQ(takeLastWord(text, "[0-9]+"), "12");
    EXPECT_EQ(text, "a path of words");
    EXPECT_EQ(takeLastWord(text, "[0-9]+"), "");
    EXPECT_EQ(text, "a path of words");
    text = "12";  // that is the path
    EXPECT_EQ(takeLastWord(text, "[0-9]+"), "");
}

TEST(RequestWords, SizesAreChecked) {
    std::string text = "a.png 12x34";
    EXPECT_EQ(takeLastSize(text, {1, 2}, "it"), Index2(12, 34));
    EXPECT_EQ(takeLastSize(text, {1, 2}, "it"), Index2(1, 2));
    EXPECT_EQ(text, "a.png");
    text = "a.png 0x34";
    EXPECT_THROW(takeLastSize(text, {1, 2}, "it"), Error);
}

}  // namespace
}  // namespace voledit
