#include "app/animation/frame_record.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/animation/fingerprint.h"
#include "core/base/error.h"

namespace voledit {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr int kVersion = 1;

json toJson(const FrameSettings& s) {
    return {{"voledit-frames", kVersion},   {"scene", s.scene}, {"camera", s.camera}, {"renderer", s.renderer},
            {"size", {s.size.x, s.size.y}}, {"fps", s.fps},     {"step", s.step},     {"supersample", s.supersample}};
}

FrameSettings settingsOf(const json& j) {
    return {.scene = j.at("scene"),
            .camera = j.at("camera"),
            .renderer = j.at("renderer"),
            .size = {j.at("size").at(0), j.at("size").at(1)},
            .fps = j.at("fps"),
            .step = j.at("step"),
            .supersample = j.value("supersample", 1)};
}

FinishedFrame frameOf(const json& j) {
    return {.frame = j.at("frame"), .bytes = j.at("bytes"), .fingerprint = j.at("fingerprint")};
}

}  // namespace

FinishedFrame finishedFrame(int frame, const fs::path& file) {
    std::error_code failed;
    const auto bytes = fs::file_size(file, failed);
    Fingerprint content;
    if (failed || !content.addFile(file)) throw Error(file.string(), "cannot be read", "check its permissions");
    return {frame, bytes, content.text()};
}

FrameRecord::FrameRecord(const AnimationOutput& output) : path_(output.recordFile()) {
    if (path_.empty()) return;
    std::error_code ignored;
    fs::create_directories(path_.parent_path(), ignored);
    file_ = FileDescriptor(open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0644));
    if (!file_) {
        const int cause = errno;
        if (!output.isVideo()) return;
        throw Error(path_.string(), "cannot be made (" + std::string(std::strerror(cause)) + ")",
                    "check the folder's permissions and the disk's space, or choose another place");
    }
    if (flock(file_.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        throw Error(output.path().string(), "is being drawn by another voledit", "wait for it, or stop it first");
    read();
}

void FrameRecord::read() {
    std::ifstream in(path_, std::ios::binary);
    std::string line;
    while (std::getline(in, line)) {
        // The last line may be cut: its frame is drawn again.
        const json j = json::parse(line, nullptr, false);
        try {
            if (!known_) {
                if (j.value("voledit-frames", 0) != kVersion) return;
                settings_ = settingsOf(j);
                known_ = true;
            } else {
                const FinishedFrame frame = frameOf(j);
                frames_[frame.frame] = frame;
            }
        } catch (const json::exception&) {
            if (!known_) return;
        }
    }
}

std::string FrameRecord::mismatch(const FrameSettings& settings) const {
    if (!known_) return {};
    if (settings_.scene != settings.scene) return "the scene or one of its files changed";
    if (settings_.size != settings.size) return "--size is another";
    if (settings_.fps != settings.fps) return "the frame rate is another";
    if (settings_.camera != settings.camera) return "the camera changed";
    return settings_ == settings ? "" : "the renderer, the step or the supersampling is another";
}

bool FrameRecord::holds(int frame, const fs::path& file) const {
    const auto found = frames_.find(frame);
    std::error_code failed;
    if (found == frames_.end() || fs::file_size(file, failed) != found->second.bytes || failed) return false;
    Fingerprint content;
    return content.addFile(file) && content.text() == found->second.fingerprint;
}

void FrameRecord::begin(const FrameSettings& settings, bool keep) {
    // A line break ends a line that was cut when the disk was full or the power went.
    if (keep && known_) return write("");
    if (!keep) frames_.clear();
    settings_ = settings;
    known_ = true;
    if (!file_) return;
    if (ftruncate(file_.get(), 0) != 0)
        throw Error(path_.string(), "cannot be written (" + std::string(std::strerror(errno)) + ")",
                    "check the disk's space");
    write(toJson(settings).dump());
}

void FrameRecord::add(const FinishedFrame& frame) {
    frames_[frame.frame] = frame;
    write(json{{"frame", frame.frame}, {"bytes", frame.bytes}, {"fingerprint", frame.fingerprint}}.dump());
}

void FrameRecord::write(const std::string& line) {
    if (!file_) return;
    const std::string text = line + "\n";
    const ssize_t written = ::write(file_.get(), text.data(), text.size());
    if (written != ssize_t(text.size()))
        throw Error(path_.string(),
                    "cannot be written (" + std::string(std::strerror(written < 0 ? errno : ENOSPC)) + ")",
                    "free space on the disk");
}

}  // namespace voledit
