#pragma once
// Draws single frames of a scene to files.

#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <string>

#include "app/animation/frame_record.h"
#include "app/cli/picture_arguments.h"
#include "app/opening/open_file.h"

namespace voledit {

/// A scene and what it takes to draw it at any time. A frame's pixels do not depend on the frames drawn before, so
/// that any process may draw any of them.
class FramePainter {
public:
    /// `opened` has the arguments' camera and step in it; frame n is at n / fps seconds; `warn` is given each warning
    /// once. `io` outlives it. Throws Error where the context cannot be made.
    FramePainter(IoClient& io, OpenedScene opened, const PictureArguments& arguments, double fps,
                 std::function<void(const std::string&)> warn);

    /// Draws frame n and writes it beside `file`, then renames. Throws Error, Cancelled.
    FinishedFrame paint(int frame, const std::filesystem::path& file, Progress* progress);

private:
    IoClient& io_;
    OpenedScene opened_;
    Index2 size_;
    int supersample_;
    double fps_;
    std::function<void(const std::string&)> warn_;
    std::set<std::string> warned_;
    std::unique_ptr<Drawing> drawing_;
    CompiledScene compiled_;  // of the frame before: what did not change is taken from it
    bool compiledBefore_ = false;
};

}  // namespace voledit
