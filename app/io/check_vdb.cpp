#include "app/io/check_vdb.h"

#include <array>
#include <cstring>

#include "core/base/error.h"

namespace voledit {

namespace {

constexpr std::uint32_t kOldest = 220, kNewest = 300;
constexpr std::uint32_t kMostEntries = 65536, kLongestText = 1 << 20;

class VdbHeader {
public:
    explicit VdbHeader(const Source& source) : file_(source) {}

    void check() {
        if (number<std::int64_t>() != 0x56444220) damaged("does not begin as an OpenVDB file");
        const auto version = number<std::uint32_t>();
        if (version < kOldest || version > kNewest)
            throw Error(file_.name(), "is OpenVDB of file version " + std::to_string(version) + ", which is not read",
                        "save it anew with a current program");
        skip(8);  // the library's version
        if (number<std::uint8_t>() != 1) damaged("has no table of its grids' places");
        skip(36);  // its identifier
        for (auto n = count(); n > 0; --n) {
            skip(text());  // key
            skip(text());  // type
            skip(text());  // value
        }
        const auto grids = count();
        if (grids == 0) damaged("holds no grids");
        for (std::uint32_t n = 0; n < grids; ++n) checkGrid();
    }

private:
    [[noreturn]] void damaged(const std::string& what) const {
        throw Error(file_.name() + ", byte " + std::to_string(at_), what,
                    "the file is damaged or cut off: save or copy it anew");
    }

    template <class T>
    T number() {
        std::array<std::byte, sizeof(T)> raw;
        if (file_.readAt(at_, raw) != raw.size()) damaged("ends within its header");
        at_ += raw.size();
        T value;
        std::memcpy(&value, raw.data(), raw.size());
        return value;
    }
    void skip(std::uint64_t bytes) {
        if (bytes > file_.size() - at_) damaged("ends within its header");
        at_ += bytes;
    }
    std::uint32_t count() {
        const auto n = number<std::uint32_t>();
        if (n > kMostEntries) damaged("has an impossible number of entries");
        return n;
    }
    /// Length of the text or value that follows.
    std::uint32_t text() {
        const auto length = number<std::uint32_t>();
        if (length > kLongestText) damaged("has an impossible length");
        return length;
    }

    void checkGrid() {
        skip(text());  // name
        skip(text());  // type
        skip(text());  // the grid whose voxels it shares
        const auto begin = number<std::int64_t>(), blocks = number<std::int64_t>(), end = number<std::int64_t>();
        if (begin < std::int64_t(at_) || blocks < begin || end < blocks) damaged("has a grid at impossible places");
        if (std::uint64_t(end) > file_.size()) damaged("has a grid that reaches beyond the end of the file");
        at_ = std::uint64_t(end);
    }

    InputFile file_;
    std::uint64_t at_ = 0;
};

}  // namespace

void checkVdb(const Source& source) {
    VdbHeader(source).check();
}

}  // namespace voledit
