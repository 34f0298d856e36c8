#include "core/io/memory_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/base/error.h"

namespace voledit {

namespace {
constexpr int kSeals = F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_WRITE;

std::string megabytes(std::size_t size) {
    return std::to_string((size >> 20) + 1) + " MiB";
}
}  // namespace

FileDescriptor makeMemoryFile(std::size_t size) {
    FileDescriptor file(memfd_create("voledit", MFD_CLOEXEC | MFD_ALLOW_SEALING));
    if (!file || ftruncate(file.get(), off_t(size)) != 0)
        throw Error("no memory for " + megabytes(size) + ": " + std::strerror(errno));
    return file;
}

MappedBytes mapForWriting(int file, std::size_t size) {
    void* start = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (start == MAP_FAILED) throw Error("no memory for " + megabytes(size) + ": " + std::strerror(errno));
    return {{static_cast<std::byte*>(start), size}, {start, [size](void* p) { munmap(p, size); }}};
}

void seal(int file) {
    if (fcntl(file, F_ADD_SEALS, kSeals) != 0)
        throw Error("cannot seal shared memory: " + std::string(std::strerror(errno)));
}

std::pair<std::span<const std::byte>, std::shared_ptr<const void>> mapSealed(int file, std::size_t size) {
    struct stat status {};
    const int seals = fcntl(file, F_GET_SEALS);
    if (seals < 0 || (seals & kSeals) != kSeals || fstat(file, &status) != 0 || std::size_t(status.st_size) < size)
        throw Error("voledit-io returned memory that is not what it says");
    // Private, since a sealed file cannot be mapped shared on older kernels; unchanged pages are shared all the same.
    void* start = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file, 0);
    if (start == MAP_FAILED) throw Error("no address space for " + megabytes(size) + ": " + std::strerror(errno));
    return {{static_cast<const std::byte*>(start), size},
            std::shared_ptr<const void>(start, [size](const void* p) { munmap(const_cast<void*>(p), size); })};
}

}  // namespace voledit
