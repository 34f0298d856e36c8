#pragma once
// One running voledit-io: started, watched, killed.

#include <sys/types.h>

#include <filesystem>
#include <string>

#include "core/io/channel.h"

namespace voledit {

/// A child process that serves one socket. It is killed and reaped on destruction.
class ParserProcess {
public:
    /// Starts `program`. Throws Error where that cannot be run.
    explicit ParserProcess(const std::filesystem::path& program);
    ~ParserProcess();
    ParserProcess(const ParserProcess&) = delete;
    ParserProcess& operator=(const ParserProcess&) = delete;

    int socket() const { return socket_.get(); }
    pid_t id() const { return pid_; }
    /// False once it has ended.
    bool alive();
    /// Processor time that it has used, seconds, all threads.
    double processorSeconds() const;
    /// Waits for a process that has closed its socket and says what ended it: "signal 11 (Segmentation fault)".
    std::string causeOfDeath();

private:
    bool reap(bool wait);

    FileDescriptor socket_;
    pid_t pid_ = -1;
    int status_ = 0;
    bool ended_ = false;
};

}  // namespace voledit
