// Scalar fields, STFs and SD objects as JSON.
#include <algorithm>

#include "core/scene/scene_to_json.h"
#include "core/stf/transfer_definition.h"

namespace voledit {

namespace {

using nlohmann::ordered_json;
using voledit::toJson;

constexpr const char* kAxes[] = {"x", "y", "z"};

/// Adds members x, y, z.
void addFields(ordered_json& object, const std::array<FieldRef, 3>& fields) {
    for (std::size_t a = 0; a < 3; ++a) object[kAxes[a]] = toJson(*fields[a]);
}

// ---- scalar fields

ordered_json toJson(const NumberField& field) {
    return toJson(field.value);
}
ordered_json toJson(const FormulaField& field) {
    return {{"expression", field.expression}};
}
ordered_json toJson(const ComponentOf& field) {
    return {{"component", kAxes[field.axis]}, {"of", std::visit([](const auto& of) { return toJson(*of); }, field.of)}};
}
ordered_json toJson(const AttributeOf& field) {
    return {{"attribute", field.name}, {"of", toJson(*field.of)}};
}
ordered_json toJson(const AssetField& field) {
    ordered_json result{{"asset", field.asset}};
    if (field.channel != 0) result["channel"] = field.channel;
    return result;
}
ordered_json toJson(const MappedField& field) {
    return {{"map", toJson(field.table)}, {"of", toJson(*field.of)}};
}

// ---- lattices

using Moves = std::map<std::size_t, FfdTransfer::Move>;

/// Whether all moves are whole tracks with the same times and interpolation.
bool moveTogether(const Moves& moves) {
    const Track* first = nullptr;
    for (const auto& [point, move] : moves) {
        const auto& tracks = move.vector.tracks();
        if (tracks.size() != 1 || tracks[0].part != PartTrack::kWhole) return false;
        const Track& track = tracks[0].track;
        if (!first) first = &track;
        const auto sameTime = [](const auto& a, const auto& b) {
            return a.time == b.time && a.interpolation == b.interpolation;
        };
        if (track.interpolation != first->interpolation ||
            !std::equal(track.keys.begin(), track.keys.end(), first->keys.begin(), first->keys.end(), sameTime))
            return false;
    }
    return first != nullptr;
}

/// Positions of all points, with one track where they move together.
Tracked<std::vector<Vec3>> controlOf(const Moves& moves) {
    std::vector<Vec3> positions;
    positions.reserve(moves.size());
    for (const auto& [point, move] : moves) positions.push_back(move.vector);
    Tracked<std::vector<Vec3>> control(std::move(positions));
    std::vector<PartTrack> tracks;
    if (moveTogether(moves)) {
        tracks.push_back({PartTrack::kWhole, moves.begin()->second.vector.tracks()[0].track});
        for (auto& key : tracks[0].track.keys) key.value.clear();
        for (const auto& [point, move] : moves) {
            const auto& keys = move.vector.tracks()[0].track.keys;
            for (std::size_t k = 0; k < keys.size(); ++k) {
                auto& value = tracks[0].track.keys[k].value;
                value.insert(value.end(), keys[k].value.begin(), keys[k].value.end());
            }
        }
    } else {
        int first = 0;
        for (const auto& [point, move] : moves) {
            for (const PartTrack& track : move.vector.tracks())
                tracks.push_back({first + std::max(track.part, 0), track.track});
            first += 3;
        }
    }
    control.setTracks(std::move(tracks));
    return control;
}

/// `control` where every point has a position of its own, else `move` for those that are not at rest.
void addPoints(ordered_json& object, const FfdTransfer& ffd) {
    const auto count = std::size_t(ffd.points.x) * std::size_t(ffd.points.y) * std::size_t(ffd.points.z);
    bool positions = ffd.moves.size() == count;
    for (const auto& [point, move] : ffd.moves) positions = positions && move.absolute;
    if (positions) {
        object["control"] = toJson(controlOf(ffd.moves));
        return;
    }
    ordered_json list = ordered_json::array();
    const auto nx = std::size_t(ffd.points.x), ny = std::size_t(ffd.points.y);
    for (const auto& [point, move] : ffd.moves)
        list.push_back({{"point", {point % nx, point / nx % ny, point / nx / ny}},
                        {move.absolute ? "to" : "by", toJson(move.vector)}});
    if (!list.empty()) object["move"] = std::move(list);
}

// ---- STFs: what stands between `name` and `frame`

void add(ordered_json& object, const AffineTransfer& transfer) {
    add(object, transfer.placement);
}
void add(ordered_json& object, const FfdTransfer& ffd) {
    const bool bezier = ffd.basis == LatticeBasis::Bezier;
    object["basis"] = bezier ? "bezier" : "bspline";
    object[bezier ? "degree" : "points"] = toJson(bezier ? ffd.points - Index3(1) : ffd.points);
    addPoints(object, ffd);
    object["cells"] = toJson(ffd.cells);
}

ordered_json toJson(const LibraryTransfer::Line& line) {
    return {{"point", toJson(line.point)}, {"direction", toJson(line.direction)}};
}
ordered_json toJson(const LibraryTransfer::Axes& axes) {
    if (!axes.list) return kAxes[axes.axes.at(0)];
    ordered_json list = ordered_json::array();
    for (const int axis : axes.axes) list.push_back(kAxes[axis]);
    return list;
}
/// In the order of the definition, where that is known.
void add(ordered_json& object, const LibraryTransfer& transfer) {
    std::map<std::string, LibraryTransfer::Argument> rest = transfer.arguments;
    const auto write = [&](const auto& named) {
        object[named.first] = std::visit([](const auto& value) { return toJson(value); }, named.second);
    };
    const TransferDefinitionPtr definition = transfer.isFile ? nullptr : libraryTransfer(transfer.definition);
    if (definition)
        for (const auto& parameter : definition->parameters())
            if (const auto named = rest.extract(parameter.name)) write(std::pair(named.key(), named.mapped()));
    for (const auto& named : rest) write(named);
}

void add(ordered_json& object, const ExpressionTransfer& transfer) {
    object["x"] = transfer.x;
    object["y"] = transfer.y;
    object["z"] = transfer.z;
    if (!transfer.undefined.empty()) object["undefined"] = transfer.undefined;
    if (!transfer.let.empty()) {
        ordered_json& lets = object["let"] = ordered_json::array();
        for (const auto& [name, formula] : transfer.let) lets.push_back({name, formula});
    }
    if (transfer.world) object["space"] = "world";
    if (transfer.image) object["image"] = toJson(*transfer.image);
}

void add(ordered_json& object, const FieldsTransfer& transfer) {
    if (transfer.asset.empty())
        addFields(object, transfer.fields);
    else
        object["asset"] = transfer.asset;
    if (transfer.displacement) object["displacement"] = true;
}

void add(ordered_json& object, const SequenceTransfer& transfer) {
    object["of"] = listToJson(transfer.of);
}
void add(ordered_json& object, const TransferredTransfer& transfer) {
    object["by"] = toJson(*transfer.by);
    object["of"] = toJson(*transfer.of);
}

void add(ordered_json& object, const MappedTransfer& transfer) {
    object["points"] = toJson(transfer.points);
    object["source"] = toJson(transfer.source);
    ordered_json& cells = object["cells"] = ordered_json::array();
    for (const auto& cell : transfer.cells) cells.push_back(cell);
}

void add(ordered_json& object, const SkeletonTransfer& transfer) {
    object["limb"] = transfer.limb;
    add(object, transfer.rig);
}

void add(ordered_json&, const TransferUse&) {}

ordered_json typeOf(const Transfer& transfer) {
    if (const auto* library = std::get_if<LibraryTransfer>(&transfer.kind)) {
        if (library->isFile) return {{"file", library->definition}};
        return library->definition;
    }
    static constexpr const char* words[] = {"affine",   "ffd",         "",       "",        "expression", "fields",
                                            "sequence", "transferred", "mapped", "skeleton"};
    static_assert(std::size(words) == std::variant_size_v<decltype(Transfer::kind)>);
    return words[transfer.kind.index()];
}

// ---- SD objects

ordered_json toJson(const DisplacementUse& use) {
    return {{"use", use.name}};
}
ordered_json toJson(const OfDisplacement& of) {
    return {{"type", "of"}, {"transfer", toJson(*of.transfer)}};
}
ordered_json toJson(const ScaleDisplacement& scale) {
    return {{"type", "scale"}, {"by", toJson(*scale.by)}, {"of", toJson(*scale.of)}};
}
ordered_json toJson(const CombinedDisplacement& combined) {
    static constexpr const char* words[] = {"sum", "union", "intersection"};
    return {{"type", words[std::size_t(combined.kind)]}, {"of", listToJson(combined.of)}};
}
ordered_json toJson(const BlendDisplacement& blend) {
    ordered_json of = ordered_json::array();
    of.push_back(toJson(*blend.first));
    of.push_back(toJson(*blend.second));
    return {{"type", "blend"}, {"weight", toJson(*blend.weight)}, {"of", std::move(of)}};
}
ordered_json toJson(const FieldsDisplacement& fields) {
    ordered_json result{{"type", "fields"}};
    addFields(result, fields.fields);
    return result;
}

}  // namespace

ordered_json toJson(const Field& field) {
    return std::visit([](const auto& kind) { return toJson(kind); }, field.kind);
}

ordered_json toJson(const Transfer& transfer) {
    if (const auto* use = std::get_if<TransferUse>(&transfer.kind)) return {{"use", use->name}};
    ordered_json result{{"type", typeOf(transfer)}};
    if (!transfer.name.empty()) result["name"] = transfer.name;
    std::visit([&](const auto& kind) { add(result, kind); }, transfer.kind);
    if (transfer.frame) result["frame"] = toJson(*transfer.frame);
    if (transfer.outside) result["outside"] = *transfer.outside == Outside::Keep ? "keep" : "hide";
    if (!transfer.enabled) result["enabled"] = false;
    if (transfer.amount != Tracked<double>(1)) result["amount"] = toJson(transfer.amount);
    return result;
}

ordered_json toJson(const Displacement& displacement) {
    return std::visit([](const auto& kind) { return toJson(kind); }, displacement.kind);
}

}  // namespace voledit
