#pragma once
// Frames drawn by several processes.

#include <functional>
#include <string>
#include <vector>

#include "app/animation/frame_record.h"
#include "core/base/progress.h"

namespace voledit {

/// The words between a worker and whom it works for: a line each. The worker reads "12" and draws frame 12; it answers
/// "done 12 BYTES FINGERPRINT" when the frame's file is in place, "failed MESSAGE" before it ends, and in between
/// "warning MESSAGE". It ends where its input does.
struct WorkerWords {
    static std::string done(const FinishedFrame& frame);
    static std::string warning(const std::string& message);
    static std::string failed(const std::string& message);
};

struct WorkerPool {
    std::vector<std::string> command;      // that starts a worker
    std::vector<std::string> environment;  // of a worker, beside our own
    int count = 1;                         // workers
};

/// Has `frames` drawn by `pool.count` workers, each given its next frame when it has finished one. `onFrame` is called
/// in this thread as frames are finished, in any order; `onWarning` with what workers say. When one fails, or
/// `progress` is cancelled, all are stopped (none leaves a half-written file); finished frames stay. Throws Error,
/// Cancelled.
void drawByWorkers(const WorkerPool& pool, const std::vector<int>& frames,
                   const std::function<void(const FinishedFrame&)>& onFrame,
                   const std::function<void(const std::string&)>& onWarning, Progress* progress);

}  // namespace voledit
