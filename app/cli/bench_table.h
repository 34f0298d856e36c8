#pragma once
// The figures of `voledit bench` for the eye, and beside those of an earlier run.

#include <nlohmann/json.hpp>
#include <string>

namespace voledit {

/// One row for each scene, size and renderer, and one for each scene's work; columns aligned with spaces. Figures that
/// a row does not have are "-".
std::string benchTable(const nlohmann::ordered_json& run);

/// Adds `earlier_over_now` to each row of `run` that `earlier` has, too (the same scene, size and renderer): for every
/// time the earlier median over this one, for every rate this over the earlier: above 1 is better now. PSNRs become
/// differences in dB. Throws Error where `earlier` is not the output of `voledit bench`.
void compareRuns(nlohmann::ordered_json& run, const nlohmann::ordered_json& earlier);

}  // namespace voledit
