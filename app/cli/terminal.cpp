#include "app/cli/terminal.h"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <thread>

namespace voledit {

namespace {

volatile std::sig_atomic_t interrupted = 0;
void onInterrupt(int) {
    // A second Ctrl-C ends the program at once.
    if (interrupted) _exit(1);
    interrupted = 1;
}

void draw(const std::string& what, double fraction) {
    constexpr int kWidth = 30;
    const int filled = static_cast<int>(fraction * kWidth);
    std::fprintf(stderr, "\r%s [", what.c_str());
    for (int i = 0; i < kWidth; ++i) std::fputc(i < filled ? '#' : '.', stderr);
    std::fprintf(stderr, "] %3d %%", static_cast<int>(fraction * 100));
    std::fflush(stderr);
}

}  // namespace

void withProgress(const std::string& what, Verbosity verbosity, const std::function<void(Progress*)>& work) {
    const bool bar = verbosity != Verbosity::Quiet && isatty(STDERR_FILENO);
    const auto start = std::chrono::steady_clock::now();
    Progress progress;
    std::atomic<bool> done{false};
    interrupted = 0;
    struct sigaction action {
    }, before{};
    action.sa_handler = onInterrupt;
    sigaction(SIGINT, &action, &before);
    std::thread watcher([&] {
        bool drawn = false;
        for (int tick = 0; !done; ++tick) {
            if (interrupted) progress.cancel();
            if (bar && tick >= 25 && tick % 5 == 0) draw(what, progress.fraction()), drawn = true;
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
        if (drawn) std::fprintf(stderr, "\r%*s\r", 60 + static_cast<int>(what.size()), "");
    });
    const auto finish = [&] {
        done = true;
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
        std::fprintf(stderr, "voledit: %s: %.0f ms\n", what.c_str(),
                     std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
}

void printWarnings(const std::vector<std::string>& warnings) {
    for (const std::string& w : warnings) std::fprintf(stderr, "voledit: warning: %s\n", w.c_str());
}

}  // namespace voledit
