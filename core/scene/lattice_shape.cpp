// setLatticeShape: another basis, degree or number of points for a lattice that has been deformed already.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/base/error.h"
#include "core/scene/edits.h"
#include "core/scene/limits.h"
#include "core/scene/scene_walk.h"
#include "core/stf/lattice_basis.h"

namespace voledit {

namespace {

/// Dense matrix, row by row.
struct Matrix {
    int rows = 0, columns = 0;
    std::vector<double> values;

    Matrix(int r, int c) : rows(r), columns(c), values(std::size_t(r) * std::size_t(c)) {}
    double& at(int r, int c) { return values[std::size_t(r) * std::size_t(columns) + std::size_t(c)]; }
    double at(int r, int c) const { return values[std::size_t(r) * std::size_t(columns) + std::size_t(c)]; }
};

/// X of A X = B by Gauss elimination with partial pivoting; A square and regular.
Matrix solved(Matrix a, Matrix b) {
    const int n = a.rows;
    for (int k = 0; k < n; ++k) {
        int pivot = k;
        for (int r = k + 1; r < n; ++r)
            if (std::abs(a.at(r, k)) > std::abs(a.at(pivot, k))) pivot = r;
        assert(a.at(pivot, k) != 0);
        for (int c = 0; c < n; ++c) std::swap(a.at(k, c), a.at(pivot, c));
        for (int c = 0; c < b.columns; ++c) std::swap(b.at(k, c), b.at(pivot, c));
        for (int r = 0; r < n; ++r) {
            const double factor = r == k ? 0 : a.at(r, k) / a.at(k, k);
            if (factor == 0) continue;
            for (int c = k; c < n; ++c) a.at(r, c) -= factor * a.at(k, c);
            for (int c = 0; c < b.columns; ++c) b.at(r, c) -= factor * b.at(k, c);
        }
    }
    for (int r = 0; r < n; ++r)
        for (int c = 0; c < b.columns; ++c) b.at(r, c) /= a.at(r, r);
    return b;
}

/// B_j(at[i]) of `count` basis functions.
Matrix basisAt(LatticeBasis basis, int count, const std::vector<double>& at) {
    Matrix values(int(at.size()), count);
    for (int i = 0; i < values.rows; ++i) {
        const BasisValues b = basisValues(basis, count, at[std::size_t(i)]);
        for (std::size_t n = 0; n < b.value.size(); ++n) values.at(i, int(b.first + n)) = b.value[n];
    }
    return values;
}

/// Control points of the new basis from those of the old one, along one axis: degree elevation where both are Bézier
/// [Farin 2002, §6.1, applied degree by degree], else interpolation at the new basis' Greville points.
Matrix conversion(LatticeBasis from, int oldCount, LatticeBasis to, int newCount) {
    if (from != LatticeBasis::Bezier || to != LatticeBasis::Bezier || newCount < oldCount) {
        const auto at = restParameters(to, newCount);
        return solved(basisAt(to, newCount, at), basisAt(from, oldCount, at));
    }
    Matrix matrix(oldCount, oldCount);
    for (int i = 0; i < oldCount; ++i) matrix.at(i, i) = 1;
    for (int count = oldCount + 1; count <= newCount; ++count) {
        Matrix raised(count, oldCount);
        for (int i = 0; i < count; ++i)
            for (int c = 0; c < oldCount; ++c) {
                const double t = double(i) / (count - 1);
                raised.at(i, c) =
                    (i > 0 ? t * matrix.at(i - 1, c) : 0) + (i < count - 1 ? (1 - t) * matrix.at(i, c) : 0);
            }
        matrix = raised;
    }
    return matrix;
}

/// `values` (size.x·size.y·size.z, first axis fastest) with `matrix` applied along `axis`; `size` becomes the new one.
std::vector<Vec3> appliedAlong(int axis, const Matrix& matrix, const std::vector<Vec3>& values, Index3& size) {
    const Index3 before = size;
    size[axis] = matrix.rows;
    std::vector<Vec3> result(std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z), Vec3(0));
    std::size_t n = 0;
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i, ++n) {
                Index3 from{i, j, k};
                const int row = from[axis];
                for (int c = 0; c < matrix.columns; ++c) {
                    from[axis] = c;
                    const auto index =
                        std::size_t(from.x) +
                        std::size_t(before.x) * (std::size_t(from.y) + std::size_t(before.y) * std::size_t(from.z));
                    result[n] += matrix.at(row, c) * values[index];
                }
            }
    return result;
}

void checkShape(const std::string& name, LatticeBasis basis, Index3 points, Index3 cells) {
    const int fewest = basis == LatticeBasis::Bezier ? 2 : 4;
    const int most = basis == LatticeBasis::Bezier ? kLargestDegree + 1 : kMostPointsAlongAxis;
    double cellCount = 1, pointCount = 1;
    for (int a = 0; a < 3; ++a) {
        if (points[a] < fewest || points[a] > most)
            throw Error("lattice \"" + name + "\"", std::to_string(points[a]) + " control points along an axis",
                        "give " + std::to_string(fewest) + " to " + std::to_string(most));
        if (cells[a] < 1) throw Error("lattice \"" + name + "\"", "no cells along an axis", "give 1 or more");
        cellCount *= cells[a];
        pointCount *= points[a];
    }
    if (cellCount > double(kMostCells))
        throw Error("lattice \"" + name + "\"", "too many cells",
                    "give " + std::to_string(kMostCells) + " or fewer in all");
    if (pointCount > double(kMostControlPoints))
        throw Error("lattice \"" + name + "\"", "too many control points",
                    "give " + std::to_string(kMostControlPoints) + " or fewer in all");
}

}  // namespace

void setLatticeShape(Scene& scene, const std::string& name, LatticeBasis basis, Index3 points, Index3 cells,
                     const Frame& frame) {
    checkShape(name, basis, points, cells);
    editTransfer(scene, name, [&](Transfer& transfer) {
        auto* ffd = std::get_if<FfdTransfer>(&transfer.kind);
        if (!ffd) throw Error("transfer \"" + name + "\"", "it is not a lattice", "choose a transfer of type ffd");
        ffd->cells = cells;
        if (ffd->basis == basis && ffd->points == points) return;

        // The rest lattice is the identity in either basis, so displacements alone are converted: exactly linear.
        const Frame own = transfer.frame.value_or(frame);
        const auto rest = restControlPoints(ffd->basis, ffd->points, own);
        std::vector<Vec3> displacement(rest.size(), Vec3(0));
        for (const auto& [point, move] : ffd->moves)
            displacement.at(point) = move.absolute ? *move.vector - rest[point] : *move.vector;
        Index3 size = ffd->points;
        double largest = 0;
        for (const Vec3& d : displacement) largest = std::max({largest, std::abs(d.x), std::abs(d.y), std::abs(d.z)});
        for (int a = 0; a < 3; ++a)
            displacement =
                appliedAlong(a, conversion(ffd->basis, ffd->points[a], basis, points[a]), displacement, size);

        ffd->basis = basis;
        ffd->points = points;
        ffd->moves.clear();
        // What rounding leaves of a zero is not a move.
        const double rounding = 1e-13 * largest;
        for (std::size_t i = 0; i < displacement.size(); ++i) {
            const Vec3& d = displacement[i];
            if (std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) > rounding) ffd->moves[i] = {d, false};
        }
    });
}

}  // namespace voledit
