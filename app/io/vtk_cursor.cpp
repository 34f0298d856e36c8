#include "app/io/vtk_cursor.h"

#include <cstring>

#include "app/io/header_text.h"
#include "core/base/error.h"

namespace voledit {

namespace {

constexpr std::size_t kBuffer = 1 << 20, kLongestLine = 1 << 16, kLongestWord = 512;

bool isSeparator(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r') || c == ',';
}

}  // namespace

VtkCursor::VtkCursor(const InputFile& file, std::uint64_t position)
    : file_(file), offset_(position), buffer_(kBuffer, '\0') {}

void VtkCursor::moveTo(std::uint64_t position) {
    if (position >= offset_ && position <= offset_ + end_) {
        at_ = std::size_t(position - offset_);
        return;
    }
    offset_ = position;
    at_ = end_ = 0;
}

std::size_t VtkCursor::need(std::size_t wanted) {
    if (end_ - at_ >= wanted) return end_ - at_;
    std::memmove(buffer_.data(), buffer_.data() + at_, end_ - at_);
    offset_ += at_;
    end_ -= at_;
    at_ = 0;
    end_ += file_.readAt(offset_ + end_, std::as_writable_bytes(std::span(buffer_).subspan(end_)));
    return end_;
}

std::optional<std::string> VtkCursor::line() {
    const std::size_t there = need(kLongestLine + 1);
    if (there == 0) return std::nullopt;
    const std::string_view text(buffer_.data() + at_, there);
    std::size_t end = text.find('\n');
    const bool ends = end != std::string_view::npos;
    if (!ends) end = text.size();
    if (end > kLongestLine)
        throw Error(file_.name(), "has a line of more than 64 KiB at byte " + std::to_string(position()),
                    "the header is damaged, or its sizes are wrong: correct it");
    std::string line(text.substr(0, end));
    at_ += end + (ends ? 1 : 0);
    lines_ += ends;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return line;
}

std::string_view VtkCursor::word() {
    for (;;) {
        while (at_ < end_ && isSeparator(buffer_[at_])) lines_ += buffer_[at_++] == '\n';
        if (at_ < end_) break;
        if (need(1) == 0) return {};
    }
    need(kLongestWord);
    const std::size_t start = at_, stop = std::min(end_, at_ + kLongestWord);
    while (at_ < stop && !isSeparator(buffer_[at_])) ++at_;
    return std::string_view(buffer_).substr(start, at_ - start);
}

bool VtkCursor::ahead(std::string_view text) {
    if (need(text.size()) < text.size()) return false;
    return lowered(std::string_view(buffer_).substr(at_, text.size())) == text;
}

std::size_t VtkCursor::read(std::span<std::byte> out) {
    const std::size_t buffered = std::min(out.size(), end_ - at_);
    if (buffered > 0) std::memcpy(out.data(), buffer_.data() + at_, buffered);
    at_ += buffered;
    if (buffered == out.size()) return buffered;
    const std::size_t more = file_.readAt(position(), out.subspan(buffered));
    moveTo(position() + more);
    return buffered + more;
}

}  // namespace voledit
