#pragma once
// Times of a piece of work, for `voledit bench`.

#include <functional>
#include <nlohmann/json.hpp>
#include <vector>

namespace voledit {

/// Milliseconds of one piece of work: wall clock, and of all of the process's threads together, which hardly moves
/// where other work shares the machine.
struct WorkTime {
    double wall = 0, cpu = 0;
};
WorkTime timeOf(const std::function<void()>& work);

/// Median, smallest and largest of `times` (at least one).
nlohmann::ordered_json summaryOf(std::vector<double> times);

/// Adds `NAME_ms` (wall) and `NAME_cpu_ms` (the median) of `times` to `json`.
void addTimes(nlohmann::ordered_json& json, const std::string& name, const std::vector<WorkTime>& times);

/// The middle one of `times` (at least one).
double medianOf(std::vector<double> times);

}  // namespace voledit
