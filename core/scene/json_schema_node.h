#pragma once
// One schema of a JsonSchema, read once so that checking needs no look-ups. For json_schema*.cpp alone.

#include <nlohmann/json.hpp>
#include <vector>

#include "core/scene/json_schema.h"

namespace voledit {

enum JsonType : unsigned {
    kNull = 1,
    kBoolean = 2,
    kInteger = 4,
    kNumber = 8,
    kString = 16,
    kArray = 32,
    kObject = 64
};

struct JsonSchema::Node {
    std::string title;
    bool never = false;            // the schema `false`
    std::string reference;         // name below #/definitions/, or empty
    const Node* target = nullptr;  // what `reference` names
    unsigned types = 0;            // JsonType bits; 0: any

    std::vector<nlohmann::json> values;  // of enum or const; empty: any
    std::optional<double> minimum, maximum, exclusiveMinimum, exclusiveMaximum;
    std::optional<std::size_t> minLength, maxLength, minItems, maxItems, minProperties, maxProperties;
    bool uniqueItems = false;

    std::vector<std::string> required;
    std::vector<std::pair<std::string, const Node*>> properties;
    const Node* additional = nullptr;     // additionalProperties; null: anything
    const Node* propertyNames = nullptr;  // null: anything
    const Node* items = nullptr;          // of every element; null: anything
    std::vector<const Node*> tuple;       // of the first elements

    const Node *condition = nullptr, *then = nullptr, *otherwise = nullptr;
    std::vector<const Node*> allOf, anyOf, oneOf;
    const Node* negated = nullptr;

    const Node* property(const std::string& name) const {
        for (const auto& [known, node] : properties)
            if (known == name) return node;
        return nullptr;
    }
};

}  // namespace voledit
