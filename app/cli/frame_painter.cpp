#include "app/cli/frame_painter.h"

#include "core/base/error.h"

namespace voledit {

FramePainter::FramePainter(IoClient& io, OpenedScene opened, const PictureArguments& arguments, double fps,
                           std::function<void(const std::string&)> warn)
    : io_(io),
      opened_(std::move(opened)),
      size_(arguments.pixels()),
      supersample_(arguments.supersample),
      fps_(fps),
      warn_(std::move(warn)),
      drawing_(arguments.drawing()) {}

FinishedFrame FramePainter::paint(int frame, const std::filesystem::path& file, Progress* progress) {
    try {
        compiled_ = compile(opened_.scene, opened_.assets, frame / fps_, compiledBefore_ ? &compiled_ : nullptr,
                            double(size_.x) / size_.y);
        compiledBefore_ = true;
    } catch (const Error& error) {
        throw Error("frame " + std::to_string(frame) + ": " + error.what());
    }
    for (const std::string& warning : compiled_.warnings)
        if (warned_.insert(warning).second) warn_(warning);
    io_.writePicture(drawStill(*drawing_, compiled_, size_, supersample_, progress), file,
                     compiled_.render.transparent);
    return finishedFrame(frame, file);
}

}  // namespace voledit
