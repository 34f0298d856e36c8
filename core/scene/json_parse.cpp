#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "core/base/error.h"
#include "core/scene/json_text.h"
#include "core/scene/limits.h"

namespace voledit {

using nlohmann::json;

namespace {
constexpr std::size_t kLongestQuotation = 60;  // bytes of a name or text that messages repeat
constexpr std::size_t kLongestPointer = 400;   // bytes of a place that messages name
}  // namespace

std::string abridged(const std::string& text) {
    if (text.size() <= kLongestQuotation) return text;
    std::size_t end = kLongestQuotation;
    while (end > 0 && (text[end] & 0xC0) == 0x80) --end;  // not within a character
    return text.substr(0, end) + "…";
}

std::string memberOf(const std::string& pointer, const std::string& key) {
    std::string result = pointer + "/";
    for (const char c : abridged(key)) {
        if (c == '~')
            result += "~0";
        else if (c == '/')
            result += "~1";
        else
            result += c;
    }
    return result;
}

std::string elementOf(const std::string& pointer, std::size_t index) {
    return pointer + "/" + std::to_string(index);
}

std::string JsonPlace::pointer() const {
    std::vector<const JsonPlace*> places;
    for (const JsonPlace* place = this; place->outer; place = place->outer) places.push_back(place);
    std::string result;
    for (auto place = places.rbegin(); place != places.rend(); ++place)
        result = (*place)->member.data() ? memberOf(result, std::string((*place)->member))
                                         : elementOf(result, (*place)->element);
    if (result.size() > kLongestPointer) result = abridged(result);
    return result.empty() ? "/" : result;
}

namespace {

/// Builds the tree from the parser's events. nlohmann's own builder lets the last of two equal members win and nests
/// without end.
class TreeBuilder : public nlohmann::json_sax<json> {
public:
    TreeBuilder(const std::string& text, std::string file) : text_(text), file_(std::move(file)) {}

    json take() { return std::move(tree_); }

    bool null() override { return put(nullptr) != nullptr; }
    bool boolean(bool value) override { return put(value) != nullptr; }
    bool number_integer(number_integer_t value) override { return put(value) != nullptr; }
    bool number_unsigned(number_unsigned_t value) override { return put(value) != nullptr; }
    bool number_float(number_float_t value, const string_t&) override { return put(value) != nullptr; }
    bool string(string_t& value) override { return put(std::move(value)) != nullptr; }
    bool binary(binary_t&) override { return false; }

    bool start_object(std::size_t) override { return open(json::object()); }
    bool end_object() override { return close(); }
    bool start_array(std::size_t) override { return open(json::array()); }
    bool end_array() override { return close(); }

    bool key(string_t& name) override {
        json& object = *open_.back();
        if (object.contains(name))
            fail(memberOf(pointer(), name), "this member stands twice in its object", "remove one of the two");
        slot_ = &object[name];
        slotName_ = std::move(name);
        return true;
    }

    bool parse_error(std::size_t position, const std::string&, const json::exception& error) override {
        const std::size_t end = std::min(position ? position - 1 : 0, text_.size());
        const auto line = 1 + std::count(text_.begin(), text_.begin() + std::ptrdiff_t(end), '\n');
        const std::size_t lineStart = end ? text_.rfind('\n', end - 1) + 1 : 0;
        const std::string place = file_ + ":" + std::to_string(line) + ":" + std::to_string(end - lineStart + 1);
        if (error.id == 406)
            throw Error(place,
                        "a number in " + (slot_ ? memberOf(pointer(), slotName_) : pointer()) +
                            " is beyond what a double holds (1.8e308)",
                        "write a finite number");
        std::string what = error.what();
        const bool utf8 = what.find("UTF-8") != std::string::npos;
        if (const auto start = what.find("syntax error"); start != std::string::npos) what = what.substr(start);
        if (const auto read = what.find("; last read:"); read != std::string::npos) {
            const auto after = what.find("'; expected", read);
            what = what.substr(0, read) + (after == std::string::npos ? "" : what.substr(after + 1));
        }
        if (what.size() > 300) what = what.substr(0, 300) + "…";
        throw Error(place, (utf8 ? "not UTF-8 text: " : "not JSON: ") + what,
                    utf8 ? "save the file as UTF-8" : "mend the text there");
    }

private:
    [[noreturn]] void fail(const std::string& pointer, const std::string& what, const std::string& remedy) const {
        const std::string place = pointer.size() > kLongestPointer ? abridged(pointer) : pointer;
        throw Error(file_ + ": " + (place.empty() ? "/" : place), what, remedy);
    }

    /// Place of the innermost open object or array; empty for the outermost.
    std::string pointer() const {
        std::string result;
        for (std::size_t i = 0; i < names_.size(); ++i)
            result = names_[i] ? memberOf(result, *names_[i]) : elementOf(result, open_[i]->size() - 1);
        return result;
    }

    json* put(json value) {
        if (++count_ > kMostJsonValues)
            fail(pointer(), "the file holds more than " + std::to_string(kMostJsonValues) + " values",
                 "keep large data in volume files");
        json* place = nullptr;
        if (open_.empty()) {
            tree_ = std::move(value);
            place = &tree_;
        } else if (open_.back()->is_array()) {
            open_.back()->push_back(std::move(value));
            place = &open_.back()->back();
        } else {
            *slot_ = std::move(value);
            place = slot_;
        }
        return place;
    }

    bool open(json value) {
        if (open_.size() >= kDeepestNesting) {
            fail(abridged(pointer()),
                 "objects and lists are nested deeper than " + std::to_string(kDeepestNesting) + " levels",
                 "name inner parts in `objects` or `transfers` and refer to them with `use`");
        }
        if (!open_.empty())
            names_.push_back(open_.back()->is_array() ? std::nullopt : std::optional<std::string>(slotName_));
        open_.push_back(put(std::move(value)));
        slot_ = nullptr;
        return true;
    }

    bool close() {
        open_.pop_back();
        if (!names_.empty()) names_.pop_back();
        slot_ = nullptr;
        return true;
    }

    const std::string& text_;
    std::string file_;
    json tree_;
    // Addresses stay right: an array grows only while none of its elements is open.
    std::vector<json*> open_;
    std::vector<std::optional<std::string>> names_;  // of every open one but the outermost; nullopt: array element
    json* slot_ = nullptr;                           // the object's member that comes next
    std::string slotName_;
    std::size_t count_ = 0;
};

}  // namespace

json parseJson(const std::string& text, const std::string& file) {
    if (text.find_first_not_of(" \t\r\n") == std::string::npos)
        throw Error(file, "the file is empty", "name another file");
    TreeBuilder builder(text, file);
    json::sax_parse(text, &builder);
    return builder.take();
}

}  // namespace voledit
