#include <algorithm>
#include <charconv>
#include <fstream>

#include "core/base/error.h"
#include "core/io/bvh.h"
#include "core/io/output_folder.h"

namespace voledit {

namespace {

constexpr const char* kChannelWords[] = {" Xposition", " Yposition", " Zposition",
                                         " Xrotation", " Yrotation", " Zrotation"};

void append(std::string& text, double number) {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, number).ptr;
    text.append(digits, end);
}

std::string writableName(std::string name) {
    for (char& c : name)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f || c == '{' || c == '}') c = '_';
    return name;
}

class BvhWriter {
public:
    explicit BvhWriter(const Motion& motion) : motion_(motion), children_(motion.joints.size()) {
        std::size_t first = 0;
        for (std::size_t j = 0; j < motion.joints.size(); ++j) {
            const MotionJoint& joint = motion.joints[j];
            if (joint.parent != Joint::kNoParent) children_[std::size_t(joint.parent)].push_back(j);
            firstChannel_.push_back(first);
            first += joint.channels.size();
        }
        channels_ = first;
    }

    std::string text() {
        text_ = "HIERARCHY\n";
        for (std::size_t j = 0; j < motion_.joints.size(); ++j)
            if (motion_.joints[j].parent == Joint::kNoParent) writeTree(j);
        text_ += "MOTION\nFrames: " + std::to_string(motion_.frames) + "\nFrame Time: ";
        append(text_, motion_.frameTime);
        text_ += '\n';
        for (std::size_t f = 0; f < motion_.frames && channels_ > 0; ++f) writeFrame(f);
        return std::move(text_);
    }

private:
    struct Open {
        std::size_t joint, nextChild = 0;
    };

    /// Without recursion: skeletons may be as deep as they have joints.
    void writeTree(std::size_t root) {
        std::vector<Open> open{{root}};
        begin(root, 0);
        while (!open.empty()) {
            const auto& children = children_[open.back().joint];
            if (open.back().nextChild < children.size()) {
                const std::size_t child = children[open.back().nextChild++];
                begin(child, open.size());
                open.push_back({child});
            } else {
                open.pop_back();
                indent(open.size());
                text_ += "}\n";
            }
        }
    }

    void begin(std::size_t j, std::size_t depth) {
        const MotionJoint& joint = motion_.joints[j];
        order_.push_back(j);
        indent(depth);
        const bool endSite = joint.endSite && children_[j].empty() && joint.channels.empty() && depth > 0;
        text_ += endSite ? "End Site" : (depth == 0 ? "ROOT " : "JOINT ") + writableName(joint.name);
        text_ += '\n';
        indent(depth);
        text_ += "{\n";
        indent(depth + 1);
        text_ += "OFFSET";
        for (int a = 0; a < 3; ++a) append(text_ += ' ', joint.offset[a]);
        text_ += '\n';
        if (endSite) return;
        indent(depth + 1);
        text_ += "CHANNELS " + std::to_string(joint.channels.size());
        for (const MotionChannel channel : joint.channels) text_ += kChannelWords[std::size_t(channel)];
        text_ += '\n';
    }

    void indent(std::size_t depth) {
        constexpr std::size_t deepest = 64;  // what is deeper would make the text's length quadratic
        text_.append(std::min(depth, deepest), '\t');
    }

    void writeFrame(std::size_t frame) {
        const double* values = motion_.values.data() + frame * channels_;
        bool first = true;
        for (const std::size_t j : order_) {
            for (std::size_t c = 0; c < motion_.joints[j].channels.size(); ++c) {
                if (!first) text_ += ' ';
                append(text_, values[firstChannel_[j] + c]);
                first = false;
            }
        }
        text_ += '\n';
    }

    const Motion& motion_;
    std::vector<std::vector<std::size_t>> children_;
    std::vector<std::size_t> firstChannel_, order_;  // of each joint; joints as they are written
    std::size_t channels_ = 0;
    std::string text_;
};

}  // namespace

std::string bvhText(const Motion& motion) {
    return BvhWriter(motion).text();
}

void writeBvh(const Motion& motion, const std::filesystem::path& path) {
    const std::string text = bvhText(motion);
    const OutputFolder folder(path);
    std::ofstream out(folder.file(), std::ios::binary);
    out << text;
    out.close();
    if (!out) throw Error(path.string(), "could not be written", "check the disk's space and permissions");
    folder.publish({folder.file().filename().string()});
}

}  // namespace voledit
