#include "app/io/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>

#include "core/base/error.h"

namespace voledit {

namespace {
constexpr int kLevel = 4;  // twice as fast as the usual 6, files about 3 % larger
constexpr std::size_t kChunk = 1 << 20;
}  // namespace

OutputFile::OutputFile(const Source& target)
    : name_(target.name), file_(open(target.path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666)) {
    if (!file_) throw Error(name_, "cannot be made (" + std::string(std::strerror(errno)) + ")", "check its folder");
}

OutputFile::~OutputFile() {
    if (packing_ != Packing::Plain) deflateEnd(&stream_);
}

void OutputFile::pack(Packing packing) {
    if (packing_ != Packing::Plain) {
        deflateSome(Z_FINISH);
        deflateEnd(&stream_);
    }
    packing_ = packing;
    if (packing_ == Packing::Plain) return;
    stream_ = {};
    const int windowBits = packing == Packing::Gzip ? 15 + 16 : 15;
    if (deflateInit2(&stream_, kLevel, Z_DEFLATED, windowBits, 8, Z_DEFAULT_STRATEGY) != Z_OK) {
        packing_ = Packing::Plain;
        throw std::bad_alloc();
    }
    buffer_.resize(kChunk);
}

void OutputFile::write(std::span<const std::byte> bytes) {
    if (packing_ == Packing::Plain) return writePlain(bytes);
    while (!bytes.empty()) {
        const auto chunk = bytes.first(std::min(bytes.size(), kChunk));
        stream_.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(chunk.data()));
        stream_.avail_in = uInt(chunk.size());
        deflateSome(Z_NO_FLUSH);
        bytes = bytes.subspan(chunk.size());
    }
}

void OutputFile::deflateSome(int flush) {
    do {
        stream_.next_out = reinterpret_cast<Bytef*>(buffer_.data());
        stream_.avail_out = uInt(buffer_.size());
        deflate(&stream_, flush);
        writePlain(std::span(buffer_).first(buffer_.size() - stream_.avail_out));
    } while (stream_.avail_out == 0);
}

void OutputFile::writePlain(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t n = ::write(file_.get(), bytes.data(), std::min(bytes.size(), kChunk * 64));
        if (n < 0 && errno == EINTR) continue;
        if (n < 0)
            throw Error(name_, "cannot be written (" + std::string(std::strerror(errno)) + ")",
                        "free space on the disk");
        size_ += std::uint64_t(n);
        bytes = bytes.subspan(std::size_t(n));
    }
}

void OutputFile::close() {
    pack(Packing::Plain);
    if (fsync(file_.get()) != 0 && errno != EINVAL)
        throw Error(name_, "cannot be written (" + std::string(std::strerror(errno)) + ")", "free space on the disk");
    file_.reset();
}

}  // namespace voledit
