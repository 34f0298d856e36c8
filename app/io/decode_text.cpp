#include "app/io/decode_text.h"

#include <charconv>
#include <cstring>

#include "app/io/checks.h"
#include "app/io/stored_type.h"
#include "core/base/error.h"

namespace voledit {

namespace {

constexpr std::size_t kLongestWord = 512;

/// Words of a file, from an offset on.
class Words {
public:
    Words(const InputFile& file, std::uint64_t offset) : file_(file), offset_(offset), buffer_(1 << 20, '\0') {}

    /// The next word; empty at the end of the file. Valid until the next call.
    std::string_view next() {
        while (at_ < end_ || refill()) {
            if (!isSeparator(buffer_[at_])) break;
            ++at_;
        }
        if (end_ - at_ < kLongestWord) refill();
        const std::size_t start = at_;
        while (at_ < end_ && !isSeparator(buffer_[at_])) ++at_;
        return std::string_view(buffer_).substr(start, at_ - start);
    }
    /// The next character that is no separator; 0 at the end.
    char nextCharacter() {
        while (at_ < end_ || refill())
            if (const char c = buffer_[at_++]; !isSeparator(c)) return c;
        return '\0';
    }

    std::uint64_t position() const { return offset_ - (end_ - at_); }

private:
    static bool isSeparator(char c) { return c == ' ' || (c >= '\t' && c <= '\r') || c == ','; }

    /// Moves what is left to the front and reads on; false at the end of the file.
    bool refill() {
        std::memmove(buffer_.data(), buffer_.data() + at_, end_ - at_);
        end_ -= at_;
        at_ = 0;
        const std::size_t n = file_.readAt(offset_, std::as_writable_bytes(std::span(buffer_).subspan(end_)));
        offset_ += n;
        end_ += n;
        return n > 0;
    }

    const InputFile& file_;
    std::uint64_t offset_;
    std::string buffer_;
    std::size_t at_ = 0, end_ = 0;
};

[[noreturn]] void throwBadText(const InputFile& file, const Words& words, const std::string& what) {
    throw Error(file.name(), what + " at byte " + std::to_string(words.position()), "correct the text or its header");
}

template <class T>
void readNumbers(const PartTask& task, const InputFile& file, std::span<T> out) {
    Words words(file, task.part.offset);
    for (std::size_t i = 0; i < out.size(); ++i) {
        std::string_view word = words.next();
        if (word.empty())
            throwBadText(file, words,
                         "ends after " + std::to_string(i) + " of " + std::to_string(task.values) + " numbers,");
        if (word.front() == '+') word.remove_prefix(1);
        const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), out[i]);
        if (failed != std::errc() || end != word.data() + word.size())
            throwBadText(file, words,
                         inQuotes(word) + " is no number of type " + std::string(nameOf(task.stored.type)));
        if (i % (1 << 16) == 0) task.sink.progress(task.from + (task.to - task.from) * double(i) / double(out.size()));
    }
    if (!task.stored.moreMayFollow && out.size() == task.values && !words.next().empty())
        task.sink.warn(file.name() + ": holds more numbers than its header claims; the rest was left out");
}

int digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

}  // namespace

void decodeNumbers(const PartTask& task, const InputFile& file, std::span<std::byte> out) {
    withStoredType(task.stored.type, [&](auto t) {
        using T = decltype(t);
        readNumbers(task, file, std::span(reinterpret_cast<T*>(out.data()), out.size() / sizeof(T)));
    });
}

void decodeHex(const PartTask& task, const InputFile& file, std::span<std::byte> out) {
    Words words(file, task.part.offset);
    for (std::size_t i = 0; i < out.size(); ++i) {
        const int high = digit(words.nextCharacter()), low = digit(words.nextCharacter());
        if (high < 0 || low < 0) throwBadText(file, words, "has no hexadecimal digit, or ends,");
        out[i] = std::byte(high << 4 | low);
        if (i % (1 << 18) == 0) task.sink.progress(task.from + (task.to - task.from) * double(i) / double(out.size()));
    }
}

}  // namespace voledit
