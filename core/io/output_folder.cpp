#include "core/io/output_folder.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <mutex>

#include "core/base/error.h"

namespace voledit {

namespace fs = std::filesystem;

namespace {

// A signal that would end the program waits while any output folder is there, so that none stays behind. Signals that
// somebody handles (a command that can be cancelled) are left to them.
struct Deferred {
    int signal;
    volatile std::sig_atomic_t arrived = 0;
    bool deferring = false;
};
std::array<Deferred, 2> deferred{{{SIGINT}, {SIGTERM}}};
std::mutex deferredMutex;
int outputFolders = 0;

void note(int signal) {
    for (Deferred& d : deferred)
        if (d.signal == signal) d.arrived = 1;
}

void deferSignals() {
    const std::lock_guard lock(deferredMutex);
    if (outputFolders++ > 0) return;
    for (Deferred& d : deferred) {
        struct sigaction now {};
        sigaction(d.signal, nullptr, &now);
        d.arrived = 0;
        d.deferring = now.sa_handler == SIG_DFL;
        now.sa_handler = note;
        if (d.deferring) sigaction(d.signal, &now, nullptr);
    }
}

void deliverSignals() {
    const std::lock_guard lock(deferredMutex);
    if (--outputFolders > 0) return;
    for (Deferred& d : deferred) {
        if (!d.deferring) continue;
        std::signal(d.signal, SIG_DFL);
        if (d.arrived) std::raise(d.signal);
    }
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& target) : target_(fs::absolute(target)) {
    std::error_code failed;
    if (fs::is_symlink(target_, failed)) target_ = fs::weakly_canonical(target_, failed);
    if (!target_.has_filename()) throw Error(target.string(), "names a folder", "name a file to write");
    const fs::file_status there = fs::status(target_, failed);
    if (fs::exists(there) && !fs::is_regular_file(there))
        throw Error(target.string(), "is there already and is no ordinary file", "choose another name");
    std::string name = (target_.parent_path() / ".voledit-XXXXXX").string();
    deferSignals();
    if (!mkdtemp(name.data())) {
        const int cause = errno;
        deliverSignals();
        throw Error(target.string(), "cannot write in its folder (" + std::string(std::strerror(cause)) + ")",
                    "make the folder, or choose one that you may write to");
    }
    folder_ = name;
}

OutputFolder::~OutputFolder() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
    deliverSignals();
}

void OutputFolder::publish(const std::vector<std::string>& names) const {
    for (const std::string& name : names) {
        // A name is the parser's word: it must not lead elsewhere.
        if (fs::path(name).filename() != fs::path(name) || name == "." || name == "..")
            throw Error("voledit-io wrote a file of an impossible name, " + name);
        std::error_code failed;
        fs::rename(folder_ / name, target_.parent_path() / name, failed);
        if (failed)
            throw Error((target_.parent_path() / name).string(), "cannot be put in place (" + failed.message() + ")",
                        "check that nothing else uses the name");
    }
}

}  // namespace voledit
