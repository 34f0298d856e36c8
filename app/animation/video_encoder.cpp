#include "app/animation/video_encoder.h"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <csignal>
#include <fstream>
#include <functional>
#include <iterator>

#include "app/animation/child_process.h"
#include "core/base/error.h"

namespace voledit {

namespace fs = std::filesystem;

namespace {

using Words = std::vector<std::string>;

void append(Words& words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
}

/// The shortest text that reads back as the same number.
std::string textOf(double number) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, number).ptr};
}

/// A name that ffmpeg takes as a file whatever stands in it.
std::string fileName(const fs::path& path) {
    return "file:" + path.string();
}

/// Deterministic: a fixed number of threads (the encoders' results depend on it), no dates, no versions.
Words ffmpeg() {
    return {"ffmpeg", "-nostdin", "-y", "-v", "error", "-threads", "2", "-filter_threads", "1"};
}

Words framesFromPipe(double fps) {
    return {"-f", "image2pipe", "-c:v", "png", "-framerate", textOf(fps), "-i", "pipe:0"};
}

std::string evenSize(Index2 size) {
    if (size.x % 2 == 0 && size.y % 2 == 0) return "";
    const std::string right = std::to_string(size.x % 2), bottom = std::to_string(size.y % 2);
    return "pad=iw+" + right + ":ih+" + bottom + ":0:0,fillborders=right=" + right + ":bottom=" + bottom +
           ":mode=smear,";
}

Words yuvVideo(const VideoSettings& settings, const Words& encoder) {
    // Colours as television and browsers take them (BT.709, limited range), said in the file too.
    Words words{"-vf", evenSize(settings.size) + "scale=out_color_matrix=bt709:out_range=tv,format=yuv420p"};
    append(words, encoder);
    append(words, {"-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "iec61966-2-1", "-color_range",
                   "tv", "-threads", "4"});
    return words;
}

std::string firstLine(const std::string& text) {
    return text.substr(0, text.find('\n'));
}

/// The last lines tell the cause; x264 and libvpx say "Error initializing" after it, so the first is shown.
std::string causeOf(ChildProcess& child) {
    const int status = child.wait();
    const std::string errors = child.errors();
    if (errors.find("No space left") != std::string::npos) return "no space left on the disk";
    if (status == 128 + SIGXFSZ) return "the file is larger than this process may write";
    return errors.empty() ? child.causeOfDeath() : firstLine(errors);
}

std::string bytesOf(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(in)), {});
    if (bytes.empty()) throw Error(path.string(), "cannot be read", "draw the animation again with --resume");
    return bytes;
}

/// Pipes the frames into `command` and waits for its end. Throws Error naming `target`.
void pipeFrames(const Words& command, const std::vector<fs::path>& frames, const std::string& target,
                const std::function<void(std::size_t)>& onFrame) {
    ChildProcess child({.command = command, .environment = {}, .keepErrors = true});
    bool reads = true;
    for (std::size_t i = 0; reads && i < frames.size(); ++i) {
        onFrame(i);
        reads = child.write(bytesOf(frames[i]));
    }
    child.closeInput();
    while (!child.ended()) {
        onFrame(frames.size());
        usleep(5000);
    }
    if (!reads || child.wait() != 0)
        throw Error(target, "ffmpeg could not encode it (" + causeOf(child) + ")",
                    "the frames are kept: once mended, --resume encodes them");
}

/// The index stands in front of an .mp4, so that it can be played while it is fetched.
Words container(AnimationKind kind) {
    if (kind == AnimationKind::Gif) return {"-f", "gif"};
    if (kind == AnimationKind::Webm) return {"-f", "webm"};
    return {"-movflags", "+faststart", "-f", "mp4"};
}

}  // namespace

std::vector<std::string> VideoEncoder::encoding() const {
    const auto crf = [&](int usual) { return std::to_string(settings_.crf < 0 ? usual : settings_.crf); };
    Words words;
    if (kind_ == AnimationKind::Gif)
        words = {"-lavfi", "[0:v][1:v]paletteuse=dither=sierra2_4a", "-c:v", "gif"};
    else if (kind_ == AnimationKind::Webm)
        words = yuvVideo(settings_,
                         {"-c:v", "libvpx-vp9", "-b:v", "0", "-crf", crf(30), "-deadline", "good", "-cpu-used", "3"});
    else
        words = yuvVideo(settings_, {"-c:v", "libx264", "-preset", "medium", "-crf", crf(18)});
    append(words, {"-map_metadata", "-1", "-fflags", "+bitexact", "-flags:v", "+bitexact"});
    return words;
}

VideoEncoder::VideoEncoder(AnimationKind kind, const VideoSettings& settings) : kind_(kind), settings_(settings) {
    const std::string what = kind == AnimationKind::Mp4 ? ".mp4" : kind == AnimationKind::Webm ? ".webm" : ".gif";
    if (!programIsInstalled("ffmpeg"))
        throw Error("ffmpeg", "is not installed, and it makes " + what + " files",
                    "install the package ffmpeg, or write pictures: -o frame-%04d.png");
    Words words = ffmpeg();
    const std::string size = std::to_string(settings.size.x) + "x" + std::to_string(settings.size.y);
    append(words,
           {"-f", "lavfi", "-i", "color=black:size=" + size + ":rate=" + textOf(settings.fps) + ",format=rgb24"});
    if (kind == AnimationKind::Gif) append(words, {"-f", "lavfi", "-i", "color=black:size=16x16,format=rgb24"});
    append(words, encoding());
    append(words, {"-frames:v", "1", "-f", "null", "pipe:1"});
    ChildProcess child({.command = words, .environment = {}, .keepErrors = true});
    child.closeInput();
    if (child.wait() != 0)
        throw Error("ffmpeg", "cannot make " + what + " files of this size (" + causeOf(child) + ")",
                    "install Debian's ffmpeg, choose another --size, or write pictures: -o frame-%04d.png");
}

void VideoEncoder::encode(const std::vector<fs::path>& frames, const fs::path& folder, const fs::path& target,
                          Progress* progress) const {
    const double passes = kind_ == AnimationKind::Gif ? 2 : 1;
    double pass = 0;
    const auto onFrame = [&](std::size_t i) {
        report(progress, (pass + 0.99 * double(i) / double(frames.size())) / passes);
    };
    const fs::path palette = folder / "palette.png", made = folder / ("video" + target.extension().string());
    // Two passes rather than one filter graph, which would hold all frames in memory until the palette is known.
    if (kind_ == AnimationKind::Gif) {
        Words words = ffmpeg();
        append(words, framesFromPipe(settings_.fps));
        append(words, {"-vf", "palettegen", "-frames:v", "1", "-update", "1", "-f", "image2", fileName(palette)});
        pipeFrames(words, frames, target.string(), onFrame);
        pass = 1;
    }
    std::error_code failed;
    try {
        Words words = ffmpeg();
        append(words, framesFromPipe(settings_.fps));
        if (kind_ == AnimationKind::Gif) append(words, {"-i", fileName(palette)});
        append(words, encoding());
        append(words, container(kind_));
        words.push_back(fileName(made));
        pipeFrames(words, frames, target.string(), onFrame);
        fs::rename(made, target, failed);
        if (failed)
            throw Error(target.string(), "cannot be put in place (" + failed.message() + ")",
                        "check that nothing else uses the name");
    } catch (...) {
        fs::remove(made, failed);
        throw;
    }
}

}  // namespace voledit
