#pragma once
// Rows for the parameters of deformations and shapes: numbers with a slider's range and a wider allowed one, pairs,
// axes, lines. As widgets.h.

#include <array>
#include <vector>

#include "app/editor/widgets.h"
#include "core/base/interval.h"

namespace voledit {

/// How a parameter is shown: its slider from format.min to format.max (either infinite: dragged without end), and the
/// values that may be typed.
struct ParameterFormat {
    NumberFormat format;
    Interval allowed;
};

namespace ui {

/// A slider; beyond its ends by typing, up to the allowed values.
Edit parameter(const char* label, double& value, const ParameterFormat& format, const std::string& help = {});
/// The same with a button at its end that asks for a formula in its place ("label formula").
Edit parameterOrFormula(const char* label, double& value, const ParameterFormat& format, const std::string& help,
                        bool& formulaWanted);
/// Two of them beside each other, noted as "label 1" and "label 2".
Edit pair(const char* label, std::array<double, 2>& values, const ParameterFormat& format,
          const std::string& help = {});
/// One of X, Y, Z; noted as "label/X" and so on.
Edit axis(const char* label, int& axis, const std::string& help = {});
/// Any of X, Y, Z but none at all, ascending; noted as "label/X" and so on.
Edit axes(const char* label, std::vector<int>& axes, const std::string& help = {});

/// A small diamond before the next row's field: its value changes over time. Noted as "label animated".
void animatedMark(const char* label);

}  // namespace ui
}  // namespace voledit
