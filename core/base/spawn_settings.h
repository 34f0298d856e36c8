#pragma once
// What a program that is started finds: its open files, its signals.

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>

namespace voledit {

/// Settings for posix_spawn, released with this: a process group of its own, all signals unblocked and as they are by
/// default. File actions are done in the order of the calls.
class SpawnSettings {
public:
    SpawnSettings() {
        posix_spawn_file_actions_init(&actions_);
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

    /// Our open file `ours` is number `theirs` in the program.
    void pass(int ours, int theirs) { posix_spawn_file_actions_adddup2(&actions_, ours, theirs); }
    /// Number `theirs` reads nothing, or what is written to it is dropped.
    void passNothing(int theirs, int openFlags) {
        posix_spawn_file_actions_addopen(&actions_, theirs, "/dev/null", openFlags, 0);
    }

    const posix_spawn_file_actions_t* actions() const { return &actions_; }
    const posix_spawnattr_t* attributes() const { return &attributes_; }

private:
    posix_spawn_file_actions_t actions_;
    posix_spawnattr_t attributes_;
};

}  // namespace voledit
