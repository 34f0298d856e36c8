// common/volume.glsl: a volume by index coordinates; samples stand at whole numbers.

uniform sampler3D volume;
uniform vec3 volumeLast;    // size - 1
uniform vec3 texelPerIndex;  // 1 / size
uniform vec3 domainMin;   // of index coordinates, with the contract's tolerance
uniform vec3 domainMax;

bool insideVolume(vec3 index) {
    return all(greaterThanEqual(index, domainMin)) && all(lessThanEqual(index, domainMax));
}

// Where the line index + t * perDepth, whose index is inside, enters (x, at most 0) and leaves (y, at least 0) the
// volume's domain.
vec2 domainCrossings(vec3 index, vec3 perDepth) {
    vec3 safe = mix(perDepth, vec3(1e-20), lessThan(abs(perDepth), vec3(1e-20)));
    vec3 toMin = (domainMin - index) / safe;
    vec3 toMax = (domainMax - index) / safe;
    vec3 enter = min(toMin, toMax);
    vec3 leave = max(toMin, toMax);
    return vec2(min(max(max(enter.x, enter.y), enter.z), 0.0), max(min(min(leave.x, leave.y), leave.z), 0.0));
}

// Trilinear, in the texture's own unit.
float rawAt(vec3 index) {
    return textureLod(volume, index * texelPerIndex + 0.5 * texelPerIndex, 0.0).r;
}

// Differences of one voxel along the index axes, at the volume's faces by the distance that there is: the definition
// of Volume::gradient.
vec3 rawDifferencesAt(vec3 index) {
    vec3 at = clamp(index, vec3(0.0), volumeLast);
    vec3 ahead = min(at + 1.0, volumeLast);
    vec3 behind = max(at - 1.0, vec3(0.0));
    vec3 difference = vec3(rawAt(vec3(ahead.x, at.yz)) - rawAt(vec3(behind.x, at.yz)),
                           rawAt(vec3(at.x, ahead.y, at.z)) - rawAt(vec3(at.x, behind.y, at.z)),
                           rawAt(vec3(at.xy, ahead.z)) - rawAt(vec3(at.xy, behind.z)));
    return difference / max(ahead - behind, vec3(1e-6));
}
