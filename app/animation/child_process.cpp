#include "app/animation/child_process.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <utility>

#include "core/base/error.h"
#include "core/base/spawn_settings.h"

namespace voledit {

namespace {

struct Pipe {
    FileDescriptor read, write;
};

Pipe makePipe() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
        throw Error("a pipe cannot be made (" + std::string(std::strerror(errno)) + "); close other programs");
    return {FileDescriptor(ends[0]), FileDescriptor(ends[1])};
}

std::vector<char*> pointersTo(std::vector<std::string>& words) {
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    return pointers;
}

/// This program's environment with `changes` in place of what they name.
std::vector<std::string> environmentWith(const std::vector<std::string>& changes) {
    std::vector<std::string> all = changes;
    for (char** variable = environ; *variable; ++variable) {
        const std::string text = *variable;
        const std::string name = text.substr(0, text.find('=') + 1);
        bool changed = false;
        for (const std::string& change : changes) changed = changed || change.starts_with(name);
        if (!changed) all.push_back(text);
    }
    return all;
}

}  // namespace

ChildProcess::ChildProcess(const Settings& settings) {
    Pipe in = makePipe(), out = makePipe();
    if (settings.keepErrors) errors_ = FileDescriptor(memfd_create("voledit-errors", MFD_CLOEXEC));
    SpawnSettings spawn;
    spawn.pass(in.read.get(), STDIN_FILENO);
    spawn.pass(out.write.get(), STDOUT_FILENO);
    if (errors_.get() >= 0) spawn.pass(errors_.get(), STDERR_FILENO);
    std::vector<std::string> command = settings.command, environment = environmentWith(settings.environment);
    const int failed = posix_spawnp(&pid_, command.front().c_str(), spawn.actions(), spawn.attributes(),
                                    pointersTo(command).data(), pointersTo(environment).data());
    if (failed) {
        ended_ = true;
        throw Error(command.front(), "cannot be started (" + std::string(std::strerror(failed)) + ")",
                    "check that it is installed, and that there is memory for it");
    }
    input_ = std::move(in.write);
    output_ = std::move(out.read);
    fcntl(output_.get(), F_SETFL, O_NONBLOCK);
}

ChildProcess::~ChildProcess() {
    if (ended_) return;
    kill(pid_, SIGKILL);
    reap(true);
}

bool ChildProcess::write(const std::string& text) {
    std::size_t at = 0;
    while (at < text.size()) {
        const ssize_t n = ::write(input_.get(), text.data() + at, text.size() - at);
        if (n < 0 && errno != EINTR) return false;
        if (n > 0) at += std::size_t(n);
    }
    return true;
}

std::optional<std::string> ChildProcess::readLine() {
    for (;;) {
        if (const auto end = pending_.find('\n'); end != std::string::npos) {
            std::string line = pending_.substr(0, end);
            pending_.erase(0, end + 1);
            return line;
        }
        std::array<char, 4096> chunk;
        const ssize_t n = outputEnded_ ? 0 : read(output_.get(), chunk.data(), chunk.size());
        if (n > 0) {
            pending_.append(chunk.data(), std::size_t(n));
        } else if (n == 0 || (errno != EINTR && errno != EAGAIN)) {
            outputEnded_ = true;
            return std::nullopt;
        } else if (errno == EAGAIN) {
            return std::nullopt;
        }
    }
}

std::string ChildProcess::errors() const {
    if (!errors_) return {};
    std::array<char, 4096> tail;
    const off_t size = lseek(errors_.get(), 0, SEEK_END);
    const off_t from = size > off_t(tail.size()) ? size - off_t(tail.size()) : 0;
    const ssize_t n = pread(errors_.get(), tail.data(), tail.size(), from);
    return n > 0 ? std::string(tail.data(), std::size_t(n)) : std::string();
}

void ChildProcess::signal(int number) {
    if (!ended()) kill(pid_, number);
}

bool ChildProcess::reap(bool wait) {
    if (ended_) return true;
    pid_t done;
    do done = waitpid(pid_, &status_, wait ? 0 : WNOHANG);
    while (done < 0 && errno == EINTR);
    ended_ = done != 0;
    return ended_;
}

bool ChildProcess::ended() {
    return reap(false);
}

int ChildProcess::wait() {
    reap(true);
    return WIFSIGNALED(status_) ? 128 + WTERMSIG(status_) : WEXITSTATUS(status_);
}

std::string ChildProcess::causeOfDeath() const {
    if (!WIFSIGNALED(status_)) return "exit status " + std::to_string(WEXITSTATUS(status_));
    return "signal " + std::to_string(WTERMSIG(status_)) + " (" + strsignal(WTERMSIG(status_)) + ")";
}

bool programIsInstalled(const std::string& name) {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path ? path : "/usr/bin:/bin");
    for (std::string folder; std::getline(folders, folder, ':');) {
        const auto file = std::filesystem::path(folder.empty() ? "." : folder) / name;
        std::error_code failed;
        if (std::filesystem::is_regular_file(file, failed) && access(file.c_str(), X_OK) == 0) return true;
    }
    return false;
}

}  // namespace voledit
