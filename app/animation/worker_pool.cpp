#include "app/animation/worker_pool.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <memory>
#include <sstream>

#include "app/animation/child_process.h"
#include "core/base/error.h"

namespace voledit {

namespace {

constexpr int kPollMilliseconds = 20;
constexpr int kPatienceMilliseconds = 2000;  // for a worker to put away what it writes

std::string oneLine(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

class Pool {
public:
    Pool(const WorkerPool& settings, const std::vector<int>& frames) : frames_(frames) {
        const auto count = std::min(frames.size(), std::size_t(settings.count));
        for (std::size_t i = 0; i < count; ++i) {
            workers_.push_back(std::make_unique<Worker>(settings));
            giveNext(*workers_.back());
        }
    }
    ~Pool() {
        // A worker that writes finishes that or removes it; one that draws ends at once.
        for (const auto& worker : workers_) worker->process.signal(SIGTERM);
        for (int waited = 0; waited < kPatienceMilliseconds && !allEnded(); waited += 5) usleep(5000);
    }
    Pool(const Pool&) = delete;
    Pool& operator=(const Pool&) = delete;

    void waitForOutput() const {
        std::vector<pollfd> waiting;
        for (const auto& worker : workers_)
            if (!worker->process.outputEnded()) waiting.push_back({worker->process.output(), POLLIN, 0});
        poll(waiting.data(), nfds_t(waiting.size()), kPollMilliseconds);
    }

    void readAll(const std::function<void(const FinishedFrame&)>& onFrame,
                 const std::function<void(const std::string&)>& onWarning) {
        for (const auto& worker : workers_) {
            while (const auto line = worker->process.readLine()) {
                std::istringstream words(*line);
                std::string word, rest;
                words >> word;
                if (word == "done") {
                    FinishedFrame frame;
                    words >> frame.frame >> frame.bytes >> frame.fingerprint;
                    onFrame(frame);
                    ++done_;
                    giveNext(*worker);
                    continue;
                }
                std::getline(words >> std::ws, rest);
                if (word == "failed") throw Error(rest);
                if (word == "warning") onWarning(rest);
            }
            if (worker->draws && worker->process.outputEnded()) throwDeath(*worker);
        }
    }

    bool finished() const { return done_ == frames_.size(); }

private:
    struct Worker {
        explicit Worker(const WorkerPool& settings)
            : process({.command = settings.command, .environment = settings.environment}) {}
        ChildProcess process;
        bool draws = false;  // has a frame to finish
    };

    void giveNext(Worker& worker) {
        worker.draws = next_ < frames_.size();
        if (worker.draws)
            worker.process.write(std::to_string(frames_[next_++]) + "\n");
        else
            worker.process.closeInput();
    }

    static void throwDeath(Worker& worker) {
        worker.process.wait();
        throw Error("a process that draws frames died, by " + worker.process.causeOfDeath() +
                    "; it may have run out of memory: draw with --workers 1, and go on with --resume");
    }

    bool allEnded() const {
        return std::all_of(workers_.begin(), workers_.end(),
                           [](const auto& worker) { return worker->process.ended(); });
    }

    const std::vector<int>& frames_;
    std::vector<std::unique_ptr<Worker>> workers_;
    std::size_t next_ = 0, done_ = 0;
};

}  // namespace

std::string WorkerWords::done(const FinishedFrame& frame) {
    return "done " + std::to_string(frame.frame) + " " + std::to_string(frame.bytes) + " " + frame.fingerprint + "\n";
}

std::string WorkerWords::warning(const std::string& message) {
    return "warning " + oneLine(message) + "\n";
}

std::string WorkerWords::failed(const std::string& message) {
    return "failed " + oneLine(message) + "\n";
}

void drawByWorkers(const WorkerPool& settings, const std::vector<int>& frames,
                   const std::function<void(const FinishedFrame&)>& onFrame,
                   const std::function<void(const std::string&)>& onWarning, Progress* progress) {
    Pool pool(settings, frames);
    while (!pool.finished()) {
        report(progress, progress ? progress->fraction() : 0);
        pool.waitForOutput();
        pool.readAll(onFrame, onWarning);
    }
}

}  // namespace voledit
