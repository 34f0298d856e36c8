#pragma once
// Transfer functions sampled into tables for the GPU.

#include <span>
#include <vector>

#include "core/fields/transfer_function.h"

namespace voledit {

/// A transfer function at `kSize` values from `low` to `high`, linear between them and held beyond; the range holds
/// every corner of the function that values of the volume can reach.
struct TransferTable {
    static constexpr int kSize = 4096;

    double low = 0, high = 1;
    std::vector<float> thickness;       // of one opacity distance: −ln(1 − min(O, 0.9999))
    std::vector<float> color;           // RGB and 0
    std::vector<float> gradientFactor;  // over 0 … gradientHigh; empty where there is none
    double gradientHigh = 1;
    /// Table coordinates (0 … kSize − 1) outside of which nothing is visible; first > last: nothing is at all.
    double firstVisible = kSize, lastVisible = -1;

    /// True if some value in [from, to] has thickness above 0, as the table's linear interpolation gives it.
    bool visible(double from, double to) const;

private:
    friend TransferTable makeTransferTable(const TransferFunction&, double, double);
    std::vector<int> visibleBefore_;  // entries with thickness > 0 before entry n
};

/// @param min,max  range of the volume's finite values
TransferTable makeTransferTable(const TransferFunction& function, double min, double max);

}  // namespace voledit
