#include "app/editor/background.h"

#include <atomic>
#include <exception>
#include <thread>
#include <utility>

#include "core/base/error.h"

namespace voledit {

struct Background::Job {
    std::string title;
    Progress progress;
    Finish finish;
    std::exception_ptr problem;
    bool cancelled = false;
    std::atomic<bool> done{false};
    std::thread thread;

    ~Job() {
        progress.cancel();
        if (thread.joinable()) thread.join();
    }

    void run(const Work& work) {
        try {
            finish = work(progress);
        } catch (const Cancelled&) {
            cancelled = true;
        } catch (...) {
            problem = std::current_exception();
        }
        done = true;
        done.notify_all();
    }
};

Background::Background() = default;
Background::~Background() = default;

void Background::start(std::string title, Work work) {
    job_ = std::make_unique<Job>();
    job_->title = std::move(title);
    job_->thread = std::thread([job = job_.get(), work = std::move(work)] { job->run(work); });
}

const std::string& Background::title() const {
    static const std::string none;
    return job_ ? job_->title : none;
}

double Background::fraction() const {
    return job_ ? job_->progress.fraction() : 1;
}

void Background::cancel() {
    if (job_) job_->progress.cancel();
}

void Background::wait() {
    if (job_) job_->done.wait(false);
}

Background::Ended Background::poll() {
    if (!job_ || !job_->done) return Ended::No;
    const std::unique_ptr<Job> job = std::move(job_);
    job->thread.join();
    // A cancel that came too late is still what the user wants.
    if (job->cancelled || job->progress.cancelled()) return Ended::Cancelled;
    if (job->problem) std::rethrow_exception(job->problem);
    if (job->finish) job->finish();
    return Ended::Done;
}

}  // namespace voledit
