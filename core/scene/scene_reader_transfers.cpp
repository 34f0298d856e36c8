// STFs of a scene file.
#include <algorithm>

#include "core/base/error.h"
#include "core/scene/json_schema.h"
#include "core/scene/limits.h"
#include "core/scene/scene_reader.h"
#include "core/stf/transfer_definition.h"

namespace voledit {

Transfer SceneReader::transfer(const JsonView& view) {
    Transfer result;
    if (view.has("use") && !view.has("type")) {
        transferUses_.push_back({view["use"].text(), view["use"].place.pointer()});
        result.kind = TransferUse{transferUses_.back().name};
        return result;
    }
    const auto& type = view.value["type"];
    if (type == "affine")
        result.kind = AffineTransfer{placement(view)};
    else if (type == "ffd")
        result.kind = lattice(view);
    else if (type == "expression")
        result.kind = expression(view);
    else if (type == "fields")
        result.kind = fieldsTransfer(view);
    else if (type == "sequence")
        result.kind = SequenceTransfer{transferList(view["of"])};
    else if (type == "transferred")
        result.kind = TransferredTransfer{transfer(view["by"]), transfer(view["of"])};
    else if (type == "mapped")
        result.kind = mapped(view);
    else if (type == "skeleton")
        result.kind = skeletonTransfer(view);
    else if (type == "sweep")
        notBuilt(view["type"].place, "transfers of type " + described(type), "use other types");
    else
        result.kind = libraryOrFile(view);
    if (view.has("name")) result.name = view["name"].text();
    if (view.has("frame")) result.frame = frame(view["frame"]);
    if (view.has("outside")) result.outside = view.value["outside"] == "keep" ? Outside::Keep : Outside::Hide;
    if (view.has("enabled")) result.enabled = view.value["enabled"].get<bool>();
    if (view.has("amount")) result.amount = number(view["amount"]);
    return result;
}

std::vector<TransferRef> SceneReader::transferList(const JsonView& view) {
    if (view.value.size() > kDeepestNesting)
        fail(view.place,
             "found " + described(view.value) + "; a list of STFs has at most " + std::to_string(kDeepestNesting),
             "join some of them");
    std::vector<TransferRef> result;
    for (std::size_t i = 0; i < view.value.size(); ++i) result.emplace_back(transfer(view[i]));
    return result;
}

LibraryTransfer SceneReader::libraryOrFile(const JsonView& view) const {
    LibraryTransfer result;
    const JsonView type = view["type"];
    result.isFile = type.value.is_object();
    result.definition = result.isFile ? type["file"].text() : type.text();
    if (result.isFile) checkPath(type["file"]);
    const TransferDefinitionPtr definition = result.isFile ? nullptr : libraryTransfer(result.definition);
    if (!result.isFile && !definition) {
        std::vector<std::string> known{"affine", "expression", "fields",   "ffd",        "sweep",
                                       "mapped", "skeleton",   "sequence", "transferred"};
        std::string list = "expression, fields, ffd, mapped, sequence, skeleton, transferred";
        for (const auto& one : transferLibrary()) {
            known.push_back(one->name());
            list += ", " + one->name();
        }
        failUnknown(type, "found " + described(type.value) + ", which is no type of transfer that voledit knows", known,
                    "use one of: " + list);
    }
    static const std::vector<std::string> common{"type", "name", "frame", "outside", "enabled", "amount"};
    std::vector<std::string> parameters;
    if (definition)
        for (const auto& parameter : definition->parameters()) parameters.push_back(parameter.name);
    for (auto member = view.value.begin(); member != view.value.end(); ++member) {
        const std::string& name = member.key();
        if (std::find(common.begin(), common.end(), name) != common.end()) continue;
        const JsonView value{member.value(), view.place.at(name)};
        if (definition && !definition->find(name)) {
            const std::string nearest = nearestName(name, parameters);
            fail(value.place, described(type.value) + " has no parameter of this name",
                 nearest.empty() ? "remove it" : "did you mean \"" + nearest + "\"?");
        }
        result.arguments[name] = argument(value);
    }
    if (definition)
        for (const auto& parameter : definition->parameters())
            if (!parameter.initial && !result.arguments.contains(parameter.name))
                fail(view.place, "\"" + parameter.name + "\" is missing", "add it: " + parameter.description);
    return result;
}

LibraryTransfer::Argument SceneReader::argument(const JsonView& view) const {
    const auto axis = [](const nlohmann::json& word) { return word.get_ref<const std::string&>()[0] - 'x'; };
    if (view.value.is_string()) return LibraryTransfer::Axes{{axis(view.value)}, false};
    if (view.value.is_array() && view.value[0].is_string()) {
        LibraryTransfer::Axes axes{{}, true};
        for (const auto& word : view.value) axes.axes.push_back(axis(word));
        return axes;
    }
    if (view.value.is_object() && view.has("point"))
        return LibraryTransfer::Line{vector(view["point"]), direction(view["direction"])};
    return numbers(view);
}

ExpressionTransfer SceneReader::expression(const JsonView& view) const {
    ExpressionTransfer result;
    ExpressionUse use;
    if (view.has("let")) {
        const JsonView lets = view["let"];
        for (std::size_t i = 0; i < lets.value.size(); ++i) {
            use.lets.push_back({lets[i][0].text(), formulaText(lets[i][1])});
            result.let.emplace_back(lets[i][0].text(), lets[i][1].text());
        }
    }
    use.x = formulaText(view["x"]);
    use.y = formulaText(view["y"]);
    use.z = formulaText(view["z"]);
    if (view.has("undefined")) use.undefined = formulaText(view["undefined"]);
    use.world = result.world = view.has("space") && view.value["space"] == "world";
    makeExpressionMap(use);  // finds mistakes
    result.x = use.x.text;
    result.y = use.y.text;
    result.z = use.z.text;
    if (use.undefined) result.undefined = use.undefined->text;
    if (view.has("image")) result.image = frame(view["image"]);
    return result;
}

FieldsTransfer SceneReader::fieldsTransfer(const JsonView& view) {
    FieldsTransfer result;
    if (view.has("asset"))
        result.asset = volumeAsset(view["asset"]);
    else
        result.fields = fields(view);
    if (view.has("displacement")) result.displacement = view.value["displacement"].get<bool>();
    return result;
}

}  // namespace voledit
