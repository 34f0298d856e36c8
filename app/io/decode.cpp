#include "app/io/decode.h"

#include <algorithm>

#include "app/io/checks.h"
#include "app/io/decode_text.h"
#include "app/io/inflater.h"
#include "core/base/error.h"

namespace voledit {

namespace {

constexpr std::size_t kChunk = 4 << 20;

[[noreturn]] void throwShort(const std::string& name, const std::string& has, const std::string& needs) {
    throw Error(name, "is cut off: it holds " + has + ", its header claims " + needs,
                "copy or download the file anew, or correct the header");
}

void warnLonger(const PartTask& task) {
    if (task.stored.moreMayFollow) return;
    task.sink.warn(task.part.file.name + ": holds more data than its header claims; the rest was left out");
}

/// Shortest text of `values` numbers: a digit each, with separators between (hex: two digits a byte).
std::uint64_t shortestText(const PartTask& task) {
    return task.stored.encoding == Encoding::Hex ? 2 * task.values * byteSize(task.stored.type) : 2 * task.values - 1;
}

void copyRaw(const PartTask& task, const InputFile& file, std::span<std::byte> out) {
    const std::uint64_t start = task.part.offset + task.stored.skip;
    if (task.sink.copy(file, start, out, task.from, task.to)) return;
    for (std::size_t at = 0; at < out.size(); at += kChunk) {
        const auto chunk = out.subspan(at, std::min(kChunk, out.size() - at));
        if (file.readAt(start + at, chunk) != chunk.size())
            throwShort(file.name(), readableBytes(file.size()), readableBytes(start + out.size()));
        task.sink.progress(task.from + (task.to - task.from) * double(at) / double(out.size()));
    }
}

void inflateAll(const PartTask& task, const InputFile& file, std::span<std::byte> out) {
    Inflater inflater(file, task.part.offset);
    std::vector<std::byte> scratch(64 << 10);
    for (std::uint64_t left = task.stored.skip; left > 0;) {
        const std::size_t n =
            inflater.read(std::span(scratch).first(std::size_t(std::min<std::uint64_t>(left, scratch.size()))));
        if (n == 0) throwShort(file.name(), "less than its header", "data behind it");
        left -= n;
    }
    for (std::size_t at = 0; at < out.size();) {
        const std::size_t n = inflater.read(out.subspan(at, std::min(kChunk, out.size() - at)));
        if (n == 0) throwShort(file.name(), readableBytes(at) + " of data", readableBytes(out.size()));
        at += n;
        task.sink.progress(task.from + (task.to - task.from) * double(at) / double(out.size()));
    }
    // Only the stream's end carries the checksum.
    const bool whole = out.size() == task.values * byteSize(task.stored.type);
    if (whole && (inflater.read(std::span(scratch).first(1)) != 0 || inflater.trailing())) warnLonger(task);
}

}  // namespace

void checkLength(const PartTask& task) {
    const InputFile file(task.part.file);
    const StoredVolume& s = task.stored;
    if (file.size() == 0) throw Error(file.name(), "is empty", "copy or download the file anew");
    const std::uint64_t there = file.size() - std::min(file.size(), task.part.offset);
    const std::uint64_t needed =
        checkProduct(file.name(), {task.values, byteSize(s.type)}) + std::min(s.skip, std::uint64_t(1) << 40);
    switch (s.encoding) {
        case Encoding::Raw:
            if (there < needed) throwShort(file.name(), readableBytes(there) + " of data", readableBytes(needed));
            if (there > needed) warnLonger(task);
            break;
        case Encoding::Deflated:
            if (needed / kDeflateRatio > there)
                throwShort(file.name(), readableBytes(there) + " of compressed data", readableBytes(needed));
            break;
        case Encoding::Ascii:
        case Encoding::Hex:
            if (there < shortestText(task))
                throwShort(file.name(), readableBytes(there) + " of text", std::to_string(task.values) + " numbers");
            break;
    }
}

void decode(const PartTask& task, std::span<std::byte> out) {
    const InputFile file(task.part.file);
    switch (task.stored.encoding) {
        case Encoding::Raw:
            return copyRaw(task, file, out);
        case Encoding::Deflated:
            return inflateAll(task, file, out);
        case Encoding::Ascii:
            return decodeNumbers(task, file, out);
        case Encoding::Hex:
            return decodeHex(task, file, out);
    }
}

}  // namespace voledit
