#include "app/io/session.h"

#include <chrono>
#include <cstring>
#include <mutex>
#include <new>

#include "app/io/checks.h"
#include "app/io/copy_file.h"
#include "app/io/header_text.h"
#include "app/io/limits.h"
#include "app/io/module_loader.h"
#include "app/io/modules/motions.h"
#include "app/io/modules/pictures.h"
#include "app/io/png_file.h"
#include "app/io/read_volume.h"
#include "app/io/stored_volume.h"
#include "app/io/writers.h"
#include "core/base/error.h"
#include "core/fields/statistics.h"
#include "core/io/bvh.h"
#include "core/io/memory_file.h"
#include "core/io/protocol.h"

namespace voledit {

namespace {

using Clock = std::chrono::steady_clock;

/// Tells the client how far we are, at most every 20 ms.
class ProgressReporter {
public:
    explicit ProgressReporter(int client) : client_(client) {}

    /// From any thread; one that finds another telling need not.
    void operator()(double fraction) {
        const std::unique_lock turn(mutex_, std::try_to_lock);
        if (!turn) return;
        const auto now = Clock::now();
        if (now - last_ < std::chrono::milliseconds(20)) return;
        last_ = now;
        IoReply reply;
        reply.fraction = fraction;
        sendPacket(client_, pack(reply), -1, Send::DropIfFull);
    }

private:
    int client_;
    Clock::time_point last_;
    std::mutex mutex_;
};

/// Receives a volume or mesh into a memory file.
class MemorySink final : public VolumeSink {
public:
    MemorySink(ProgressReporter& reporter, const IoRequest& request)
        : reporter_(reporter), limit_(request.memoryLimit), mayReduce_(request.mayReduce) {}

    std::span<std::byte> allocate(const std::string& where, const VolumeHeader& header) override {
        header_ = header;
        const VolumeGrid& g = header.grid;
        const std::uint64_t bytes =
            checkProduct(where, {std::uint64_t(g.size.x), std::uint64_t(g.size.y), std::uint64_t(g.size.z),
                                 std::uint64_t(g.channels), byteSize(header.type)});
        return makeFile(where, bytes);
    }
    void take(const std::string& where, MeshData mesh, const std::string& storedType) override {
        mesh_ = countsOf(mesh);
        header_.format = "vtk";
        header_.storedType = storedType;
        header_.grid.channels = mesh.channels;
        statistics_ = statisticsOf(VoxelType::Float, std::as_bytes(std::span(mesh.values)), mesh.channels);
        writeMesh(mesh, makeFile(where, byteSize(*mesh_)));
    }
    void checkMemory(const std::string& where, std::uint64_t bytes) const override {
        if (bytes > limit_)
            throw Error(where, "needs " + readableBytes(bytes) + ", more than the limit of " + readableBytes(limit_),
                        "raise --memory-limit, or reduce the volume");
    }
    void rescale(double slope, double intercept) override {
        slope_ = slope;
        intercept_ = intercept;
    }
    std::uint64_t memoryLimit() const override { return limit_; }
    bool mayReduce() const override { return mayReduce_; }
    bool copy(const InputFile& file, std::uint64_t offset, std::span<std::byte> out, double from, double to) override {
        const std::ptrdiff_t at = out.data() - mapping_.bytes.data();
        if (mapping_.bytes.empty() || at < 0 || std::size_t(at) + out.size() > mapping_.bytes.size()) return false;
        const MemoryLimitLifted lifted;  // the file's own pages, a few at a time
        return copyToMemory(file, offset, out.size(), file_.get(), std::uint64_t(at),
                            [&](double fraction) { progress(from + (to - from) * fraction); });
    }
    void progress(double fraction) override { reporter_(0.9 * fraction); }
    void warn(const std::string& message) override { warnings_.push_back(message); }

    /// The reply and the sealed file.
    std::pair<IoReply, FileDescriptor> finish() {
        if (slope_ != 1 || intercept_ != 0) applyRescale();
        IoReply reply;
        reply.kind = mesh_ ? IoReply::Kind::Mesh : IoReply::Kind::Volume;
        reply.mesh = mesh_.value_or(MeshCounts());
        reply.grid = header_.grid;
        reply.type = header_.type;
        reply.format = header_.format;
        reply.storedType = header_.storedType;
        reply.notes = std::move(warnings_);
        reporter_(0.9);
        const MemoryLimitLifted lifted;  // threads have stacks
        reply.statistics =
            mesh_ ? std::move(statistics_) : extremesOf(header_.type, mapping_.bytes, header_.grid.channels);
        mapping_ = {};
        seal(file_.get());
        return {std::move(reply), std::move(file_)};
    }

private:
    std::span<std::byte> makeFile(const std::string& where, std::uint64_t bytes) {
        checkMemory(where, bytes);
        file_ = makeMemoryFile(bytes);
        const MemoryLimitLifted lifted;  // the bytes have been held against the limit
        mapping_ = mapForWriting(file_.get(), bytes);
        return mapping_.bytes;
    }

    void applyRescale() {
        StoredVolume stored;
        stored.type = StoredType(header_.type);
        std::array<std::uint64_t, 3> size;
        for (int a = 0; a < 3; ++a) size[std::size_t(a)] = std::uint64_t(header_.grid.size[a]);
        stored.setInterleaved(size, std::uint64_t(header_.grid.channels), 1);
        stored.slope = slope_;
        stored.intercept = intercept_;
        const FileDescriptor file = std::move(file_);
        const MappedBytes values = std::move(mapping_);
        header_.type = loadedType(stored, values.bytes);
        convert(stored, values.bytes, header_.type, allocate("the rescaled volume", VolumeHeader(header_)));
    }

    ProgressReporter& reporter_;
    std::uint64_t limit_;
    bool mayReduce_;
    VolumeHeader header_;
    std::optional<MeshCounts> mesh_;
    VolumeStatistics statistics_;  // of a mesh
    FileDescriptor file_;
    MappedBytes mapping_;
    std::vector<std::string> warnings_;
    double slope_ = 1, intercept_ = 0;
};

using Answer = std::pair<IoReply, FileDescriptor>;

Answer readVolume(const IoRequest& request, ProgressReporter& reporter) {
    MemorySink sink(reporter, request);
    readAnyVolume(request, sink);
    return sink.finish();
}

Answer writeVolume(const IoRequest& request, const FileDescriptor& file, ProgressReporter& reporter) {
    const std::size_t bytes = request.grid.valueCount() * byteSize(request.type);
    const auto [voxels, owner] = mapSealed(file.get(), bytes);
    VolumeOutput output{request.grid, request.type, voxels, {request.path, request.shownPath}, [&](double fraction) {
                            reporter(fraction);
                        }};
    IoReply reply;
    reply.kind = IoReply::Kind::Written;
    reply.notes = writeAnyVolume(output);
    return {std::move(reply), FileDescriptor()};
}

Answer readPicture(const IoRequest& request) {
    const Source source{request.path, request.shownPath};
    if (InputFile(source).size() == 0) throw Error(source.name, "is empty", "copy or download the file anew");
    Picture picture;
    if (InputFile(source).start(4) == "\x89PNG")
        picture = readPng(source);
    else
        moduleFunction<decltype(voleditReadPicture)>("voledit-io-pictures.so", "voleditReadPicture")(source, picture);
    const auto pixels = std::as_bytes(std::span(picture.pixels));
    FileDescriptor file = makeMemoryFile(pixels.size());
    std::memcpy(mapForWriting(file.get(), pixels.size()).bytes.data(), pixels.data(), pixels.size());
    seal(file.get());
    IoReply reply;
    reply.kind = IoReply::Kind::Picture;
    reply.pictureSize = picture.size;
    return {std::move(reply), std::move(file)};
}

Answer readMotion(const IoRequest& request) {
    const Source source{request.path, request.shownPath};
    const std::uint64_t bytes = InputFile(source).size();
    if (bytes == 0) throw Error(source.name, "is empty", "copy or download the file anew");
    limitParsing(bytes);
    StoredMotion stored;
    moduleFunction<decltype(voleditReadMotion)>("voledit-io-motions.so", "voleditReadMotion")(source, stored);
    const std::string text = bvhText(stored.motion);
    FileDescriptor file = makeMemoryFile(text.size());
    std::memcpy(mapForWriting(file.get(), text.size()).bytes.data(), text.data(), text.size());
    seal(file.get());
    IoReply reply;
    reply.kind = IoReply::Kind::Motion;
    reply.format = stored.format;
    reply.notes = std::move(stored.warnings);
    reply.textBytes = text.size();
    return {std::move(reply), std::move(file)};
}

Answer writePicture(const IoRequest& request, const FileDescriptor& file) {
    Picture picture(request.pictureSize);
    const auto [pixels, owner] = mapSealed(file.get(), picture.pixels.size() * sizeof(Vec4f));
    std::memcpy(picture.pixels.data(), pixels.data(), pixels.size());
    Source target{request.path, request.shownPath};
    const std::string ending = lowered(target.path.extension().string());
    if (ending != ".png" && ending != ".exr")
        throw Error(target.name, "its ending names no picture format that voledit writes", "end it in .png or .exr");
    if (ending == ".png")
        writePng(picture, target, request.transparent);
    else
        moduleFunction<decltype(voleditWriteExr)>("voledit-io-pictures.so", "voleditWriteExr")(picture, target,
                                                                                               request.transparent);
    IoReply reply;
    reply.kind = IoReply::Kind::Written;
    reply.notes = {target.path.filename().string()};
    return {std::move(reply), FileDescriptor()};
}

Answer answer(const IoRequest& request, const FileDescriptor& file, int client) {
    ProgressReporter reporter(client);
    switch (request.task) {
        case IoTask::ReadVolume:
            return readVolume(request, reporter);
        case IoTask::WriteVolume:
            return writeVolume(request, file, reporter);
        case IoTask::ReadPicture:
            return readPicture(request);
        case IoTask::ReadMotion:
            return readMotion(request);
        case IoTask::WritePicture:
            break;
    }
    return writePicture(request, file);
}

Answer failure(const std::string& message) {
    IoReply reply;
    reply.kind = IoReply::Kind::Failed;
    reply.message = message;
    return {std::move(reply), FileDescriptor()};
}

Answer answerOrFailure(const IoRequest& request, const FileDescriptor& file, int client) {
    try {
        limitMemory(request.memoryLimit);
        return answer(request, file, client);
    } catch (const Error& error) {
        return failure(error.what());
    } catch (const std::bad_alloc&) {
        return failure(request.shownPath +
                       ": needs more memory than a sound file of its size would, or than the limit of " +
                       readableBytes(request.memoryLimit) + "; save it anew, reduce it, or raise --memory-limit");
    } catch (const std::exception& error) {
        return failure(request.shownPath + ": cannot be read or written (" + error.what() +
                       "); the file may be damaged, save it anew with the program that made it");
    }
}

}  // namespace

void serve(int client) {
    for (;;) {
        const auto packet = receivePacket(client, -1);
        if (!packet) continue;
        if (packet->bytes.empty()) return;
        const auto [reply, file] = answerOrFailure(unpackRequest(packet->bytes), packet->file, client);
        sendPacket(client, pack(reply), file.get());
    }
}

}  // namespace voledit
