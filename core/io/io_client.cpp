#include "core/io/io_client.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <glm/matrix.hpp>
#include <mutex>

#include "core/base/error.h"
#include "core/base/paths.h"
#include "core/io/bvh.h"
#include "core/io/memory_file.h"
#include "core/io/output_folder.h"
#include "core/io/parser_process.h"
#include "core/io/protocol.h"
#include "core/io/reduced_volumes.h"

namespace voledit {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

namespace {

constexpr int kPollMilliseconds = 20;  // how soon a cancelled call returns
constexpr double kBytesPerSecond = 20e6;

fs::path defaultProgram() {
    if (const char* set = std::getenv("VOLEDIT_IO")) return set;
    return programFolder() / "voledit-io";
}

std::size_t threeQuartersOfMemory() {
    return std::size_t(sysconf(_SC_PHYS_PAGES)) * std::size_t(sysconf(_SC_PAGESIZE)) / 4 * 3;
}

std::atomic<std::size_t> limitOfProcess{0};

/// Watches that the parser gets on: throws where it used up the patience since the last progress.
class Watchdog {
public:
    Watchdog(const ParserProcess& process, IoPatience patience, const std::string& shownPath)
        : process_(process), patience_(patience), shownPath_(shownPath) {
        progressed();
    }
    void progressed() {
        since_ = Clock::now();
        processorSince_ = process_.processorSeconds();
    }
    void check() const {
        const double wall = std::chrono::duration<double>(Clock::now() - since_).count();
        const double processor = process_.processorSeconds() - processorSince_;
        if (wall <= patience_.wallSeconds && processor <= patience_.processorSeconds) return;
        throw Error(shownPath_, "reading or writing it did not get on for " + std::to_string(int(wall)) + " seconds",
                    "the file is probably damaged; save it anew with the program that made it");
    }

private:
    const ParserProcess& process_;
    IoPatience patience_;
    const std::string& shownPath_;
    Clock::time_point since_;
    double processorSince_ = 0;
};

/// The size of a reply's volume in bytes, having checked all that a broken parser could get wrong.
std::size_t checkedBytes(const IoReply& reply) {
    const VolumeGrid& g = reply.grid;
    std::size_t bytes = byteSize(reply.type);
    // Of a histogram there is all or nothing: then it is counted when someone asks.
    bool good = reply.statistics.histogram.size() == 256 || reply.statistics.histogram.empty();
    for (const int n : {g.size.x, g.size.y, g.size.z, g.channels})
        good = good && n >= 1 && !__builtin_mul_overflow(bytes, std::size_t(std::max(n, 1)), &bytes);
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) good = good && std::isfinite(g.worldFromIndex[c][r]);
    if (!good || glm::determinant(Mat3(g.worldFromIndex)) == 0)
        throw Error("voledit-io returned a volume that cannot be");
    return bytes;
}

/// `bytes` in a new memory file. Throws Error, Cancelled.
FileDescriptor memoryFileOf(std::span<const std::byte> bytes, Progress* progress) {
    FileDescriptor file = makeMemoryFile(bytes.size());
    constexpr std::size_t chunk = 16 << 20;
    for (std::size_t at = 0; at < bytes.size();) {
        report(progress, 0.2 * double(at) / double(bytes.size()));
        const ssize_t n = pwrite(file.get(), bytes.data() + at, std::min(chunk, bytes.size() - at), off_t(at));
        if (n < 0 && errno != EINTR) throw Error("no memory for the voxels: " + std::string(std::strerror(errno)));
        if (n > 0) at += std::size_t(n);
    }
    seal(file.get());
    return file;
}

}  // namespace

void setMemoryLimit(std::size_t bytes) {
    limitOfProcess = bytes;
}

std::size_t memoryLimit() {
    const std::size_t limit = limitOfProcess;
    return limit > 0 ? limit : threeQuartersOfMemory();
}

namespace {
std::atomic<bool> reducedOfProcess{false};
}

void setMayReduceVolumes(bool may) {
    reducedOfProcess = may;
}

bool mayReduceVolumes() {
    return reducedOfProcess;
}

struct IoClient::Process {
    struct Answer {
        IoReply reply;
        FileDescriptor file;
    };

    fs::path program;
    IoPatience patience;
    std::timed_mutex mutex;
    std::unique_ptr<ParserProcess> running;
    std::atomic<int> id{0};

    /// Sends the request and waits for the last reply; `from` is the progress at which the parser's begins. The parser
    /// is killed where the wait ends in any other way.
    Answer ask(IoRequest request, int file, Progress* progress, double from = 0) {
        const auto lock = waitForTurn(progress);
        if (request.memoryLimit == 0) request.memoryLimit = threeQuartersOfMemory();
        try {
            start();
            if (!sendPacket(running->socket(), pack(request), file)) throw Error(lastWords(request));
            return wait(request, progress, from);
        } catch (...) {
            stop();
            throw;
        }
    }

private:
    std::unique_lock<std::timed_mutex> waitForTurn(Progress* progress) {
        std::unique_lock lock(mutex, std::defer_lock);
        while (!lock.try_lock_for(std::chrono::milliseconds(kPollMilliseconds)))
            if (progress && progress->cancelled()) throw Cancelled();
        return lock;
    }

    void start() {
        if (running && running->alive()) return;
        running = std::make_unique<ParserProcess>(program);
        id = running->id();
    }

    void stop() {
        running.reset();
        id = 0;
    }

    IoPatience patienceFor(const IoRequest& request) const {
        std::error_code failed;
        const auto bytes = fs::is_regular_file(request.path, failed) ? fs::file_size(request.path, failed) : 0;
        const double values = double(request.grid.valueCount() * byteSize(request.type));
        const double more = ((failed ? 0.0 : double(bytes)) + values) / kBytesPerSecond;
        return {patience.processorSeconds + more, patience.wallSeconds + more};
    }

    Answer wait(const IoRequest& request, Progress* progress, double from) {
        Watchdog watchdog(*running, patienceFor(request), request.shownPath);
        double best = -1;
        for (;;) {
            report(progress, std::max(best, from));
            auto packet = receivePacket(running->socket(), kPollMilliseconds);
            watchdog.check();
            if (!packet) continue;
            if (packet->bytes.empty()) throw Error(lastWords(request));
            IoReply reply = unpackReply(packet->bytes);
            if (reply.kind != IoReply::Kind::Progress) return {std::move(reply), std::move(packet->file)};
            // Only getting further counts as getting on.
            const double fraction = from + (1 - from) * std::clamp(reply.fraction, 0.0, 1.0);
            if (fraction > best) watchdog.progressed();
            best = std::max(best, fraction);
        }
    }

    /// What to tell of a parser that died over `request`.
    std::string lastWords(const IoRequest& request) {
        const bool writes = request.task == IoTask::WriteVolume || request.task == IoTask::WritePicture;
        return request.shownPath + ": voledit-io died " + (writes ? "writing" : "reading") + " it, by " +
               running->causeOfDeath() +
               (writes ? "; nothing was written, choose another format or free memory"
                       : "; the file is damaged, or needs more memory than there is: save it anew with the program "
                         "that made it, or raise --memory-limit");
    }
};

IoClient::IoClient(fs::path program, IoPatience patience) : process_(std::make_unique<Process>()) {
    process_->program = program.empty() ? defaultProgram() : std::move(program);
    process_->patience = patience;
}

IoClient::~IoClient() = default;

int IoClient::processId() const {
    return process_->id;
}

namespace {

IoRequest requestFor(IoTask task, const fs::path& path, const fs::path& shown) {
    IoRequest request;
    request.task = task;
    request.path = fs::absolute(path).string();
    request.shownPath = shown.string();
    return request;
}

void throwIfFailed(const IoReply& reply, IoReply::Kind expected) {
    if (reply.kind == IoReply::Kind::Failed) throw Error(reply.message);
    if (reply.kind != expected) throw Error("voledit-io answered something else than was asked");
}

}  // namespace

namespace {

std::string lowerEnding(const fs::path& path) {
    std::string ending = path.extension().string();
    for (char& c : ending) c = char(std::tolower(static_cast<unsigned char>(c)));
    return ending;
}

}  // namespace

bool isMotionFile(const fs::path& path) {
    const std::string ending = lowerEnding(path);
    constexpr std::array endings{".bvh", ".gltf", ".glb", ".fbx", ".dae"};
    return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

MotionFile IoClient::readMotion(const fs::path& path, Progress* progress) {
    MotionFile file;
    file.format = "bvh";
    report(progress, 0);
    if (!isMotionFile(path) || lowerEnding(path) == ".bvh") {
        file.motion = std::make_shared<const Motion>(readBvh(path, &file.warnings));
    } else {
        IoRequest request = requestFor(IoTask::ReadMotion, path, path);
        request.memoryLimit = memoryLimit();
        auto [reply, memory] = process_->ask(std::move(request), -1, progress);
        throwIfFailed(reply, IoReply::Kind::Motion);
        if (reply.textBytes > BvhLimits::fileBytes) throw Error("voledit-io returned a motion that cannot be");
        const auto [bytes, owner] = mapSealed(memory.get(), std::max<std::size_t>(std::size_t(reply.textBytes), 1));
        const std::string_view text(reinterpret_cast<const char*>(bytes.data()), std::size_t(reply.textBytes));
        file.format = reply.format;
        file.warnings = std::move(reply.notes);
        file.motion = std::make_shared<const Motion>(parseBvh(text, path.string(), &file.warnings));
    }
    report(progress, 1);
    return file;
}

VolumeFile IoClient::readVolume(const fs::path& path, const ReadOptions& options, Progress* progress) {
    auto file = readVolumeOrMesh(path, options, progress);
    if (std::holds_alternative<MeshFile>(file))
        throw Error(path.string(), "holds a mesh, where a volume of voxels is needed",
                    "give a volume, or make one of the mesh: voledit voxelize");
    return std::get<VolumeFile>(std::move(file));
}

std::variant<VolumeFile, MeshFile> IoClient::readVolumeOrMesh(const fs::path& path, const ReadOptions& options,
                                                              Progress* progress) {
    if (path.empty()) throw Error("", "no file is named", "name a volume file or a folder of slices");
    IoRequest request = requestFor(IoTask::ReadVolume, path, path);
    request.raw = options.raw;
    request.spacing = options.spacing;
    request.memoryLimit = options.memoryLimit > 0 ? options.memoryLimit : memoryLimit();
    request.mayReduce = mayReduceVolumes();
    auto [reply, file] = process_->ask(std::move(request), -1, progress);
    if (reply.kind == IoReply::Kind::Mesh) {
        const auto [bytes, owner] = mapSealed(file.get(), std::max<std::size_t>(byteSize(reply.mesh), 1));
        report(progress, 1);
        return MeshFile{readMesh(reply.mesh, bytes), reply.format, reply.storedType, std::move(reply.statistics),
                        std::move(reply.notes)};
    }
    throwIfFailed(reply, IoReply::Kind::Volume);
    auto [voxels, owner] = mapSealed(file.get(), checkedBytes(reply));
    auto volume =
        std::make_shared<const Volume>(reply.grid, reply.type, voxels, std::move(owner), std::move(reply.statistics));
    report(progress, 1);
    return VolumeFile{std::move(volume), reply.format, reply.storedType, std::move(reply.notes)};
}

void IoClient::writeVolume(const Volume& volume, const fs::path& path, Progress* progress) {
    const OutputFolder folder(path);
    IoRequest request = requestFor(IoTask::WriteVolume, folder.file(), path);
    request.grid = volume.grid();
    request.type = volume.type();
    const FileDescriptor voxels = memoryFileOf(volume.voxels(), progress);
    const auto answer = process_->ask(std::move(request), voxels.get(), progress, 0.2);
    throwIfFailed(answer.reply, IoReply::Kind::Written);
    folder.publish(answer.reply.notes);
}

void IoClient::writePicture(const Picture& picture, const fs::path& path, bool transparent) {
    if (picture.pixels.empty()) throw Error(path.string(), "the picture is empty", "draw it first");
    const OutputFolder folder(path);
    IoRequest request = requestFor(IoTask::WritePicture, folder.file(), path);
    request.pictureSize = picture.size;
    request.transparent = transparent;
    const FileDescriptor pixels = memoryFileOf(std::as_bytes(std::span(picture.pixels)), nullptr);
    const auto answer = process_->ask(std::move(request), pixels.get(), nullptr);
    throwIfFailed(answer.reply, IoReply::Kind::Written);
    folder.publish(answer.reply.notes);
}

Picture IoClient::readPicture(const fs::path& path) {
    const auto answer = process_->ask(requestFor(IoTask::ReadPicture, path, path), -1, nullptr);
    throwIfFailed(answer.reply, IoReply::Kind::Picture);
    const Index2 size = answer.reply.pictureSize;
    if (size.x < 1 || size.y < 1 || size.x > (1 << 20) || size.y > (1 << 20))
        throw Error("voledit-io returned a picture that cannot be");
    Picture picture(size);
    const auto [bytes, owner] = mapSealed(answer.file.get(), picture.pixels.size() * sizeof(Vec4f));
    std::memcpy(picture.pixels.data(), bytes.data(), bytes.size());
    return picture;
}

}  // namespace voledit
