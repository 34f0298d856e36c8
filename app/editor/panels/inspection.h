#pragma once
// What the inspectors of all kinds of nodes share: a node is copied, its rows edit the copy, and what changed goes back
// into the scene as one step.

#include <functional>
#include <string>

#include "app/editor/formula_field.h"
#include "app/editor/panels/transfer_plot.h"
#include "app/editor/parameter_widgets.h"
#include "app/editor/timeline/key_row.h"
#include "app/editor/workspace.h"

namespace voledit {

/// What an inspector keeps from frame to frame.
struct InspectorState {
    FormulaFields formulas;
    TransferPlot plot;  // of a recolour's tables
    std::string shown;  // path of the node
    Box3 box;           // lengths that sliders go by, world units; held while something is dragged
};

/// One frame of an inspector: rows edit a copy of the node, `finish` writes what changed.
class Inspection {
public:
    /// `path` is that of the node shown.
    Inspection(Workspace& workspace, InspectorState& state, std::string path)
        : workspace_(workspace), state_(state), path_(std::move(path)) {}

    Workspace& workspace() { return workspace_; }
    const std::string& path() const { return path_; }
    TransferPlot& plot() { return state_.plot; }
    const Box3& box() const { return state_.box; }

    /// "Change" and the label in small letters.
    static std::string stepFor(const std::string& label);
    /// Takes in what a widget did; `step` names the undo step.
    void note(const Edit& edit, const std::string& step);

    /// A row for a value that may have keys, which stands at `member` of the node ("/angle"; "": it takes none): shows
    /// it at the current time with a mark. An edit of one that has keys, or any with auto-key, sets the key of that
    /// time. `widget(value)` draws the row.
    template <class T, class Widget>
    void tracked(const char* label, const std::string& member, Tracked<T>& value, const Widget& widget);

    /// Rows of numbers in world units, without ends (`low` apart), dragged by a thousandth of the box.
    void length(const char* label, const std::string& member, Tracked<double>& value, double low,
                const std::string& help = {});
    void position(const char* label, const std::string& member, Tracked<Vec3>& value, const std::string& help = {});
    void direction(const char* label, const std::string& member, Tracked<Vec3>& value, const std::string& help = {});
    NumberFormat lengthFormat() const;

    /// A row for a formula, checked by compiling the scene with it: `put(text)` writes it into the node's copy.
    void formula(const char* label, const std::string& member, const std::string& text,
                 const std::function<void(const std::string&)>& put, const std::string& help = {});
    /// A row for a number or a formula: a slider with a button that turns it into a formula; a formula that is a mere
    /// number becomes one when its field is left. `Scalar` is either of a scene's forms.
    void scalar(const char* label, const std::string& member, std::variant<Tracked<double>, std::string>& value,
                const ParameterFormat& format, const std::string& help = {});
    /// The same for a scalar field; those of other kinds are named only, and stand in the tree.
    void field(const char* label, const std::string& member, FieldRef& field, const ParameterFormat& format,
               const std::string& help = {});
    /// min and max of a box at `member`.
    void boxRows(const char* minLabel, const char* maxLabel, const std::string& member, TrackedBox& box);
    /// translate, rotate, scale; or the matrix. They stand in the node itself, or at `member` of it.
    void placementRows(Placement& placement, const std::string& member = {});

    /// How a copy of the node goes into a scene; set by the inspector before its rows are drawn.
    std::function<void(Scene&)> write;

    /// Previews, commits or restores by what `note` took in. Once, after all rows.
    void finish();

private:
    /// A formula's row; what it did, with `typed` the new text.
    Edit formulaRow(const char* label, const std::string& member, const std::string& text, std::string& typed,
                    const std::function<void(const std::string&)>& put, const std::string& help);

    Workspace& workspace_;
    InspectorState& state_;
    std::string path_;
    Edit edit_;
    std::string step_;
};

template <class T, class Widget>
void Inspection::tracked(const char* label, const std::string& member, Tracked<T>& value, const Widget& widget) {
    T now = value.at(workspace_.time);
    if (value.animated()) ui::animatedMark(label);
    Edit edit;
    {
        const KeyRow keys(workspace_, member.empty() ? "" : path_ + member, label, keyStateOf(value, workspace_.time));
        edit = widget(now);
    }
    if (edit.changed) setWhen(value, now, workspace_.when());
    note(edit, stepFor(label));
    if (member.empty() || !takeKeyWish(workspace_, path_ + member)) return;
    setWhen(value, now, {workspace_.time, true});
    note({true, true, false}, "Insert key");
}

}  // namespace voledit
