#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

#include "core/base/error.h"
#include "core/io/bvh.h"
#include "core/io/bvh_scanner.h"
#include "core/io/unique_names.h"

namespace voledit {

namespace {

constexpr std::array<const char*, 6> kChannelNames{"Xposition", "Yposition", "Zposition",
                                                   "Xrotation", "Yrotation", "Zrotation"};

const char* const kExportAnew = "export it anew";
const char* const kCutOff = "it was cut off: copy or export it anew";

class BvhParser {
public:
    BvhParser(std::string_view text, const std::string& file, std::vector<std::string>* warnings)
        : scan_(text, file), warnings_(warnings) {}

    Motion parse() {
        if (scan_.atEnd()) throw Error(scan_.file(), "is empty", "copy or export it anew");
        if (!scan_.take("HIERARCHY")) {
            scan_.word();
            scan_.fail("is no BVH file: it does not begin with HIERARCHY", "give a motion in BVH format");
        }
        readHierarchy();
        nameEndSites();
        readFrameTable();
        readFrames();
        return std::move(motion_);
    }

private:
    struct OpenJoint {
        int index;
        bool offset = false, channels = false, children = false;
    };

    void warn(const std::string& what) {
        constexpr int most = 10;
        if (warnings_ && ++warned_ <= most)
            warnings_->push_back(scan_.file() + ": " + what + (warned_ == most ? "; and perhaps more" : ""));
    }

    const std::string& nameOf(const OpenJoint& joint) const { return motion_.joints[std::size_t(joint.index)].name; }

    void readHierarchy() {
        while (!(open_.empty() && scan_.take("MOTION"))) {
            const std::string_view word = scan_.word();
            if (word.empty())
                scan_.fail(open_.empty() ? "it ends before MOTION"
                                         : "it ends within the joint " + quotedText(nameOf(open_.back())),
                           kCutOff);
            if (open_.empty())
                readRoot(word);
            else
                readMember(word);
        }
        if (motion_.joints.empty()) scan_.fail("its hierarchy has no joints", kExportAnew);
    }

    void readRoot(std::string_view word) {
        if (!equalInAnyCase(word, "ROOT"))
            scan_.fail(quotedText(word) + " stands where ROOT or MOTION is expected", "mend the hierarchy there");
        openJoint(false);
    }

    void readMember(std::string_view word) {
        OpenJoint& joint = open_.back();
        const bool endSite = motion_.joints[std::size_t(joint.index)].endSite;
        if (word == "}") {
            closeJoint();
        } else if (equalInAnyCase(word, "OFFSET")) {
            once(joint.offset, joint, "OFFSET");
            for (int a = 0; a < 3; ++a) motion_.joints[std::size_t(joint.index)].offset[a] = scan_.number("an OFFSET");
        } else if (equalInAnyCase(word, "CHANNELS") && !endSite) {
            once(joint.channels, joint, "CHANNELS");
            // The order of joints is the order of their numbers: later channels would stand before earlier ones.
            if (joint.children) scan_.fail("CHANNELS stand behind a joint below", "put them before it");
            readChannels(motion_.joints[std::size_t(joint.index)]);
        } else if (equalInAnyCase(word, "JOINT") && !endSite) {
            joint.children = true;
            openJoint(false);
        } else if (equalInAnyCase(word, "End") && scan_.take("Site") && !endSite) {
            joint.children = true;
            openJoint(true);
        } else {
            scan_.fail(quotedText(word) + " stands where " +
                           (endSite ? "OFFSET or }" : "OFFSET, CHANNELS, JOINT, End Site or }") + " is expected",
                       "mend the hierarchy there; every { needs its }");
        }
    }

    void once(bool& seen, const OpenJoint& joint, const char* what) {
        if (seen)
            scan_.fail(std::string(what) + " stands twice in the joint " + quotedText(nameOf(joint)), kExportAnew);
        seen = true;
    }

    void openJoint(bool endSite) {
        if (motion_.joints.size() >= kMostJoints)
            scan_.fail("it has more than " + std::to_string(kMostJoints) + " joints", "give a smaller skeleton");
        if (open_.size() >= BvhLimits::depth)
            scan_.fail("its joints are nested deeper than " + std::to_string(BvhLimits::depth),
                       "give a flatter skeleton");
        MotionJoint joint;
        joint.endSite = endSite;
        joint.parent = open_.empty() ? Joint::kNoParent : open_.back().index;
        const std::string_view written = scan_.restOfLine();
        if (!endSite) joint.name = jointName(written);
        if (!scan_.take("{")) {
            const std::string_view found = scan_.word();
            scan_.fail(
                found.empty() ? "it ends where { is expected" : quotedText(found) + " stands where { is expected",
                found.empty() ? kCutOff : "mend the hierarchy there");
        }
        open_.push_back({int(motion_.joints.size())});
        motion_.joints.push_back(std::move(joint));
    }

    void closeJoint() {
        const OpenJoint& joint = open_.back();
        if (!joint.offset)
            scan_.fail(motion_.joints[std::size_t(joint.index)].endSite
                           ? "an End Site has no OFFSET"
                           : "the joint " + quotedText(nameOf(joint)) + " has no OFFSET",
                       "give it one");
        open_.pop_back();
    }

    std::string jointName(std::string_view written) {
        if (written.empty()) scan_.fail("a joint has no name", "give it one");
        if (written.size() > BvhLimits::nameBytes)
            scan_.fail("a joint's name is longer than " + std::to_string(BvhLimits::nameBytes) + " bytes",
                       "shorten it");
        const auto isControl = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
        if (std::any_of(written.begin(), written.end(), isControl))
            scan_.fail("the joint's name " + quotedText(written) + " is no text", kExportAnew);
        std::string name(written);
        if (!isUtf8(name)) {
            name = utf8OfLatin1(name);
            warn("line " + std::to_string(scan_.line()) + ": the joint's name " + quotedText(written) +
                 " is not UTF-8 and was taken as Latin-1");
        }
        const std::string free = names_.unique(name);
        if (free != name)
            warn("line " + std::to_string(scan_.line()) + ": the name " + quotedText(name) +
                 " is given twice; this joint is called " + quotedText(free));
        return free;
    }

    void nameEndSites() {
        for (MotionJoint& joint : motion_.joints)
            if (joint.endSite) joint.name = names_.unique(motion_.joints[std::size_t(joint.parent)].name + "_End");
    }

    void readChannels(MotionJoint& joint) {
        const double count = scan_.number("the number of CHANNELS");
        if (count < 0 || count > double(BvhLimits::channels) || count != std::floor(count))
            scan_.fail("the joint " + quotedText(joint.name) + " claims a number of channels that is not one of 0 … " +
                           std::to_string(BvhLimits::channels),
                       "mend it there");
        for (std::size_t i = 0; i < std::size_t(count); ++i) {
            const std::string_view name = scan_.word();
            const auto found = std::find_if(kChannelNames.begin(), kChannelNames.end(),
                                            [&](const char* known) { return equalInAnyCase(known, name); });
            if (found == kChannelNames.end())
                scan_.fail(quotedText(name) + " is no channel, or the joint " + quotedText(joint.name) +
                               " has fewer than it claims",
                           "known are Xposition, Yposition, Zposition, Xrotation, Yrotation, Zrotation");
            const auto channel = MotionChannel(found - kChannelNames.begin());
            const bool again = std::find(joint.channels.begin(), joint.channels.end(), channel) != joint.channels.end();
            if (again && channel <= MotionChannel::Zposition)
                scan_.fail("the joint " + quotedText(joint.name) + " has " + *found + " twice", "take one away");
            joint.channels.push_back(channel);
        }
    }

    /// "Frames:", also with a blank before the colon.
    void expect(std::string_view key) {
        const bool glued = scan_.take(std::string(key) + ":");
        if (glued || (scan_.take(key) && scan_.take(":"))) return;
        const std::string_view found = scan_.word();
        scan_.fail(found.empty() ? "it ends where " + std::string(key) + ": is expected"
                                 : quotedText(found) + " stands where " + std::string(key) + ": is expected",
                   found.empty() ? kCutOff : "mend it there, or export anew");
    }

    void readFrameTable() {
        expect("Frames");
        const double frames = scan_.number("the number of frames");
        if (frames < 0 || frames != std::floor(frames))
            scan_.fail("the number of frames is not one of 0, 1, 2 …", "mend it there, or export anew");
        if (frames > double(BvhLimits::frames))
            scan_.fail("it claims more than " + std::to_string(BvhLimits::frames) + " frames",
                       "mend the number or cut the motion");
        claimed_ = std::size_t(frames);
        if (!scan_.take("Frame"))
            scan_.fail("Frame Time: is expected behind the number of frames", "mend it there, or export anew");
        expect("Time");
        motion_.frameTime = scan_.number("the frame time");
        if (motion_.frameTime == 0 && claimed_ <= 1) {
            motion_.frameTime = 1.0 / 30;
            warn("its frame time of 0 was taken as 1/30 second");
        }
        if (motion_.frameTime < 1e-6 || motion_.frameTime > 1e4)
            scan_.fail("the frame time is not between 0.000001 and 10000 seconds", "give seconds, such as 0.0333333");
    }

    void readFrames() {
        const std::size_t channels = motion_.channelCount();
        // A number takes two bytes at least: what the file cannot hold is not reserved.
        motion_.values.reserve(std::min(claimed_ * channels, scan_.left() / 2 + 1));
        if (channels == 0) motion_.frames = claimed_;
        for (; motion_.frames < claimed_ && !scan_.atEnd(); ++motion_.frames) readFrame(channels);
        if (motion_.frames == 0 && claimed_ > 0)
            throw Error(scan_.file(), "claims " + std::to_string(claimed_) + " frames and holds none", kCutOff);
        if (motion_.frames < claimed_)
            warn("claims " + std::to_string(claimed_) + " frames and holds " + std::to_string(motion_.frames) +
                 "; those were read");
        if (!scan_.atEnd())
            warn("line " + std::to_string(scan_.line()) + ": what stands behind the " + std::to_string(claimed_) +
                 " frames that it claims was left out");
    }

    void readFrame(std::size_t channels) {
        const int first = scan_.line();
        for (std::size_t c = 0; c < channels; ++c) {
            if (scan_.atEnd())
                throw Error(scan_.file() + ", line " + std::to_string(first),
                            "it ends within frame " + std::to_string(motion_.frames) + ", which has " +
                                std::to_string(c) + " of " + std::to_string(channels) + " numbers",
                            kCutOff);
            motion_.values.push_back(scan_.number("a channel of a frame"));
        }
        if (!scan_.atLineEnd())
            throw Error(scan_.file() + ", line " + std::to_string(first),
                        "frame " + std::to_string(motion_.frames) + " does not have the " + std::to_string(channels) +
                            " numbers that its channels make (on line " + std::to_string(scan_.line()) +
                            " there are more, or a line before has fewer)",
                        "mend it there, or export anew");
    }

    BvhScanner scan_;
    std::vector<std::string>* warnings_;
    Motion motion_;
    std::vector<OpenJoint> open_;
    UniqueNames names_;
    std::size_t claimed_ = 0;
    int warned_ = 0;
};

std::string contentsOf(const std::filesystem::path& path) {
    struct stat about {};
    if (stat(path.c_str(), &about) != 0) throw Error(path.string(), "cannot be found", "check the name");
    if (!S_ISREG(about.st_mode)) throw Error(path.string(), "is no ordinary file", "name a motion file");
    if (std::size_t(about.st_size) > BvhLimits::fileBytes)
        throw Error(path.string(), "is longer than " + std::to_string(BvhLimits::fileBytes >> 20) + " MiB",
                    "cut the motion into parts");
    std::ifstream in(path, std::ios::binary);
    std::string text(std::size_t(about.st_size), '\0');
    in.read(text.data(), std::streamsize(text.size()));
    if (!in) throw Error(path.string(), "cannot be read", "check its permissions");
    return text;
}

}  // namespace

Motion parseBvh(std::string_view text, const std::string& fileName, std::vector<std::string>* warnings) {
    return BvhParser(text, fileName, warnings).parse();
}

Motion readBvh(const std::filesystem::path& path, std::vector<std::string>* warnings) {
    return parseBvh(contentsOf(path), path.string(), warnings);
}

}  // namespace voledit
