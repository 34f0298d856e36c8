#include "app/cli/terminal.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <mutex>
#include <thread>

namespace voledit {

namespace {

volatile std::sig_atomic_t interrupted = 0;
void onInterrupt(int) {
    // A second Ctrl-C ends the program at once.
    if (interrupted) _exit(1);
    interrupted = 1;
}

void draw(const std::string& what, double fraction, double seconds) {
    constexpr int kWidth = 30;
    const int filled = static_cast<int>(fraction * kWidth);
    std::fprintf(stderr, "\r%s [", what.c_str());
    for (int i = 0; i < kWidth; ++i) std::fputc(i < filled ? '#' : '.', stderr);
    std::fprintf(stderr, "] %3d %%%-24s", static_cast<int>(fraction * 100), timeLeft(seconds, fraction).c_str());
    std::fflush(stderr);
}

double secondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

void withProgress(const std::string& what, Verbosity verbosity, const std::function<void(Progress*)>& work,
                  bool report) {
    const bool bar = verbosity != Verbosity::Quiet && isatty(STDERR_FILENO);
    const auto start = std::chrono::steady_clock::now();
    Progress progress;
    std::mutex mutex;
    std::condition_variable wake;
    bool done = false;
    interrupted = 0;
    struct sigaction action {
    }, before{};
    action.sa_handler = onInterrupt;
    sigaction(SIGINT, &action, &before);
    std::thread watcher([&] {
        bool drawn = false;
        std::unique_lock lock(mutex);
        for (int tick = 0; !done; ++tick) {
            if (interrupted) progress.cancel();
            if (bar && tick >= 25 && tick % 5 == 0) draw(what, progress.fraction(), secondsSince(start)), drawn = true;
            if (report && tick % 10 == 0) std::printf("progress %.3f\n", progress.fraction()), std::fflush(stdout);
            wake.wait_for(lock, std::chrono::milliseconds(20), [&] { return done; });
        }
        if (drawn) std::fprintf(stderr, "\r%*s\r", 70 + static_cast<int>(what.size()), "");
    });
    const auto finish = [&] {
        {
            const std::scoped_lock lock(mutex);
            done = true;
        }
        wake.notify_one();
        watcher.join();
        sigaction(SIGINT, &before, nullptr);
    };
    try {
        work(&progress);
    } catch (...) {
        finish();
        throw;
    }
    finish();
    if (verbosity == Verbosity::Verbose)
        std::fprintf(stderr, "voledit: %s: %.0f ms\n", what.c_str(), secondsSince(start) * 1000);
}

std::string timeLeft(double seconds, double fraction) {
    if (seconds < 2 || fraction < 0.01 || fraction >= 1) return "";
    const long left = std::lround(seconds / fraction * (1 - fraction));
    if (left < 90) return ", about " + std::to_string(std::max(left, 1L)) + " s left";
    if (left < 90 * 60) return ", about " + std::to_string((left + 30) / 60) + " min left";
    return ", about " + std::to_string((left + 1800) / 3600) + " h left";
}

void printWarnings(const std::vector<std::string>& warnings) {
    for (const std::string& w : warnings) std::fprintf(stderr, "voledit: warning: %s\n", w.c_str());
}

}  // namespace voledit
