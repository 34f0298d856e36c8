#pragma once
// JSON text to a tree and back, with the care that files from strangers need.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace voledit {

/// `text` for a message: cut where it is long.
std::string abridged(const std::string& text);
/// Appends member `key` to the JSON pointer `pointer` (RFC 6901: ~ and / escaped); a long key is abridged.
std::string memberOf(const std::string& pointer, const std::string& key);
/// Appends element `index` to the JSON pointer `pointer`.
std::string elementOf(const std::string& pointer, std::size_t index);

/// A place in a JSON tree while it is walked: a link to the place around it, so that no text is made unless something
/// is wrong. The outer place and the member's name must outlive it.
struct JsonPlace {
    const JsonPlace* outer = nullptr;
    std::string_view member = {};  // null data: an element
    std::size_t element = 0;

    JsonPlace at(std::string_view name) const { return {this, name, 0}; }
    JsonPlace at(std::size_t index) const { return {this, {}, index}; }
    /// The JSON pointer; "/" for the whole tree.
    std::string pointer() const;
};

/// Parses `text`. `file` names it in errors. Throws Error with line and column for what is not JSON or not UTF-8, and
/// with the JSON pointer for a member that stands twice, a number beyond a double's range, nesting deeper than
/// kDeepestNesting and more than kMostJsonValues values.
nlohmann::json parseJson(const std::string& text, const std::string& file);

/// Members in their order, indented by two; what fits within about a hundred characters stands on one line. Numbers
/// are the shortest that read back as the same double. Throws Error for a number that is not finite and for text that
/// is not UTF-8.
std::string printJson(const nlohmann::ordered_json& value);

}  // namespace voledit
