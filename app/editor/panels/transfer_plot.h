#pragma once
// The transfer-function editor: opacity over the histogram, colours in a bar below it.

#include <optional>
#include <string>

#include "app/editor/panels/transfer_edit.h"
#include "app/editor/widgets.h"
#include "core/fields/volume.h"

struct ImDrawList;
struct ImVec2;

namespace voledit {

/// What a plot calls its parts, in names of widgets and of undo steps.
struct PlotWords {
    const char* plot = "Opacity plot";
    const char* point = "Opacity point";  // and its number
    const char* height = "Opacity";       // of a point
    const char* help = "Opacity of one opacity distance of the material";
    const char* what = "opacity";  // is edited
    const char* where = "Value";   // a point is, along the axis
    const char* whereHelp = "Data value of the selected point";
    double lines = 9.5;  // of letters, that it is high
    bool colors = true;  // has them below, in a bar
};

/// Double click adds a point or a stop, a drag moves it (Shift+drag: all of them along the values), right click or
/// Delete takes it away. The wheel zooms the value axis about the mouse, a middle drag pans it. Keeps what is selected
/// and which values are in view; the tables are the scene's.
class TransferPlot {
public:
    TransferPlot() = default;
    explicit TransferPlot(const PlotWords& words) : words_(words) {}

    /// The tables after this frame's input, and what the input was.
    struct Result {
        TransferFunction function;
        Edit edit;
        std::string step;  // name of the undo step
    };

    /// Draws at the cursor, as wide as the window has room. `shown` is drawn; drags restart from `committed`, so that
    /// one is a single step.
    Result draw(const TransferFunction& shown, const TransferFunction& committed, const VolumeStatistics& statistics);
    /// Shows all values of the data and of the tables.
    void fit() { view_.reset(); }

private:
    enum class Part : std::uint8_t { None, Opacity, Color, All };
    struct Geometry;  // of one frame, screen pixels
    struct Handle {
        Part part = Part::None;
        std::size_t index = 0;
        bool operator==(const Handle&) const = default;
    };

    Geometry geometry(const ValueRange& whole) const;
    std::string stepOf(Part part) const;
    Handle handleAt(const Geometry& g, const TransferFunction& shown, const Vec2& mouse) const;
    void navigate(const Geometry& g, const ValueRange& whole);
    void press(const Geometry& g, const TransferFunction& committed, const Handle& under, bool inBar);
    void drag(const Geometry& g, Result& result);
    void removeHandle(Handle handle, Result& result);
    void drawHistogram(const Geometry& g, const VolumeStatistics& statistics) const;
    void drawOpacity(const Geometry& g, const TransferFunction& shown, const Handle& under) const;
    void drawColors(const Geometry& g, const TransferFunction& shown, const Handle& under) const;
    void drawAxis(const Geometry& g) const;
    void drawReadout(const Geometry& g, const TransferFunction& shown) const;
    void entry(const TransferFunction& committed, const ValueRange& whole, Result& result);

    PlotWords words_;
    std::optional<ValueRange> view_;  // values in view; nullopt: all
    Handle selected_, dragged_;
    std::optional<TransferFunction> start_;  // the tables that the drag began with
    Vec2 grab_{0};                           // of a drag: value and opacity under the mouse − the handle's
    Vec2 pressedAt_{0};                      // mouse, screen pixels
    bool moved_ = false;                     // since then
    std::string step_;
};

}  // namespace voledit
