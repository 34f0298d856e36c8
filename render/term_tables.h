#pragma once
// Piecewise-linear tables of a term program on the GPU.

#include <span>

#include "core/base/interval.h"
#include "render/gl_objects.h"
#include "render/term_program.h"

namespace voledit {

/// Entries of a table, linear between them: corners are rounded off within one entry, steps are one entry wide.
inline constexpr int kTableEntries = 4096;

/// Sets what the entries stand for: the range in which the tables change, cut to `values`, which are all that come.
void setRange(ProgramTable& table, const std::optional<Interval>& values);

/// RGB and value of each entry.
std::vector<float> entriesOf(const ProgramTable& table);

}  // namespace voledit
