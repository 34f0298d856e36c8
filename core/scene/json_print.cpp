#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/scene/json_text.h"

namespace voledit {

namespace {

using nlohmann::ordered_json;

constexpr std::size_t kLineWidth = 110;

class Printer {
public:
    std::string take() { return std::move(text_) + "\n"; }

    void print(const ordered_json& value, std::size_t indent) {
        if (!value.is_structured() || value.empty()) return leaf(value);
        const std::size_t start = text_.size();
        const std::size_t lineStart = text_.rfind('\n') + 1;
        if (indent > 0 && fitsLine(value, lineStart)) return;
        text_.resize(start);
        const char open = value.is_array() ? '[' : '{', close = value.is_array() ? ']' : '}';
        text_ += open;
        bool first = true;
        for (const auto& item : value.items()) {
            text_ += first ? "\n" : ",\n";
            first = false;
            text_.append(indent + 2, ' ');
            if (value.is_object()) text_ += quoted(item.key()) + ": ";
            print(item.value(), indent + 2);
        }
        text_ += '\n';
        text_.append(indent, ' ');
        text_ += close;
    }

private:
    /// Prints on this line; false, with text half written, where the line grows too long.
    bool fitsLine(const ordered_json& value, std::size_t lineStart) {
        if (!value.is_structured() || value.empty()) {
            leaf(value);
            return text_.size() - lineStart <= kLineWidth;
        }
        text_ += value.is_array() ? "[" : "{ ";
        bool first = true;
        for (const auto& item : value.items()) {
            if (!first) text_ += ", ";
            first = false;
            if (value.is_object()) text_ += quoted(item.key()) + ": ";
            if (!fitsLine(item.value(), lineStart)) return false;
        }
        text_ += value.is_array() ? "]" : " }";
        return text_.size() - lineStart <= kLineWidth;
    }

    void leaf(const ordered_json& value) {
        if (value.is_number_float())
            number(value.get<double>());
        else if (value.is_string())
            text_ += quoted(value.get_ref<const std::string&>());
        else
            text_ += value.dump();
    }

    void number(double value) {
        if (!std::isfinite(value)) throw Error("scene", "a number is not finite", "undo the last change");
        char digits[32];
        const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
        text_.append(digits, end);
    }

    static std::string quoted(const std::string& text) {
        try {
            return ordered_json(text).dump();
        } catch (const ordered_json::type_error&) {
            throw Error("scene", "a name or path is not UTF-8 text, which JSON cannot hold", "rename it");
        }
    }

    std::string text_;
};

}  // namespace

std::string printJson(const ordered_json& value) {
    Printer printer;
    printer.print(value, 0);
    return printer.take();
}

}  // namespace voledit
