#include "app/io/inflater.h"

#include <algorithm>
#include <limits>
#include <new>

#include "core/base/error.h"

namespace voledit {

namespace {
constexpr std::size_t kInput = 256 << 10;
constexpr int kDetectGzipOrZlib = 15 + 32;
}  // namespace

Inflater::Inflater(const InputFile& file, std::uint64_t offset) : file_(file), offset_(offset), input_(kInput) {
    if (inflateInit2(&stream_, kDetectGzipOrZlib) != Z_OK) throw std::bad_alloc();
}

Inflater::~Inflater() {
    inflateEnd(&stream_);
}

void Inflater::refill() {
    const std::size_t n = file_.readAt(offset_, input_);
    offset_ += n;
    stream_.next_in = reinterpret_cast<Bytef*>(input_.data());
    stream_.avail_in = uInt(n);
}

void Inflater::endMember() {
    if (stream_.avail_in == 0) refill();
    // A gzip file may have several members; anything else behind a stream is not ours.
    if (stream_.avail_in > 0 && *stream_.next_in == 0x1f) {
        inflateReset(&stream_);
    } else {
        trailing_ = stream_.avail_in > 0;
        done_ = true;
    }
}

std::size_t Inflater::read(std::span<std::byte> out) {
    const std::size_t wanted = std::min<std::size_t>(out.size(), std::numeric_limits<uInt>::max());
    stream_.next_out = reinterpret_cast<Bytef*>(out.data());
    stream_.avail_out = uInt(wanted);
    while (stream_.avail_out > 0 && !done_) {
        if (stream_.avail_in == 0) refill();
        if (stream_.avail_in == 0)
            throw Error(file_.name(), "is cut off: its compressed data breaks off at the end of the file",
                        "copy or download the file anew");
        const int state = inflate(&stream_, Z_NO_FLUSH);
        if (state == Z_STREAM_END)
            endMember();
        else if (state == Z_MEM_ERROR)
            throw std::bad_alloc();
        else if (state != Z_OK && state != Z_BUF_ERROR)
            throw Error(file_.name(),
                        "its compressed data is damaged before byte " + std::to_string(offset_) + " (" +
                            (stream_.msg ? stream_.msg : "not gzip or zlib data") + ")",
                        "copy or download the file anew");
    }
    return wanted - stream_.avail_out;
}

}  // namespace voledit
