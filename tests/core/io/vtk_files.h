#pragma once
// Legacy VTK files of grids, made for tests.

#include <array>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/types.h"
#include "tests/core/io/files.h"

namespace voledit::test {

/// How a legacy file is written.
struct VtkStyle {
    bool text = true;
    int version = 3;  // 5: cells as offsets and connectivity
};

inline std::vector<VtkStyle> vtkStyles() {
    return {{true, 3}, {false, 3}, {true, 5}, {false, 5}};
}

/// Numbers as the style has them, with the line's end behind.
template <class T>
std::string vtkNumbers(const std::vector<T>& values, VtkStyle style) {
    if (!style.text) return bytesOf(values, true) + "\n";
    std::ostringstream text;
    text.precision(17);
    for (std::size_t i = 0; i < values.size(); ++i) text << +values[i] << (i % 9 == 8 ? "\n" : " ");
    return text.str() + "\n";
}

inline std::string vtkStart(const std::string& dataset, VtkStyle style) {
    return "# vtk DataFile Version " + std::to_string(style.version) + (style.version == 5 ? ".1" : ".0") +
           "\na title\n" + (style.text ? "ASCII" : "BINARY") + "\nDATASET " + dataset + "\n";
}

inline std::string vtkPoints(const std::vector<Vec3>& points, VtkStyle style) {
    std::vector<double> numbers;
    for (const Vec3& p : points) numbers.insert(numbers.end(), {p.x, p.y, p.z});
    return "POINTS " + std::to_string(points.size()) + " double\n" + vtkNumbers(numbers, style);
}

struct VtkCell {
    int type;
    std::vector<int> points;
};

/// CELLS and CELL_TYPES.
inline std::string vtkCells(const std::vector<VtkCell>& cells, VtkStyle style) {
    std::vector<int> types, list;
    std::vector<std::int64_t> offsets{0}, connectivity;
    for (const VtkCell& cell : cells) {
        types.push_back(cell.type);
        list.push_back(int(cell.points.size()));
        list.insert(list.end(), cell.points.begin(), cell.points.end());
        connectivity.insert(connectivity.end(), cell.points.begin(), cell.points.end());
        offsets.push_back(std::int64_t(connectivity.size()));
    }
    std::string text;
    if (style.version < 5)
        text = "CELLS " + std::to_string(cells.size()) + " " + std::to_string(list.size()) + "\n" +
               vtkNumbers(list, style);
    else
        text = "CELLS " + std::to_string(offsets.size()) + " " + std::to_string(connectivity.size()) +
               "\nOFFSETS vtktypeint64\n" + vtkNumbers(offsets, style) + "CONNECTIVITY vtktypeint64\n" +
               vtkNumbers(connectivity, style);
    return text + "\nCELL_TYPES " + std::to_string(cells.size()) + "\n" + vtkNumbers(types, style);
}

/// POINT_DATA (or CELL_DATA) with one scalar array of floats.
inline std::string vtkScalars(const std::vector<float>& values, VtkStyle style, const std::string& of = "POINT_DATA") {
    return "\n" + of + " " + std::to_string(values.size()) + "\nSCALARS s float 1\nLOOKUP_TABLE default\n" +
           vtkNumbers(values, style);
}

}  // namespace voledit::test
