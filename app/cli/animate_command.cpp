// `voledit animate`: a scene to a video or to numbered pictures.

#include <sys/prctl.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <optional>
#include <set>

#include "app/animation/animation_files.h"
#include "app/animation/fingerprint.h"
#include "app/animation/video_encoder.h"
#include "app/animation/whole_picture.h"
#include "app/animation/worker_pool.h"
#include "app/cli/commands.h"
#include "app/cli/frame_painter.h"
#include "app/cli/output.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/io/reduced_volumes.h"

namespace voledit {

namespace fs = std::filesystem;

namespace {

struct AnimateArguments {
    InputArguments input;
    PictureArguments picture;
    std::string output, frames;
    std::optional<double> fps;
    int crf = -1, workers = 0;
    bool resume = false;
    bool worker = false;  // draws the frames that its standard input names
    bool report = false;  // progress as lines on standard output, for the editor
};

AnimationOutput outputOf(const AnimateArguments& a) {
    try {
        return AnimationOutput(a.output);
    } catch (const std::invalid_argument& error) {
        throw UsageError(std::string("-o ") + error.what());
    }
}

void checkArguments(const AnimateArguments& a, AnimationKind kind) {
    a.picture.check();
    if (a.fps && !(*a.fps >= 0.01 && *a.fps <= 1000)) throw UsageError("--fps: give a number from 0.01 to 1000");
    const int worst = kind == AnimationKind::Mp4 ? 51 : kind == AnimationKind::Webm ? 63 : -1;
    if (a.crf != -1 && worst < 0) throw UsageError("--crf is for .mp4 and .webm");
    if (a.crf < -1 || a.crf > std::max(worst, -1))
        throw UsageError("--crf: give a number from 0 (best) to " + std::to_string(worst));
    if (a.workers < 0 || a.workers > 256) throw UsageError("--workers: give a number from 1 to 256");
}

double rateOf(const AnimateArguments& a, AnimationKind kind, const Scene& scene) {
    const double fps = a.fps.value_or(scene.timeline.fps);
    // The format counts in hundredths of a second, and viewers slow down what is faster.
    if (kind == AnimationKind::Gif && fps > 50)
        throw Error(a.output, "a .gif shows at most 50 frames a second", "give --fps 50 or less");
    return fps;
}

FrameRange rangeOf(const AnimateArguments& a, const Scene& scene, double fps) {
    if (a.frames.empty()) return framesOf(scene.timeline, fps);
    try {
        return parseFrameRange(a.frames);
    } catch (const Error& error) {
        throw UsageError(std::string("--") + error.what());
    }
}

FrameSettings settingsOf(const AnimateArguments& a, const OpenedScene& opened, double fps) {
    FrameSettings settings;
    settings.scene = fingerprintOf(opened);
    if (!a.picture.camera.empty()) {
        Fingerprint camera;
        camera.addFile(a.picture.camera);
        settings.camera = camera.text();
    }
    settings.renderer = a.picture.renderer;
    settings.size = a.picture.pixels();
    settings.fps = fps;
    settings.step = std::isnan(a.picture.step) ? -1 : a.picture.step;
    settings.supersample = a.picture.supersample;
    return settings;
}

// ---- Progress -----------------------------------------------------------------------------------------------------

/// Says how far drawing is where no bar does.
class FrameLines {
public:
    FrameLines(const AnimateArguments& a, const CommonArguments& common, int kept, int total)
        : report_(a.report),
          lines_(!a.report && common.verbosity() != Verbosity::Quiet && !isatty(STDERR_FILENO)),
          kept_(kept),
          done_(kept),
          total_(total) {}

    void finished(int frame, Progress* progress) {
        ++done_;
        const double fraction = double(done_ - kept_) / (total_ - kept_);
        if (progress) progress->set(fraction);
        const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
        if (report_) {
            std::printf("frame %d %d %.1f\n", done_, total_, seconds / fraction * (1 - fraction));
            std::fflush(stdout);
        }
        if (!lines_ || (seconds < next_ && done_ < total_)) return;
        next_ = seconds + 5;
        std::fprintf(stderr, "voledit: frame %d, %d of %d%s\n", frame, done_, total_,
                     timeLeft(seconds, fraction).c_str());
    }
    int done() const { return done_; }
    int total() const { return total_; }

private:
    using Clock = std::chrono::steady_clock;
    bool report_, lines_;
    int kept_, done_, total_;
    Clock::time_point start_ = Clock::now();
    double next_ = 5;
};

// ---- Drawing ------------------------------------------------------------------------------------------------------

/// Words by which this program starts itself as a worker; values are joined to their flags, so that none is taken for
/// a flag.
std::vector<std::string> workerCommand(const AnimateArguments& a, const CommonArguments& common, double fps,
                                       int threads) {
    std::array<char, 32> rate{};
    std::to_chars(rate.data(), rate.data() + rate.size(), fps);
    std::vector<std::string> words{"/proc/self/exe",
                                   "animate",
                                   "--worker",
                                   "--output=" + a.output,
                                   "--size=" + a.picture.size,
                                   "--gl=" + a.picture.gl,
                                   "--fps=" + std::string(rate.data()),
                                   "--supersample=" + std::to_string(a.picture.supersample),
                                   "--threads=" + std::to_string(threads)};
    const auto add = [&](const std::string& flag, const std::string& value) {
        if (!value.empty()) words.push_back(flag + "=" + value);
    };
    add("--renderer", a.picture.renderer);
    add("--camera", a.picture.camera);
    add("--raw", a.input.raw);
    add("--spacing", a.input.spacing);
    add("--memory-limit", common.memoryLimit);
    if (!std::isnan(a.picture.step)) {
        std::array<char, 32> step{};
        std::to_chars(step.data(), step.data() + step.size(), a.picture.step);
        add("--step", step.data());
    }
    if (a.input.allowOutside) words.push_back("--allow-outside");
    words.insert(words.end(), {"--", a.input.file});
    return words;
}

/// A worker: draws the frames that it reads the numbers of, until there are no more.
int work(const AnimateArguments& a, const AnimationOutput& output) {
    // Whoever asked for the frames is gone: nobody wants them any more.
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    const auto say = [](const std::string& line) {
        std::cout << line << std::flush;
        if (!std::cout) _exit(1);
    };
    try {
        IoClient io;
        OpenedScene opened = openFile(io, a.input.file, a.input.options());
        a.picture.applyTo(opened.scene);
        if (output.isVideo()) opened.scene.render.transparent = false;  // videos keep no alpha
        FramePainter painter(io, std::move(opened), a.picture, a.fps.value(),
                             [&](const std::string& text) { say(WorkerWords::warning(text)); });
        for (int frame = 0; std::cin >> frame;)
            say(WorkerWords::done(painter.paint(frame, output.frameFile(frame), nullptr)));
        return 0;
    } catch (const std::bad_alloc&) {
        say(WorkerWords::failed("out of memory; draw with --workers 1, or close other programs"));
    } catch (const std::exception& error) {
        say(WorkerWords::failed(error.what()));
    }
    return 1;
}

/// Drawing is threaded already, and each worker holds the scene: what more of them gain stands in README.md.
constexpr int kUsualWorkers = 1;

/// Draws `frames` and records each as it is finished.
void drawFrames(const AnimateArguments& a, const CommonArguments& common, double fps, const std::vector<int>& frames,
                FrameRecord& record, FrameLines& lines) {
    const int workers = a.workers > 0 ? a.workers : kUsualWorkers;
    const int threads = std::max(1, threadCount() / workers);
    const WorkerPool pool{.command = workerCommand(a, common, fps, threads),
                          .environment = {"LP_NUM_THREADS=" + std::to_string(threads)},
                          .count = workers};
    std::set<std::string> warned;
    const auto warn = [&](const std::string& warning) {
        if (warned.insert(warning).second) printWarnings({warning});
    };
    withProgress("Drawing", common.verbosity(), [&](Progress* progress) {
        const auto finished = [&](const FinishedFrame& frame) {
            record.add(frame);
            lines.finished(frame.frame, progress);
        };
        drawByWorkers(pool, frames, finished, warn, progress);
    });
}

/// The frames that are still to be drawn; those of an earlier run are kept where --resume says so and they show the
/// same.
std::vector<int> framesToDraw(const AnimateArguments& a, const AnimationOutput& output, const FrameRange& range,
                              const FrameSettings& settings, FrameRecord& record) {
    const std::string mismatch = a.resume ? record.mismatch(settings) : "";
    if (!mismatch.empty()) printWarnings({mismatch + " since the earlier run: all frames are drawn anew"});
    const bool known = record.known(), keep = a.resume && mismatch.empty();
    // Without a record (it is not among the cached files here) whole pictures of the right size are what was asked for.
    const bool trust = keep && !known && !output.isVideo();
    record.begin(settings, keep && known);
    std::vector<int> missing;
    for (int n = range.first; n <= range.last; ++n) {
        const fs::path file = output.frameFile(n);
        if (trust && isWholePicture(file, settings.size))
            record.add(finishedFrame(n, file));
        else if (!keep || !record.holds(n, file))
            missing.push_back(n);
    }
    const int kept = range.count() - int(missing.size());
    if (trust && kept > 0)
        printWarnings({std::to_string(kept) + " frames were there already and are kept; nothing tells what scene they "
                                              "show (without --resume they are drawn anew)"});
    return missing;
}

/// The scene read, and what follows from it. The files themselves are let go: workers read them.
struct Plan {
    double fps;
    FrameRange range;
    FrameSettings settings;
};

Plan planOf(const AnimateArguments& a, const CommonArguments& common, AnimationKind kind) {
    IoClient io;
    const OpenedScene opened = open(io, a.input, common);
    if (!a.picture.camera.empty()) readCamera(a.picture.camera);
    const double fps = rateOf(a, kind, opened.scene);
    return {fps, rangeOf(a, opened.scene, fps), settingsOf(a, opened, fps)};
}

void encodeVideo(const VideoEncoder& encoder, const CommonArguments& common, const AnimationOutput& output,
                 const FrameRange& range, bool report) {
    if (report) {
        std::puts("encoding");
        std::fflush(stdout);
    }
    std::vector<fs::path> files;
    for (int n = range.first; n <= range.last; ++n) files.push_back(output.frameFile(n));
    withProgress("Encoding " + output.path().filename().string(), common.verbosity(),
                 [&](Progress* progress) { encoder.encode(files, output.frameFolder(), output.path(), progress); });
}

int animate(const AnimateArguments& a, const CommonArguments& common) {
    setMayReduceVolumes(true);
    const AnimationOutput output = outputOf(a);
    checkArguments(a, output.kind());
    if (a.worker) return work(a, output);
    if (!a.frames.empty()) rangeOf(a, {}, 1);  // a wrong flag before anything is read
    checkWritable(output.path());
    const Plan plan = planOf(a, common, output.kind());
    std::optional<VideoEncoder> encoder;
    if (output.isVideo()) encoder.emplace(output.kind(), VideoSettings{plan.settings.size, plan.fps, a.crf});

    makeFrameFolder(output);
    FrameRecord record(output);
    removeLeftovers(output);
    const std::vector<int> frames = framesToDraw(a, output, plan.range, plan.settings, record);
    FrameLines lines(a, common, plan.range.count() - int(frames.size()), plan.range.count());
    try {
        if (!frames.empty()) drawFrames(a, common, plan.fps, frames, record, lines);
        if (encoder) encodeVideo(*encoder, common, output, plan.range, a.report);
    } catch (const std::exception& error) {
        if (lines.done() == 0) removeFrames(output);
        const bool stopped = dynamic_cast<const Cancelled*>(&error);
        if (!stopped) std::fprintf(stderr, "voledit: %s\n", error.what());
        std::fprintf(stderr, "voledit: %s%d of %d frames are finished%s\n", stopped ? "stopped; " : "", lines.done(),
                     lines.total(), lines.done() > 0 ? ": the same command with --resume goes on" : "");
        return 1;
    }
    if (encoder) removeFrames(output);
    return 0;
}

}  // namespace

Command addAnimateCommand(CLI::App& command, const CommonArguments& common) {
    auto a = std::make_shared<AnimateArguments>();
    addInputArguments(command, a->input, "scene");
    command.add_option("-o,--output", a->output, "Video (.mp4, .webm, .gif) or pictures (frame-%04d.png or .exr)")
        ->required()
        ->type_name("OUT");
    command
        .add_option("--frames", a->frames, "Numbers of the first and the last frame, both drawn (the whole timeline)")
        ->type_name("A-B");
    command
        .add_option("--fps", a->fps,
                    "Frames a second, played and drawn: frame n shows the scene at n/F seconds (the timeline's)")
        ->type_name("F");
    command.add_flag("--resume", a->resume, "Keep the finished frames of a run that was stopped");
    addPictureArguments(command, a->picture);
    command.add_option("--crf", a->crf, "Quality of the video, 0 is best (.mp4 18, .webm 30)")->type_name("N");
    command.add_option("--workers", a->workers, "Processes that draw")->type_name("N");
    command.add_flag("--worker", a->worker)->group("");
    command.add_flag("--report", a->report)->group("");
    return [a, &common] { return animate(*a, common); };
}

}  // namespace voledit
