#pragma once
// What the volumes look like.

#include <memory>
#include <string>

#include "app/editor/panels/transfer_plot.h"
#include "app/editor/workspace.h"

namespace voledit {

/// Preset, transfer function, factor over the gradient's magnitude, opacity distance of one of the scene's volumes.
class AppearancePanel {
public:
    AppearancePanel();

    void draw(Workspace& workspace);

private:
    void editGradientOpacity(Workspace& workspace, const TransferFunction& shown, const TransferFunction& committed);

    std::string asset_;  // shown; another where the scene has no such volume
    TransferPlot plot_, gradientPlot_;
    std::shared_ptr<const Volume> countedOf_;
    VolumeStatistics values_, steepness_;  // of it
};

}  // namespace voledit
