#pragma once
// Another program that works for this one: started, spoken to through pipes, stopped.

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

#include "core/io/channel.h"

namespace voledit {

/// A running program in a process group of its own, so that Ctrl-C reaches only us, who then decide. Killed and reaped
/// on destruction.
class ChildProcess {
public:
    struct Settings {
        std::vector<std::string> command;      // program (found in PATH where it has no slash) and arguments
        std::vector<std::string> environment;  // "NAME=value", added to this program's own
        bool keepErrors = false;               // its standard error is kept for `errors()`, else it is this program's
    };
    /// Starts it with a pipe for each of its standard input and output. Throws Error where it cannot be run.
    explicit ChildProcess(const Settings& settings);
    ~ChildProcess();
    ChildProcess(ChildProcess&&) = delete;
    ChildProcess& operator=(ChildProcess&&) = delete;

    /// Writes all of `text` to its input; false where it no longer reads. Waits while the pipe is full.
    bool write(const std::string& text);
    /// Its input ends here.
    void closeInput() { input_.reset(); }
    /// What `poll` waits on to learn that there is output.
    int output() const { return output_.get(); }
    /// The next whole line of output that is there already; nullopt where there is none yet.
    std::optional<std::string> readLine();
    /// True once its output has ended and every line of it was read.
    bool outputEnded() const { return outputEnded_ && pending_.find('\n') == std::string::npos; }
    /// What it has written to standard error so far, at most the last 4 KiB (`keepErrors`).
    std::string errors() const;

    void signal(int number);
    /// True once it has ended.
    bool ended();
    /// Waits for its end. Its exit status, or 128 + the signal that killed it.
    int wait();
    /// "exit status 3" or "signal 9 (Killed)"; after its end.
    std::string causeOfDeath() const;

private:
    bool reap(bool wait);

    FileDescriptor input_, output_, errors_;
    std::string pending_;  // output without its end of line yet
    bool outputEnded_ = false;
    pid_t pid_ = -1;
    int status_ = 0;
    bool ended_ = false;
};

/// True if PATH has an executable of this name.
bool programIsInstalled(const std::string& name);

}  // namespace voledit
