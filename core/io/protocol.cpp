#include "core/io/protocol.h"

#include <cstring>
#include <type_traits>

#include "core/base/error.h"

namespace voledit {

namespace {

constexpr std::size_t kLongestText = 8 * 1024, kMostNotes = 10;

class Packer {
public:
    template <class T>
    void operator()(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        const auto* bytes = reinterpret_cast<const std::byte*>(&value);
        packet_.insert(packet_.end(), bytes, bytes + sizeof(T));
    }
    void operator()(const std::string& text) {
        const std::string cut = text.substr(0, kLongestText);
        (*this)(std::uint32_t(cut.size()));
        const auto* bytes = reinterpret_cast<const std::byte*>(cut.data());
        packet_.insert(packet_.end(), bytes, bytes + cut.size());
    }
    void operator()(const std::vector<std::string>& texts) {
        const std::size_t count = std::min(texts.size(), kMostNotes);
        (*this)(std::uint32_t(count));
        for (std::size_t i = 0; i < count; ++i) (*this)(texts[i]);
    }
    void operator()(const std::vector<std::uint64_t>& numbers) {
        (*this)(std::uint32_t(numbers.size()));
        for (const std::uint64_t n : numbers) (*this)(n);
    }
    template <class T>
    void operator()(const std::optional<T>& value) {
        (*this)(std::uint8_t(value.has_value()));
        if (value) (*this)(*value);
    }

    std::vector<std::byte> take() { return std::move(packet_); }

private:
    std::vector<std::byte> packet_;
};

class Unpacker {
public:
    explicit Unpacker(std::span<const std::byte> packet) : rest_(packet) {}

    template <class T>
    void operator()(T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        std::memcpy(static_cast<void*>(&value), take(sizeof(T)).data(), sizeof(T));
    }
    void operator()(std::string& text) {
        const auto bytes = take(count());
        text.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    }
    void operator()(std::vector<std::string>& texts) {
        texts.resize(count());
        for (auto& text : texts) (*this)(text);
    }
    void operator()(std::vector<std::uint64_t>& numbers) {
        numbers.resize(count());
        for (auto& n : numbers) (*this)(n);
    }
    template <class T>
    void operator()(std::optional<T>& value) {
        std::uint8_t there = 0;
        (*this)(there);
        value.reset();
        if (there) (*this)(value.emplace());
    }

    void finish() const {
        if (!rest_.empty()) throw Error("voledit-io sent a message that is too long");
    }

private:
    /// Every counted item takes at least a byte, so a count beyond what is left is a lie.
    std::size_t count() {
        std::uint32_t n = 0;
        (*this)(n);
        if (n > rest_.size()) throw Error("voledit-io sent a message that is too short");
        return n;
    }
    std::span<const std::byte> take(std::size_t n) {
        if (n > rest_.size()) throw Error("voledit-io sent a message that is too short");
        const auto taken = rest_.first(n);
        rest_ = rest_.subspan(n);
        return taken;
    }

    std::span<const std::byte> rest_;
};

// One list of members for both ways.
template <class Archive, class Request>
void describeRequest(Archive& archive, Request& r) {
    archive(r.task);
    archive(r.path);
    archive(r.shownPath);
    archive(r.raw);
    archive(r.spacing);
    archive(r.memoryLimit);
    archive(r.mayReduce);
    archive(r.grid);
    archive(r.type);
    archive(r.pictureSize);
    archive(r.transparent);
}

template <class Archive, class Reply>
void describeReply(Archive& archive, Reply& r) {
    archive(r.kind);
    archive(r.fraction);
    archive(r.message);
    archive(r.format);
    archive(r.storedType);
    archive(r.grid);
    archive(r.type);
    archive(r.statistics.min);
    archive(r.statistics.max);
    archive(r.statistics.mean);
    archive(r.statistics.histogram);
    archive(r.mesh);
    archive(r.notes);
    archive(r.pictureSize);
    archive(r.textBytes);
}

}  // namespace

std::vector<std::byte> pack(const IoRequest& request) {
    Packer packer;
    describeRequest(packer, request);
    return packer.take();
}

std::vector<std::byte> pack(const IoReply& reply) {
    Packer packer;
    describeReply(packer, reply);
    return packer.take();
}

IoRequest unpackRequest(std::span<const std::byte> packet) {
    Unpacker unpacker(packet);
    IoRequest request;
    describeRequest(unpacker, request);
    unpacker.finish();
    if (request.task > IoTask::ReadMotion || request.type > VoxelType::Double)
        throw Error("voledit-io was asked for something unknown");
    return request;
}

IoReply unpackReply(std::span<const std::byte> packet) {
    Unpacker unpacker(packet);
    IoReply reply;
    describeReply(unpacker, reply);
    unpacker.finish();
    if (reply.kind > IoReply::Kind::Motion || reply.type > VoxelType::Double)
        throw Error("voledit-io sent a message of an unknown kind");
    return reply;
}

}  // namespace voledit
