#pragma once
// BVH: motion capture as text, a hierarchy and its channels [Meredith, Maddock: Motion Capture File Formats Explained,
// 2001]. Read here and not in the parser process: the reader is our own, bounded, and sees no library.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/skeleton/motion.h"

namespace voledit {

/// What a BVH file may hold at most; more is refused with an error that says so. Joints: kMostJoints, end sites too.
struct BvhLimits {
    static constexpr std::size_t fileBytes = std::size_t(512) << 20;
    static constexpr std::size_t depth = 1000;   // joints below joints
    static constexpr std::size_t channels = 12;  // of one joint
    static constexpr std::size_t frames = 10'000'000;
    static constexpr double number = 1e12;  // the largest magnitude
    static constexpr std::size_t nameBytes = 200;
};

/// Reads the text of a BVH file; `fileName` is for messages.
///
/// Keywords in any case; lines end in LF, CR LF or CR; channels in any order, any subset, any number up to the limit (a
/// position axis once); several ROOTs; names run to the end of their line. Every frame must end with a line. Values are
/// the file's, to the bit of the nearest double.
///
/// Repaired, each with one line in `warnings` (may be null): fewer frames than claimed, but whole ones; more frames or
/// other text behind those claimed (left out); names given twice (the later ones get _2, _3 …); names that are not
/// UTF-8 (taken as Latin-1); a frame time of 0 where there is at most one frame (becomes 1/30 s). End sites are named
/// PARENT_End, with _2 … where that name is taken.
///
/// Throws Error (file, line, cause, remedy) for all else.
Motion parseBvh(std::string_view text, const std::string& fileName, std::vector<std::string>* warnings = nullptr);

/// The same of a file. Throws Error also where it is missing, no ordinary file, empty or too long.
Motion readBvh(const std::filesystem::path& path, std::vector<std::string>* warnings = nullptr);

/// The motion as BVH text: joints depth first (as every file has them), numbers in the fewest digits that read back to
/// the same bits. Reading it gives an equal motion, if its joints stand depth first and its names are a file's (control
/// characters and braces become _).
std::string bvhText(const Motion& motion);

/// Writes it beside `path`, then renames. Throws Error.
void writeBvh(const Motion& motion, const std::filesystem::path& path);

}  // namespace voledit
