#include "app/animation/fingerprint.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <vector>

#include "core/scene/scene_children.h"

namespace voledit {

namespace fs = std::filesystem;

void Fingerprint::mix(std::uint64_t word) {
    // Two multiplicative mixers with odd constants of high entropy (the golden ratio's, and SplitMix64's).
    a_ = (a_ ^ word) * 0x9e3779b97f4a7c15;
    a_ ^= a_ >> 29;
    b_ = (b_ + word) * 0xbf58476d1ce4e5b9;
    b_ ^= b_ >> 32;
}

void Fingerprint::add(std::span<const std::byte> bytes) {
    mix(bytes.size());
    std::uint64_t word = 0;
    for (; bytes.size() >= sizeof word; bytes = bytes.subspan(sizeof word)) {
        std::memcpy(&word, bytes.data(), sizeof word);
        mix(word);
    }
    if (bytes.empty()) return;
    word = 0;
    std::memcpy(&word, bytes.data(), bytes.size());
    mix(word);
}

bool Fingerprint::addFile(const fs::path& path) {
    std::error_code failed;
    if (fs::is_directory(path, failed)) {
        std::vector<fs::path> files;
        for (const auto& entry : fs::directory_iterator(path, failed))
            if (entry.is_regular_file(failed)) files.push_back(entry.path());
        std::sort(files.begin(), files.end());
        for (const fs::path& file : files) add(file.filename().string());
        return !failed && std::all_of(files.begin(), files.end(), [&](const fs::path& f) { return addFile(f); });
    }
    std::ifstream in(path, std::ios::binary);
    std::vector<char> chunk(1 << 20);
    while (in) {
        in.read(chunk.data(), std::streamsize(chunk.size()));
        if (in.gcount() > 0) add(std::as_bytes(std::span(chunk).first(std::size_t(in.gcount()))));
    }
    return in.eof();
}

std::string Fingerprint::text() const {
    std::array<char, 33> digits{};
    std::snprintf(digits.data(), digits.size(), "%016llx%016llx", static_cast<unsigned long long>(a_),
                  static_cast<unsigned long long>(b_));
    return digits.data();
}

namespace {

/// The scene without the places of its files.
Scene withoutPaths(const Scene& scene, const fs::path& folder) {
    Scene bare = scene;
    for (auto& [name, asset] : bare.assets) asset.path.clear();
    rewriteNodes(bare, [&]<class Node>(const Node& node) -> std::optional<Node> {
        if constexpr (std::is_same_v<Node, Transfer>) {
            const auto* library = std::get_if<LibraryTransfer>(&node.kind);
            if (!library || !library->isFile) return std::nullopt;
            Fingerprint text;
            text.addFile(folder / library->definition);
            Transfer transfer = node;
            std::get<LibraryTransfer>(transfer.kind).definition = text.text();
            return transfer;
        }
        return std::nullopt;
    });
    return bare;
}

}  // namespace

std::string fingerprintOf(const OpenedScene& opened) {
    Fingerprint all;
    all.add(sceneToJson(withoutPaths(opened.scene, opened.folder)));
    for (const auto& [name, asset] : opened.scene.assets) {
        all.add(name);
        // A volume's header may point to other files, so its values count; other kinds are one file each.
        if (const auto volume = opened.assets.volumes.find(name); volume != opened.assets.volumes.end()) {
            const VolumeGrid& grid = volume->second->grid();
            all.add(std::string(nameOf(volume->second->type())));
            all.add(std::as_bytes(std::span(&grid.size, 1)));
            all.add(std::as_bytes(std::span(&grid.channels, 1)));
            all.add(std::as_bytes(std::span(&grid.worldFromIndex, 1)));
            all.add(volume->second->voxels());
        } else {
            all.addFile(assetPath(asset, opened.folder));
        }
    }
    return all.text();
}

}  // namespace voledit
