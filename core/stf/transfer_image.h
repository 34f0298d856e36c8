#pragma once
// Where the forward image of a box lies, by the [image] formulas of a formula file. Internal to core/stf.

#include <optional>
#include <span>
#include <vector>

#include "core/base/box3.h"
#include "core/stf/formula_file.h"

namespace voledit {

class TransferImage {
public:
    /// `lets` stand before the image's own; `symbols` hold the file's parameters and constants. Throws FormulaError.
    TransferImage(const FormulaFileImage& image, const std::vector<FormulaLet>& lets, const FormulaSymbols& symbols);

    /// The image of `rest`, both in the formulas' coordinates; `rest` itself where a formula gives no finite number.
    Box3 of(const Box3& rest, std::span<const double> parameters) const;

private:
    std::vector<std::size_t> overSizes_;  // values of each `over`
    std::optional<FormulaGraph> overs_;   // (low, high) → the values of all lists, one behind the other
    FormulaGraph result_;                 // (low, high, one value of each list) → point, or min and max
};

}  // namespace voledit
