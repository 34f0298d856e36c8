#pragma once
// Checking JSON against a schema, with messages for people.

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace voledit {

/// What is wrong with a JSON value, and where.
struct JsonMistake {
    std::string pointer;  // JSON pointer
    std::string what;     // what was found and what was expected
    std::string remedy;   // what to do
};

/// A JSON Schema of draft 7 without `pattern`, `format`, `dependencies`, `contains` and references to other files. A
/// schema's `title` is a noun phrase ("a vector [x, y, z]") and says in messages what was expected.
class JsonSchema {
public:
    /// Throws Error for a keyword that is not understood or a reference to nothing.
    explicit JsonSchema(const nlohmann::ordered_json& schema);
    ~JsonSchema();

    /// The first mistake in `value`, or nullopt where it is valid. Needs memory for the path to the mistake only, and
    /// a stack frame or five for each level that `value` is nested.
    std::optional<JsonMistake> check(const nlohmann::json& value) const;

private:
    struct Node;
    struct Reader;
    struct Check;
    std::vector<std::unique_ptr<Node>> nodes_;
    const Node* root_ = nullptr;
};

/// The one of `names` that `name` is probably a slip of; "" where none is near.
std::string nearestName(const std::string& name, const std::vector<std::string>& names);

/// A value in a few words, for messages: `"abc"`, `12`, `a list of 4`, `an object with use`.
std::string described(const nlohmann::json& value);

}  // namespace voledit
