#include "app/io/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "app/io/checks.h"
#include "core/base/error.h"

namespace voledit {

namespace fs = std::filesystem;

InputFile::InputFile(const Source& source) : name_(source.name) {
    // Without O_NONBLOCK, opening a pipe waits for a writer.
    file_ = FileDescriptor(open(source.path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY));
    if (!file_ && errno == ENOENT) throw Error(name_, "there is no such file", "check the name");
    if (!file_)
        throw Error(name_, "cannot be opened (" + std::string(std::strerror(errno)) + ")", "check its permissions");
    struct stat status {};
    if (fstat(file_.get(), &status) != 0 || !S_ISREG(status.st_mode))
        throw Error(name_, "is a folder, pipe or device, not an ordinary file", "name a file");
    size_ = std::uint64_t(status.st_size);
}

std::size_t InputFile::readAt(std::uint64_t offset, std::span<std::byte> out) const {
    std::size_t done = 0;
    while (done < out.size()) {
        constexpr std::size_t most = 1 << 30;
        const ssize_t n =
            pread(file_.get(), out.data() + done, std::min(most, out.size() - done), off_t(offset + done));
        if (n < 0 && errno == EINTR) continue;
        if (n < 0)
            throw Error(name_,
                        "cannot be read at byte " + std::to_string(offset + done) + " (" + std::strerror(errno) + ")",
                        "check the disk");
        if (n == 0) break;
        done += std::size_t(n);
    }
    return done;
}

std::string InputFile::start(std::size_t length) const {
    std::string text(std::min<std::uint64_t>(length, size_), '\0');
    text.resize(readAt(0, std::as_writable_bytes(std::span(text))));
    return text;
}

std::string placeOf(const Source& header, int line) {
    return header.name + ", line " + std::to_string(line);
}

Source dataFileOf(const Source& header, const std::string& written, int line) {
    const std::string place = placeOf(header, line);
    const fs::path relative = written;
    const bool climbs = std::find(relative.begin(), relative.end(), "..") != relative.end();
    if (written.empty() || written.find('\0') != std::string::npos)
        throw Error(place, "names no data file", "name a file in the header's folder");
    if (relative.is_absolute() || climbs)
        throw Error(place, "its data file " + inQuotes(written) + " lies outside the header's folder, which is refused",
                    "put the data file beside the header and name it without a folder");
    const fs::path folder = header.path.parent_path();
    std::error_code failed;
    const fs::path full = fs::canonical(folder / relative, failed);
    if (failed)
        throw Error(place, "its data file " + inQuotes(written) + " cannot be found (" + failed.message() + ")",
                    "put the data file beside the header");
    const fs::path home = fs::canonical(folder, failed);
    if (std::mismatch(home.begin(), home.end(), full.begin(), full.end()).first != home.end())
        throw Error(place, "its data file " + inQuotes(written) + " leads out of the header's folder, which is refused",
                    "put the data file itself beside the header");
    if (!fs::is_regular_file(full, failed))
        throw Error(place, "its data file " + inQuotes(written) + " is a folder, pipe or device",
                    "name an ordinary file beside the header");
    return {full, (fs::path(header.name).parent_path() / relative).string()};
}

}  // namespace voledit
