#pragma once
// From a scene's arguments to the slots of a formula file's graphs. Internal to core/stf.

#include <map>
#include <string>
#include <vector>

#include "core/stf/transfer_definition.h"

namespace voledit {

using TransferArguments = std::map<std::string, TransferArgument>;

/// All parameters' values: those given, checked, and for the others what a missing member means. Vectors given by one
/// number are three. Throws Error that names the parameter.
TransferArguments completeArguments(const TransferDefinition& definition, const TransferArguments& given);

/// What names mean in the definition's formulas, but for the point: axes are constants (0, 1, 2; for a list of axes a
/// vector of 0 and 1), all else parameters. `arguments` need hold the axes only.
FormulaSymbols symbolsFor(const TransferDefinition& definition, const TransferArguments& arguments);

/// Values of the parameters of `symbolsFor`, in order: angles in radians, directions of lines of length 1; the frame's
/// edge lengths and handedness where the definition uses a frame; the time.
/// @param arguments  complete
/// @param amount     multiplies strengths
std::vector<double> parameterValues(const TransferDefinition& definition, const TransferArguments& arguments,
                                    const Frame& frame, double amount, double time);

}  // namespace voledit
