#pragma once
// Opening files in the background, so that the window stays live.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/opening/open_file.h"

namespace voledit {

/// Opens one file at a time in a thread of its own; asked once a frame whether it is done.
class Loader {
public:
    /// `io` outlives the loader.
    explicit Loader(IoClient& io);
    /// Cancels what is loading and waits for it.
    ~Loader();
    Loader(const Loader&) = delete;
    Loader& operator=(const Loader&) = delete;

    /// What became of a file: either `opened` or the message of what failed.
    struct Result {
        std::filesystem::path path;
        std::optional<OpenedScene> opened;
        std::string problem;
        bool outside = false;  // a scene that names files outside its folder: it can be opened if the user allows it
        bool cancelled = false;
    };

    /// Starts opening `path`; what was loading is cancelled and forgotten.
    void start(const std::filesystem::path& path, const OpenOptions& options);
    /// True from start() until take() has given the result.
    bool running() const { return job_ != nullptr; }
    /// The file being opened, and 0…1 of it.
    std::filesystem::path path() const;
    double fraction() const;
    /// Asks it to stop; take() tells when it has.
    void cancel();
    /// The result, once; nullopt while there is none.
    std::optional<Result> take();
    /// Blocks until take() has a result, or nothing is running.
    void wait();

private:
    struct Job;
    IoClient& io_;
    std::unique_ptr<Job> job_;
};

}  // namespace voledit
