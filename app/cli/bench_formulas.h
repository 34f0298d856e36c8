#pragma once
// What formulas cost against the same written by hand.

#include <nlohmann/json.hpp>

namespace voledit {

/// Million points a second and core of some transfers by their formula files ("formula") and as C++ functions ("code"),
/// medians of `repeats`, and how many times the code's time the formula takes ("ratio").
nlohmann::ordered_json benchFormulas(int repeats);

}  // namespace voledit
