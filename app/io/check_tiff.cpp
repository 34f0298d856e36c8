#include "app/io/check_tiff.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "app/io/checks.h"
#include "core/base/error.h"

namespace voledit {

namespace {

constexpr std::size_t kMostPages = 65536, kMostEntries = 4096;
constexpr std::uint64_t kMostSegments = 1 << 24;

enum Tag : std::uint16_t {
    NewSubfileType = 254,
    ImageWidth = 256,
    ImageLength = 257,
    BitsPerSample = 258,
    Compression = 259,
    StripOffsets = 273,
    SamplesPerPixel = 277,
    StripByteCounts = 279,
    TileOffsets = 324,
    TileByteCounts = 325,
};

class TiffChecker {
public:
    TiffChecker(const Source& source, VolumeSink& sink) : file_(source), sink_(sink) {}

    std::vector<int> check() {
        std::uint64_t at = firstPage();
        std::set<std::uint64_t> seen;
        std::vector<int> pages;
        for (int page = 0; at != 0; ++page) {
            if (!seen.insert(at).second) damaged(page, "is listed twice");
            if (seen.size() > kMostPages) damaged(page, "is one too many: there may be 65536");
            const Entries entries = readEntries(at, page);
            if (checkPage(entries, page)) pages.push_back(page);
        }
        if (pages.empty()) throw Error(file_.name(), "has no pages", "the file is damaged: save it anew");
        return pages;
    }

private:
    struct Entry {
        std::uint16_t type = 0;
        std::uint64_t count = 0;
        std::uint64_t at = 0;  // where its values lie
    };
    using Entries = std::map<std::uint16_t, Entry>;

    [[noreturn]] void damaged(int page, const std::string& what) const {
        throw Error(file_.name() + ", page " + std::to_string(page + 1), what,
                    "the file is damaged or cut off: save or copy it anew");
    }

    /// The number of `bytes` bytes at `at`.
    std::uint64_t number(std::uint64_t at, std::size_t bytes) const {
        std::array<std::byte, 8> raw{};
        const auto part = std::span(raw).first(bytes);
        if (file_.readAt(at, part) != bytes)
            throw Error(file_.name(), "ends within its directory", "copy or save the file anew");
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < bytes; ++i)
            value = value << 8 | std::to_integer<std::uint64_t>(part[big_ ? i : bytes - 1 - i]);
        return value;
    }

    std::uint64_t firstPage() {
        const std::string magic = file_.start(4);
        if (magic.size() < 4 || (!magic.starts_with("II") && !magic.starts_with("MM")))
            throw Error(file_.name(), "is no TIFF file", "take it out of the stack");
        big_ = magic.starts_with("MM");
        wide_ = number(2, 2) == 43;
        return wide_ ? number(8, 8) : number(4, 4);
    }

    /// The entries of the page's directory at `at`, which becomes the next one's place.
    Entries readEntries(std::uint64_t& at, int page) const {
        const std::size_t countBytes = wide_ ? 8 : 2, entryBytes = wide_ ? 20 : 12, wordBytes = wide_ ? 8 : 4;
        const std::uint64_t count = number(at, countBytes);
        if (count > kMostEntries) damaged(page, "has " + std::to_string(count) + " directory entries");
        constexpr std::array<std::uint64_t, 19> sizes{0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8, 4, 0, 0, 8, 8, 8};
        Entries entries;
        for (std::uint64_t n = 0; n < count; ++n) {
            const std::uint64_t here = at + countBytes + n * entryBytes;
            Entry entry;
            entry.type = std::uint16_t(number(here + 2, 2));
            entry.count = number(here + 4, wordBytes);
            const std::uint64_t place = here + 4 + wordBytes;
            const std::uint64_t size = entry.type < sizes.size() ? sizes[entry.type] : 0;
            const std::uint64_t bytes = checkProduct(file_.name(), {size, entry.count});
            entry.at = bytes <= wordBytes ? place : number(place, wordBytes);
            if (entry.at > file_.size() || bytes > file_.size() - entry.at)
                damaged(page, "has directory values beyond the end of the file");
            entries[std::uint16_t(number(here, 2))] = entry;
        }
        at = number(at + countBytes + count * entryBytes, wordBytes);
        return entries;
    }

    std::uint64_t value(const Entry& entry, std::uint64_t index) const {
        constexpr std::array<std::size_t, 19> sizes{0, 1, 1, 2, 4, 0, 1, 1, 2, 4, 0, 0, 0, 4, 0, 0, 8, 8, 8};
        const std::size_t bytes = entry.type < sizes.size() ? sizes[entry.type] : 0;
        return bytes == 0 || index >= entry.count ? 0 : number(entry.at + index * bytes, bytes);
    }
    std::uint64_t value(const Entries& entries, Tag tag, std::uint64_t otherwise) const {
        const auto found = entries.find(tag);
        return found == entries.end() || found->second.count == 0 ? otherwise : value(found->second, 0);
    }

    /// False for a reduced copy of another page.
    bool checkPage(const Entries& entries, int page) {
        const std::uint64_t width = value(entries, ImageWidth, 0), height = value(entries, ImageLength, 0);
        const std::uint64_t samples = value(entries, SamplesPerPixel, 1), bits = value(entries, BitsPerSample, 1);
        checkSizes(file_.name() + ", page " + std::to_string(page + 1), {width, height, 1}, samples);
        if (bits < 1 || bits > 64) damaged(page, "has " + std::to_string(bits) + " bits a sample");
        const std::uint64_t stored = checkSegments(entries, page);
        const std::uint64_t needed = (checkProduct(file_.name(), {width, samples, bits}) + 7) / 8 * height;
        const std::uint64_t compression = value(entries, Compression, 1);
        const bool deflate = compression == 8 || compression == 32946;
        if ((compression == 1 && stored < needed) || (deflate && needed / kDeflateRatio > stored))
            damaged(page, "claims more pixels than its data can hold");
        if (bits != 8 && bits % 16 != 0 && !std::exchange(warnedOfBits_, true))
            sink_.warn(file_.name() + ": its samples of " + std::to_string(bits) +
                       " bits were widened to the full range of the next larger type");
        return (value(entries, NewSubfileType, 0) & 1) == 0;
    }

    /// Bytes in the page's strips or tiles, all of which must lie in the file.
    std::uint64_t checkSegments(const Entries& entries, int page) const {
        const bool tiled = entries.contains(TileOffsets);
        const auto offsets = entries.find(tiled ? TileOffsets : StripOffsets);
        const auto lengths = entries.find(tiled ? TileByteCounts : StripByteCounts);
        if (offsets == entries.end()) damaged(page, "has no data");
        // Old files of one strip leave its length out: it runs to the end of the file.
        if (lengths == entries.end()) return file_.size();
        const std::uint64_t count = std::min(offsets->second.count, lengths->second.count);
        if (count == 0 || count > kMostSegments) damaged(page, "has " + std::to_string(count) + " strips or tiles");
        std::uint64_t sum = 0;
        for (std::uint64_t n = 0; n < count; ++n) {
            const std::uint64_t from = value(offsets->second, n), length = value(lengths->second, n);
            if (from > file_.size() || length > file_.size() - from)
                damaged(page, "has data beyond the end of the file");
            sum += length;
        }
        return sum;
    }

    InputFile file_;
    VolumeSink& sink_;
    bool big_ = false, wide_ = false, warnedOfBits_ = false;
};

}  // namespace

std::vector<int> checkTiff(const Source& source, VolumeSink& sink) {
    return TiffChecker(source, sink).check();
}

}  // namespace voledit
