#include "core/base/progress.h"

#include "core/base/error.h"

namespace voledit {

void report(Progress* progress, double fraction) {
    if (!progress) return;
    if (progress->cancelled()) throw Cancelled();
    progress->set(fraction);
}

}  // namespace voledit
