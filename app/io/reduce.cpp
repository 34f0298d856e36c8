#include "app/io/reduce.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>

#include "app/io/byte_order.h"
#include "app/io/inflater.h"
#include "app/io/limits.h"
#include "app/io/stored_type.h"
#include "core/base/error.h"
#include "core/base/parallel.h"

namespace voledit {

namespace {

constexpr std::size_t kBlockBytes = 256 << 10;  // read at a time
constexpr int kMostReduction = 1 << 20;

/// What a box takes along each axis.
std::array<std::uint64_t, 3> boxOf(const StoredVolume& s, int factor) {
    std::array<std::uint64_t, 3> box;
    for (std::size_t a = 0; a < 3; ++a) box[a] = std::min<std::uint64_t>(std::uint64_t(factor), s.size[a]);
    return box;
}

/// Bytes that a value takes while and after it is loaded, at most.
std::uint64_t bytesPerValue(const StoredVolume& s) {
    if (s.slope == 1 && s.intercept == 0) return byteSize(s.type) * (s.type >= StoredType::Int64 ? 2 : 1);
    return byteSize(s.type) + 8;
}

/// Sums of the boxes of whole rows.
class RowSums {
public:
    RowSums(const StoredVolume& s, int factor, std::uint64_t rows)
        : s_(s), box_(boxOf(s, factor)), length_(s.size[0] / box_[0] * s.channels), sums_(length_ * rows) {}

    void clear() { std::fill(sums_.begin(), sums_.end(), 0.0); }

    /// Adds one stored row, in the file's byte order, to row `to` of the sums.
    void add(std::span<std::byte> row, std::uint64_t to) {
        toMachineOrder(s_, row);
        withStoredType(s_.type, [&](auto t) {
            const auto* value = reinterpret_cast<const decltype(t)*>(row.data());
            double* sum = sums_.data() + to * length_;
            for (double* end = sum + length_; sum < end; sum += s_.channels)
                for (std::uint64_t i = 0; i < box_[0]; ++i)
                    for (std::uint64_t c = 0; c < s_.channels; ++c) sum[c] += double(*value++);
        });
    }

    /// Stores the means of the first `rows` rows.
    void store(std::uint64_t rows, std::byte* out) const {
        const double count = double(box_[0]) * double(box_[1]) * double(box_[2]);
        withStoredType(s_.type, [&](auto t) {
            using T = decltype(t);
            T* to = reinterpret_cast<T*>(out);
            for (std::size_t n = 0; n < length_ * rows; ++n)
                to[n] = std::is_integral_v<T> ? T(std::round(sums_[n] / count)) : T(sums_[n] / count);
        });
    }

private:
    const StoredVolume& s_;
    std::array<std::uint64_t, 3> box_;
    std::uint64_t length_;
    std::vector<double> sums_;
};

/// Reads raw bytes of all parts as if they stood one behind the other.
void readRaw(const StoredVolume& s, std::uint64_t at, std::span<std::byte> out) {
    const std::uint64_t share = s.storedValues / s.parts.size() * byteSize(s.type);
    while (!out.empty()) {
        const DataPart& part = s.parts[at / share];
        const auto mine = out.first(std::size_t(std::min<std::uint64_t>(out.size(), share - at % share)));
        const InputFile file(part.file);
        if (file.readAt(part.offset + s.skip + at % share, mine) != mine.size())
            throw Error(file.name(), "became shorter while it was read", "read it again");
        at += mine.size();
        out = out.subspan(mine.size());
    }
}

/// Boxes by themselves: each band of them reads its rows.
void reduceRaw(const StoredVolume& s, int factor, std::span<std::byte> out, VolumeSink& sink) {
    const auto box = boxOf(s, factor);
    const std::uint64_t rows = s.size[1] / box[1], slices = s.size[2] / box[2];
    const std::uint64_t rowBytes = s.size[0] * s.channels * byteSize(s.type);
    const std::uint64_t outRow = s.size[0] / box[0] * s.channels * byteSize(s.type);
    const std::uint64_t band = std::clamp<std::uint64_t>(kBlockBytes / (rowBytes * box[1]), 1, rows);
    std::atomic<std::uint64_t> done{0};
    parallelFor(slices, 1, [&](std::size_t begin, std::size_t end) {
        RowSums sums(s, factor, band);
        std::vector<std::byte> read(std::size_t(band * box[1] * rowBytes));
        for (std::uint64_t k = begin; k < end; ++k) {
            for (std::uint64_t j = 0; j < rows; j += band) {
                const std::uint64_t count = std::min(band, rows - j);
                sums.clear();
                for (std::uint64_t z = k * box[2]; z < (k + 1) * box[2]; ++z) {
                    readRaw(s, (z * s.size[1] + j * box[1]) * rowBytes,
                            std::span(read).first(std::size_t(count * box[1] * rowBytes)));
                    for (std::uint64_t y = 0; y < count * box[1]; ++y)
                        sums.add(std::span(read).subspan(std::size_t(y * rowBytes), std::size_t(rowBytes)), y / box[1]);
                }
                sums.store(count, out.data() + (k * rows + j) * outRow);
            }
            sink.progress(double(++done) / double(slices));
        }
    });
}

void readWhole(Inflater& inflater, const InputFile& file, std::span<std::byte> out) {
    while (!out.empty()) {
        const std::size_t n = inflater.read(out);
        if (n == 0) throw Error(file.name(), "is cut off: its data ends early", "copy or download the file anew");
        out = out.subspan(n);
    }
}

/// Compressed data comes in its own order: slice by slice.
void reduceDeflated(const StoredVolume& s, int factor, std::span<std::byte> out, VolumeSink& sink) {
    const auto box = boxOf(s, factor);
    const std::uint64_t rows = s.size[1] / box[1], slices = s.size[2] / box[2];
    const std::uint64_t outSlice = s.size[0] / box[0] * rows * s.channels * byteSize(s.type);
    const InputFile file(s.parts.front().file);
    Inflater inflater(file, s.parts.front().offset);
    std::vector<std::byte> row(std::size_t(s.size[0] * s.channels * byteSize(s.type)));
    for (std::uint64_t left = s.skip; left > 0;) {
        const auto some = std::span(row).first(std::size_t(std::min<std::uint64_t>(left, row.size())));
        readWhole(inflater, file, some);
        left -= some.size();
    }
    RowSums sums(s, factor, rows);
    for (std::uint64_t k = 0; k < slices; ++k) {
        sums.clear();
        for (std::uint64_t z = 0; z < box[2]; ++z)
            for (std::uint64_t y = 0; y < s.size[1]; ++y) {
                readWhole(inflater, file, row);
                if (y / box[1] < rows) sums.add(row, y / box[1]);
            }
        sums.store(rows, out.data() + k * outSlice);
        sink.progress(double(k + 1) / double(slices));
    }
}

}  // namespace

int reductionFor(const StoredVolume& s, std::uint64_t limit) {
    StoredVolume usual;
    usual.setInterleaved(s.size, s.channels, 1);
    const bool readable =
        s.encoding == Encoding::Raw || (s.encoding == Encoding::Deflated && s.parts.size() == 1 && s.skip < (1U << 30));
    if (!readable || s.stride != usual.stride) return 1;
    for (int factor = 1; factor < kMostReduction; factor *= 2) {
        const StoredVolume reduced = reducedBy(factor, s);
        // No overflow: the sizes have been checked, and 8 bytes a value with them.
        if (reduced.storedValues <= limit / bytesPerValue(s)) return factor;
    }
    return 1;
}

StoredVolume reducedBy(int factor, const StoredVolume& stored) {
    StoredVolume result = stored;
    const auto box = boxOf(stored, factor);
    std::array<std::uint64_t, 3> size;
    for (std::size_t a = 0; a < 3; ++a) {
        size[a] = stored.size[a] / box[a];
        result.worldFromIndex[3] += (double(box[a]) - 1) / 2 * stored.worldFromIndex[int(a)];
        result.worldFromIndex[int(a)] *= double(box[a]);
    }
    result.setInterleaved(size, stored.channels, 1);
    return result;
}

void readReduced(const StoredVolume& stored, int factor, std::span<std::byte> out, VolumeSink& sink) {
    const MemoryLimitLifted lifted;  // what it takes beside `out` is a few rows a thread
    if (stored.encoding == Encoding::Raw)
        reduceRaw(stored, factor, out, sink);
    else
        reduceDeflated(stored, factor, out, sink);
}

}  // namespace voledit
