#pragma once
// BVH texts for tests.

#include <string>

namespace voledit::test {

/// Two bones and an end site; every joint has its own order of channels. Two frames.
inline std::string smallBvh() {
    return "HIERARCHY\n"
           "ROOT Hips\n{\n"
           "  OFFSET 1 2 3\n  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
           "  JOINT Spine.01\n  {\n    OFFSET 0 10 0\n    CHANNELS 3 Yrotation Xrotation Zrotation\n"
           "    JOINT Head\n    {\n      OFFSET 0 5 0\n      CHANNELS 1 Xrotation\n"
           "      End Site\n      {\n        OFFSET 0 2 0\n      }\n    }\n  }\n}\n"
           "MOTION\nFrames: 2\nFrame Time: 0.025\n"
           "4 5 6 0 0 0 0 0 0 0\n"
           "1.5 -2 3e1 10 20 30 -40 50 60 70\n";
}

/// `text` with the first `from` replaced.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    return at == std::string::npos ? "" : text.replace(at, from.size(), to);
}

}  // namespace voledit::test
