#include "core/io/bvh_scanner.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/base/error.h"
#include "core/io/bvh.h"

namespace voledit {

namespace {

bool isLineEnd(char c) {
    return c == '\n' || c == '\r';
}

bool isBlank(char c) {
    return c == ' ' || c == '\t' || c == '\v' || c == '\f' || isLineEnd(c);
}

bool isBrace(char c) {
    return c == '{' || c == '}';
}

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
}

}  // namespace

BvhScanner::BvhScanner(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {
    if (text_.starts_with("\xef\xbb\xbf")) at_ = 3;
}

void BvhScanner::step() {
    const char c = text_[at_++];
    const bool beforeLineFeed = c == '\r' && at_ < text_.size() && text_[at_] == '\n';
    if (isLineEnd(c) && !beforeLineFeed) ++line_;
}

void BvhScanner::skipBlanks() {
    while (at_ < text_.size() && isBlank(text_[at_])) step();
}

std::string_view BvhScanner::word() {
    skipBlanks();
    wordLine_ = line_;
    const std::size_t start = at_;
    if (at_ < text_.size() && isBrace(text_[at_])) return text_.substr(at_++, 1);
    while (at_ < text_.size() && !isBlank(text_[at_]) && !isBrace(text_[at_])) ++at_;
    return text_.substr(start, at_ - start);
}

std::string_view BvhScanner::peek() {
    skipBlanks();
    const std::size_t start = at_;
    const std::string_view next = word();
    at_ = start;
    return next;
}

bool BvhScanner::take(std::string_view expected) {
    if (!equalInAnyCase(peek(), expected)) return false;
    word();
    return true;
}

std::string_view BvhScanner::restOfLine() {
    while (!atLineEnd() && isBlank(text_[at_])) step();
    const std::size_t start = at_;
    while (at_ < text_.size() && !isLineEnd(text_[at_]) && !isBrace(text_[at_])) ++at_;
    std::string_view rest = text_.substr(start, at_ - start);
    while (!rest.empty() && isBlank(rest.back())) rest.remove_suffix(1);
    return rest;
}

double BvhScanner::number(std::string_view what) {
    const std::string_view written = word();
    if (written.empty()) fail("it ends before " + std::string(what), "it was cut off: copy or export it anew");
    std::string_view digits = written;
    if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (end != digits.data() + digits.size() || error == std::errc::invalid_argument)
        fail(quotedText(written) + " is no number, where " + std::string(what) + " is expected",
             "mend it there, or export anew");
    if (error != std::errc() || !std::isfinite(value) || std::abs(value) > BvhLimits::number)
        fail(quotedText(written) + " is not finite, or out of range, where " + std::string(what) + " is expected",
             "mend it there, or export anew");
    return value;
}

bool BvhScanner::atEnd() {
    skipBlanks();
    return at_ == text_.size();
}

bool BvhScanner::atLineEnd() {
    while (at_ < text_.size() && isBlank(text_[at_]) && !isLineEnd(text_[at_])) ++at_;
    return at_ == text_.size() || isLineEnd(text_[at_]);
}

void BvhScanner::fail(const std::string& what, const std::string& remedy) const {
    throw Error(file_ + ", line " + std::to_string(wordLine_), what, remedy);
}

std::string quotedText(std::string_view text) {
    constexpr std::size_t longest = 40;
    std::string shown = "\"";
    for (const char c : text.substr(0, longest)) shown += c >= ' ' && c <= '~' ? c : '?';
    return shown + (text.size() > longest ? "…\"" : "\"");
}

bool equalInAnyCase(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return lower(x) == lower(y); });
}

}  // namespace voledit
