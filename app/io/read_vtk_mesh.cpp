// Meshes in legacy VTK files: curvilinear and rectilinear grids, unstructured grids of cells that fill a volume.

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "app/io/checks.h"
#include "app/io/readers.h"
#include "app/io/split_cells.h"
#include "app/io/vtk_values.h"
#include "core/base/error.h"

namespace voledit {

namespace {

// Bits of the arrays "vtkGhostType": points and cells that are not to be seen.
constexpr std::uint32_t kHiddenPoint = 2, kHiddenCell = 32;

class MeshReader {
public:
    MeshReader(const VtkFile& file, VolumeSink& sink) : file_(file), name_(file.source.name), sink_(sink) {}

    void read() {
        file_.dataset == VtkDataset::RectilinearGrid ? readAxes() : readPoints();
        readHidden();
        chooseValues();
        file_.dataset == VtkDataset::UnstructuredGrid ? readCells() : makeGridCells();
        finishValues();
        sink_.take(name_, std::move(mesh_), std::string(nameOf(values_->type)));
    }

private:
    // ---- Points

    void readPoints() {
        if (!file_.points) throw Error(name_, "has no POINTS", "the file is cut off: copy or save it anew");
        if (file_.dataset == VtkDataset::StructuredGrid) checkGrid(file_.points->tuples);
        const std::vector<double> numbers = readReals(file_, *file_.points, sink_);
        mesh_.points.resize(numbers.size() / 3);
        for (std::size_t v = 0; v < mesh_.points.size(); ++v)
            mesh_.points[v] = {numbers[3 * v], numbers[3 * v + 1], numbers[3 * v + 2]};
        checkPoints();
    }

    /// Points of a rectilinear grid.
    void readAxes() {
        std::array<std::vector<double>, 3> axis;
        for (std::size_t a = 0; a < 3; ++a) {
            const auto& array = file_.coordinates[a];
            if (!array || array->tuples != file_.dimensions[a])
                throw Error(name_, "its coordinates do not fit its DIMENSIONS", "correct the header");
            axis[a] = readReals(file_, *array, sink_);
        }
        const auto& n = file_.dimensions;
        checkGrid(checkProduct(name_, {n[0], n[1], n[2]}));
        // Three short lists can claim more points than there is memory for; the values are in the file.
        const VtkArray *ofPoints = mainArray(file_.pointData), *ofCells = mainArray(file_.cellData);
        if (!ofPoints && !ofCells) throwNoValues();
        if (ofPoints ? ofPoints->tuples != n[0] * n[1] * n[2] : ofCells->tuples != (n[0] - 1) * (n[1] - 1) * (n[2] - 1))
            throw Error(name_, "its values do not fit its DIMENSIONS", "correct the header");
        for (const double z : axis[2])
            for (const double y : axis[1])
                for (const double x : axis[0]) mesh_.points.push_back({x, y, z});
        checkPoints();
    }

    void checkGrid(std::uint64_t points) const {
        const auto& n = file_.dimensions;
        checkSizes(name_ + ", DIMENSIONS", n, 1);
        if (points != checkProduct(name_, {n[0], n[1], n[2]}))
            throw Error(name_, "has " + std::to_string(points) + " points, which do not fit its DIMENSIONS",
                        "correct the header");
        if (n[0] < 2 || n[1] < 2 || n[2] < 2)
            throw Error(name_, "is a grid of one layer of points, without an inside",
                        "give a grid of two points or more along each axis");
    }

    void checkPoints() const {
        for (std::size_t v = 0; v < mesh_.points.size(); ++v)
            if (const Vec3& p = mesh_.points[v]; !std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
                throw Error(name_, "point " + std::to_string(v) + " is not finite", "correct its coordinates");
        if (mesh_.points.size() >= std::numeric_limits<std::uint32_t>::max())
            throw Error(name_, "has more than 2^32 - 2 points", "split or thin the mesh");
    }

    // ---- What is hidden

    void readHidden() {
        if (file_.visible) {
            const auto visible = readIndices(file_, *file_.visible, sink_);
            if (visible.size() != mesh_.points.size())
                throw Error(name_, "BLANKING does not fit the number of points", "correct the header");
            for (std::size_t v = 0; v < visible.size(); ++v)
                if (visible[v] == 0) hidePoint(v);
        }
        for (const VtkArray& array : file_.pointData) {
            if (array.name != "vtkGhostType" || array.count() != mesh_.points.size()) continue;
            const auto flags = readIndices(file_, array, sink_);
            for (std::size_t v = 0; v < flags.size(); ++v)
                if (flags[v] & kHiddenPoint) hidePoint(v);
        }
        for (const VtkArray& array : file_.cellData)
            if (array.name == "vtkGhostType") cellFlags_ = readIndices(file_, array, sink_);
    }
    void hidePoint(std::size_t v) {
        hiddenPoints_.resize(mesh_.points.size());
        hiddenPoints_[v] = true;
    }
    bool hidden(std::size_t cell, std::span<const std::uint32_t> vertices) const {
        if (cell < cellFlags_.size() && (cellFlags_[cell] & kHiddenCell)) return true;
        return !hiddenPoints_.empty() &&
               std::ranges::any_of(vertices, [&](std::uint32_t v) { return hiddenPoints_[v]; });
    }

    // ---- Cells

    void makeGridCells() {
        const auto& n = file_.dimensions;
        checkMemory(checkProduct(name_, {n[0] - 1, n[1] - 1, n[2] - 1, 32}));
        const auto at = [&](std::uint64_t i, std::uint64_t j, std::uint64_t k) {
            return std::uint32_t(i + n[0] * (j + n[1] * k));
        };
        std::size_t cell = 0;
        for (std::uint64_t k = 0; k + 1 < n[2]; ++k)
            for (std::uint64_t j = 0; j + 1 < n[1]; ++j)
                for (std::uint64_t i = 0; i + 1 < n[0]; ++i, ++cell) {
                    const std::array<std::uint32_t, 8> vertices{
                        at(i, j, k),     at(i + 1, j, k),     at(i, j + 1, k),     at(i + 1, j + 1, k),
                        at(i, j, k + 1), at(i + 1, j, k + 1), at(i, j + 1, k + 1), at(i + 1, j + 1, k + 1)};
                    if (hidden(cell, vertices)) continue;
                    mesh_.hexahedra.push_back(vertices);
                    gather(cell, vertices);
                }
        if (mesh_.hexahedra.empty()) throw Error(name_, "all its cells are hidden", "save it with visible cells");
        cellCount_ = cell;
    }

    void readCells() {
        if (!file_.cellTypes) throw Error(name_, "has no CELL_TYPES", "the file is cut off: copy or save it anew");
        const auto types = readIndices(file_, *file_.cellTypes, sink_);
        std::map<std::uint32_t, std::size_t> skipped;
        const auto take = [&](std::size_t cell, std::span<const std::uint32_t> vertices) {
            const std::size_t expected = verticesOfCell(types[cell]);
            if (expected == 0) {
                ++skipped[types[cell]];
                return;
            }
            checkVertices(cell, types[cell], vertices);
            if (hidden(cell, vertices)) return;
            appendTetrahedra(types[cell], vertices, mesh_.tetrahedra);
            gather(cell, vertices);
        };
        file_.offsets ? forCellsByOffsets(types.size(), take) : forCellsInList(types.size(), take);
        cellCount_ = types.size();
        if (!skipped.empty() || mesh_.tetrahedra.empty()) tellSkipped(skipped);
    }

    template <class Take>
    void forCellsByOffsets(std::size_t count, const Take& take) {
        const auto offsets = readIndices(file_, *file_.offsets, sink_);
        const auto connectivity = readIndices(file_, *file_.connectivity, sink_);
        if (count != file_.cellCount) throwCellCount();
        for (std::size_t c = 0; c < count; ++c) {
            if (offsets[c] > offsets[c + 1] || offsets[c + 1] > connectivity.size())
                throw Error(name_, "the points of cell " + std::to_string(c) + " are not where OFFSETS says",
                            "save the file anew");
            take(c, std::span(connectivity).subspan(offsets[c], offsets[c + 1] - offsets[c]));
        }
    }

    template <class Take>
    void forCellsInList(std::size_t count, const Take& take) {
        if (!file_.cells) throw Error(name_, "has no CELLS", "the file is cut off: copy or save it anew");
        const auto list = readIndices(file_, *file_.cells, sink_);
        if (count != file_.cellCount) throwCellCount();
        std::size_t at = 0;
        for (std::size_t c = 0; c < count; ++c) {
            if (at >= list.size() || list[at] > list.size() - at - 1)
                throw Error(name_, "CELLS ends within cell " + std::to_string(c), "correct its sizes");
            take(c, std::span(list).subspan(at + 1, list[at]));
            at += 1 + list[at];
        }
    }

    [[noreturn]] void throwCellCount() const {
        throw Error(name_,
                    "has " + std::to_string(file_.cellCount) + " CELLS, but CELL_TYPES of " +
                        std::to_string(file_.cellTypes->tuples),
                    "correct the sizes");
    }

    void checkVertices(std::size_t cell, std::uint32_t type, std::span<const std::uint32_t> vertices) const {
        if (vertices.size() != verticesOfCell(type))
            throw Error(name_,
                        "cell " + std::to_string(cell) + " of type " + std::to_string(type) + " has " +
                            std::to_string(vertices.size()) + " points, not " + std::to_string(verticesOfCell(type)),
                        "correct the cell");
        for (const std::uint32_t v : vertices)
            if (v >= mesh_.points.size())
                throw Error(name_,
                            "cell " + std::to_string(cell) + " names point " + std::to_string(v) + " of " +
                                std::to_string(mesh_.points.size()),
                            "correct the cell: points count from 0");
    }

    void tellSkipped(const std::map<std::uint32_t, std::size_t>& skipped) {
        std::string kinds;
        for (const auto& [type, count] : skipped)
            if (kinds.size() < 200)
                kinds += (kinds.empty() ? "" : ", ") + std::to_string(count) + " of type " + std::to_string(type) +
                         " (" + nameOfCell(type) + ")";
        if (mesh_.tetrahedra.empty())
            throw Error(name_, "has no cells that fill a volume" + (kinds.empty() ? "" : ": " + kinds),
                        "save it with tetrahedra, hexahedra, voxels, wedges or pyramids (types 10 to 14)");
        sink_.warn(name_ +
                   ": cells that are no tetrahedra, hexahedra, voxels, wedges or pyramids were left out: " + kinds);
    }

    // ---- Values

    [[noreturn]] void throwNoValues() const {
        throw Error(name_, "holds no values at its points or cells", "save it with POINT_DATA");
    }

    void chooseValues() {
        values_ = mainArray(file_.pointData);
        if (values_) {
            if (values_->tuples != mesh_.points.size())
                throw Error(name_,
                            "has " + std::to_string(values_->tuples) + " values for " +
                                std::to_string(mesh_.points.size()) + " points",
                            "correct POINT_DATA");
            mesh_.values = readFloats(file_, *values_, sink_);
        } else {
            values_ = mainArray(file_.cellData);
            if (!values_) throwNoValues();
            cellValues_ = readFloats(file_, *values_, sink_);
            checkMemory(checkProduct(name_, {mesh_.points.size(), values_->components, 4}));
            mesh_.values.assign(mesh_.points.size() * values_->components, 0);
            gathered_.assign(mesh_.values.size(), 0);
        }
        mesh_.channels = int(values_->components);
    }

    /// Adds the values of a cell to its points, where it is cells that have them.
    void gather(std::size_t cell, std::span<const std::uint32_t> vertices) {
        const std::size_t channels = values_->components;
        if (gathered_.empty() || (cell + 1) * channels > cellValues_.size()) return;
        for (const std::uint32_t v : vertices)
            for (std::size_t c = 0; c < channels; ++c)
                if (const float value = cellValues_[cell * channels + c]; std::isfinite(value)) {
                    mesh_.values[v * channels + c] += value;
                    ++gathered_[v * channels + c];
                }
    }

    void finishValues() {
        if (gathered_.empty()) return;
        if (values_->tuples != cellCount_)
            throw Error(
                name_,
                "has " + std::to_string(values_->tuples) + " values for " + std::to_string(cellCount_) + " cells",
                "correct CELL_DATA");
        for (std::size_t i = 0; i < gathered_.size(); ++i)
            mesh_.values[i] =
                gathered_[i] > 0 ? mesh_.values[i] / float(gathered_[i]) : std::numeric_limits<float>::quiet_NaN();
        sink_.warn(name_ + ": holds values of cells; each point was given the mean of the cells about it");
    }

    /// Before taking memory that the file's length does not bound.
    void checkMemory(std::uint64_t bytes) const { sink_.checkMemory(name_, bytes); }

    const VtkFile& file_;
    const std::string& name_;
    VolumeSink& sink_;
    MeshData mesh_;
    std::vector<bool> hiddenPoints_;
    std::vector<std::uint32_t> cellFlags_;
    std::size_t cellCount_ = 0;
    const VtkArray* values_ = nullptr;
    std::vector<float> cellValues_;
    std::vector<std::uint32_t>
        gathered_;  // how many values each of mesh_.values is the sum of; empty: points have them
};

}  // namespace

void readVtkMesh(const VtkFile& file, VolumeSink& sink) {
    MeshReader(file, sink).read();
}

}  // namespace voledit
