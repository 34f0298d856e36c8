#pragma once
// A volume term made ready for packets of rays: its table of optical depths, and where it has nothing to see.

#include <memory>

#include "core/objects/term.h"
#include "core/rays/optical_table.h"
#include "core/rays/skip_grid.h"

namespace voledit {

/// Immutable; made for one length of the step.
struct VolumeLook {
    TermPtr term;     // a VolumeTerm; keeps it
    double unit = 1;  // the step, opacity distances
    OpticalTable table;
    SteepnessTable steepness;
    std::shared_ptr<const SkipGrid> grid;

    const SkipGrid& skip() const { return *grid; }
    const VolumeTerm& volumeTerm() const { return std::get<VolumeTerm>(term->node); }
    /// False only if nothing is seen within so many voxels of the volume's faces.
    bool reachesFaces(double voxels) const;
};

/// True for volumes that packets draw as written: linear and packable().
bool packable(const VolumeTerm& term);

/// The look of a VolumeTerm that is packable(); `previous` (may be null) if that is it. Where only `unit` differs its
/// grid is kept: what is visible at all does not depend on the step.
std::shared_ptr<const VolumeLook> volumeLook(const TermPtr& term, double unit,
                                             const std::shared_ptr<const VolumeLook>& previous);

}  // namespace voledit
