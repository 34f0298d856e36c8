// Forward maps of a scene file: lattices and mapped cells.
#include "core/scene/json_schema.h"
#include "core/scene/limits.h"
#include "core/scene/scene_reader.h"

namespace voledit {

void SceneReader::countCells(double more, const JsonPlace& place) {
    cells_ += more;
    if (cells_ > double(kMostCells))
        fail(place,
             "the scene's lattices and limbs have " + std::to_string(std::uint64_t(cells_)) + " cells, more than the " +
                 std::to_string(kMostCells) + " that fit",
             "give fewer cells an axis (16 is the default)");
}

FfdTransfer SceneReader::lattice(const JsonView& view) {
    FfdTransfer ffd;
    if (view.has("basis") && view.value["basis"] == "bspline") {
        ffd.basis = LatticeBasis::BSpline;
        ffd.points = indices(view["points"]);
    } else if (view.has("degree")) {
        ffd.points = indices(view["degree"]) + Index3(1);
    }
    if (view.has("cells")) ffd.cells = indices(view["cells"]);
    countCells(double(ffd.cells.x) * ffd.cells.y * ffd.cells.z, view.has("cells") ? view["cells"].place : view.place);
    controlPoints_ += double(ffd.points.x) * ffd.points.y * ffd.points.z;
    if (controlPoints_ > double(kMostControlPoints))
        fail(view.place,
             "the scene's lattices have more than the " + std::to_string(kMostControlPoints) +
                 " control points that fit",
             "give fewer points an axis");
    if (view.has("control")) readControl(ffd, view["control"]);
    if (view.has("move")) readMoves(ffd, view["move"]);
    return ffd;
}

void SceneReader::readControl(FfdTransfer& ffd, const JsonView& view) const {
    const auto count = std::size_t(ffd.points.x) * std::size_t(ffd.points.y) * std::size_t(ffd.points.z);
    const auto& list = view.value.is_object() ? view.value["keys"][0][1] : view.value;
    if (list.size() != count)
        fail(view.place,
             "found " + described(list) + "; a lattice of " + std::to_string(ffd.points.x) + " × " +
                 std::to_string(ffd.points.y) + " × " + std::to_string(ffd.points.z) + " control points has " +
                 std::to_string(count),
             "list every control point, i fastest, or use `move`");
    if (view.value.is_array()) {
        for (std::size_t i = 0; i < count; ++i) ffd.moves[i] = {vector(view[i]), true};
        return;
    }
    static constexpr int shape[] = {kAny, 3};
    const Track all = track(view, shape);
    for (std::size_t i = 0; i < count; ++i) {
        Track one{{}, all.interpolation};
        for (const auto& key : all.keys) {
            const auto first = key.value.begin() + std::ptrdiff_t(3 * i);
            one.keys.push_back({key.time, {first, first + 3}, key.interpolation});
        }
        FfdTransfer::Move& move = ffd.moves[i];
        move.absolute = true;
        move.vector.setTracks({{PartTrack::kWhole, std::move(one)}});
    }
}

void SceneReader::readMoves(FfdTransfer& ffd, const JsonView& view) const {
    for (std::size_t m = 0; m < view.value.size(); ++m) {
        const JsonView move = view[m];
        const JsonView at = move["point"];
        const Index3 point = indices(at);
        for (std::size_t a = 0; a < 3; ++a)
            if (point[int(a)] >= ffd.points[int(a)])
                fail(at[a].place,
                     "found " + std::to_string(point[int(a)]) + "; the lattice has control points 0 to " +
                         std::to_string(ffd.points[int(a)] - 1) + " along " + "xyz"[a],
                     "name a point within it");
        const auto index =
            std::size_t(point.x) +
            std::size_t(ffd.points.x) * (std::size_t(point.y) + std::size_t(ffd.points.y) * std::size_t(point.z));
        const bool absolute = move.has("to");
        if (!ffd.moves.try_emplace(index, FfdTransfer::Move{vector(move[absolute ? "to" : "by"]), absolute}).second)
            fail(move.place, "this control point is moved twice", "join the two moves");
    }
}

MappedTransfer SceneReader::mapped(const JsonView& view) {
    MappedTransfer result;
    result.points = vectors(view["points"]);
    result.source = vectors(view["source"]);
    const std::size_t count = result.points->size();
    if (result.source->size() != count)
        fail(view["source"].place,
             "it has " + std::to_string(result.source->size()) + " vectors, `points` " + std::to_string(count),
             "give every point its source coordinate");
    const JsonView cells = view["cells"];
    countCells(double(cells.value.size()), cells.place);
    result.cells.resize(cells.value.size());
    for (std::size_t c = 0; c < result.cells.size(); ++c)
        for (std::size_t v = 0; v < 8; ++v) {
            result.cells[c][v] = cells.value[c][v].get<std::uint32_t>();
            if (result.cells[c][v] >= count)
                fail(cells[c][v].place,
                     "found vertex " + std::to_string(result.cells[c][v]) + " of " + std::to_string(count) + " points",
                     "vertices are counted from 0");
        }
    return result;
}

}  // namespace voledit
