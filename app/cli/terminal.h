#pragma once
// What every command does with the terminal: progress, warnings, Ctrl-C.

#include <functional>
#include <string>
#include <vector>

#include "core/base/progress.h"

namespace voledit {

enum class Verbosity : unsigned char { Quiet, Normal, Verbose };

/// Runs `work` while a bar named `what` shows its progress (where standard error is a terminal, and from half a second
/// on, with the time that is left) and Ctrl-C cancels it; says how long it took when verbose. Throws what `work`
/// throws.
void withProgress(const std::string& what, Verbosity verbosity, const std::function<void(Progress*)>& work,
                  bool report = false);

/// ", about 3 min left": what is said of work that has got so far (0…1) in so many seconds; empty where it is too early
/// to tell, or done.
std::string timeLeft(double seconds, double fraction);

/// "voledit: warning: …" on standard error, one line each; also when quiet, as a repaired file must never go unnoticed.
void printWarnings(const std::vector<std::string>& warnings);

}  // namespace voledit
