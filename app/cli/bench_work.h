#pragma once
// Work on volumes that is not drawing: making volumes, finding points, reading, starting; for `voledit bench`.

#include <nlohmann/json.hpp>
#include <string>

#include "app/opening/open_file.h"

namespace voledit {

/// Where the root shows one volume: `voxelise_ms` and `voxelise_msamples_per_s` of its scalars on its own grid, moved
/// as the scene moves it. Where the outermost transfer has mapped cells: `locate_mqueries_per_s` of a million random
/// points in their box (all threads), `locate_one_thread_mqueries_per_s`, `tetrahedra`.
nlohmann::ordered_json benchWork(const OpenedScene& opened, int repeats);

/// `volume_mib` of the scene's volumes in memory, `raw_read_ms` of their files' bytes by plain reading (warm),
/// `read_ms` as voledit reads them.
nlohmann::ordered_json benchReading(const OpenedScene& opened, double readMilliseconds, int repeats);

/// A new process draws the scene's first picture: `start_to_first_picture_ms`, what a user waits for after the double
/// click, and that process's `peak_mib`. `flags` go to `voledit render FILE`. Throws Error where it fails.
nlohmann::ordered_json benchStart(const std::string& file, const std::vector<std::string>& flags, int repeats);

}  // namespace voledit
