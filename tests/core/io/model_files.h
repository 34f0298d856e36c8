#pragma once
// Small glTF, Collada and FBX files of one arm: Armature > Hips > Arm > Hand, with a clip.

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace voledit::test {

inline std::string base64(const std::string& bytes) {
    const char* const letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (i + k < bytes.size() ? std::uint8_t(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? letters[bits >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

inline std::string floatBytes(const std::vector<float>& values) {
    std::string bytes(values.size() * sizeof(float), '\0');
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

/// Key times 0, 0.5, 1; the arm's rotations about z by 0, 90 and 180 degrees; the hips' places.
inline std::string clipBytes() {
    const float h = 0.70710678118654752f;
    return floatBytes({0, 0.5f, 1}) + floatBytes({0, 0, 0, 1, 0, 0, h, h, 0, 0, 1, 0}) +
           floatBytes({0, 1, 0, 0, 1, 2, 0, 1, 4});
}

/// The JSON of a glTF file whose buffer is `uri` ("" for a GLB's own). `clips`: how many, all alike.
inline std::string gltfText(const std::string& uri, int clips = 1) {
    std::string animations;
    for (int c = 0; c < clips; ++c)
        animations += std::string(c ? "," : "") + "{\"name\":\"clip " + std::to_string(c) +
                      "\",\"channels\":[{\"sampler\":0,\"target\":{\"node\":2,\"path\":\"rotation\"}},"
                      "{\"sampler\":1,\"target\":{\"node\":1,\"path\":\"translation\"}}],"
                      "\"samplers\":[{\"input\":0,\"output\":1},{\"input\":0,\"output\":2}]}";
    return "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":["
           // Turned so that z is up in the file's own nodes, as exporters of Blender do, and in another unit.
           "{\"name\":\"Armature\",\"rotation\":[-0.7071067811865476,0,0,0.7071067811865476],\"scale\":[10,10,10],"
           "\"children\":[1]},"
           "{\"name\":\"Hips\",\"translation\":[0,1,0],\"children\":[2]},"
           "{\"name\":\"Arm\",\"translation\":[1,0,0],\"children\":[3]},"
           "{\"name\":\"Hand\",\"translation\":[2,0,0]}]"
           ",\"buffers\":[{\"byteLength\":96" +
           (uri.empty() ? "" : ",\"uri\":\"" + uri + "\"") +
           "}],"
           "\"bufferViews\":[{\"buffer\":0,\"byteOffset\":0,\"byteLength\":12},{\"buffer\":0,\"byteOffset\":12,"
           "\"byteLength\":48},"
           "{\"buffer\":0,\"byteOffset\":60,\"byteLength\":36}],"
           "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"SCALAR\",\"min\":[0],"
           "\"max\":[1]},"
           "{\"bufferView\":1,\"componentType\":5126,\"count\":3,\"type\":\"VEC4\"},"
           "{\"bufferView\":2,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}]" +
           (clips > 0 ? ",\"animations\":[" + animations + "]" : "") + "}";
}

inline std::string embeddedGltf(int clips = 1) {
    return gltfText("data:application/octet-stream;base64," + base64(clipBytes()), clips);
}

/// The same as a GLB.
inline std::string glbBytes() {
    std::string json = gltfText("");
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const std::string data = clipBytes();
    const auto word = [](std::uint32_t n) {
        std::string bytes(4, '\0');
        std::memcpy(bytes.data(), &n, 4);
        return bytes;
    };
    const std::string body = word(std::uint32_t(json.size())) + "JSON" + json + word(std::uint32_t(data.size())) +
                             std::string("BIN\0", 4) + data;
    return "glTF" + word(2) + word(std::uint32_t(12 + body.size())) + body;
}

/// The same in Collada, y up: the arm's matrix at the three times.
inline std::string colladaText() {
    return R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="meter" meter="1"/><up_axis>Y_UP</up_axis></asset>
<library_animations><animation id="arm"><source id="t"><float_array id="ta" count="3">0 0.5 1</float_array>
<technique_common><accessor source="#ta" count="3" stride="1"><param name="TIME" type="float"/></accessor></technique_common></source>
<source id="m"><float_array id="ma" count="48">
1 0 0 1 0 1 0 0 0 0 1 0 0 0 0 1  0 -1 0 1 1 0 0 0 0 0 1 0 0 0 0 1  -1 0 0 1 0 -1 0 0 0 0 1 0 0 0 0 1</float_array>
<technique_common><accessor source="#ma" count="3" stride="16"><param name="TRANSFORM" type="float4x4"/></accessor></technique_common></source>
<source id="i"><Name_array id="ia" count="3">LINEAR LINEAR LINEAR</Name_array>
<technique_common><accessor source="#ia" count="3" stride="1"><param name="INTERPOLATION" type="name"/></accessor></technique_common></source>
<sampler id="s"><input semantic="INPUT" source="#t"/><input semantic="OUTPUT" source="#m"/><input semantic="INTERPOLATION" source="#i"/></sampler>
<channel source="#s" target="Arm/transform"/></animation></library_animations>
<library_visual_scenes><visual_scene id="scene" name="scene">
<node id="Hips" name="Hips" type="JOINT"><matrix sid="transform">1 0 0 0 0 1 0 1 0 0 1 0 0 0 0 1</matrix>
<node id="Arm" name="Arm" type="JOINT"><matrix sid="transform">1 0 0 1 0 1 0 0 0 0 1 0 0 0 0 1</matrix>
<node id="Hand" name="Hand" type="JOINT"><matrix sid="transform">1 0 0 2 0 1 0 0 0 0 1 0 0 0 0 1</matrix></node></node></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#scene"/></scene></COLLADA>
)";
}

/// The same in FBX's text form: the arm's rotation about z, keys in FBX's time (46186158000 a second).
inline std::string fbxText() {
    const auto limb = [](const std::string& id, const std::string& name, const std::string& place) {
        return "    Model: " + id + ", \"Model::" + name +
               "\", \"LimbNode\" {\n        Version: 232\n        Properties70:  {\n"
               "            P: \"Lcl Translation\", \"Lcl Translation\", \"\", \"A\"," +
               place + "\n        }\n    }\n";
    };
    return "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n    FBXHeaderVersion: 1003\n    FBXVersion: 7400\n}\n"
           "GlobalSettings:  {\n    Version: 1000\n    Properties70:  {\n        P: \"UpAxis\", \"int\", \"Integer\", "
           "\"\",1\n    }\n}\n"
           "Objects:  {\n" +
           limb("10", "Hips", "0,1,0") + limb("20", "Arm", "1,0,0") + limb("30", "Hand", "2,0,0") +
           "    AnimationStack: 40, \"AnimStack::Take\", \"\" {\n    }\n    AnimationLayer: 50, \"AnimLayer::Base\", "
           "\"\" {\n    }\n"
           "    AnimationCurveNode: 60, \"AnimCurveNode::R\", \"\" {\n        Properties70:  {\n"
           "            P: \"d|X\", \"Number\", \"\", \"A\",0\n            P: \"d|Y\", \"Number\", \"\", \"A\",0\n"
           "            P: \"d|Z\", \"Number\", \"\", \"A\",0\n        }\n    }\n"
           "    AnimationCurve: 70, \"AnimCurve::\", \"\" {\n        Default: 0\n        KeyVer: 4008\n"
           "        KeyTime: *3 {\n            a: 0,23093079000,46186158000\n        }\n"
           "        KeyValueFloat: *3 {\n            a: 0,90,180\n        }\n"
           "        KeyAttrFlags: *1 {\n            a: 24836\n        }\n        KeyAttrDataFloat: *4 {\n            "
           "a: 0,0,0,0\n        }\n"
           "        KeyAttrRefCount: *1 {\n            a: 3\n        }\n    }\n}\n"
           "Connections:  {\n    C: \"OO\",10,0\n    C: \"OO\",20,10\n    C: \"OO\",30,20\n    C: \"OO\",50,40\n    C: "
           "\"OO\",60,50\n"
           "    C: \"OP\",60,20, \"Lcl Rotation\"\n    C: \"OP\",70,60, \"d|Z\"\n}\n";
}

}  // namespace voledit::test
