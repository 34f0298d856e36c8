// Checking a value against a schema that was read.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/scene/json_schema_node.h"
#include "core/scene/json_text.h"

namespace voledit {

using nlohmann::json;

namespace {

unsigned typeOf(const json& value) {
    switch (value.type()) {
        case json::value_t::null:
            return kNull;
        case json::value_t::boolean:
            return kBoolean;
        case json::value_t::number_integer:
        case json::value_t::number_unsigned:
            return kInteger | kNumber;
        // 3.0 is an integer too, since draft 6.
        case json::value_t::number_float:
            return value.get<double>() == std::floor(value.get<double>()) ? kInteger | kNumber : unsigned(kNumber);
        case json::value_t::string:
            return kString;
        case json::value_t::array:
            return kArray;
        case json::value_t::object:
            return kObject;
        default:
            return 0;
    }
}

std::string typeNames(unsigned types) {
    static constexpr std::pair<unsigned, const char*> names[] = {
        {kNull, "null"},   {kBoolean, "true or false"}, {kInteger, "a whole number"}, {kNumber, "a number"},
        {kString, "text"}, {kArray, "a list"},          {kObject, "an object"}};
    std::string result;
    for (const auto& [type, name] : names)
        if (types & type) result += (result.empty() ? "" : " or ") + std::string(name);
    return result;
}

std::string joined(const std::vector<std::string>& words, const char* separator = ", ") {
    std::string result;
    for (const auto& word : words) result += (result.empty() ? "" : separator) + word;
    return result;
}

std::string suggestion(const std::string& name, const std::vector<std::string>& names, const std::string& otherwise) {
    const std::string nearest = nearestName(name, names);
    return nearest.empty() ? otherwise : "did you mean \"" + nearest + "\"?";
}

/// Characters of UTF-8 text.
std::size_t lengthOf(const std::string& text) {
    return std::size_t(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

/// Edits (insert, delete, replace, swap neighbours) from a to b.
std::size_t editDistance(const std::string& a, const std::string& b) {
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i)
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                d[i][j] = i + j;
                continue;
            }
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
        }
    return d[a.size()][b.size()];
}

}  // namespace

std::string nearestName(const std::string& name, const std::vector<std::string>& names) {
    if (name.size() > 64) return "";
    std::string nearest;
    std::size_t least = std::max<std::size_t>(1, name.size() / 3) + 1;
    for (const auto& candidate : names) {
        if (candidate.size() > 64) continue;
        const std::size_t distance = editDistance(name, candidate);
        if (distance >= least) continue;
        least = distance;
        nearest = candidate;
    }
    return nearest;
}

std::string described(const json& value) {
    if (value.is_array()) return "a list of " + std::to_string(value.size());
    if (value.is_object()) {
        if (value.empty()) return "an empty object";
        std::vector<std::string> names;
        for (const auto& item : value.items()) {
            if (names.size() == 5) {
                names.push_back("…");
                break;
            }
            names.push_back(abridged(item.key()));
        }
        return "an object with " + joined(names);
    }
    if (value.is_string())
        return json(abridged(value.get_ref<const std::string&>())).dump(-1, ' ', false, json::error_handler_t::replace);
    return value.dump();
}

/// One pass over a value. `mistake` is null where only the answer is asked for (`if`, `not`, alternatives).
struct JsonSchema::Check {
    JsonMistake* mistake;

    /// Not inlined, since the texts of every message would then take room in each frame of a deep walk.
    template <class Words>
    [[gnu::noinline]] bool fail(const JsonPlace& place, const Words& words) const {
        if (mistake) {
            const auto [what, remedy] = words();
            *mistake = {place.pointer(), what, remedy};
        }
        return false;
    }
    using Words = std::pair<std::string, std::string>;

    static std::string expected(const Node& node) { return node.title.empty() ? typeNames(node.types) : node.title; }

    bool failExpected(const Node& node, const json& value, const JsonPlace& place) const {
        return fail(place,
                    [&] { return Words("found " + described(value) + ", expected " + expected(node), "correct it"); });
    }

    bool valid(const Node& node, const json& value, const JsonPlace& place) const {
        if (node.never) return fail(place, [] { return Words("this may not stand here", "remove it"); });
        if (node.target) return valid(*node.target, value, place);
        if (node.types && !(node.types & typeOf(value))) return failExpected(node, value, place);
        if (!node.values.empty() && !validChoice(node, value, place)) return false;
        if (value.is_number() && !validNumber(node, value, place)) return false;
        if (value.is_string() && !validText(node, value, place)) return false;
        if (value.is_array() && !validArray(node, value, place)) return false;
        if (value.is_object() && !validObject(node, value, place)) return false;
        return validCombination(node, value, place);
    }

    bool validChoice(const Node& node, const json& value, const JsonPlace& place) const {
        if (std::find(node.values.begin(), node.values.end(), value) != node.values.end()) return true;
        return fail(place, [&] {
            std::vector<std::string> quoted, plain;
            for (const auto& choice : node.values) {
                quoted.push_back(choice.dump());
                plain.push_back(choice.is_string() ? choice.get<std::string>() : choice.dump());
            }
            const std::string text = value.is_string() ? abridged(value.get_ref<const std::string&>()) : "";
            if (quoted.size() == 1 && !node.title.empty())
                return Words("found " + described(value) + ", expected " + node.title, "write that");
            const std::string kind = node.title.empty() ? "" : " (" + node.title + ")";
            return Words("found " + described(value) + ", expected one of " + joined(quoted) + kind,
                         suggestion(text, plain, "choose one of them"));
        });
    }

    bool validNumber(const Node& node, const json& value, const JsonPlace& place) const {
        const double number = value.get<double>();
        const bool inside = (!node.minimum || number >= *node.minimum) && (!node.maximum || number <= *node.maximum) &&
                            (!node.exclusiveMinimum || number > *node.exclusiveMinimum) &&
                            (!node.exclusiveMaximum || number < *node.exclusiveMaximum);
        return inside || failExpected(node, value, place);
    }

    bool validText(const Node& node, const json& value, const JsonPlace& place) const {
        if (!node.minLength && !node.maxLength) return true;
        const std::size_t length = lengthOf(value.get_ref<const std::string&>());
        const bool inside = length >= node.minLength.value_or(0) && length <= node.maxLength.value_or(length);
        return inside || fail(place, [&] {
                   const std::string found =
                       length ? "a text of " + std::to_string(length) + " characters" : "an empty text";
                   return Words("found " + found + ", expected " + expected(node), "correct it");
               });
    }

    bool validArray(const Node& node, const json& value, const JsonPlace& place) const {
        if (value.size() < node.minItems.value_or(0) || value.size() > node.maxItems.value_or(value.size()))
            return failExpected(node, value, place);
        for (std::size_t i = 0; i < value.size(); ++i) {
            const JsonPlace here = place.at(i);
            const Node* schema = i < node.tuple.size() ? node.tuple[i] : node.items;
            if (schema && !valid(*schema, value[i], here)) return false;
            if (node.uniqueItems && std::find(value.begin(), value.begin() + std::ptrdiff_t(i), value[i]) !=
                                        value.begin() + std::ptrdiff_t(i))
                return fail(here, [&] { return Words(described(value[i]) + " stands twice", "remove one"); });
        }
        return true;
    }

    bool validObject(const Node& node, const json& value, const JsonPlace& place) const {
        if (node.propertyNames || node.additional)
            for (auto item = value.begin(); item != value.end(); ++item)
                if (!validName(node, item.key(), place)) return false;
        for (const auto& name : node.required)
            if (!value.contains(name))
                return fail(place, [&] {
                    const std::string kind =
                        node.title.empty() ? "" : "; " + node.title + " needs " + joined(node.required);
                    return Words("\"" + name + "\" is missing" + kind, "add it");
                });
        if (value.size() < node.minProperties.value_or(0) || value.size() > node.maxProperties.value_or(value.size()))
            return fail(place, [&] {
                return Words("found " + described(value) + ", expected " + expected(node) + " with one of " +
                                 joined(propertiesOf(node)),
                             "give exactly one");
            });
        for (auto item = value.begin(); item != value.end(); ++item) {
            const Node* schema = node.property(item.key());
            if (!schema) schema = node.additional;
            const JsonPlace here = place.at(item.key());
            if (schema && !valid(*schema, item.value(), here)) return false;
        }
        return true;
    }

    static std::vector<std::string> propertiesOf(const Node& node) {
        std::vector<std::string> names;
        for (const auto& [name, schema] : node.properties)
            if (name != "type") names.push_back(name);
        return names;
    }

    bool validName(const Node& node, const std::string& name, const JsonPlace& place) const {
        const JsonPlace here = place.at(name);
        if (node.propertyNames && lengthOf(name) < node.propertyNames->minLength.value_or(0))
            return fail(here, [] { return Words("a name is empty", "give it one"); });
        if (!node.additional || !node.additional->never || node.property(name)) return true;
        return fail(here, [&] {
            const auto known = propertiesOf(node);
            const std::string kind = node.title.empty() ? "this object" : node.title;
            return Words("unknown member \"" + abridged(name) + "\"; " + kind + " has " + joined(known),
                         suggestion(name, known, "remove it or correct its name"));
        });
    }

    bool validCombination(const Node& node, const json& value, const JsonPlace& place) const {
        const Check quietly{nullptr};
        if (node.condition) {
            const Node* branch = quietly.valid(*node.condition, value, place) ? node.then : node.otherwise;
            if (branch && !valid(*branch, value, place)) return false;
        }
        for (const Node* part : node.allOf)
            if (!valid(*part, value, place)) return false;
        const auto holding = [&](const std::vector<const Node*>& parts) {
            return std::count_if(parts.begin(), parts.end(),
                                 [&](const Node* part) { return quietly.valid(*part, value, place); });
        };
        if (!node.anyOf.empty() && holding(node.anyOf) == 0) return failAlternatives(node, node.anyOf, value, place);
        if (!node.oneOf.empty() && holding(node.oneOf) != 1) return failAlternatives(node, node.oneOf, value, place);
        if (node.negated && quietly.valid(*node.negated, value, place))
            return fail(place, [&] {
                return Words("found " + (node.negated->title.empty() ? described(value) : node.negated->title),
                             "keep one of them");
            });
        return true;
    }

    bool failAlternatives(const Node& node, const std::vector<const Node*>& parts, const json& value,
                          const JsonPlace& place) const {
        return fail(place, [&] {
            std::vector<std::string> choices;
            for (const Node* part : parts)
                choices.push_back(part->title.empty() ? joined(part->required, " and ") : part->title);
            return Words("found " + described(value) + "; " + expected(node) + " has " +
                             (&parts == &node.oneOf ? "exactly one of: " : "at least one of: ") + joined(choices),
                         "correct its members");
        });
    }
};

std::optional<JsonMistake> JsonSchema::check(const json& value) const {
    JsonMistake mistake;
    if (Check{&mistake}.valid(*root_, value, JsonPlace{})) return std::nullopt;
    return mistake;
}

}  // namespace voledit
