#pragma once
// How long work tells how far it is, and learns that nobody wants it any more.

#include <atomic>
#include <string>

namespace voledit {

/// Shared between a worker and whoever watches it; all members may be used from any thread.
class Progress {
public:
    /// Fraction done, 0…1.
    void set(double fraction) { fraction_.store(fraction, std::memory_order_relaxed); }
    double fraction() const { return fraction_.load(std::memory_order_relaxed); }

    void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
    bool cancelled() const { return cancelled_.load(std::memory_order_relaxed); }

private:
    std::atomic<double> fraction_{0};
    std::atomic<bool> cancelled_{false};
};

/// Throws Cancelled if `progress` (may be null) was cancelled; else notes `fraction`.
void report(Progress* progress, double fraction);

}  // namespace voledit
