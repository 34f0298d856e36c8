#include "app/io/session.h"

#include <chrono>
#include <new>

#include "app/io/checks.h"
#include "app/io/limits.h"
#include "app/io/read_volume.h"
#include "core/base/error.h"
#include "core/fields/statistics.h"
#include "core/io/memory_file.h"
#include "core/io/protocol.h"

namespace voledit {

namespace {

using Clock = std::chrono::steady_clock;

/// Tells the client how far we are, at most every 20 ms.
class ProgressReporter {
public:
    explicit ProgressReporter(int client) : client_(client) {}

    void operator()(double fraction) {
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
};

/// Receives a volume into a memory file.
class MemorySink final : public VolumeSink {
public:
    MemorySink(ProgressReporter& reporter, std::uint64_t memoryLimit) : reporter_(reporter), limit_(memoryLimit) {}

    std::span<std::byte> allocate(const std::string& where, const VolumeHeader& header) override {
        header_ = header;
        const VolumeGrid& g = header.grid;
        const std::uint64_t bytes =
            checkProduct(where, {std::uint64_t(g.size.x), std::uint64_t(g.size.y), std::uint64_t(g.size.z),
                                 std::uint64_t(g.channels), byteSize(header.type)});
        if (bytes > limit_)
            throw Error(where, "needs " + readableBytes(bytes) + ", more than the limit of " + readableBytes(limit_),
                        "raise --memory-limit, or reduce the volume");
        file_ = makeMemoryFile(bytes);
        mapping_ = mapForWriting(file_.get(), bytes);
        return mapping_.bytes;
    }
    void progress(double fraction) override { reporter_(0.9 * fraction); }
    void warn(const std::string& message) override { warnings_.push_back(message); }

    /// The reply and the sealed file.
    std::pair<IoReply, FileDescriptor> finish() {
        IoReply reply;
        reply.kind = IoReply::Kind::Volume;
        reply.grid = header_.grid;
        reply.type = header_.type;
        reply.format = header_.format;
        reply.storedType = header_.storedType;
        reply.notes = std::move(warnings_);
        reporter_(0.9);
        reply.statistics = statisticsOf(header_.type, mapping_.bytes, header_.grid.channels);
        mapping_ = {};
        seal(file_.get());
        return {std::move(reply), std::move(file_)};
    }

private:
    ProgressReporter& reporter_;
    std::uint64_t limit_;
    VolumeHeader header_;
    FileDescriptor file_;
    MappedBytes mapping_;
    std::vector<std::string> warnings_;
};

std::pair<IoReply, FileDescriptor> answer(const IoRequest& request, const FileDescriptor&, int client) {
    ProgressReporter reporter(client);
    MemorySink sink(reporter, request.memoryLimit);
    readAnyVolume(request, sink);
    return sink.finish();
}

std::pair<IoReply, FileDescriptor> failure(const std::string& message) {
    IoReply reply;
    reply.kind = IoReply::Kind::Failed;
    reply.message = message;
    return {std::move(reply), FileDescriptor()};
}

std::pair<IoReply, FileDescriptor> answerOrFailure(const IoRequest& request, const FileDescriptor& file, int client) {
    try {
        limitMemory(request.memoryLimit);
        return answer(request, file, client);
    } catch (const Error& error) {
        return failure(error.what());
    } catch (const std::bad_alloc&) {
        return failure(request.shownPath + ": needs more memory than the limit of " +
                       readableBytes(request.memoryLimit) + "; raise --memory-limit, or reduce the file");
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
