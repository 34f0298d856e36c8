#include "app/cli/bench_measure.h"

#include <time.h>

#include <algorithm>
#include <chrono>

namespace voledit {

namespace {

double processCpuMilliseconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return double(now.tv_sec) * 1e3 + double(now.tv_nsec) * 1e-6;
}

}  // namespace

WorkTime timeOf(const std::function<void()>& work) {
    const double cpu = processCpuMilliseconds();
    const auto start = std::chrono::steady_clock::now();
    work();
    const double wall = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return {wall, processCpuMilliseconds() - cpu};
}

double medianOf(std::vector<double> times) {
    std::nth_element(times.begin(), times.begin() + std::ptrdiff_t(times.size() / 2), times.end());
    return times[times.size() / 2];
}

nlohmann::ordered_json summaryOf(std::vector<double> times) {
    std::sort(times.begin(), times.end());
    return {{"median", times[times.size() / 2]}, {"min", times.front()}, {"max", times.back()}};
}

void addTimes(nlohmann::ordered_json& json, const std::string& name, const std::vector<WorkTime>& times) {
    std::vector<double> wall, cpu;
    for (const WorkTime& time : times) {
        wall.push_back(time.wall);
        cpu.push_back(time.cpu);
    }
    json[name + "_ms"] = summaryOf(wall);
    json[name + "_cpu_ms"] = medianOf(cpu);
}

}  // namespace voledit
