#include "core/io/parser_process.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <thread>

#include "core/base/error.h"
#include "core/base/spawn_settings.h"

namespace voledit {

namespace {

constexpr int kSocketInChild = 3;

/// The child starts with its socket and silent standard streams: a library's chatter must not reach our standard
/// output, which carries results. VOLEDIT_IO_STDERR lets its errors through.
void pass(SpawnSettings& settings, int socket) {
    settings.pass(socket, kSocketInChild);
    settings.passNothing(STDIN_FILENO, O_RDONLY);
    settings.passNothing(STDOUT_FILENO, O_WRONLY);
    if (!std::getenv("VOLEDIT_IO_STDERR")) settings.passNothing(STDERR_FILENO, O_WRONLY);
}

}  // namespace

ParserProcess::ParserProcess(const std::filesystem::path& program) {
    auto [ours, theirs] = makeChannel();
    SpawnSettings settings;
    pass(settings, theirs.get());
    std::string name = program.string(), parent = std::to_string(getpid());
    char* arguments[] = {name.data(), parent.data(), nullptr};
    const int failed = posix_spawn(&pid_, name.c_str(), settings.actions(), settings.attributes(), arguments, environ);
    if (failed) {
        pid_ = -1;
        throw Error(name, "cannot be started (" + std::string(std::strerror(failed)) + ")",
                    "install voledit-io beside voledit, or set VOLEDIT_IO to its place");
    }
    socket_ = std::move(ours);
}

ParserProcess::~ParserProcess() {
    if (ended_) return;
    kill(pid_, SIGKILL);
    reap(true);
}

bool ParserProcess::reap(bool wait) {
    if (ended_) return true;
    pid_t done;
    do done = waitpid(pid_, &status_, wait ? 0 : WNOHANG);
    while (done < 0 && errno == EINTR);
    ended_ = done != 0;
    return ended_;
}

bool ParserProcess::alive() {
    return !reap(false);
}

double ParserProcess::processorSeconds() const {
    clockid_t clock;
    timespec time{};
    if (ended_ || clock_getcpuclockid(pid_, &clock) != 0 || clock_gettime(clock, &time) != 0) return 0;
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

std::string ParserProcess::causeOfDeath() {
    using namespace std::chrono_literals;
    for (int i = 0; i < 200 && !reap(false); ++i) std::this_thread::sleep_for(5ms);
    if (!ended_) {  // it closed its socket but lives on
        kill(pid_, SIGKILL);
        reap(true);
    }
    if (WIFSIGNALED(status_)) {
        const int number = WTERMSIG(status_);
        return "signal " + std::to_string(number) + " (" + strsignal(number) + ")";
    }
    return "exit status " + std::to_string(WEXITSTATUS(status_));
}

}  // namespace voledit
