#include <memory>

#include "app/editor/icons.h"
#include "app/editor/panel.h"
#include "app/editor/panels/appearance_panel.h"
#include "app/editor/panels/history_panel.h"
#include "app/editor/panels/inspector_panel.h"
#include "app/editor/panels/lattice_panel.h"
#include "app/editor/panels/render_panel.h"
#include "app/editor/panels/scene_panel.h"

namespace voledit {

std::vector<Panel> makePanels() {
    const auto isOpen = [](const Workspace& workspace) { return workspace.open; };
    const auto lattice = std::make_shared<LatticePanel>();
    const auto appearance = std::make_shared<AppearancePanel>();
    std::vector<Panel> panels;
    panels.push_back({"Scene", drawScenePanel, {}, icons::kScene, true});
    const auto inspector = std::make_shared<InspectorPanel>();
    panels.push_back(
        {"Inspector", [inspector](Workspace& w) { inspector->draw(w); }, hasInspector, icons::kSliders, true});
    const auto hasVolumes = [](const Workspace& w) { return w.open && !w.assets.volumes.empty(); };
    const auto showsLattice = [](const Workspace& w) { return w.open && w.selection.showsLattice(); };
    panels.push_back({"Lattice", [lattice](Workspace& w) { lattice->draw(w); }, showsLattice, icons::kLattice, true});
    panels.push_back(
        {"Appearance", [appearance](Workspace& w) { appearance->draw(w); }, hasVolumes, icons::kAppearance, true});
    panels.push_back({"Render", drawRenderPanel, isOpen, icons::kRender, false});
    panels.push_back({"History", drawHistoryPanel, isOpen, icons::kHistory, false});
    return panels;
}

}  // namespace voledit
