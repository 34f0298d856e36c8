#include "core/skeleton/joint_words.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <vector>

namespace voledit {

namespace {

bool isUpper(char c) {
    return std::isupper(static_cast<unsigned char>(c)) != 0;
}
bool isLetter(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0;
}
char lower(char c) {
    return char(std::tolower(static_cast<unsigned char>(c)));
}

std::string withoutNameSpace(const std::string& name) {
    const auto at = name.find_last_of(":|");
    return at == std::string::npos || at + 1 == name.size() ? name : name.substr(at + 1);
}

/// Runs of letters in lower case, split where a capital begins a word too: "LHipJoint" is l, hip, joint.
std::vector<std::string> wordsOf(const std::string& name) {
    std::vector<std::string> words;
    bool open = false;
    for (std::size_t i = 0; i < name.size(); ++i) {
        if (!isLetter(name[i])) {
            open = false;
            continue;
        }
        const bool afterSmall = open && !isUpper(name[i - 1]);
        const bool beforeSmall = i + 1 < name.size() && isLetter(name[i + 1]) && !isUpper(name[i + 1]);
        if (!open || (isUpper(name[i]) && (afterSmall || beforeSmall))) words.emplace_back();
        words.back() += lower(name[i]);
        open = true;
    }
    return words;
}

bool isOneOf(std::string_view word, std::initializer_list<std::string_view> list) {
    return std::find(list.begin(), list.end(), word) != list.end();
}

/// Takes the side away from the words.
BodySide takeSide(std::vector<std::string>& words) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        const bool left = isOneOf(words[i], {"left", "l", "lft"}), right = isOneOf(words[i], {"right", "r", "rgt"});
        if (!left && !right) continue;
        words.erase(words.begin() + std::ptrdiff_t(i));
        return left ? BodySide::Left : BodySide::Right;
    }
    // Grown together: "leftupleg", "lThigh" written small.
    constexpr std::array<std::string_view, 22> known{
        "hand", "thigh", "shin",  "foot", "forearm", "shldr", "shoulder", "collar", "clavicle", "arm",  "uparm",
        "toe",  "leg",   "upleg", "knee", "ankle",   "elbow", "wrist",    "finger", "thumb",    "calf", "index"};
    for (std::string& word : words) {
        for (const auto& [start, side] : {std::pair{"left", BodySide::Left}, {"right", BodySide::Right}})
            if (word.starts_with(start)) {
                word.erase(0, std::string_view(start).size());
                return side;
            }
        if (word[0] != 'l' && word[0] != 'r') continue;
        const std::string_view rest = std::string_view(word).substr(1);
        const auto begins = [&](std::string_view start) { return rest.starts_with(start); };
        if (std::none_of(known.begin(), known.end(), begins)) continue;
        const BodySide side = word[0] == 'l' ? BodySide::Left : BodySide::Right;
        word.erase(0, 1);
        return side;
    }
    return BodySide::Middle;
}

class Text {
public:
    explicit Text(const std::vector<std::string>& words) {
        for (const std::string& word : words)
            if (word != "armature") text_ += word;
    }
    bool has(std::initializer_list<std::string_view> parts) const {
        return std::any_of(parts.begin(), parts.end(),
                           [&](std::string_view part) { return text_.find(part) != std::string::npos; });
    }
    bool begins(std::string_view start) const { return text_.starts_with(start); }

private:
    std::string text_;
};

JointWord sidedWord(const Text& text) {
    if (text.has({"thumb"})) return JointWord::Thumb;
    if (text.has({"index"})) return JointWord::Index;
    if (text.has({"middle"})) return JointWord::MiddleFinger;
    if (text.has({"pinky", "pinkie", "little"})) return JointWord::Little;
    if (text.begins("ring") || text.has({"handring"})) return JointWord::Ring;
    if (text.has({"finger"})) return JointWord::Fingers;
    if (text.has({"toe", "ball"})) return JointWord::Toe;
    if (text.has({"foot", "ankle"})) return JointWord::Foot;
    if (text.has({"thigh", "femur"}) || (text.has({"leg"}) && text.has({"up"}))) return JointWord::Thigh;
    if (text.has({"shin", "calf", "knee", "tibia"})) return JointWord::Shin;
    if (text.has({"leg"})) return text.has({"low", "loleg"}) ? JointWord::Shin : JointWord::Leg;
    if (text.has({"elbow", "forearm", "loarm", "ulna"}) || (text.has({"arm"}) && text.has({"low"})))
        return JointWord::Forearm;
    if (text.has({"humerus", "bicep"}) || (text.has({"arm"}) && text.has({"up"}))) return JointWord::UpperArm;
    if (text.has({"hand", "wrist", "palm"})) return JointWord::Hand;
    if (text.has({"collar", "clavicle", "scapula"})) return JointWord::Collar;
    if (text.has({"shoulder", "shldr"})) return JointWord::Shoulder;
    if (text.has({"arm"})) return JointWord::Arm;
    return text.has({"hip"}) ? JointWord::Hip : JointWord::None;
}

JointWord middleWord(const std::vector<std::string>& words, const Text& text) {
    if (text.has({"hip", "pelvis"})) return JointWord::Hips;
    if (text.has({"spine", "chest", "abdomen", "torso", "thorax", "waist"})) return JointWord::Spine;
    if (text.has({"neck"})) return JointWord::Neck;
    if (text.has({"head"})) return JointWord::Head;
    const auto isWord = [&](std::initializer_list<std::string_view> list) {
        return std::any_of(words.begin(), words.end(), [&](const std::string& word) { return isOneOf(word, list); });
    };
    if (isWord({"back", "lowerback", "upperback"})) return JointWord::Spine;
    return isWord({"root", "reference", "origin"}) ? JointWord::Root : JointWord::None;
}

}  // namespace

NameReading readName(const std::string& name) {
    const std::string own = withoutNameSpace(name);
    std::vector<std::string> words = wordsOf(own);
    NameReading reading;
    reading.side = takeSide(words);
    reading.helper = own.starts_with('_');
    for (const std::string& word : words) {
        reading.isEnd = reading.isEnd || isOneOf(word, {"end", "nub", "site", "effector"});
        reading.helper = reading.helper || isOneOf(word, {"twist", "roll", "ik", "pole", "target", "ctrl"});
    }
    const Text text(words);
    reading.word = reading.side == BodySide::Middle ? middleWord(words, text) : sidedWord(text);
    return reading;
}

std::string plainName(const std::string& name) {
    std::string plain;
    for (const char c : withoutNameSpace(name))
        if (isLetter(c) || std::isdigit(static_cast<unsigned char>(c)) || static_cast<unsigned char>(c) >= 0x80)
            plain += lower(c);
    return plain;
}

}  // namespace voledit
