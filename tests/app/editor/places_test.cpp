#include "app/editor/places.h"

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace voledit {
namespace {

TEST(Places, EveryFormReadsBack) {
    for (const char* text : {"12,34", "12.5,34", "-3,4", "@view(0.25,0.75)", "@point(pull,3,0,2)", "@joint(LeftArm)",
                             "@key(pull.amount,2)", "@widget(\"Lattice/Amount\")", "@view(0.5,0.5)+-20,8", "12,34+1,-1",
                             "@point(\"my lattice\",0,0,0)+40,-20", "+10,-4", "@widget(\"Open/a, b (c).nrrd\")"})
        EXPECT_EQ(textOf(parsePlace(text)), text);
}

TEST(Places, Parts) {
    const Place place = parsePlace("@point(pull, 3, 0, 2)+40,-20");
    EXPECT_EQ(place.kind, Place::Kind::Point);
    EXPECT_EQ(place.name, "pull");
    EXPECT_EQ(place.point, Index3(3, 0, 2));
    EXPECT_EQ(place.offset, Vec2(40, -20));
}

TEST(Places, WrongOnes) {
    for (const char* text : {"", "12", "12,", "a,b", "12,34+", "12,34+5", "@", "@view", "@view(0.5)", "@view(0.5,x)",
                             "@point(pull,1,2)", "@point(pull,1,2,-3)", "@point(,1,2,3)", "@nothing(1)", "@widget()",
                             "@view(0.5,0.5)40,20", "@view(nan,0.5)", "@view(0.5,0.5", "1e999,0"})
        EXPECT_THROW(parsePlace(text), Error) << text;
}

}  // namespace
}  // namespace voledit
