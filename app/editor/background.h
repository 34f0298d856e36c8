#pragma once
// Long work beside the window: rigging, fitting, reading motions.

#include <functional>
#include <memory>
#include <string>

#include "core/base/progress.h"

namespace voledit {

/// One piece of work at a time in a thread of its own. It must not touch what the window's thread changes: it takes
/// copies, and gives back what is to be done with its result, which `poll` does in the window's thread.
class Background {
public:
    using Finish = std::function<void()>;
    using Work = std::function<Finish(Progress&)>;

    Background();
    /// Cancels what goes on and waits for it.
    ~Background();
    Background(const Background&) = delete;
    Background& operator=(const Background&) = delete;

    /// Starts `work`; what went on is cancelled and forgotten. `title` says what it is: "Auto-rig".
    void start(std::string title, Work work);
    /// True from start() until poll() has finished it.
    bool running() const { return job_ != nullptr; }
    const std::string& title() const;
    double fraction() const;  // 0…1
    /// Asks it to stop; poll() tells when it has.
    void cancel();
    /// Blocks until the work is done, or nothing is running.
    void wait();

    enum class Ended : unsigned char { No, Done, Cancelled };
    /// Does what is to be done with a result that is there. Throws what the work threw (Cancelled apart).
    Ended poll();

private:
    struct Job;
    std::unique_ptr<Job> job_;
};

}  // namespace voledit
