#pragma once
// The library's transfers with arguments, for tests.

#include <map>
#include <string>

#include "core/stf/transfer_definition.h"

namespace voledit {

using Numbers = std::vector<double>;
using Axes = std::vector<int>;
using Arguments = std::map<std::string, TransferArgument>;

/// A frame in millimetres with three different sides.
inline Box3 testBox() {
    return {{-30, -20, 10}, {50, 40, 130}};
}

inline TransferPtr library(const std::string& name, const Arguments& arguments, double amount = 1,
                           Outside outside = Outside::Hide, const Box3& frame = testBox()) {
    const TransferDefinitionPtr definition = libraryTransfer(name);
    if (!definition) throw Error("no transfer " + name);
    return definition->make({arguments, frameOf(frame), outside, amount, 0});
}

struct LibraryCase {
    std::string name;
    Arguments arguments;
};

/// Every transfer of the library, some with several sets of arguments.
inline std::vector<LibraryCase> libraryCases() {
    const LineValue line{{10, 5, 60}, {0.3, -0.2, 1}};
    return {
        {"split", {{"axis", Axes{0}}, {"gap", Numbers{0.3}}}},
        {"split", {{"axis", Axes{2}}, {"at", Numbers{0.2}}, {"gap", Numbers{0.05}}}},
        {"dissect", {{"axes", Axes{0, 1, 2}}}},
        {"dissect", {{"axes", Axes{1}}, {"gap", Numbers{0.6}}}},
        {"open", {{"axis", Axes{0}}, {"hinge", Axes{1}}}},
        {"open",
         {{"axis", Axes{2}},
          {"hinge", Axes{0}},
          {"at", Numbers{0.4}},
          {"width", Numbers{0.5}},
          {"profile", Numbers{3}}}},
        {"open", {{"axis", Axes{1}}, {"hinge", Axes{1}}, {"profile", Numbers{0.5}}}},
        {"insideOut", {{"line", line}, {"radius", Numbers{25}}}},
        {"squeeze", {{"axis", Axes{2}}, {"strength", Numbers{0.6}}}},
        {"squeeze", {{"axis", Axes{0}}, {"strength", Numbers{-0.8}}, {"at", Numbers{0.9}}, {"sigma", Numbers{0.4}}}},
        {"twist", {{"axis", Axes{2}}, {"angle", Numbers{120}}}},
        {"twist", {{"axis", Axes{0}}, {"angle", Numbers{-250}}, {"at", Numbers{0}}}},
        {"taper", {{"axis", Axes{1}}, {"scale", Numbers{0.4, 1.7}}}},
        {"bend", {{"axis", Axes{2}}, {"toward", Axes{0}}, {"angle", Numbers{90}}}},
        {"bend", {{"axis", Axes{0}}, {"toward", Axes{1}}, {"angle", Numbers{-200}}, {"range", Numbers{0.25, 0.75}}}},
        {"bend", {{"axis", Axes{2}}, {"toward", Axes{1}}, {"angle", Numbers{340}}, {"range", Numbers{0, 1}}}},
        {"rotationalSweep",
         {{"line", line}, {"start", Numbers{1, 0.2, 0}}, {"from", Numbers{-30}}, {"to", Numbers{200}}}},
        {"deflect", {{"center", Numbers{20, 10, 70}}, {"radius", Numbers{45}}, {"translate", Numbers{20, -8, 5}}}},
        {"deflect",
         {{"center", Numbers{20, 10, 70}},
          {"radius", Numbers{45}},
          {"translate", Numbers{-9, 4, 12}},
          {"rotate", Numbers{40, -25, 70}},
          {"scale", Numbers{1.6}}}},
        {"affine",
         {{"translate", Numbers{5, -6, 7}}, {"rotate", Numbers{20, 50, -140}}, {"scale", Numbers{1.5, 0.7, -2}}}},
    };
}

}  // namespace voledit
