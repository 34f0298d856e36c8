#include "core/io/parser_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <ctime>
#include <thread>

#include "core/base/error.h"

namespace voledit {

namespace {

constexpr int kSocketInChild = 3;

/// What the child starts with: its socket, silent standard streams (a library's chatter must not reach our standard
/// output), default signals, and a process group of its own so that Ctrl-C reaches only us, who then decide.
class SpawnSettings {
public:
    explicit SpawnSettings(int socket) {
        posix_spawn_file_actions_init(&actions_);
        posix_spawn_file_actions_adddup2(&actions_, socket, kSocketInChild);
        posix_spawn_file_actions_addopen(&actions_, 0, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_addopen(&actions_, 1, "/dev/null", O_WRONLY, 0);
        if (!std::getenv("VOLEDIT_IO_STDERR")) posix_spawn_file_actions_addopen(&actions_, 2, "/dev/null", O_WRONLY, 0);
        posix_spawnattr_init(&attributes_);
        sigset_t none, all;
        sigemptyset(&none);
        sigfillset(&all);
        posix_spawnattr_setsigmask(&attributes_, &none);
        posix_spawnattr_setsigdefault(&attributes_, &all);
        posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    }
    ~SpawnSettings() {
        posix_spawn_file_actions_destroy(&actions_);
        posix_spawnattr_destroy(&attributes_);
    }
    SpawnSettings(const SpawnSettings&) = delete;
    SpawnSettings& operator=(const SpawnSettings&) = delete;

    const posix_spawn_file_actions_t* actions() const { return &actions_; }
    const posix_spawnattr_t* attributes() const { return &attributes_; }

private:
    posix_spawn_file_actions_t actions_;
    posix_spawnattr_t attributes_;
};

}  // namespace

ParserProcess::ParserProcess(const std::filesystem::path& program) {
    auto [ours, theirs] = makeChannel();
    const SpawnSettings settings(theirs.get());
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
