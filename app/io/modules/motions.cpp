#include "app/io/modules/motions.h"

#include <assimp/config.h>
#include <assimp/scene.h>

#include <assimp/DefaultIOSystem.h>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <map>
#include <set>

#include "app/io/checks.h"
#include "app/io/header_text.h"
#include "core/base/error.h"
#include "core/io/bvh.h"

namespace voledit {

namespace fs = std::filesystem;

namespace {

/// Opens the file itself, and of those that it names the ones in its folder or below.
class ConfinedFiles final : public Assimp::DefaultIOSystem {
public:
    explicit ConfinedFiles(const Source& source) : home_(fs::canonical(source.path).parent_path()) {}

    bool Exists(const char* name) const override { return allowed(name); }
    Assimp::IOStream* Open(const char* name, const char* mode) override {
        return mode && mode[0] == 'r' && allowed(name) ? DefaultIOSystem::Open(name, mode) : nullptr;
    }

private:
    bool allowed(const char* name) const {
        std::error_code failed;
        const fs::path full = fs::canonical(name, failed);
        return !failed && fs::is_regular_file(full, failed) &&
               std::mismatch(home_.begin(), home_.end(), full.begin(), full.end()).first == home_.end();
    }

    fs::path home_;
};

Vec3 toVec3(const aiVector3D& v) {
    return {v.x, v.y, v.z};
}
Quat toQuat(const aiQuaternion& q) {
    return {q.w, q.x, q.y, q.z};
}
Mat4 toMat4(const aiMatrix4x4& m) {
    Mat4 matrix;
    for (unsigned c = 0; c < 4; ++c)
        for (unsigned r = 0; r < 4; ++r) matrix[int(c)][int(r)] = m[r][c];
    return matrix;
}

std::vector<ClipNode> nodesOf(const Source& source, const aiScene& scene) {
    std::set<std::string> bones;
    for (unsigned m = 0; m < scene.mNumMeshes; ++m)
        for (unsigned b = 0; b < scene.mMeshes[m]->mNumBones; ++b)
            bones.insert(scene.mMeshes[m]->mBones[b]->mName.C_Str());
    constexpr std::size_t mostNodes = 100'000;
    struct Waiting {
        const aiNode* node;
        int parent;
    };
    std::vector<ClipNode> nodes;
    // Depth first, children in order: as BVH writes joints.
    std::vector<Waiting> waiting{{scene.mRootNode, Joint::kNoParent}};
    while (!waiting.empty()) {
        const auto [node, parent] = waiting.back();
        waiting.pop_back();
        if (nodes.size() >= mostNodes)
            throw Error(source.name, "has more than " + std::to_string(mostNodes) + " nodes",
                        "export the skeleton alone");
        for (unsigned c = node->mNumChildren; c-- > 0;) waiting.push_back({node->mChildren[c], int(nodes.size())});
        const std::string name = node->mName.C_Str();
        nodes.push_back({name, parent, toMat4(node->mTransformation), bones.contains(name), node->mNumMeshes > 0, {}});
    }
    return nodes;
}

/// Gives the nodes the clip's keys.
void addKeys(const aiAnimation& clip, std::vector<ClipNode>& nodes) {
    std::map<std::string, std::size_t> index;
    for (std::size_t n = 0; n < nodes.size(); ++n) index.emplace(nodes[n].name, n);
    const double second = clip.mTicksPerSecond > 0 ? clip.mTicksPerSecond : 1;
    for (unsigned c = 0; c < clip.mNumChannels; ++c) {
        const aiNodeAnim& channel = *clip.mChannels[c];
        const auto found = index.find(channel.mNodeName.C_Str());
        if (found == index.end()) continue;
        NodeKeys keys;
        for (unsigned k = 0; k < channel.mNumPositionKeys; ++k)
            keys.translate.push_back(
                {channel.mPositionKeys[k].mTime / second, toVec3(channel.mPositionKeys[k].mValue)});
        for (unsigned k = 0; k < channel.mNumRotationKeys; ++k)
            keys.rotate.push_back({channel.mRotationKeys[k].mTime / second, toQuat(channel.mRotationKeys[k].mValue)});
        for (unsigned k = 0; k < channel.mNumScalingKeys; ++k)
            keys.scale.push_back({channel.mScalingKeys[k].mTime / second, toVec3(channel.mScalingKeys[k].mValue)});
        nodes[found->second].keys = std::move(keys);
    }
}

std::string nameOf(const aiAnimation& clip) {
    return inQuotes(clip.mName.length > 0 ? clip.mName.C_Str() : "unnamed");
}

void warnOfOthers(const Source& source, const aiScene& scene, StoredMotion& motion) {
    if (scene.mNumAnimations < 2) return;
    std::string others;
    for (unsigned a = 1; a < std::min(scene.mNumAnimations, 6u); ++a)
        others += (a > 1 ? ", " : "") + nameOf(*scene.mAnimations[a]);
    motion.warnings.push_back(source.name + ": holds " + std::to_string(scene.mNumAnimations) + " clips; " +
                              nameOf(*scene.mAnimations[0]) + " was read, not " + others +
                              (scene.mNumAnimations > 6 ? " and more" : ""));
}

}  // namespace

void voleditReadMotion(const Source& source, StoredMotion& motion) {
    Assimp::Importer importer;
    importer.SetIOHandler(new ConfinedFiles(source));  // the importer owns it
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_TEXTURES, false);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_CAMERAS, false);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_LIGHTS, false);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true);
    const aiScene* scene = importer.ReadFile(source.path.string(), 0);
    if (!scene || !scene->mRootNode)
        throw Error(source.name,
                    "cannot be read as a skeleton with a motion (" + inQuotes(importer.GetErrorString()) + ")",
                    "export it anew, or as BVH");
    std::vector<ClipNode> nodes = nodesOf(source, *scene);
    if (scene->mNumAnimations > 0) addKeys(*scene->mAnimations[0], nodes);
    warnOfOthers(source, *scene, motion);
    motion.motion = motionOfNodes(source.name, nodes, motion.warnings);
    const std::string ending = source.path.extension().string();
    motion.format = ending == ".fbx" || ending == ".FBX"   ? "fbx"
                    : ending == ".dae" || ending == ".DAE" ? "dae"
                                                           : "gltf";
}

}  // namespace voledit
