#include "app/editor/loader.h"

#include <atomic>
#include <new>
#include <thread>

#include "core/base/error.h"

namespace voledit {

struct Loader::Job {
    Progress progress;
    Result result;
    std::atomic<bool> done{false};
    std::thread thread;

    ~Job() {
        progress.cancel();
        if (thread.joinable()) thread.join();
    }

    void run(IoClient& io, const OpenOptions& options) {
        try {
            result.opened = openFile(io, result.path, options, &progress);
        } catch (const Cancelled&) {
            result.cancelled = true;
        } catch (const OutsideFolderError& error) {
            result.problem = error.what();
            result.outside = true;
        } catch (const std::bad_alloc&) {
            result.problem =
                result.path.string() + ": not enough memory; close other programs, or open a smaller volume";
        } catch (const std::exception& error) {
            result.problem = error.what();
        }
        done = true;
        done.notify_all();
    }
};

Loader::Loader(IoClient& io) : io_(io) {}
Loader::~Loader() = default;

void Loader::start(const std::filesystem::path& path, const OpenOptions& options) {
    job_ = std::make_unique<Job>();
    job_->result.path = path;
    job_->thread = std::thread([job = job_.get(), this, options] { job->run(io_, options); });
}

std::filesystem::path Loader::path() const {
    return job_ ? job_->result.path : std::filesystem::path();
}

double Loader::fraction() const {
    return job_ ? job_->progress.fraction() : 1;
}

void Loader::cancel() {
    if (job_) job_->progress.cancel();
}

std::optional<Loader::Result> Loader::take() {
    if (!job_ || !job_->done) return std::nullopt;
    job_->thread.join();
    Result result = std::move(job_->result);
    // A cancel that came too late is still what the user wants.
    if (job_->progress.cancelled()) {
        result.cancelled = true;
        result.opened.reset();
    }
    job_.reset();
    return result;
}

void Loader::wait() {
    if (job_) job_->done.wait(false);
}

}  // namespace voledit
