#pragma once
// A transfer function integrated over the value, as rays in fragments take it.

#include <array>
#include <vector>

#include "core/base/interval.h"
#include "core/fields/transfer_function.h"

namespace voledit {

/// Extinction, its antiderivative over the value, and the same for colour, at equal distances ("bins"). A stretch of
/// length h, over which the value runs linearly from bin a to bin b, has the optical depth (D(b) − D(a)) / (b − a) · h
/// [Engel, Kraus, Ertl 2001], h in opacity distances; exact but for the values' rounding to bins.
struct MarchTable {
    float low = 0, scale = 1;  // bin of a value: round((value − low) · scale), clamped to [0, bins − 1]
    int bins = 2;
    /// Of each bin: D as the sum of two floats, so that differences of neighbours are exact beside any total; the
    /// extinction; 0.
    std::vector<std::array<float, 4>> depth;
    std::vector<float> next;  // of each bin: the first from it on that absorbs; `bins` where none does
    /// Of each bin: the antiderivative of colour times extinction, 0; after all of these the colours themselves.
    std::vector<std::array<float, 4>> color;

    /// False only if no stretch between two values of `values`, rounded as fragments may round them, absorbs anything.
    bool mayAbsorb(const Interval& values) const;

private:
    friend MarchTable makeMarchTable(const TransferFunction&, const Interval&, bool);
    std::vector<int> absorbingBefore_;  // bins with an extinction above 0 before bin n
};

/// The table for values in `data`; `whole` says that they are whole numbers.
MarchTable makeMarchTable(const TransferFunction& look, const Interval& data, bool whole);

}  // namespace voledit
