// Reading a schema.
#include "core/scene/json_schema.h"

#include <functional>
#include <map>
#include <unordered_map>

#include "core/base/error.h"
#include "core/scene/json_schema_node.h"

namespace voledit {

using nlohmann::ordered_json;

struct JsonSchema::Reader {
    std::vector<std::unique_ptr<Node>>& nodes;
    std::map<std::string, const Node*> definitions = {};

    const Node* read(const ordered_json& schema) {
        Node& node = *nodes.emplace_back(std::make_unique<Node>());
        if (schema.is_boolean()) {
            node.never = !schema.get<bool>();
            return &node;
        }
        for (const auto& item : schema.items()) {
            const auto known = keywords().find(item.key());
            if (known == keywords().end())
                throw Error("schema", "keyword \"" + item.key() + "\" is not understood", "use draft 7's common ones");
            known->second(*this, node, item.value());
        }
        return &node;
    }

    std::vector<const Node*> readList(const ordered_json& list) {
        std::vector<const Node*> result;
        for (const auto& schema : list) result.push_back(read(schema));
        return result;
    }

    void resolveReferences() {
        for (const auto& node : nodes) {
            if (node->reference.empty()) continue;
            const auto found = definitions.find(node->reference);
            if (found == definitions.end()) throw Error("schema", "no definition " + node->reference, "define it");
            node->target = found->second;
        }
    }

private:
    using Keyword = std::function<void(Reader&, Node&, const ordered_json&)>;

    static unsigned typeNamed(const std::string& name) {
        static const std::unordered_map<std::string, unsigned> types{
            {"null", kNull},     {"boolean", kBoolean}, {"integer", kInteger}, {"number", kNumber},
            {"string", kString}, {"array", kArray},     {"object", kObject}};
        return types.at(name);
    }

    template <class T>
    static Keyword number(std::optional<T> Node::*member) {
        return [member](Reader&, Node& node, const ordered_json& value) { node.*member = value.get<T>(); };
    }
    static Keyword schema(const Node* Node::*member) {
        return [member](Reader& reader, Node& node, const ordered_json& value) { node.*member = reader.read(value); };
    }
    static Keyword schemas(std::vector<const Node*> Node::*member) {
        return
            [member](Reader& reader, Node& node, const ordered_json& value) { node.*member = reader.readList(value); };
    }

    static const std::unordered_map<std::string, Keyword>& keywords() {
        static const Keyword nothing = [](Reader&, Node&, const ordered_json&) {};
        static const std::unordered_map<std::string, Keyword> all{
            {"$schema", nothing},
            {"description", nothing},
            {"default", nothing},
            {"title", [](Reader&, Node& node, const ordered_json& value) { node.title = value.get<std::string>(); }},
            {"definitions", readDefinitions},
            {"$ref", readReference},
            {"type", readTypes},
            {"const", [](Reader&, Node& node, const ordered_json& value) { node.values = {value}; }},
            {"enum",
             [](Reader&, Node& node, const ordered_json& value) {
                 node.values = {value.begin(), value.end()};
             }},
            {"minimum", number(&Node::minimum)},
            {"maximum", number(&Node::maximum)},
            {"exclusiveMinimum", number(&Node::exclusiveMinimum)},
            {"exclusiveMaximum", number(&Node::exclusiveMaximum)},
            {"minLength", number(&Node::minLength)},
            {"maxLength", number(&Node::maxLength)},
            {"minItems", number(&Node::minItems)},
            {"maxItems", number(&Node::maxItems)},
            {"minProperties", number(&Node::minProperties)},
            {"maxProperties", number(&Node::maxProperties)},
            {"uniqueItems", [](Reader&, Node& node, const ordered_json& value) { node.uniqueItems = value; }},
            {"required", [](Reader&, Node& node, const ordered_json& value) { value.get_to(node.required); }},
            {"properties", readProperties},
            {"additionalProperties", schema(&Node::additional)},
            {"propertyNames", schema(&Node::propertyNames)},
            {"items", readItems},
            {"if", schema(&Node::condition)},
            {"then", schema(&Node::then)},
            {"else", schema(&Node::otherwise)},
            {"allOf", schemas(&Node::allOf)},
            {"anyOf", schemas(&Node::anyOf)},
            {"oneOf", schemas(&Node::oneOf)},
            {"not", schema(&Node::negated)}};
        return all;
    }

    static void readDefinitions(Reader& reader, Node&, const ordered_json& value) {
        for (const auto& item : value.items()) reader.definitions[item.key()] = reader.read(item.value());
    }
    static void readReference(Reader&, Node& node, const ordered_json& value) {
        const std::string prefix = "#/definitions/", reference = value;
        if (reference.rfind(prefix, 0) != 0) throw Error("schema", "reference " + reference, "refer to definitions");
        node.reference = reference.substr(prefix.size());
    }
    static void readTypes(Reader&, Node& node, const ordered_json& value) {
        if (value.is_string()) node.types = typeNamed(value);
        if (value.is_array())
            for (const auto& type : value) node.types |= typeNamed(type);
    }
    static void readProperties(Reader& reader, Node& node, const ordered_json& value) {
        for (const auto& item : value.items()) node.properties.emplace_back(item.key(), reader.read(item.value()));
    }
    static void readItems(Reader& reader, Node& node, const ordered_json& value) {
        if (value.is_array())
            node.tuple = reader.readList(value);
        else
            node.items = reader.read(value);
    }
};

JsonSchema::JsonSchema(const ordered_json& schema) {
    Reader reader{nodes_};
    try {
        root_ = reader.read(schema);
    } catch (const ordered_json::exception& error) {
        throw Error("schema", error.what(), "mend it");
    }
    reader.resolveReferences();
}

JsonSchema::~JsonSchema() = default;

}  // namespace voledit
