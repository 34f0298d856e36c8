#include "app/io/copy_file.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <optional>

#include "core/base/error.h"
#include "core/base/parallel.h"

namespace voledit {

namespace {

constexpr std::uint64_t kChunk = 4 << 20;

/// A stretch of a file in our address space. It is given to the kernel only: reading it here would kill the process
/// where another one shortens the file.
class MappedFile {
public:
    MappedFile(int file, std::uint64_t offset, std::uint64_t count) {
        const auto page = std::uint64_t(sysconf(_SC_PAGESIZE));
        before_ = offset % page;
        size_ = std::size_t(before_ + count);
        start_ = mmap(nullptr, size_, PROT_READ, MAP_SHARED, file, off_t(offset - before_));
    }
    ~MappedFile() {
        if (*this) munmap(start_, size_);
    }
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;

    explicit operator bool() const { return start_ != MAP_FAILED; }
    const std::byte* bytes() const { return static_cast<const std::byte*>(start_) + before_; }

private:
    void* start_;
    std::size_t size_;
    std::uint64_t before_;
};

/// False where the file cannot be mapped.
bool copyChunk(const InputFile& file, std::uint64_t offset, std::uint64_t count, int memory, std::uint64_t at) {
    const MappedFile mapped(file.descriptor(), offset, count);
    if (!mapped) return false;
    for (std::uint64_t done = 0; done < count;) {
        const ssize_t n = pwrite(memory, mapped.bytes() + done, std::size_t(count - done), off_t(at + done));
        if (n < 0 && errno == EINTR) continue;
        if (n < 0 && errno == EFAULT)
            throw Error(file.name(), "became shorter, or its disk failed, while it was read", "read it again");
        if (n <= 0)
            throw Error(file.name(), "there is no memory for it (" + std::string(std::strerror(errno)) + ")",
                        "close other programs, or open a smaller volume");
        done += std::uint64_t(n);
    }
    return true;
}

}  // namespace

// Memory written through its descriptor is neither zeroed first nor mapped page by page: half the cost of reading into
// a mapping.
bool copyToMemory(const InputFile& file, std::uint64_t offset, std::uint64_t count, int memory, std::uint64_t at,
                  const std::function<void(double)>& progress) {
    std::atomic<bool> mappable{true};
    std::atomic<std::uint64_t> done{0};
    const std::uint64_t chunks = (count + kChunk - 1) / kChunk;
    parallelFor(chunks, 1, [&](std::size_t begin, std::size_t end) {
        for (std::uint64_t c = begin; c < end && mappable; ++c) {
            const std::uint64_t size = std::min(kChunk, count - c * kChunk);
            if (!copyChunk(file, offset + c * kChunk, size, memory, at + c * kChunk)) mappable = false;
            progress(double(++done) / double(chunks));
        }
    });
    return mappable;
}

}  // namespace voledit
