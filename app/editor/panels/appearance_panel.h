#pragma once
// What the volumes look like.

#include <memory>
#include <string>

#include "app/editor/panels/transfer_plot.h"
#include "app/editor/workspace.h"

namespace voledit {

/// Preset, transfer function, opacity distance of one of the scene's volumes.
class AppearancePanel {
public:
    void draw(Workspace& workspace);

private:
    std::string asset_;  // shown; another where the scene has no such volume
    TransferPlot plot_;
};

}  // namespace voledit
