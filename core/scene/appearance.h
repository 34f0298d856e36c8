#pragma once
// Appearances by name: the files of resources/appearances.

#include <string>
#include <vector>

#include "core/fields/transfer_function.h"
#include "core/fields/volume.h"
#include "core/scene/scene.h"

namespace voledit {

struct Preset {
    std::string name;         // file name without ending: "ct-bone"
    std::string title;        // "CT bone"
    std::string description;  // one line
    /// True: the tables' values run over 0…1 of the volume's min … max; else they are in data units (HU).
    bool relative = false;
    TransferFunction tables;
};

/// All presets of resources/appearances, sorted by name; read once. Throws Error where a file is wrong.
const std::vector<Preset>& presets();
/// Throws Error that lists the names there are.
const Preset& presetNamed(const std::string& name);

/// The tables that `appearance` means for `volume`, in data units.
TransferFunction resolve(const Appearance& appearance, const Volume& volume);
/// The same for values within `range`: those of a mesh.
TransferFunction resolve(const Appearance& appearance, const Interval& range);

/// The preset that suits a volume which comes without one, by its type, range and histogram; "" for the grey ramp.
std::string suggestedPreset(const Volume& volume);

}  // namespace voledit
