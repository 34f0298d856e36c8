#include "app/editor/panels/lattice_panel.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "app/editor/icons.h"
#include "app/editor/timeline/key_row.h"
#include "app/editor/tools/tool_actions.h"
#include "app/editor/widgets.h"
#include "core/scene/edits.h"
#include "core/scene/limits.h"

namespace voledit {

namespace {

std::string pointName(const Lattice& lattice, std::size_t index) {
    const Index3 at = gridIndexOf(lattice, index);
    return "(" + std::to_string(at.x) + ", " + std::to_string(at.y) + ", " + std::to_string(at.z) + ")";
}

/// Basis, degree or points, cells: what the lattice is made of.
void drawShape(Workspace& workspace, const LatticeView& view, const FfdTransfer& ffd) {
    Document& document = workspace.document;
    static const std::vector<std::string> bases{"Bézier", "B-spline"};
    int basis = ffd.basis == LatticeBasis::Bezier ? 0 : 1;
    const Edit chosen = ui::choice(
        "Basis", basis, bases, "Bézier: every control point moves everything a little. B-spline: only what is near.");
    const bool bezier = basis == 0;
    const Index3 off(bezier ? 1 : 0);
    Index3 points = ffd.points - off;
    const int most = bezier ? kLargestDegree : kMostPointsAlongAxis;
    const Edit counted =
        ui::integers(bezier ? "Degree" : "Points", points, bezier ? 1 : 4, most,
                     "Along each axis. Control points keep the shape where the new lattice can hold it.");
    Index3 cells = ffd.cells;
    const Edit divided =
        ui::integers("Cells", cells, 1, 128, "Mapped cells along each axis: more follow the bend closer");
    const auto change = [&](Scene& scene) {
        const Index3 count = bezier ? points + off : glm::max(points, Index3(4));
        setLatticeShape(scene, view.name, bezier ? LatticeBasis::Bezier : LatticeBasis::BSpline, count, cells,
                        view.lattice.frame);
    };
    // The numbers of the points mean others then.
    if (chosen.changed || counted.changed) workspace.selection.points.clear();
    applyEdit(document, chosen, "Change basis", change);
    applyEdit(document, counted, bezier ? "Change degree" : "Change points", change);
    applyEdit(document, divided, "Change cells", change);
}

void drawStrength(Workspace& workspace, const std::string& name, const Transfer& transfer) {
    Document& document = workspace.document;
    double amount = transfer.amount.at(workspace.time);
    NumberFormat format{0, 1, 0, 2};
    Edit scaled;
    {
        const NodePath path = followedUse(document.scene(), workspace.selection.node);
        const KeyRow keys(workspace, path.empty() ? "" : path + "/amount", "Amount",
                          keyStateOf(transfer.amount, workspace.time));
        scaled = ui::slider("Amount", amount, format, "How much of the deformation is applied");
    }
    applyEdit(document, scaled, "Change amount",
              [&](Scene& scene) { setTransferAmount(scene, name, amount, workspace.when()); });

    static const std::vector<std::string> kinds{"Hide", "Keep"};
    int outside = transfer.outside.value_or(Outside::Hide) == Outside::Keep ? 1 : 0;
    const Edit chosen =
        ui::choice("Outside", outside, kinds, "What lies outside the lattice: hidden, or kept as it is");
    applyEdit(document, chosen, "Change outside",
              [&](Scene& scene) { setTransferOutside(scene, name, outside == 1 ? Outside::Keep : Outside::Hide); });
}

Vec3 meanOf(const LatticeView& view, const std::vector<std::size_t>& points) {
    Vec3 sum(0);
    for (const std::size_t p : points) sum += view.shown(p);
    return sum / double(points.size());
}

/// Where the selected points are, as shown, for typing: one's position, the mean of several.
void drawPosition(Workspace& workspace, const LatticeView& view, const std::vector<std::size_t>& points) {
    Document& document = workspace.document;
    const auto before = latticeView(document.committed(), &workspace.compiled, view.name);
    if (!before || points.back() >= before->lattice.control.size()) return;
    const Vec3 size = boundsOf(view.lattice.frame).size();
    NumberFormat format;
    format.speed = glm::length(size) / 1000;
    format.decimals = std::clamp(int(std::ceil(-std::log10(std::max(format.speed, 1e-9)))) + 1, 1, 6);
    Vec3 position = meanOf(view, points);
    const Edit edit = ui::vector(points.size() == 1 ? "Position" : "Mean", position, format,
                                 "World units, as shown. Drag, or double-click to type.");
    const Mat3 latticeFromShown = glm::inverse(Mat3(view.shownFromLattice));
    const Vec3 offset = latticeFromShown * (position - meanOf(*before, points));
    const std::string name =
        points.size() == 1 ? "Move control point" : "Move " + std::to_string(points.size()) + " control points";
    applyEdit(document, edit, name,
              [&](Scene& scene) { moveControlPoints(scene, view.name, points, offset, workspace.when()); });
}

void drawSelection(Workspace& workspace, const LatticeView& view) {
    std::vector<std::size_t> points = workspace.selection.points;
    std::erase_if(points, [&](std::size_t p) { return p >= view.lattice.control.size(); });
    if (workspace.selection.lattice != view.name) points.clear();
    ui::heading("CONTROL POINTS");
    if (points.empty()) {
        ui::note("None selected. Click one in the view.");
    } else {
        ui::row("Selected");
        const std::string what = points.size() == 1 ? "Point " + pointName(view.lattice, points[0])
                                                    : std::to_string(points.size()) + " of " +
                                                          std::to_string(view.lattice.control.size()) + " points";
        ImGui::TextUnformatted(what.c_str());
        noteWidget("Selected");
        drawPosition(workspace, view, points);
    }
    const bool clicked = ui::button(points.empty() ? "Reset all to rest##Reset" : "Reset to rest##Reset",
                                    workspace.actions.tooltip("lattice.reset"));
    noteWidget("Reset");
    if (clicked && workspace.actions.find("lattice.reset")) workspace.actions.run("lattice.reset");
}

/// Says where the lattice folds and which points do it.
void drawFolds(const LatticeView& view, const std::vector<std::size_t>& folding) {
    if (folding.empty()) return;
    const bool one = folding.size() == 1;
    std::string names;
    for (std::size_t i = 0; i < std::min<std::size_t>(folding.size(), 4); ++i)
        names += (i ? ", " : "") + pointName(view.lattice, folding[i]);
    if (folding.size() > 4) names += " and " + std::to_string(folding.size() - 4) + " more";
    ui::warning(std::string("Folded by control point") + (one ? " " : "s ") + names + ": parts show more than once. " +
                (one ? "Move it" : "Move them") + " back a little.");
    noteWidget("Fold warning");
}

}  // namespace

void LatticePanel::draw(Workspace& workspace) {
    Document& document = workspace.document;
    const std::string name = activeLattice(workspace);
    if (name.empty()) {
        ui::note("No lattice. Add one and drag its points to bend the object.");
        ui::actionButton(workspace.actions, "lattice.add");
        return;
    }
    const auto view = latticeView(document.scene(), &workspace.compiled, name);
    const Transfer* transfer = findTransfer(document.scene(), name);
    const auto* ffd = transfer ? std::get_if<FfdTransfer>(&transfer->kind) : nullptr;
    if (!view || !ffd) return ui::note("\"" + name + "\" takes no part in what is shown.");
    // Copies: an edit below replaces what the pointers point to.
    const Transfer settings = *transfer;
    const FfdTransfer shape = *ffd;
    if (!view->exact) ui::note("Shown where it acts: a deformation outside it moves what you see.");
    drawFolds(*view, folded_.of(view->map));
    drawSelection(workspace, *view);
    ui::heading("LATTICE");
    drawStrength(workspace, name, settings);
    drawShape(workspace, *view, shape);
}

}  // namespace voledit
