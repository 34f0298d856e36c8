#include "core/fields/brick_set.h"

#include <algorithm>
#include <cassert>
#include <glm/common.hpp>

#include "core/base/parallel.h"

namespace voledit {

namespace {

void spreadAlongRow(std::uint8_t* row, int count) {
    for (int i = 1; i < count; ++i) row[i] = std::min(row[i], std::uint8_t(row[i - 1] + 1));
    for (int i = count - 2; i >= 0; --i) row[i] = std::min(row[i], std::uint8_t(row[i + 1] + 1));
}

/// Lowers a row to what the one beside it allows.
void spreadToRow(std::uint8_t* row, const std::uint8_t* beside, int count) {
    const auto lowerTo = [&](int i, std::uint8_t nearest) { row[i] = std::min(row[i], std::uint8_t(nearest + 1)); };
    lowerTo(0, std::min(beside[0], beside[std::min(1, count - 1)]));
    for (int i = 1; i < count - 1; ++i) lowerTo(i, std::min(std::min(beside[i - 1], beside[i]), beside[i + 1]));
    lowerTo(count - 1, std::min(beside[count - 1], beside[std::max(count - 2, 0)]));
    spreadAlongRow(row, count);
}

/// Distances within one layer of rows, there and back [Rosenfeld & Pfaltz 1968].
void spreadInLayer(std::uint8_t* layer, Index2 count) {
    const auto row = [&](int j) { return layer + std::ptrdiff_t(j) * count.x; };
    spreadAlongRow(layer, count.x);
    for (int j = 1; j < count.y; ++j) spreadToRow(row(j), row(j - 1), count.x);
    for (int j = count.y - 2; j >= 0; --j) spreadToRow(row(j), row(j + 1), count.x);
}

/// The same row of every layer, `stride` apart.
struct Rows {
    std::uint8_t* first;
    std::size_t stride;
    int count, width;

    std::uint8_t* row(int n) const { return first + std::size_t(n) * stride; }
};

/// distance(n) = min over r of max(r, before(n ± r)).
void spreadAcross(const Rows& rows, std::vector<std::uint8_t>& before) {
    const int width = rows.width;
    before.resize(std::size_t(rows.count) * std::size_t(width));
    for (int n = 0; n < rows.count; ++n) std::copy_n(rows.row(n), width, before.begin() + std::ptrdiff_t(n) * width);
    for (int n = 0; n < rows.count; ++n) {
        std::uint8_t* row = rows.row(n);
        // Rows as far away as the largest distance make nothing nearer.
        const auto largest = [&] {
            std::uint8_t most = 0;
            for (int i = 0; i < width; ++i) most = std::max(most, row[i]);
            return int(most);
        };
        for (int r = 1; r < std::min(largest(), rows.count); ++r)
            for (const int from : {n - r, n + r}) {
                if (from < 0 || from >= rows.count) continue;
                const std::uint8_t* other = before.data() + std::ptrdiff_t(from) * width;
                const auto least = std::uint8_t(r);
                for (int i = 0; i < width; ++i) row[i] = std::min(row[i], std::max(other[i], least));
            }
    }
}

/// Lowers each value to what its neighbours' plus one allow, along all axes and diagonals.
void spreadDistances(Index3 count, std::vector<std::uint8_t>& cells) {
    const std::size_t row = std::size_t(count.x), layer = row * std::size_t(count.y);
    parallelFor(std::size_t(count.z), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) spreadInLayer(cells.data() + k * layer, count);
    });
    parallelFor(std::size_t(count.y), 1, [&](std::size_t begin, std::size_t end) {
        std::vector<std::uint8_t> before;
        for (std::size_t j = begin; j < end; ++j)
            spreadAcross({cells.data() + j * row, layer, count.z, count.x}, before);
    });
}

}  // namespace

BrickSet::BrickSet(Index3 count, std::vector<std::uint8_t> member) : count_(count), member_(std::move(member)) {
    assert(member_.size() == indexOf({0, 0, count.z}));
    findBounds();
    sumUp();
}

void BrickSet::findBounds() {
    first_ = count_;
    end_ = Index3(0);
    const std::uint8_t* at = member_.data();
    for (int k = 0; k < count_.z; ++k)
        for (int j = 0; j < count_.y; ++j)
            for (int i = 0; i < count_.x; ++i, ++at) {
                if (*at == 0) continue;
                ++size_;
                first_ = glm::min(first_, Index3(i, j, k));
                end_ = glm::max(end_, Index3(i, j, k) + 1);
            }
}

void BrickSet::sumUp() {
    const std::size_t row = std::size_t(count_.x + 1), slice = row * std::size_t(count_.y + 1);
    sums_.assign(slice * std::size_t(count_.z + 1), 0);
    const std::uint8_t* at = member_.data();
    for (int k = 0; k < count_.z; ++k)
        for (int j = 0; j < count_.y; ++j) {
            int* sum = sums_.data() + slice * std::size_t(k + 1) + row * std::size_t(j + 1) + 1;
            int inRow = 0;
            for (int i = 0; i < count_.x; ++i, ++sum, ++at) {
                inRow += *at != 0;
                *sum = inRow + *(sum - row) + *(sum - slice) - *(sum - slice - row);
            }
        }
}

bool BrickSet::any(Index3 first, Index3 end) const {
    first = glm::clamp(first, Index3(0), count_);
    end = glm::clamp(end, Index3(0), count_);
    if (first.x >= end.x || first.y >= end.y || first.z >= end.z) return false;
    const std::size_t row = std::size_t(count_.x + 1), slice = row * std::size_t(count_.y + 1);
    const auto layer = [&](int k) {
        const int* from = sums_.data() + slice * std::size_t(k);
        const auto at = [&](int i, int j) { return from[row * std::size_t(j) + std::size_t(i)]; };
        return at(end.x, end.y) - at(first.x, end.y) - at(end.x, first.y) + at(first.x, first.y);
    };
    return layer(end.z) > layer(first.z);
}

std::vector<std::uint8_t> BrickSet::distances(int farthest) const {
    assert(farthest <= 254);
    std::vector<std::uint8_t> cells(member_.size());
    std::transform(member_.begin(), member_.end(), cells.begin(),
                   [&](std::uint8_t m) { return m ? std::uint8_t(0) : std::uint8_t(farthest); });
    spreadDistances(count_, cells);
    return cells;
}

}  // namespace voledit
